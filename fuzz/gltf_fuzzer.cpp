#include <algorithm>
#include <cmath>
#include <cstring>

#include "sweepface/gltf.hpp"

#include "gltf/bound_scene.hpp"
#include "gltf/scene.hpp"
#include "gltf/triangles.hpp"
#include "gltf_mutator.hpp"
#include "mesh_properties.hpp"

namespace {

using namespace sweepface;
using fuzzing::require;

/// Every target has a name of its own and a finite place for every vertex.
void requireTargets(const MeshRig& rig) {
  std::vector<std::string> names;
  for (const MeshTarget& target : rig.targets) {
    require(!target.name.empty());
    names.push_back(target.name);
    require(target.positions.size() == rig.neutral.positions.size());
    for (const Vec3& position : target.positions) require(isFinite(position));
  }
  std::ranges::sort(names);
  require(std::ranges::adjacent_find(names) == names.end());
}

/// The scene has the same parts as its source, and is its own scene.
void requireScene(const RigSource& source) {
  auto scene = gltf::parseScene(source.scene);
  require(scene.has_value());
  const auto parts = gltf::findParts(*scene);
  require(parts.has_value());
  require(parts->vertexCount == source.rig.neutral.positions.size());
  require(parts->targets.size() == source.rig.targets.size());
  const auto again = gltf::makeScene(std::move(*scene), *parts, source.rig.neutral.polygons, {});
  require(again.has_value() && gltf::formatScene(again->glb) == source.scene);
}

/// The scene takes back what it left to the face: the same triangles.
void requireTriangles(const RigSource& source) {
  Rig rig;
  for (const MeshTarget& target : source.rig.targets) rig.targets.emplace_back(target.name);
  rig.scene = source.scene;
  rig.source.gridVertex.resize(source.rig.neutral.positions.size());
  rig.source.polygons = source.rig.neutral.polygons;
  const auto scene = gltf::sceneOf(rig);
  require(scene.has_value());
  std::size_t count = 0;
  for (const gltf::Part& part : scene->parts.parts) {
    const auto found = gltf::trianglesOf(scene->document, scene->parts, part);
    require(found.has_value());
    count += found->triangles.size();
  }
  const Polygons& faces = rig.source.polygons;
  require(count == faces.corners.size() - 2 * static_cast<std::size_t>(faces.faceCount()));
}

}  // namespace

void requireSound(const sweepface::Result<sweepface::Clip>& clip) {
  if (!clip) {
    const std::string& message = clip.error().message;
    return require(message.starts_with("input.glb: ") && fuzzing::isSentence(message));
  }
  require(!clip->times.empty() && std::ranges::is_sorted(clip->times));
  require(clip->weights.size() == clip->times.size() * clip->names.size());
  for (const double weight : clip->weights) require(std::isfinite(weight));
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  requireSound(parseGltfClip(fuzzing::asText(data, size), "input.glb", {}));
  const auto source = parseGltf(fuzzing::asText(data, size), "input.glb", {});
  if (!source) {
    const std::string& message = source.error().message;
    require(message.starts_with("input.glb: ") && fuzzing::isSentence(message));
    return 0;
  }
  fuzzing::requireWhole(source->rig.neutral);
  requireTargets(source->rig);
  requireScene(*source);
  requireTriangles(*source);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t maxSize, unsigned seed) {
  auto pieces = fuzzing::takeApart(fuzzing::asText(data, size));
  if (!pieces || seed % 16 == 0) return LLVMFuzzerMutate(data, size, maxSize);
  fuzzing::Mutator(seed).mutate(*pieces);
  const std::string bytes = gltf::formatContainer(pieces->json, pieces->binary);
  if (bytes.size() > maxSize) return LLVMFuzzerMutate(data, size, maxSize);
  std::memcpy(data, bytes.data(), bytes.size());
  return bytes.size();
}
