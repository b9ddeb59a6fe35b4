#include <algorithm>
#include <string>

#include "codec/wireframe_rules.hpp"
#include "layout/layout.hpp"

namespace sweepface {

namespace {

// The same patch with its sides renumbered: side 1 becomes side 0.
GridPatch turned(const GridPatch& p) {
  GridPatch t;
  t.m = p.n;
  t.n = p.m;
  for (Index j = 0; j <= t.n; ++j)
    for (Index i = 0; i <= t.m; ++i) t.vertices.push_back(p.vertex(p.m - j, i));
  for (Index j = 0; j < t.n; ++j)
    for (Index i = 0; i < t.m; ++i) {
      const Index old = i * p.m + (p.m - 1 - j);
      t.quads.push_back(p.quads[old]);
      t.bottoms.push_back(nextIn(p.bottoms[old]));
    }
  return t;
}

// The half-edges of a side, in the direction of the patch's loop.
std::vector<HalfEdge> sideOf(const GridPatch& p, int side) {
  std::vector<HalfEdge> edges;
  switch (side) {
    case 0:
      for (Index i = 0; i < p.m; ++i) edges.push_back(p.bottoms[i]);
      break;
    case 1:
      for (Index j = 0; j < p.n; ++j) edges.push_back(nextIn(p.bottoms[(j + 1) * p.m - 1]));
      break;
    case 2:
      for (Index i = p.m; i-- > 0;) edges.push_back(across(p.bottoms[(p.n - 1) * p.m + i]));
      break;
    default:
      for (Index j = p.n; j-- > 0;) edges.push_back(prevIn(p.bottoms[j * p.m]));
  }
  return edges;
}

}  // namespace

Result<std::vector<GridPatch>> Layout::patches() const {
  std::vector<GridPatch> result;
  std::vector<char> seen(mesh_.quads.size(), 0);
  std::size_t covered = 0;
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mark_.size()); ++h) {
    if (seen[h >> 2] || !mark_[h] || !mark_[prevIn(h)]) continue;
    GridPatch p;
    for (HalfEdge row = h;; row = mesh_.twin[across(row)]) {
      for (HalfEdge b = row;; b = nextIn(mesh_.twin[nextIn(b)])) {
        if (seen[b >> 2])
          return fail("the region around face " + std::to_string(h >> 2) + " has no four sides");
        seen[b >> 2] = 1;
        p.bottoms.push_back(b);
        p.quads.push_back(b >> 2);
        if (mark_[nextIn(b)]) break;
      }
      ++p.n;
      if (mark_[across(row)]) break;
    }
    p.m = static_cast<Index>(p.quads.size()) / p.n;
    if (p.m * p.n != static_cast<Index>(p.quads.size()))
      return fail("the region around face " + std::to_string(h >> 2) + " is no grid");
    covered += p.quads.size();
    for (Index j = 0; j <= p.n; ++j)
      for (Index i = 0; i <= p.m; ++i) {
        const HalfEdge b = p.bottoms[std::min(j, p.n - 1) * p.m + std::min(i, p.m - 1)];
        const HalfEdge corner =
            i < p.m ? (j < p.n ? b : prevIn(b)) : (j < p.n ? nextIn(b) : across(b));
        p.vertices.push_back(mesh_.from(corner));
      }
    result.push_back(std::move(p));
  }
  if (covered != mesh_.quads.size())
    return fail("the traced lines leave a region without four sides");
  return result;
}

namespace {

// Cuts the sides of all patches into arcs at the nodes.
struct ArcBuilder {
  const GridMesh& mesh;
  const std::vector<Index>& nodeOf;
  Wireframe& w;
  std::vector<HalfArc> halfArcOf;

  void addSide(const std::vector<HalfEdge>& edges) {
    for (std::size_t k = 0; k < edges.size();) {
      std::size_t end = k + 1;
      while (nodeOf[mesh.from(end < edges.size() ? edges[end] : nextIn(edges[end - 1]))] < 0) ++end;
      if (halfArcOf[edges[k]] < 0) addArc({edges.begin() + k, edges.begin() + end});
      w.loops.push_back(halfArcOf[edges[k]]);
      k = end;
    }
  }

 private:
  void addArc(const std::vector<HalfEdge>& edges) {
    const auto forward = static_cast<HalfArc>(2 * w.arcs.size());
    w.arcs.push_back({nodeOf[mesh.from(edges.front())], nodeOf[mesh.to(edges.back())],
                      static_cast<Index>(edges.size()), 0, mesh.collapsed[edges.front()] != 0});
    for (HalfEdge h : edges) {
      halfArcOf[h] = forward;
      if (mesh.twin[h] >= 0) halfArcOf[mesh.twin[h]] = twin(forward);
    }
  }
};

// Lets patches sweep and curves share ribbons as the codec expects, so that files need not say how.
void chooseSweeps(Wireframe& w, std::vector<GridPatch>& patches) {
  codec::SweepRule rule(w);
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p) {
    if (rule.turns(p, 0)) {
      auto& sides = w.patches[p].sides;
      const Index begin = sides[0], moved = sides[1] - begin;
      std::rotate(w.loops.begin() + begin, w.loops.begin() + sides[1], w.loops.begin() + sides[4]);
      for (int s = 0; s < 3; ++s) sides[s + 1] = sides[s + 2] - moved;
      sides[4] = sides[3] + moved;
      patches[p] = turned(patches[p]);
    }
    rule.sweep(p);
  }
  const std::vector<Index> ribbons = codec::expectedRibbons(w);
  Index count = 0;
  for (std::size_t a = 0; a < w.arcs.size(); ++a) {
    w.arcs[a].ribbon = ribbons[a];
    count = std::max(count, ribbons[a] + 1);
  }
  w.ribbons.assign(count, {});
}

