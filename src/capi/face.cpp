#include <algorithm>
#include <cmath>
#include <cstring>

#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

namespace {

bool isWeight(double w) { return std::abs(w) <= SWEEPFACE_MOST_WEIGHT; }  // false for NaN

sweepface_status refuseWeight(const sweepface_face& face, std::size_t target) {
  return refuseCall("The weight of '", face.mesh->rig->targets[target].name, "' must lie within ",
                    static_cast<int>(SWEEPFACE_MOST_WEIGHT), " of 0.");
}

VectorsOut pointsOf(const Mesh& mesh, const sweepface_vectors& out, std::size_t count) {
  const auto points = std::min(count, static_cast<std::size_t>(mesh.render.points));
  return {out.data, static_cast<Index>(points), strideOf(out)};
}

}  // namespace

sweepface_status capi::needVertices(const Mesh& mesh, std::size_t count) {
  const auto vertices = static_cast<std::size_t>(mesh.render.vertexCount());
  if (count <= vertices) return SWEEPFACE_OK;
  return refuse("There are only ", vertices, " vertices, not ", count, ".");
}

void capi::repeatPoints(const Mesh& mesh, const sweepface_vectors& out, std::size_t count) {
  if (!out.data) return;
  char* const first = reinterpret_cast<char*>(out.data);
  const std::size_t stride = strideOf(out);
  for (std::size_t v = mesh.render.points; v < count; ++v)
    std::memcpy(first + stride * v, first + stride * mesh.render.copies[v - mesh.render.points],
                kTight);
}

sweepface_status sweepface_face_create(const sweepface_mesh* mesh, sweepface_face** face) {
  if (!mesh || !face) return refuse("Making a face needs a mesh and a place for it.");
  const Mesh& made = *mesh->mesh;
  const Weights rest(made.division->count() * made.rig->targets.size(), 0.0);
  *face = new sweepface_face{mesh->mesh,
                             Weights(made.division->count() * made.shown, 0.0),
                             rest,
                             std::vector<std::byte>(made.scratchBytes()),
                             {.weights = rest},
                             {.weights = rest}};
  return SWEEPFACE_OK;
}

void sweepface_face_free(sweepface_face* face) { delete face; }

sweepface_status sweepface_face_set_weight(sweepface_face* face, uint32_t target, double weight) {
  if (!face) return refuse("Setting a weight needs a face.");
  const std::size_t count = face->mesh->shown;
  if (target >= count) return noSuch("target", target, count);
  if (const auto status = needTargets(*face->mesh->rig)) return status;
  if (!isWeight(weight)) return refuseWeight(*face, target);
  for (std::size_t k = target; k < face->weights.size(); k += count) face->weights[k] = weight;
  return SWEEPFACE_OK;
}

namespace {

sweepface_status checkWeights(const sweepface_face* face, const double* weights, size_t count) {
  if (!face || (!weights && count > 0)) return refuse("Setting weights needs a face and weights.");
  if (count > face->mesh->shown)
    return refuse("There are ", count, " weights for ", face->mesh->shown, " targets.");
  if (const auto status = needTargets(*face->mesh->rig)) return status;
  for (size_t k = 0; k < count; ++k)
    if (!isWeight(weights[k])) return refuseWeight(*face, k);
  return SWEEPFACE_OK;
}

}  // namespace

sweepface_status sweepface_face_set_weights(sweepface_face* face, const double* weights,
                                            size_t count) {
  if (const auto status = checkWeights(face, weights, count)) return status;
  for (std::size_t r = 0; r < face->mesh->division->count(); ++r)
    std::copy_n(weights, count, face->weights.data() + r * face->mesh->shown);
  return SWEEPFACE_OK;
}

sweepface_status sweepface_face_set_region_weights(sweepface_face* face, uint32_t region,
                                                   const double* weights, size_t count) {
  if (const auto status = checkWeights(face, weights, count)) return status;
  const std::size_t regions = face->mesh->division->count();
  if (region >= regions) return noSuch("region", region, regions);
  std::copy_n(weights, count, face->weights.data() + region * face->mesh->shown);
  return SWEEPFACE_OK;
}

