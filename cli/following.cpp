#include "following.hpp"

#include <algorithm>
#include <fmt/ranges.h>
#include <ranges>
#include <utility>

#include "sweepface/arcs.hpp"

#include "output.hpp"

namespace sweepface::cli {

void addFollowing(CLI::App& app, FollowingArguments& a) {
  app.add_option("--arcs", a.arcs,
                 "on: expressions that turn something move it on arcs instead of straight lines: "
                 "lids over the eyeball, the jaw about its hinge")
      ->check(onOrOff())
      ->capture_default_str()
      ->type_name("on|off");
  app.add_option("--eyes", a.eyes,
                 "on: eyeballs turn rigidly about their centres, by the eyeLook weights or the "
                 "angles of a capture")
      ->check(onOrOff())
      ->capture_default_str()
      ->type_name("on|off");
  app.add_flag("--combine", a.combine,
               "Targets named A_B follow the product of the weights of A and B, and those named "
               "A_50 stand in for A at 0.5");
  app.add_option("--limits", a.limits,
                 "Clamp weights to these limits, e.g. 0:1 for all, or 0:1,jawOpen=0:0.8")
      ->check(notEmpty())
      ->type_name("LOW:HIGH,...");
}

void Following::apply(std::span<double> weights, const HeadPose* pose) const {
  limits.apply(weights);
  pose ? eyes.apply(*pose, weights) : eyes.apply(weights);
  followers.apply(weights);
}

namespace {

std::string listed(const std::vector<Index>& targets, const std::vector<std::string>& names) {
  const auto named = targets | std::views::transform([&](Index k) { return names[k]; });
  return fmt::format("{}", fmt::join(named, " and "));
}

/// A name in small letters, with underscores for separators.
std::string plainly(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == '-' || c == '.' || c == ' ' || c == '+') c = '_';
  }
  const auto repeated =
      std::ranges::unique(name, [](char a, char b) { return a == '_' && b == '_'; });
  name.erase(repeated.begin(), repeated.end());
  return name;
}

/// Targets by the length of their names, the longest first, but for those that follow others.
std::vector<Index> leadersByLength(const std::vector<std::string>& names,
                                   const std::vector<Follower>& followers) {
  std::vector<Index> order;
  for (Index k = 0; k < std::ssize(names); ++k)
    if (std::ranges::find(followers, k, &Follower::target) == followers.end()) order.push_back(k);
  std::ranges::sort(order, {}, [&](Index k) { return std::pair(-std::ssize(names[k]), k); });
  return order;
}

/// Where a name stands in another between underscores, or npos.
std::size_t placeIn(const std::string& name, const std::string& part) {
  for (auto at = name.find(part); at != name.npos; at = name.find(part, at + 1)) {
    const std::size_t end = at + part.size();
    if ((at == 0 || name[at - 1] == '_') && (end == name.size() || name[end] == '_')) return at;
  }
  return name.npos;
}

/// The targets whose names stand in that of one, each apart from those before.
std::vector<Index> namedIn(Index target, const std::vector<std::string>& names,
                           const std::vector<Index>& leaders) {
  std::string name = names[target];
  std::vector<Index> found;
  for (const Index k : leaders) {
    const std::size_t at = names[k] == names[target] ? name.npos : placeIn(name, names[k]);
    if (at == name.npos) continue;
    found.push_back(k);
    name.replace(at, names[k].size(), 1, '\0');
  }
  return found;
}

/// Whether a name is another with something after it that ends in two digits, but is no number.
bool isStopOf(const std::string& name, const std::string& leader) {
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  return name.size() > leader.size() + 2 && name.starts_with(leader) &&
         !isDigit(name[leader.size()]) && isDigit(name.back()) && isDigit(name[name.size() - 2]);
}

/// Warns of targets that would be combinations if names did not differ in capitals and separators,
/// or had nothing besides the names of others.
void warnOfSpellings(const std::vector<std::string>& names,
                     const std::vector<Follower>& followers) {
  std::vector<std::string> plain;
  for (const std::string& name : names) plain.push_back(plainly(name));
  const std::vector<Follower> alike = Followers::named(plain);
  const std::vector<Index> possible = leadersByLength(plain, alike);
  for (Index k = 0; k < std::ssize(names); ++k) {
    if (std::ranges::find(followers, k, &Follower::target) != followers.end()) continue;
    const auto meant = std::ranges::find(alike, k, &Follower::target);
    std::vector<Index> leaders =
        meant != alike.end() ? meant->leaders : namedIn(k, plain, possible);
    if (leaders.size() == 1 && meant == alike.end() && !isStopOf(plain[k], plain[leaders[0]]))
      continue;
    if (!leaders.empty())
      printWarning(
          fmt::format("--combine: {} does not follow {}, as it is not spelt alike; rename it.",
                      names[k], listed(leaders, names)));
  }
}

