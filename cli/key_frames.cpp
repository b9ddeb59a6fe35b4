#include "key_frames.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "sweepface/gltf.hpp"

namespace sweepface::cli {
namespace {

constexpr double kMostFrames = 1e6, kRate = 480;

/// A key's time as it is written, in single precision.
double written(double time) { return static_cast<float>(time); }

std::vector<double> coarseTimes(const Performance& performance) {
  const double last = std::max(64.0, std::ceil(std::min(performance.seconds * kRate, kMostFrames)));
  std::vector<double> times;
  for (double k = 0; k <= last; ++k) times.push_back(performance.seconds * (k / last));
  return times;
}

/// Halves intervals of time until straight lines across them are close enough.
class Halver {
 public:
  /// How far a line is off between two times: in all, and apart from jumps.
  struct Missed {
    std::function<double(double from, double to)> all, butJumps;
  };

  Halver(Missed missed, double allowed, double seconds)
      : missed_(std::move(missed)),
        allowed_(allowed),
        shortest_(std::min(1 / kRate, seconds / 64) / 256) {}

  /// Key times as written: those of `times`, which increase, and more where lines are too far off.
  std::vector<double> cut(const std::vector<double>& times) {
    cut_ = {written(times.front())};
    for (const double time : times)
      if (written(time) > cut_.back()) add(cut_.back(), written(time));
    return std::move(cut_);
  }

  double worst() const { return worst_; }  ///< how far a line is still off, jumps aside

 private:
  /// Adds the end of an interval, and before it what is needed in between.
  void add(double from, double to) {
    const double miss = missed_.all(from, to), middle = written(std::midpoint(from, to));
    const bool isShortest = to - from <= shortest_ || from >= middle || middle >= to;
    if (miss > allowed_ && !isShortest && static_cast<double>(cut_.size()) < kMostFrames) {
      add(from, middle);
      add(middle, to);
    } else {
      cut_.push_back(to);
      if (miss > worst_) worst_ = std::max(worst_, isShortest ? missed_.butJumps(from, to) : miss);
    }
  }

  Missed missed_;
  double allowed_, shortest_, worst_ = 0;
  std::vector<double> cut_;
};

/// How far lines are off the weights.
class WeightLines {
 public:
  WeightLines(const Performance& performance, std::size_t targets)
      : performance_(performance),
        start_(targets),
        end_(targets),
        now_(targets),
        missed_(targets),
        beyond_(targets) {}

  double all(double from, double to) {
    compare(from, to);
    return missed_.empty() ? 0 : std::ranges::max(missed_);
  }

  double butJumps(double from, double to) {
    compare(from, to);
    double most = 0;
    for (std::size_t k = 0; k < missed_.size(); ++k)
      if (missed_[k] > most) most = std::max(most, jumps(k, from, to) ? beyond_[k] : missed_[k]);
    return most;
  }

 private:
  /// How far each weight is off its line, and how far it goes beyond both ends of the line.
  void compare(double from, double to) {
    constexpr double kGolden = 0.6180339887;  // not in step with the zeros of a swing
    const int looks = static_cast<int>(std::clamp(30 * (to - from), 3.0, 100.0));
    performance_.at(from, start_);
    performance_.at(to, end_);
    std::ranges::fill(missed_, 0.0);
    std::ranges::fill(beyond_, 0.0);
    for (int look = 1; look <= looks; ++look) {
      const double s = std::fmod(look * kGolden, 1);
      performance_.at(std::lerp(from, to, s), now_);
      for (std::size_t k = 0; k < now_.size(); ++k) {
        missed_[k] = std::max(missed_[k], std::abs(now_[k] - std::lerp(start_[k], end_[k], s)));
        const auto [low, high] = std::minmax(start_[k], end_[k]);
        beyond_[k] = std::max({beyond_[k], low - now_[k], now_[k] - high});
      }
    }
  }

  /// Whether a weight is somewhere steeper than any intended slope: a cut in a timeline takes a few
  /// microseconds.
  bool jumps(std::size_t k, double from, double to) {
    constexpr double kShort = 4e-6, kSteepest = 200;  // seconds, weights a second
    double before = start_[k], after = end_[k];
    while (to - from > kShort) {
      const double middle = std::midpoint(from, to);
      performance_.at(middle, now_);
      const bool isLater = std::abs(after - now_[k]) > std::abs(now_[k] - before);
      (isLater ? from : to) = middle;
      (isLater ? before : after) = now_[k];
    }
    return std::abs(after - before) > kSteepest * (to - from);
  }

  const Performance& performance_;
  Weights start_, end_, now_;
  std::vector<double> missed_, beyond_;
};

/// How far, in radians, a turn at constant speed is off in its middle, where it is furthest off
/// angles that change at constant speed.
double ofTurn(const Performance& performance, double from, double to) {
  const auto at = [&](double time) { return quaternionOf(performance.pose(time).head); };
  const Quaternion start = at(from), end = at(to), middle = at(std::midpoint(from, to));
  double along = 0, square = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double sum = start[k] + end[k];
    along += sum * middle[k], square += sum * sum;
  }
  return 2 * std::acos(std::min(1.0, std::abs(along) / std::sqrt(square)));
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
  WeightLines lines(performance, rig.targets.size());
  Halver halver({[&](double from, double to) { return lines.all(from, to); },
                 [&](double from, double to) { return lines.butJumps(from, to); }},
                tolerance / 16, performance.seconds);
  std::vector<double> times = halver.cut(own.empty() ? coarseTimes(performance) : own);
  // In single precision the last time may fall short of the last event.
  times.back() = std::max(times.back(), performance.seconds);
  Clip clip = sample(performance, rig, times);
  const double missed = performance.frameMiss + halver.worst();
  return {std::move(clip), missed < tolerance ? tolerance - missed : tolerance / 2, halver.worst()};
}

std::vector<double> turningTimes(const Performance& performance) {
  const auto missed = [&](double from, double to) { return ofTurn(performance, from, to); };
  Halver halver({missed, missed}, kHeadTolerance / 16, performance.seconds);
  return halver.cut(performance.frameTimes);
}

}  // namespace sweepface::cli
