#pragma once

#include <span>

#include "sweepface/rig.hpp"

#include "codec/hierarchy.hpp"
#include "codec/steps.hpp"

namespace sweepface::codec {

/// What moves in coefficients.
Sparse movedIn(const Coefficients& coefficients);

/// What a file can hold of a pose: whole multiples of a step for every stored vector, smaller for
/// those that move the surface further, beyond what the hierarchy predicts.
class Lattice {
 public:
  Lattice(const Surface& surface, const Packing& packing)
      : Lattice(surface, packing,
                spreadMirror(surface.wireframe(), surface.connectivity(), packing.mirror)) {}
  /// With what the packing's pairs spread to.
  Lattice(const Surface& surface, const Packing& packing, const Mirror& mirror)
      : hierarchy_(surface, mirror), mirrors_(mirrorsOf(hierarchy_)), axis_(packing.axis) {}

  const Hierarchy& hierarchy() const { return hierarchy_; }
  int axis() const { return axis_; }

  /// From here on targets are predicted by where the neutral's stored vectors [S] are.
  void learn(const Surface& surface, std::span<const Vec3> neutral, double step);
  /// What predicts the vectors of a pose, 0 the neutral.
  const Prediction& prediction(Index pose) const {
    return pose == 0 || moves_.steps.empty() ? hierarchy_.prediction() : moves_;
  }

  /// The nearest multiples, each beyond the prediction from the nearest ones before it.
  Coefficients round(Index pose, std::span<const Vec3> vectors, double step) const {
    return round(pose, vectors, step, Coefficients(vectors.size()),
                 std::vector<char>(vectors.size(), 1));
  }
  /// The same for those [S] that are free, given the others.
  Coefficients round(Index pose, std::span<const Vec3> vectors, double step, Coefficients given,
                     std::span<const char> isFree) const;
  /// The vectors of coefficients [S]; false if one is too large.
  bool restore(Index pose, const Coefficients& coefficients, double step,
               std::span<Vec3> vectors) const;
  /// The same of several poses, all of them targets or the neutral alone.
  struct Restored {
    const Sparse& moved;
    double step;
    std::span<Vec3> vectors;
  };
  bool restore(const Prediction& prediction, std::span<const Restored> poses) const;

  /// The coefficients of the mirror image; zero for vectors that have none.
  Coefficients image(const Coefficients& coefficients) const;

  /// What moves, or its mirror image in the same order, in steps 2^finer times smaller.
  Sparse moved(const Sparse& moved, bool mirrored, int finer) const;
  Sparse moved(const Coefficients& coefficients, bool mirrored, int finer) const {
    return moved(movedIn(coefficients), mirrored, finer);
  }

 private:
  // The vector that each one is the image of [S], or -1: no two have the same.
  static std::vector<Index> mirrorsOf(const Hierarchy& hierarchy);

  Hierarchy hierarchy_;
  std::vector<Index> mirrors_;
  Prediction moves_;  // of targets, once the neutral is known
  int axis_;
};

/// The step of a pose, 0 the neutral.
inline double stepOf(const Packing& packing, Index pose) {
  const int finer = pose < static_cast<Index>(packing.poses.size()) ? packing.poses[pose].finer : 0;
  return std::ldexp(pose == 0 ? packing.neutralStep : packing.targetStep, -finer);
}

inline Symmetry symmetryOf(const Packing::Pose& form, Index pose) {
  return form.image < 0 ? Symmetry::none : form.image == pose ? Symmetry::self : Symmetry::partner;
}

/// The image that a pose is compared with, in its own steps; nothing but for Symmetry::partner.
/// Poses are Coefficients or Sparse.
template <typename Steps>
Sparse partnerOf(const Packing& packing, const Lattice& lattice, const std::vector<Steps>& poses,
                 Index pose) {
  const Packing::Pose& form = packing.poses[pose];
  if (symmetryOf(form, pose) != Symmetry::partner) return {};
  return lattice.moved(poses[form.image], true, form.finer - packing.poses[form.image].finer);
}

inline constexpr int kMostFiner = 40;

/// A rig's packing as a file can hold it, with a form for every pose.
Packing sound(const Rig& rig);

}  // namespace sweepface::codec
