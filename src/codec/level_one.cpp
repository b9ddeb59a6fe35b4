#include "codec/level_one.hpp"

#include "codec/edge_map.hpp"
#include "codec/fan_walk.hpp"
#include "surface/vertex_numbers.hpp"

namespace sweepface::codec {

namespace {

class Numbering {
 public:
  explicit Numbering(const Surface& surface)
      : surface_(surface), w_(surface.wireframe()), nodes_(w_), count_(nodes_.count) {
    for (const Arc& arc : w_.arcs) {
      arc_.push_back(count_);
      if (!arc.collapsed) count_ += arc.edges - 1;
    }
    for (Index p = 0; p < surface.patchCount(); ++p) {
      patch_.push_back(count_);
      count_ += (surface.edgesU(p) - 1) * (surface.edgesV(p) - 1);
    }
  }

  Index count() const { return count_; }

  // All vertices of a patch in rows of constant v.
  void fill(Index p, std::vector<Index>& grid) const {
    const Index m = surface_.edgesU(p), n = surface_.edgesV(p);
    grid.resize((m + 1) * (n + 1));
    Index inner = patch_[p];
    for (Index j = 1; j < n; ++j)
      for (Index i = 1; i < m; ++i) grid[j * (m + 1) + i] = inner++;
    fillSide(p, 0, &grid[0], 1);
    fillSide(p, 1, &grid[m], m + 1);
    fillSide(p, 2, &grid[n * (m + 1) + m], -1);
    fillSide(p, 3, &grid[n * (m + 1)], -(m + 1));
  }

 private:
  // Fills a side from one corner up to, but not including, the next.
  void fillSide(Index p, int s, Index* at, std::ptrdiff_t stride) const {
    for (const HalfArc h : w_.side(p, s)) {
      const Arc& arc = w_.arcs[arcOf(h)];
      const Index first = nodes_.ofNode[w_.start(h)];
      *at = first;
      at += stride;
      for (Index step = 1; step < arc.edges; ++step, at += stride)
        *at = arc.collapsed ? first : arc_[arcOf(h)] + (h & 1 ? arc.edges - step : step) - 1;
    }
  }

  const Surface& surface_;
  const Wireframe& w_;
  VertexNumbers nodes_;
  Index count_;
  std::vector<Index> arc_, patch_;
};

}  // namespace

LevelOne::LevelOne(const Surface& surface, const Mirror& mirror) {
  const Numbering numbering(surface);
  vertices_ = numbering.count();
  quads_.reserve(surface.wireframe().quadCount());
  std::vector<Index> grid;
  for (Index p = 0; p < surface.patchCount(); ++p) {
    const Index m = surface.edgesU(p), n = surface.edgesV(p);
    numbering.fill(p, grid);
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < m; ++i) {
        const Index* at = &grid[j * (m + 1) + i];
        quads_.push_back({at[0], at[1], at[m + 2], at[m + 1]});
      }
  }
  mirror_ = mirrorGrid(surface, quads_, vertices_, mirror);
}

Neighbours LevelOne::quadNeighbours() const {
  const auto corners = static_cast<Index>(4 * quads_.size());
  const auto at = [&](Index corner, int k) { return quads_[corner / 4][(corner + k) % 4]; };
  std::vector<EdgeMap::Edge> edges;
  edges.reserve(4 * quads_.size());
  for (Index corner = 0; corner < corners; ++corner)
    edges.push_back({at(corner, 0), at(corner, 1)});
  const EdgeMap sides(edges, vertices_);
  Neighbours neighbours;
  neighbours.first.reserve(quads_.size() + 1);
  neighbours.all.reserve(4 * quads_.size());
  for (Index corner = 0; corner < corners; ++corner) {
    // The quad that has the same side in the opposite direction.
    const Index other = sides.find(at(corner, 1), at(corner, 0));
    neighbours.all.push_back(other < 0 ? -1 : other / 4);
    if (corner % 4 == 3) neighbours.first.push_back(corner + 1);
  }
  return neighbours;
}

Neighbours LevelOne::vertexNeighbours() const {
  // Around a vertex counter-clockwise: from each quad's next corner to its last one.
  const Index* const first = quads_.empty() ? nullptr : quads_[0].data();
  const Groups corners({first, 4 * quads_.size()}, static_cast<std::size_t>(vertices_));
  Neighbours neighbours;
  FanWalk walk(static_cast<std::size_t>(vertices_));
  std::vector<FanWalk::Step> steps;
  for (Index v = 0; v < vertices_; ++v) {
    steps.clear();
    for (const Index corner : corners.of(v))
      steps.push_back({quads_[corner / 4][(corner + 1) % 4], quads_[corner / 4][(corner + 3) % 4]});
    walk.around(v, steps, neighbours.all);
    neighbours.first.push_back(static_cast<Index>(neighbours.all.size()));
  }
  return neighbours;
}

}  // namespace sweepface::codec
