#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

namespace {

constexpr std::size_t kTight = 3 * sizeof(float);

bool isWeight(double w) { return std::abs(w) <= SWEEPFACE_MOST_WEIGHT; }  // false for NaN

sweepface_status refuseWeight(const sweepface_face& face, std::size_t target) {
  return refuse("The weight of '" + face.mesh->rig->targets[target].name + "' must lie within " +
                std::to_string(static_cast<int>(SWEEPFACE_MOST_WEIGHT)) + " of 0.");
}

// Positions beyond single precision end where it does.
float toFloat(double x) {
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -most, most));
}

bool fits(const sweepface_vectors& out) { return out.stride == 0 || out.stride >= kTight; }

void write(const sweepface_face& face, std::size_t count, const sweepface_vectors& out) {
  char* to = reinterpret_cast<char*>(out.data);
  const std::size_t stride = out.stride ? out.stride : kTight;
  for (std::size_t v = 0; v < count; ++v, to += stride) {
    const Vec3& p = face.places[face.mesh->placeOf[v]];
    const float floats[3] = {toFloat(p.x), toFloat(p.y), toFloat(p.z)};
    std::memcpy(to, floats, kTight);
  }
}

}  // namespace

sweepface_status sweepface_face_create(const sweepface_mesh* mesh, sweepface_face** face) {
  if (!mesh || !face) return refuse("Making a face needs a mesh and a place for it.");
  const Rig& rig = *mesh->mesh->rig;
  *face = new sweepface_face{
      mesh->mesh, Weights(rig.targets.size(), 0.0), std::vector<Vec3>(rig.surface.vectorCount()),
      std::vector<Vec3>(mesh->mesh->grid.vertexCount() + rig.source.loose.size())};
  return SWEEPFACE_OK;
}

void sweepface_face_free(sweepface_face* face) { delete face; }

sweepface_status sweepface_face_set_weight(sweepface_face* face, uint32_t target, double weight) {
  if (!face) return refuse("Setting a weight needs a face.");
  if (target >= face->weights.size()) return noSuch("target", target, face->weights.size());
  if (!isWeight(weight)) return refuseWeight(*face, target);
  face->weights[target] = weight;
  return SWEEPFACE_OK;
}

sweepface_status sweepface_face_set_weights(sweepface_face* face, const double* weights,
                                            size_t count) {
  if (!face || (!weights && count > 0)) return refuse("Setting weights needs a face and weights.");
  if (count > face->weights.size())
    return refuse("There are " + std::to_string(count) + " weights for " +
                  std::to_string(face->weights.size()) + " targets.");
  for (size_t k = 0; k < count; ++k)
    if (!isWeight(weights[k])) return refuseWeight(*face, k);
  std::copy_n(weights, count, face->weights.begin());
  return SWEEPFACE_OK;
}

const double* sweepface_face_weights(const sweepface_face* face) {
  return face ? face->weights.data() : nullptr;
}

sweepface_status sweepface_face_evaluate(sweepface_face* face, size_t count,
                                         sweepface_vectors positions, sweepface_vectors normals) {
  if (!face) return refuse("Evaluating needs a face.");
  const Mesh& mesh = *face->mesh;
  if (count > mesh.placeOf.size())
    return refuse("There are only " + std::to_string(mesh.placeOf.size()) + " vertices, not " +
                  std::to_string(count) + ".");
  if (!fits(positions) || !fits(normals))
    return refuse("A stride must be 0 or at least 12 bytes: three floats.");
  blend(*mesh.rig, face->weights, face->vectors);
  const std::span<Vec3> places(face->places);
  const std::span<Vec3> loose = places.subspan(mesh.grid.vertexCount());
  if (positions.data) {
    mesh.grid.positions(face->vectors, places);
    blendLoose(*mesh.rig, face->weights, loose);
    write(*face, count, positions);
  }
  if (normals.data) {
    mesh.grid.normals(face->vectors, places);
    std::ranges::fill(loose, Vec3{0, 0, 1});
    write(*face, count, normals);
  }
  return SWEEPFACE_OK;
}
