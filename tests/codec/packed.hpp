#pragma once

#include <cmath>
#include <random>

#include "codec/bones.hpp"
#include "codec/lattice.hpp"
#include "codec/rigs.hpp"

namespace sweepface::testing {

/// The rig with its vectors and texture coordinates rounded to the steps of a file.
inline Rig packed(Rig rig) {
  rig.packing.neutralStep = 0.01;
  rig.packing.targetStep = 0.02;
  rig.packing.textureBits = 12;
  rig.packing.poses.resize(rig.targets.size() + 1);
  codec::Lattice lattice(rig.surface, rig.packing);
  codec::Bones bones;
  for (Index pose = 0; pose < static_cast<Index>(rig.packing.poses.size()); ++pose) {
    std::vector<Vec3>& vectors = pose == 0 ? rig.neutral : rig.targets[pose - 1].difference;
    const double step = codec::stepOf(rig.packing, pose);
    const auto& carries = rig.packing.poses[pose].carries;
    lattice.restore(pose, lattice.round(pose, bones.beyond(carries, vectors), step), step, vectors);
    bones.add(carries, 1, vectors);
    if (pose > 0) continue;
    lattice.learn(rig.surface, vectors, step);
    bones = codec::Bones(rig.surface, rig.packing, vectors);
  }
  for (Vec2& t : rig.source.polygons.texcoords)
    t = {std::round(t.x * 4096) / 4096, std::round(t.y * 4096) / 4096};
  return rig;
}

/// Adds two bones that carry some of the nodes, in two of the targets.
inline void addBones(Rig& rig) {
  for (Index v = 0; v < rig.surface.storedCount(); ++v) {
    const Index node = rig.surface.stored(v).node;
    rig.packing.bones.push_back(node < 2 ? 0 : node == 5 ? 1 : -1);
  }
  rig.packing.poses.resize(rig.targets.size() + 1);
  rig.packing.poses[1].carries = {{0, {{{100, -2, 0}, {0, 3, -50}, {7, 0, 0}, {1, 1, -1}}}},
                                  {1, {{{-9, 0, 4}, {0, 0, 0}, {0, 0, 0}, {0, 0, 12345}}}}};
  rig.packing.poses[2].carries = {{1, {{{1, 2, 3}, {0, 5, 0}, {0, 0, 0}, {-8, 0, 0}}}}};
}

/// A rig with some of everything that files hold.
inline Rig everything() {
  Wireframe wireframe = twoPatches();
  for (Arc& arc : wireframe.arcs) arc.edges = 2;
  wireframe.nodes[4].stored = 1 | 1 << 1 | 1 << 3;
  wireframe.ribbons[1] = {1, -3.0 / 4, 5.0 / 16};
  Rig rig = withScene(dressed(makeRig(wireframe)));
  rig.packing.mirror = {{0, 2}};
  rig.packing.poses = {{0, 0}, {1, -1}, {0, 1}, {0, 3}};
  addBones(rig);
  rig.names = {"cm", {}, {"brow", "", "", "", "", "", ""}, {}, {}};
  rig = packed(std::move(rig));
  rig.targets[1].difference[2].x = 1.0 / 3;  // not a multiple of any step
  return rig;
}

/// The vertices of the source in another order.
inline void shuffle(SourceMesh& source) {
  std::mt19937 random(5);
  std::vector<Index> place;  // [vertices] where each goes
  for (Index v = 0; v < static_cast<Index>(source.gridVertex.size()); ++v) {
    place.push_back(v);
    std::swap(place[v], place[random() % (v + 1u)]);
  }
  const std::vector<Index> before = source.gridVertex;
  for (std::size_t v = 0; v < before.size(); ++v) source.gridVertex[place[v]] = before[v];
  for (Index& corner : source.polygons.corners) corner = place[corner];
}

// What lies beyond the numbers at which the format's searches end.

/// One target that moves a little, and no source.
inline Rig small(Wireframe wireframe) {
  Rig rig = makeRig(std::move(wireframe));
  rig.targets = {rig.targets[1]};
  for (Vec3& v : rig.neutral) v = 0.02 * v;
  for (Vec3& v : rig.targets[0].difference) v = 0.04 * v;
  rig.source = {};
  return packed(std::move(rig));
}

/// A site of more nodes than a search for near sites goes on from.
inline Rig spokes() { return small(fan(200)); }

/// A node of more arms than wait in such a search.
inline Rig hub() {
  Wireframe wireframe = wheel(900);
  for (Node& node : wireframe.nodes) node.stored = kPosition;
  for (Arc& arc : wireframe.arcs) {
    arc.edges = 1;
    for (Index* node : {&arc.from, &arc.to})
      if (*node > 0) *node = wireframe.points - *node;  // so that the last arm leads to the first
  }
  return small(std::move(wireframe));
}

/// Vertices in no order, so that many neighbour one of which the trail has just lost sight.
inline Rig disorder() {
  Rig rig = makeRig(sheet(12));
  rig.targets.clear();
  shuffle(rig.source);
  return packed(std::move(rig));
}

}  // namespace sweepface::testing
