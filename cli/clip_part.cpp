#include "clip_part.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace sweepface::cli {
namespace {

/// Frames within it, and one at each end.
std::vector<double> framesWithin(const std::vector<double>& times, double from, double to) {
  constexpr double kSame = 1e-4;  // seconds: a frame so near to an end is that end
  std::vector<double> within{0};
  for (const double time : times)
    if (time - from > kSame && to - time > kSame) within.push_back(time - from);
  within.push_back(to - from);
  return within;
}

}  // namespace

Result<Performance> partOf(Performance whole, const PerformanceArguments& a) {
  const double from = a.clipFrom, asked = a.clipTo.value_or(whole.seconds);
  const double to = std::min(asked, whole.seconds);
  if (asked <= from && a.clipTo)
    return fail(fmt::format(
        "--clip-to {:.6g} is no later than --clip-from {:.6g}; give a later one.", asked, from));
  if (from > 0 && from >= whole.seconds)
    return fail(
        fmt::format("{} lasts {:.6g} s, of which nothing is left from {:.6g} s on; give "
                    "less --clip-from.",
                    whole.called, whole.seconds, from));
  if (asked > whole.seconds)
    whole.notes.push_back(fmt::format("{} ends after {:.6g} s, before --clip-to {:.6g}.",
                                      whole.called, whole.seconds, asked));
  if (from == 0 && to == whole.seconds) return whole;
  Performance part = whole;
  part.seconds = to - from;
  part.frameTimes = framesWithin(whole.frameTimes, from, to);
  part.at = [at = whole.at, from](double time, std::span<double> weights) {
    at(from + time, weights);
  };
  part.kinematicsAt = [at = whole.kinematicsAt, from](double time, std::span<Kinematics> weights) {
    at(from + time, weights);
  };
  if (whole.pose) part.pose = [at = whole.pose, from](double time) { return at(from + time); };
  return part;
}

}  // namespace sweepface::cli
