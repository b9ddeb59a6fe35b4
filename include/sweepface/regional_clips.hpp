#pragma once

#include <span>
#include <string>
#include <vector>

#include "sweepface/clip.hpp"
#include "sweepface/regions.hpp"
#include "sweepface/timeline.hpp"
#include "sweepface/trajectory.hpp"

namespace sweepface {

/// A recording as every region of a face plays it.
struct RegionalClips {
  Clip whole;                   ///< of head and eyes, which no region's matter holds back
  std::vector<Clip> ofRegions;  ///< [R]
  double missed = 0;            ///< as Baked has it, the most of any region
};

/// A capture by the matters of R ≥ 1 regions, which hang on it by `hold`. Refuses matters that
/// check() refuses, springs that Trajectory::spring does, and more than kMostClipWeights in all.
Result<RegionalClips> inRegions(Clip capture, std::span<const Matter> matters, const Spring& hold);

/// A timeline in R ≥ 1 regions, which end together. Refuses events for regions that are not among
/// the names [R], and more than kMostClipWeights in all.
Result<RegionalClips> inRegions(const Timeline& timeline, std::span<const std::string> names,
                                std::span<const Matter> matters);

}  // namespace sweepface
