#include "mesh/quad_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesh/face_edges.hpp"

namespace sweepface {

namespace {

// The limits of sound quads, in degrees. Artists' quads have corners that are not quite convex.
constexpr double smallestCorner = 0.5, largestCorner = 185, sharpestFold = 130;

// Logarithms of odds, found by trial on three quad meshes cut in four ways and shuffled.
constexpr double rightCorners = 2.25;  // for a quad of right angles
constexpr double cornerCost = 3;       // of the worst corner, for each 90° off
constexpr double foldCost = 6;         // for each 90° between the halves
constexpr double valenceCost = 4;      // of each edge too many or too few at a vertex
constexpr double bendCost = 3;         // of an edge loop, for each 90° at a vertex
constexpr double loneCost = 4;         // of a triangle left over
constexpr int mostSpokes = 12;         // larger stars are poles, where anything goes

class Finder {
 public:
  Finder(const MeshRig& rig, std::span<const Index> copies, std::span<const Index> parts)
      : faces_(rig.neutral.polygons),
        positions_(rig.neutral.positions),
        copies_(copies),
        parts_(parts),
        edges_(faceEdges(rig)),
        pairAt_(edges_.twin.size(), -1) {}

  QuadCandidates find() {
    result_.problem.triangles = faces_.faceCount();
    result_.problem.loneCost = loneCost;
    const auto corners = static_cast<Index>(edges_.twin.size());
    for (Index c = 0; c < corners; ++c)
      if (edges_.twin[c] >= 0 && edges_.face[c] < edges_.face[edges_.twin[c]]) consider(c);
    std::vector<char> seen(edges_.twin.size(), 0);
    for (bool closed : {false, true})  // open stars begin where there is no face before
      for (Index c = 0; c < corners; ++c)
        if (!seen[c] && (closed || edges_.twin[c] < 0)) addStar(c, closed, seen);
    return std::move(result_);
  }

 private:
  void consider(Index c) {
    const Index t = edges_.twin[c];
    if (!alike(edges_.face[c], edges_.face[t]) || !sameCorner(c, edges_.next[t]) ||
        !sameCorner(edges_.next[c], t))
      return;
    const auto score = shapeScore({c, edges_.previous[t], edges_.next[c], edges_.previous[c]});
    if (!score) return;
    pairAt_[c] = pairAt_[t] = static_cast<Index>(result_.corners.size());
    result_.corners.push_back({c, t});
    result_.problem.pairs.push_back({{edges_.face[c], edges_.face[t]}, *score});
  }

  bool alike(Index f, Index g) const {
    const auto same = [&](std::span<const Index> list) {
      return list.empty() || list[f] == list[g];
    };
    return faces_.faceSize(f) == 3 && faces_.faceSize(g) == 3 && same(faces_.faceMaterial) &&
           same(faces_.faceGroup) && same(parts_);
  }

  // False where a seam runs along the edge.
  bool sameCorner(Index a, Index b) const {
    const auto vertex = [&](Index c) {
      return copies_.empty() ? faces_.corners[c] : copies_[faces_.corners[c]];
    };
    const auto texcoord = [&](Index c) -> std::optional<Vec2> {
      const Index t = faces_.cornerTexcoords.empty() ? -1 : faces_.cornerTexcoords[c];
      return t < 0 ? std::nullopt : std::optional(faces_.texcoords[t]);
    };
    return vertex(a) == vertex(b) && texcoord(a) == texcoord(b);
  }

  const Vec3& at(Index corner) const { return positions_[faces_.corners[corner]]; }

