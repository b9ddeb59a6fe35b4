#pragma once

#include "performance.hpp"

namespace sweepface::cli {

/// A clip's own frames; of those that the single precision of keys cannot tell apart, the last.
std::vector<double> ownKeyTimes(const Performance& performance);

/// A performance as frames, and how far keys may be off their straight lines so that they are
/// within a tolerance of what is played.
struct KeyFrames {
  Clip clip;
  double tolerance = 0;
  double missed = 0;  ///< what swings too quickly for them is off by so much between two frames
};
/// A clip's own frames; of a law 480 a second, and more wherever straight lines between them would
/// take more than a sixteenth of the tolerance: where it bounces or swings quickly.
KeyFrames keyFrames(const Performance& performance, const Rig& rig, double tolerance);

}  // namespace sweepface::cli
