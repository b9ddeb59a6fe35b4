#include "codec/grid_mirror.hpp"

namespace sweepface::codec {

namespace {

// The corner of a patch, 4 · patch + corner, that mirrors the first corner of another, or -1.
Index imageOfCorner(const Surface& surface, const Mirror& mirror, Index patch) {
  const Connectivity& c = surface.connectivity();
  const HalfArc image = mirror.halfArc[surface.wireframe().side(patch, 0)[0]];
  if (image < 0 || c.patchOf[twin(image)] < 0) return -1;
  const Index corner = c.cornerAt[c.next[twin(image)]];
  if (corner < 0) return -1;
  const bool turned = corner % 2 == 0;  // u maps to v
  const Index m = surface.edgesU(corner / 4), n = surface.edgesV(corner / 4);
  const bool fits =
      surface.edgesU(patch) == (turned ? n : m) && surface.edgesV(patch) == (turned ? m : n);
  return fits ? corner : -1;
}

}  // namespace

GridMirror mirrorGrid(const Surface& surface, std::span<const std::array<Index, 4>> quads,
                      Index vertices, const Mirror& mirror) {
  std::vector<Index> first{0};  // the first quad of each patch
  for (Index p = 0; p < surface.patchCount(); ++p)
    first.push_back(first.back() + surface.edgesU(p) * surface.edgesV(p));
  GridMirror found{std::vector<Index>(vertices, -1), std::vector<Index>(quads.size(), -1),
                   std::vector<std::uint8_t>(quads.size(), 0)};
  for (Index p = 0; p < surface.patchCount(); ++p) {
    const Index image = imageOfCorner(surface, mirror, p);
    if (image < 0) continue;
    const int turn = image % 4;
    const Index m = surface.edgesU(image / 4), n = surface.edgesV(image / 4);
    for (Index quad = first[p]; quad < first[p + 1]; ++quad) {
      const Index i = (quad - first[p]) % surface.edgesU(p),
                  j = (quad - first[p]) / surface.edgesU(p);
      // i runs back along the side that ends at the corner, j on along the side that begins there.
      const std::array<std::array<Index, 2>, 4> byTurn{
          {{j, i}, {m - 1 - i, j}, {m - 1 - j, n - 1 - i}, {i, n - 1 - j}}};
      const auto [u, v] = byTurn[turn];
      const Index there = first[image / 4] + v * m + u;
      found.quad[quad] = there;
      found.turn[quad] = static_cast<std::uint8_t>(turn);
      for (int k = 0; k < 4; ++k) found.vertex[quads[quad][k]] = quads[there][(turn - k) & 3];
    }
  }
  return found;
}

}  // namespace sweepface::codec
