#pragma once

#include "performance.hpp"

namespace sweepface::cli {

/// A clip's own frames. Where single precision cannot tell two apart, the earlier one is moved to
/// the number before: it may be the last before a jump.
std::vector<double> ownKeyTimes(const Performance& performance);

/// A performance as frames, and how far keys may be off their straight lines so that they are
/// within a tolerance of what is played.
struct KeyFrames {
  Clip clip;
  double tolerance = 0;
  double missed = 0;  ///< what swings too quickly for them is off by so much; jumps aside
};
/// A clip's own frames, of a law 480 a second, and more wherever straight lines between them would
/// take more than a sixteenth of the tolerance: where it bounces or swings quickly, and where
/// weights follow from others. All at times that single precision can tell.
KeyFrames keyFrames(const Performance& performance, const Rig& rig, double tolerance);

/// The same of the times of a clip's head, with turns at constant speed and kHeadTolerance.
std::vector<double> turningTimes(const Performance& performance);

}  // namespace sweepface::cli
