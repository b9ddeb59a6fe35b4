#pragma once

#include "sweepface/eval.hpp"

namespace sweepface {

/// Cuts patches on until their triangles are near the surface: what two lines through the middle
/// of a patch can't tell, as it may be twisted between them. Remembers what it measured.
class SagMeter {
 public:
  /// Of a settled pose, which it looks at as long as it lives.
  SagMeter(const Surface& surface, std::span<const Vec3> vectors);

  /// Makes a density finer until no triangle's edge is further than `error` from the surface at its
  /// middle, where edges of the source may be cut on, or until there are more than `most` vertices.
  /// Arcs are cut with the patches beside them, as a strip between a coarse side and a fine grid is
  /// only as near as the side.
  void refine(Density& density, double error, std::int64_t most);

 private:
  struct Sag {
    double most = 0;                ///< model units
    std::array<double, 2> along{};  ///< how far the edge where it is leads along u and v, in cells
  };
  struct Measured {
    std::vector<Index> cuts;  ///< of the patch and its arcs
    Sag sag;
  };

  PatchMesh stitched(const Density& density, Index patch);
  Sag sagOf(const Density& density, Index patch);
  const Sag& measure(const Density& density, Index patch);
  std::array<Index, 2> finer(const Density& density, Index patch, double error);
  void cutSides(Index patch, std::array<Index, 2> cells, Density& density) const;

  const Surface& surface_;
  std::span<const Vec3> vectors_;
  std::vector<Index> nodes_;                     // [nodes] the same where they are at one point
  std::vector<Index> arcs_;                      // [arcs] the first vertex inside, for one patch
  std::vector<std::vector<Measured>> measured_;  // [patches]
};

}  // namespace sweepface
