#include "sweepface/followers.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "surface/sorting.hpp"

namespace sweepface {
namespace {

/// Finds the followers that the names of targets imply.
class NameReader {
 public:
  explicit NameReader(std::span<const std::string> names) : names_(names) {
    for (Index k = 0; k < static_cast<Index>(names.size()); ++k) sorted_.push_back(k);
    sortSmall(std::span(sorted_),
              [&](Index a, Index b) { return names[a] != names[b] ? names[a] < names[b] : a < b; });
  }

  std::optional<Follower> read(Index target) const {
    if (auto follower = readInBetween(target)) return follower;
    return readProduct(target);
  }

 private:
  Index find(std::string_view name) const {
    const auto found = std::ranges::lower_bound(
        sorted_, name, {}, [&](Index k) { return std::string_view(names_[k]); });
    return name.empty() || found == sorted_.end() || names_[*found] != name ? -1 : *found;
  }

  /// In-betweens: the leader's name, an optional separator, and two digits, the per cent of the
  /// leader's weight.
  std::optional<Follower> readInBetween(Index target) const {
    std::string_view name = names_[target];
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    if (name.size() < 3 || !isDigit(name.back()) || !isDigit(name[name.size() - 2])) return {};
    const int percent = 10 * (name[name.size() - 2] - '0') + name.back() - '0';
    name.remove_suffix(2);
    Index leader = isDigit(name.back()) ? -1 : find(name);  // target_110 does not follow target_1
    if (leader < 0 && (name.back() == '_' || name.back() == '.'))
      leader = find(name.substr(0, name.size() - 1));
    if (leader < 0 || percent == 0) return {};
    return Follower{Follower::Kind::inBetween, target, {leader}, percent / 100.0};
  }

  std::optional<Follower> readProduct(Index target) const {
    // The number of ways to split a name doubles with every underscore.
    constexpr int kMostUnderscores = 12;
    if (std::ranges::count(names_[target], '_') > kMostUnderscores) return {};
    Follower follower{Follower::Kind::product, target, {}, 0};
    if (!split(names_[target], target, follower.leaders) || follower.leaders.size() < 2) return {};
    return follower;
  }

  /// Splits a name into names of other targets, trying the shortest first: `eyeBlink_L_jawOpen`
  /// into `eyeBlink_L` and `jawOpen`, and `A_B_C` into A, B and C even if there is an `A_B`.
  bool split(std::string_view name, Index target, std::vector<Index>& leaders) const {
    for (auto end = name.find('_');; end = name.find('_', end + 1)) {
      const Index leader = find(name.substr(0, end));
      if (leader >= 0 && leader != target && std::ranges::find(leaders, leader) == leaders.end()) {
        leaders.push_back(leader);
        if (end == name.npos || split(name.substr(end + 1), target, leaders)) return true;
        leaders.pop_back();
      }
      if (end == name.npos) return false;
    }
  }

