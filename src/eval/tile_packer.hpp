#pragma once

#include "eval/planes.hpp"
#include "eval/tiles.hpp"

namespace sweepface {

/// A tile before it is packed.
struct TileSource {
  std::vector<std::uint32_t> vertices;        ///< where its vertices go
  std::vector<std::uint16_t> targets;         ///< weights that move it
  std::vector<std::array<float, 3>> neutral;  ///< [rows]
  Planes differences;                         ///< [rows × targets], in units of `unit`
  double unit = 1;                            ///< what a difference of 1 stands for
};

/// How far a packed tile may be from its source, in its units.
struct PackedErrors {
  std::vector<double> ofTarget;  ///< [targets] measured at weight 1
  double rounding = 0;           ///< in addition, for weights within [-1, 1]
};

/// Packs a tile so that no target of weight 1 is off by more than 1 unit in any row, if 16 bits
/// suffice. `nobody` is the index of a weight that is always 0.
PackedErrors packTile(const TileSource& source, std::uint16_t nobody, TileTable& table);

}  // namespace sweepface
