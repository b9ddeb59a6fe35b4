#include <unordered_map>

#include "eval/triangulate.hpp"
#include "gltf/fine_mesh.hpp"
#include "gltf/same_vertices.hpp"
#include "rig/source_quads.hpp"

namespace sweepface::gltf {
namespace {

/// Vertices of a run on the edges of the source's quads: the same place between the same vertices
/// is the same vertex.
class EdgeVertices {
 public:
  explicit EdgeVertices(FineMesh::Run& run) : run_(&run) {}

  Index at(Index gridVertex, const Mix& place) {
    const Key key{gridVertex, place.corners[0], place.corners[1]};
    const auto [known, isNew] = known_.try_emplace(key, 0);
    if (isNew) known->second = add(gridVertex, place);
    return known->second;
  }
  Index add(Index gridVertex, const Mix& place) {
    run_->gridVertex.push_back(gridVertex);
    run_->places.push_back(place);
    return static_cast<Index>(run_->places.size()) - 1;
  }

 private:
  using Key = std::array<Index, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::size_t hash = 0;
      for (const Index k : key)
        hash = (hash ^ static_cast<std::size_t>(k)) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
      return hash;
    }
  };

  FineMesh::Run* run_;
  std::unordered_map<Key, Index, Hash> known_;
};

class Cutter {
 public:
  Cutter(const Rig& rig, const BoundScene& scene, const Tessellation& grid,
         const std::vector<Vec3>& positions, const std::vector<Index>& same)
      : rig_(rig),
        scene_(scene),
        grid_(grid),
        positions_(positions),
        same_(same),
        level_(grid.level()),
        cell_(static_cast<std::size_t>((level_ + 1) * (level_ + 1))),
        faceOfQuad_(faceOfQuads(rig)) {
    mesh_.runs.resize(scene.parts.runs.size());
    mesh_.triangles.resize(scene.parts.parts.size());
    for (FineMesh::Run& run : mesh_.runs) vertices_.emplace_back(run);
  }

  Result<FineMesh> cut() {
    const Surface& surface = rig_.surface;
    std::size_t quad = 0;
    for (Index p = 0; p < surface.patchCount(); ++p)
      for (Index j = 0; j < surface.edgesV(p); ++j)
        for (Index i = 0; i < surface.edgesU(p); ++i, ++quad)
          if (auto ok = cutQuad(p, i, j, quad); !ok) return std::unexpected(ok.error());
    for (std::size_t part = 0; part < mesh_.triangles.size(); ++part)
      if (mesh_.triangles[part].empty()) addDot(part);
    return std::move(mesh_);
  }

 private:
  struct Corner {
    Index vertex, gridVertex;
  };

  Result<void> cutQuad(Index patch, Index i, Index j, std::size_t quad) {
    const Index part = scene_.facePart[faceOfQuad_[quad]];
    if (part < 0) return {};
    const Index* const corners = &rig_.source.quadCorners[4 * quad];
    const std::size_t number = scene_.parts.parts[part].run;
    const Run& run = scene_.parts.runs[number];
    std::array<Index, 4> vertices{};
    for (int k = 0; k < 4; ++k) {
      vertices[k] = same_[scene_.cornerVertex[corners[k]]] - static_cast<Index>(run.first);
      if (vertices[k] < 0 || vertices[k] >= static_cast<Index>(run.count))
        return fail("A quad of the face belongs to two meshes of its scene; convert it again.");
    }
    for (Index b = 0; b <= level_; ++b)
      for (Index a = 0; a <= level_; ++a) {
        const Index g = grid_.vertex(patch, i * level_ + a, j * level_ + b);
        cell_[b * (level_ + 1) + a] = {vertexAt(vertices_[number], g, vertices, a, b), g};
      }
    const bool mirrored = scene_.parts.meshes[run.rigMesh].mirrors;
    for (Index b = 0; b < level_; ++b)
      for (Index a = 0; a < level_; ++a) addCell(a, b, mirrored, mesh_.triangles[part]);
    return {};
  }

  Index vertexAt(EdgeVertices& known, Index g, const std::array<Index, 4>& c, Index a,
                 Index b) const {
    if (b == 0) return known.at(g, Mix::between(c[0], c[1], a, level_));
    if (b == level_) return known.at(g, Mix::between(c[3], c[2], a, level_));
    if (a == 0) return known.at(g, Mix::between(c[0], c[3], b, level_));
    if (a == level_) return known.at(g, Mix::between(c[1], c[2], b, level_));
    return known.add(g, {c, static_cast<double>(a) / level_, static_cast<double>(b) / level_});
  }

  void addCell(Index a, Index b, bool mirrored, std::vector<Index>& triangles) {
    const Index row = level_ + 1, first = b * row + a;
    std::vector<Index> loop;
    std::vector<Vec3> polygon;
    for (const Index k : {first, first + 1, first + row + 1, first + row}) {
      // Where a side is collapsed, two neighbours are one.
      if (!loop.empty() && cell_[loop.back()].gridVertex == cell_[k].gridVertex) continue;
      if (!loop.empty() && cell_[loop.front()].gridVertex == cell_[k].gridVertex) continue;
      loop.push_back(k);
      polygon.push_back(positions_[cell_[k].gridVertex]);
    }
    if (loop.size() < 3) return;
    for (Triangle t : triangulate(polygon)) {
      if (mirrored) std::swap(t[1], t[2]);
      for (const Index k : t) triangles.push_back(cell_[loop[k]].vertex);
    }
  }

  /// Keeps a part without any surface as a triangle that is a point: a glTF has no empty
  /// primitives.
  void addDot(std::size_t part) {
    const std::size_t run = scene_.parts.parts[part].run;
    if (mesh_.runs[run].places.empty()) vertices_[run].add(0, Mix::at(0));
    mesh_.triangles[part].assign(3, 0);
  }

  const Rig& rig_;
  const BoundScene& scene_;
  const Tessellation& grid_;
  const std::vector<Vec3>& positions_;
  const std::vector<Index>& same_;
  Index level_;
  std::vector<Corner> cell_;  // [(level + 1)²] of the current quad
  std::vector<Index> faceOfQuad_;
  std::vector<EdgeVertices> vertices_;  // [runs]
  FineMesh mesh_;
};

}  // namespace

Result<FineMesh> cutFinely(const Rig& rig, const BoundScene& scene, const Tessellation& grid,
                           const std::vector<Vec3>& positions) {
  std::vector<Index> places;
  for (const Index v : scene.vertices) places.push_back(rig.source.gridVertex[v]);
  const auto same = sameVertices(scene.document, scene.parts, places);
  if (!same) return std::unexpected(same.error());
  return Cutter(rig, scene, grid, positions, *same).cut();
}

}  // namespace sweepface::gltf
