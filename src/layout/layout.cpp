#include "layout/layout.hpp"

#include <algorithm>
#include <queue>
#include <tuple>

#include "layout/mirror.hpp"

namespace sweepface {

Layout::Layout(const GridMesh& mesh, std::span<const Vec3> positions, bool symmetric)
    : mesh_(mesh),
      mirror_(symmetric ? findMirror(mesh, positions)
                        : std::vector<HalfEdge>(mesh.twin.size(), -1)),
      mark_(mesh.twin.size(), 0) {
  buildRings();
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mesh_.twin.size()); ++h)
    if (mesh_.twin[h] < 0) setMark(h);
  traceFromIrregular(positions);
  cutRings();
}

void Layout::buildRings() {
  const Index vertices = mesh_.vertexCount();
  std::vector<HalfEdge> first(vertices, -1);
  boundary_.assign(vertices, 0);
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mesh_.twin.size()); ++h) {
    const Index v = mesh_.from(h);
    if (first[v] < 0 || mesh_.twin[h] < 0) first[v] = h;
    if (mesh_.twin[h] < 0) boundary_[v] = 1;
  }
  ringStart_.assign(1, 0);
  for (Index v = 0; v < vertices; ++v) {
    HalfEdge h = first[v];
    do {
      ring_.push_back(h);
      h = mesh_.twin[prevIn(h)];
    } while (h >= 0 && h != first[v]);
    ringStart_.push_back(static_cast<Index>(ring_.size()));
  }
}

HalfEdge Layout::arm(Index vertex, int k) const {
  const auto ring = sectors(vertex);
  return k < static_cast<int>(ring.size()) ? ring[k] : prevIn(ring.back());
}

Index Layout::target(Index vertex, int k) const {
  const HalfEdge h = arm(vertex, k);
  return k < static_cast<int>(sectors(vertex).size()) ? mesh_.to(h) : mesh_.from(h);
}

Layout::Arrival Layout::walk(Index vertex, int k) const {
  const auto ring = sectors(vertex);
  const HalfEdge h = arm(vertex, k);
  const bool backwards = k == static_cast<int>(ring.size());
  const Index end = backwards ? mesh_.from(h) : mesh_.to(h);
  const HalfEdge back = backwards ? h : mesh_.twin[h];
  const auto there = sectors(end);
  const auto at = back < 0 ? there.end() : std::find(there.begin(), there.end(), back);
  return {end, static_cast<int>(at - there.begin())};
}

int Layout::opposite(Index vertex, int k) const {
  if (!isRegular(vertex)) return -1;
  if (!boundary_[vertex]) return (k + 2) % 4;
  return k == 1 ? -1 : 2 - k;
}

bool Layout::isRegular(Index v) const {
  const auto ring = sectors(v);
  if (!boundary_[v]) return ring.size() == 4;
  return ring.size() == 2 && mesh_.collapsed[ring[0]] == mesh_.collapsed[prevIn(ring[1])];
}

int Layout::marks(Index vertex) const {
  int count = 0;
  for (int k = 0; k < armCount(vertex); ++k) count += marked(vertex, k);
  return count;
}

bool Layout::isFull(Index v) const {
  if (!isRegular(v)) return true;
  return boundary_[v] ? marked(v, 1) : marks(v) == 4;
}

bool Layout::isNode(Index v) const { return isFull(v) || (!boundary_[v] && marks(v) >= 3); }

Index Layout::beyond(Index vertex, Index neighbour) const {
  if (!isRegular(vertex)) return -1;
  for (int k = 0; k < armCount(vertex); ++k)
    if (target(vertex, k) == neighbour) {
      const int on = opposite(vertex, k);
      return on < 0 ? -1 : target(vertex, on);
    }
  return -1;
}

bool Layout::isUneven(Index v, std::span<const Vec3> positions, double ratio) const {
  const auto place = [&](Index u) { return positions[mesh_.source[mesh_.point[u]]]; };
  for (int k = 0; k < armCount(v); ++k)
    if (const int on = opposite(v, k); on >= 0) {
      const double here = norm(place(target(v, k)) - place(v)),
                   there = norm(place(target(v, on)) - place(v));
      if (here > ratio * there && there > 0) return true;
    }
  return false;
}

