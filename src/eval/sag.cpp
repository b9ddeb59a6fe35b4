#include "eval/sag.hpp"

#include <algorithm>
#include <cmath>

#include "eval/stitching.hpp"
#include "surface/distances.hpp"

namespace sweepface {
namespace {

// An edge in the coordinates of its patch. A side that is a single point has no position along
// itself, so it is met straight across.
struct FlatEdge {
  FlatEdge(const PatchMesh::Point& from, const PatchMesh::Point& to, Vec2 size,
           const std::array<bool, 4>& isPoint)
      : a{from.u.value(), from.v.value()}, b{to.u.value(), to.v.value()} {
    for (const auto& [end, other] : {std::pair(&a, b), std::pair(&b, a)}) {
      if ((isPoint[0] && end->y == 0) || (isPoint[2] && end->y == size.y)) end->x = other.x;
      if ((isPoint[3] && end->x == 0) || (isPoint[1] && end->x == size.x)) end->y = other.y;
    }
  }

  Vec2 a, b;
};

// Errors fall with the square of the number of cuts. Takes half of what that asks for, on a
// logarithmic scale, as the result is measured again, but no step so small that many would follow.
Index somewhatMore(Index count, double tooFar, Index most) {
  const double more = count * std::clamp(std::sqrt(std::sqrt(tooFar)), 1.1, 2.0);
  return std::min(most, std::max(count + 1, static_cast<Index>(more)));
}

}  // namespace

SagMeter::SagMeter(const Surface& surface, std::span<const Vec3> vectors)
    : surface_(surface),
      vectors_(vectors),
      nodes_(surface.wireframe()),
      arcs_(surface.wireframe().arcs.size()),
      measured_(surface.patchCount()) {}

// Uses a numbering that tells the vertices of one patch apart.
PatchMesh SagMeter::stitched(const Density& density, Index patch) {
  const Wireframe& w = surface_.wireframe();
  Index next = nodes_.count;
  for (int s = 0; s < 4; ++s)
    for (const HalfArc h : w.side(patch, s))
      arcs_[arcOf(h)] = std::exchange(next, next + density.arcs[arcOf(h)]);
  return stitch(surface_, density, {nodes_.ofNode, arcs_, next}, patch);
}

// To second order, no point of a triangle is further away than its edges are. An edge inside
// belongs to two triangles, once in each direction, and is measured once. Those around the patch
// belong to the arcs, and are measured with them.
SagMeter::Sag SagMeter::sagOf(const Density& density, Index patch) {
  const PatchMesh mesh = stitched(density, patch);
  const Vec2 size{double(surface_.edgesU(patch)), double(surface_.edgesV(patch))};
  const auto [columns, rows] = density.patches[patch];
  const auto at = [&](Vec2 p) { return surface_.evaluate(vectors_, {patch, p.x, p.y}); };
  std::array<bool, 4> isPoint;
  for (int s = 0; s < 4; ++s)
    isPoint[s] = sideSegments(surface_.wireframe(), density, patch, s) == 0;
  std::vector<Vec3> points;
  for (const auto& [vertex, u, v] : mesh.points) points.push_back(at({u.value(), v.value()}));
  Sag worst;
  for (const auto& triangle : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Index i = triangle[k], j = triangle[(k + 1) % 3];
      if (i > j || mesh.points[i].vertex == mesh.points[j].vertex) continue;
      const auto [a, b] = FlatEdge(mesh.points[i], mesh.points[j], size, isPoint);
      const Vec3 on = at({(a.x + b.x) / 2, (a.y + b.y) / 2});
      const double sag = distanceToSegment(on, points[i], points[j]);
      if (sag > worst.most)
        worst = {sag,
                 {std::abs(b.x - a.x) * columns / size.x, std::abs(b.y - a.y) * rows / size.y}};
    }
  return worst;
}

const SagMeter::Sag& SagMeter::measure(const Density& density, Index patch) {
  const Wireframe& w = surface_.wireframe();
  std::vector<Index> cuts(density.patches[patch].begin(), density.patches[patch].end());
  for (int s = 0; s < 4; ++s)
    for (const HalfArc h : w.side(patch, s)) cuts.push_back(density.arcs[arcOf(h)]);
  std::vector<Measured>& known = measured_[patch];
  const auto found = std::ranges::find(known, cuts, &Measured::cuts);
  if (found != known.end()) return found->sag;
  known.push_back({std::move(cuts), sagOf(density, patch)});
  return known.back().sag;
}

// Refines along the worst edge; never across it, even where refining along it is impossible.
std::array<Index, 2> SagMeter::finer(const Density& density, Index patch, double error) {
  std::array<Index, 2> cells = density.patches[patch];
  const Sag& sag = measure(density, patch);
  if (sag.most <= error) return cells;
  const std::array edges{surface_.edgesU(patch), surface_.edgesV(patch)};
  for (int d = 0; d < 2; ++d)
    if (sag.along[d] >= sag.along[1 - d])
      cells[d] = somewhatMore(cells[d], sag.most / error, mostSegments(edges[d]));
  return cells;
}

void SagMeter::cutSides(Index patch, std::array<Index, 2> cells, Density& density) const {
  const Wireframe& w = surface_.wireframe();
  const std::array edges{surface_.edgesU(patch), surface_.edgesV(patch)};
  for (int s = 0; s < 4; ++s) {
    if (cells[s % 2] == density.patches[patch][s % 2]) continue;
    for (const HalfArc h : w.side(patch, s)) {
      Index& segments = density.arcs[arcOf(h)];
      const auto share = std::int64_t(cells[s % 2]) * w.arcs[arcOf(h)].edges / edges[s % 2];
      segments = std::max(segments, static_cast<Index>(share));
    }
  }
  density.patches[patch] = cells;
}

void SagMeter::refine(Density& density, double error, std::int64_t most) {
  for (bool isFiner = true; isFiner && vertexCountOf(surface_.wireframe(), density) <= most;) {
    isFiner = false;
    Density next = density;
    for (Index p = 0; p < surface_.patchCount(); ++p) {
      const std::array<Index, 2> cells = finer(density, p, error);
      if (cells == density.patches[p]) continue;
      cutSides(p, cells, next);
      isFiner = true;
    }
    refineToShape(surface_, next);
    density = std::move(next);
  }
}

}  // namespace sweepface
