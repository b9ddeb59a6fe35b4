// The part of the C interface that reads other programs' files (sweepface_clips.h), and the only
// part that links the conversion code.
#include <algorithm>

#include "sweepface/filter.hpp"
#include "sweepface/gltf.hpp"
#include "sweepface/region_file.hpp"
#include "sweepface/regional_clips.hpp"
#include "sweepface/sweepface_clips.h"

#include "capi/handles.hpp"
#include "capi/message.hpp"
#include "io/json_text.hpp"
#include "io/text.hpp"

using namespace sweepface;
using namespace sweepface::capi;

struct sweepface_clip {
  RegionalClips clips;
  ClipMatch match;
  ClipAngles angles;
  std::size_t targets;
};

namespace {

// ---- Regions ----

/// [R]
std::vector<Matter> mattersOf(const Division& division) {
  std::vector<Matter> matters = division.matters;
  matters.resize(division.count());
  return matters;
}

/// Whether a text without regions is meant to have none: a timeline, or an empty object.
bool meansNone(std::string_view text) {
  const auto json = io::parseJson(text, "");
  return json && json->is_object() &&
         (json->empty() || json->contains("regions") || json->contains("events"));
}

// ---- Clips ----

enum class Kind { csv, capture, timeline, gltf };

Kind kindOf(std::string_view bytes) {
  if (bytes.starts_with("glTF")) return Kind::gltf;
  const std::string_view text = io::trimmed(io::withoutMark(bytes));
  if (!text.starts_with('{') && !text.starts_with('[')) return Kind::csv;
  return isTimeline(text) ? Kind::timeline : Kind::capture;
}

Result<Clip> readCapture(Kind kind, std::string_view bytes, const char* name,
                         const sweepface_clip_options& options) {
  const std::string_view animation = options.animation ? options.animation : "";
  auto clip = kind == Kind::gltf      ? parseGltfClip(bytes, name, {}, animation)
              : kind == Kind::capture ? parseClipJson(bytes, name, options.frames_per_second)
                                      : parseLiveLinkCsv(bytes, name, options.frames_per_second);
  if (clip && options.smooth) smooth(*clip);
  return clip;
}

Result<Clip> withNames(Clip clip, const char* names, const std::vector<std::string>& targets) {
  if (!names) return clip;
  const auto map = parseNameMap(names, "The text of names");
  if (!map) return std::unexpected(map.error());
  return renamed(std::move(clip), *map, targets);
}

Result<RegionalClips> readForRegions(const Division& division,
                                     const std::vector<std::string>& targets,
                                     std::string_view bytes, const char* name,
                                     const sweepface_clip_options& options) {
  const std::vector<Matter> matters = mattersOf(division);
  const auto named = [name](Result<RegionalClips> clips) -> Result<RegionalClips> {
    if (!clips) return fail(name, ": ", clips.error().message);
    return clips;
  };
  const Kind kind = kindOf(bytes);
  if (kind != Kind::timeline) {
    auto capture = readCapture(kind, bytes, name, options);
    if (capture) capture = withNames(std::move(*capture), options.names, targets);
    if (!capture) return std::unexpected(capture.error());
    return named(inRegions(std::move(*capture), matters, {options.frequency, options.damping}));
  }
  const auto timeline = parseTimeline(bytes, name);
  if (!timeline) return std::unexpected(timeline.error());
  if (!division.names.empty()) return named(inRegions(*timeline, division.names, matters));
  const auto own = parseRegions(bytes, name);
  if (!own) return std::unexpected(own.error());
  auto clips = named(inRegions(*timeline, std::vector<std::string>{"rest"}, matters));
  if (clips && !own->empty())
    clips->whole.warnings.push_back(
        std::string(name) + ": its regions count only if the face is divided by them first.");
  return clips;
}

const char* nameAt(const std::vector<std::string>& names, uint32_t index) {
  return index < names.size() ? names[index].c_str() : nullptr;
}

sweepface_angles anglesOf(const Angles& a) { return {a.yaw, a.pitch, a.roll}; }

}  // namespace

sweepface_status sweepface_rig_divide_by(sweepface_rig* rig, const void* text, size_t size,
                                         const char* name) {
  if (!rig || (!text && size > 0)) return refuse("Dividing a face needs a rig and a text.");
  const char* const called = calledOr(name, "The text");
  const std::string_view given{static_cast<const char*>(text), size};
  const auto painted = parseRegions(given, called);
  if (!painted) return refuse(SWEEPFACE_BAD_DATA, painted.error().message);
  if (painted->empty() && !meansNone(given))
    return refuse(SWEEPFACE_BAD_DATA,
                  std::string(called) + " has no 'regions'; see docs/regions.md.");
  if (painted->empty()) return sweepface_rig_divide(rig, nullptr, nullptr, 0);
  const auto regions = paintRegions(*rig->rig, *painted);
  if (!regions) return refuse(called, ": ", regions.error().message);
  divide(*rig, divisionOf(*rig->rig, *regions));
  return SWEEPFACE_OK;
}