void Layout::setMark(HalfEdge h) {
  for (const HalfEdge side : {h, mirror_[h]}) {
    if (side < 0) continue;
    mark_[side] = 1;
    if (mesh_.twin[side] >= 0) mark_[mesh_.twin[side]] = 1;
  }
}

Index Layout::image(Index vertex) const {
  const HalfEdge mirrored = mirror_[sectors(vertex)[0]];
  return mirrored < 0 ? -1 : mesh_.to(mirrored);
}

void Layout::trace(Index vertex, int k) {
  while (!marked(vertex, k)) {
    const Arrival next = walk(vertex, k);
    const bool met = !isRegular(next.vertex) || marks(next.vertex) > 0;
    setMark(arm(vertex, k));
    if (met) return;
    vertex = next.vertex;
    k = opposite(vertex, next.arm);
  }
}

void Layout::traceFromIrregular(std::span<const Vec3> positions) {
  struct Particle {
    double time;
    Index vertex;
    int arm;
    bool operator<(const Particle& b) const {
      return std::tie(time, vertex, arm) > std::tie(b.time, b.vertex, b.arm);
    }
  };
  const auto place = [&](Index v) { return positions[mesh_.source[mesh_.point[v]]]; };
  const auto launch = [&](double time, Index v, int k) {
    return Particle{time + norm(place(target(v, k)) - place(v)), v, k};
  };
  std::priority_queue<Particle> queue;
  for (Index v = 0; v < mesh_.vertexCount(); ++v)
    if (!isRegular(v))
      for (int k = 0; k < armCount(v); ++k)
        if (!marked(v, k)) queue.push(launch(0, v, k));
  while (!queue.empty()) {
    const Particle p = queue.top();
    queue.pop();
    if (marked(p.vertex, p.arm)) continue;
    const Arrival next = walk(p.vertex, p.arm);
    const bool met = !isRegular(next.vertex) || marks(next.vertex) > 0;
    setMark(arm(p.vertex, p.arm));
    if (!met) queue.push(launch(p.time, next.vertex, opposite(next.vertex, next.arm)));
  }
}

// A region without corners is a ring of quads or a whole torus; a line across it cuts it open.
void Layout::cutRings() {
  const auto quads = static_cast<Index>(mesh_.quads.size());
  std::vector<char> settled(quads, 0);
  std::vector<Index> inside(quads, 0);  // the look in which a quad was last found
  Index look = 0;
  for (Index seed = 0; seed < quads; ++seed) {
    if (settled[seed]) continue;
    std::vector<Index> region{seed};
    inside[seed] = ++look;
    HalfEdge border = -1;
    bool corner = false;
    for (std::size_t k = 0; k < region.size(); ++k)
      for (int side = 0; side < 4; ++side) {
        const HalfEdge h = 4 * region[k] + side;
        if (mark_[h]) {
          if (border < 0) border = h;
          corner |= mark_[prevIn(h)] != 0;
        } else if (const Index q = mesh_.twin[h] >> 2; inside[q] != look) {
          inside[q] = look;
          region.push_back(q);
        }
      }
    if (corner) {
      for (Index q : region) settled[q] = 1;
      continue;
    }
    const HalfEdge h = border >= 0 ? prevIn(border) : 4 * seed;  // from the border, or all around
    const HalfEdge out = border >= 0 ? mesh_.twin[h] : h;
    const Index v = mesh_.from(out);
    const auto ring = sectors(v);
    trace(v, static_cast<int>(std::find(ring.begin(), ring.end(), out) - ring.begin()));
    --seed;  // look at what is left of this region again
  }
}

void Layout::split(const GridPatch& patch, bool alongV, Index i) {
  const Index steps = alongV ? patch.n : patch.m;
  for (Index k = 0; k < steps; ++k) {
    const HalfEdge bottom =
        alongV ? patch.bottoms[k * patch.m + i] : patch.bottoms[i * patch.m + k];
    setMark(alongV ? prevIn(bottom) : bottom);
  }
}

void Layout::extend(Index vertex) {
  for (int k = 0; k < armCount(vertex); ++k)
    if (!marked(vertex, k)) return trace(vertex, k);
}

}  // namespace sweepface
