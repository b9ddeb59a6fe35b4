#pragma once

#include <cstdint>
#include <vector>

#include "sweepface/surface.hpp"

#include "surface/union_find.hpp"

// What usually holds of a wireframe, and is told only where it does not.
namespace sweepface::codec {

/// The arcs at T-nodes that run straight on: a T-node is where a patch's side has a node inside.
void joinRails(const Wireframe& w, UnionFind& sets);

/// Whether a patch sweeps along the other pair of its sides than the one its loop begins with: the
/// way that joins smaller sets of arcs that share their shape parameters.
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

/// One ribbon a set, numbered by their first arcs.
std::vector<Index> expectedRibbons(const Wireframe& w);

/// One point a node, numbered as the nodes; nodes joined by collapsed arcs share theirs; T-nodes
/// have none.
std::vector<Index> expectedPoints(const Wireframe& w, std::size_t nodes);

/// How many derivatives the lengths of a node's lines speak for, along both of its axes: context
/// for what it stores.
std::uint32_t lineClass(const Wireframe& w, const Connectivity& c, Index node, int axis);

}  // namespace sweepface::codec
