#ifndef __wasm__
#include <cstring>

#include "capi/handles.hpp"
#include "capi/message.hpp"
#include "eval/tile_kernels.hpp"

using namespace sweepface;
using namespace sweepface::capi;

const Evaluator& Mesh::mapTangents(bool moving) const {
  std::call_once(tangentsOnce, [&] { tangents = neutralTangents(*rig, grid, render, lod); });
  Late<Evaluator>& map = moving ? movingMap : neutralMap;
  std::call_once(map.once, [&] {
    map.made = *Evaluator::make(
        *rig, grid, render, tangents,
        {.level = lod, .positions = false, .targets = moving, .influences = division->influences});
  });
  return *map.made;
}

namespace {

constexpr std::size_t kTightTangents = 4 * sizeof(float);

sweepface_status needDirections(const Mesh& mesh) {
  if (!mesh.render.texcoords.empty() || mesh.grid.isOfSites()) return SWEEPFACE_OK;
  return refuse("The mesh has no texture coordinates, along which tangents would go.");
}

void writeSigns(const std::vector<float>& signs, const VectorsOut& tangents) {
  auto* place = reinterpret_cast<char*>(tangents.data) + kTight;
  for (Index v = 0; v < tangents.count; ++v, place += tangents.stride)
    std::memcpy(place, &signs[v], sizeof(float));
}

/// Copies of points share the points' normals, so that no seam shows in the light. Their tangents
/// are turned to be at right angles to these.
void squareUp(const Mesh& mesh, const VectorsOut& normals, const VectorsOut& tangents) {
  const auto read = [](const VectorsOut& from, Index vertex) {
    float xyz[3];
    std::memcpy(xyz, vectorAt(from, static_cast<std::uint32_t>(vertex)), sizeof(xyz));
    return Vec3{xyz[0], xyz[1], xyz[2]};
  };
  for (Index v = mesh.render.points; v < tangents.count; ++v) {
    const Vec3 normal = read(normals, v), along = read(tangents, v),
               t = normalized(along - dot(along, normal) * normal);
    const float xyz[3] = {static_cast<float>(t.x), static_cast<float>(t.y),
                          static_cast<float>(t.z)};
    std::memcpy(vectorAt(tangents, static_cast<std::uint32_t>(v)), xyz, sizeof(xyz));
  }
}

/// Forgets what the face wrote there, as it is overwritten.
void forget(sweepface_face& face, const sweepface_vectors& to, std::size_t count,
            std::size_t size) {
  for (Written* const last : {&face.positions, &face.normals})
    if (last->isHitBy(to, count, size)) last->data = nullptr;
  face.positionsBefore.forget(to, count, size);
  face.normalsBefore.forget(to, count, size);
}

}  // namespace

sweepface_status sweepface_mesh_prepare_tangents(const sweepface_mesh* mesh) {
  if (!mesh) return refuse("Preparing needs a mesh.");
  if (const auto status = needDirections(*mesh->mesh)) return status;
  if (const auto status = needTargets(*mesh->mesh->rig)) return status;
  mesh->mesh->mapTangents(false);
  mesh->mesh->mapTangents(true);
  return SWEEPFACE_OK;
}

sweepface_status sweepface_face_tangents(sweepface_face* face, size_t count,
                                         sweepface_vectors normals, sweepface_vectors tangents) {
  if (!face) return refuse("Tangents need a face.");
  const Mesh& mesh = *face->mesh;
  if (const auto status = needDirections(mesh)) return status;
  if (const auto status = needVertices(mesh, count)) return status;
  if (!fits(normals)) return refuse("The stride of normals must be 0 or 12 bytes to a gigabyte.");
  if (!fits(tangents, kTightTangents))
    return refuse("The stride of tangents must be 0 or 16 bytes, four floats, to a gigabyte.");
  if (Written{normals.data, normals.stride, count, {}}.isHitBy(tangents, count, kTightTangents))
    return refuse("Normals and tangents would be written over each other.");
  const auto to = [&](const sweepface_vectors& out, std::size_t tight) {
    return VectorsOut{out.data, static_cast<Index>(count), strideOf(out, tight)};
  };
  const Weights& weights = follow(*face);
  Evaluation job;
  job.evaluator = &mesh.mapTangents(!isNeutral(weights));
  job.weights = weights;
  job.scratch = face->scratch;
  job.normals = to(normals, kTight);
  job.tangents = to(tangents, kTightTangents);
  job.run();
  repeatPoints(mesh, normals, count);
  if (normals.data && tangents.data) squareUp(mesh, job.normals, job.tangents);
  if (tangents.data) writeSigns(mesh.tangents.signs, job.tangents);
  forget(*face, normals, count, kTight);
  forget(*face, tangents, count, kTightTangents);
  return SWEEPFACE_OK;
}
#endif
