#pragma once

#include <random>

#include "codec/rigs.hpp"
#include "faces.hpp"
#include "layout/layout.hpp"

// Surfaces over mesh layouts, and arbitrary poses that nothing smooths.
namespace sweepface::testing {

/// The surface over a layout. Circular derivations are broken by storing the whole jets of nodes or
/// by extending lines.
inline Surface surfaceOf(Layout& layout) {
  std::set<Index> whole;
  while (true) {
    auto patches = layout.patches().value();
    auto [w, vertexOf] = layout.wireframe(patches);
    for (std::size_t n = 0; n < w.nodes.size(); ++n)
      if (w.nodes[n].point >= 0 && whole.contains(vertexOf[n])) w.nodes[n].stored = kWholeJet;
    std::vector<Index> circle;
    auto surface = Surface::make(w, &circle);
    if (surface || circle.empty()) return surface.value();
    for (Index n : circle)
      if (w.nodes[n].point < 0)
        layout.extend(vertexOf[n]);
      else
        whole.insert(vertexOf[n]);
  }
}

/// The surface over a face's layout after random splits: with T-nodes where `splits` > 0.
inline Surface surfaceOf(const MeshRig& rig, int splits = 0, unsigned seed = 1) {
  const GridMesh mesh = makeGridMesh(rig).value();
  Layout layout(mesh, rig.neutral.positions);
  std::mt19937 random(seed);
  for (int k = 0; k < splits; ++k) {
    const auto patches = layout.patches().value();
    const GridPatch& p = patches[random() % patches.size()];
    const bool alongV = random() % 2 == 0;
    if (const Index n = alongV ? p.m : p.n; n > 1)
      layout.split(p, alongV, 1 + static_cast<Index>(random() % static_cast<unsigned>(n - 1)));
  }
  return surfaceOf(layout);
}

/// A settled pose of arbitrary stored vectors.
inline std::vector<Vec3> anyPose(const Surface& surface, Index from = 0) {
  std::vector<Vec3> vectors(surface.vectorCount());
  for (Index v = 0; v < surface.storedCount(); ++v) vectors[v] = anyVector(from + v);
  surface.settle({vectors.data(), static_cast<std::size_t>(surface.storedCount())}, vectors);
  return vectors;
}

/// Sites all over a patch, including its corners and sides.
inline std::vector<Site> sitesOf(const Surface& surface, Index patch) {
  std::vector<Site> sites;
  for (double a : {0.0, 0.13, 0.5, 0.81, 1.0})
    for (double b : {0.0, 0.29, 0.5, 1.0})
      sites.push_back({patch, a * surface.edgesU(patch), b * surface.edgesV(patch)});
  return sites;
}

inline double largest(const std::vector<Vec3>& vectors) {
  double result = 0;
  for (const Vec3& v : vectors) result = std::max(result, norm(v));
  return result;
}

/// Surfaces of every kind: small hand-made ones, and layouts with and without T-nodes.
inline std::vector<std::pair<std::string, Surface>> everySurface() {
  std::vector<std::pair<std::string, Surface>> list;
  for (const Rig& rig : someRigs())
    list.emplace_back("made by hand " + std::to_string(list.size()), rig.surface);
  for (const Face& face : everyFace())
    for (int splits : {0, 12})
      list.emplace_back(std::string(face.name) + (splits ? " split" : ""),
                        surfaceOf(face.rig, splits));
  return list;
}

}  // namespace sweepface::testing