const double* sweepface_face_weights(const sweepface_face* face) {
  return face ? face->weights.data() : nullptr;
}

double sweepface_face_error(const sweepface_face* face) {
  if (!face) return 0;
  const Mesh& mesh = *face->mesh;
  sweepface_face copy{face->mesh, face->weights, face->followed, {}, {}, {}, face->looks};
  const Weights& weights = follow(copy);
  return (isNeutral(weights) ? mesh.neutral : mesh.positions()).positionBound(weights);
}

namespace {

sweepface_status checkOutputs(const sweepface_face* face, std::size_t count,
                              const sweepface_vectors& positions,
                              const sweepface_vectors& normals) {
  if (!face) return refuse("Evaluating needs a face.");
  if (const auto status = needVertices(*face->mesh, count)) return status;
  if (!fits(positions) || !fits(normals))
    return refuse("A stride must be 0 or 12 bytes, three floats, to a gigabyte.");
#ifndef __wasm__
  if (Written{positions.data, positions.stride, count, {}}.isHitBy(normals, count))
    return refuse("Positions and normals would be written over each other.");
#endif
  return SWEEPFACE_OK;
}

enum class What { positions, normals };

void write(sweepface_face& face, const Weights& weights, What what, const sweepface_vectors& to,
           std::size_t count, bool onlyChanges) {
  if (!to.data) return;
  const Mesh& mesh = *face.mesh;
  const bool ofPositions = what == What::positions;
  auto& written = ofPositions ? face.positions : face.normals;
  auto& other = ofPositions ? face.normals : face.positions;
#ifdef __wasm__
  if (other.data == to.data) other.data = nullptr;  // it is overwritten
#else
  if (other.isHitBy(to, count)) other.data = nullptr;
  (ofPositions ? face.normalsBefore : face.positionsBefore).forget(to, count);
  (ofPositions ? face.positionsBefore : face.normalsBefore).bringBack(written, to, count);
#endif
  const bool isThere = written.is(to, count);
  Evaluation job;
  job.evaluator = isNeutral(weights) ? &mesh.neutral
                  : ofPositions      ? &mesh.positions()
                                     : &mesh.normals();
  // The neutral's tables have no targets that would show what differs, and hold derivatives in
  // other units where a target opens what the neutral holds shut.
  const bool ofTheseTables = !isNeutral(weights) && (ofPositions || !isNeutral(written.weights));
  if (onlyChanges && isThere && ofTheseTables) job.previous = written.weights;
  job.weights = weights;
  job.scratch = face.scratch;
  (ofPositions ? job.positions : job.normals) = pointsOf(mesh, to, count);
  job.run();
  repeatPoints(mesh, to, count);
  written.data = to.data, written.stride = to.stride, written.count = count;
  std::ranges::copy(weights, written.weights.begin());
}

sweepface_status evaluate(sweepface_face* face, std::size_t count,
                          const sweepface_vectors& positions, const sweepface_vectors& normals,
                          bool onlyChanges) {
  if (const auto status = checkOutputs(face, count, positions, normals)) return status;
  const Weights& weights = follow(*face);
  if (positions.data && normals.data && !isNeutral(weights)) face->mesh->prepareBoth();
  write(*face, weights, What::positions, positions, count, onlyChanges);
  write(*face, weights, What::normals, normals, count, onlyChanges);
  return SWEEPFACE_OK;
}

}  // namespace

sweepface_status sweepface_face_evaluate(sweepface_face* face, size_t count,
                                         sweepface_vectors positions, sweepface_vectors normals) {
  return evaluate(face, count, positions, normals, false);
}

sweepface_status sweepface_face_update(sweepface_face* face, size_t count,
                                       sweepface_vectors positions, sweepface_vectors normals) {
  return evaluate(face, count, positions, normals, true);
}
