#include "sweepface/regional_clips.hpp"

#include <algorithm>

#include "sweepface/head.hpp"

namespace sweepface {
namespace {

/// Whether each of so many regions can have a clip of this size.
Result<void> checkRoom(const Clip& clip, std::size_t regions) {
  if (regions == 0) return fail("it needs a region to be played in.");
  if (clip.weights.size() <= kMostClipWeights / regions) return {};
  return fail("it is too long for ", regions, " regions; cut it, or play it with fewer.");
}

}  // namespace

void mergeTimes(std::vector<double>& times) {
  std::ranges::sort(times);
  const auto same =
      std::ranges::unique(times, [](double a, double b) { return b - a <= 1e-12 * b; });
  times.erase(same.begin(), same.end());
}

Result<RegionalClips> inRegions(Clip capture, std::span<const Matter> matters, const Spring& hold) {
  if (auto ok = checkRoom(capture, matters.size()); !ok) return std::unexpected(ok.error());
  if (const auto ok = Trajectory::spring({}, 0, hold); !ok)
    return fail("the spring on which heavy regions hang: ", ok.error().message);
  for (const Matter& matter : matters)
    if (auto ok = check(matter); !ok) return std::unexpected(ok.error());
  RegionalClips clips;
  for (const Matter& matter : matters)
    clips.ofRegions.push_back(inMatter(capture, matter, hold, matters.size()));
  clips.whole = std::move(capture);
  return clips;
}

Result<RegionalClips> inRegions(const Timeline& timeline, std::span<const std::string> names,
                                std::span<const Matter> matters) {
  if (auto ok = checkRegions(timeline, names); !ok) return std::unexpected(ok.error());
  if (matters.empty() || names.size() != matters.size())
    return fail("it needs a region to be played in, with a name and a matter each.");
  double end = 0;
  for (std::size_t r = 0; r < matters.size(); ++r)
    end = std::max(end, endIn(timeline, names[r], matters[r]));
  RegionalClips clips;
  for (std::size_t r = 0; r < matters.size(); ++r) {
    auto baked = bakeToPlay(timeline, names[r], matters[r], matters.size(), end);
    if (!baked) return std::unexpected(baked.error());
    if (auto ok = checkRoom(baked->clip, matters.size()); !ok) return std::unexpected(ok.error());
    clips.missed = std::max(clips.missed, baked->missed);
    clips.ofRegions.push_back(std::move(baked->clip));
  }
  const Clip& first = clips.ofRegions.front();
  if (matters.front() == Matter{} || std::ranges::none_of(first.names, ClipAngles::tells)) {
    clips.whole = first;
    return clips;
  }
  auto whole = bakeToPlay(timeline, names.front(), {}, matters.size(), end);
  if (!whole) return std::unexpected(whole.error());
  clips.whole = std::move(whole->clip);
  return clips;
}

}  // namespace sweepface
