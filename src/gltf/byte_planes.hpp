#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "sweepface/result.hpp"

// Numbers deflate badly: the first bytes of a float are much like those of its neighbours, and the
// last ones are noise. A table of numbers deflates better plane by plane: the first bytes of all
// its rows, then the second ones, and so on.
namespace sweepface::gltf {

/// Rows of bytes one after another.
struct ByteTable {
  std::size_t begin = 0, width = 0, rows = 0;

  std::size_t size() const { return width * rows; }
  std::size_t end() const { return begin + size(); }
};

/// The bytes, with the tables that deflate better that way in planes, each plane as it is or as
/// differences from row to row, and a head that says which. Empty if no table does. Tables must be
/// in ascending order and not overlap.
std::string toPlanes(std::string_view bytes, std::span<const ByteTable> tables);

/// Undoes toPlanes(). Refuses tables that are out of order or reach beyond the bytes.
Result<std::string> fromPlanes(std::string_view planes);

}  // namespace sweepface::gltf
