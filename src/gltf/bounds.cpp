#include "gltf/bounds.hpp"

#include <algorithm>

#include "gltf/accessor.hpp"

namespace sweepface::gltf {
namespace {

void tellBounds(Json& json, const std::vector<double>& values, std::size_t width) {
  std::vector<double> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width));
  std::vector<double> high = low;
  for (std::size_t k = width; k < values.size(); ++k) {
    low[k % width] = std::min(low[k % width], values[k]);
    high[k % width] = std::max(high[k % width], values[k]);
  }
  if (find(json, "min")) json["min"] = low;
  if (find(json, "max")) json["max"] = high;
}

}  // namespace

void correctBounds(Document& document, const std::vector<bool>& rounded) {
  std::uint64_t left = document.mostClaimed();
  for (std::size_t a = 0; a < document.list("accessors").size(); ++a) {
    Json& json = document.json["accessors"][a];
    if (!find(json, "min") && !find(json, "max")) continue;
    const auto accessor = accessorAt(document, a);
    // Faults of an accessor are reported when it is read.
    if (!accessor || accessor->type != Component::float32 || !accessor->view ||
        !rounded[*accessor->view])
      continue;
    if (accessor->count > left) return;  // claimed by a few bytes again and again
    left -= accessor->count;
    if (const auto values = decode(document, *accessor))
      tellBounds(json, *values, accessor->components());
  }
}

}  // namespace sweepface::gltf
