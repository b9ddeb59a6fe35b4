#pragma once

#include "sweepface/eval.hpp"

#include "surface/vertex_numbers.hpp"

namespace sweepface {

/// Refines patches until their triangles are near the surface. The two lines through the middle of
/// a patch cannot ensure that, as the patch may be twisted between them. Remembers what it has
/// measured.
class SagMeter {
 public:
  /// `vectors` is a settled pose, which must outlive the meter.
  SagMeter(const Surface& surface, std::span<const Vec3> vectors);

  /// Refines a density until no triangle's edge is further than `error` from the surface at its
  /// middle, as far as the edges of the source may be divided, or until there are more than `most`
  /// vertices. Arcs are refined together with the patches beside them, as a strip between a coarse
  /// side and a fine grid is only as near as the side.
  void refine(Density& density, double error, std::int64_t most);

 private:
  struct Sag {
    double most = 0;                ///< model units
    std::array<double, 2> along{};  ///< extent of the worst edge along u and v, in cells
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
  VertexNumbers nodes_;
  std::vector<Index> arcs_;                      // [arcs] the first vertex inside, for one patch
  std::vector<std::vector<Measured>> measured_;  // [patches]
};

}  // namespace sweepface
