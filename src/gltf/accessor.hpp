#pragma once

#include <optional>
#include <vector>

#include "sweepface/vec.hpp"

#include "gltf/component.hpp"
#include "gltf/document.hpp"

namespace sweepface::gltf {

/// An accessor whose data lie within their buffer views.
struct Accessor {
  struct Sparse {
    std::size_t count = 0;
    Component indexType = Component::uint8;
    std::size_t indexView = 0, indexOffset = 0, valueView = 0, valueOffset = 0;
  };

  std::size_t index = 0;            ///< in the list of accessors
  std::optional<std::size_t> view;  ///< none: zeros
  std::size_t offset = 0, count = 0;
  Component type = Component::float32;
  std::size_t rows = 1, columns = 1;
  bool normalized = false;
  std::optional<Sparse> sparse;

  std::size_t components() const { return rows * columns; }
  /// Bytes from one column to the next: columns of small matrices begin at multiples of four.
  std::size_t columnSize() const;
  std::size_t elementSize() const { return columnSize() * columns; }
  bool hasData() const { return view || sparse; }
};

/// Reads the accessor at an index, which must be in the list. Without a buffer view its count is
/// only a claim.
Result<Accessor> accessorAt(const Document& document, std::size_t index);

/// All values, component by component, normalised if the accessor says so. All are finite. Refuses
/// more zeros than a file of this size can mean.
Result<std::vector<double>> decode(const Document& document, const Accessor& accessor);

/// Values in threes.
std::vector<Vec3> asVectors(const std::vector<double>& values);

}  // namespace sweepface::gltf
