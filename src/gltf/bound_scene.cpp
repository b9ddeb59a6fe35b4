#include "gltf/bound_scene.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>
#include <span>

#include "gltf/left_to_face.hpp"
#include "gltf/more_targets.hpp"
#include "gltf/scene.hpp"

namespace sweepface::gltf {
namespace {

std::unexpected<Error> doesNotFit(std::string_view why) {
  return fail(fmt::format("The face and its scene do not fit: {}; convert the source again.", why));
}

/// The part of every face. They come in the order of the parts, as many as their triangles make.
Result<std::vector<Index>> partsOfFaces(const Polygons& polygons, const BoundScene& scene) {
  const Parts& parts = scene.parts;
  std::vector<Index> facePart;
  std::size_t named = 0;
  Index face = 0;
  for (std::size_t p = 0; p < parts.parts.size(); ++p) {
    const auto count = triangleCount(scene.document, parts, parts.parts[p]);
    if (!count) return std::unexpected(count.error());
    // Parts that share indices could take very long.
    named += 3 * *count;
    if (named > scene.document.mostElements()) return doesNotFit("it has far more triangles");
    const Run& run = parts.runs[parts.parts[p].run];
    std::size_t left = *count;
    for (; left > 0 && face < polygons.faceCount(); ++face) {
      const std::span corners(&polygons.corners[polygons.faceStart[face]],
                              static_cast<std::size_t>(polygons.faceSize(face)));
      const bool fits = corners.size() - 2 <= left && std::ranges::all_of(corners, [&](Index v) {
                          return static_cast<std::size_t>(v) - run.first < run.count;
                        });
      if (!fits) return doesNotFit(fmt::format("face {} is in no mesh of it", face));
      left -= corners.size() - 2;
      facePart.push_back(static_cast<Index>(p));
    }
    if (left > 0) return doesNotFit("it has more triangles");
  }
  if (face < polygons.faceCount())
    return doesNotFit(fmt::format("face {} is in no mesh of it", face));
  return facePart;
}

/// Targets of the rig that its scene came without.
std::vector<std::string> newTargets(const Rig& rig, const std::vector<std::string>& known) {
  const std::set<std::string_view> names(known.begin(), known.end());
  std::vector<std::string> more;
  for (const Target& target : rig.targets)
    if (!names.contains(target.name)) more.push_back(target.name);
  return more;
}

/// The rig's target of each of the scene's.
Result<std::vector<Index>> matchTargets(const Rig& rig, const std::vector<std::string>& names) {
  std::map<std::string_view, Index> numbers;
  for (std::size_t k = 0; k < rig.targets.size(); ++k)
    numbers.emplace(rig.targets[k].name, static_cast<Index>(k));
  std::vector<Index> targets;
  for (const std::string& name : names) {
    const auto number = numbers.find(name);
    if (number == numbers.end())
      return doesNotFit(fmt::format("only the latter has the target '{}'", name));
    targets.push_back(number->second);
    numbers.erase(number);
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
  if (!document) return doesNotFit(document.error().message);
  auto parts = findParts(*document);
  if (!parts) return doesNotFit(parts.error().message);
  if (document->buffers.size() > 1) return doesNotFit("it has several buffers");
  // What its accessors may claim counts on what was taken out as well: shapes, triangles and
  // texture coordinates.
  const Polygons& polygons = rig.source.polygons;
  const std::size_t vertices = rig.source.gridVertex.size();
  document->sourceBytes += (12 + 8) * vertices + 2 * polygons.corners.size();
  if (const auto more = newTargets(rig, parts->targets); !more.empty()) {
    if (auto ok = addTargets(*document, *parts, more); !ok) return doesNotFit(ok.error().message);
    parts = findParts(*document);
    if (!parts) return doesNotFit(parts.error().message);
  }
  if (parts->vertexCount != vertices)
    return doesNotFit(fmt::format("they have {} and {} vertices", vertices, parts->vertexCount));
  BoundScene scene{std::move(*document), std::move(*parts), {}, {}, polygons.corners, {}};
  auto targets = matchTargets(rig, scene.parts.targets);
  if (!targets) return std::unexpected(targets.error());
  scene.targets = std::move(*targets);
  scene.vertices.resize(vertices);
  std::iota(scene.vertices.begin(), scene.vertices.end(), 0);
  auto faces = partsOfFaces(polygons, scene);
  if (!faces) return std::unexpected(faces.error());
  scene.facePart = std::move(*faces);
  if (auto ok = takeFromFace(scene, polygons); !ok) return doesNotFit(ok.error().message);
  return scene;
}

}  // namespace sweepface::gltf
