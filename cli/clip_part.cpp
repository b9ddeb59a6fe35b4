#include "clip_part.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace sweepface::cli {
namespace {

/// The frames between two times, relative to the first, and one at each end.
std::vector<double> framesWithin(const std::vector<double>& times, double from, double to) {
  constexpr double kSame = 1e-4;  // seconds: a frame this close to an end is that end
  std::vector<double> within{0};
  for (const double time : times)
    if (time - from > kSame && to - time > kSame) within.push_back(time - from);
  within.push_back(to - from);
  return within;
}

}  // namespace

Result<Performance> partOf(Performance played, const PerformanceArguments& a) {
  const double from = a.clipFrom, asked = a.clipTo.value_or(played.seconds);
  const double to = std::min(asked, played.seconds);
  if (asked <= from && a.clipTo)
    return fail(fmt::format(
        "--clip-to {:.6g} is no later than --clip-from {:.6g}; give a later one.", asked, from));
  if (from > 0 && from >= played.seconds)
    return fail(
        fmt::format("{} lasts {:.6g} s, of which nothing is left from {:.6g} s on; give "
                    "less --clip-from.",
                    played.called, played.seconds, from));
  if (asked > played.seconds)
    played.notes.push_back(fmt::format("{} ends after {:.6g} s, before --clip-to {:.6g}.",
                                       played.called, played.seconds, asked));
  if (from == 0 && to == played.seconds) return played;
  played.seconds = to - from;
  played.frameTimes = framesWithin(played.frameTimes, from, to);
  played.at = [at = std::move(played.at), from](double time, std::span<double> weights) {
    at(from + time, weights);
  };
  played.kinematicsAt = [at = std::move(played.kinematicsAt), from](double time,
                                                                    std::span<Kinematics> weights) {
    at(from + time, weights);
  };
  if (played.pose)
    played.pose = [at = std::move(played.pose), from](double time) { return at(from + time); };
  return played;
}

}  // namespace sweepface::cli
