#include "gltf/bound_scene.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>

#include "sweepface/gltf.hpp"

#include "gltf/left_to_face.hpp"
#include "gltf/more_targets.hpp"
#include "gltf/references.hpp"
#include "gltf/scene.hpp"
#include "io/text.hpp"

namespace sweepface::gltf {
namespace {

std::unexpected<Error> doesNotFit(std::string_view why) {
  return fail(fmt::format("The face and its scene do not fit: {}; convert the source again.", why));
}

/// Passes on an error without its advice, which may be about the glTF that the scene once was and
/// would help nobody.
std::unexpected<Error> cannotBeRead(const Error& error) {
  return doesNotFit(io::withoutAdvice(error.message));
}

/// Targets of the rig that its scene lacks.
std::vector<std::string> newTargets(const Rig& rig, const std::vector<std::string>& known) {
  const std::set<std::string_view> names(known.begin(), known.end());
  std::vector<std::string> more;
  for (const Target& target : rig.targets)
    if (!names.contains(target.name)) more.push_back(target.name);
  return more;
}

/// The rig's target for each of the scene's, or -1 for one that was taken out of the rig.
std::vector<Index> matchTargets(const Rig& rig, const std::vector<std::string>& names) {
  std::map<std::string_view, Index> numbers;
  for (std::size_t k = 0; k < rig.targets.size(); ++k)
    numbers.emplace(rig.targets[k].name, static_cast<Index>(k));
  std::vector<Index> targets;
  for (const std::string& name : names) {
    const auto number = numbers.find(name);
    targets.push_back(number == numbers.end() ? -1 : number->second);
  }
  return targets;
}

}  // namespace

std::vector<Index> shownMeshes(const BoundScene& scene) {
  std::vector<Index> rigMesh(scene.document.list("meshes").size(), -1);
  for (std::size_t m = 0; m < scene.parts.meshes.size(); ++m)
    rigMesh[scene.parts.meshes[m].mesh] = static_cast<Index>(m);
  std::vector<Index> shown;
  for (const Json& node : scene.document.list("nodes")) {
    const auto mesh = findIndex(node, "mesh", rigMesh.size());
    shown.push_back(mesh ? rigMesh[*mesh] : -1);
  }
  return shown;
}

Result<BoundScene> sceneOf(const Rig& rig) {
  auto document = parseScene(rig.scene);
  if (!document) return cannotBeRead(document.error());
  auto parts = findParts(*document);
  if (!parts) return cannotBeRead(parts.error());
  if (document->buffers.size() > 1) return doesNotFit("it has several buffers");
  // What its accessors may claim also depends on what was taken out: shapes, triangles and texture
  // coordinates.
  const Polygons& polygons = rig.source.polygons;
  const std::size_t vertices = rig.source.gridVertex.size();
  document->sourceBytes += (12 + 8) * vertices + 2 * polygons.corners.size();
  if (auto ok = checkReferences(*document); !ok) return cannotBeRead(ok.error());
  if (const auto more = newTargets(rig, parts->targets); !more.empty()) {
    if (auto ok = addTargets(*document, *parts, more); !ok) return cannotBeRead(ok.error());
    parts = findParts(*document);
    if (!parts) return cannotBeRead(parts.error());
  }
  if (parts->vertexCount != vertices)
    return doesNotFit(fmt::format("they have {} and {} vertices", vertices, parts->vertexCount));
  BoundScene scene{std::move(*document), std::move(*parts), {}, {}, polygons.corners, {}};
  scene.targets = matchTargets(rig, scene.parts.targets);
  scene.vertices.resize(vertices);
  std::iota(scene.vertices.begin(), scene.vertices.end(), 0);
  auto faces = partsOfFaces(scene.document, scene.parts, polygons);
  if (!faces) return cannotBeRead(faces.error());
  scene.facePart = std::move(*faces);
  if (auto ok = takeFromFace(scene.document, scene.parts, polygons, scene.facePart); !ok)
    return cannotBeRead(ok.error());
  return scene;
}

}  // namespace sweepface::gltf

namespace sweepface {

Result<void> checkScene(const Rig& rig) {
  if (rig.scene.empty()) return {};
  const auto scene = gltf::sceneOf(rig);
  return scene ? Result<void>{} : std::unexpected(scene.error());
}

}  // namespace sweepface
