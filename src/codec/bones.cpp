#include "codec/bones.hpp"

#include <array>
#include <cmath>

#include "sweepface/box.hpp"

#include "codec/limits.hpp"

namespace sweepface::codec {

namespace {

// As a fraction of the targets' step.
constexpr double kBoneUnit = 1.0 / 16;

}  // namespace

void makeBonesSound(Packing& packing, std::size_t vectors) {
  if (packing.bones.size() != vectors) packing.bones.clear();
  Index count = 0;
  for (Index& bone : packing.bones) {
    if (bone < 0 || bone >= kMostBones) bone = -1;
    count = std::max(count, bone + 1);
  }
  if (count == 0) packing.bones.clear();
  if (!packing.poses.empty()) packing.poses.front().carries.clear();  // the neutral carries nothing
  for (Packing::Pose& pose : packing.poses) {
    Index last = -1;
    std::erase_if(pose.carries, [&](Packing::Carry& carry) {
      for (auto& by : carry.by)
        for (std::int32_t& x : by) x = std::clamp(x, -kMostCarried, kMostCarried);
      const bool stays = carry.bone > last && carry.bone < count;
      if (stays) last = carry.bone;
      return !stays;
    });
  }
}

void levelOut(const Hierarchy& hierarchy, std::vector<Index>& bones) {
  if (bones.empty()) return;
  for (const CodedSite& site : hierarchy.sites())
    std::fill_n(bones.begin() + site.first, site.count, bones[site.first]);
}

Bones::Bones(const Surface& surface, const Packing& packing, std::span<const Vec3> neutral)
    : unit_(kBoneUnit * packing.targetStep) {
  std::array<Box, kMostBones> boxes{};
  for (Index v = 0; v < static_cast<Index>(packing.bones.size()); ++v) {
    const Index bone = packing.bones[v];
    if (bone < 0) continue;
    const StoredVector& s = surface.stored(v);
    const Vec3& p = neutral[v];
    places_.push_back({v, bone, s.isPosition(), p});
    if (places_.back().isPosition) boxes[bone].include(p);
  }
  for (Place& p : places_) {
    const Box& box = boxes[p.bone];
    const Vec3 across = box.size();
    const double size = std::max(across.x, std::max(across.y, across.z));
    if (p.isPosition) p.at -= box.centre();
    p.at = (size > 0 ? 2 / size : 0) * p.at;
  }
}

bool Bones::add(std::span<const Packing::Carry> carries, double sign,
                std::span<Vec3> vectors) const {
  if (carries.empty()) return true;
  std::array<const Packing::Carry*, kMostBones> carryOf{};
  for (const Packing::Carry& carry : carries) carryOf[carry.bone] = &carry;
  const double unit = sign * unit_;
  double scaled = 0;  // finite until a value is too large
  for (const auto& [vector, bone, isPosition, at] : places_) {
    if (carryOf[bone] == nullptr) continue;
    const auto& by = carryOf[bone]->by;
    const auto along = [&](int axis) {
      return unit * (at.x * by[1][axis] + at.y * by[2][axis] + at.z * by[3][axis] +
                     (isPosition ? by[0][axis] : 0));
    };
    Vec3& moved = vectors[vector];
    moved += {along(0), along(1), along(2)};
    scaled += kScaleToMost * moved.x + kScaleToMost * moved.y + kScaleToMost * moved.z;
  }
  return std::isfinite(scaled);
}

}  // namespace sweepface::codec
