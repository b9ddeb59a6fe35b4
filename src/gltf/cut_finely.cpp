#include "eval/triangulate.hpp"
#include "gltf/fine_mesh.hpp"
#include "gltf/scene_quads.hpp"

namespace sweepface::gltf {
namespace {

class Cutter {
 public:
  Cutter(const Rig& rig, const BoundScene& scene, const Tessellation& grid,
         const std::vector<Vec3>& positions, const SceneQuads& quads)
      : rig_(rig),
        grid_(grid),
        positions_(positions),
        quads_(quads),
        level_(grid.level()),
        cell_(static_cast<std::size_t>((level_ + 1) * (level_ + 1))),
        builder_(scene) {}

  FineMesh cut() {
    const Surface& surface = rig_.surface;
    std::size_t quad = 0;
    for (Index p = 0; p < surface.patchCount(); ++p)
      for (Index j = 0; j < surface.edgesV(p); ++j)
        for (Index i = 0; i < surface.edgesU(p); ++i, ++quad)
          if (quads_.partOf(quad) >= 0) cutQuad(p, i, j, quad);
    return builder_.take();
  }

 private:
  struct Corner {
    Index vertex, gridVertex;
  };

  void cutQuad(Index patch, Index i, Index j, std::size_t quad) {
    for (Index b = 0; b <= level_; ++b)
      for (Index a = 0; a <= level_; ++a) {
        const Index g = grid_.vertex(patch, i * level_ + a, j * level_ + b);
        cell_[b * (level_ + 1) + a] = {vertexAt(g, quad, a, b), g};
      }
    for (Index b = 0; b < level_; ++b)
      for (Index a = 0; a < level_; ++a) addCell(a, b, quads_.partOf(quad));
  }

  Index vertexAt(Index g, std::size_t quad, Index a, Index b) {
    const Mix place = Mix::within(quads_.verticesOf(quad), a, level_, b, level_);
    const bool isInside = a > 0 && a < level_ && b > 0 && b < level_;
    return isInside ? builder_.single(quads_.partOf(quad), g, place)
                    : builder_.shared(quads_.partOf(quad), g, place);
  }

  void addCell(Index a, Index b, Index part) {
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
    for (const Triangle& t : triangulate(polygon))
      builder_.addTriangle(
          part, {cell_[loop[t[0]]].vertex, cell_[loop[t[1]]].vertex, cell_[loop[t[2]]].vertex});
  }

  const Rig& rig_;
  const Tessellation& grid_;
  const std::vector<Vec3>& positions_;
  const SceneQuads& quads_;
  Index level_;
  std::vector<Corner> cell_;  // [(level + 1)²] of the current quad
  FineMeshBuilder builder_;
};

}  // namespace

Result<FineMesh> cutFinely(const Rig& rig, const BoundScene& scene, const Tessellation& grid,
                           const std::vector<Vec3>& positions) {
  const auto quads = SceneQuads::find(rig, scene);
  if (!quads) return std::unexpected(quads.error());
  return Cutter(rig, scene, grid, positions, *quads).cut();
}

}  // namespace sweepface::gltf
