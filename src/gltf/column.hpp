#pragma once

#include <span>
#include <string>

#include "sweepface/vec.hpp"

#include "gltf/component.hpp"

namespace sweepface::gltf {

/// Values for an accessor, element by element without gaps, little-endian.
struct Column {
  std::string bytes;
  Component type = Component::float32;
  std::size_t width = 1;  ///< components of an element: 1 to 4, or 16
  bool normalized = false;
  bool bounded = false;  ///< min and max are to be written, as positions must have them
  bool sound = true;     ///< every value could be held

  std::size_t elementSize() const { return width * sizeOf(type); }
  std::size_t count() const { return bytes.size() / elementSize(); }
  /// The component's number as it is stored.
  double stored(std::size_t component) const;
};

/// A number rounded to single precision, as renderers will have it.
inline double single(double value) { return static_cast<double>(static_cast<float>(value)); }

/// Packs numbers into a type, rounded if it is an integer type. Zeros lose their sign.
Column pack(std::span<const double> values, std::size_t width, Component type = Component::float32,
            bool normalized = false);
Column pack(std::span<const Vec3> values, Component type = Component::float32,
            bool normalized = false);
Column pack(std::span<const Vec2> values);
/// Packs vertices of triangles into the smallest type that every graphics API supports.
Column packIndices(std::span<const Index> vertices);

}  // namespace sweepface::gltf
