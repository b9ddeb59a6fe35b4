#include "io/frame_clock.hpp"

#include <cmath>

namespace sweepface::io {

FrameClock::FrameClock(double framesPerSecond, bool dropsFrames) : counted_(framesPerSecond) {
  constexpr double kLonger = 1.001, kSame = 0.0045;
  const double whole = std::round(framesPerSecond * kLonger);
  const bool isBetween = whole > 0 && framesPerSecond != std::round(framesPerSecond) &&
                         std::abs(framesPerSecond * kLonger - whole) < kSame;
  if (isBetween) counted_ = whole;
  if (dropsFrames && (counted_ == 30 || counted_ == 60)) dropped_ = counted_ / 15;
  if (isBetween || dropped_ > 0) length_ = kLonger;
}

double FrameClock::timeOf(double seconds, double frames) const {
  const double minutes = std::floor(seconds / 60);
  frames -= dropped_ * (minutes - std::floor(minutes / 10));
  return (seconds + frames / counted_) * length_;
}

}  // namespace sweepface::io
