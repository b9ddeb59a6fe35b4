#include "gltf/column.hpp"

#include <algorithm>
#include <vector>

namespace sweepface::gltf {

double Column::stored(std::size_t component) const {
  return load(type, &bytes[component * sizeOf(type)]);
}

Column pack(std::span<const double> values, std::size_t width, Component type, bool normalized) {
  Column column{.bytes = {}, .type = type, .width = width, .normalized = normalized};
  column.bytes.reserve(values.size() * sizeOf(type));
  const auto [low, high] = rangeOf(type);
  const double one = normalized ? high : 1;
  for (double value : values) {
    value *= one;
    const bool fits = value >= low && value <= high;  // false for NaN
    column.sound = column.sound && fits;
    append(column.bytes, type, fits ? value : value > high ? high : value < low ? low : 0);
  }
  return column;
}

Column pack(std::span<const Vec3> values, Component type, bool normalized) {
  std::vector<double> numbers;
  numbers.reserve(3 * values.size());
  for (const Vec3& v : values) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  return pack(numbers, 3, type, normalized);
}

Column pack(std::span<const Vec2> values) {
  std::vector<double> numbers;
  numbers.reserve(2 * values.size());
  for (const Vec2& v : values) numbers.insert(numbers.end(), {v.x, v.y});
  return pack(numbers, 2);
}

Column packIndices(std::span<const Index> vertices) {
  const Index largest = vertices.empty() ? 0 : std::ranges::max(vertices);
  // The largest number of a type means primitive restart.
  const Component type = largest < 0xffff ? Component::uint16 : Component::uint32;
  const std::vector<double> numbers(vertices.begin(), vertices.end());
  return pack(numbers, 1, type);
}

}  // namespace sweepface::gltf
