#pragma once

#include "sweepface/followers.hpp"
#include "sweepface/head.hpp"
#include "sweepface/limits.hpp"

#include "command.hpp"
#include "performance.hpp"

namespace sweepface::cli {

/// What happens to weights once they are set.
struct FollowingArguments {
  std::string arcs = "off", eyes = "off", limits;
  bool combine = false;
  bool any() const { return arcs == "on" || eyes == "on" || combine; }
};
void addFollowing(CLI::App& app, FollowingArguments& a);

/// Limits, and weights that follow from the ones that are set.
struct Following {
  Limits limits;
  Followers followers;
  EyeTurns eyes;
  std::size_t count = 0;  ///< how many weights are set; they come first

  bool empty() const { return limits.empty() && followers.empty() && eyes.empty(); }
  /// Applies to the weights of all targets. The eyes' angles, if known, replace the eyeLook
  /// weights.
  void apply(std::span<double> weights, const HeadPose* pose = nullptr) const;
};

inline constexpr const char* kNoTurns =
    "No target turns about anything, so --arcs changes nothing.";

/// The limits of --limits; none if it is not given.
Result<Limits> limitsGiven(const FollowingArguments& a, const Rig& rig);

/// Sets up what was asked for and adds arcs and turning eyes to the targets of the rig. Warns of
/// weights in `told`, each [targets], that were set for targets that follow others, and of arcs
/// that change none of these expressions.
Result<Following> follow(const FollowingArguments& a, Rig& rig, std::vector<Weights> told = {});

/// A performance with limits, eyes and followers applied to its weights.
Performance withFollowing(Performance performance, const Following& following);

}  // namespace sweepface::cli
