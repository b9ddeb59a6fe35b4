#include "sweepface/render_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "eval/cells.hpp"
#include "eval/density_triangles.hpp"
#include "eval/triangulate.hpp"
#include "rig/source_quads.hpp"

namespace sweepface {
namespace {

/// Collects triangles, and makes a vertex for each pair of point and texture coordinate. The first
/// texture coordinate at a point goes to the point's own vertex; others get vertices after all
/// points.
class Builder {
 public:
  Builder(std::vector<Vec3> neutral, const Polygons& source)
      : neutral_(std::move(neutral)),
        texcoords_(neutral_.size()),
        textured_(neutral_.size(), false),
        next_(neutral_.size(), -1),
        trianglesOf_(source.materials.size() + 1) {
    mesh_.points = static_cast<Index>(neutral_.size());
  }

  Index vertex(Index point) const { return point; }
  Index vertex(Index point, const Vec2& texcoord) {
    // A pole may have thousands of vertices, but consecutive faces share one: a few looks suffice.
    constexpr int kLooks = 16;
    int looks = 0;
    for (Index v = point; v >= 0 && looks < kLooks; v = next_[v], ++looks) {
      if (!textured_[v]) {
        textured_[v] = true;
        texcoords_[v] = texcoord;
      }
      if (texcoords_[v] == texcoord) return v;
    }
    return addCopy(point, texcoord);
  }

  void addTriangle(Index material, Index a, Index b, Index c) {
    const Index p = mesh_.pointOf(a), q = mesh_.pointOf(b), r = mesh_.pointOf(c);
    if (p == q || q == r || r == p) return;
    for (const Index v : {a, b, c})
      trianglesOf_[material + 1].push_back(static_cast<std::uint32_t>(v));
  }

  void addQuad(Index material, const std::array<Index, 4>& v) {
    const auto length = [&](int a, int b) { return norm(place(v[a]) - place(v[b])); };
    const int first = length(1, 3) < length(0, 2) ? 1 : 0;
    addTriangle(material, v[first], v[first + 1], v[first + 2]);
    addTriangle(material, v[first], v[first + 2], v[(first + 3) % 4]);
  }

  void addPolygon(Index material, std::span<const Index> vertices) {
    corners_.clear();
    for (const Index v : vertices) corners_.push_back(place(v));
    for (const Triangle& t : triangulate(corners_))
      addTriangle(material, vertices[t[0]], vertices[t[1]], vertices[t[2]]);
  }

  RenderMesh take() {
    for (Index k = 0; k < static_cast<Index>(trianglesOf_.size()); ++k) {
      const auto& part = trianglesOf_[k];
      if (part.empty()) continue;
      mesh_.parts.push_back({k - 1, static_cast<std::uint32_t>(mesh_.triangles.size() / 3),
                             static_cast<std::uint32_t>(part.size() / 3)});
      mesh_.triangles.insert(mesh_.triangles.end(), part.begin(), part.end());
    }
    if (std::ranges::count(textured_, true) > 0)
      for (const Vec2& t : texcoords_) {
        mesh_.texcoords.push_back(static_cast<float>(t.x));
        mesh_.texcoords.push_back(static_cast<float>(t.y));
      }
    return std::move(mesh_);
  }

 private:
  const Vec3& place(Index vertex) const { return neutral_[mesh_.pointOf(vertex)]; }

  Index addCopy(Index point, const Vec2& texcoord) {
    mesh_.copies.push_back(point);
    texcoords_.push_back(texcoord);
    textured_.push_back(true);
    next_.push_back(next_[point]);
    return next_[point] = mesh_.vertexCount() - 1;
  }