// How many derivatives the source vertices along one line of a node can determine: one stored
// vector for each vertex that lies nearer to this node than to the next that stores any.
int determined(const Wireframe& w, const Connectivity& c, Index node, int axis) {
  const Star& star = c.stars[node];
  double reach[2] = {0.5, 0.5};
  int arms = 0;
  for (std::size_t k = axis; k < star.arms.size() && k < 4; k += 2, ++arms) {
    const Rail rail = c.rails[star.arms[k]];
    reach[arms] =
        c.kinds[w.end(rail.last)] == NodeKind::hanging ? rail.edges - 0.5 : rail.edges / 2.0;
  }
  // Derivatives that only a long side determines would oscillate on a short one.
  constexpr double kUneven = 3;
  const double shorter = std::min(reach[0], reach[1]), longer = std::max(reach[0], reach[1]);
  const double own = arms < 2 ? shorter + longer : shorter + std::min(longer, kUneven * shorter);
  const int count = own < 1.75 ? 1 : own < 2.75 ? 2 : 3;
  return arms < 2 ? std::max(2, count) : count;  // the end of a line has nothing to predict from
}

}  // namespace

std::vector<GridPatch> Layout::glued(std::vector<GridPatch> patches) const {
  std::vector<Index> patchAt(mark_.size(), -1);  // the patch at each half-edge along a side
  std::vector<std::array<HalfEdge, 4>> first(patches.size());
  std::vector<std::vector<HalfEdge>> border(patches.size());
  for (Index p = 0; p < static_cast<Index>(patches.size()); ++p)
    for (int s = 0; s < 4; ++s) {
      const auto side = sideOf(patches[p], s);
      first[p][s] = side.front();
      for (const HalfEdge h : side) patchAt[h] = p;
      border[p].insert(border[p].end(), side.begin(), side.end());
    }
  std::vector<char> placed(patches.size(), 0);
  std::vector<std::size_t> waiting(mark_.size(), SIZE_MAX);  // place of an open edge in the queue
  std::vector<GridPatch> result;
  std::vector<HalfEdge> queue;
  const auto place = [&](Index p) {
    int base = 0;
    for (int s = 1; s < 4; ++s)
      if (waiting[first[p][s]] < waiting[first[p][base]]) base = s;
    placed[p] = 1;
    GridPatch patch = std::move(patches[p]);
    for (int k = 0; k < base; ++k) patch = turned(patch);
    // In the order of the loop, which begins with side `base`.
    const std::size_t size = border[p].size();
    const auto begin = std::ranges::find(border[p], first[p][base]) - border[p].begin();
    for (std::size_t k = 0; k < size; ++k) {
      const HalfEdge other = mesh_.twin[border[p][(static_cast<std::size_t>(begin) + k) % size]];
      if (other < 0 || placed[patchAt[other]]) continue;
      waiting[other] = queue.size();
      queue.push_back(other);
    }
    result.push_back(std::move(patch));
  };
  std::size_t head = 0;
  for (Index p = 0; p < static_cast<Index>(patches.size()); ++p) {
    if (placed[p]) continue;
    place(p);
    for (; head < queue.size(); ++head)
      if (const Index next = patchAt[queue[head]]; !placed[next]) place(next);
  }
  return result;
}

MeshWireframe Layout::wireframe(std::vector<GridPatch>& patches) const {
  patches = glued(std::move(patches));
  Wireframe w;
  std::vector<Index> nodeVertices;
  std::vector<Index> nodeOf(mesh_.vertexCount(), -1), pointOf(mesh_.pointCount(), -1);
  const auto number = [&](Index v) {
    if (nodeOf[v] >= 0 || !isNode(v)) return;
    nodeOf[v] = static_cast<Index>(w.nodes.size());
    Index point = -1;
    if (isFull(v)) {
      Index& p = pointOf[mesh_.point[v]];
      if (p < 0) p = w.points++;
      point = p;
    }
    w.nodes.push_back({point, kPosition});
    nodeVertices.push_back(v);
  };
  for (const GridPatch& p : patches)
    for (int s = 0; s < 4; ++s)
      for (const HalfEdge h : sideOf(p, s)) number(mesh_.from(h));
  ArcBuilder arcs{mesh_, nodeOf, w, std::vector<HalfArc>(mark_.size(), -1)};
  for (const GridPatch& p : patches) {
    Patch patch;
    for (int s = 0; s < 4; ++s) {
      patch.sides[s] = static_cast<Index>(w.loops.size());
      arcs.addSide(sideOf(p, s));
    }
    patch.sides[4] = static_cast<Index>(w.loops.size());
    w.patches.push_back(patch);
  }
  w.ribbons.emplace_back();  // one for all until the sweeps are chosen
  const auto connectivity = Connectivity::make(w);
  if (!connectivity) return {w, nodeVertices};  // Surface::make will say why
  chooseSweeps(w, patches);
  for (Index n = 0; n < static_cast<Index>(w.nodes.size()); ++n) {
    if (connectivity->kinds[n] != NodeKind::crossing) continue;
    const int x = determined(w, *connectivity, n, 0), y = determined(w, *connectivity, n, 1);
    JetMask mask = 0;
    for (int i = 0; i < x; ++i)
      for (int j = 0; j < y && i + j <= 2; ++j) mask |= static_cast<JetMask>(1 << (3 * i + j));
    w.nodes[n].stored = mask;
  }
  return {std::move(w), std::move(nodeVertices)};
}

}  // namespace sweepface
