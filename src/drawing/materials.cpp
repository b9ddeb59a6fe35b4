#include "drawing/materials.hpp"

#include <algorithm>

#include "io/text.hpp"

namespace sweepface::drawing {

void addMaterials(SourceMesh& grid, const Surface& surface, const Drawing& drawing) {
  Polygons& faces = grid.polygons;
  const auto hasNone = [](const Drawing::Patch& patch) { return patch.material.empty(); };
  if (std::ranges::all_of(drawing.patches, hasNone)) return;
  io::NameIndex numbers(faces.materials);
  for (Index p = 0; p < surface.patchCount(); ++p) {
    const auto quads = static_cast<std::size_t>(surface.edgesU(p) * surface.edgesV(p));
    const Index number = numbers(drawing.patches[p].material);
    faces.faceMaterial.insert(faces.faceMaterial.end(), quads, number);
  }
}

}  // namespace sweepface::drawing
