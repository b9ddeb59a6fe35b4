#pragma once

#include "sweepface/followers.hpp"
#include "sweepface/head.hpp"
#include "sweepface/limits.hpp"

#include "command.hpp"
#include "performance.hpp"

namespace sweepface::cli {

/// What happens to weights after they were set.
struct FollowingArguments {
  std::string arcs = "off", eyes = "off", limits;
  bool combine = false;
  bool any() const { return arcs == "on" || eyes == "on" || combine; }
};
void addFollowing(CLI::App& app, FollowingArguments& a);

/// Limits, and weights that follow from those that are set.
struct Following {
  Limits limits;
  Followers followers;
  EyeTurns eyes;
  std::size_t count = 0;  ///< weights that are set, the first ones

  bool empty() const { return limits.empty() && followers.empty() && eyes.empty(); }
  /// Of all targets. Where the eyes' angles are known, they count instead of eyeLook weights.
  void apply(std::span<double> weights, const HeadPose* pose = nullptr) const;
};

inline constexpr const char* kNoTurns =
    "No target turns about anything, so --arcs changes nothing.";

/// What was asked for; arcs and turning eyes are added to the targets of the rig. Warns of weights
/// that were told of what follows, each [targets].
Result<Following> follow(const FollowingArguments& a, Rig& rig,
                         const std::vector<Weights>& told = {});

/// A performance whose weights take followers along.
Performance withFollowing(Performance performance, const Following& following);

}  // namespace sweepface::cli
