#pragma once

namespace sweepface::io {

/// A clock that counts frames (SMPTE ST 12-1). At 23.976, 29.97, 47.952 and 59.94 frames a second a
/// second of the clock has as many as at 24, 30, 48 and 60, and is a thousandth longer; clocks that
/// drop frames leave out the numbers of the first two of 30, or four of 60, of every minute but
/// each tenth, to keep up with the time of day.
class FrameClock {
 public:
  explicit FrameClock(double framesPerSecond, bool dropsFrames = false);

  /// Frames in a second of the clock.
  double counted() const { return counted_; }
  /// The time of day at which it shows this, in seconds.
  double timeOf(double seconds, double frames) const;
  /// Seconds of the clock, which drops no frames, at a time of day.
  double secondsAt(double time) const { return time / length_; }

 private:
  double counted_;
  double length_ = 1;   // of its second
  double dropped_ = 0;  // frames a minute
};

}  // namespace sweepface::io
