#include <algorithm>
#include <fmt/format.h>

#include "sweepface/gltf.hpp"

#include "gltf/accessor.hpp"
#include "gltf/chosen_meshes.hpp"
#include "gltf/left_out.hpp"
#include "gltf/lost_normals.hpp"
#include "gltf/mesh_rig.hpp"
#include "gltf/same_vertices.hpp"
#include "gltf/scene.hpp"
#include "gltf/skins.hpp"
#include "gltf/touching.hpp"
#include "io/text.hpp"
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

/// The parts that are the face: those of meshes of some names, or, without names, those that the
/// scene shows; if it shows none of them, all.
Result<gltf::Parts> chosenParts(gltf::Document& document, std::span<const std::string> names,
                                std::vector<std::string>& warnings) {
  if (!names.empty()) {
    if (auto ok = gltf::chooseByName(document, names); !ok) return std::unexpected(ok.error());
    return gltf::findParts(document);
  }
  auto parts = gltf::findParts(document);
  if (!parts) return parts;
  std::vector<std::size_t> meshes;
  for (const gltf::RigMesh& mesh : parts->meshes) meshes.push_back(mesh.mesh);
  std::vector<std::string> others;
  for (const std::size_t mesh : gltf::chooseShown(document, meshes))
    others.push_back(gltf::placeOf(document, mesh));
  if (others.empty()) return parts;
  warnings.push_back(
      fmt::format("Meshes that the file's scene does not show are not part of the face: {}; to "
                  "have others, choose meshes by their names (--mesh).",
                  io::fewOf(others, 3)));
  return gltf::findParts(document);
}

Result<RigSource> readGltf(std::string_view bytes, const std::filesystem::path& folder,
                           const SourceOptions& options) {
  auto document = gltf::parseDocument(bytes, folder);
  if (!document) return std::unexpected(document.error());
  RigSource source;
  auto parts = chosenParts(*document, options.meshes, source.faceWarnings);
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
  source.rig = std::move(rig);
  if (hasStepsThatASkinUndoes(*document, *parts))
    source.faceWarnings.push_back(
        "The face is quantized, and its skin undoes that: sizes, distances and the tolerance are "
        "in units of the quantization, not of the scene.");
  if (!lost.empty()) source.faceWarnings.push_back(lost);
  if (!options.withScene) return source;
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
                            const std::filesystem::path& folder, const SourceOptions& options) {
  auto source = readGltf(bytes, folder, options);
  if (source) return source;
  return fail(std::string(name) + ": " + source.error().message);
}

}  // namespace sweepface
