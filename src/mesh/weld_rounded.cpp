#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <unsupported/Eigen/BVH>

#include "mesh/each_edge.hpp"
#include "mesh/shared_edges.hpp"
#include "mesh/weld.hpp"
#include "surface/union_find.hpp"

namespace sweepface {

namespace {

/// [vertices] The length of the shortest edge at each that is above `least`, or `most` if smaller.
std::vector<double> shortestEdges(const PolygonMesh& mesh, double least, double most) {
  std::vector<double> shortest(mesh.positions.size(), most);
  eachEdge(mesh.polygons, [&](Index a, Index b, Index) {
    const double length = norm(mesh.positions[a] - mesh.positions[b]);
    if (length > least)
      for (const Index v : {a, b}) shortest[v] = std::min(shortest[v], length);
  });
  return shortest;
}

// The largest rounding, and the largest gap between edges meant as one, as shares of edge lengths.
constexpr double kRoundingOfEdges = 1e-3, kGapOfEdges = 0.05;

/// Finds vertices that are near each other in all poses: at most `within` apart, at most a share of
/// any edge of either that is longer than `within`, and at most `inNeutral` in the neutral.
class Neighbours {
 public:
  Neighbours(const MeshRig& rig, double within, double ofEdges, double inNeutral = INFINITY)
      : rig_(rig),
        allowed_(shortestEdges(rig.neutral, within, within / ofEdges)),
        inNeutral_(inNeutral) {
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
    return norm(neutral[a] - neutral[b]) <= std::min(most, inNeutral_) &&
           apart(a, b) <= most;  // few get this far
  }

  /// Groups of `vertices` that are near each other, directly or through others.
  UnionFind sets(const std::vector<Index>& vertices) const {
    UnionFind sets(rig_.neutral.positions.size());
    std::vector<Box> places;
    for (const Index v : vertices) places.emplace_back(placeOf(v));
    const Eigen::KdBVH<double, 3, Index> tree(vertices.begin(), vertices.end(), places.begin(),
                                              places.end());
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      Ball ball{*this, sets, vertices[k], places[k].min()};
      Eigen::BVIntersect(tree, ball);
    }
    return sets;
  }

 private:
  using Box = Eigen::AlignedBox3d;

  /// The search for the neighbours of a vertex, as Eigen's tree asks for it. Of two vertices that
  /// are near each other the one with shorter edges finds the other, so no ball is large for all.
  struct Ball {
    const Neighbours& neighbours;
    UnionFind& sets;
    Index vertex;
    Eigen::Vector3d centre;

    bool intersectVolume(const Box& box) const {
      constexpr double kRounding = 1 + 1e-6;  // of means
      return box.exteriorDistance(centre) <= kRounding * neighbours.allowed_[vertex];
    }
    bool intersectObject(Index other) const {
      if (neighbours.areNear(vertex, other)) sets.join(vertex, other);
      return false;  // go on
    }
  };

  /// The mean over all poses, no two of which have the same weight: vertices near each other in all
  /// poses are near there, and those that one pose separates are not.
  Eigen::Vector3d placeOf(Index v) const {
    double sum = 1, share = 0;
    Vec3 mean = rig_.neutral.positions[v];
    for (const MeshTarget& target : rig_.targets) {
      share = std::fmod(share + std::numbers::phi, 1);
      mean += (1 + share) * target.positions[v];
      sum += 1 + share;
    }
    return Eigen::Vector3d(mean.x, mean.y, mean.z) / sum;
  }