/// The followers that the names of the targets define.
std::vector<Follower> combined(const Rig& rig, const std::vector<Weights>& told) {
  const std::vector<std::string> names = rig.targetNames();
  std::vector<Follower> followers = Followers::named(names);
  if (followers.empty())
    printWarning("No target is named after others, so --combine changes nothing.");
  for (const Follower& f : followers)
    if (std::ranges::any_of(told, [&](const Weights& w) { return w[f.target] != 0; }))
      printWarning(
          fmt::format("--combine: {} follows {}, so that its own weight counts for nothing.",
                      names[f.target], listed(f.leaders, names)));
  warnOfSpellings(names, followers);
  return followers;
}

/// Warns if no target turns, or none of those that expressions use.
void warnOfIdleArcs(const Rig& rig, const std::vector<Turn>& turns,
                    const std::vector<Weights>& expressions) {
  if (turns.empty()) return printWarning(kNoTurns);
  bool isAnyUsed = false;
  for (const Weights& weights : expressions) {
    if (std::ranges::any_of(turns, [&](const Turn& t) { return weights[t.target] != 0; })) return;
    isAnyUsed |= std::ranges::any_of(weights, [](double weight) { return weight != 0; });
  }
  if (!isAnyUsed) return;
  std::vector<std::string> names;
  for (const Turn& turn : turns) names.push_back(rig.targets[turn.target].name);
  printWarning(
      fmt::format("No target of the expression turns about anything, so --arcs changes nothing; "
                  "those that turn are {}.",
                  firstOf(names)));
}

/// Whether the turning eyes have taken over all that this target moved.
bool isStill(const Rig& rig, const Target& target) {
  const auto isNothing = [&](const Vec3& d) { return norm(d) <= rig.tolerance; };
  return std::ranges::all_of(target.difference, isNothing) &&
         std::ranges::all_of(target.looseDifference, isNothing);
}

}  // namespace

Result<Limits> limitsGiven(const FollowingArguments& a, const Rig& rig) {
  if (a.limits.empty()) return Limits();
  auto limits = Limits::parse(rig, a.limits);
  if (limits) return limits;
  const std::string& why = limits.error().message;
  if (!why.starts_with("There is no target")) return fail("--limits: " + why);
  std::string named;  // without limits for all
  for (const auto item : a.limits | std::views::split(','))
    if (const std::string_view text(item.begin(), item.end()); text.contains('='))
      named.append(text).append(",");
  return fail("--limits: " + hintAtName(named, rig) + why);
}

Result<Following> follow(const FollowingArguments& a, Rig& rig, std::vector<Weights> told) {
  Following following;
  following.count = rig.targets.size();
  auto limits = limitsGiven(a, rig);
  if (!limits) return std::unexpected(limits.error());
  following.limits = std::move(*limits);
  std::vector<Follower> followers;
  if (a.combine) followers = combined(rig, told);
  // Lids turn about the eyeballs, so turns are found while the targets still move the eyeballs.
  auto turns = a.arcs == "on" ? turnsOf(rig) : std::vector<Turn>{};
  if (a.arcs == "on") {
    for (Weights& weights : told) {
      weights.resize(rig.targets.size());
      following.limits.apply(weights);
      Followers(followers).apply(weights);
    }
    warnOfIdleArcs(rig, turns, told);
  }
  if (a.eyes == "on") {
    const std::vector<Eye> eyes = findEyes(rig);
    if (eyes.empty()) return fail("The face has no eyeballs that could turn; leave --eyes out.");
    if (std::ranges::any_of(eyes,
                            [&](const Eye& eye) { return rig.find(eye.name + ".down") >= 0; }))
      printWarning(
          "The face has targets as an earlier --eyes on adds them, like 'eyeLeft.down'; those that "
          "are added now end in '_'. Convert a file without them.");
    following.eyes = EyeTurns::addTo(rig, eyes);
    std::erase_if(turns, [&](const Turn& turn) { return isStill(rig, rig.targets[turn.target]); });
  }
  const std::vector<Follower> arcs = addArcs(rig, turns);
  followers.insert(followers.end(), arcs.begin(), arcs.end());
  following.followers = Followers(std::move(followers));
  return following;
}

Performance withFollowing(Performance performance, const Following& following) {
  if (following.empty()) return performance;
  performance.motion.reset();  // keys could not hold it exactly
  performance.at = [at = std::move(performance.at), following, pose = performance.pose,
                    byAngles = performance.hasEyes](double time, std::span<double> weights) {
    at(time, weights.first(following.count));
    const HeadPose stands = byAngles ? pose(time) : HeadPose{};
    following.apply(weights, byAngles ? &stands : nullptr);
  };
  return performance;
}

}  // namespace sweepface::cli
