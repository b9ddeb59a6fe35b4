#include "key_frames.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "sweepface/gltf.hpp"

namespace sweepface::cli {
namespace {

constexpr double kMostFrames = 1e6, kRate = 480;

/// Times of keys have single precision.
double written(double time) { return static_cast<float>(time); }

std::vector<double> coarseTimes(const Performance& performance) {
  const double last = std::max(64.0, std::ceil(std::min(performance.seconds * kRate, kMostFrames)));
  std::vector<double> times;
  for (double k = 0; k <= last; ++k) times.push_back(performance.seconds * (k / last));
  return times;
}

/// Halves stretches of time until straight lines over them are near enough.
class Halver {
 public:
  /// What a line misses between two times, and what is beyond both its ends: not a jump's.
  struct Miss {
    double all = 0, butJumps = 0;
  };
  using Missed = std::function<Miss(double from, double to)>;

  Halver(Missed missed, double allowed, double seconds)
      : missed_(std::move(missed)),
        allowed_(allowed),
        shortest_(std::min(1 / kRate, seconds / 64) / 256) {}

  /// Times of keys within all of these, which increase.
  std::vector<double> cut(const std::vector<double>& times) {
    cut_ = {written(times.front())};
    for (const double time : times)
      if (written(time) > cut_.back()) add(cut_.back(), written(time));
    return std::move(cut_);
  }

  double worst() const { return worst_; }  ///< that a line still misses but for jumps

 private:
  /// Adds the end of a stretch, and before it what is needed in between.
  void add(double from, double to) {
    const Miss miss = missed_(from, to);
    const double middle = written(std::midpoint(from, to));
    const bool isShortest = to - from <= shortest_ || from >= middle || middle >= to;
    if (miss.all > allowed_ && !isShortest && static_cast<double>(cut_.size()) < kMostFrames) {
      add(from, middle);
      add(middle, to);
    } else {
      cut_.push_back(to);
      worst_ = std::max(worst_, isShortest ? miss.butJumps : miss.all);
    }
  }

  Missed missed_;
  double allowed_, shortest_, worst_ = 0;
  std::vector<double> cut_;
};

/// What lines miss of the weights.
Halver::Missed ofWeights(const Performance& performance, std::size_t targets) {
  return [&performance, start = Weights(targets), end = Weights(targets), now = Weights(targets)](
             double from, double to) mutable {
    constexpr double kGolden = 0.6180339887;  // not in step, as zeros of a swing are
    const int looks = static_cast<int>(std::clamp(30 * (to - from), 3.0, 100.0));
    performance.at(from, start);
    performance.at(to, end);
    Halver::Miss most;
    for (int look = 1; look <= looks; ++look) {
      const double s = std::fmod(look * kGolden, 1);
      performance.at(std::lerp(from, to, s), now);
      for (std::size_t k = 0; k < now.size(); ++k) {
        most.all = std::max(most.all, std::abs(now[k] - std::lerp(start[k], end[k], s)));
        const auto [low, high] = std::minmax(start[k], end[k]);
        most.butJumps = std::max({most.butJumps, low - now[k], now[k] - high});
      }
    }
    return most;
  };
}

/// Radians that a turn at constant speed misses in the middle, where it misses most of angles that
/// change at constant speed.
Halver::Miss ofTurn(const Performance& performance, double from, double to) {
  const auto at = [&](double time) { return quaternionOf(performance.pose(time).head); };
  const Quaternion start = at(from), end = at(to), middle = at(std::midpoint(from, to));
  double along = 0, square = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double sum = start[k] + end[k];
    along += sum * middle[k], square += sum * sum;
  }
  const double miss = 2 * std::acos(std::min(1.0, std::abs(along) / std::sqrt(square)));
  return {miss, miss};
}

}  // namespace

std::vector<double> ownKeyTimes(const Performance& performance) {
  std::vector<double> times;
  for (const double time : performance.frameTimes) {
    if (!times.empty() && written(times.back()) >= written(time)) {
      times.back() = std::nextafter(static_cast<float>(time), -1.0F);
      if (times.size() == 1 || written(times[times.size() - 2]) >= times.back()) times.pop_back();
    }
    times.push_back(time);
  }
  return times;
}

KeyFrames keyFrames(const Performance& performance, const Rig& rig, double tolerance) {
  const std::vector<double>& own = performance.frameTimes;
  Halver halver(ofWeights(performance, rig.targets.size()), tolerance / 16, performance.seconds);
  std::vector<double> times = halver.cut(own.empty() ? coarseTimes(performance) : own);
  // Single precision may end before the last event does.
  times.back() = std::max(times.back(), performance.seconds);
  Clip clip = sample(performance, rig, times);
  const double missed = performance.frameMiss + halver.worst();
  return {std::move(clip), std::max(tolerance - missed, tolerance / 2), halver.worst()};
}

std::vector<double> turningTimes(const Performance& performance) {
  Halver halver([&](double from, double to) { return ofTurn(performance, from, to); },
                kHeadTolerance / 16, performance.seconds);
  return halver.cut(performance.frameTimes);
}

}  // namespace sweepface::cli
