#include "sweepface/filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sweepface {
namespace {

/// The share of the new value in an exponential filter of a cutoff frequency.
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

void smooth(Clip& clip, const OneEuro& settings) {
  const std::size_t n = clip.names.size();
  OneEuroFilter filter(n, settings);
  for (std::size_t f = 0; f < clip.times.size(); ++f)
    filter.apply(f == 0 ? 0 : clip.times[f] - clip.times[f - 1],
                 std::span(clip.weights).subspan(f * n, n));
}

}  // namespace sweepface
