#pragma once

#include <array>
#include <optional>

#include "surface/stored_jets.hpp"

namespace sweepface::drawing {

/// The derivatives ∂x^i ∂y^j of a node at index 3i + j; index 0 is its position.
using Jet = std::array<Vec3, 9>;

/// The index of an arm in a node's star; none if it does not leave the node.
std::optional<int> placeInStar(const Connectivity& connectivity, Index node, HalfArc arm);

/// The angle in the chart at which an arm leaves an irregular node. The arm must not be collapsed.
double chartAngle(const Surface& surface, const StoredJets& jets, Index node, HalfArc arm);

/// A jet of an irregular node, up to the second order, in axes turned clockwise by `angle`. These
/// are the axes of the chart if the jet's own x axis lies at `angle` there.
Jet turnedJet(const Jet& jet, double angle);

/// The vector of a derivative of a node, or of one of its fans; -1 if it is predicted. The first
/// sector of a regular fan also has the derivatives that other fans give it.
Index jetVector(const Surface& surface, const StoredJets& jets, Index node, int component, int fan);

}  // namespace sweepface::drawing