  const MeshRig& rig_;
  std::vector<double> allowed_;  // [vertices]
  double inNeutral_;
};

struct OpenEdge {
  Index from, to, face;
};

/// The edges that no face has in the other direction.
std::vector<OpenEdge> openEdges(const Polygons& faces, const std::vector<Index>& first) {
  const auto endsOf = [](const OpenEdge& edge) { return std::pair(edge.from, edge.to); };
  std::vector<OpenEdge> edges, open;
  eachEdge(faces,
           [&](Index a, Index b, Index face) { edges.push_back({first[a], first[b], face}); });
  std::ranges::sort(edges, {}, endsOf);
  for (const OpenEdge& edge : edges)
    if (!std::ranges::binary_search(edges, std::pair(edge.to, edge.from), {}, endsOf))
      open.push_back(edge);
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
                [&](const OpenEdge& edge) { return !neighbours.areNear(edge.from, edge.to); });
  if (open.empty()) return;
  UnionFind closed = sets;
  for (const OpenEdge& edge : open) closed.join(edge.from, edge.to);
  const std::vector<char> bad = notPoints(faces, neighbours, sets, closed);
  for (const OpenEdge& edge : open)
    if (!bad[closed.find(edge.from)]) sets.join(edge.from, edge.to);
}

/// Joins open edges that pair up once near vertices count as one; what merely touches stays apart,
/// and so do pairs of which `isCard(edge, other)`. Returns the widest gap.
template <typename IsCard>
double closeSlits(const Polygons& faces, const Neighbours& neighbours, UnionFind& sets,
                  const IsCard& isCard) {
  const auto open = openEdges(faces, firstOf(sets));
  double widest = 0;
  std::vector<Index> ends;
  for (const OpenEdge& edge : open) ends.insert(ends.end(), {edge.from, edge.to});
  std::ranges::sort(ends);
  ends.erase(std::ranges::unique(ends).begin(), ends.end());
  UnionFind near = neighbours.sets(ends);
  std::vector<EdgeSide> sides;
  for (Index k = 0; k < std::ssize(open); ++k)
    if (const Index a = near.find(open[k].from), b = near.find(open[k].to); a != b)
      sides.emplace_back(a, b, k);
  eachSharedEdge(sides, [&](std::span<const EdgeSide> edge) {
    if (edge.size() != 2) return;
    const OpenEdge &one = open[edge[0].at], &other = open[edge[1].at];
    const Index a = one.from, b = one.to, c = other.from, d = other.to;
    if (isCard(one, other) || !neighbours.areNear(a, d) || !neighbours.areNear(b, c)) return;
    widest = std::max({widest, neighbours.apart(a, d), neighbours.apart(b, c)});
    sets.join(a, d);
    sets.join(b, c);
  });
  return widest;
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
  closeSlits(rig.neutral.polygons, neighbours, sets,
             [](const OpenEdge& a, const OpenEdge& b) { return a.face == b.face; });
  first = firstOf(sets);
  double furthest = 0;
  for (Index v = 0; v < std::ssize(first); ++v)
    if (first[v] != v) furthest = std::max(furthest, neighbours.apart(v, first[v]));
  return furthest;
}

OpenSeams openSeams(const MeshRig& rig, double within, double inNeutral,
                    const std::vector<Index>& first) {
  const Neighbours neighbours(rig, within, kGapOfEdges, inNeutral);
  UnionFind sets = setsOf(first), narrow = sets;
  eachEdge(rig.neutral.polygons, [&](Index a, Index b, Index) {
    if (norm(rig.neutral.positions[a] - rig.neutral.positions[b]) <= within) narrow.join(a, b);
  });
  // The two sides of a card are as near each other as those of a seam, but along its surface.
  const auto isCard = [&](const OpenEdge& a, const OpenEdge& b) {
    return narrow.find(a.from) == narrow.find(b.to) || narrow.find(a.to) == narrow.find(b.from);
  };
  OpenSeams seams;
  seams.widest = closeSlits(rig.neutral.polygons, neighbours, sets, isCard);
  for (Index v = 0; v < std::ssize(first); ++v)
    if (const Index other = sets.find(v); first[v] == v && other != v)
      if (seams.vertices++ == 0) seams.one = v, seams.other = other;
  return seams;
}

}  // namespace sweepface
