#pragma once

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "sweepface/codec.hpp"
#include "sweepface/eval.hpp"

// Small hand-made rigs.
namespace sweepface::testing {

inline Arc arc(Index from, Index to, Index edges, Index ribbon) {
  return {from, to, edges, ribbon, false};
}

/// A patch of m × n quads. Ribbon 0 runs along u, ribbon 1 along v.
inline Wireframe onePatch(Index m, Index n) {
  Wireframe w;
  w.points = 4;
  for (Index k = 0; k < 4; ++k) w.nodes.push_back({k, kWholeJet});
  w.arcs = {arc(0, 1, m, 0), arc(1, 2, n, 1), arc(3, 2, m, 0), arc(3, 0, n, 1)};
  w.patches = {{{0, 1, 2, 3, 4}}};
  w.loops = {0, 2, 5, 6};
  w.ribbons = {{}, {1, -0.5, 0.25}};
  return w;
}

/// Two patches side by side along u that share an arc.
inline Wireframe twoPatches() {
  Wireframe w;
  w.points = 6;
  for (Index k = 0; k < 6; ++k) w.nodes.push_back({k, kPosition});
  // 3 --- 4 --- 5
  // |     |     |
  // 0 --- 1 --- 2
  w.arcs = {arc(0, 1, 3, 0), arc(1, 2, 2, 0), arc(3, 4, 3, 0), arc(4, 5, 2, 0),
            arc(0, 3, 2, 1), arc(1, 4, 2, 1), arc(2, 5, 2, 1)};
  w.patches = {{{0, 1, 2, 3, 4}}, {{4, 5, 6, 7, 8}}};
  w.loops = {0, 10, 5, 9, 2, 12, 7, 11};
  w.ribbons = {{}, {}};
  return w;
}

/// n × n patches of one quad each.
inline Wireframe sheet(Index n) {
  Wireframe w;
  const auto node = [n](Index x, Index y) { return y * (n + 1) + x; };
  const auto right = [n](Index x, Index y) { return 2 * (y * n + x); };
  const auto up = [n](Index x, Index y) { return 2 * (n * (n + 1) + y * (n + 1) + x); };
  for (Index k = 0; k < (n + 1) * (n + 1); ++k) w.nodes.push_back({k, kPosition});
  w.points = static_cast<Index>(w.nodes.size());
  for (Index y = 0; y <= n; ++y)
    for (Index x = 0; x < n; ++x) w.arcs.push_back(arc(node(x, y), node(x + 1, y), 1, 0));
  for (Index y = 0; y < n; ++y)
    for (Index x = 0; x <= n; ++x) w.arcs.push_back(arc(node(x, y), node(x, y + 1), 1, 1));
  for (Index y = 0; y < n; ++y)
    for (Index x = 0; x < n; ++x) {
      const auto start = static_cast<Index>(w.loops.size());
      w.patches.push_back({{start, start + 1, start + 2, start + 3, start + 4}});
      for (HalfArc h : {right(x, y), up(x + 1, y), right(x, y + 1) + 1, up(x, y) + 1})
        w.loops.push_back(h);
    }
  w.ribbons = {{}, {}};
  return w;
}

/// A patch whose side 3 is collapsed: a slice of a fan.
inline Wireframe slice() {
  Wireframe w = onePatch(3, 2);
  w.points = 3;
  w.nodes[3].point = 0;
  w.nodes[1].point = 1, w.nodes[2].point = 2;
  w.arcs[3].collapsed = true;
  return w;
}

/// Two patches above one, with a T-node between them.
inline Wireframe tee() {
  Wireframe w;
  w.points = 7;
  for (Index point : {0, 1, 2, -1, 3, 4, 5, 6}) w.nodes.push_back({point, kPosition});
  // 5 --- 6 --- 7
  // |     |     |
  // 2 --- 3 --- 4
  // |           |
  // 0 --------- 1
  w.arcs = {arc(0, 1, 4, 0), arc(2, 3, 2, 0), arc(3, 4, 2, 0), arc(5, 6, 2, 0), arc(6, 7, 2, 0),
            arc(0, 2, 1, 1), arc(1, 4, 1, 1), arc(2, 5, 1, 1), arc(3, 6, 1, 1), arc(4, 7, 1, 1)};
  w.patches = {{{0, 1, 2, 4, 5}}, {{5, 6, 7, 8, 9}}, {{9, 10, 11, 12, 13}}};
  w.loops = {0, 12, 5, 3, 11, 2, 16, 7, 15, 4, 18, 9, 17};
  w.ribbons = {{}, {}};
  return w;
}

/// A closed fan of slices around a pole.
inline Wireframe fan(Index slices) {
  Wireframe w;
  w.points = 1 + slices;
  for (Index k = 0; k < slices; ++k) w.nodes.push_back({0, kPosition});
  for (Index k = 0; k < slices; ++k) w.nodes.push_back({1 + k, kPosition});
  for (Index k = 0; k < slices; ++k) {
    const Index next = (k + 1) % slices;
    w.arcs.push_back({k, next, 1, 1, true});
    w.arcs.push_back(arc(k, slices + k, 2, 0));
    w.arcs.push_back(arc(slices + k, slices + next, 1, 1));
  }
  for (Index k = 0; k < slices; ++k) {
    const Index next = (k + 1) % slices, start = 4 * k;
    w.patches.push_back({{start, start + 1, start + 2, start + 3, start + 4}});
    for (HalfArc h : {2 * (3 * k + 1), 2 * (3 * k + 2), 2 * (3 * next + 1) + 1, 2 * (3 * k) + 1})
      w.loops.push_back(h);
  }
  w.ribbons = {{}, {}};
  return w;
}

/// `valence` patches around node 0; arc 3k leads out of it, with patch k on its left.
inline Wireframe wheel(Index valence, const std::set<Index>& creases = {}) {
  Wireframe w;
  w.points = 1 + 2 * valence;
  for (Index k = 0; k < w.points; ++k) w.nodes.push_back({k, kWholeJet});
  for (Index k = 0; k < valence; ++k) {
    const Index out = 1 + k, corner = 1 + valence + k, next = 1 + (k + 1) % valence;
    w.arcs.push_back(arc(0, out, 2, 0));
    w.arcs.push_back(arc(out, corner, 2, 0));
    w.arcs.push_back(arc(corner, next, 2, 0));
    w.arcs[3 * k].crease = creases.contains(k);
  }
  for (Index k = 0; k < valence; ++k) {
    w.patches.push_back({{4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3, 4 * k + 4}});
    for (HalfArc h : {6 * k, 6 * k + 2, 6 * k + 4, 6 * ((k + 1) % valence) + 1})
      w.loops.push_back(h);
  }
  w.ribbons = {{}};
  return w;
}

/// Some number between -2 and 2 that single precision holds exactly.
inline double anything(Index k) { return std::round(std::sin(1.7 * k) * 2048) / 1024; }
inline Vec3 anyVector(Index k) {
  return {anything(3 * k), anything(3 * k + 1), anything(3 * k + 2)};
}

/// A source with the vertices and faces of the surface at level 1, the vertices in reverse order.
inline SourceMesh makeSource(const Surface& surface) {
  SourceMesh source;
  const Tessellation grid(surface, 1);
  const Index last = grid.vertexCount() - 1;
  for (Index v = 0; v <= last; ++v) source.gridVertex.push_back(last - v);
  Polygons& faces = source.polygons;
  for (const auto& face : grid.faces()) {
    const auto start = static_cast<Index>(faces.corners.size());
    for (Index v : face) faces.corners.push_back(last - v);
    for (Index k = 0; k < 4; ++k) source.quadCorners.push_back(start + (k + faces.faceCount()) % 4);
    faces.faceStart.push_back(start + 4);
  }
  return source;
}

/// A rig with a neutral, a source and the targets open (moves everything), wink (some vectors) and
/// rest (nothing).
inline Rig makeRig(Wireframe wireframe) {
  Rig rig;
  rig.surface = Surface::make(std::move(wireframe)).value();
  const Index count = rig.surface.storedCount();
  for (Index v = 0; v < count; ++v) rig.neutral.push_back(anyVector(v));
  rig.targets = {{"open", {}, {}}, {"wink \xC3\xA9", {}, {}}, {"rest", {}, {}}};
  for (Index v = 0; v < count; ++v) {
    rig.targets[0].difference.push_back(anyVector(v + 100));
    rig.targets[1].difference.push_back(v % 4 == 1 ? anyVector(v + 200) : Vec3{});
    rig.targets[2].difference.push_back({});
  }
  rig.source = makeSource(rig.surface);
  rig.tolerance = 0.0123;
  return rig;
}

/// Adds texture coordinates, materials, groups and two loose vertices.
inline Rig dressed(Rig rig) {
  SourceMesh& source = rig.source;
  Polygons& faces = source.polygons;
  for (std::size_t c = 0; c < faces.corners.size(); ++c) {
    faces.texcoords.push_back({0.25 * static_cast<double>(c), 0.1});
    faces.cornerTexcoords.push_back(c % 5 == 0 ? -1 : static_cast<Index>(c));
  }
  faces.materials = {"skin", ""};
  faces.groups = {"head"};
  faces.materialFiles = {"a face.mtl"};
  for (Index f = 0; f < faces.faceCount(); ++f) {
    faces.faceMaterial.push_back(f % 3 - 1);
    faces.faceGroup.push_back(0);
  }
  source.gridVertex.push_back(-1);
  source.gridVertex.push_back(-2);
  source.loose = {{1.0 / 3, 0.2, 0.3}, {4, 5, 6}};
  for (Target& target : rig.targets) target.looseDifference = {{}, {0.5, 0, 1e-9}};
  rig.targets[2].looseDifference = {{}, {}};
  return rig;
}

/// Adds a scene. Its content does not matter here.
inline Rig withScene(Rig rig) {
  rig.scene = std::string("glTF\0\x02 anything", 15);
  return rig;
}

/// Makes two of its targets turn, one about an axis and one about a ball.
inline Rig withTurns(Rig rig) {
  rig.turns = {{0, {1, -2, 0.5}, {0, 0.6000000238418579, 0.800000011920929}}, {1, {0, 4, 8}, {}}};
  return rig;
}

/// Small rigs of every kind.
inline std::vector<Rig> someRigs() {
  return {makeRig(onePatch(1, 1)),
          makeRig(onePatch(3, 2)),
          makeRig(twoPatches()),
          makeRig(slice()),
          makeRig(tee()),
          makeRig(fan(4)),
          dressed(makeRig(onePatch(2, 3))),
          dressed(makeRig(twoPatches())),
          dressed(makeRig(slice())),
          withScene(makeRig(onePatch(1, 1))),
          withScene(dressed(makeRig(onePatch(2, 3)))),
          withTurns(dressed(makeRig(onePatch(2, 3))))};
}

inline void expectEqual(const Polygons& a, const Polygons& b) {
  EXPECT_EQ(a.faceStart, b.faceStart);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.texcoords, b.texcoords);
  EXPECT_EQ(a.cornerTexcoords, b.cornerTexcoords);
  EXPECT_EQ(a.materials, b.materials);
  EXPECT_EQ(a.faceMaterial, b.faceMaterial);
  EXPECT_EQ(a.groups, b.groups);
  EXPECT_EQ(a.faceGroup, b.faceGroup);
  EXPECT_EQ(a.materialFiles, b.materialFiles);
}

inline void expectEqual(const Rig& a, const Rig& b) {
  EXPECT_EQ(a.surface.wireframe(), b.surface.wireframe());
  EXPECT_EQ(a.neutral, b.neutral);
  EXPECT_EQ(a.targets, b.targets);
  EXPECT_EQ(a.tolerance, b.tolerance);
  EXPECT_EQ(a.scene, b.scene);
  EXPECT_EQ(a.names, b.names);
  EXPECT_EQ(a.turns, b.turns);
  EXPECT_EQ(a.source.gridVertex, b.source.gridVertex);
  EXPECT_EQ(a.source.loose, b.source.loose);
  EXPECT_EQ(a.source.quadCorners, b.source.quadCorners);
  expectEqual(a.source.polygons, b.source.polygons);
}

}  // namespace sweepface::testing
