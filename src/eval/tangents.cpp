#include "sweepface/tangents.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface {
namespace {

Vec3 inPlane(const Vec3& a, const Vec3& normal) { return a - dot(a, normal) * normal; }

/// The angle between unit vectors to within 7e-5 (Abramowitz and Stegun, Handbook of Mathematical
/// Functions, 4.4.45), the same on every machine.
double angleBetween(const Vec3& a, const Vec3& b) {
  const double cosine = dot(a, b), x = std::min(std::abs(cosine), 1.0);
  const double angle =
      std::sqrt(1 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - x * 0.0187293)));
  return cosine >= 0 ? angle : 3.14159265358979 - angle;
}

/// Of the triangles round a vertex, apart by whether their texture coordinates are mirrored.
struct Sums {
  Vec3 along[2];
  double angle[2] = {};

  void add(bool mirrored, const Vec3& tangent, double weight) {
    along[mirrored] += weight * tangent;
    angle[mirrored] += weight;
  }
  bool isMirrored() const { return angle[1] > angle[0]; }
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
  Vec2 texcoord(std::uint32_t vertex) const {
    return {mesh_.texcoords[2 * vertex], mesh_.texcoords[2 * vertex + 1]};
  }

  void addTriangle(const std::uint32_t* v) {
    const Vec2 t0 = texcoord(v[0]), t1 = texcoord(v[1]), t2 = texcoord(v[2]);
    const double v1 = t1.y - t0.y, v2 = t2.y - t0.y;
    const double area = (t1.x - t0.x) * v2 - (t2.x - t0.x) * v1;
    if (area == 0) return;
    const Vec3 scaled = v2 * (place(v[1]) - place(v[0])) - v1 * (place(v[2]) - place(v[0]));
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

Tangents tangentsOf(const RenderMesh& mesh, std::span<const Vec3> positions,
                    std::span<const Vec3> normals) {
  return Summation(mesh, positions, normals).take();
}

}  // namespace sweepface
