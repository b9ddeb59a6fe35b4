#include "gltf/bound_scene.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <numeric>
#include <set>
#include <span>

#include "gltf/more_targets.hpp"
#include "gltf/triangles.hpp"

namespace sweepface::gltf {
namespace {

std::unexpected<Error> doesNotFit(std::string_view why) {
  return fail(fmt::format("The face and its scene do not fit: {}; convert the source again.", why));
}

/// Finds the part of every face. Where parts share vertices their triangles tell: faces come in the
/// order of the parts, so that each run of vertices is gone through part by part.
class FaceFinder {
 public:
  FaceFinder(const Polygons& polygons, const BoundScene& scene)
      : polygons_(polygons), scene_(scene), runs_(scene.parts.runs.size()) {
    for (std::size_t p = 0; p < scene.parts.parts.size(); ++p)
      runs_[scene.parts.parts[p].run].parts.push_back(static_cast<Index>(p));
  }

  Result<std::vector<Index>> find() {
    std::vector<Index> parts;
    for (Index face = 0; face < polygons_.faceCount(); ++face) {
      const auto part = partOf(face);
      if (!part) return std::unexpected(part.error());
      parts.push_back(*part);
    }
    return parts;
  }

 private:
  /// The parts of a run, and what no face has taken of the triangles of the last one looked at.
  struct RunParts {
    std::vector<Index> parts;
    std::size_t next = 0;          // in parts
    std::multiset<Triangle> left;  // vertices in ascending order
  };

  Result<Index> partOf(Index face) {
    const std::span corners(&polygons_.corners[polygons_.faceStart[face]],
                            static_cast<std::size_t>(polygons_.faceSize(face)));
    const auto& runs = scene_.parts.runs;
    const auto after =
        std::ranges::upper_bound(runs, static_cast<std::size_t>(corners[0]), {}, &Run::first);
    RunParts& run = runs_[static_cast<std::size_t>(after - runs.begin()) - 1];
    if (run.parts.size() == 1) return run.parts[0];
    while (!take(run.left, corners)) {
      if (run.next == run.parts.size())
        return doesNotFit(fmt::format("face {} is in no mesh of it", face));
      if (auto ok = note(run, run.parts[run.next++]); !ok) return std::unexpected(ok.error());
    }
    return run.parts[run.next - 1];
  }

  Result<void> note(RunParts& run, Index part) {
    const auto found = trianglesOf(scene_.document, scene_.parts, scene_.parts.parts[part]);
    if (!found) return std::unexpected(found.error());
    // Parts that share indices could take very long.
    named_ += found->named;
    if (named_ > scene_.document.mostElements()) return doesNotFit("it has far more triangles");
    const auto first = static_cast<Index>(scene_.parts.runs[scene_.parts.parts[part].run].first);
    run.left.clear();
    for (Triangle t : found->triangles) {
      for (Index& v : t) v += first;
      std::ranges::sort(t);
      run.left.insert(t);
    }
    return {};
  }

  /// Takes the triangles of a face out of those that are left; false where there are none. A quad's
  /// are the halves beside one of its diagonals. One of them may lie in another part, or be told by
  /// copies of its vertices.
  static bool take(std::multiset<Triangle>& left, std::span<const Index> corners) {
    const std::size_t size = corners.size();
    const auto half = [&](std::size_t k) {
      Triangle t{corners[k % size], corners[(k + 1) % size], corners[(k + 2) % size]};
      std::ranges::sort(t);
      return left.find(t);
    };
    for (const std::size_t k : {0, 1}) {
      const auto one = half(k), other = half(k + 2);
      if (size != 4 || one == left.end() || other == left.end() || one == other) continue;
      left.erase(one);
      left.erase(other);
      return true;
    }
    for (std::size_t k = 0; k < (size == 4 ? 4 : 1); ++k)
      if (const auto one = half(k); one != left.end()) return left.erase(one), true;
    return false;
  }

  const Polygons& polygons_;
  const BoundScene& scene_;
  std::vector<RunParts> runs_;
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
  // What its accessors may claim counts on the shapes that were taken out as well.
  const std::size_t vertices = rig.source.gridVertex.size();
  document->sourceBytes += 12 * vertices;
  if (const auto more = newTargets(rig, parts->targets); !more.empty()) {
    if (auto ok = addTargets(*document, *parts, more); !ok) return doesNotFit(ok.error().message);
    parts = findParts(*document);
    if (!parts) return doesNotFit(parts.error().message);
  }
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
