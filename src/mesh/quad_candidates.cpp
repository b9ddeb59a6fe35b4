#include "mesh/quad_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "mesh/weld.hpp"

namespace sweepface {

namespace {

// Faces joined over the edges that exactly two of them share in opposite directions.
struct FaceEdges {
  std::vector<Index> face, next, previous, vertex;  // [C]; the edge of a corner leads to the next
  std::vector<Index> twin;                          // [C] or -1
};

FaceEdges loops(const Polygons& polygons) {
  FaceEdges edges;
  const auto corners = static_cast<Index>(polygons.corners.size());
  for (auto* list : {&edges.face, &edges.next, &edges.previous, &edges.vertex, &edges.twin})
    list->resize(corners);
  for (Index f = 0; f < polygons.faceCount(); ++f) {
    const Index begin = polygons.faceStart[f], end = polygons.faceStart[f + 1];
    for (Index c = begin; c < end; ++c) {
      edges.face[c] = f;
      edges.next[c] = c + 1 < end ? c + 1 : begin;
      edges.previous[c] = c > begin ? c - 1 : end - 1;
    }
  }
  return edges;
}

std::vector<std::pair<Index, Index>> pairUp(FaceEdges& edges) {
  struct Side {
    Index low, high, corner;
  };
  std::vector<Side> sides;
  edges.twin.assign(edges.vertex.size(), -1);
  for (Index c = 0; c < static_cast<Index>(edges.vertex.size()); ++c) {
    const Index a = edges.vertex[c], b = edges.vertex[edges.next[c]];
    if (a != b) sides.push_back({std::min(a, b), std::max(a, b), c});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  std::vector<std::pair<Index, Index>> cut;
  for (std::size_t k = 0, end; k < sides.size(); k = end) {
    end = k + 1;
    while (end < sides.size() && sides[end].low == sides[k].low && sides[end].high == sides[k].high)
      ++end;
    const auto startsLow = [&](Index c) { return edges.vertex[c] == sides[k].low; };
    if (end - k == 2 && startsLow(sides[k].corner) != startsLow(sides[k + 1].corner)) {
      edges.twin[sides[k].corner] = sides[k + 1].corner;
      edges.twin[sides[k + 1].corner] = sides[k].corner;
    } else if (end - k > 1)
      cut.emplace_back(sides[k].low, sides[k].high);
  }
  return cut;
}

FaceEdges faceEdges(const MeshRig& rig) {
  FaceEdges edges = loops(rig.neutral.polygons);
  for (auto first = weld(rig);;) {
    for (std::size_t c = 0; c < edges.vertex.size(); ++c)
      edges.vertex[c] = first[rig.neutral.polygons.corners[c]];
    if (const auto cut = pairUp(edges); cut.empty() || !takeApart(first, cut)) return edges;
  }
}

constexpr double degree = std::numbers::pi / 180;

// -1 unsound
double shapeScore(const std::array<Vec3, 4>& p) {
  const Vec3 n = normalized(cross(p[2] - p[0], p[3] - p[1]));
  if (n == Vec3{}) return -1e9;
  double worst = 0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 a = p[(k + 1) % 4] - p[k], b = p[(k + 3) % 4] - p[k];
    double angle = std::atan2(dot(cross(a, b), n), dot(a, b)) / degree;
    if (angle < -90) angle += 360;
    if (angle <= 0.5 || angle > 185) return -1e9;
    worst = std::max(worst, std::abs(angle - 90) / 90);
  }
  const Vec3 n1 = cross(p[1] - p[0], p[2] - p[0]), n2 = cross(p[2] - p[0], p[3] - p[0]);
  if (dot(n1, n) <= 0 || dot(n2, n) <= 0) return -1e9;
  const double fold = angleDegrees(n1, n2);
  if (fold > 130) return -1e9;
  return 6 * (0.75 - worst) - fold / 20;
}

}  // namespace

QuadCandidates findQuadCandidates(const MeshRig& rig, std::span<const Index> copies) {
  const Polygons& faces = rig.neutral.polygons;
  const FaceEdges edges = faceEdges(rig);
  QuadCandidates result;
  const auto copy = [&](Index c) {
    const Index v = faces.corners[c];
    return copies.empty() ? v : copies[v];
  };
  const auto texcoord = [&](Index c) {
    const Index t = faces.cornerTexcoords.empty() ? -1 : faces.cornerTexcoords[c];
    return t < 0 ? Vec2{NAN, 0} : faces.texcoords[t];
  };
  const auto sameTexcoord = [&](Index a, Index b) {
    const Vec2 s = texcoord(a), t = texcoord(b);
    return (std::isnan(s.x) && std::isnan(t.x)) || s == t;
  };
  std::vector<Index> candidateAt(edges.twin.size(), -1);
  for (Index c = 0; c < static_cast<Index>(edges.twin.size()); ++c) {
    const Index t = edges.twin[c];
    if (t < 0) continue;
    const Index f = edges.face[c], g = edges.face[t];
    if (f >= g || faces.faceSize(f) != 3 || faces.faceSize(g) != 3) continue;
    if (!faces.faceMaterial.empty() && faces.faceMaterial[f] != faces.faceMaterial[g]) continue;
    if (!faces.faceGroup.empty() && faces.faceGroup[f] != faces.faceGroup[g]) continue;
    if (copy(c) != copy(edges.next[t]) || copy(edges.next[c]) != copy(t)) continue;
    if (!sameTexcoord(c, edges.next[t]) || !sameTexcoord(edges.next[c], t)) continue;
    const Index a = c, b = edges.previous[t], d = edges.next[c], e = edges.previous[c];
    if (edges.vertex[b] == edges.vertex[e] || edges.vertex[b] == edges.vertex[a] ||
        edges.vertex[b] == edges.vertex[d] || edges.vertex[e] == edges.vertex[a] ||
        edges.vertex[e] == edges.vertex[d])
      continue;
    const auto at = [&](Index k) { return rig.neutral.positions[faces.corners[k]]; };
    const double score = shapeScore({at(a), at(b), at(d), at(e)});
    if (score < -1e8) continue;
    candidateAt[c] = candidateAt[t] = static_cast<Index>(result.list.size());
    result.list.push_back({{c, t}});
    result.problem.pairs.push_back({{f, g}, score});
  }
  result.problem.triangles = faces.faceCount();
  std::vector<char> seen(edges.twin.size(), 0);
  const auto angleAt = [&](Index c) {
    const auto at = [&](Index k) { return rig.neutral.positions[faces.corners[k]]; };
    return angleDegrees(at(edges.next[c]) - at(c), at(edges.previous[c]) - at(c));
  };
  const auto walk = [&](Index start, bool closed) {
    PairingProblem::Star star{static_cast<Index>(result.problem.spokes.size()), 0, closed, 4};
    double angle = 0;
    Index c = start;
    do {
      seen[c] = 1;
      result.problem.spokes.push_back(candidateAt[c]);
      angle += angleAt(c);
      const Index in = edges.previous[c];
      c = edges.twin[in];
      if (c < 0) result.problem.spokes.push_back(-1);
    } while (c >= 0 && c != start);
    if (!closed) star.edges = 1 + std::max(1, static_cast<int>(std::lround(angle / 90)));
    star.end = static_cast<Index>(result.problem.spokes.size());
    result.problem.stars.push_back(star);
  };
  for (Index c = 0; c < static_cast<Index>(seen.size()); ++c)
    if (!seen[c] && edges.twin[c] < 0) walk(c, false);
  for (Index c = 0; c < static_cast<Index>(seen.size()); ++c)
    if (!seen[c]) walk(c, true);
  return result;
}

}  // namespace sweepface
