#pragma once

#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface::cli {

/// The point on a node, curve or patch that is nearest to a given point.
struct NearPlace {
  Vec3 at;
  double distance = 0;
};

/// How near the neutral's nodes, curves and patches come to a point, in model units, accurate to a
/// fraction of an edge.
struct NearThings {
  std::vector<NearPlace> nodes, curves, patches;
};
NearThings nearThings(const Rig& rig, const Vec3& point);

}  // namespace sweepface::cli
