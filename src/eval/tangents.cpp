#include "sweepface/tangents.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface {
namespace {

Vec3 inPlane(const Vec3& a, const Vec3& normal) { return a - dot(a, normal) * normal; }

/// The angle between unit vectors, to within 7e-5 (Abramowitz and Stegun, Handbook of Mathematical
/// Functions, 4.4.45), the same on every machine.
double angleBetween(const Vec3& a, const Vec3& b) {
  const double cosine = dot(a, b), x = std::min(std::abs(cosine), 1.0);
  const double angle =
      std::sqrt(1 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - x * 0.0187293)));
  return cosine >= 0 ? angle : 3.14159265358979 - angle;
}

/// Sums over the triangles round a vertex, kept apart by whether their texture coordinates are
/// mirrored.
struct Sums {
  Vec3 along[2];
  double angle[2] = {};

  void add(bool mirrored, const Vec3& tangent, double weight) {
    along[mirrored] += weight * tangent;
    angle[mirrored] += weight;
  }
  bool isMirrored() const { return angle[1] > angle[0]; }
};

Vec2 texcoord(const RenderMesh& mesh, std::uint32_t vertex) {
  return {mesh.texcoords[2 * vertex], mesh.texcoords[2 * vertex + 1]};
}

/// A triangle in the plane of its texture coordinates, from its first corner.
struct Chart {
  Vec2 first, second;

  Chart(const RenderMesh& mesh, const std::uint32_t* v) {
    const Vec2 t0 = texcoord(mesh, v[0]), t1 = texcoord(mesh, v[1]), t2 = texcoord(mesh, v[2]);
    first = {t1.x - t0.x, t1.y - t0.y};
    second = {t2.x - t0.x, t2.y - t0.y};
  }
  double area() const { return first.x * second.y - second.x * first.y; }
};

class Summation {
 public:
  Summation(const RenderMesh& mesh, std::span<const Vec3> positions, std::span<const Vec3> normals)
      : mesh_(mesh), positions_(positions), normals_(normals), sums_(mesh.vertexCount()) {
    if (mesh.texcoords.empty()) return;
    for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) addTriangle(&mesh.triangles[k]);
  }

  Tangents take() const {
    Tangents out;
    for (Index v = 0; v < mesh_.vertexCount(); ++v) {
      const bool mirrored = sums_[v].isMirrored();
      const Vec3 direction = normalized(inPlane(sums_[v].along[mirrored], normal(v)));
      out.directions.push_back(isFinite(direction) ? direction : Vec3{});
      out.signs.push_back(mirrored ? -1.0F : 1.0F);
    }
    return out;
  }

 private:
  const Vec3& place(std::uint32_t vertex) const { return positions_[mesh_.pointOf(vertex)]; }
  const Vec3& normal(std::uint32_t vertex) const { return normals_[mesh_.pointOf(vertex)]; }

  void addTriangle(const std::uint32_t* v) {
    const Chart chart(mesh_, v);
    const double area = chart.area();
    if (area == 0) return;
    const Vec3 scaled =
        chart.second.y * (place(v[1]) - place(v[0])) - chart.first.y * (place(v[2]) - place(v[0]));
    const Vec3 tangent = area > 0 ? scaled : -scaled;  // ∂P/∂u but for its length
    for (int c = 0; c < 3; ++c) addCorner(v[c], v[(c + 1) % 3], v[(c + 2) % 3], area < 0, tangent);
  }

  void addCorner(std::uint32_t v, std::uint32_t next, std::uint32_t last, bool mirrored,
                 const Vec3& tangent) {
    const auto direction = [&](const Vec3& a) { return normalized(inPlane(a, normal(v))); };
    const double angle =
        angleBetween(direction(place(next) - place(v)), direction(place(last) - place(v)));
    sums_[v].add(mirrored, direction(tangent), angle);
  }

  const RenderMesh& mesh_;
  std::span<const Vec3> positions_, normals_;  // [points]
  std::vector<Sums> sums_;                     // [vertices]
};

}  // namespace

void splitMirrored(RenderMesh& mesh) {
  if (mesh.texcoords.empty()) return;
  const Index count = mesh.vertexCount();
  const auto forEachCorner = [&](bool mirrored, auto use) {
    for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
      std::uint32_t* const v = &mesh.triangles[k];
      const double area = Chart(mesh, v).area();
      if (mirrored ? area < 0 : area > 0)
        for (int c = 0; c < 3; ++c) use(v[c]);
    }
  };
  std::vector<char> isPlain(count);
  forEachCorner(false, [&](std::uint32_t v) { isPlain[v] = true; });
  std::vector<Index> copy(count, -1);
  forEachCorner(true, [&](std::uint32_t& v) {
    if (!isPlain[v]) return;
    if (copy[v] < 0) {
      copy[v] = mesh.vertexCount();
      mesh.copies.push_back(mesh.pointOf(static_cast<Index>(v)));
      const Vec2 t = texcoord(mesh, v);
      mesh.texcoords.insert(mesh.texcoords.end(),
                            {static_cast<float>(t.x), static_cast<float>(t.y)});
    }
    v = static_cast<std::uint32_t>(copy[v]);
  });
}

Tangents tangentsOf(const RenderMesh& mesh, std::span<const Vec3> positions,
                    std::span<const Vec3> normals) {
  return Summation(mesh, positions, normals).take();
}

Tangents neutralTangents(const Rig& rig, const Tessellation& grid, const RenderMesh& mesh,
                         Index level) {
  const auto vectors = blend(rig, {});
  if (level > 0) return tangentsOf(mesh, grid.positions(vectors), grid.normals(vectors));
  return tangentsOf(mesh, sourcePositions(rig, grid, vectors, {}),
                    sourceNormals(rig, grid, vectors));
}

}  // namespace sweepface
