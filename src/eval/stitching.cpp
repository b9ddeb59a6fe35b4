// Triangulates patches of any density: a grid inside, surrounded by strips to the points of the
// four sides, which belong to the arcs.
#include "eval/stitching.hpp"

#include <algorithm>

#include "surface/sorting.hpp"
#include "surface/vertex_numbers.hpp"

namespace sweepface {

Index sideSegments(const Wireframe& w, const Density& density, Index patch, int side) {
  Index count = 0;
  for (const HalfArc h : w.side(patch, side))
    if (!w.arcs[arcOf(h)].collapsed) count += density.arcs[arcOf(h)];
  return count;
}

std::int64_t vertexCountOf(const Wireframe& w, const Density& density) {
  std::int64_t count = VertexNumbers(w).count;
  for (std::size_t a = 0; a < w.arcs.size(); ++a)
    if (!w.arcs[a].collapsed) count += density.arcs[a] - 1;
  for (const auto& [columns, rows] : density.patches)
    count += std::int64_t(columns - 1) * (rows - 1);
  return count;
}

namespace {

// The ends as points or, below 0, nodes without a point.
std::array<Index, 2> endsOf(const Wireframe& w, const Arc& arc) {
  const auto vertex = [&](Index node) {
    const Index point = w.nodes[node].point;
    return point >= 0 ? point : -1 - node;
  };
  const Index a = vertex(arc.from), b = vertex(arc.to);
  return {std::min(a, b), std::max(a, b)};
}

// Is the patch a tube, with two opposite sides that are the same arcs?
bool closesUpon(const Wireframe& w, Index patch, int side) {
  const auto opposite = w.side(patch, side + 2);
  return std::ranges::any_of(w.side(patch, side), [&](HalfArc h) {
    return !w.arcs[arcOf(h)].collapsed &&
           std::ranges::any_of(opposite, [&](HalfArc o) { return arcOf(o) == arcOf(h); });
  });
}

}  // namespace

void refineToShape(const Surface& surface, Density& density) {
  const Wireframe& w = surface.wireframe();
  std::vector<std::array<Index, 3>> arcs;  // by their ends
  for (std::size_t a = 0; a < w.arcs.size(); ++a) {
    if (w.arcs[a].collapsed) continue;
    const auto [first, second] = endsOf(w, w.arcs[a]);
    arcs.push_back({first, second, static_cast<Index>(a)});
    if (first == second) density.arcs[a] = std::max<Index>(density.arcs[a], 3);
  }
  sortSmall(std::span(arcs));
  for (std::size_t k = 1; k < arcs.size(); ++k)
    if (arcs[k][0] == arcs[k - 1][0] && arcs[k][1] == arcs[k - 1][1])
      for (const auto& arc : {arcs[k - 1], arcs[k]})
        density.arcs[arc[2]] = std::max<Index>(density.arcs[arc[2]], 2);
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (int s = 0; s < 2; ++s)
      if (closesUpon(w, p, s)) {
        Index& around = density.patches[p][1 - s];
        around = std::max<Index>(around, 3);
        if (sideSegments(w, density, p, 1 - s) + sideSegments(w, density, p, 3 - s) > 0) continue;
        for (const HalfArc h : w.side(p, s))  // between two poles
          density.arcs[arcOf(h)] = std::max<Index>(density.arcs[arcOf(h)], 2);
      }
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (int s = 0; s < 4; ++s) {
      Index& rows = density.patches[p][s % 2];
      rows = std::max(rows, sideSegments(w, density, p, s));
    }
}

namespace {

using Point = PatchMesh::Point;

Place placeAt(Index step, Index of, Index edges) {
  const auto all = std::int64_t(step) * edges;
  return {static_cast<Index>(all / of), static_cast<Index>(all % of), of};
}
Place fromTheEnd(const Place& p, Index edges) {
  if (p.step == 0) return {edges - p.whole, 0, p.of};
  return {edges - p.whole - 1, p.of - p.step, p.of};
}

/// A row of points of a patch, and how far along it each lies.
struct Line {
  std::vector<Index> points;
  std::vector<double> along;

