#include "gltf/moved_targets.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace sweepface::gltf {
namespace {

/// How many targets a mesh has.
std::size_t targetCount(const Json& mesh) {
  const Json& primitives = listOf(mesh, "primitives");
  return primitives.empty() ? 0 : listOf(primitives[0], "targets").size();
}

}  // namespace

std::vector<std::vector<Index>> movedTargets(const BoundScene& scene) {
  std::map<std::string_view, Index> numbers;
  for (std::size_t t = 0; t < scene.parts.targets.size(); ++t)
    numbers.emplace(scene.parts.targets[t], scene.targets[t]);
  const Json& meshes = scene.document.list("meshes");
  std::vector<std::vector<Index>> moved(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    moved[m].resize(targetCount(meshes[m]), -1);
    const Json* const extras = find(meshes[m], "extras");
    const Json* const names = extras ? find(*extras, "targetNames") : nullptr;
    if (!names || !names->is_array() || names->size() != moved[m].size()) continue;
    for (std::size_t t = 0; t < names->size(); ++t)
      if (const Json& name = (*names)[t]; name.is_string())
        if (const auto known = numbers.find(name.get_ref<const std::string&>());
            known != numbers.end())
          moved[m][t] = known->second;
  }
  for (const RigMesh& mesh : scene.parts.meshes) {  // which may be called by their numbers
    moved[mesh.mesh].clear();
    for (const std::size_t t : mesh.targets) moved[mesh.mesh].push_back(scene.targets[t]);
  }
  return moved;
}

std::optional<std::vector<double>> weightsOf(const Json& holder, std::size_t targets) {
  const Json& list = listOf(holder, "weights");
  if (list.size() != targets) return std::nullopt;
  std::vector<double> weights;
  for (const Json& weight : list) weights.push_back(weight.is_number() ? weight.get<double>() : 0);
  return weights;
}

}  // namespace sweepface::gltf
