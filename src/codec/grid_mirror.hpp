#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/mirror.hpp"

namespace sweepface::codec {

/// Maps the vertices and quads at level 1 to their mirror images.
struct GridMirror {
  std::vector<Index> vertex;  ///< [vertices] or -1
  std::vector<Index> quad;    ///< [quads] or -1
  std::vector<std::uint8_t>
      turn;  ///< [quads] corner k becomes corner (turn - k) mod 4 of the image
};

/// `quads` are those of LevelOne.
GridMirror mirrorGrid(const Surface& surface, std::span<const std::array<Index, 4>> quads,
                      Index vertices, const Mirror& mirror);

}  // namespace sweepface::codec