  Line reversed() const {
    Line line = *this;
    std::ranges::reverse(line.points);
    std::ranges::reverse(line.along);
    for (double& x : line.along) x = -x;
    return line;
  }
};

/// Adds the triangles between two lines that run in the same direction, the second to the left of
/// the first. Always advances on the line whose next point comes first.
void addStrip(const Line& right, const Line& left, PatchMesh& mesh) {
  std::size_t a = 0, b = 0;
  while (a + 1 < right.points.size() || b + 1 < left.points.size()) {
    const bool onRight = b + 1 == left.points.size() ||
                         (a + 1 < right.points.size() && right.along[a + 1] <= left.along[b + 1]);
    if (onRight) {
      mesh.triangles.push_back({right.points[a], right.points[a + 1], left.points[b]});
      ++a;
    } else {
      mesh.triangles.push_back({right.points[a], left.points[b + 1], left.points[b]});
      ++b;
    }
  }
}

// The points of a side from its first corner to its last.
std::vector<Point> sidePoints(const Surface& surface, const Density& density,
                              const Numbering& numbers, Index patch, int side) {
  const Wireframe& w = surface.wireframe();
  const Index m = surface.edgesU(patch), n = surface.edgesV(patch);
  std::vector<Point> points;
  Index before = 0;
  const auto add = [&](Index vertex, Place along) {
    along.whole += before;
    const Place back = fromTheEnd(along, side % 2 == 0 ? m : n);
    if (side == 0) points.push_back({vertex, along, {0, 0, 1}});
    if (side == 1) points.push_back({vertex, {m, 0, 1}, along});
    if (side == 2) points.push_back({vertex, back, {n, 0, 1}});
    if (side == 3) points.push_back({vertex, {0, 0, 1}, back});
  };
  for (const HalfArc h : w.side(patch, side)) {
    const Arc& arc = w.arcs[arcOf(h)];
    const Index segments = density.arcs[arcOf(h)];
    add(numbers.nodes[w.start(h)], {});
    for (Index k = 1; k < segments && !arc.collapsed; ++k)
      add(numbers.arcs[arcOf(h)] + (h & 1 ? segments - k : k) - 1, placeAt(k, segments, arc.edges));
    before += arc.edges;
  }
  add(numbers.nodes[w.end(w.side(patch, side).back())], {});
  return points;
}

}  // namespace

PatchMesh stitch(const Surface& surface, const Density& density, const Numbering& numbers,
                 Index patch) {
  const Index m = surface.edgesU(patch), n = surface.edgesV(patch);
  const auto [columns, rows] = density.patches[patch];
  PatchMesh mesh;
  const auto along = [](const Point& p, int side) {
    const double x = (side % 2 == 0 ? p.u : p.v).value();
    return side < 2 ? x : -x;
  };
  std::array<Line, 4> sides;
  for (int s = 0; s < 4; ++s)
    for (const Point& p : sidePoints(surface, density, numbers, patch, s)) {
      sides[s].points.push_back(static_cast<Index>(mesh.points.size()));
      sides[s].along.push_back(along(p, s));
      mesh.points.push_back(p);
    }
  if (rows == 1) {
    addStrip(sides[0], sides[2].reversed(), mesh);
    return mesh;
  }
  if (columns == 1) {
    addStrip(sides[1], sides[3].reversed(), mesh);
    return mesh;
  }
  const auto first = static_cast<Index>(mesh.points.size());
  for (Index j = 1; j < rows; ++j)
    for (Index i = 1; i < columns; ++i)
      mesh.points.push_back({numbers.inside + (j - 1) * (columns - 1) + i - 1,
                             placeAt(i, columns, m), placeAt(j, rows, n)});
  const auto inner = [&](Index i, Index j) { return first + (j - 1) * (columns - 1) + i - 1; };
  for (int s = 0; s < 4; ++s) {
    Line line;
    const Index count = (s % 2 == 0 ? columns : rows) - 1;
    for (Index k = 1; k <= count; ++k) {
      const Index onward = s < 2 ? k : count + 1 - k;
      const Index p = s == 0   ? inner(onward, 1)
                      : s == 1 ? inner(columns - 1, onward)
                      : s == 2 ? inner(onward, rows - 1)
                               : inner(1, onward);
      line.points.push_back(p);
      line.along.push_back(along(mesh.points[p], s));
    }
    addStrip(sides[s], line, mesh);
  }
  for (Index j = 1; j + 1 < rows; ++j)
    for (Index i = 1; i + 1 < columns; ++i) {
      mesh.triangles.push_back({inner(i, j), inner(i + 1, j), inner(i + 1, j + 1)});
      mesh.triangles.push_back({inner(i, j), inner(i + 1, j + 1), inner(i, j + 1)});
    }
  return mesh;
}

PatchMesh Tessellation::patchMesh(Index patch) const {
  return stitch(*surface_, density_, {nodeVertex_, arcVertex_, patchVertex_[patch]}, patch);
}

namespace {

/// Calls `use` with the three vertices of every triangle that is not degenerate.
template <typename Use>
void eachTriangle(const PatchMesh& mesh, const Use& use) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Index i = mesh.points[a].vertex, j = mesh.points[b].vertex, k = mesh.points[c].vertex;
    if (i != j && j != k && k != i) use(std::array{i, j, k});
  }
}

}  // namespace

// Two patches with two corners in common may have the same edge across; both are then refined.
// Returns whether any was.
bool Tessellation::separateEdges() {
  std::vector<std::array<Index, 3>> edges;  // from, to, patch
  for (Index p = 0; p < surface_->patchCount(); ++p)
    eachTriangle(patchMesh(p), [&](const auto& t) {
      for (int k = 0; k < 3; ++k) edges.push_back({t[k], t[(k + 1) % 3], p});
    });
  sortSmall(std::span(edges));
  std::vector<char> isFiner(density_.patches.size(), 0);
  bool found = false;
  for (std::size_t k = 1; k < edges.size(); ++k)
    if (edges[k][0] == edges[k - 1][0] && edges[k][1] == edges[k - 1][1])
      for (const Index p : {edges[k - 1][2], edges[k][2]})
        if (!std::exchange(isFiner[p], 1)) {
          found = true;
          for (Index& count : density_.patches[p]) ++count;
        }
  return found;
}

std::vector<std::array<Index, 3>> Tessellation::triangles() const {
  std::vector<std::array<Index, 3>> all;
  for (Index p = 0; p < surface_->patchCount(); ++p)
    eachTriangle(patchMesh(p), [&](const auto& t) { all.push_back(t); });
  return all;
}

}  // namespace sweepface
