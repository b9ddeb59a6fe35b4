#include "fit/packed_poses.hpp"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <utility>

#include "fit/bones.hpp"
#include "surface/terms.hpp"

namespace sweepface {

using codec::Coefficients;

namespace {

// The cost in bits of a tangent that leans by the angle aimed at. The neutral's errors are in every
// pose, those of a target only where it moves.
constexpr double kNeutralBits = 1.5, kTargetBits = 0.1;

void add(std::vector<Vec3>& sums, std::span<const Vec3> more) {
  for (std::size_t v = 0; v < sums.size(); ++v) sums[v] += more[v];
}
std::vector<Vec3> difference(std::vector<Vec3> a, std::span<const Vec3> b) {
  for (std::size_t v = 0; v < a.size(); ++v) a[v] -= b[v];
  return a;
}

}  // namespace

PackedPoses::PackedPoses(Rig& rig, const MeshRig& source, PackGoals goals, codec::Lattice lattice,
                         double tolerance, double angle)
    : rig_(rig),
      source_(source),
      lattice_(std::move(lattice)),
      tolerance_(tolerance),
      angle_(angle),
      grid_(rig.surface, 1),
      folds_(rig, grid_),
      inStored_(inStoredVectors(rig.surface)),
      columns_(columnsOf(rig.surface, grid_, lattice_.prediction(0), inStored_)),
      goals_(std::move(goals)),
      kept_(rig.packing.poses.size()),
      fittedNeutral_(rig.neutral) {}

void PackedPoses::keep(Index pose, Coefficients q) {
  rig_.vectorsOf(pose) = restored(pose, q);
  kept_[pose] = std::move(q);
}

void PackedPoses::learnNeutral() {
  neutralFolds_ = folds(0, rig_.neutral);
  neutralErrors_ = errors(0, rig_.neutral);
  neutralOff_ = settled(difference(rig_.neutral, fittedNeutral_));
  lattice_.learn(rig_.surface, rig_.neutral, step(0));
  findBones(rig_, lattice_, rig_.neutral, tolerance_, rig_.packing);
  bones_ = codec::Bones(rig_.surface, rig_.packing, rig_.neutral);
  columns_ = {};  // freed before the new ones are made: they are large
  columns_ = columnsOf(rig_.surface, grid_, lattice_.prediction(1), inStored_);
}

Coefficients PackedPoses::expected(Index pose) const {
  Coefficients steps(fitted(pose).size());
  for (const codec::Moved& m : codec::partnerOf(rig_.packing, lattice_, kept_, pose))
    steps[m.vector] = m.steps;
  return steps;
}

std::vector<Vec3> PackedPoses::compensated(Index pose) const {
  return pose == 0 ? fitted(0) : difference(fitted(pose), neutralOff_);
}

Coefficients PackedPoses::rounded(Index pose, const std::vector<Vec3>& vectors) const {
  return lattice_.round(pose, bones_.beyond(carries(pose), vectors), step(pose));
}

Coefficients PackedPoses::rounded(Index pose, const std::vector<Vec3>& vectors, Coefficients given,
                                  std::span<const char> isFree) const {
  return lattice_.round(pose, bones_.beyond(carries(pose), vectors), step(pose), std::move(given),
                        isFree);
}

std::vector<Vec3> PackedPoses::restored(Index pose, const Coefficients& q) const {
  std::vector<Vec3> vectors(q.size());
  lattice_.restore(pose, q, step(pose), vectors);
  bones_.add(carries(pose), 1, vectors);
  return vectors;
}

std::vector<Vec3> PackedPoses::settled(std::vector<Vec3> stored) const {
  const std::size_t count = stored.size();
  stored.resize(rig_.surface.vectorCount());
  rig_.surface.settle(std::span(stored).first(count), stored);
  return stored;
}

std::vector<Vec3> PackedPoses::errors(Index pose, std::vector<Vec3> vectors) const {
  std::vector<Vec3> errors = grid_.positions(settled(std::move(vectors)));
  for (std::size_t v = 0; v < errors.size(); ++v) {
    errors[v] -= goals_.places[pose][v];
    if (pose > 0) errors[v] += neutralErrors_[v];
    if (!isKnown(static_cast<Index>(v))) errors[v] = {};
  }
  return errors;
}

Slopes PackedPoses::slopes(Index pose, const std::vector<Vec3>& vectors) const {
  std::vector<Vec3> form = fitted(pose);
  if (pose > 0) add(form, fittedNeutral_);
  form = settled(std::move(form));
  const std::vector<Vec3> off = settled(difference(vectors, fitted(pose)));
  std::vector<Vec3> whole = off;
  if (pose > 0) add(whole, neutralOff_);
  const double limit = angle_ * std::numbers::pi / 180;
  const double weight = (pose == 0 ? kNeutralBits : kTargetBits) / (limit * limit);
  return slopesOf(rig_.surface, grid_, goals_.isKnown, {form, off, whole}, 0.5 * tolerance_,
                  static_cast<float>(weight));
}

std::vector<Index> PackedPoses::folds(Index pose, std::vector<Vec3> vectors) const {
  if (pose > 0) add(vectors, rig_.neutral);
  return folds_.quads(settled(std::move(vectors)), source_.positionsOf(pose));
}

std::vector<Index> PackedPoses::corners(std::span<const Index> quads) const {
  std::vector<Index> corners;
  for (const Index quad : quads)
    std::ranges::copy(folds_.corners(quad), std::back_inserter(corners));
  return corners;
}

std::set<Index> PackedPoses::behind(std::span<const Index> vertices) const {
  std::set<Index> stored;
  for (const Index v : vertices)
    for (const Index vector : rig_.surface.weights(grid_.site(v)).vectors)
      for (const Term& t : inStored_[vector]) stored.insert(t.vector);
  return stored;
}

}  // namespace sweepface
