#pragma once

#include <algorithm>
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
  Clip whole;                   ///< for head and eyes, which no region's matter holds back
  std::vector<Clip> ofRegions;  ///< [R]
  double missed = 0;            ///< as in Baked, the most of any region

  /// Until the last region has arrived.
  double seconds() const {
    double longest = 0;
    for (const Clip& clip : ofRegions) longest = std::max(longest, clip.seconds());
    return longest;
  }
};

/// Puts times of frames of several regions in order, each once: delayed regions have others, or the
/// same but for rounding.
void mergeTimes(std::vector<double>& times);

/// A capture as R ≥ 1 regions of these matters play it, hanging on it by `hold`. Refuses matters
/// that check() refuses, springs that Trajectory::spring() refuses, and more than kMostClipWeights
/// weights in all.
Result<RegionalClips> inRegions(Clip capture, std::span<const Matter> matters, const Spring& hold);

/// A timeline in R ≥ 1 regions, which end together. Refuses events for regions that are not among
/// the names [R], and more than kMostClipWeights in all.
Result<RegionalClips> inRegions(const Timeline& timeline, std::span<const std::string> names,
                                std::span<const Matter> matters);

}  // namespace sweepface