  // The score of the quad between four face corners, the first and third of which are on the
  // diagonal; nothing if it would not be sound.
  std::optional<double> shapeScore(const std::array<Index, 4>& quad) const {
    for (int k = 0; k < 4; ++k)
      for (int l = 0; l < k; ++l)
        if (edges_.vertex[quad[k]] == edges_.vertex[quad[l]]) return {};
    const auto p = [&](int k) { return at(quad[k % 4]); };
    const Vec3 first = cross(p(2) - p(0), p(3) - p(0)), second = cross(p(1) - p(0), p(2) - p(0));
    const Vec3 normal = normalized(first + second);
    const double fold = angleDegrees(first, second);
    if (!(dot(first, normal) > 0 && dot(second, normal) > 0 && fold <= sharpestFold)) return {};
    double worst = 0;
    for (int k = 0; k < 4; ++k) {
      const double corner = angleAround(normal, p(k + 1) - p(k), p(k + 3) - p(k));
      if (!(corner >= smallestCorner && corner <= largestCorner)) return {};
      worst = std::max(worst, std::abs(corner - 90));
    }
    return rightCorners - cornerCost * worst / 90 - foldCost * fold / 90;
  }

  // Degrees from a to b; a clockwise turn of up to 90 is negative, more counts on from 180.
  static double angleAround(const Vec3& axis, const Vec3& a, const Vec3& b) {
    const double height = dot(cross(a, b), axis);
    const double angle = angleDegrees({1, 0, 0}, {dot(a, b), height, 0});
    return height >= 0 ? angle : angle > 90 ? 360 - angle : -angle;
  }

  void addStar(Index start, bool closed, std::vector<char>& seen) {
    auto& problem = result_.problem;
    PairingProblem::Star star;
    star.firstSpoke = static_cast<Index>(problem.spokes.size());
    star.firstChoice = static_cast<Index>(problem.choices.size());
    std::vector<double> direction;  // of the spokes, in degrees, with the faces laid out flat
    double turned = 0;
    Index c = start;
    do {
      seen[c] = 1;
      problem.spokes.push_back(pairAt_[c]);
      direction.push_back(turned);
      const Index last = edges_.previous[c];
      turned += angleDegrees(at(edges_.next[c]) - at(c), at(last) - at(c));
      c = edges_.twin[last];
    } while (c >= 0 && c != start);
    if (!closed) {
      problem.spokes.push_back(-1);
      direction.push_back(turned);
    } else if (turned > 0) {
      for (double& d : direction) d *= 360 / turned;
    }
    star.endSpoke = static_cast<Index>(problem.spokes.size());
    if (direction.size() <= mostSpokes) addChoices(star, direction, turned, closed);
    star.endChoice = static_cast<Index>(problem.choices.size());
    problem.stars.push_back(star);
  }

  void addChoices(const PairingProblem::Star& star, const std::vector<double>& direction,
                  double turned, bool closed) {
    const auto size = direction.size();
    unsigned possible = 0;
    for (std::size_t k = 0; k < size; ++k)
      if (result_.problem.spokes[star.firstSpoke + static_cast<Index>(k)] >= 0) possible |= 1u << k;
    const int wanted = closed ? 4 : 1 + std::max(1, static_cast<int>(std::lround(turned / 90)));
    std::vector<double> edges;
    for (unsigned diagonals = 0; diagonals < 1u << size; ++diagonals) {
      const unsigned following = diagonals >> 1 | (closed ? (diagonals & 1) << (size - 1) : 0);
      if (diagonals & ~possible || diagonals & following) continue;
      edges.clear();
      for (std::size_t k = 0; k < size; ++k)
        if (!(diagonals >> k & 1)) edges.push_back(direction[k]);
      if (closed && edges.size() < 3 && diagonals != 0) continue;  // quads that share two edges
      double score = -valenceCost * std::abs(static_cast<int>(edges.size()) - wanted);
      if (closed && edges.size() == 4)
        score -= bendCost / 90 *
                 (std::abs(edges[2] - edges[0] - 180) + std::abs(edges[3] - edges[1] - 180));
      result_.problem.choices.push_back({static_cast<std::uint16_t>(diagonals), score});
    }
  }

  const Polygons& faces_;
  const std::vector<Vec3>& positions_;
  std::span<const Index> copies_, parts_;
  FaceEdges edges_;
  std::vector<Index> pairAt_;  // [C] the pair over the edge that begins at a corner, or -1
  QuadCandidates result_;
};

}  // namespace

QuadCandidates findQuadCandidates(const MeshRig& rig, std::span<const Index> copies,
                                  std::span<const Index> parts) {
  return Finder(rig, copies, parts).find();
}

}  // namespace sweepface
