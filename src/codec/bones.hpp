#pragma once

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include "sweepface/rig.hpp"

#include "codec/hierarchy.hpp"
#include "codec/symbols.hpp"

namespace sweepface::codec {

inline constexpr Index kMostBones = 64;
inline constexpr std::int32_t kMostCarried = 1 << 26;

/// Drops or clamps whatever a file cannot hold of the bones and their carries, for a rig with
/// `vectors` stored vectors.
void makeBonesSound(Packing& packing, std::size_t vectors);

/// Attaches all vectors of a site to the bone of its position.
void levelOut(const Hierarchy& hierarchy, std::vector<Index>& bones);

/// Parts that some targets move as a whole, such as eyes, or teeth and lower gums with the jaw.
/// Each bone carries its vectors by an affine map, so a target codes only what it does beyond that.
/// This is linear blend skinning with weights of 0 and 1, used only within the file.
class Bones {
 public:
  Bones() = default;
  /// `neutral` [S] says where the vectors of each bone are.
  Bones(const Surface& surface, const Packing& packing, std::span<const Vec3> neutral);

  /// Adds the effect of the carries to vectors [S] of a pose, or subtracts it, by `sign`. False if
  /// a resulting vector is too large.
  bool add(std::span<const Packing::Carry> carries, double sign, std::span<Vec3> vectors) const;
  /// Vectors [S] of a pose less the effect of its carries.
  std::vector<Vec3> beyond(std::span<const Packing::Carry> carries,
                           std::vector<Vec3> vectors) const {
    add(carries, -1, vectors);
    return vectors;
  }

  /// A neutral vector relative to its bone's centre and size: what the affine maps are applied to.
  struct Place {
    Index vector = -1, bone = -1;
    bool isPosition = false;
    Vec3 at;
  };
  const std::vector<Place>& places() const { return places_; }
  double unit() const { return unit_; }

 private:
  std::vector<Place> places_;
  double unit_ = 0;
};

/// Tags beyond those of poses.
enum BoneTag : std::uint32_t {
  kBones = 57,
  kSameBone = 59,
  kBone = 60,
  kCarries = 62,
  kCarry = 63
};

/// Codes the bone that each site is attached to, most often that of the site that predicts it.
/// Returns the number of bones.
template <typename Coder>
Index codeBones(Symbols<Coder>& symbols, const Hierarchy& hierarchy, std::vector<Index>& bones) {
  Index count = 0;
  if constexpr (kWrites<Coder>)
    for (const Index b : bones) count = std::max(count, b + 1);
  count = static_cast<Index>(std::min<std::uint32_t>(
      symbols.number(kBones, 0, 0, static_cast<std::uint64_t>(count)), kMostBones + 1));
  if (count > kMostBones) symbols.refuse("there are too many bones");
  if (count == 0 || !symbols.ok()) return 0;
  const auto& sites = hierarchy.sites();
  bones.resize(hierarchy.prediction().steps.size(), -1);
  std::vector<char> followed(sites.size());
  Index before = -1;
  for (Index s = 0; s < static_cast<Index>(sites.size()) && symbols.ok(); ++s) {
    const CodedSite& site = sites[s];
    const auto beside = hierarchy.beside(s);
    const Index expected = beside.empty() ? before : bones[beside.front().vector];
    const std::uint32_t image = site.mirror >= 0 && site.mirror < s ? 1 + followed[site.mirror] : 0;
    std::int64_t bone = bones[site.first];
    const std::uint32_t kind = (beside.empty() ? 4 : site.parent < 0 ? 2 : 0) + (expected < 0);
    followed[s] = symbols.bit(kSameBone, image, kind, bone == expected);
    if (followed[s])
      bone = expected;
    else
      bone = std::int64_t{symbols.number(kBone, 0, 0, static_cast<std::uint64_t>(bone + 1))} - 1;
    if (bone < -1 || bone >= count) {
      symbols.refuse("there is no such bone");
      return 0;
    }
    before = static_cast<Index>(bone);
    std::fill_n(bones.begin() + site.first, site.count, before);
  }
  return count;
}

/// Returns the total number of bits in the carries' numbers.
template <typename Coder>
std::uint64_t codeCarries(Symbols<Coder>& symbols, Index bones,
                          std::vector<Packing::Carry>& carries) {
  std::size_t next = 0;
  std::uint64_t bits = 0;
  for (Index b = 0; b < bones && symbols.ok(); ++b) {
    const bool told = next < carries.size() && carries[next].bone == b;
    if (!symbols.bit(kCarries, static_cast<std::uint32_t>(b), 0, told)) continue;
    if constexpr (!kWrites<Coder>) carries.push_back({b, {}});
    auto& by = carries[next++].by;
    for (std::uint32_t k = 0; k < 4; ++k)
      for (std::int32_t& x : by[k]) {
        const std::int64_t steps = symbols.signedNumber(kCarry, k > 0, 0, x);
        if (std::abs(steps) > kMostCarried) symbols.refuse("a bone is carried too far");
        if (!symbols.ok()) return bits;
        x = static_cast<std::int32_t>(steps);
        bits += std::bit_width(static_cast<std::uint64_t>(std::abs(steps))) + 1;
      }
  }
  return bits;
}

}  // namespace sweepface::codec
