#include "sweepface/limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

namespace sweepface {
namespace {

std::optional<double> numberOf(std::string_view text) {
  const std::string digits(text);
  char* end = nullptr;  // not from_chars: libc++ 19 has none for floating point
  const double value = std::strtod(digits.c_str(), &end);
  const bool plain =
      !digits.empty() && digits.find_first_not_of("0123456789+-.eE") == std::string::npos;
  if (!plain || *end != 0 || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<Limits::Range> rangeOf(std::string_view text) {
  const auto colon = text.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto low = numberOf(text.substr(0, colon)), high = numberOf(text.substr(colon + 1));
  if (!low || !high || *low > *high) return std::nullopt;
  return Limits::Range{*low, *high};
}

}  // namespace

Result<Limits> Limits::parse(const Rig& rig, std::string_view text) {
  constexpr double most = std::numeric_limits<double>::infinity();
  std::vector<Range> ranges(rig.targets.size(), Range{-most, most});
  while (!text.empty()) {
    const auto comma = text.find(',');
    const std::string_view item = text.substr(0, comma);
    text = comma == std::string_view::npos ? "" : text.substr(comma + 1);
    const auto equals = item.rfind('=');
    const bool all = equals == std::string_view::npos;
    const auto range = rangeOf(all ? item : item.substr(equals + 1));
    if (!range)
      return fail("limits are like 0:1 or jawOpen=0:0.8, the lower one first, not '" +
                  std::string(item) + "'");
    if (all) {
      std::ranges::fill(ranges, *range);
      continue;
    }
    const Result<Index> target = findTarget(rig, item.substr(0, equals));
    if (!target) return std::unexpected(target.error());
    ranges[*target] = *range;
  }
  return Limits(std::move(ranges));
}

void Limits::apply(std::span<double> weights) const noexcept {
  for (std::size_t k = 0; k < std::min(weights.size(), ranges_.size()); ++k)
    weights[k] = std::clamp(weights[k], ranges_[k].low, ranges_[k].high);
}

}  // namespace sweepface
