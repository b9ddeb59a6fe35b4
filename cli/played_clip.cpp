#include "played_clip.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include "sweepface/filter.hpp"
#include "sweepface/gltf.hpp"
#include "sweepface/io.hpp"
#include "sweepface/regional_clips.hpp"
#include "sweepface/timeline.hpp"

#include "output.hpp"

namespace sweepface::cli {
namespace {

Result<Timeline> readTimeline(const PerformanceArguments& a, const std::string& text) {
  if (a.smooth || !a.animation.empty() || a.tellsSpring || a.tellsRate || !a.clipNames.empty())
    return fail(
        fmt::format("{} is a timeline; leave --smooth, --animation, --clip-fps, --clip-names, "
                    "--frequency and --damping out.",
                    a.clip));
  return parseTimeline(text, a.clip);
}

Result<Clip> readCapture(const PerformanceArguments& a, const std::string& text) {
  const bool isJson = isOfKind(a.clip, ".json"), gltf = isGltf(a.clip);
  if (!isJson && !gltf && !isOfKind(a.clip, ".csv"))
    return fail(
        fmt::format("{} is neither a .csv, a .json, a .glb, a .gltf nor a .vrm; give a recording "
                    "or a timeline.",
                    a.clip));
  if (!gltf && !a.animation.empty())
    return fail(fmt::format(
        "{} has no animations to choose from, as a .glb has; leave --animation out.", a.clip));
  auto clip = isJson ? parseClipJson(text, a.clip, a.clipRate)
              : gltf ? parseGltfClip(text, a.clip, folderOf(utf8Path(a.clip)), a.animation)
                     : parseLiveLinkCsv(text, a.clip, a.clipRate);
  if (clip && isJson && a.tellsRate && parseClipJson(text, a.clip))
    clip->warnings.push_back(
        fmt::format("{} tells when its frames are, so --clip-fps changes nothing.", a.clip));
  if (clip && a.smooth) smooth(*clip);
  return clip;
}

Result<Clip> withNames(Clip clip, const PerformanceArguments& a,
                       std::span<const std::string> targets) {
  if (a.clipNames.empty()) return clip;
  const auto text = readFile(utf8Path(a.clipNames));
  if (!text) return std::unexpected(text.error());
  const auto map = parseNameMap(*text, a.clipNames);
  if (!map) return std::unexpected(map.error());
  return renamed(std::move(clip), *map, targets);
}

struct ReadClip {
  RegionalClips clips;
  bool isAuthored = false;  // by someone who knows which targets are to move
};

Result<ReadClip> readClip(const PerformanceArguments& a, const std::string& text,
                          std::span<const std::string> targets, std::span<const Region> regions) {
  const std::vector<Matter> matters = mattersOf(regions);
  const auto called = [&](Result<RegionalClips> clips, bool isAuthored) -> Result<ReadClip> {
    if (!clips) return fail(fmt::format("{}: {}", a.clip, clips.error().message));
    return ReadClip{std::move(*clips), isAuthored};
  };
  if (isOfKind(a.clip, ".json") && isTimeline(text)) {
    const auto timeline = readTimeline(a, text);
    if (!timeline) return std::unexpected(timeline.error());
    return called(inRegions(*timeline, namesOf(regions), matters), true);
  }
  auto capture = readCapture(a, text);
  if (capture) capture = withNames(std::move(*capture), a, targets);
  if (!capture) return std::unexpected(capture.error());
  return called(inRegions(std::move(*capture), matters, {a.frequency, a.damping}), false);
}

}  // namespace

Result<std::vector<Performance>> byClip(const PerformanceArguments& a, const std::string& text,
                                        const Rig& rig, std::span<const Region> regions) {
  const std::vector<std::string> targets = rig.targetNames();
  Result<ReadClip> read = readClip(a, text, targets, regions);
  if (!read) return std::unexpected(read.error());
  RegionalClips* const clips = &read->clips;
  const auto whole = std::make_shared<const Clip>(std::move(clips->whole));
  const ClipMatch match = matchClip(*whole, targets);
  if (!movesAnything(*whole, match))
    return fail(
        fmt::format("{}: none of its {} names is a target of the face: {}; `sweepface info` "
                    "lists the targets.",
                    a.clip, whole->names.size(), firstOf(whole->names)));
  Performance shared;
  shared.name = utf8Path(a.clip).stem().string();
  if (!whole->title.empty()) shared.name += " " + whole->title;
  // The name is printed on a single line, whatever the file calls it.
  std::ranges::replace_if(shared.name, [](unsigned char c) { return c < ' '; }, ' ');
  shared.called = a.clip;
  shared.frameMiss = clips->missed;
  shared.notes = whole->warnings;
  if (const auto idle = idleNames(*whole, match); !idle.empty())
    shared.notes.push_back(fmt::format("{}: {} of {} names drive no target of the face: {}.",
                                       a.clip, idle.size(), whole->names.size(), firstOf(idle)));
  std::ranges::move(notesOnClip(*whole, match, clips->missed, targets, a.clip),
                    std::back_inserter(shared.notes));
  if (!read->isAuthored && !match.undriven.empty())
    shared.notes.push_back(fmt::format("{}: nothing drives {} of {} targets: {}.", a.clip,
                                       match.undriven.size(), targets.size(),
                                       firstOf(match.undriven)));
  const ClipAngles angles(*whole);
  shared.hasHead = angles.head(), shared.turnsHead = angles.turnsHead();
  shared.hasEyes = angles.eyes();
  if (shared.hasHead || shared.hasEyes)
    shared.pose = [whole, angles](double time) { return angles.at(*whole, time); };
  std::vector<Performance> performances(regions.size(), shared);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    Performance& performance = performances[r];
    const auto clip = std::make_shared<const Clip>(std::move(clips->ofRegions[r]));
    performance.seconds = clip->seconds();
    for (const double time : clip->times)
      performance.frameTimes.push_back(time - clip->times.front());
    performance.at = [clip, match](double time, std::span<double> weights) {
      match.spread(*clip, time, weights);
    };
    performance.kinematicsAt = byDifferences(performance.at, performance.seconds);
  }
  return performances;
}

}  // namespace sweepface::cli
