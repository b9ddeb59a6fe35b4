#include "mesh/weld.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <unordered_map>

namespace sweepface {

namespace {

std::uint64_t hashOf(const MeshRig& rig, std::size_t vertex) {
  std::uint64_t h = 0;
  const auto add = [&](const Vec3& p) {
    for (double c : {p.x, p.y, p.z})  // + 0.0 makes both zeros the same
      h = (h ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
  };
  add(rig.neutral.positions[vertex]);
  for (const MeshTarget& target : rig.targets) add(target.positions[vertex]);
  return h;
}

}  // namespace

std::vector<Index> weld(const MeshRig& rig) {
  const auto same = [&](Index a, Index b) {
    return rig.neutral.positions[a] == rig.neutral.positions[b] &&
           std::all_of(rig.targets.begin(), rig.targets.end(),
                       [&](const MeshTarget& t) { return t.positions[a] == t.positions[b]; });
  };
  std::unordered_map<std::uint64_t, std::vector<Index>> seen;
  std::vector<Index> first(rig.neutral.positions.size());
  for (Index v = 0; v < static_cast<Index>(first.size()); ++v) {
    auto& here = seen[hashOf(rig, v)];
    const auto match = std::find_if(here.begin(), here.end(), [&](Index w) { return same(v, w); });
    first[v] = match == here.end() ? v : *match;
    if (match == here.end()) here.push_back(v);
  }
  return first;
}

bool takeApart(std::vector<Index>& first, const std::vector<std::pair<Index, Index>>& edges) {
  std::vector<char> apart(first.size(), 0);
  for (auto [a, b] : edges) apart[a] = apart[b] = 1;
  bool any = false;
  for (std::size_t v = 0; v < first.size(); ++v)
    if (first[v] != static_cast<Index>(v) && apart[first[v]]) {
      first[v] = static_cast<Index>(v);
      any = true;
    }
  return any;
}

}  // namespace sweepface
