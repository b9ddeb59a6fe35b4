#include "key_frames.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sweepface::cli {
namespace {

constexpr double kMostFrames = 1e6;

/// Whether the single precision of keys tells them apart.
bool areApart(double a, double b) { return static_cast<float>(a) < static_cast<float>(b); }

std::vector<double> coarseTimes(const Performance& performance) {
  constexpr double kRate = 480;
  const double last = std::max(64.0, std::ceil(std::min(performance.seconds * kRate, kMostFrames)));
  std::vector<double> times;
  for (double k = 0; k <= last; ++k) times.push_back(performance.seconds * (k / last));
  return times;
}

/// Halves stretches of time until straight lines over them are near enough.
class Halver {
 public:
  Halver(const Performance& performance, std::size_t targets, double allowed)
      : performance_(performance),
        allowed_(allowed),
        start_(targets),
        end_(targets),
        now_(targets) {}

  /// Adds the end of a stretch, and before it what is needed in between.
  void add(double from, double to, int halvings = 0) {
    constexpr int kMostHalvings = 8;
    const double miss = missed(from, to), middle = std::midpoint(from, to);
    if (miss > allowed_ && halvings < kMostHalvings && areApart(from, middle) &&
        areApart(middle, to) && static_cast<double>(times.size()) < kMostFrames) {
      add(from, middle, halvings + 1);
      add(middle, to, halvings + 1);
    } else {
      times.push_back(to);
      worst = std::max(worst, miss);
    }
  }

  std::vector<double> times;
  double worst = 0;  ///< that a line still misses

 private:
  double missed(double from, double to) {
    performance_.at(from, start_);
    performance_.at(to, end_);
    double most = 0;
    for (const double s : {0.191, 0.5, 0.691}) {  // not in step, as zeros of a swing are
      performance_.at(std::lerp(from, to, s), now_);
      for (std::size_t k = 0; k < now_.size(); ++k)
        most = std::max(most, std::abs(now_[k] - std::lerp(start_[k], end_[k], s)));
    }
    return most;
  }

  const Performance& performance_;
  const double allowed_;
  Weights start_, end_, now_;
};

}  // namespace

std::vector<double> ownKeyTimes(const Performance& performance) {
  std::vector<double> times;
  for (const double time : performance.frameTimes) {
    if (!times.empty() && !areApart(times.back(), time)) times.pop_back();
    times.push_back(time);
  }
  return times;
}

KeyFrames keyFrames(const Performance& performance, const Rig& rig, double tolerance) {
  if (!performance.frameTimes.empty())
    return {sample(performance, rig, ownKeyTimes(performance)),
            std::max(tolerance - performance.frameMiss, tolerance / 2), performance.frameMiss};
  const std::vector<double> coarse = coarseTimes(performance);
  Halver halver(performance, rig.targets.size(), tolerance / 16);
  halver.times.push_back(coarse.front());
  for (std::size_t k = 1; k < coarse.size(); ++k) halver.add(coarse[k - 1], coarse[k]);
  return {sample(performance, rig, std::move(halver.times)),
          std::max(tolerance - halver.worst, tolerance / 2), halver.worst};
}

}  // namespace sweepface::cli
