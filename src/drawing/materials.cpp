#include "drawing/materials.hpp"

#include <algorithm>
#include <map>

namespace sweepface::drawing {

void addMaterials(SourceMesh& grid, const Surface& surface, const Drawing& drawing) {
  Polygons& faces = grid.polygons;
  const auto hasNone = [](const Drawing::Patch& patch) { return patch.material.empty(); };
  if (std::ranges::all_of(drawing.patches, hasNone)) return;
  std::map<std::string, Index> numbers{{"", -1}};
  for (Index p = 0; p < surface.patchCount(); ++p) {
    const std::string& name = drawing.patches[p].material;
    const auto next = static_cast<Index>(faces.materials.size());
    const auto [number, isNew] = numbers.try_emplace(name, next);
    if (isNew) faces.materials.push_back(name);
    const auto quads = static_cast<std::size_t>(surface.edgesU(p) * surface.edgesV(p));
    faces.faceMaterial.insert(faces.faceMaterial.end(), quads, number->second);
  }
}

}  // namespace sweepface::drawing
