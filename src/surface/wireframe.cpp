#include <algorithm>

#include "sweepface/surface.hpp"

#include "surface/creases.hpp"
#include "surface/groups.hpp"

namespace sweepface {

Index Wireframe::sideEdges(Index patch, int s) const {
  Index sum = 0;
  for (HalfArc h : side(patch, s)) sum += arcs[arcOf(h)].edges;
  return sum;
}

std::size_t Wireframe::quadCount() const {
  std::size_t quads = 0;
  for (Index p = 0; p < static_cast<Index>(patches.size()); ++p)
    quads += static_cast<std::size_t>(sideEdges(p, 0)) * sideEdges(p, 1);
  return quads;
}

std::size_t Star::straight() const {
  return std::find(sectors.begin(), sectors.end(), kStraight) - sectors.begin();
}

std::array<HalfArc, 2> Star::line() const {
  const std::size_t k = straight();
  return {arms[(k + 1) % 3], arms[k]};
}

namespace {

Result<void> checkIndices(const Wireframe& w) {
  const auto nodes = static_cast<Index>(w.nodes.size());
  const auto halves = static_cast<Index>(2 * w.arcs.size());
  for (std::size_t a = 0; a < w.arcs.size(); ++a) {
    const Arc& arc = w.arcs[a];
    const auto id = static_cast<Index>(a);
    if (arc.from < 0 || arc.from >= nodes || arc.to < 0 || arc.to >= nodes)
      return fail("arc ", id, " ends at a node that does not exist");
    if (arc.edges < 1) return fail("arc ", id, " has no length");
    if (arc.collapsed && arc.crease)
      return fail("arc ", id, " is one point and cannot be a crease");
    if (arc.ribbon < 0 || arc.ribbon >= static_cast<Index>(w.ribbons.size()))
      return fail("arc ", id, " belongs to a ribbon that does not exist");
  }
  for (std::size_t n = 0; n < w.nodes.size(); ++n)
    if (w.nodes[n].point < -1 || w.nodes[n].point >= w.points)
      return fail("node ", n, " stands at a point that does not exist");
  for (std::size_t p = 0; p < w.patches.size(); ++p) {
    const auto& sides = w.patches[p].sides;
    for (int s = 0; s < 4; ++s)
      if (sides[s] < 0 || sides[s + 1] <= sides[s] ||
          sides[s + 1] > static_cast<Index>(w.loops.size()))
        return fail("patch ", p, " lacks a side");
  }
  for (HalfArc h : w.loops)
    if (h < 0 || h >= halves) return fail("a patch is bounded by an arc that does not exist");
  return {};
}

// Links the half-arcs of every loop and checks that each loop closes and is four-sided.
Result<void> linkLoops(const Wireframe& w, Connectivity& c) {
  const std::size_t halves = 2 * w.arcs.size();
  c.patchOf.assign(halves, -1);
  c.cornerAt.assign(halves, -1);
  c.next.assign(halves, -1);
  c.prev.assign(halves, -1);
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p) {
    const auto& sides = w.patches[p].sides;
    const Index begin = sides[0], size = sides[4] - begin;
    for (Index k = 0; k < size; ++k) {
      const HalfArc h = w.loops[begin + k], g = w.loops[begin + (k + 1) % size];
      if (c.patchOf[h] >= 0) return fail("arc ", arcOf(h), " is used twice in the same direction");
      if (w.end(h) != w.start(g)) return fail("patch ", p, " is not a closed loop of arcs");
      c.patchOf[h] = p;
      c.next[h] = g;
      c.prev[g] = h;
    }
    for (int s = 0; s < 4; ++s) c.cornerAt[w.loops[sides[s]]] = 4 * p + s;
    for (int s = 0; s < 2; ++s)
      if (w.sideEdges(p, s) != w.sideEdges(p, s + 2))
        return fail("patch ", p, " has opposite sides of different length");
  }
  return {};
}

// Groups the half-arcs of the loops by the node that they leave.
Groups leavingEach(const Wireframe& w) {
  std::vector<Index> starts;
  starts.reserve(w.loops.size());
  for (const HalfArc h : w.loops) starts.push_back(w.start(h));
  return Groups(starts, w.nodes.size());
}

// The star of a node; `leaving` holds the positions in the loops of the half-arcs that leave it.
Result<Star> starAt(const Wireframe& w, const Connectivity& c, Index node,
                    std::span<const Index> leaving) {
  Star star;
  if (leaving.empty()) return fail("node ", node, " belongs to no patch");
  star.arms.reserve(leaving.size() + 1);
  star.sectors.reserve(leaving.size());
  HalfArc first = w.loops[leaving[0]];
  for (const Index at : leaving)
    if (c.patchOf[twin(w.loops[at])] < 0) first = w.loops[at];
  HalfArc h = first;
  do {
    star.arms.push_back(h);
    star.sectors.push_back(c.cornerAt[h] >= 0 ? c.cornerAt[h] : kStraight);
    h = twin(c.prev[h]);
  } while (h != first && c.patchOf[h] >= 0 && star.arms.size() <= leaving.size());
  star.closed = h == first;
  if (!star.closed) star.arms.push_back(h);
  if (star.sectors.size() != leaving.size())
    return fail("node ", node, " joins patches that only touch there; give each its own node");
  return star;
}

bool hangsOnCrease(const Wireframe& w, const Star& star) {
  const auto [ahead, behind] = star.line();
  return w.arcs[arcOf(ahead)].crease || w.arcs[arcOf(behind)].crease;
}

Result<NodeKind> kindOf(const Wireframe& w, Index node, const Star& star, bool isCreased) {
  const auto straight = std::count(star.sectors.begin(), star.sectors.end(), kStraight);
  const bool atPole = std::any_of(star.arms.begin(), star.arms.end(),
                                  [&](HalfArc h) { return w.arcs[arcOf(h)].collapsed; });
  if (straight > 0) {
    if (straight > 1 || !star.closed || star.arms.size() != 3)
      return fail("node ", node, " stands on the side of a patch but is no T of three arcs");
    if (hangsOnCrease(w, star))
      return fail("node ", node, " hangs on a crease; run its arc on, or end the crease");
    return NodeKind::hanging;
  }
  if (atPole) return NodeKind::irregular;
  if (isCreased) return NodeKind::creased;
  const std::size_t turns = star.sectors.size();
  return (star.closed ? turns == 4 : turns <= 2) ? NodeKind::crossing : NodeKind::irregular;
}

// The half-arc that runs straight on where `h` arrives at a T-node, or -1 where its rail ends.
HalfArc straightOn(const Wireframe& w, const Connectivity& c, HalfArc h) {
  return c.kinds[w.end(h)] == NodeKind::hanging ? c.opposite(w, twin(h)) : -1;
}

// Adds up every rail from its end, so that the whole takes time linear in the number of arcs.
Result<void> followRails(const Wireframe& w, Connectivity& c) {
  c.rails.assign(2 * w.arcs.size(), {});
  for (HalfArc last = 0; last < static_cast<HalfArc>(2 * w.arcs.size()); ++last) {
    if (straightOn(w, c, last) >= 0) continue;
    Index edges = 0;
    for (HalfArc h = last; h >= 0;) {
      edges += w.arcs[arcOf(h)].edges;
      c.rails[h] = {last, edges};
      const HalfArc before = straightOn(w, c, twin(h));
      h = before < 0 ? -1 : twin(before);
    }
  }
  for (std::size_t h = 0; h < c.rails.size(); ++h)
    if (c.rails[h].last < 0)
      return fail("arc ", h / 2, " lies on a ring of T-nodes; cut it at a node");
  return {};
}

}  // namespace

