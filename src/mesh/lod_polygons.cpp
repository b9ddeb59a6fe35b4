#include "sweepface/lod_polygons.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "rig/source_quads.hpp"

namespace sweepface {
namespace {

/// Texture coordinates inside the source's quads. Quads that share an edge of the texture share its
/// points, which are keyed by the edge's ends.
class QuadTexture {
 public:
  using Corners = std::array<Index, 4>;  ///< texture coordinates at a quad's corners

  QuadTexture(const std::vector<Vec2>& source, Index level) : points_(source), level_(level) {}

  /// The texture coordinate at (i, j) steps of `level` from the first corner of a quad.
  Index at(Index quad, const Corners& t, Index i, Index j) {
    if (j == 0) return onEdge(t[0], t[1], i);
    if (j == level_) return onEdge(t[3], t[2], i);
    if (i == 0) return onEdge(t[0], t[3], j);
    if (i == level_) return onEdge(t[1], t[2], j);
    const auto [first, isNew] = interiors_.try_emplace(quad, static_cast<Index>(points_.size()));
    if (isNew) addInterior(t);
    return first->second + (j - 1) * (level_ - 1) + i - 1;
  }

  std::vector<Vec2> take() { return std::move(points_); }

 private:
  Vec2 between(const Vec2& a, const Vec2& b, Index step) const {
    const double t = static_cast<double>(step) / level_;
    return {std::lerp(a.x, b.x, t), std::lerp(a.y, b.y, t)};
  }
  void addInterior(const Corners& t) {
    for (Index j = 1; j < level_; ++j)
      for (Index i = 1; i < level_; ++i)
        add(between(between(points_[t[0]], points_[t[1]], i),
                    between(points_[t[3]], points_[t[2]], i), j));
  }
  Index add(const Vec2& point) {
    points_.push_back(point);
    return static_cast<Index>(points_.size()) - 1;
  }
  Index onEdge(Index from, Index to, Index step) {
    if (step == 0 || from == to) return from;
    if (step == level_) return to;
    if (from > to) return onEdge(to, from, level_ - step);
    const auto [place, isNew] = edges_.try_emplace({from, to, step}, 0);
    if (isNew) place->second = add(between(points_[from], points_[to], step));
    return place->second;
  }

  std::vector<Vec2> points_;
  Index level_;
  std::map<std::tuple<Index, Index, Index>, Index> edges_;
  std::map<Index, Index> interiors_;  // by quad: its first interior point
};

class LodPolygons {
 public:
  LodPolygons(const Rig& rig, const Tessellation& grid)
      : rig_(rig),
        source_(rig.source.polygons),
        grid_(grid),
        texture_(source_.texcoords, grid.level()),
        faceOfCorner_(facesOfCorners(source_)) {}

  Polygons make() {
    result_.materials = source_.materials;
    result_.groups = source_.groups;
    result_.materialFiles = source_.materialFiles;
    const std::vector<std::array<Index, 4>> faces = grid_.faces();
    const Index level = grid_.level();
    std::size_t face = 0;
    Index first = 0;  // quad of the patch
    for (Index p = 0; p < rig_.surface.patchCount(); ++p) {
      const Index m = rig_.surface.edgesU(p), n = rig_.surface.edgesV(p);
      for (Index j = 0; j < level * n; ++j)
        for (Index i = 0; i < level * m; ++i)
          addFace(faces[face++], first + j / level * m + i / level, i % level, j % level);
      first += m * n;
    }
    result_.texcoords = texture_.take();
    return std::move(result_);
  }

 private:
  /// Adds the face (i, j) steps into a quad of the source.
  void addFace(const std::array<Index, 4>& vertices, Index quad, Index i, Index j) {
    const Index* const corners = &rig_.source.quadCorners[4 * quad];
    const QuadTexture::Corners texcoords = texcoordsOf(corners);
    const bool textured = std::ranges::all_of(texcoords, [](Index t) { return t >= 0; });
    for (int k = 0; k < 4; ++k) {
      if (vertices[k] == vertices[(k + 1) % 4]) continue;
      result_.corners.push_back(vertices[k]);
      if (!source_.cornerTexcoords.empty())
        result_.cornerTexcoords.push_back(
            textured ? texture_.at(quad, texcoords, i + (k == 1 || k == 2), j + (k >= 2)) : -1);
    }
    result_.faceStart.push_back(static_cast<Index>(result_.corners.size()));
    const Index face = faceOfCorner_[corners[0]];
    if (!source_.faceMaterial.empty()) result_.faceMaterial.push_back(source_.faceMaterial[face]);
    if (!source_.faceGroup.empty()) result_.faceGroup.push_back(source_.faceGroup[face]);
  }

  QuadTexture::Corners texcoordsOf(const Index* corners) const {
    QuadTexture::Corners t{-1, -1, -1, -1};
    if (!source_.cornerTexcoords.empty())
      for (int k = 0; k < 4; ++k) t[k] = source_.cornerTexcoords[corners[k]];
    return t;
  }

  const Rig& rig_;
  const Polygons& source_;
  const Tessellation& grid_;
  QuadTexture texture_;
  std::vector<Index> faceOfCorner_;
  Polygons result_;
};

}  // namespace

Polygons lodPolygons(const Rig& rig, const Tessellation& grid) {
  return LodPolygons(rig, grid).make();
}

}  // namespace sweepface
