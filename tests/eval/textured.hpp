#pragma once

#include <functional>
#include <numeric>

#include "sweepface/eval.hpp"

#include "codec/rigs.hpp"

// Helpers for sources with texture coordinates.
namespace sweepface::testing {

inline std::vector<Vec3> neutralOf(const Rig& rig, const Tessellation& grid) {
  return sourcePositions(rig, grid, blend(rig, {}), {});
}

/// A rig whose surface is a planar sheet of n × n unit quads.
inline Rig plainSheet(Index n = 2) {
  Rig rig;
  rig.surface = Surface::make(onePatch(n, n)).value();
  rig.neutral.resize(rig.surface.storedCount());
  const double size = n;
  const Vec3 corners[4] = {{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, 0}};
  for (Index v = 0; v < rig.surface.storedCount(); ++v) {
    const StoredVector& s = rig.surface.stored(v);
    if (s.i == 0 && s.j == 0) rig.neutral[v] = corners[s.node];
    if (s.i + s.j == 1) {
      // Slopes along the sheet's sides; a node's axes are its first two arms.
      const auto& arms = rig.surface.connectivity().stars[s.node].arms;
      const HalfArc arm = arms[s.i == 1 ? 0 : 1];
      const Vec3 way = corners[rig.surface.wireframe().end(arm)] - corners[s.node];
      rig.neutral[v] = (1 / size) * way;
    }
  }
  rig.source = makeSource(rig.surface);
  std::iota(rig.source.quadCorners.begin(), rig.source.quadCorners.end(), 0);
  return rig;
}

/// Adds texture coordinates computed from each corner's position and the centre of its face.
inline void texture(Rig& rig,
                    const std::function<Vec2(const Vec3& place, const Vec3& middle)>& at) {
  const Tessellation grid(rig.surface, 1);
  const auto places = neutralOf(rig, grid);
  Polygons& faces = rig.source.polygons;
  for (Index f = 0; f < faces.faceCount(); ++f) {
    Vec3 middle;
    for (Index c = faces.faceStart[f]; c < faces.faceStart[f + 1]; ++c)
      middle += (1.0 / faces.faceSize(f)) * places[faces.corners[c]];
    for (Index c = faces.faceStart[f]; c < faces.faceStart[f + 1]; ++c) {
      faces.cornerTexcoords.push_back(static_cast<Index>(faces.texcoords.size()));
      faces.texcoords.push_back(at(places[faces.corners[c]], middle));
    }
  }
}

}  // namespace sweepface::testing
