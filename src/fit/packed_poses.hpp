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

/// The poses of a rig while they are packed: what coefficients say of each, and how far that is
/// from the fit and from the source. The neutral comes first; targets are told beyond it.
class PackedPoses {
 public:
  /// Tangents shall lean by about `angle` degrees. The lattice is that of the rig's packing; the
  /// source tells where faces fold.
  PackedPoses(Rig& rig, const MeshRig& source, PackGoals goals, codec::Lattice lattice,
              double tolerance, double angle);

  Index count() const { return static_cast<Index>(kept_.size()); }
  Index vertexCount() const { return grid_.vertexCount(); }
  double tolerance() const { return tolerance_; }
  const codec::Lattice& lattice() const { return lattice_; }
  const Columns& columns() const { return columns_; }
  /// Whether a source vertex stands at one of level 1.
  bool isKnown(Index vertex) const { return goals_.isKnown[vertex] != 0; }

  Packing::Pose& form(Index pose) { return rig_.packing.poses[pose]; }
  double step(Index pose) const { return codec::stepOf(rig_.packing, pose); }
  /// What the image of a pose predicts [S], for Symmetry::partner.
  codec::Coefficients expected(Index pose) const;

  /// The stored vectors [S] of the fit, until the pose is kept; of targets their differences.
  const std::vector<Vec3>& fitted(Index pose) const { return rig_.vectorsOf(pose); }
  /// What brings a target to where the fit has it, the neutral being off.
  std::vector<Vec3> compensated(Index pose) const;

  codec::Coefficients rounded(Index pose, const std::vector<Vec3>& vectors) const;
  /// The same for those [S] that are free, given the others.
  codec::Coefficients rounded(Index pose, const std::vector<Vec3>& vectors,
                              codec::Coefficients given, std::span<const char> isFree) const;
  std::vector<Vec3> restored(Index pose, const codec::Coefficients& q) const;

  /// How far off the source a pose with these vectors is [vertices]; nothing where that is not
  /// known.
  std::vector<Vec3> errors(Index pose, std::vector<Vec3> vectors) const;
  /// How far its tangents are off the fit's.
  Slopes slopes(Index pose, const std::vector<Vec3>& vectors) const;
  /// The quads that fold then; in order, each as often as sixteenths of it do.
  std::vector<Index> folds(Index pose, std::vector<Vec3> vectors) const;
  const std::vector<Index>& neutralFolds() const { return neutralFolds_; }
  /// The vertices of quads, and the stored vectors that the surface around vertices is made of.
  std::vector<Index> corners(std::span<const Index> quads) const;
  std::set<Index> behind(std::span<const Index> vertices) const;

  /// Puts what coefficients say into the rig. Poses may be kept at the same time.
  void keep(Index pose, codec::Coefficients q);
  /// From here on targets are predicted by the neutral that is kept, and bones carry them.
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
  std::vector<Vec3> neutralOff_;     // settled: how far the neutral is off the fit
  std::vector<Index> neutralFolds_;  // quads, in order
};

}  // namespace sweepface
