#include "layout/mirror.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include "sweepface/box.hpp"

#include "mesh/median.hpp"
#include "surface/union_find.hpp"

namespace sweepface {

namespace {

// Points sorted into cells, to find the nearest one within the size of a cell.
class PointGrid {
 public:
  /// Cells are counted from `origin`, so that their numbers stay small wherever the model stands.
  PointGrid(const std::vector<Vec3>& points, const Vec3& origin, double cell)
      : points_(points), origin_(origin), cell_(cell) {
    for (std::size_t p = 0; p < points.size(); ++p)
      cells_[keyOf(points[p])].push_back(static_cast<Index>(p));
  }

  Index nearest(const Vec3& place) const {
    Index found = -1;
    double least = cell_;
    const auto [x, y, z] = keyOf(place);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (const auto cell = cells_.find({x + i, y + j, z + k}); cell != cells_.end())
            for (const Index p : cell->second)
              if (const double d = norm(points_[p] - place); d < least) {
                least = d;
                found = p;
              }
    return found;
  }

 private:
  using Key = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t h = 0;
      for (const std::int64_t k : key) h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15;
      return static_cast<std::size_t>(h ^ h >> 32);
    }
  };
  Key keyOf(const Vec3& p) const {
    const Vec3 way = p - origin_;
    return {std::llround(way.x / cell_), std::llround(way.y / cell_), std::llround(way.z / cell_)};
  }

  const std::vector<Vec3>& points_;
  Vec3 origin_;
  double cell_;
  std::unordered_map<Key, std::vector<Index>, Hash> cells_;
};

double medianEdge(const GridMesh& mesh, const std::vector<Vec3>& points) {
  std::vector<double> lengths;
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mesh.twin.size()); ++h)
    if (!mesh.collapsed[h])
      lengths.push_back(norm(points[mesh.point[mesh.to(h)]] - points[mesh.point[mesh.from(h)]]));
  return median(std::move(lengths));
}

// The image of each point across the best of the three planes; empty if most points have none.
std::vector<Index> imagesOfPoints(const GridMesh& mesh, std::span<const Vec3> positions) {
  std::vector<Vec3> points;
  for (const Index v : mesh.source) points.push_back(positions[v]);
  Box box(points);
  constexpr double kNear = 1e-3;  // of the diagonal
  // No more than an edge, so that a part far away does not put all others into a few cells.
  const double cell = std::min(kNear * norm(box.size()), medianEdge(mesh, points));
  if (!(cell > 0) || !std::isfinite(cell)) return {};
  const PointGrid grid(points, box.low, cell);
  std::vector<Index> best;
  std::ptrdiff_t found = static_cast<std::ptrdiff_t>(points.size()) / 2;
  for (int axis = 0; axis < 3; ++axis) {
    const double twice = coordinate(box.low, axis) + coordinate(box.high, axis);
    std::vector<Index> images;
    for (Vec3 p : points) {
      coordinate(p, axis) = twice - coordinate(p, axis);
      images.push_back(grid.nearest(p));
    }
    for (std::size_t p = 0; p < images.size(); ++p)
      if (images[p] >= 0 && images[images[p]] != static_cast<Index>(p)) images[p] = -1;
    const auto count = std::ranges::count_if(images, [](Index i) { return i >= 0; });
    if (count <= found) continue;
    found = count;
    best = std::move(images);
  }
  return best;
}

using Corners = std::array<Index, 4>;

Corners pointsOf(const GridMesh& mesh, Index quad) {
  Corners points;
  for (int k = 0; k < 4; ++k) points[k] = mesh.point[mesh.quads[quad][k]];
  return points;
}

// Vertices where other than four quads meet, and those on the boundary.
std::vector<char> irregularVertices(const GridMesh& mesh) {
  std::vector<int> quads(mesh.vertexCount(), 0);
  for (const auto& quad : mesh.quads)
    for (const Index v : quad) ++quads[v];
  std::vector<char> irregular;
  for (const int count : quads) irregular.push_back(count != 4);
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mesh.twin.size()); ++h)
    if (mesh.twin[h] < 0) irregular[mesh.from(h)] = irregular[mesh.to(h)] = 1;
  return irregular;
}

// Walks a mesh and its image together: forwards from a half-edge is backwards from its image.
class MirrorWalk {
 public:
  explicit MirrorWalk(const GridMesh& mesh) : mesh_(mesh), mirror_(mesh.twin.size(), -1) {}

