#include <string>

#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

namespace {

// How many vertices a level has is asked before anyone makes room for them.
constexpr double kMostVertices = 1 << 24;

double gridVertices(const Surface& surface, double level) {
  double count = 0;
  for (Index p = 0; p < surface.patchCount(); ++p)
    count += level * surface.edgesU(p) * level * surface.edgesV(p);
  return count;
}

}  // namespace

sweepface_status sweepface_mesh_create(const sweepface_rig* rig, uint32_t lod,
                                       sweepface_mesh** mesh) {
  if (!rig || !mesh) return refuse("Making a mesh needs a rig and a place for it.");
  if (lod > SWEEPFACE_MOST_LOD)
    return refuse("The level of detail must be 0 to " + std::to_string(SWEEPFACE_MOST_LOD) +
                  ", not " + std::to_string(lod) + ".");
  if (lod == 0 && rig->rig->source.gridVertex.empty())
    return refuse("The face came without its source's vertices; ask for level of detail 1.");
  const Index level = lod == 0 ? 1 : static_cast<Index>(lod);
  if (gridVertices(rig->rig->surface, level) > kMostVertices)
    return refuse("The face has too many vertices at level of detail " + std::to_string(lod) +
                  "; ask for a lower one.");
  const Tessellation grid(rig->rig->surface, level);
  EvaluatorOptions options;
  options.level = static_cast<Index>(lod);
  auto evaluator = Evaluator::make(*rig->rig, grid, options);
  if (!evaluator) return refuse(std::move(evaluator.error().message));
  auto made = std::make_shared<Mesh>(
      Mesh{rig->rig, rig->followers, rig->shown, std::move(*evaluator),
           lod == 0 ? renderSource(*rig->rig, grid) : renderGrid(*rig->rig, grid)});
  *mesh = new sweepface_mesh{std::move(made)};
  return SWEEPFACE_OK;
}

void sweepface_mesh_free(sweepface_mesh* mesh) { delete mesh; }

uint32_t sweepface_mesh_point_count(const sweepface_mesh* mesh) {
  return mesh ? static_cast<uint32_t>(mesh->mesh->render.points) : 0;
}

uint32_t sweepface_mesh_vertex_count(const sweepface_mesh* mesh) {
  return mesh ? static_cast<uint32_t>(mesh->mesh->render.vertexCount()) : 0;
}

uint32_t sweepface_mesh_triangle_count(const sweepface_mesh* mesh) {
  return mesh ? static_cast<uint32_t>(mesh->mesh->render.triangles.size() / 3) : 0;
}

const uint32_t* sweepface_mesh_triangles(const sweepface_mesh* mesh) {
  return mesh ? mesh->mesh->render.triangles.data() : nullptr;
}

const float* sweepface_mesh_texcoords(const sweepface_mesh* mesh) {
  if (!mesh || mesh->mesh->render.texcoords.empty()) return nullptr;
  return mesh->mesh->render.texcoords.data();
}

uint32_t sweepface_mesh_part_count(const sweepface_mesh* mesh) {
  return mesh ? static_cast<uint32_t>(mesh->mesh->render.parts.size()) : 0;
}

sweepface_status sweepface_mesh_part(const sweepface_mesh* mesh, uint32_t part,
                                     sweepface_part* out) {
  if (!mesh || !out) return refuse("A part of a mesh needs a mesh and a place for it.");
  const RenderMesh& render = mesh->mesh->render;
  if (part >= render.parts.size()) return noSuch("part", part, render.parts.size());
  const auto& [material, first, count] = render.parts[part];
  const auto& names = mesh->mesh->rig->source.polygons.materials;
  *out = {material < 0 ? "" : names[material].c_str(), first, count};
  return SWEEPFACE_OK;
}
