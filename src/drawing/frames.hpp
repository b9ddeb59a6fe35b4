#pragma once

#include <array>
#include <optional>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface::drawing {

/// Derivatives of a node by index 3i + j, index 0 its place.
using Jet = std::array<Vec3, 9>;

/// Where a surface stores the jets of its nodes.
class StoredJets {
 public:
  explicit StoredJets(const Surface& surface);
  /// The stored vector ∂x^i ∂y^j (index 3i + j) of a node, or of all irregular nodes at its point;
  /// -1 if it is predicted or derived.
  Index at(Index node, int component) const { return at_[9 * home_[node] + component]; }
  /// Of the irregular nodes at a point the one that stands for all; every other node itself.
  Index home(Index node) const { return home_[node]; }

 private:
  std::vector<Index> home_;  // [nodes]
  std::vector<Index> at_;    // [9·nodes]
};

/// At a crossing: by how many right angles the surface's axes are turned against those whose x
/// leaves along `arm`; nothing if `arm` does not leave the node.
std::optional<int> quarterTo(const Connectivity& connectivity, Index node, HalfArc arm);

/// At an irregular node: the angle at which an arm that is not collapsed leaves in the chart.
double chartAngle(const Surface& surface, const StoredJets& jets, Index node, HalfArc arm);

/// A jet of an irregular node, up to the second order, in axes turned by `angle` clockwise: those
/// of the chart if the jet's own x axis lies at `angle` there.
Jet turnedJet(const Jet& jet, double angle);

}  // namespace sweepface::drawing
