#include <algorithm>

#include "sweepface/gltf.hpp"

#include "gltf/accessor.hpp"
#include "gltf/left_out.hpp"
#include "gltf/lost_normals.hpp"
#include "gltf/mesh_rig.hpp"
#include "gltf/same_vertices.hpp"
#include "gltf/scene.hpp"
#include "gltf/skins.hpp"
#include "gltf/touching.hpp"
#include "mesh/quads.hpp"
#include "mesh/weld.hpp"

namespace sweepface {
namespace {

/// Whether the steps of a quantized mesh are undone by a skin that could not place it.
bool hasStepsThatASkinUndoes(const gltf::Document& document, const gltf::Parts& parts) {
  std::vector<bool> isSkinned(document.list("meshes").size());
  for (const gltf::Json& node : document.list("nodes"))
    if (const auto mesh = gltf::findIndex(node, "mesh", isSkinned.size());
        mesh && gltf::find(node, "skin"))
      isSkinned[*mesh] = true;
  return std::ranges::any_of(parts.runs, [&](const gltf::Run& run) {
    const auto position = gltf::accessorAt(document, run.position);
    const gltf::RigMesh& mesh = parts.meshes[run.rigMesh];
    return position && position->type != gltf::Component::float32 && isSkinned[mesh.mesh] &&
           mesh.world == gltf::Affine{};
  });
}

Result<RigSource> readGltf(std::string_view bytes, const std::filesystem::path& folder,
                           bool withScene) {
  auto document = gltf::parseDocument(bytes, folder);
  if (!document) return std::unexpected(document.error());
  auto parts = gltf::findParts(*document);
  if (!parts) return std::unexpected(parts.error());
  gltf::placeBySkins(*document, *parts);
  auto read = gltf::readMeshRig(*document, *parts);
  if (!read) return std::unexpected(read.error());
  auto& [rig, facePart] = *read;
  const std::vector<Index> places = weld(rig);
  const auto same = gltf::sameVertices(*document, *parts, places);
  if (!same) return std::unexpected(same.error());
  const std::string lost = gltf::lostNormals(*document, *parts, rig, places);
  rig.neutral.polygons = recoverQuads(rig, *same, facePart).polygons;
  RigSource source{std::move(rig), {}, {}};
  if (hasStepsThatASkinUndoes(*document, *parts))
    source.faceWarnings.push_back(
        "The face is quantized, and its skin undoes that: sizes, distances and the tolerance are "
        "in units of the quantization, not of the scene.");
  if (!lost.empty()) source.faceWarnings.push_back(lost);
  if (!withScene) return source;
  source.warnings = document->warnings;
  for (auto& sentences : {parts->warnings, gltf::leftOut(*document, *parts)})
    source.warnings.insert(source.warnings.end(), sentences.begin(), sentences.end());
  if (std::string meeting = gltf::touchingMeshes(*document, *parts, source.rig, places);
      !meeting.empty())
    source.warnings.push_back(std::move(meeting));
  auto scene = gltf::makeScene(std::move(*document), *parts, source.rig.neutral.polygons, folder);
  if (!scene) return std::unexpected(scene.error());
  source.scene = gltf::formatScene(scene->glb);
  source.warnings.insert(source.warnings.end(), scene->warnings.begin(), scene->warnings.end());
  return source;
}

}  // namespace

Result<RigSource> parseGltf(std::string_view bytes, std::string_view name,
                            const std::filesystem::path& folder, bool withScene) {
  auto source = readGltf(bytes, folder, withScene);
  if (source) return source;
  return fail(std::string(name) + ": " + source.error().message);
}

}  // namespace sweepface