  RenderMesh mesh_;
  std::vector<Vec3> neutral_;    // [points]
  std::vector<Vec2> texcoords_;  // [vertices]
  std::vector<char> textured_;   // [vertices] whether it has a texture coordinate
  std::vector<Index> next_;      // [vertices] next of the same point, the latest copy first, or -1
  std::vector<std::vector<std::uint32_t>> trianglesOf_;  // by material + 1
  std::vector<Vec3> corners_;
};

}  // namespace

RenderMesh renderSource(const Rig& rig, const Tessellation& grid) {
  const Polygons& faces = rig.source.polygons;
  Builder builder(sourcePositions(rig, grid, blend(rig, {}), {}), faces);
  std::vector<Index> vertices;
  for (Index face = 0; face < faces.faceCount(); ++face) {
    vertices.clear();
    for (Index c = faces.faceStart[face]; c < faces.faceStart[face + 1]; ++c) {
      const Index t = faces.cornerTexcoords.empty() ? -1 : faces.cornerTexcoords[c];
      vertices.push_back(t < 0 ? builder.vertex(faces.corners[c])
                               : builder.vertex(faces.corners[c], faces.texcoords[t]));
    }
    const Index material = faces.faceMaterial.empty() ? -1 : faces.faceMaterial[face];
    if (vertices.size() == 3)
      builder.addTriangle(material, vertices[0], vertices[1], vertices[2]);
    else
      builder.addPolygon(material, vertices);
  }
  return builder.take();
}

namespace {

// Interpolates to the same numbers from either end.
Vec2 between(const Vec2& a, const Vec2& b, std::int64_t step, Index level) {
  if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) return between(b, a, level - step, level);
  const double t = static_cast<double>(step) / level;
  return {std::lerp(a.x, b.x, t), std::lerp(a.y, b.y, t)};
}

/// Materials and texture coordinates of the quads of level 1.
class Quads {
 public:
  explicit Quads(const Rig& rig)
      : faces_(rig.source.polygons),
        corners_(rig.source.quadCorners),
        faceOfQuad_(faceOfQuads(rig)) {}

  Index material(std::size_t quad) const {
    if (faceOfQuad_.empty() || faces_.faceMaterial.empty()) return -1;
    return faces_.faceMaterial[faceOfQuad_[quad]];
  }

  bool isTextured(std::size_t quad) const {
    if (faceOfQuad_.empty() || faces_.cornerTexcoords.empty()) return false;
    return std::ranges::all_of(std::span(corners_).subspan(4 * quad, 4),
                               [&](Index c) { return faces_.cornerTexcoords[c] >= 0; });
  }

  /// The texture coordinate i of m and j of n steps from the first corner of a textured quad;
  /// extrapolated beyond the quad.
  Vec2 texcoord(std::size_t quad, std::int64_t i, Index m, std::int64_t j, Index n) const {
    const auto at = [&](int k) { return texcoordAt(quad, k); };
    if (i == 0) return between(at(0), at(3), j, n);
    if (i == m) return between(at(1), at(2), j, n);
    return between(between(at(0), at(1), i, m), between(at(3), at(2), i, m), j, n);
  }

  /// Whether the texture goes on from quad a to b, which lies beyond a's corners `next` and 2.
  bool areJoined(std::size_t a, std::size_t b, int next) const {
    return isTextured(a) && isTextured(b) && texcoordAt(a, next) == texcoordAt(b, 0) &&
           texcoordAt(a, 2) == texcoordAt(b, 4 - next);
  }

 private:
  const Vec2& texcoordAt(std::size_t quad, int corner) const {
    return faces_.texcoords[faces_.cornerTexcoords[corners_[4 * quad + corner]]];
  }

  const Polygons& faces_;
  const std::vector<Index>& corners_;
  std::vector<Index> faceOfQuad_;  // empty if unknown
};

}  // namespace

RenderMesh renderGrid(const Rig& rig, const Tessellation& grid) {
  const Index level = grid.level();
  const auto faces = grid.faces();
  Builder builder(grid.positions(blend(rig, {})), rig.source.polygons);
  const Quads quads(rig);
  forEachCell(rig.surface, level, [&](const Cell& cell) {
    std::array<Index, 4> vertices = faces[cell.face];
    if (quads.isTextured(cell.quad))
      for (int k = 0; k < 4; ++k) {
        const auto [i, j] = cell.cornerInQuad(k, level);
        vertices[k] = builder.vertex(vertices[k], quads.texcoord(cell.quad, i, level, j, level));
      }
    builder.addQuad(quads.material(cell.quad), vertices);
  });
  return builder.take();
}

// What lies beyond a seam gets its texture coordinates as if the quad before the seam continued.
RenderMesh renderDensity(const Rig& rig, const Tessellation& grid) {
  Builder builder(grid.positions(blend(rig, {})), rig.source.polygons);
  const Quads quads(rig);
  const auto areJoined = [&](std::size_t a, std::size_t b, int next) {
    return quads.areJoined(a, b, next);
  };
  forEachTriangle(rig.surface, grid, areJoined, [&](const DensityTriangle& triangle) {
    const bool textured = quads.isTextured(triangle.middle);
    std::array<Index, 3> corners = triangle.vertices;
    for (int k = 0; k < 3; ++k) {
      const auto& [quad, i, m, j, n] = triangle.places[k];
      corners[k] = textured ? builder.vertex(corners[k], quads.texcoord(quad, i, m, j, n))
                            : builder.vertex(corners[k]);
    }
    builder.addTriangle(quads.material(triangle.middle), corners[0], corners[1], corners[2]);
  });
  return builder.take();
}

}  // namespace sweepface
