#include <algorithm>
#include <array>

#include "sweepface/arcs.hpp"
#include "sweepface/box.hpp"
#include "sweepface/clip.hpp"
#include "sweepface/codec.hpp"

#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

sweepface_status capi::needTargets(const Rig& rig) {
  // All targets are loaded at once, so it is enough to check the first; many calls ask.
  if (rig.targets.empty() || rig.knows(rig.targets.front())) return SWEEPFACE_OK;
  return refuse("What the targets do was not loaded; call sweepface_rig_load_targets first.");
}

namespace {

sweepface_status loadNeutral(const void* bytes, size_t size, const char* name,
                             const DecodeLimits& limits, sweepface_rig** rig) {
  if (!rig || (!bytes && size > 0)) return refuse("Loading a rig needs bytes and a place for it.");
  auto decoded =
      decodeNeutral({static_cast<const char*>(bytes), size}, calledOr(name, "The face"), limits);
  if (!decoded) return refuse(SWEEPFACE_BAD_DATA, decoded.error().message);
  const std::size_t targets = decoded->rig.targets.size();
  // Reserves a target for the arcs of each, and those that turn two eyes, so that adding them does
  // not move names.
  decoded->rig.targets.reserve(2 * targets + 2 * EyeTurns::kTargets);
  *rig =
      new sweepface_rig{std::make_shared<Rig>(std::move(decoded->rig)), std::move(decoded->targets),
                        targets, std::make_shared<const Division>()};
  return SWEEPFACE_OK;
}

}  // namespace

sweepface_status sweepface_rig_load_neutral(const void* bytes, size_t size, const char* name,
                                            sweepface_rig** rig) {
  return loadNeutral(bytes, size, name, {}, rig);
}

sweepface_status sweepface_rig_load_targets(sweepface_rig* rig) {
  if (!rig) return refuse("Loading targets needs a rig.");
  const Result<void> decoded = rig->toCome.decode(*rig->rig);
  return decoded ? SWEEPFACE_OK : refuse(SWEEPFACE_BAD_DATA, decoded.error().message);
}

sweepface_status sweepface_rig_load(const void* bytes, size_t size, const char* name,
                                    sweepface_rig** rig) {
  return sweepface_rig_load_within(bytes, size, name, DecodeLimits{}.memory, rig);
}

sweepface_status sweepface_rig_load_within(const void* bytes, size_t size, const char* name,
                                           size_t memory, sweepface_rig** rig) {
  sweepface_rig* made = nullptr;
  if (const auto status = loadNeutral(bytes, size, name, {memory}, rig ? &made : nullptr))
    return status;
  if (const auto status = sweepface_rig_load_targets(made)) {
    sweepface_rig_free(made);
    return status;
  }
  *rig = made;
  return SWEEPFACE_OK;
}

void sweepface_rig_free(sweepface_rig* rig) { delete rig; }

uint32_t sweepface_rig_target_count(const sweepface_rig* rig) {
  return rig ? static_cast<uint32_t>(rig->shown) : 0;
}

const char* sweepface_rig_target_name(const sweepface_rig* rig, uint32_t target) {
  if (target >= sweepface_rig_target_count(rig)) return nullptr;
  return rig->rig->targets[target].name.c_str();
}

sweepface_status sweepface_rig_find_target(const sweepface_rig* rig, const char* name,
                                           uint32_t* target) {
  if (!rig || !name || !target) return refuse("Finding a target needs a rig, a name and a place.");
  const Result<Index> found = findTarget(*rig->rig, name, rig->shown);
  if (!found) return refuse(found.error().message);
  *target = static_cast<uint32_t>(*found);
  return SWEEPFACE_OK;
}

uint32_t sweepface_rig_match_targets(const sweepface_rig* rig, const char* name, uint32_t* targets,
                                     uint32_t room) {
  if (!rig || !name) return 0;
  Clip clip;
  clip.names = {name};
  const std::vector<Index> driven = matchClip(clip, shownNames(*rig)).targets.front();
  const auto count = static_cast<uint32_t>(driven.size());
  if (targets) std::copy_n(driven.begin(), std::min(room, count), targets);
  return count;
}

uint32_t sweepface_rig_turn_count(const sweepface_rig* rig) {
  return rig ? static_cast<uint32_t>(rig->rig->turns.size()) : 0;
}

sweepface_status sweepface_rig_follow(sweepface_rig* rig, uint32_t what) {
  if (!rig) return refuse("Following weights need a rig.");
  if ((what & ~uint32_t{SWEEPFACE_ARCS | SWEEPFACE_COMBINE}) != 0)
    return refuse("Weights follow by SWEEPFACE_ARCS, SWEEPFACE_COMBINE or both.");
  if (rig->rig.use_count() > 1)
    return refuse(
        "What follows must be said before a rig has meshes; free its meshes and faces, or load it "
        "again.");
  if (const auto status = needTargets(*rig->rig)) return status;
  if (rig->following.eyes)
    return refuse("What follows must be said before eyes turn; load the rig again.");
  constexpr std::size_t kMostShown = 4096;  // the time that names take grows with their square
  if (what && rig->shown > kMostShown)
    return refuse("Weights follow in faces of up to ", kMostShown, " targets, not of ", rig->shown,
                  ".");
  Rig& made = *rig->rig;
  made.targets.resize(rig->shown);
  std::vector<Follower> followers;
  if (what & SWEEPFACE_COMBINE) followers = Followers::named(shownNames(*rig));
  if (what & SWEEPFACE_ARCS) {
    const std::vector<Follower> arcs = addArcs(made, made.turns);
    followers.insert(followers.end(), arcs.begin(), arcs.end());
  }
  rig->following = {};
  if (!followers.empty()) {
    rig->following.followers = std::make_shared<const Followers>(std::move(followers));
    rig->following.apply = followAll;
  }
  return SWEEPFACE_OK;
}

void sweepface_rig_box(const sweepface_rig* rig, double low[3], double high[3]) {
  if (!low || !high) return;
  Box box;
  if (rig && static_cast<double>(rig->rig->surface.wireframe().quadCount()) <= kMostVertices) {
    box = Box(Tessellation(rig->rig->surface, 1).positions(blend(*rig->rig, {})));
    for (const Vec3& loose : rig->rig->source.loose) box.include(loose);
  }
  if (box.isEmpty()) box = Box(std::array{Vec3{}});
  std::ranges::copy(std::array{box.low.x, box.low.y, box.low.z}, low);
  std::ranges::copy(std::array{box.high.x, box.high.y, box.high.z}, high);
}

double sweepface_rig_tolerance(const sweepface_rig* rig) { return rig ? rig->rig->tolerance : 0; }
