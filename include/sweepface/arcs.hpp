#pragma once

#include <span>
#include <vector>

#include "sweepface/followers.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// Finds the turns among the targets from the model alone (docs/arcs.md); none while targets are
/// not decoded. Part of the library that converts.
std::vector<Turn> findTurns(const Rig& rig);
/// The turns that the rig knows, or else those that are found. Part of the same library.
std::vector<Turn> turnsOf(const Rig& rig);

/// Where a point is half-way on the arc from `from` to `to`, minus where it is half-way on the
/// straight line; zero where no arc is meant: beside the axis, and for more than two thirds of half
/// a turn.
Vec3 bulge(const Turn& turn, const Vec3& from, const Vec3& to);

/// The name of the target that bends the path of another into an arc.
std::string arcName(std::string_view target);

/// Adds a target with the bulge for every turn, named by arcName(), to the end of a rig. A target
/// that already has that name, as in a face made from a GLB with arcs, is used instead, and is no
/// turn itself. Returns their followers. With these, points at a weight w are at
/// x₀ + wΔ + 4w(1 − w)B: where they would be anyway at 0 and 1, on the arc at ½.
std::vector<Follower> addArcs(Rig& rig, std::span<const Turn> turns);

}  // namespace sweepface
