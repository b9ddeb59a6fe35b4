#include "gltf/fine_mesh.hpp"

#include <bit>

namespace sweepface::gltf {

FineMeshBuilder::FineMeshBuilder(const BoundScene& scene)
    : scene_(scene), known_(scene.parts.runs.size()) {
  mesh_.runs.resize(scene.parts.runs.size());
  mesh_.triangles.resize(scene.parts.parts.size());
}

std::size_t FineMeshBuilder::Hash::operator()(const Key& key) const {
  std::uint64_t hash = 0;
  const auto add = [&](std::uint64_t bits) {
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
  };
  add(key.gridVertex);
  for (const Index corner : key.place.corners) add(corner);
  for (const double part : {key.place.u, key.place.v}) add(std::bit_cast<std::uint64_t>(part));
  return static_cast<std::size_t>(hash);
}

Index FineMeshBuilder::shared(Index part, Index gridVertex, const Mix& place) {
  const auto [known, isNew] = known_[runOf(part)].try_emplace({gridVertex, place}, 0);
  if (isNew) known->second = single(part, gridVertex, place);
  return known->second;
}

Index FineMeshBuilder::single(Index part, Index gridVertex, const Mix& place) {
  FineMesh::Run& run = mesh_.runs[runOf(part)];
  run.gridVertex.push_back(gridVertex);
  run.places.push_back(place);
  return static_cast<Index>(run.places.size()) - 1;
}

void FineMeshBuilder::addTriangle(Index part, std::array<Index, 3> vertices) {
  if (scene_.parts.meshes[scene_.parts.runs[runOf(part)].rigMesh].mirrors)
    std::swap(vertices[1], vertices[2]);
  mesh_.triangles[part].insert(mesh_.triangles[part].end(), vertices.begin(), vertices.end());
}

FineMesh FineMeshBuilder::take() {
  for (Index part = 0; part < static_cast<Index>(mesh_.triangles.size()); ++part) {
    if (!mesh_.triangles[part].empty()) continue;
    // A glTF has no empty primitives: what shows nothing is a triangle that is a point.
    if (mesh_.runs[runOf(part)].places.empty()) single(part, 0, Mix::at(0));
    mesh_.triangles[part].assign(3, 0);
  }
  return std::move(mesh_);
}

}  // namespace sweepface::gltf
