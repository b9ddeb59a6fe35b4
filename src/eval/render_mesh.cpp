#include "sweepface/render_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "eval/cells.hpp"
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

  /// Steps from a textured quad, at position `at` in its row or column, towards `goal` in that,
  /// until a seam is in the way. The next quad is `stride` further on, beyond the corner `next`.
  void follow(std::size_t& quad, Index& at, const Place& goal, Index stride, int next) const {
    while (goal.value() > at + 1 && areJoined(quad, quad + stride, next)) quad += stride, ++at;
    while (goal.value() < at && areJoined(quad - stride, quad, next)) quad -= stride, --at;
  }

 private:
  const Vec2& texcoordAt(std::size_t quad, int corner) const {
    return faces_.texcoords[faces_.cornerTexcoords[corners_[4 * quad + corner]]];
  }
  bool areJoined(std::size_t a, std::size_t b, int next) const {
    return isTextured(a) && isTextured(b) && texcoordAt(a, next) == texcoordAt(b, 0) &&
           texcoordAt(a, 2) == texcoordAt(b, 4 - next);
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
        const Index i = cell.i % level + (k == 1 || k == 2), j = cell.j % level + (k >= 2);
        vertices[k] = builder.vertex(vertices[k], quads.texcoord(cell.quad, i, level, j, level));
      }
    builder.addQuad(quads.material(cell.quad), vertices);
  });
  return builder.take();
}

// A triangle takes its texture coordinates from the quad at its centroid. What lies beyond a seam
// gets them as if that quad continued.
RenderMesh renderDensity(const Rig& rig, const Tessellation& grid) {
  const Surface& surface = rig.surface;
  Builder builder(grid.positions(blend(rig, {})), rig.source.polygons);
  std::size_t first = 0;
  const Quads quads(rig);
  for (Index p = 0; p < surface.patchCount(); ++p) {
    const Index m = surface.edgesU(p), n = surface.edgesV(p);
    const PatchMesh mesh = grid.patchMesh(p);
    for (const auto& triangle : mesh.triangles) {
      double u = 0, v = 0;
      for (const Index k : triangle)
        u += mesh.points[k].u.value() / 3, v += mesh.points[k].v.value() / 3;
      const Index column = std::min(static_cast<Index>(u), m - 1),
                  row = std::min(static_cast<Index>(v), n - 1);
      const std::size_t middle = first + std::size_t(row) * m + column;
      const auto cornerAt = [&](const PatchMesh::Point& point) {
        if (!quads.isTextured(middle)) return builder.vertex(point.vertex);
        std::size_t quad = middle;
        Index i = column, j = row;
        for (int turn = 0; turn < 2; ++turn) {  // once more, around the end of a seam
          quads.follow(quad, i, point.u, 1, 1);
          quads.follow(quad, j, point.v, m, 3);
        }
        const auto steps = [](const Place& place, Index from) {
          return std::int64_t{place.whole - from} * place.of + place.step;
        };
        return builder.vertex(point.vertex, quads.texcoord(quad, steps(point.u, i), point.u.of,
                                                           steps(point.v, j), point.v.of));
      };
      // In this order, as each may add a vertex.
      const std::array corners{cornerAt(mesh.points[triangle[0]]),
                               cornerAt(mesh.points[triangle[1]]),
                               cornerAt(mesh.points[triangle[2]])};
      builder.addTriangle(quads.material(middle), corners[0], corners[1], corners[2]);
    }
    first += std::size_t(m) * n;
  }
  return builder.take();
}

}  // namespace sweepface
