// A region is a share of every node. What a node stores, its position and derivatives, moves by the
// weights of its regions in proportion to their shares. Patches take this from their nodes as
// usual, so seams stay closed and joins C².
#include "sweepface/regions.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace sweepface {
namespace {

bool isShare(double x) { return x >= 0 && x <= 1; }

std::unexpected<Error> tooMany() {
  return fail("A face has at most " + std::to_string(kMostRegions) +
              " regions, with what is left of it.");
}

Result<void> check(const std::vector<Region>& regions, std::size_t nodes) {
  if (regions.size() > kMostRegions) return tooMany();
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const Region& region = regions[r];
    if (region.name.empty()) return fail("A region has no name.");
    for (std::size_t s = 0; s < r; ++s)
      if (regions[s].name == region.name)
        return fail("Two regions are named '" + region.name + "'.");
    if (auto ok = sweepface::check(region.matter); !ok)
      return fail("Region '" + region.name + "': " + ok.error().message);
    if (region.shares.size() != nodes)
      return fail("Region '" + region.name + "' has " + std::to_string(region.shares.size()) +
                  " shares for " + std::to_string(nodes) + " nodes.");
    if (!std::ranges::all_of(region.shares, isShare))
      return fail("Region '" + region.name + "' has a share that is not from 0 to 1.");
  }
  return {};
}

std::string freeName(const std::vector<Region>& regions) {
  std::string name = "rest";
  while (std::ranges::find(regions, name, &Region::name) != regions.end()) name += '_';
  return name;
}

/// A share this small is a rounding error.
constexpr double kNothing = 1e-12;

}  // namespace

Result<void> check(const Matter& matter) {
  constexpr double least = 1e-4, most = 1e4;
  const auto within = [](double x) { return x >= least && x <= most; };
  if (!within(matter.mass) || !within(matter.stiffness))
    return fail("A mass and a stiffness are from 0.0001 to 10000, 1 being that of the rest.");
  constexpr double latest = 60;
  if (!(matter.delay >= 0 && matter.delay <= latest))
    return fail("A delay is from 0 to 60 seconds.");
  return {};
}

std::vector<std::string> namesOf(std::span<const Region> regions) {
  std::vector<std::string> names;
  for (const Region& region : regions) names.push_back(region.name);
  return names;
}

std::vector<Matter> mattersOf(std::span<const Region> regions) {
  std::vector<Matter> matters;
  for (const Region& region : regions) matters.push_back(region.matter);
  return matters;
}

Result<std::vector<Region>> dividedFace(const Rig& rig, std::vector<Region> painted) {
  const std::size_t nodes = rig.surface.wireframe().nodes.size();
  if (auto ok = check(painted, nodes); !ok) return std::unexpected(ok.error());
  Region rest{freeName(painted), {}, std::vector<double>(nodes, 0.0)};
  bool isLeft = false;
  for (std::size_t n = 0; n < nodes; ++n) {
    double sum = 0;
    for (const Region& region : painted) sum += region.shares[n];
    if (sum > 1)
      for (Region& region : painted) region.shares[n] /= sum;
    else if (sum < 1 - kNothing)
      rest.shares[n] = 1 - sum, isLeft = true;
  }
  if (isLeft || painted.empty()) painted.insert(painted.begin(), std::move(rest));
  if (painted.size() > kMostRegions) return tooMany();
  return painted;
}

std::vector<std::vector<float>> influencesOf(const Surface& surface,
                                             std::span<const Region> regions) {
  if (regions.size() < 2) return {};
  const auto stored = static_cast<std::size_t>(surface.storedCount());
  std::vector<std::vector<float>> influences(regions.size(), std::vector<float>(stored));
  for (std::size_t v = 0; v < stored; ++v) {
    const Index node = surface.stored(static_cast<Index>(v)).node;
    std::size_t largest = 0;
    double others = 0;
    for (std::size_t r = 1; r < regions.size(); ++r)
      if (regions[r].shares[node] > regions[largest].shares[node]) largest = r;
    for (std::size_t r = 0; r < regions.size(); ++r)
      if (r != largest) others += influences[r][v] = static_cast<float>(regions[r].shares[node]);
    influences[largest][v] = static_cast<float>(1 - others);  // so that they sum to 1
  }
  return influences;
}

