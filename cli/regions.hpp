#pragma once

#include "sweepface/regions.hpp"

#include "following.hpp"
#include "performance.hpp"

namespace sweepface::cli {

/// The file that names parts of the face that move in their own way.
void addRegions(CLI::App& app, std::string& file);

/// What is played, with its followers and with the regions of the file, or else of a timeline.
/// Their targets are added to the rig, and the performance has a weight for each of them.
Result<Performance> perform(const PerformanceArguments& what, const std::string& regionFile,
                            const FollowingArguments& following, Rig& rig);

}  // namespace sweepface::cli
