#pragma once

#include "sweepface/rig.hpp"

#include "codec/lattice.hpp"
#include "codec/likeness.hpp"
#include "codec/symbols.hpp"

// The small values coded for each pose before its coefficients, shared by reader and writer.
namespace sweepface::codec {

/// Tags beyond those of the wireframe.
enum RigTag : std::uint32_t {
  kFiner = 45,
  kHasImage = 47,
  kOwnImage = 48,
  kImageOf = 49,
  kHasLike = 51,
  kLikeBack = 52,
  kLikeMirrored = 54,
  kLikeNegated = 55
};

/// Codes what a pose is like: the image that it is compared with, which is implied, or else a coded
/// pose.
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
  const std::uint32_t finer = symbols.number(kFiner, 0, 0, static_cast<std::uint64_t>(form.finer));
  if (finer > kMostFiner) return symbols.refuse("a step is too fine");
  form.finer = static_cast<int>(finer);
  if (!symbols.bit(kHasImage, 0, 0, form.image >= 0)) {
    form.image = -1;
  } else if (symbols.bit(kOwnImage, 0, 0, form.image == pose)) {
    form.image = pose;
  } else {  // most often the previous pose
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
