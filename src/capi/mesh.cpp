#include <string>

#include "sweepface/nearest.hpp"

#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

namespace {

sweepface_status makeMesh(const sweepface_rig& rig, Index lod, Tessellation grid,
                          RenderMesh (*rendered)(const Rig&, const Tessellation&),
                          sweepface_mesh** mesh) {
  auto neutral = Evaluator::make(
      *rig.rig, grid, {.level = lod, .targets = false, .influences = rig.division->influences});
  if (!neutral) return refuse(neutral.error().message);
  RenderMesh render = rendered(*rig.rig, grid);
#ifndef __wasm__  // where shaders find tangents themselves
  splitMirrored(render);
#endif
  *mesh = new sweepface_mesh{std::make_shared<Mesh>(rig.rig, rig.shown, rig.division, rig.following,
                                                    lod, std::move(grid), std::move(*neutral),
                                                    std::move(render))};
  return SWEEPFACE_OK;
}

#ifndef __wasm__
RenderMesh renderSites(const Rig&, const Tessellation& sites) {
  RenderMesh mesh;
  mesh.points = sites.vertexCount();
  return mesh;
}
#endif

static_assert(static_cast<int>(Budget::Kind::edgeLength) == SWEEPFACE_BUDGET_EDGE_LENGTH &&
              static_cast<int>(Budget::Kind::error) == SWEEPFACE_BUDGET_ERROR &&
              static_cast<int>(Budget::Kind::vertices) == SWEEPFACE_BUDGET_VERTICES);

}  // namespace

sweepface_status sweepface_mesh_create(const sweepface_rig* rig, uint32_t lod,
                                       sweepface_mesh** mesh) {
  if (!rig || !mesh) return refuse("Making a mesh needs a rig and a place for it.");
  if (lod > SWEEPFACE_MOST_LOD)
    return refuse("The level of detail must be 0 to ", SWEEPFACE_MOST_LOD, ", not ", lod, ".");
  if (lod == 0 && rig->rig->source.gridVertex.empty())
    return refuse("The face came without its source's vertices; ask for level of detail 1.");
  const Index level = lod == 0 ? 1 : static_cast<Index>(lod);
  if (static_cast<double>(rig->rig->surface.wireframe().quadCount()) * level * level >
      kMostVertices)
    return refuse("The face has too many vertices at level of detail ", lod,
                  "; ask for a lower one.");
  return makeMesh(*rig, static_cast<Index>(lod), Tessellation(rig->rig->surface, level),
                  lod == 0 ? renderSource : renderGrid, mesh);
}

sweepface_status sweepface_mesh_create_within(const sweepface_rig* rig, sweepface_budget budget,
                                              double value, sweepface_mesh** mesh) {
  if (!rig || !mesh) return refuse("Making a mesh needs a rig and a place for it.");
  if (budget < SWEEPFACE_BUDGET_EDGE_LENGTH || budget > SWEEPFACE_BUDGET_VERTICES)
    return refuse("There is no budget of kind ", budget, "; kinds are 0 to ",
                  int(SWEEPFACE_BUDGET_VERTICES), ".");
  const auto density = densityFor(rig->rig->surface, blend(*rig->rig, {}),
                                  {static_cast<Budget::Kind>(budget), value});
  if (!density) return refuse(density.error().message);
  return makeMesh(*rig, 1, Tessellation(rig->rig->surface, *density), renderDensity, mesh);
}

#ifndef __wasm__  // left out to keep the module small
sweepface_status sweepface_mesh_create_at(const sweepface_rig* rig, const double* points,
                                          size_t count, sweepface_mesh** mesh) {
  if (!rig || !mesh || !points || count == 0)
    return refuse("Making a mesh of points needs a rig, points and a place for it.");
  if (static_cast<double>(count) > kMostVertices)
    return refuse("A mesh may have at most ", static_cast<int>(kMostVertices), " points, not ",
                  count, ".");
  if (static_cast<double>(rig->rig->surface.wireframe().quadCount()) > kMostVertices)
    return refuse("The face has more than ", static_cast<int>(kMostVertices),
                  " quads, too many to look for points on them.");
  std::vector<Vec3> places;
  for (std::size_t k = 0; k < count; ++k, points += 3)
    places.push_back({points[0], points[1], points[2]});
  auto sites = nearestSites(rig->rig->surface, blend(*rig->rig, {}), places);
  if (!sites) return refuse(sites.error().message);
  return makeMesh(*rig, 1, Tessellation(rig->rig->surface, std::move(*sites)), renderSites, mesh);
}
#endif

sweepface_status sweepface_mesh_prepare(const sweepface_mesh* mesh, int32_t normals) {
  if (!mesh) return refuse("Preparing needs a mesh.");
  if (const auto status = needTargets(*mesh->mesh->rig)) return status;
  if (normals)
    mesh->mesh->prepareBoth();
  else
    mesh->mesh->positions();
  return SWEEPFACE_OK;
}

void sweepface_mesh_free(sweepface_mesh* mesh) { delete mesh; }

uint32_t sweepface_mesh_point_count(const sweepface_mesh* mesh) {
  return mesh ? static_cast<uint32_t>(mesh->mesh->render.points) : 0;
}

uint32_t sweepface_mesh_vertex_count(const sweepface_mesh* mesh) {
  return mesh ? static_cast<uint32_t>(mesh->mesh->render.vertexCount()) : 0;
}

const uint32_t* sweepface_mesh_copies(const sweepface_mesh* mesh) {
  if (!mesh || mesh->mesh->render.copies.empty()) return nullptr;
  return reinterpret_cast<const uint32_t*>(mesh->mesh->render.copies.data());
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