  std::span<const std::string> names_;
  std::vector<Index> sorted_;  // targets, sorted by name
};

}  // namespace

std::vector<Follower> Followers::named(std::span<const std::string> targets) {
  const NameReader reader(targets);
  std::vector<Follower> followers;
  for (Index k = 0; k < static_cast<Index>(targets.size()); ++k)
    if (auto follower = reader.read(k)) followers.push_back(std::move(*follower));
  const auto isProduct = [&](Index target) {
    return std::ranges::any_of(followers, [&](const Follower& f) {
      return f.target == target && f.kind == Follower::Kind::product;
    });
  };
  std::vector<Follower> found;
  for (const Follower& follower : followers)
    if (follower.kind != Follower::Kind::product ||
        std::ranges::none_of(follower.leaders, isProduct))
      found.push_back(follower);
  return found;
}

Followers::Followers(std::vector<Follower> followers) {
  sortSmall(std::span(followers), [](const Follower& a, const Follower& b) {
    return a.at != b.at ? a.at < b.at : a.target < b.target;
  });
  const auto is = [&](Index target, Follower::Kind kind) {
    return std::ranges::any_of(
        followers, [&](const Follower& f) { return f.target == target && f.kind == kind; });
  };
  for (const Follower& follower : followers) {
    const auto isBetween = [&](Index t) { return is(t, Follower::Kind::inBetween); };
    if (follower.kind == Follower::Kind::product) {
      products_.push_back(follower);
    } else if (follower.kind == Follower::Kind::arc) {
      const Index leader = follower.leaders[0];
      const bool hasStops = std::ranges::any_of(followers, [&](const Follower& f) {
        return f.kind == Follower::Kind::inBetween && f.leaders[0] == leader;
      });
      const bool follows = isBetween(leader) || is(leader, Follower::Kind::product);
      auto& arcs = follows ? lateArcs_ : arcs_;
      arcs.push_back(follower);
      if (hasStops) arcs.back().leaders.clear();  // in-betweens define the path: no bulge on top
    } else {
      auto chain = std::ranges::find(chains_, follower.leaders[0], &Chain::leader);
      if (chain == chains_.end()) chain = chains_.insert(chain, {follower.leaders[0], {}, 0});
      // If two targets stand for the same stop, the first counts.
      if (chain->stops.empty() || chain->stops.back().at != follower.at)
        chain->stops.push_back(follower);
      else
        ignored_.push_back(follower.target);
    }
  }
  for (Follower& product : products_)
    std::erase_if(product.leaders, [&](Index leader) {  // in-betweens become factors of chains
      bool isGiven = false;
      for (Chain& chain : chains_) {
        if (!chain.gives(leader)) continue;
        chain.factors.push_back({leader, product.target});
        isGiven = true;
      }
      return isGiven;
    });
  orderChains();
}

bool Followers::Chain::gives(Index target) const {
  return std::ranges::find(stops, target, &Follower::target) != stops.end();
}

// A chain hands over its leader's weight, so it comes after all chains that contribute to that.
void Followers::orderChains() {
  const auto isBefore = [](const Chain& a, const Chain& b) {
    return a.gives(b.leader) ||
           std::ranges::find(a.factors, b.leader, &Factor::product) != a.factors.end();
  };
  std::vector<std::array<Chain*, 2>> pairs;
  for (Chain& before : chains_)
    for (Chain& chain : chains_)
      if (isBefore(before, chain)) pairs.push_back({&before, &chain});
  bool deepens = true;
  for (std::size_t round = 0; round < chains_.size() && deepens; ++round) {
    deepens = false;
    for (const auto& [before, chain] : pairs)
      if (chain->depth <= before->depth) chain->depth = before->depth + 1, deepens = true;
  }
  sortSmall(std::span(chains_), [](const Chain& a, const Chain& b) {
    return a.depth != b.depth ? a.depth < b.depth : a.leader < b.leader;
  });
}

void Followers::apply(std::span<double> weights) const noexcept {
  const auto bend = [&](const std::vector<Follower>& arcs) {
    for (const Follower& arc : arcs) {
      const double w = arc.leaders.empty() ? 0 : weights[arc.leaders[0]];
      weights[arc.target] = 4 * w * (1 - w);
    }
  };
  for (const Index target : ignored_) weights[target] = 0;
  for (const Follower& product : products_) {
    double& weight = weights[product.target] = 1;
    for (const Index leader : product.leaders) weight *= weights[leader];
  }
  bend(arcs_);
  for (const Chain& chain : chains_) {
    handOver(chain, weights);
    for (const auto& [leader, product] : chain.factors) weights[product] *= weights[leader];
  }
  bend(lateArcs_);
  // Products of large weights may be too large to evaluate or, of infinity and 0, no number.
  for (double& w : weights)
    w = w == w ? std::clamp(w, -kMostPlausibleWeight, kMostPlausibleWeight) : 0;
}

// Linear between neighbouring stops, the outermost being the neutral and the leader itself; the
// first and the last piece are extrapolated.
void Followers::handOver(const Chain& chain, std::span<double> weights) noexcept {
  const double w = weights[chain.leader];
  const std::size_t count = chain.stops.size();
  const auto at = [&](std::size_t k) { return k < count ? chain.stops[k].at : 1.0; };
  const auto targetOf = [&](std::size_t k) {
    return k < count ? chain.stops[k].target : chain.leader;
  };
  for (std::size_t k = 0; k <= count; ++k) weights[targetOf(k)] = 0;
  std::size_t above = 0;
  while (above < count && at(above) < w) ++above;
  const double low = above ? at(above - 1) : 0, share = (w - low) / (at(above) - low);
  weights[targetOf(above)] = share;
  if (above > 0) weights[targetOf(above - 1)] = 1 - share;
}

}  // namespace sweepface