  /// Pairs two half-edges and all that they are connected to. Pairs nothing and returns false if
  /// the two sides differ anywhere, or if fewer than half of the pairs are `expected`.
  bool spread(HalfEdge h, HalfEdge g, const std::vector<HalfEdge>& expected) {
    paired_.clear();
    bool same = pair(h, g);
    for (std::size_t k = 0; k < paired_.size() && same; ++k) {
      const HalfEdge here = paired_[k], there = mirror_[here];
      const HalfEdge beyond = mesh_.twin[here], image = mesh_.twin[there];
      same = pair(nextIn(here), prevIn(there)) && (beyond < 0) == (image < 0) &&
             (beyond < 0 || pair(beyond, image));
    }
    const auto met =
        std::ranges::count_if(paired_, [&](HalfEdge e) { return expected[e] == mirror_[e]; });
    if (same && 2 * met >= std::ssize(paired_)) return true;
    for (const HalfEdge e : paired_) {
      mirror_[mirror_[e]] = -1;
      mirror_[e] = -1;
    }
    return false;
  }
  bool has(HalfEdge h) const { return mirror_[h] >= 0; }
  std::vector<HalfEdge> take() { return std::move(mirror_); }

 private:
  bool pair(HalfEdge h, HalfEdge g) {
    if (mirror_[h] >= 0 || mirror_[g] >= 0) return mirror_[h] == g;
    if (mesh_.collapsed[h] != mesh_.collapsed[g]) return false;
    mirror_[h] = g;
    mirror_[g] = h;
    paired_.push_back(h);
    return true;
  }

  const GridMesh& mesh_;
  std::vector<HalfEdge> mirror_, paired_;
};

// Pairs the half-edges of each quad with those of the quad between the images of its corners.
std::vector<HalfEdge> mirrorByPlaces(const GridMesh& mesh, const std::vector<Index>& image) {
  std::vector<HalfEdge> mirror(mesh.twin.size(), -1);
  std::map<Corners, Index> quadAt;
  for (Index q = 0; q < static_cast<Index>(mesh.quads.size()); ++q) {
    Corners key = pointsOf(mesh, q);
    std::ranges::sort(key);
    quadAt.emplace(key, q);
  }
  for (Index q = 0; q < static_cast<Index>(mesh.quads.size()); ++q) {
    Corners key = pointsOf(mesh, q);
    for (Index& p : key) p = image[p];
    std::ranges::sort(key);
    const auto found = quadAt.find(key);
    if (key[0] < 0 || found == quadAt.end()) continue;
    const Corners here = pointsOf(mesh, q), there = pointsOf(mesh, found->second);
    for (int k = 0; k < 4; ++k)
      for (int other = 0; other < 4; ++other)
        if (image[here[k]] == there[(other + 1) % 4] && image[here[(k + 1) % 4]] == there[other])
          mirror[4 * q + k] = 4 * found->second + other;
  }
  return mirror;
}

// A torus has no vertices where lines could begin, and the lines that cut it across on both sides
// would meet nowhere.
void leaveOutTori(const GridMesh& mesh, std::vector<HalfEdge>& mirror) {
  UnionFind components(static_cast<Index>(mesh.quads.size()));
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mirror.size()); ++h) {
    if (mesh.twin[h] >= 0) components.join(h >> 2, mesh.twin[h] >> 2);
    if (mirror[h] >= 0) components.join(h >> 2, mirror[h] >> 2);
  }
  const std::vector<char> irregular = irregularVertices(mesh);
  std::vector<char> anchored(mesh.quads.size(), 0);
  for (Index q = 0; q < static_cast<Index>(mesh.quads.size()); ++q)
    for (const Index v : mesh.quads[q])
      if (irregular[v]) anchored[components.find(q)] = 1;
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mirror.size()); ++h)
    if (!anchored[components.find(h >> 2)]) mirror[h] = -1;
}

}  // namespace

std::vector<HalfEdge> findMirror(const GridMesh& mesh, std::span<const Vec3> positions) {
  const std::vector<Index> image = imagesOfPoints(mesh, positions);
  MirrorWalk walk(mesh);
  if (image.empty()) return walk.take();
  const std::vector<HalfEdge> expected = mirrorByPlaces(mesh, image);
  UnionFind components(static_cast<Index>(mesh.quads.size()));
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(expected.size()); ++h)
    if (mesh.twin[h] >= 0) components.join(h >> 2, mesh.twin[h] >> 2);
  constexpr int kMostTries = 8;  // places may mislead where neighbours lie close together
  std::vector<int> tries(mesh.quads.size(), 0);
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(expected.size()); ++h) {
    if (walk.has(h) || expected[h] < 0 || expected[expected[h]] != h) continue;
    int& tried = tries[components.find(h >> 2)];
    if (tried < kMostTries) tried += !walk.spread(h, expected[h], expected);
  }
  std::vector<HalfEdge> mirror = walk.take();
  leaveOutTori(mesh, mirror);
  return mirror;
}

}  // namespace sweepface
