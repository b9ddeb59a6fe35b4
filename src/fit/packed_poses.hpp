#pragma once

#include <set>
#include <span>
#include <vector>

#include "sweepface/mesh.hpp"

#include "codec/bones.hpp"
#include "codec/lattice.hpp"
#include "fit/columns.hpp"
#include "fit/folds.hpp"
#include "fit/pack_goals.hpp"
#include "fit/slopes.hpp"

namespace sweepface {

/// The poses of a rig while they are packed: the vectors that coefficients stand for, and how far
/// these are from the fit and from the source. The neutral comes first; targets are relative to it.
class PackedPoses {
 public:
  /// Tangents may lean by about `angle` degrees. `lattice` is that of the rig's packing;
  /// `source` is needed to find folds.
  PackedPoses(Rig& rig, const MeshRig& source, PackGoals goals, codec::Lattice lattice,
              double tolerance, double angle);

  Index count() const { return static_cast<Index>(kept_.size()); }
  Index vertexCount() const { return grid_.vertexCount(); }
  double tolerance() const { return tolerance_; }
  const codec::Lattice& lattice() const { return lattice_; }
  const Columns& columns() const { return columns_; }
  /// Whether a vertex of level 1 has a goal.
  bool isKnown(Index vertex) const { return goals_.isKnown[vertex] != 0; }

  Packing::Pose& form(Index pose) { return rig_.packing.poses[pose]; }
  double step(Index pose) const { return codec::stepOf(rig_.packing, pose); }
  /// What the image of a pose predicts [S], for Symmetry::partner.
  codec::Coefficients expected(Index pose) const;

  /// The stored vectors [S] of the fit, until the pose is kept; for targets, their differences.
  const std::vector<Vec3>& fitted(Index pose) const { return rig_.vectorsOf(pose); }
  /// The vectors that put a target where the fit has it, making up for the packed neutral's errors.
  std::vector<Vec3> compensated(Index pose) const;

  codec::Coefficients rounded(Index pose, const std::vector<Vec3>& vectors) const;
  /// The same for the vectors [S] that are free, given the others.
  codec::Coefficients rounded(Index pose, const std::vector<Vec3>& vectors,
                              codec::Coefficients given, std::span<const char> isFree) const;
  std::vector<Vec3> restored(Index pose, const codec::Coefficients& q) const;

  /// [vertices] How far a pose with these vectors is off its goals; zero where there is no goal.
  std::vector<Vec3> errors(Index pose, std::vector<Vec3> vectors) const;
  /// How far its tangents are off the fit's.
  Slopes slopes(Index pose, const std::vector<Vec3>& vectors) const;
  /// The quads that fold then, listed as by FoldFinder::quads.
  std::vector<Index> folds(Index pose, std::vector<Vec3> vectors) const;
  const std::vector<Index>& neutralFolds() const { return neutralFolds_; }
  /// The vertices of quads, and the stored vectors that the surface at vertices depends on.
  std::vector<Index> corners(std::span<const Index> quads) const;
  std::set<Index> behind(std::span<const Index> vertices) const;

  /// Puts the vectors that coefficients stand for into the rig. Poses may be kept concurrently.
  void keep(Index pose, codec::Coefficients q);
  /// Finds the bones. From then on they carry targets, and the kept neutral predicts them.
  void learnNeutral();

 private:
  std::vector<Vec3> settled(std::vector<Vec3> stored) const;
  std::span<const Packing::Carry> carries(Index pose) const {
    return rig_.packing.poses[pose].carries;
  }

  Rig& rig_;
  const MeshRig& source_;
  codec::Lattice lattice_;
  double tolerance_, angle_;
  Tessellation grid_;
  FoldFinder folds_;
  std::vector<std::vector<Term>> inStored_;  // every vector as a combination of stored ones
  Columns columns_;
  codec::Bones bones_;
  PackGoals goals_;
  std::vector<codec::Coefficients> kept_;  // [poses]
  std::vector<Vec3> fittedNeutral_, neutralErrors_;
  std::vector<Vec3> neutralOff_;     // settled: how far the kept neutral is off the fit
  std::vector<Index> neutralFolds_;  // quads, in order
};

}  // namespace sweepface
