#include "gltf/left_out.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "gltf/nodes.hpp"
#include "io/text.hpp"

namespace sweepface::gltf {
namespace {

/// How many nodes of scenes show each mesh.
std::vector<std::size_t> timesShown(const Document& document) {
  const Json& nodes = document.list("nodes");
  std::vector<std::size_t> times(document.list("meshes").size());
  const std::vector<bool> isShown = nodesOfScenes(document);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (const auto mesh = findIndex(nodes[n], "mesh", times.size()); mesh && isShown[n])
      ++times[*mesh];
  return times;
}

/// Whether a mesh has targets.
bool morphs(const Json& mesh) {
  return std::ranges::any_of(listOf(mesh, "primitives"), [](const Json& primitive) {
    return !listOf(primitive, "targets").empty();
  });
}

}  // namespace

std::vector<std::set<std::size_t>> otherPrimitives(const Document& document, const Parts& parts) {
  const Json& meshes = document.list("meshes");
  std::vector<std::set<std::size_t>> others(meshes.size());
  for (std::size_t m = 0; m < meshes.size(); ++m)
    for (std::size_t p = 0; p < listOf(meshes[m], "primitives").size(); ++p) others[m].insert(p);
  for (const Part& part : parts.parts)
    others[parts.meshes[parts.runs[part.run].rigMesh].mesh].erase(part.primitive);
  return others;
}

std::vector<std::string> leftOut(const Document& document, const Parts& parts) {
  const std::vector<std::size_t> times = timesShown(document);
  const std::vector<std::set<std::size_t>> others = otherPrimitives(document, parts);
  std::vector<bool> isOfFace(times.size());
  std::vector<std::string> still, again, warnings;
  for (const RigMesh& mesh : parts.meshes) {
    isOfFace[mesh.mesh] = true;
    for (const std::size_t p : others[mesh.mesh]) still.push_back(placeOf(document, mesh.mesh, p));
  }
  for (std::size_t m = 0; m < times.size(); ++m) {
    if (!isOfFace[m] && times[m] > 0 && !morphs(document.list("meshes")[m]))
      still.push_back(placeOf(document, m));
    if (isOfFace[m] && times[m] > 1) again.push_back(placeOf(document, m));
  }
  constexpr std::size_t kMost = 3;
  constexpr const char* kWhere =
      "a .glb of the face shows them, and so do scenes in three.js and Babylon.js; pictures and "
      ".obj files do not";
  if (!still.empty())
    warnings.push_back(fmt::format(
        "Meshes without morph targets, lines and points are not part of the face: {}; {}.",
        io::fewOf(still, kMost), kWhere));
  if (!again.empty())
    warnings.push_back(
        fmt::format("Meshes that several nodes show are part of the face once, where the first one "
                    "stands: {}; as for the others, {}.",
                    io::fewOf(again, kMost), kWhere));
  return warnings;
}

}  // namespace sweepface::gltf
