#include "gltf/copies.hpp"

#include <map>
#include <set>
#include <span>

#include "gltf/limits.hpp"

namespace sweepface::gltf {
namespace {

/// The accessors in which vertices of each run may differ.
std::vector<std::set<std::size_t>> tellingAccessors(const Document& document, const Parts& parts) {
  const std::size_t count = document.list("accessors").size();
  std::vector<std::set<std::size_t>> accessors(parts.runs.size());
  for (const Part& part : parts.parts) {
    const auto add = [&](const Json& attributes) {
      for (const auto& [name, number] : attributes.items())
        if (name != "POSITION" && name != "NORMAL" && name != "TANGENT")
          accessors[part.run].insert(*asIndex(number, count));
    };
    const Json& primitive = primitiveOf(document, parts, part);
    add(primitive["attributes"]);
    for (const Json& target : listOf(primitive, "targets")) add(target);
  }
  return accessors;
}

/// Keeps those vertices of a run together that have been together and agree in an accessor.
class Splitter {
 public:
  Splitter(const Document& document, std::vector<Index> places)
      : document_(document), copies_(std::move(places)) {}

  /// False where the accessor is damaged, or there is more than the file can mean.
  bool split(std::size_t number, const Run& run) {
    elements_ += run.count;
    const auto accessor = accessorAt(document_, number);
    if (elements_ > mostElements(document_) || !accessor) return false;
    const auto values = decode(document_, *accessor);
    if (values) split(*values, accessor->components(), run);
    return values.has_value();
  }
  /// By nothing but their places.
  void split(const Run& run) { split({}, 0, run); }

  std::vector<Index> take() { return std::move(copies_); }

 private:
  void split(std::span<const double> values, std::size_t width, const Run& run) {
    std::map<std::pair<Index, std::vector<double>>, Index> known;
    for (std::size_t v = 0; v < run.count; ++v) {
      const auto own = values.subspan(v * width, width);
      Index& copy = copies_[run.first + v];
      std::pair key(copy, std::vector<double>(own.begin(), own.end()));
      copy = known.try_emplace(std::move(key), static_cast<Index>(run.first + v)).first->second;
    }
  }

  const Document& document_;
  std::vector<Index> copies_;
  std::size_t elements_ = 0;
};

}  // namespace

std::vector<Index> copiesOf(const Document& document, const Parts& parts,
                            const std::vector<Index>& places) {
  const auto accessors = tellingAccessors(document, parts);
  Splitter splitter(document, places);
  for (std::size_t r = 0; r < parts.runs.size(); ++r) {
    splitter.split(parts.runs[r]);
    for (const std::size_t accessor : accessors[r])
      if (!splitter.split(accessor, parts.runs[r])) return {};
  }
  return splitter.take();
}

}  // namespace sweepface::gltf
