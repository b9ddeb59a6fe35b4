#include "sweepface/origins.hpp"

#include <algorithm>
#include <utility>

#include "eval/cells.hpp"

namespace sweepface {
namespace {

class Finder {
 public:
  Finder(const Rig& rig, const Tessellation& grid)
      : rig_(rig), grid_(grid), origins_(grid.vertexCount()) {
    const Tessellation once(rig.surface, 1);
    std::vector<Index> sourceOf(once.vertexCount(), 0);
    const std::vector<Index>& places = rig.source.gridVertex;
    for (Index v = static_cast<Index>(places.size()) - 1; v >= 0; --v)  // the first of several
      if (places[v] >= 0) sourceOf[places[v]] = v;
    quads_ = once.faces();
    for (auto& quad : quads_)
      for (Index& corner : quad) corner = sourceOf[corner];
    std::size_t first = 0;
    for (Index p = 0; p < rig.surface.patchCount(); ++p) {
      firstQuads_.push_back(first);
      first += std::size_t(rig.surface.edgesU(p)) * rig.surface.edgesV(p);
    }
  }

  std::vector<Origin> find() {
    if (grid_.isOfSites())
      fromSites();
    else if (grid_.level() > 0)
      fromCells();
    else
      fromPatches();
    return std::move(origins_);
  }

 private:
  void fromCells() {
    const Index level = grid_.level();
    const auto faces = grid_.faces();
    forEachCell(rig_.surface, level, [&](const Cell& cell) {
      for (int k = 0; k < 4; ++k) {
        const auto [i, j] = cell.cornerInQuad(k, level);
        place(faces[cell.face][k], cell.quad, static_cast<double>(i) / level,
              static_cast<double>(j) / level);
      }
    });
  }

  void fromPatches() {
    for (Index p = 0; p < rig_.surface.patchCount(); ++p)
      for (const auto& [vertex, u, v] : grid_.patchMesh(p).points)
        place(vertex, {p, u.value(), v.value()});
  }

  void fromSites() {
    for (Index v = 0; v < grid_.vertexCount(); ++v) place(v, grid_.site(v));
  }

  void place(Index vertex, const Site& site) {
    const Index m = rig_.surface.edgesU(site.patch), n = rig_.surface.edgesV(site.patch),
                i = std::min(static_cast<Index>(site.u), m - 1),
                j = std::min(static_cast<Index>(site.v), n - 1);
    place(vertex, firstQuads_[site.patch] + std::size_t(j) * m + i, site.u - i, site.v - j);
  }

  /// Places a vertex at u and v, 0 to 1, of a quad.
  void place(Index vertex, std::size_t quad, double u, double v) {
    Origin& origin = origins_[vertex];
    if (origin.shares[0] > 0) return;
    const std::array shares{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
    std::size_t count = 0;
    for (int k = 0; k < 4; ++k) {
      if (shares[k] == 0) continue;
      const Index source = quads_[quad][k];
      const auto known =
          std::find(origin.vertices.begin(), origin.vertices.begin() + count, source);
      const auto slot = static_cast<std::size_t>(known - origin.vertices.begin());
      origin.vertices[slot] = source;
      origin.shares[slot] += shares[k];
      count = std::max(count, slot + 1);
    }
    std::fill(origin.vertices.begin() + count, origin.vertices.end(), origin.vertices[0]);
  }

  const Rig& rig_;
  const Tessellation& grid_;
  std::vector<std::array<Index, 4>> quads_;  // of level 1: vertices of the source
  std::vector<std::size_t> firstQuads_;      // [patches]
  std::vector<Origin> origins_;
};

}  // namespace

Result<std::vector<Origin>> originsOf(const Rig& rig, const Tessellation& grid) {
  if (rig.source.gridVertex.empty()) return fail("The face came without its source's vertices.");
  return Finder(rig, grid).find();
}

}  // namespace sweepface