void blend(const Rig& rig, std::span<const Region> regions, std::span<const double> weights,
           std::span<Vec3> vectors) {
  const std::size_t count = rig.targets.size(), stored = rig.neutral.size();
  if (regions.size() < 2) return blend(rig, weights, vectors);
  const auto at = [&](std::size_t k) { return k < weights.size() ? weights[k] : 0; };
  std::ranges::copy(rig.neutral, vectors.begin());
  for (std::size_t k = 0; k < count; ++k) {
    // A weight that is equal in all regions is used bit for bit, whatever the shares add up to.
    bool even = true;
    for (std::size_t r = 1; r < regions.size(); ++r) even &= at(r * count + k) == at(k);
    if ((even && at(k) == 0) || rig.targets[k].difference.empty()) continue;
    const auto weightAt = [&](Index node) {
      double weight = 0;
      for (std::size_t r = 0; r < regions.size(); ++r)
        weight += regions[r].shares[node] * at(r * count + k);
      return weight;
    };
    for (std::size_t v = 0; v < stored; ++v) {
      const Index node = rig.surface.stored(static_cast<Index>(v)).node;
      vectors[v] += (even ? at(k) : weightAt(node)) * rig.targets[k].difference[v];
    }
  }
  rig.surface.settle(vectors.first(stored), vectors);
}

// ---- Parts as targets ----

std::string partName(std::string_view target, std::string_view region) {
  return std::string(target).append("@").append(region);
}

namespace {

/// The part of a target that belongs to a region; vertices of no face go with the first.
Target partOf(const Rig& rig, const Target& whole, const Region& region, bool isFirst) {
  Target part{partName(whole.name, region.name), whole.difference, whole.looseDifference};
  for (std::size_t v = 0; v < part.difference.size(); ++v)
    part.difference[v] *= region.shares[rig.surface.stored(static_cast<Index>(v)).node];
  if (!isFirst) std::ranges::fill(part.looseDifference, Vec3{});
  return part;
}

/// Whether a target moves anything farther than a thousandth of the tolerance, which is invisible.
bool moves(const Target& target, double tolerance) {
  const auto isMore = [&](const Vec3& d) { return norm(d) > 1e-3 * tolerance; };
  return std::ranges::any_of(target.difference, isMore) ||
         std::ranges::any_of(target.looseDifference, isMore);
}

}  // namespace

RegionalTargets RegionalTargets::addTo(Rig& rig, std::span<const Region> regions,
                                       std::span<const Index> targets) {
  RegionalTargets made;
  made.count_ = rig.targets.size();
  for (const Index target : targets) {
    Split split{target, static_cast<Index>(rig.targets.size()), {}};
    std::vector<Target> parts;
    for (std::size_t r = 0; r < regions.size(); ++r) {
      Target part = partOf(rig, rig.targets[target], regions[r], r == 0);
      if (!moves(part, rig.tolerance)) continue;
      const auto isTaken = [&] {
        return rig.find(part.name) >= 0 ||
               std::ranges::find(parts, part.name, &Target::name) != parts.end();
      };
      while (isTaken()) part.name += '_';
      parts.push_back(std::move(part));
      split.regions.push_back(r);
    }
    if (parts.size() > 1) std::ranges::move(parts, std::back_inserter(rig.targets));
    if (!parts.empty()) made.splits_.push_back(std::move(split));
  }
  return made;
}

std::vector<Index> RegionalTargets::wholes() const {
  std::vector<Index> wholes(count_);
  std::iota(wholes.begin(), wholes.end(), 0);
  for (const Split& split : splits_)
    if (split.regions.size() > 1) wholes.insert(wholes.end(), split.regions.size(), split.target);
  return wholes;
}

void RegionalTargets::spread(std::span<const double> ofRegions,
                             std::span<double> out) const noexcept {
  std::ranges::copy(ofRegions.first(std::min(count_, out.size())), out.begin());
  for (const Split& split : splits_) {
    const auto weight = [&](std::size_t region) {
      return ofRegions[region * count_ + static_cast<std::size_t>(split.target)];
    };
    double least = weight(split.regions.front());
    for (const std::size_t region : split.regions) least = std::min(least, weight(region));
    if (static_cast<std::size_t>(split.target) < out.size()) out[split.target] = least;
    const std::size_t parts = split.regions.size() > 1 ? split.regions.size() : 0;
    for (std::size_t p = 0; p < parts; ++p)
      if (const auto place = static_cast<std::size_t>(split.firstPart) + p; place < out.size())
        out[place] = weight(split.regions[p]) - least;
  }
}

}  // namespace sweepface
