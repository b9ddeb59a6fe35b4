#include "gltf/column.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace sweepface::gltf {
namespace {

template <typename T>
void append(std::string& bytes, T value) {
  for (std::size_t k = 0; k < sizeof(T); ++k)
    bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * k)));
}

template <typename T>
T load(const char* bytes) {
  T value = 0;
  for (std::size_t k = 0; k < sizeof(T); ++k)
    value = static_cast<T>(value | static_cast<T>(static_cast<unsigned char>(bytes[k])) << (8 * k));
  return value;
}

std::pair<double, double> rangeOf(Component type) {
  switch (type) {
    case Component::int8:
      return {-128, 127};
    case Component::uint8:
      return {0, 255};
    case Component::int16:
      return {-32768, 32767};
    case Component::uint16:
      return {0, 65535};
    case Component::uint32:
      return {0, 4294967295.0};
    case Component::float32:
      break;
  }
  constexpr double most = std::numeric_limits<float>::max();
  return {-most, most};
}

void appendAs(std::string& bytes, Component type, double value) {
  const auto whole = [&] { return static_cast<std::int64_t>(std::llround(value)); };
  switch (type) {
    case Component::int8:
    case Component::uint8:
      return append(bytes, static_cast<std::uint8_t>(whole()));
    case Component::int16:
    case Component::uint16:
      return append(bytes, static_cast<std::uint16_t>(whole()));
    case Component::uint32:
      return append(bytes, static_cast<std::uint32_t>(whole()));
    case Component::float32:
      return append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value) + 0.0f));
  }
}

}  // namespace

double Column::stored(std::size_t component) const {
  const char* const at = &bytes[component * sizeOf(type)];
  switch (type) {
    case Component::int8:
      return static_cast<std::int8_t>(load<std::uint8_t>(at));
    case Component::uint8:
      return load<std::uint8_t>(at);
    case Component::int16:
      return static_cast<std::int16_t>(load<std::uint16_t>(at));
    case Component::uint16:
      return load<std::uint16_t>(at);
    case Component::uint32:
      return load<std::uint32_t>(at);
    case Component::float32:
      return std::bit_cast<float>(load<std::uint32_t>(at));
  }
  return 0;
}

Column pack(std::span<const double> values, std::size_t width, Component type, bool normalized) {
  Column column{.bytes = {}, .type = type, .width = width, .normalized = normalized};
  column.bytes.reserve(values.size() * sizeOf(type));
  const auto [low, high] = rangeOf(type);
  const double one = normalized ? high : 1;
  for (double value : values) {
    value *= one;
    const bool fits = value >= low && value <= high;  // not so for what is no number
    column.sound = column.sound && fits;
    appendAs(column.bytes, type, fits ? value : value > high ? high : value < low ? low : 0);
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
  // The largest number of a type means that a strip starts anew.
  const Component type = largest < 0xffff ? Component::uint16 : Component::uint32;
  const std::vector<double> numbers(vertices.begin(), vertices.end());
  return pack(numbers, 1, type);
}

}  // namespace sweepface::gltf
