#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "mesh/each_edge.hpp"
#include "mesh/shared_edges.hpp"
#include "mesh/weld.hpp"
#include "surface/union_find.hpp"

namespace sweepface {

namespace {

/// [vertices] The length of the shortest edge at each that is above `least`, or `most` if smaller.
std::vector<double> shortestEdges(const PolygonMesh& mesh, double least, double most) {
  std::vector<double> shortest(mesh.positions.size(), most);
  eachEdge(mesh.polygons, [&](Index a, Index b) {
    const double length = norm(mesh.positions[a] - mesh.positions[b]);
    if (length > least)
      for (const Index v : {a, b}) shortest[v] = std::min(shortest[v], length);
  });
  return shortest;
}

// The largest rounding, and the largest gap between edges meant as one, as shares of edge lengths.
constexpr double kRoundingOfEdges = 1e-3, kGapOfEdges = 0.05;

/// Finds vertices that are near each other in all poses: at most `within` apart, and at most a
/// share of any edge of either that is longer than `within`.
class Neighbours {
 public:
  Neighbours(const MeshRig& rig, double within, double ofEdges)
      : rig_(rig), allowed_(shortestEdges(rig.neutral, within, within / ofEdges)) {
    for (double& distance : allowed_) distance *= ofEdges;
  }

  /// The largest distance of two vertices in any pose.
  double apart(Index a, Index b) const {
    double most = norm(rig_.neutral.positions[a] - rig_.neutral.positions[b]);
    for (const MeshTarget& t : rig_.targets)
      most = std::max(most, norm(t.positions[a] - t.positions[b]));
    return most;
  }
  bool areNear(Index a, Index b) const {
    const double most = std::min(allowed_[a], allowed_[b]);
    const std::vector<Vec3>& neutral = rig_.neutral.positions;
    return norm(neutral[a] - neutral[b]) <= most && apart(a, b) <= most;  // few get this far
  }

  /// Groups of `vertices` that are near each other, directly or through others.
  UnionFind sets(const std::vector<Index>& vertices) const {
    UnionFind sets(rig_.neutral.positions.size());
    double size = 0;
    for (const Index v : vertices) size = std::max(size, allowed_[v]);
    if (!(size > 0)) size = 1;  // only vertices at the same place are near
    std::map<Cell, std::vector<Index>> cells;
    for (const Index v : vertices) {
      const Cell here = cellOf(v, size);
      for (double x : {-1, 0, 1})
        for (double y : {-1, 0, 1})
          for (double z : {-1, 0, 1})
            if (const auto there = cells.find({here[0] + x, here[1] + y, here[2] + z});
                there != cells.end())
              for (const Index w : there->second)
                if (areNear(v, w)) sets.join(v, w);
      cells[here].push_back(v);
    }
    return sets;
  }

 private:
  using Cell = std::array<double, 3>;

  /// By the mean over all poses, no two of which have the same weight: vertices near each other in
  /// all poses are near there, and those that one pose separates are not.
  Cell cellOf(Index v, double size) const {
    double sum = 1, share = 0;
    Vec3 mean = rig_.neutral.positions[v];
    for (const MeshTarget& target : rig_.targets) {
      share = std::fmod(share + std::numbers::phi, 1);
      mean += (1 + share) * target.positions[v];
      sum += 1 + share;
    }
    const double cells = 1 / (sum * size);
    return {std::floor(mean.x * cells), std::floor(mean.y * cells), std::floor(mean.z * cells)};
  }

