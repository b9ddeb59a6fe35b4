#include "sweepface/filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sweepface {
namespace {

/// The share of the new value in an exponential filter with the given cutoff frequency.
double share(double cutoff, double seconds) {
  const double steps = 2 * std::numbers::pi * cutoff * seconds;
  return steps / (steps + 1);
}

}  // namespace

OneEuroFilter::OneEuroFilter(std::size_t count, const OneEuro& settings)
    : settings_(settings), values_(count, 0), speeds_(count, 0) {}

void OneEuroFilter::apply(double seconds, std::span<double> weights) noexcept {
  const std::size_t count = std::min(values_.size(), weights.size());
  constexpr double kNoTime = 1e-9;  // speeds would not stay finite
  const bool follows = begun_ && seconds > kNoTime && std::isfinite(seconds);
  begun_ = true;
  for (std::size_t k = 0; k < count; ++k) {
    double& value = values_[k];
    double& speed = speeds_[k];
    if (!follows) {
      value = weights[k];
      speed = 0;
      continue;
    }
    speed = std::lerp(speed, (weights[k] - value) / seconds, share(settings_.speedCutoff, seconds));
    const double cutoff = settings_.cutoff + settings_.speedGain * std::abs(speed);
    value = std::lerp(value, weights[k], share(cutoff, seconds));
    weights[k] = value;
  }
}

namespace {

/// The weights of all frames, filtered from the first to the last or backwards.
std::vector<double> filtered(const Clip& clip, const OneEuro& settings, bool backwards) {
  const std::size_t n = clip.names.size(), last = clip.times.size() - 1;
  OneEuroFilter filter(n, settings);
  std::vector<double> weights = clip.weights;
  double before = 0;
  for (std::size_t k = 0; k <= last; ++k) {
    const std::size_t f = backwards ? last - k : k;
    filter.apply(k == 0 ? 0 : std::abs(clip.times[f] - before),
                 std::span(weights).subspan(f * n, n));
    before = clip.times[f];
  }
  return weights;
}

}  // namespace

void smooth(Clip& clip, const OneEuro& settings) {
  if (clip.times.empty()) return;
  const std::vector<double> late = filtered(clip, settings, false);
  const std::vector<double> early = filtered(clip, settings, true);
  for (std::size_t k = 0; k < clip.weights.size(); ++k)
    clip.weights[k] = std::midpoint(late[k], early[k]);
}

}  // namespace sweepface
