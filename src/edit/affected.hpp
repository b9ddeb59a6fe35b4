#pragma once

#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface::edit {

/// The patches affected by an edit: those whose jets or curves depend on what changed.
class Affected {
 public:
  explicit Affected(const Surface& surface)
      : surface_(surface), vectors_(surface.vectorCount()), patches_(surface.patchCount()) {}

  void addVector(Index vector) { vectors_[vector] = true; }
  /// Adds the patches along a ribbon, and those at T-nodes that lie on it.
  void addRibbon(Index ribbon);
  std::vector<Index> patches();

 private:
  template <typename Visit>
  void eachCornerVector(Index corner, Visit visit) const;
  Index ribbonOf(HalfArc h) const { return surface_.wireframe().arcs[arcOf(h)].ribbon; }

  const Surface& surface_;
  std::vector<bool> vectors_;  // [vectorCount]
  std::vector<bool> patches_;  // [patches]
};

}  // namespace sweepface::edit
