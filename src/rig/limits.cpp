#include "sweepface/limits.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "rig/number.hpp"

namespace sweepface {
namespace {

std::optional<Limits::Range> rangeOf(std::string_view text) {
  const auto colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto low = numberOf(trimmed(text.substr(0, colon))),
             high = numberOf(trimmed(text.substr(colon + 1)));
  if (!low || !high || *low > *high) return std::nullopt;
  return Limits::Range{*low, *high};
}

}  // namespace

Result<Limits> Limits::parse(const Rig& rig, std::string_view text) {
  constexpr double most = std::numeric_limits<double>::infinity();
  std::vector<Range> ranges(rig.targets.size(), Range{-most, most});
  std::vector<char> isTold(rig.targets.size() + 1, 0);  // the last entry: limits for all
  while (!text.empty()) {
    const std::string_view item = takeItem(text);
    if (item.empty()) continue;
    const auto equals = item.rfind('=');
    const bool all = equals == std::string_view::npos;
    const auto range = rangeOf(all ? item : item.substr(equals + 1));
    if (!range)
      return fail("Limits are like 0:1 or jawOpen=0:0.8, the lower one first, not '" +
                  std::string(item) + "'.");
    if (all) {
      if (std::exchange(isTold.back(), 1))
        return fail("Limits for all are told twice; tell them once.");
      for (std::size_t k = 0; k < ranges.size(); ++k)
        if (!isTold[k]) ranges[k] = *range;
      continue;
    }
    const Result<Index> target = findTarget(rig, trimmed(item.substr(0, equals)));
    if (!target) return std::unexpected(target.error());
    if (std::exchange(isTold[*target], 1))
      return fail("The limits of '" + rig.targets[*target].name +
                  "' are told twice; tell them once.");
    ranges[*target] = *range;
  }
  return Limits(std::move(ranges));
}

void Limits::apply(std::span<double> weights) const noexcept {
  for (std::size_t k = 0; k < std::min(weights.size(), ranges_.size()); ++k)
    weights[k] = std::clamp(weights[k], ranges_[k].low, ranges_[k].high);
}

}  // namespace sweepface
