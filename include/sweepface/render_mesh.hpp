#pragma once

#include <cstdint>
#include <vector>

#include "sweepface/eval.hpp"

namespace sweepface {

/// A face as graphics cards want it: triangles over vertices that have one texture coordinate each.
struct RenderMesh {
  /// Triangles of one material.
  struct Part {
    Index material = -1;  ///< of the source's polygons, or -1
    std::uint32_t firstTriangle = 0, triangles = 0;
    friend bool operator==(const Part&, const Part&) = default;
  };

  Index points = 0;           ///< vertices [0, points) are the source's or the tessellation's
  std::vector<Index> copies;  ///< [vertices - points] the point that each further vertex repeats
  std::vector<std::uint32_t> triangles;  ///< [T × 3] counter-clockwise, part by part
  std::vector<float> texcoords;          ///< [vertices × 2], or empty if there are none
  std::vector<Part> parts;

  Index pointOf(Index vertex) const { return vertex < points ? vertex : copies[vertex - points]; }
  Index vertexCount() const { return points + static_cast<Index>(copies.size()); }
};

/// The source's own polygons, cut where the neutral's diagonals are shortest; `grid` is at level 1.
RenderMesh renderSource(const Rig& rig, const Tessellation& grid);
/// The quads of any tessellation of the rig, likewise.
RenderMesh renderGrid(const Rig& rig, const Tessellation& grid);
/// The triangles of a tessellation with a density; a triangle has the material of the quad in its
/// middle.
RenderMesh renderDensity(const Rig& rig, const Tessellation& grid);

}  // namespace sweepface