sweepface_status sweepface_rig_region_matter(const sweepface_rig* rig, uint32_t region,
                                             sweepface_matter* matter) {
  if (!rig || !matter) return refuse("A region's matter needs a rig and a place for it.");
  if (region >= rig->division->count()) return noSuch("region", region, rig->division->count());
  const Matter found = mattersOf(*rig->division)[region];
  *matter = {found.mass, found.stiffness, found.delay};
  return SWEEPFACE_OK;
}

sweepface_clip_options sweepface_clip_usual_options(void) {
  const Spring hold;
  return {0, 0, hold.frequency, hold.damping, nullptr, nullptr};
}

sweepface_status sweepface_clip_read(const sweepface_rig* rig, const void* bytes, size_t size,
                                     const char* name, const sweepface_clip_options* options,
                                     sweepface_clip** clip) {
  if (!rig || !clip || (!bytes && size > 0))
    return refuse("Reading a clip needs a rig, bytes and a place for it.");
  const char* const called = calledOr(name, "The clip");
  const auto usual = sweepface_clip_usual_options();
  auto asked = options ? *options : usual;
  if (asked.frequency == 0 && asked.damping == 0)
    asked.frequency = usual.frequency, asked.damping = usual.damping;
  if (const auto hold = Trajectory::spring({}, 0, {asked.frequency, asked.damping}); !hold)
    return refuse("The spring on which heavy regions hang: ", hold.error().message);
  if (auto ok = io::checkFrameRateIfGiven(asked.frames_per_second); !ok)
    return refuse(ok.error().message);
  const std::vector<std::string> targets = shownNames(*rig);
  auto clips = readForRegions(*rig->division, targets, {static_cast<const char*>(bytes), size},
                              called, asked);
  if (!clips) return refuse(SWEEPFACE_BAD_DATA, clips.error().message);
  Clip& whole = clips->whole;
  ClipMatch match = matchClip(whole, targets);
  if (!movesAnything(whole, match))
    return refuse(SWEEPFACE_BAD_DATA, std::string(called) + ": none of its " +
                                          std::to_string(whole.names.size()) +
                                          " names is a target of the face.");
  std::ranges::move(notesOnClip(whole, match, clips->missed, targets, called),
                    std::back_inserter(whole.warnings));
  std::erase_if(match.unmatched, ClipAngles::tells);
  const ClipAngles angles(whole);
  *clip = new sweepface_clip{std::move(*clips), std::move(match), angles, rig->shown};
  return SWEEPFACE_OK;
}

void sweepface_clip_free(sweepface_clip* clip) { delete clip; }

double sweepface_clip_seconds(const sweepface_clip* clip) {
  return clip ? clip->clips.seconds() : 0;
}

const char* sweepface_clip_unmatched(const sweepface_clip* clip, uint32_t index) {
  return clip ? nameAt(clip->match.unmatched, index) : nullptr;
}

const char* sweepface_clip_undriven(const sweepface_clip* clip, uint32_t index) {
  return clip ? nameAt(clip->match.undriven, index) : nullptr;
}

const char* sweepface_clip_warning(const sweepface_clip* clip, uint32_t index) {
  return clip ? nameAt(clip->clips.whole.warnings, index) : nullptr;
}

uint32_t sweepface_clip_region_count(const sweepface_clip* clip) {
  return clip ? static_cast<uint32_t>(clip->clips.ofRegions.size()) : 0;
}

sweepface_status sweepface_clip_weights(const sweepface_clip* clip, double seconds, double* out,
                                        size_t count) {
  if (!clip || (!out && count > 0)) return refuse("Reading a clip needs one and a place.");
  const std::vector<Clip>& ofRegions = clip->clips.ofRegions;
  const std::size_t all = ofRegions.size() * clip->targets;
  if (count > all) return refuse("The clip has only ", all, " weights, not ", count, ".");
  for (std::size_t r = 0, first = 0; first < count; ++r, first += clip->targets)
    clip->match.spread(ofRegions[r], seconds,
                       {out + first, std::min(clip->targets, count - first)});
  return SWEEPFACE_OK;
}

int32_t sweepface_clip_has_head(const sweepface_clip* clip) { return clip && clip->angles.head(); }
int32_t sweepface_clip_has_eyes(const sweepface_clip* clip) { return clip && clip->angles.eyes(); }

sweepface_status sweepface_clip_pose(const sweepface_clip* clip, double seconds,
                                     sweepface_pose* pose) {
  if (!clip || !pose) return refuse("A pose needs a clip and a place for it.");
  const HeadPose found = clip->angles.at(clip->clips.whole, seconds);
  *pose = {anglesOf(found.head), anglesOf(found.leftEye), anglesOf(found.rightEye)};
  return SWEEPFACE_OK;
}
