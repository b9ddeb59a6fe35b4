#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

sweepface_status sweepface_mesh_shader_tables(const sweepface_mesh* mesh, int32_t tangents,
                                              sweepface_shader_tables* out) {
  if (!mesh || !out) return refuse("Tables for a shader need a mesh and a place for them.");
  if (const auto status = needTargets(*mesh->mesh->rig)) return status;
  mesh->mesh->makeShaderTables();
  const ShaderTables& t = tangents ? mesh->mesh->shaderTangents : mesh->mesh->shaderPositions;
  *out = {t.basis.data(), t.places.data(), t.neutral.data(),
          static_cast<uint32_t>(t.basis.size() / 4), static_cast<uint32_t>(t.modes)};
  return SWEEPFACE_OK;
}

sweepface_status sweepface_face_modes(sweepface_face* face, int32_t tangents, int16_t* out,
                                      size_t count, float* factor) {
  if (!face || (!out && count > 0) || !factor)
    return refuse("Modes need a face and a place for them.");
  if (const auto status = needTargets(*face->mesh->rig)) return status;
  const Mesh& mesh = *face->mesh;
  mesh.makeShaderTables();
  const auto modes =
      static_cast<size_t>((tangents ? mesh.shaderTangents : mesh.shaderPositions).modes);
  if (count != modes) return refuseCall("There are ", modes, " modes, not ", count, ".");
  const EvaluatorTables& tables = (tangents ? mesh.normals() : mesh.positions()).tables();
  *factor = blendModes(tables, tangents ? tables.derivatives : tables.positions, follow(*face),
                       face->scratch, {out, 4 * count});
  return SWEEPFACE_OK;
}
