#pragma once

#include <span>

#include "sweepface/rig.hpp"

#include "codec/hierarchy.hpp"
#include "codec/steps.hpp"

namespace sweepface::codec {

/// The coefficients that are not zero.
Sparse movedIn(const Coefficients& coefficients);

/// Quantises poses to what a file can hold: for every stored vector, whole multiples of a step
/// beyond what the hierarchy predicts. The step is smaller for vectors that move the surface
/// further.
class Lattice {
 public:
  Lattice(const Surface& surface, const Packing& packing)
      : Lattice(surface, packing,
                spreadMirror(surface.wireframe(), surface.connectivity(), packing.mirror)) {}
  /// With the mirror that the packing's pairs spread to.
  Lattice(const Surface& surface, const Packing& packing, const Mirror& mirror)
      : hierarchy_(surface, mirror), mirrors_(mirrorsOf(hierarchy_)), axis_(packing.axis) {}

  const Hierarchy& hierarchy() const { return hierarchy_; }
  int axis() const { return axis_; }

  /// From here on the prediction of targets takes its weights from the positions and normals of the
  /// neutral with these stored vectors [S]. Does nothing if `step` is 0.
  void learn(const Surface& surface, std::span<const Vec3> neutral, double step);
  /// The prediction for a pose, 0 being the neutral.
  const Prediction& prediction(Index pose) const {
    return pose == 0 || moves_.steps.empty() ? hierarchy_.prediction() : moves_;
  }

  /// The nearest multiples, each relative to the prediction from the rounded vectors before it.
  Coefficients round(Index pose, std::span<const Vec3> vectors, double step) const {
    return round(pose, vectors, step, Coefficients(vectors.size()),
                 std::vector<char>(vectors.size(), 1));
  }
  /// The same for the vectors [S] that are free, with all others given.
  Coefficients round(Index pose, std::span<const Vec3> vectors, double step, Coefficients given,
                     std::span<const char> isFree) const;
  /// Computes vectors from coefficients [S]; false if a vector is too large.
  bool restore(Index pose, const Coefficients& coefficients, double step,
               std::span<Vec3> vectors) const;
  /// The same for several poses: either targets only or the neutral alone.
  struct Restored {
    const Sparse& moved;
    double step;
    std::span<Vec3> vectors;
  };
  bool restore(const Prediction& prediction, std::span<const Restored> poses) const;

  /// The coefficients of the mirror image; zero for vectors without an image.
  Coefficients image(const Coefficients& coefficients) const;

  /// The moved vectors, or their mirror images in the same order, in steps 2^finer times smaller.
  Sparse moved(const Sparse& moved, bool mirrored, int finer) const;
  Sparse moved(const Coefficients& coefficients, bool mirrored, int finer) const {
    return moved(movedIn(coefficients), mirrored, finer);
  }

 private:
  // [S] the vector whose image each vector is, or -1. No two vectors share an image.
  static std::vector<Index> mirrorsOf(const Hierarchy& hierarchy);

  Hierarchy hierarchy_;
  std::vector<Index> mirrors_;
  Prediction moves_;  // prediction of targets, once the neutral is known
  int axis_;
};

/// The step of a pose, 0 being the neutral.
inline double stepOf(const Packing& packing, Index pose) {
  const int finer = pose < static_cast<Index>(packing.poses.size()) ? packing.poses[pose].finer : 0;
  return std::ldexp(pose == 0 ? packing.neutralStep : packing.targetStep, -finer);
}

inline Symmetry symmetryOf(const Packing::Pose& form, Index pose) {
  return form.image < 0 ? Symmetry::none : form.image == pose ? Symmetry::self : Symmetry::partner;
}

/// The image that a pose is compared with, converted to the pose's own steps; empty except for
/// Symmetry::partner. Poses are Coefficients or Sparse.
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