  const MeshRig& rig_;
  std::vector<double> allowed_;  // [vertices]
};

/// The edges, as (from, to), that no face has in the other direction.
std::vector<std::pair<Index, Index>> openEdges(const Polygons& faces,
                                               const std::vector<Index>& first) {
  std::vector<std::pair<Index, Index>> edges, open;
  eachEdge(faces, [&](Index a, Index b) { edges.emplace_back(first[a], first[b]); });
  std::ranges::sort(edges);
  for (const auto& [from, to] : edges)
    if (!std::ranges::binary_search(edges, std::pair(to, from))) open.emplace_back(from, to);
  return open;
}

std::vector<Index> firstOf(UnionFind& sets) {
  std::vector<Index> first(sets.size());
  for (Index v = 0; v < std::ssize(first); ++v) first[v] = sets.find(v);
  return first;
}

/// Marks the first vertices of sets that must not become points: one of their vertices is not near
/// the first, or a face would lose its surface.
std::vector<char> notPoints(const Polygons& faces, const Neighbours& neighbours, UnionFind& before,
                            UnionFind& after) {
  std::vector<char> bad(after.size(), 0);
  for (Index v = 0; v < std::ssize(bad); ++v)
    if (const Index first = after.find(v);
        first != before.find(v) && !neighbours.areNear(first, before.find(v)))
      bad[first] = 1;
  for (Index f = 0; f < faces.faceCount(); ++f) {
    std::set<Index> corners, left;
    for (Index c = faces.faceStart[f]; c < faces.faceStart[f + 1]; ++c)
      corners.insert(before.find(faces.corners[c])), left.insert(after.find(faces.corners[c]));
    if (corners.size() > 2 && left.size() < 3)
      for (const Index v : left) bad[v] = 1;
  }
  return bad;
}

/// Joins the ends of open edges that together are one point, as around the pole of a sphere.
void closePoints(const Polygons& faces, const Neighbours& neighbours, UnionFind& sets) {
  auto open = openEdges(faces, firstOf(sets));
  std::erase_if(open,
                [&](const auto& ends) { return !neighbours.areNear(ends.first, ends.second); });
  if (open.empty()) return;
  UnionFind closed = sets;
  for (const auto& [from, to] : open) closed.join(from, to);
  const std::vector<char> bad = notPoints(faces, neighbours, sets, closed);
  for (const auto& [from, to] : open)
    if (!bad[closed.find(from)]) sets.join(from, to);
}

/// Joins open edges that pair up once near vertices count as one; what merely touches stays apart.
void closeSlits(const Polygons& faces, const Neighbours& neighbours, UnionFind& sets) {
  const auto open = openEdges(faces, firstOf(sets));
  std::vector<Index> ends;
  for (const auto& [from, to] : open) ends.insert(ends.end(), {from, to});
  std::ranges::sort(ends);
  ends.erase(std::ranges::unique(ends).begin(), ends.end());
  UnionFind near = neighbours.sets(ends);
  std::vector<EdgeSide> sides;
  for (Index k = 0; k < std::ssize(open); ++k)
    if (const Index a = near.find(open[k].first), b = near.find(open[k].second); a != b)
      sides.emplace_back(a, b, k);
  eachSharedEdge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() != 2) return;
    const auto [a, b] = open[edge[0].at];
    const auto [c, d] = open[edge[1].at];
    if (!neighbours.areNear(a, d) || !neighbours.areNear(b, c)) return;
    sets.join(a, d);
    sets.join(b, c);
  });
}

UnionFind setsOf(const std::vector<Index>& first) {
  UnionFind sets(first.size());
  for (Index v = 0; v < std::ssize(first); ++v) sets.join(v, first[v]);
  return sets;
}

}  // namespace

double weldRounded(const MeshRig& rig, double within, std::vector<Index>& first) {
  const Neighbours neighbours(rig, within, kRoundingOfEdges);
  UnionFind sets = setsOf(first);
  closePoints(rig.neutral.polygons, neighbours, sets);
  closeSlits(rig.neutral.polygons, neighbours, sets);
  first = firstOf(sets);
  double furthest = 0;
  for (Index v = 0; v < std::ssize(first); ++v)
    if (first[v] != v) furthest = std::max(furthest, neighbours.apart(v, first[v]));
  return furthest;
}

OpenSeams openSeams(const MeshRig& rig, double within, const std::vector<Index>& first) {
  const Neighbours neighbours(rig, within, kGapOfEdges);
  UnionFind sets = setsOf(first);
  closeSlits(rig.neutral.polygons, neighbours, sets);
  OpenSeams seams;
  for (Index v = 0; v < std::ssize(first); ++v)
    if (const Index other = sets.find(v); first[v] == v && other != v) {
      if (seams.vertices++ == 0) seams.one = v, seams.other = other;
      seams.widest = std::max(seams.widest, neighbours.apart(v, other));
    }
  return seams;
}

}  // namespace sweepface
