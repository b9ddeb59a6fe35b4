#pragma once

#include <array>
#include <optional>

#include "surface/stored_jets.hpp"

namespace sweepface::drawing {

/// Derivatives of a node by index 3i + j, index 0 its place.
using Jet = std::array<Vec3, 9>;

/// The place of an arm in a node's star; nothing if it does not leave the node.
std::optional<int> placeInStar(const Connectivity& connectivity, Index node, HalfArc arm);

/// At an irregular node: the angle at which an arm that is not collapsed leaves in the chart.
double chartAngle(const Surface& surface, const StoredJets& jets, Index node, HalfArc arm);

/// A jet of an irregular node, up to the second order, in axes turned by `angle` clockwise: those
/// of the chart if the jet's own x axis lies at `angle` there.
Jet turnedJet(const Jet& jet, double angle);

/// The vector of a node's derivative, or of a fan's of it; -1 if it is predicted. A regular fan's
/// first sector has those too that other fans give it.
Index jetVector(const Surface& surface, const StoredJets& jets, Index node, int component, int fan);

}  // namespace sweepface::drawing
