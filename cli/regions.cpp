#include "regions.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "sweepface/io.hpp"
#include "sweepface/region_file.hpp"
#include "sweepface/regional_clips.hpp"

#include "clip_part.hpp"

namespace sweepface::cli {
namespace {

/// The regions of --regions, or else of the timeline played; without either, the whole face.
Result<std::vector<Region>> readRegions(const PerformanceArguments& what, const std::string& clip,
                                        const std::string& regionFile, const Rig& rig) {
  const bool own = regionFile.empty() && isOfKind(what.clip, ".json");
  const std::string& file = own ? what.clip : regionFile;
  if (file.empty()) return dividedFace(rig, {});
  const Result<std::string> text = file == what.clip ? clip : readFile(utf8Path(file));
  if (!text) return std::unexpected(text.error());
  const auto painted = parseRegions(*text, file);
  if (!painted) return std::unexpected(painted.error());
  if (painted->empty() && !own)
    return fail(fmt::format("{} has no regions; see docs/regions.md.", file));
  auto regions = paintRegions(rig, *painted);
  if (!regions) return fail(fmt::format("{}: {}", file, regions.error().message));
  return regions;
}

/// Notes that --regions replaces the regions of the timeline.
std::vector<std::string> notesOnOwn(const PerformanceArguments& what, const std::string& clip,
                                    const std::string& regionFile) {
  if (regionFile.empty() || regionFile == what.clip || !isOfKind(what.clip, ".json")) return {};
  const auto own = parseRegions(clip, what.clip);
  if (!own || own->empty()) return {};
  return {fmt::format("{}: its own regions are not used, but those of {}.", what.clip, regionFile)};
}

/// The motion of all regions: a performance each, of K weights.
struct Parts {
  std::vector<Performance> performances;  // [R]
  std::size_t count = 0;                  // K

  void at(double time, std::span<double> weights) const {
    for (std::size_t r = 0; r < performances.size(); ++r)
      performances[r].at(time, weights.subspan(r * count, count));
  }

  /// The targets whose weights differ between regions at some time.
  std::vector<Index> uneven(std::vector<double> times) const {
    constexpr int kLooks = 240;
    for (int k = 0; k <= kLooks; ++k) times.push_back(seconds() * k / kLooks);
    std::vector<bool> differs(count, false);
    std::vector<double> weights(count * performances.size());
    for (const double time : times) {
      at(time, weights);
      for (std::size_t k = count; k < weights.size(); ++k)
        if (weights[k] != weights[k % count]) differs[k % count] = true;
    }
    std::vector<Index> targets;
    for (std::size_t k = 0; k < count; ++k)
      if (differs[k]) targets.push_back(static_cast<Index>(k));
    return targets;
  }

  double seconds() const {
    return std::ranges::max_element(performances, {}, &Performance::seconds)->seconds;
  }
  /// The frame times of all regions.
  std::vector<double> frameTimes() const {
    std::vector<double> times;
    for (const Performance& p : performances)
      times.insert(times.end(), p.frameTimes.begin(), p.frameTimes.end());
    mergeTimes(times);
    return times;
  }
};

Performance together(Parts parts, const std::vector<Region>& regions, Rig& rig) {
  Performance whole = parts.performances.front();
  parts.count = rig.targets.size();
  whole.seconds = parts.seconds();
  whole.frameTimes = parts.frameTimes();
  const auto targets = RegionalTargets::addTo(rig, regions, parts.uneven(whole.frameTimes));
  whole.motion.reset();  // keys could not hold it exactly
  whole.isDivided = true;
  whole.wholes = targets.wholes();
  const auto shared = std::make_shared<const Parts>(std::move(parts));
  whole.at = [shared, targets](double time, std::span<double> weights) {
    std::vector<double> ofRegions(shared->count * shared->performances.size());
    shared->at(time, ofRegions);
    targets.spread(ofRegions, weights);
  };
  whole.kinematicsAt = byDifferences(whole.at, whole.seconds);
  return whole;
}

/// For a law, the expressions at both ends; none for a clip, which may drive anything.
std::vector<Weights> toldWeights(const PerformanceArguments& what, const Rig& rig) {
  std::vector<Weights> told;
  if (!what.clip.empty()) return told;
  for (const auto& [option, text] :
       {std::pair("--from", what.from), std::pair("--to", what.to.value_or(""))})
    if (auto weights = weightsGiven(option, text, rig)) told.push_back(std::move(*weights));
  return told;
}

Result<std::vector<Region>> regionsOf(const PerformanceArguments& what, const std::string& clip,
                                      const std::string& regionFile, const Rig& rig) {
  auto regions = readRegions(what, clip, regionFile, rig);
  if (!regions) return regions;
  const auto isHeavy = [](const Region& region) { return region.matter.mass > 1; };
  if (!what.clip.empty() && what.tellsSpring && std::ranges::none_of(*regions, isHeavy))
    return fail(
        fmt::format("No region is heavier than the rest, so that nothing of {} hangs on springs; "
                    "leave --frequency and --damping out.",
                    what.clip));
  return regions;
}

}  // namespace

void addRegions(CLI::App& app, std::string& file) {
  app.add_option("--regions", file,
                 "A .json with 'regions': parts of the face that are heavier, stiffer or later "
                 "than the rest; a timeline may have its own")
      ->check(notEmpty())
      ->type_name("FILE");
}

Result<Performance> perform(const PerformanceArguments& what, const std::string& regionFile,
                            const FollowingArguments& following, Rig& rig) {
  // Read once, as it may be a pipe.
  const Result<std::string> clip =
      what.clip.empty() ? std::string() : readFile(utf8Path(what.clip));
  if (!clip) return std::unexpected(clip.error());
  auto regions = regionsOf(what, *clip, regionFile, rig);
  if (!regions) return std::unexpected(regions.error());
  // In combinations, even a target that moves nothing by itself may show.
  std::vector<std::string> still;
  if (what.clip.empty() && !following.combine) still = notesOnStill(what, rig);
  auto performances = makePerformances(what, *clip, rig, *regions);
  if (!performances) return std::unexpected(performances.error());
  Parts parts{std::move(*performances)};
  const Result<Following> followed = follow(following, rig, toldWeights(what, rig));
  if (!followed) return std::unexpected(followed.error());
  followed->eyes.keepWhole(rig.surface, *regions);
  for (Performance& performance : parts.performances)
    performance = withFollowing(std::move(performance), *followed);
  Performance whole = parts.performances.size() == 1 ? std::move(parts.performances.front())
                                                     : together(std::move(parts), *regions, rig);
  std::ranges::move(still, std::back_inserter(whole.notes));
  std::ranges::move(notesOnOwn(what, *clip, regionFile), std::back_inserter(whole.notes));
  return partOf(std::move(whole), what);
}

}  // namespace sweepface::cli
