#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace sweepface::gltf {

/// The type of a number in a buffer, with glTF's code for it.
enum class Component {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126
};

std::optional<Component> componentOf(std::size_t number);
/// Bytes of a component.
std::size_t sizeOf(Component type);
/// Whether indices may be of this type.
constexpr bool isOfIndices(Component type) {
  return type == Component::uint8 || type == Component::uint16 || type == Component::uint32;
}

/// The range of a type. In normalised integers, `high` means 1.
struct ComponentRange {
  double low, high;
};
ComponentRange rangeOf(Component type);

/// Reads a number from little-endian bytes.
double load(Component type, const char* bytes);
/// Appends a number within the type's range, rounded to the type. Zeros lose their sign.
void append(std::string& bytes, Component type, double value);

}  // namespace sweepface::gltf
