#include "report/scale.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "sweepface/plot.hpp"

namespace sweepface {

double Scale::at(double value) const {
  const auto place = [&](double v) { return logarithmic ? std::log(v) : v; };
  const double low = place(ticks.front()), high = place(ticks.back());
  return std::lerp(start, end, (place(value) - low) / (high - low));
}

std::vector<std::string> labelsOf(const Scale& scale) {
  const std::vector<double>& ticks = scale.ticks;
  const double most = std::max(std::abs(ticks.front()), std::abs(ticks.back())),
               step = ticks[1] - ticks[0];
  const double digits =
      scale.logarithmic ? 1 : std::floor(std::log10(most)) - std::floor(std::log10(step)) + 1;
  std::vector<std::string> labels;
  for (const double tick : ticks) {
    const double fewest = std::abs(tick) >= 1e4 && std::abs(tick) < 1e7 ? 7 : 4;
    labels.push_back(
        fmt::format("{:.{}g}", tick, static_cast<int>(std::clamp(digits, fewest, 15.0))));
  }
  return labels;
}

namespace {

// Whether numbers differ by no more than rounding; steps that small could not be counted.
bool isSame(double low, double high) {
  return !(high - low > 1e-12 * std::max(std::abs(low), std::abs(high)));
}

// Powers of ten, seven intervals at most.
std::vector<double> decadeTicks(double low, double high) {
  const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9)),
            last = static_cast<int>(std::ceil(std::log10(high) - 1e-9)),
            step = (last - first + 6) / 7;
  std::vector<double> ticks;
  for (int decade = first; decade < last + step; decade += step)
    ticks.push_back(std::pow(10, decade));
  return ticks;
}

}  // namespace

std::vector<double> niceTicks(double low, double high, bool logarithmic) {
  std::vector<double> ticks;
  if (logarithmic) {
    if (!(low > 0) || !(high >= low) || !std::isfinite(high)) return {1, 10};
    if (high > 1e3 * low) return decadeTicks(low, high);
    for (int decade = static_cast<int>(std::floor(std::log10(low)));; ++decade)
      for (const double step : {1.0, 2.0, 5.0}) {
        const double tick = step * std::pow(10, decade);
        // Keeps the last tick that is not above the smallest value, and all after it.
        if (tick <= low * (1 + 1e-9)) ticks.clear();
        ticks.push_back(tick);
        if (tick >= high * (1 - 1e-9) && ticks.size() > 1) return ticks;
      }
  }
  if (isSame(low, high)) high = low + (low != 0 ? std::abs(low) : 1);
  if (!std::isfinite(high - low) || high - low < 1e-300) return {0, 1};
  const double decade = std::pow(10, std::floor(std::log10((high - low) / 5)));
  double step = 10 * decade;
  for (const double nice : {5.0, 2.0, 1.0})
    if ((high - low) / (nice * decade) <= 7) step = nice * decade;
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  const int steps = static_cast<int>(last - first);
  for (int k = 0; k <= steps; ++k) ticks.push_back((first + k) * step);
  return ticks;
}

}  // namespace sweepface
