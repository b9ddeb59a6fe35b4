#pragma once

#include <span>
#include <vector>

#include "sweepface/followers.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// The turns of those targets that are turns, from the model alone (docs/arcs.md). Of the library
/// that converts; none while targets are not decoded.
std::vector<Turn> findTurns(const Rig& rig);
/// Those that the rig knows, or else those that are found. Of the same library.
std::vector<Turn> turnsOf(const Rig& rig);

/// Where a point is half-way on the arc from `from` to `to`, minus where it is half-way on the
/// straight line; zero where no arc is meant: beside the axis, and for more than two thirds of half
/// a turn.
Vec3 bulge(const Turn& turn, const Vec3& from, const Vec3& to);

/// A name for the target that bends the way of another into an arc.
std::string arcName(std::string_view target);

/// Adds a target with the bulge for every turn, named by arcName(), to the end of a rig. One of
/// that name that is there already, as in a face made from a GLB with arcs, serves instead, and is
/// no turn itself. Returns their followers. With those, a weight w goes along x₀ + wΔ + 4w(1 − w)B:
/// where it would go without at 0 and 1, on the arc at ½.
std::vector<Follower> addArcs(Rig& rig, std::span<const Turn> turns);

}  // namespace sweepface
