#pragma once

#include <span>
#include <vector>

#include "sweepface/usd.hpp"

#include "usd/text.hpp"

namespace sweepface::usd {

/// Whether there is anything to move: targets, or a head that turns.
bool moves(const Rig& rig, const UsdOptions& options);

/// The time codes of an animation's frames.
std::vector<double> timeCodes(std::span<const double> times, const UsdOptions& options);

/// The skeleton `name` below the prim at `path`: a joint that holds the whole head, and the
/// animation of that and of the weights.
void addSkeleton(Text& text, const std::string& path, const std::string& name, const Rig& rig,
                 const UsdOptions& options);

/// What binds a mesh of so many points to the joint of the skeleton at `skeleton`.
void bindToJoint(Text& text, const std::string& skeleton, std::size_t points);

}  // namespace sweepface::usd