Result<Connectivity> Connectivity::make(const Wireframe& w) {
  if (auto ok = checkIndices(w); !ok) return std::unexpected(ok.error());
  Connectivity c;
  if (auto ok = linkLoops(w, c); !ok) return std::unexpected(ok.error());

  const Groups leaving = leavingEach(w);
  c.stars.resize(w.nodes.size());
  c.kinds.resize(w.nodes.size());
  c.fans.resize(w.nodes.size());
  c.cornerSector.assign(4 * w.patches.size(), -1);
  c.cornerNode.assign(4 * w.patches.size(), -1);
  for (Index n = 0; n < static_cast<Index>(w.nodes.size()); ++n) {
    auto star = starAt(w, c, n, leaving.of(n));
    if (!star) return std::unexpected(star.error());
    c.fans[n] = fansOf(w, c, *star);
    auto kind = kindOf(w, n, *star, !c.fans[n].empty());
    if (!kind) return std::unexpected(kind.error());
    if ((*kind == NodeKind::hanging) != (w.nodes[n].point < 0))
      return fail("node ", n,
                  (w.nodes[n].point < 0 ? " needs a point of its own"
                                        : " hangs on an arc and must not have a point"));
    for (std::size_t s = 0; s < star->sectors.size(); ++s)
      if (star->sectors[s] != kStraight) {
        c.cornerSector[star->sectors[s]] = static_cast<Index>(s);
        c.cornerNode[star->sectors[s]] = n;
      }
    if (*kind != NodeKind::creased) c.fans[n].clear();
    c.stars[n] = std::move(*star);
    c.kinds[n] = *kind;
  }
  if (auto ok = followRails(w, c); !ok) return std::unexpected(ok.error());
  return c;
}

int Connectivity::opposite(Index node, int arm) const {
  const Star& star = stars[node];
  const int arms = static_cast<int>(star.arms.size());
  const int sectors = static_cast<int>(star.sectors.size());
  if (kinds[node] == NodeKind::irregular || kinds[node] == NodeKind::creased) return -1;
  if (!star.closed) return sectors == 2 && arm != 1 ? 2 - arm : -1;
  int turns = 0;
  for (int k = 0; k < arms; ++k) {
    if (turns == 2) return (arm + k) % arms;
    turns += star.sectors[(arm + k) % sectors] == kStraight ? 2 : 1;
  }
  return -1;
}

HalfArc Connectivity::opposite(const Wireframe& wireframe, HalfArc h) const {
  const Index node = wireframe.start(h);
  const auto& arms = stars[node].arms;
  const int on = opposite(node, static_cast<int>(std::ranges::find(arms, h) - arms.begin()));
  return on < 0 ? -1 : arms[on];
}

}  // namespace sweepface
