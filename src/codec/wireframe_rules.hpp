#pragma once

#include <cstdint>
#include <vector>

#include "sweepface/surface.hpp"

#include "surface/union_find.hpp"

// Rules that usually hold for a wireframe, so that only exceptions are coded.
namespace sweepface::codec {

/// Joins the arcs that run straight on at T-nodes, which are the nodes within a side of a patch.
void joinRails(const Wireframe& w, UnionFind& sets);

/// Whether a patch sweeps along the other pair of sides than the one its loop begins with. The rule
/// chooses the pair that joins the smaller sets of arcs with shared shape parameters.
struct SweepRule {
  explicit SweepRule(const Wireframe& wireframe) : w(wireframe), sets(wireframe.arcs.size()) {
    joinRails(w, sets);
  }
  Index first(Index patch, int s) const { return arcOf(w.side(patch, s & 3)[0]); }
  bool turns(Index patch, int base) {
    const auto cost = [&](int s) {
      const Index a = sets.find(first(patch, base + s)), b = sets.find(first(patch, base + s + 2));
      return a == b ? 0 : sets.size(a) + sets.size(b);
    };
    return cost(1) < cost(0);
  }
  void sweep(Index patch) { sets.join(first(patch, 0), first(patch, 2)); }

  const Wireframe& w;
  UnionFind sets;
};

/// One ribbon for each set of arcs, numbered in the order of their first arcs.
std::vector<Index> expectedRibbons(const Wireframe& w);

/// One point for each node, numbered in the order of nodes. Nodes joined by collapsed arcs share a
/// point; T-nodes have none.
std::vector<Index> expectedPoints(const Wireframe& w);

/// A class of how many derivatives along `axis` the lengths of a node's lines suggest: a context
/// for what the node stores.
std::uint32_t lineClass(const Wireframe& w, const Connectivity& c, Index node, int axis);

}  // namespace sweepface::codec
