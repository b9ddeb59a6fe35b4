#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "sweepface/result.hpp"

// Numbers deflate badly: of a float the first bytes are much as those of its neighbours, and the
// last ones noise. A table of numbers deflates better plane by plane: the first bytes of all its
// rows, then the second ones, and so on.
namespace sweepface::gltf {

/// Rows of bytes one after another.
struct ByteTable {
  std::uint64_t begin = 0, width = 0, rows = 0;  ///< below 2^32 each

  std::uint64_t size() const { return width * rows; }
  std::uint64_t end() const { return begin + size(); }
};

/// The bytes with those of the tables that then deflate better in planes, each as it is or as
/// differences from row to row, and a head that says which. Nothing if none do. Tables are in
/// ascending order and apart.
std::string toPlanes(std::string_view bytes, std::span<const ByteTable> tables);

/// What was made planes of. Refuses tables that are not in order or beyond the bytes.
Result<std::string> fromPlanes(std::string_view planes);

}  // namespace sweepface::gltf
