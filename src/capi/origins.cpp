#ifndef __wasm__
#include "sweepface/origins.hpp"

#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

namespace {

/// Every vertex of the source is its own origin.
std::vector<Origin> originsOfSource(Index count) {
  std::vector<Origin> origins;
  for (Index v = 0; v < count; ++v) origins.push_back({{v, v, v, v}, {1, 0, 0, 0}});
  return origins;
}

}  // namespace

sweepface_status sweepface_mesh_origins(const sweepface_mesh* mesh, size_t count,
                                        uint32_t* vertices, float* shares) {
  if (!mesh || (count > 0 && (!vertices || !shares)))
    return refuse("Origins need a mesh and places for vertices and shares.");
  const Mesh& made = *mesh->mesh;
  const auto points = static_cast<std::size_t>(made.render.points);
  if (count > points) return refuse("There are only ", points, " points, not ", count, ".");
  const auto origins = made.lod == 0
                           ? Result<std::vector<Origin>>(originsOfSource(made.render.points))
                           : originsOf(*made.rig, made.grid);
  if (!origins) return refuse(origins.error().message);
  for (std::size_t p = 0; p < count; ++p)
    for (std::size_t k = 0; k < 4; ++k) {
      vertices[4 * p + k] = static_cast<std::uint32_t>((*origins)[p].vertices[k]);
      shares[4 * p + k] = static_cast<float>((*origins)[p].shares[k]);
    }
  return SWEEPFACE_OK;
}
#endif
