#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "sweepface/followers.hpp"
#include "sweepface/head.hpp"
#include "sweepface/limits.hpp"

#include "values.hpp"

namespace sweepface::python {

/// What follows from the weights that are set.
struct FollowingOptions {
  bool arcs = false;     ///< targets that turn move on arcs
  bool combine = false;  ///< A_B goes by the product of A and B, A_50 stands in for A at 0.5
  bool eyes = false;     ///< eyeballs turn rigidly, by the eyeLook targets or by angles
  std::string limits;    ///< as Limits::parse() reads them; empty: none
};

/// A rig and the weights that follow from those of its own targets.
class Following {
 public:
  Following(std::shared_ptr<const Rig> rig, const FollowingOptions& options);

  /// With the targets that are needed for it, after its own.
  const Rig& rig() const { return *rig_; }
  /// Weights for all of them [rig().targets] from those of its own, and from where the eyes look,
  /// if that is told.
  void extend(std::span<const double> own, const HeadPose* look, std::span<double> all) const;
  bool turnsEyes() const { return !eyes_.empty(); }
  /// Gives every eyeball that turns to one region.
  void keepWhole(std::span<Region> regions) const { eyes_.keepWhole(rig_->surface, regions); }

 private:
  std::shared_ptr<const Rig> rig_;
  Limits limits_;
  EyeTurns eyes_;
  Followers followers_;
};

}  // namespace sweepface::python
