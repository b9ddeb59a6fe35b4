#include "gltf/bound_scene.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>

#include "gltf/more_targets.hpp"
#include "gltf/triangles.hpp"

namespace sweepface::gltf {
namespace {

std::unexpected<Error> doesNotFit(std::string_view why) {
  return fail(fmt::format("The face and its scene do not fit: {}; convert the source again.", why));
}

/// Finds the part of every face. Where parts share vertices their triangles tell.
class FaceFinder {
 public:
  FaceFinder(const Polygons& polygons, const BoundScene& scene)
      : polygons_(polygons), scene_(scene), partsOfRun_(scene.parts.runs.size()) {
    for (std::size_t p = 0; p < scene.parts.parts.size(); ++p)
      partsOfRun_[scene.parts.parts[p].run].push_back(static_cast<Index>(p));
  }

  Result<std::vector<Index>> find() {
    for (std::size_t p = 0; p < scene_.parts.parts.size(); ++p)
      if (partsOfRun_[scene_.parts.parts[p].run].size() > 1)
        if (auto ok = note(p); !ok) return std::unexpected(ok.error());
    std::vector<Index> parts;
    for (Index face = 0; face < polygons_.faceCount(); ++face) {
      const Index part = partOf(face);
      if (part < 0) return doesNotFit(fmt::format("face {} is in no mesh of it", face));
      parts.push_back(part);
    }
    return parts;
  }

 private:
  Result<void> note(std::size_t part) {
    const auto found = trianglesOf(scene_.document, scene_.parts, scene_.parts.parts[part]);
    if (!found) return std::unexpected(found.error());
    // Parts that share indices could take very long.
    named_ += found->named;
    if (named_ > scene_.document.mostElements()) return doesNotFit("it has far more triangles");
    const auto first = static_cast<Index>(scene_.parts.runs[scene_.parts.parts[part].run].first);
    for (Triangle t : found->triangles) {
      for (Index& v : t) v += first;
      std::ranges::sort(t);
      partOfTriangle_.emplace(t, static_cast<Index>(part));
    }
    return {};
  }

  Index partOf(Index face) {
    const Index* const corners = &polygons_.corners[polygons_.faceStart[face]];
    const Index size = polygons_.faceSize(face);
    const auto& runs = scene_.parts.runs;
    const auto after =
        std::ranges::upper_bound(runs, static_cast<std::size_t>(corners[0]), {}, &Run::first);
    const std::vector<Index>& parts =
        partsOfRun_[static_cast<std::size_t>(after - runs.begin()) - 1];
    if (parts.size() == 1) return parts[0];
    for (Index k = 0; k < size; ++k) {
      Triangle t{corners[k], corners[(k + 1) % size], corners[(k + 2) % size]};
      std::ranges::sort(t);
      const auto found = partOfTriangle_.find(t);
      if (found == partOfTriangle_.end()) continue;
      // The same triangle may be in several parts, one upon the other: each has its face.
      const Index part = found->second;
      partOfTriangle_.erase(found);
      return part;
    }
    return -1;
  }

  const Polygons& polygons_;
  const BoundScene& scene_;
  std::vector<std::vector<Index>> partsOfRun_;
  std::multimap<Triangle, Index> partOfTriangle_;  // vertices in ascending order
  std::size_t named_ = 0;
};

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
  auto document = parseDocument(rig.scene, {});
  if (!document) return doesNotFit(document.error().message);
  auto parts = findParts(*document);
  if (!parts) return doesNotFit(parts.error().message);
  if (document->buffers.size() > 1) return doesNotFit("it has several buffers");
  if (const auto more = newTargets(rig, parts->targets); !more.empty()) {
    if (auto ok = addTargets(*document, *parts, more); !ok) return doesNotFit(ok.error().message);
    parts = findParts(*document);
    if (!parts) return doesNotFit(parts.error().message);
  }
  const std::size_t vertices = rig.source.gridVertex.size();
  if (parts->vertexCount != vertices)
    return doesNotFit(fmt::format("they have {} and {} vertices", vertices, parts->vertexCount));
  BoundScene scene{
      std::move(*document), std::move(*parts), {}, {}, rig.source.polygons.corners, {}};
  auto targets = matchTargets(rig, scene.parts.targets);
  if (!targets) return std::unexpected(targets.error());
  scene.targets = std::move(*targets);
  scene.vertices.resize(vertices);
  std::iota(scene.vertices.begin(), scene.vertices.end(), 0);
  auto faces = FaceFinder(rig.source.polygons, scene).find();
  if (!faces) return std::unexpected(faces.error());
  scene.facePart = std::move(*faces);
  return scene;
}

}  // namespace sweepface::gltf
