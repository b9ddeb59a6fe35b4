#include "mesh/weld.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <unordered_map>

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
  const Polygons& faces = mesh.polygons;
  std::vector<double> shortest(mesh.positions.size(), most);
  for (Index f = 0; f < faces.faceCount(); ++f)
    for (Index k = 0; k < faces.faceSize(f); ++k) {
      const Index a = faces.corners[faces.faceStart[f] + k],
                  b = faces.corners[faces.faceStart[f] + (k + 1) % faces.faceSize(f)];
      const double length = norm(mesh.positions[a] - mesh.positions[b]);
      if (length > 0)
        for (const Index v : {a, b}) shortest[v] = std::min(shortest[v], length);
    }
  return shortest;
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
  const std::vector<Vec3>& neutral = rig.neutral.positions;
  const auto apart = [&](Index a, Index b) {
    double most = norm(neutral[a] - neutral[b]);
    for (const MeshTarget& t : rig.targets)
      most = std::max(most, norm(t.positions[a] - t.positions[b]));
    return most;
  };
  constexpr double kOfEdges = 1e-3;
  std::vector<double> allowed = shortestEdges(rig.neutral, within / kOfEdges);
  for (double& distance : allowed) distance *= kOfEdges;
  // In an order in which what is near is near: along a line that hardly any mesh stands across.
  const Vec3 line = normalized({0.61, 0.55, 0.57});
  std::vector<std::pair<double, Index>> order;
  for (Index v = 0; v < static_cast<Index>(first.size()); ++v)
    if (first[v] == v) order.emplace_back(dot(neutral[v], line), v);
  std::ranges::sort(order);
  UnionFind sets(static_cast<Index>(first.size()));
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t before = k; before-- > 0;) {
      if (order[k].first - order[before].first > within) break;
      const Index a = order[k].second, b = order[before].second;
      if (norm(neutral[a] - neutral[b]) <= allowed[a] && apart(a, b) <= allowed[a]) sets.join(a, b);
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
