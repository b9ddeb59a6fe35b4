#pragma once

#include <string>
#include <vector>

#include "sweepface/rig.hpp"

#include "codec/lattice.hpp"
#include "codec/likeness.hpp"
#include "codec/symbols.hpp"

// Small things that stand between the large ones, the same for reader and writer.
namespace sweepface::codec {

/// Tags beyond those of the wireframe.
enum RigTag : std::uint32_t {
  kMirrorAxis = 40,
  kMirrorCount = 41,
  kMirrorArc = 43,
  kLetter = 44,
  kFiner = 45,
  kHasImage = 47,
  kOwnImage = 48,
  kImageOf = 49,
  kHasLike = 51,
  kLikeBack = 52,
  kLikeMirrored = 54,
  kLikeNegated = 55
};

/// Bytes up to a zero, each by those before it.
template <typename Coder>
std::string codeName(Symbols<Coder>& symbols, std::string_view name) {
  std::vector<char> result;
  std::uint32_t past = 0;
  for (std::size_t k = 0; symbols.ok(); ++k) {
    const std::uint32_t letter = k < name.size() ? static_cast<unsigned char>(name[k]) : 0;
    std::uint32_t known = 1;
    for (int b = 8; b-- > 0;)
      known = known << 1 |
              symbols.bit(kLetter, known * 256 + (past & 255), past >> 8 & 0xffff, letter >> b & 1);
    if ((known & 255) == 0) break;
    result.push_back(static_cast<char>(known & 255));
    past = past << 8 | (known & 255);
    if (result.size() > 4096) symbols.refuse("a name is too long");
  }
  return {result.begin(), result.end()};
}

/// What a pose is like: the image that it is compared with, or else what is told.
template <typename Coder>
void codeLikeness(Symbols<Coder>& symbols, const Packing::Pose& form, Likeness& like, Index pose) {
  if (symmetryOf(form, pose) == Symmetry::partner) {
    like = {form.image, true, false};
    return;
  }
  if (pose < 2 || !symbols.bit(kHasLike, 0, 0, like.pose >= 0)) return;
  const std::uint32_t back = symbols.number(
      kLikeBack, 0, 0, static_cast<std::uint64_t>(std::max(0, pose - 1 - like.pose)));
  if (back > static_cast<std::uint32_t>(pose - 2)) return symbols.refuse("a pose is like none");
  like.pose = pose - 1 - static_cast<Index>(back);
  like.mirrored = symbols.bit(kLikeMirrored, 0, 0, like.mirrored);
  like.negated = symbols.bit(kLikeNegated, 0, 0, like.negated);
}

template <typename Coder>
void codePose(Symbols<Coder>& symbols, Packing::Pose& form, Index pose) {
  form.finer =
      static_cast<int>(symbols.number(kFiner, 0, 0, static_cast<std::uint64_t>(form.finer)));
  if (form.finer > kMostFiner) symbols.refuse("a step is too fine");
  if (!symbols.bit(kHasImage, 0, 0, form.image >= 0)) {
    form.image = -1;
  } else if (symbols.bit(kOwnImage, 0, 0, form.image == pose)) {
    form.image = pose;
  } else {  // most often the pose before
    const std::uint32_t back = symbols.number(
        kImageOf, 0, 0, static_cast<std::uint64_t>(std::max(0, pose - 1 - form.image)));
    if (pose < 2 || back > static_cast<std::uint32_t>(pose - 2)) {
      symbols.refuse("a pose is the image of none");
      form.image = -1;
      return;
    }
    form.image = pose - 1 - static_cast<Index>(back);
  }
}

}  // namespace sweepface::codec
