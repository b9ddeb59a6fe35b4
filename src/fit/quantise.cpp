#include "fit/quantise.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>

#include "fit/check_source.hpp"
#include "fit/defaults.hpp"
#include "fit/images.hpp"
#include "fit/pose_packer.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {

namespace {

// The targets' step, a share of the tolerance like kNeutralStep.
constexpr double kTargetStep = 1;
// The neutral spends this share of the tolerance, to leave room for the other poses.
constexpr double kNeutralShare = 0.5;
// The neutral's usual share of the time.
constexpr double kNeutralTime = 0.1;
// The share of the tolerance that the search keeps to: it computes in single precision.
constexpr double kBound = 0.995;

// Chooses steps, mirror and images.
codec::Lattice latticeFor(Rig& rig, const PackAims& aims) {
  Packing& packing = rig.packing;
  packing = {};
  packing.neutralStep = kNeutralStep * aims.stepShare * aims.tolerance;
  packing.targetStep = kTargetStep * aims.stepShare * aims.tolerance;
  const codec::MirrorSeeds seeds = codec::findMirror(rig.surface, rig.neutral);
  packing.axis = seeds.axis;
  packing.mirror = seeds.pairs;
  codec::Lattice lattice(rig.surface, packing);
  chooseImages(rig, lattice, packing);
  return lattice;
}

class Quantiser {
 public:
  Quantiser(Rig& rig, const MeshRig& source, PackGoals goals, const PackAims& aims,
            const std::function<bool(double)>& proceed)
      : rig_(rig),
        source_(source),
        tolerance_(aims.tolerance),
        proceed_(proceed),
        poses_(rig, source, std::move(goals), latticeFor(rig, aims), aims.tolerance, aims.angle) {}

  Result<void> run() {
    const bool met = packPose(poses_, 0, neutralBounds(), [this] {
      neutralLeft_ *= 0.97;  // nobody knows how many sweeps it takes
      return goesOn();
    });
    neutralLeft_ = 0;
    if (!goesOn()) return fail("packing was interrupted");
    if (!met) return failed("the neutral");
    poses_.learnNeutral();
    // Images first: the poses compared with them need them.
    for (const bool images : {true, false})
      if (auto ok = packTargets(images); !ok) return ok;
    return {};
  }

 private:
  // The neutral leaves room for the other poses, but gets no less than the fit itself needs.
  std::vector<float> neutralBounds() const {
    constexpr double kMore = 0.15, kMost = 0.98;
    const std::vector<Vec3> errors = poses_.errors(0, poses_.fitted(0));
    std::vector<float> bounds(errors.size(), static_cast<float>(kBound * tolerance_));
    for (std::size_t v = 0; v < errors.size(); ++v)
      if (poses_.isKnown(static_cast<Index>(v))) {
        const double needed = norm(errors[v]) / tolerance_ + kMore;
        bounds[v] = static_cast<float>(std::clamp(needed, kNeutralShare, kMost) * tolerance_);
      }
    return bounds;
  }

  Result<void> packTargets(bool images) {
    const std::vector<float> bounds(poses_.vertexCount(), static_cast<float>(kBound * tolerance_));
    std::vector<char> met(poses_.count(), true);
    parallelFor(Index{1}, poses_.count(), [&](Index pose) {
      const Index image = poses_.form(pose).image;
      if (images != (image < 0 || image == pose)) return;
      ++begun_;
      if (!goesOn()) return;
      met[pose] = packPose(poses_, pose, bounds, [this] { return goesOn(); });
    });
    if (!goesOn()) return fail("packing was interrupted");
    if (const auto bad = std::ranges::find(met, false); bad != met.end())
      return failed("'" + rig_.targets[bad - met.begin() - 1].name + "'");
    return {};
  }

  bool goesOn() const {
    const double targets = static_cast<double>(begun_) / poses_.count();
    return proceed_(std::lerp(kNeutralTime * (1 - neutralLeft_), 1, targets));
  }

  std::unexpected<Error> failed(const std::string& pose) const {
    // Files count steps from the origin; those of roots are halved.
    const double farthest = codec::kFarthest * rig_.packing.neutralStep / 2;
    const double away = reachOf(source_.neutral).away;
    if (away > farthest)
      return fail(fmt::format(
          "the mesh stands {:.3g} from the origin, too far to be packed at a tolerance of {:.3g}; "
          "move it there, allow a larger one, or do not pack",
          away, tolerance_));
    return fail(fmt::format(
        "steps fine enough for a tolerance of {:.3g} cannot be packed in {}; allow a larger one, "
        "or do not pack",
        tolerance_, pose));
  }

  Rig& rig_;
  const MeshRig& source_;
  double tolerance_;
  const std::function<bool(double)>& proceed_;
  PackedPoses poses_;
  double neutralLeft_ = 1;        // a share
  std::atomic<Index> begun_ = 0;  // targets
};

}  // namespace

Result<void> quantise(Rig& rig, const MeshRig& source, PackGoals goals, const PackAims& aims,
                      const std::function<bool(double)>& proceed) {
  return Quantiser(rig, source, std::move(goals), aims, proceed).run();
}

}  // namespace sweepface
