#include "following.hpp"

#include "sweepface/arcs.hpp"

namespace sweepface::cli {

void addFollowing(CLI::App& app, FollowingArguments& a) {
  app.add_option(
         "--arcs", a.arcs,
         "on: what turns moves on arcs instead of straight lines, lids over the eyeball and "
         "the jaw about its hinge")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str()
      ->type_name("on|off");
  app.add_flag("--combine", a.combine,
               "Targets named A_B follow the product of the weights of A and B, and those named "
               "A_50 stand in for A at 0.5");
}

Followers follow(const FollowingArguments& a, Rig& rig) {
  std::vector<Follower> followers;
  if (a.combine) {
    std::vector<std::string> names;
    for (const Target& target : rig.targets) names.push_back(target.name);
    followers = Followers::named(names);
  }
  if (a.arcs == "on") {
    const std::vector<Follower> arcs = addArcs(rig, findTurns(rig));
    followers.insert(followers.end(), arcs.begin(), arcs.end());
  }
  return Followers(std::move(followers));
}

Performance withFollowers(Performance performance, Followers followers, std::size_t count) {
  if (followers.empty()) return performance;
  performance.motion.reset();  // keys would not hold it exactly
  performance.at = [at = std::move(performance.at), followers = std::move(followers), count](
                       double time, std::span<double> weights) {
    at(time, weights.first(count));
    followers.apply(weights);
  };
  return performance;
}

Weights withFollowers(Weights weights, const Followers& followers, const Rig& rig) {
  weights.resize(rig.targets.size());
  followers.apply(weights);
  return weights;
}

}  // namespace sweepface::cli
