#pragma once

namespace sweepface::io {

/// A clock that counts frames (SMPTE ST 12-1). At 23.976, 29.97, 47.952 and 59.94 frames a second,
/// a second of the clock counts as many frames as at 24, 30, 48 and 60, and lasts a thousandth
/// longer. Drop-frame clocks skip the first two frame numbers at 30, or four at 60, of every minute
/// except each tenth, to keep up with the time of day.
class FrameClock {
 public:
  explicit FrameClock(double framesPerSecond, bool dropsFrames = false);

  /// Frames in a second of the clock.
  double counted() const { return counted_; }
  /// The time of day at which the clock shows this, in seconds.
  double timeOf(double seconds, double frames) const;
  /// The clock's seconds at a time of day; it must not drop frames.
  double secondsAt(double time) const { return time / length_; }

 private:
  double counted_;
  double length_ = 1;   // of the clock's second
  double dropped_ = 0;  // frame numbers a minute
};

}  // namespace sweepface::io
