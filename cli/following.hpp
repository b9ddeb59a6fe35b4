#pragma once

#include "sweepface/followers.hpp"

#include "command.hpp"
#include "performance.hpp"

namespace sweepface::cli {

/// Which weights follow from those that are set.
struct FollowingArguments {
  std::string arcs = "off";
  bool combine = false;
  bool any() const { return arcs == "on" || combine; }
};
void addFollowing(CLI::App& app, FollowingArguments& a);

/// The followers that were asked for; arcs are added to the targets of the rig.
Followers follow(const FollowingArguments& a, Rig& rig);

/// A performance whose weights, of the first `count` targets, take followers along.
Performance withFollowers(Performance performance, Followers followers, std::size_t count);

/// The same for the weights of one expression.
Weights withFollowers(Weights weights, const Followers& followers, const Rig& rig);

}  // namespace sweepface::cli
