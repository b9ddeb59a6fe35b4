#include "mesh/weld.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <tuple>
#include <unordered_map>

#include "mesh/each_edge.hpp"
#include "surface/union_find.hpp"

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

/// [vertices] of the edges of any length around each, but `most` at most.
std::vector<double> shortestEdges(const PolygonMesh& mesh, double most) {
  std::vector<double> shortest(mesh.positions.size(), most);
  eachEdge(mesh.polygons, [&](Index a, Index b) {
    const double length = norm(mesh.positions[a] - mesh.positions[b]);
    if (length > 0)
      for (const Index v : {a, b}) shortest[v] = std::min(shortest[v], length);
  });
  return shortest;
}

/// Sets of vertices, of those that are the first at their place, that are next to each other in all
/// poses.
template <typename Apart>
UnionFind nearSets(const MeshRig& rig, double within, const std::vector<Index>& first,
                   const Apart& apart) {
  constexpr double kOfEdges = 1e-3;
  constexpr std::size_t kMostLooks = 256;  // at vertices of one place that targets part
  const std::vector<Vec3>& neutral = rig.neutral.positions;
  std::vector<double> allowed = shortestEdges(rig.neutral, within / kOfEdges);
  for (double& distance : allowed) distance *= kOfEdges;
  // In an order in which what is near is near: along a line that hardly any mesh stands across.
  const Vec3 line = normalized({0.61, 0.55, 0.57});
  std::vector<std::pair<double, Index>> order;
  for (Index v = 0; v < static_cast<Index>(first.size()); ++v)
    if (first[v] == v) order.emplace_back(dot(neutral[v], line), v);
  std::ranges::sort(order);
  UnionFind sets(first.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t before = k; before-- > 0;) {
      if (order[k].first - order[before].first > within || k - before > kMostLooks) break;
      const Index a = order[k].second, b = order[before].second;
      if (norm(neutral[a] - neutral[b]) <= allowed[a] && apart(a, b) <= allowed[a]) sets.join(a, b);
    }
  return sets;
}

/// From and to which vertex edges lead that no face has the other way.
std::vector<std::pair<Index, Index>> openEdges(const Polygons& faces,
                                               const std::vector<Index>& first) {
  std::vector<std::pair<Index, Index>> edges, open;
  eachEdge(faces, [&](Index a, Index b) { edges.emplace_back(first[a], first[b]); });
  std::ranges::sort(edges);
  for (const auto& [from, to] : edges)
    if (!std::ranges::binary_search(edges, std::pair(to, from))) open.emplace_back(from, to);
  return open;
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

double weldRounded(const MeshRig& rig, double within, std::vector<Index>& first) {
  const auto apart = [&](Index a, Index b) {
    double most = norm(rig.neutral.positions[a] - rig.neutral.positions[b]);
    for (const MeshTarget& t : rig.targets)
      most = std::max(most, norm(t.positions[a] - t.positions[b]));
    return most;
  };
  UnionFind near = nearSets(rig, within, first, apart);
  // What merely touches somewhere is not meant to be joined, but edges that only these sets pair.
  struct OpenEdge {
    Index low, high;  // sets
    Index from, to;
  };
  std::vector<OpenEdge> edges;
  for (const auto& [from, to] : openEdges(rig.neutral.polygons, first))
    if (const auto [low, high] = std::minmax({near.find(from), near.find(to)}); low != high)
      edges.push_back({low, high, from, to});
  std::ranges::sort(edges, {},
                    [](const OpenEdge& e) { return std::tuple(e.low, e.high, e.from, e.to); });
  UnionFind sets(first.size());
  for (std::size_t k = 0; k < edges.size();) {
    std::size_t end = k + 1;
    while (end < edges.size() && edges[end].low == edges[k].low && edges[end].high == edges[k].high)
      ++end;
    if (end - k == 2 && near.find(edges[k].from) == near.find(edges[k + 1].to)) {
      sets.join(edges[k].from, edges[k + 1].to);
      sets.join(edges[k].to, edges[k + 1].from);
    }
    k = end;
  }
  double furthest = 0;
  for (Index v = 0; v < static_cast<Index>(first.size()); ++v) {
    first[v] = sets.find(first[v]);
    if (first[v] != v) furthest = std::max(furthest, apart(v, first[v]));
  }
  return furthest;
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
