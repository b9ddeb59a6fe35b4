#include "following.hpp"

#include <algorithm>

#include "sweepface/arcs.hpp"
#include "sweepface/weights.hpp"

namespace sweepface::python {

Following::Following(std::shared_ptr<const Rig> rig, const FollowingOptions& options)
    : rig_(std::move(rig)) {
  if (!options.limits.empty()) limits_ = valueOf(Limits::parse(*rig_, options.limits));
  if (!options.arcs && !options.combine && !options.eyes) return;
  const auto extended = std::make_shared<Rig>(*rig_);
  std::vector<Follower> followers;
  if (options.combine) {
    followers = Followers::named(rig_->targetNames());
    if (followers.empty()) throw Failure("No target is named after others; leave combine out.");
  }
  if (options.arcs) {
    const std::vector<Turn> turns = turnsOf(*rig_);
    if (turns.empty()) throw Failure("No target turns anything; leave arcs out.");
    std::ranges::copy(addArcs(*extended, turns), std::back_inserter(followers));
  }
  if (options.eyes) {
    const std::vector<Eye> eyes = findEyes(*rig_);
    if (eyes.empty()) throw Failure("The face has no eyeballs that could turn; leave eyes out.");
    eyes_ = EyeTurns::addTo(*extended, eyes);
  }
  followers_ = Followers(std::move(followers));
  rig_ = extended;
}

void Following::extend(std::span<const double> own, const HeadPose* look,
                       std::span<double> all) const {
  std::ranges::copy(own, all.begin());
  limits_.apply(all);
  look ? eyes_.apply(*look, all) : eyes_.apply(all);
  followers_.apply(all);
}

}  // namespace sweepface::python
