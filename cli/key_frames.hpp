#pragma once

#include "performance.hpp"

namespace sweepface::cli {

/// The times of a clip's own frames. Where two coincide in single precision, the earlier one moves
/// to the preceding number: it may be the last before a jump.
std::vector<double> ownKeyTimes(const Performance& performance);

/// A performance as frames, and how far keys may be off the straight lines between them to stay
/// within a tolerance of what is played.
struct KeyFrames {
  Clip clip;
  double tolerance = 0;
  double missed = 0;  ///< error where it swings too quickly for the frames, jumps aside
};
/// A clip's own frames, or 480 a second of a law, and more wherever straight lines between them
/// would use up more than a sixteenth of the tolerance: where it bounces or swings quickly, and
/// where weights follow from others. All times are distinct in single precision.
KeyFrames keyFrames(const Performance& performance, const Rig& rig, double tolerance);

/// The same for the times of a clip's head, with turns at constant speed instead of straight lines,
/// and kHeadTolerance.
std::vector<double> turningTimes(const Performance& performance);

}  // namespace sweepface::cli
