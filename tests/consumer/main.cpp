// A small program that uses an installed Sweepface: one bicubic-looking patch, bent and evaluated.
#include <cmath>
#include <sweepface/eval.hpp>
#include <sweepface/motion.hpp>

using namespace sweepface;

// A flat square patch, one edge a side: four corner nodes, four arcs.
Wireframe square() {
  Wireframe w;
  w.points = 4;
  for (Index k = 0; k < 4; ++k) {
    w.nodes.push_back({k, kWholeJet});
    w.arcs.push_back({k, (k + 1) % 4, 1, 0, false});
    w.loops.push_back(2 * k);
  }
  w.patches.push_back({{0, 1, 2, 3, 4}});
  w.ribbons.push_back({});
  return w;
}

int main() {
  const auto surface = Surface::make(square());
  if (!surface) return 1;
  std::vector<Vec3> vectors(surface->vectorCount());
  const Vec3 corners[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (Index v = 0; v < surface->storedCount(); ++v)
    if (const StoredVector& s = surface->stored(v); s.i == 0 && s.j == 0)
      vectors[v] = corners[s.node];
  surface->settle({vectors.data(), static_cast<std::size_t>(surface->storedCount())}, vectors);
  const Tessellation mesh(*surface, 4);
  const auto positions = mesh.positions(vectors);
  const bool covers =
      mesh.vertexCount() == 25 && norm(positions[mesh.vertex(0, 2, 2)] - Vec3{0.5, 0.5, 0}) < 1e-12;
  return covers && progress(TimeLaw::newton, 0.5).position == 0.25 ? 0 : 1;
}
