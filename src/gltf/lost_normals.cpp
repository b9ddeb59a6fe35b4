#include "gltf/lost_normals.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace sweepface::gltf {
namespace {

// Cosines: more than 30 degrees apart, but not the two sides of a doubled sheet.
constexpr double kFar = 0.866, kOpposite = -0.999;
// A smaller share is lashes and rims, which a smooth surface may have.
constexpr double kShare = 0.01;
// The cosine of 45 degrees. Only tips and rims have normals that far from the mean of the triangles
// around, unless they are not meant to be those of the mesh.
constexpr double kOther = 0.707, kShareOfOthers = 0.05;

bool areApart(const Vec3& a, const Vec3& b) {
  const double lengths = norm(a) * norm(b), cosine = dot(a, b);
  return cosine < kFar * lengths && cosine > kOpposite * lengths;
}

/// The normals of a primitive's vertices; empty if it has none or some are not numbers: the face
/// can do without.
std::vector<Vec3> normalsOf(const Document& document, const Json& primitive) {
  const Json* const number = find(*find(primitive, "attributes"), "NORMAL");
  if (!number) return {};
  const auto accessor = accessorAt(document, number->get<std::size_t>());
  if (!accessor || !accessor->hasData()) return {};
  return asVectors(decode(document, *accessor).value_or(std::vector<double>{}));
}

/// [places] The sum of the triangles' normals there, weighted by their areas.
std::vector<Vec3> trianglesNormals(const MeshRig& rig, std::span<const Index> places) {
  const auto& [positions, polygons] = rig.neutral;
  std::vector<Vec3> normals(places.size());
  for (std::size_t c = 0; c + 2 < polygons.corners.size(); c += 3) {
    const std::span corners = std::span(polygons.corners).subspan(c, 3);
    const Vec3& a = positions[corners[0]];
    const Vec3 normal = cross(positions[corners[1]] - a, positions[corners[2]] - a);
    for (const Index v : corners) normals[places[v]] += normal;
  }
  return normals;
}

/// What is known of the normals at a place.
struct Place {
  Vec3 first;  // of a vertex, 0 if none has one
  bool isHard = false, isOther = false;
};

std::vector<Place> placesOf(const Document& document, const Parts& parts, const MeshRig& rig,
                            std::span<const Index> places) {
  const std::vector<Vec3> expected = trianglesNormals(rig, places);
  std::vector<Place> found(places.size());
  std::vector<bool> isRead(parts.runs.size());
  for (const Part& part : parts.parts) {
    if (isRead[part.run]) continue;
    isRead[part.run] = true;
    const std::vector<Vec3> normals = normalsOf(document, primitiveOf(document, parts, part));
    const Run& run = parts.runs[part.run];
    for (std::size_t v = 0; v < normals.size(); ++v) {
      const Vec3& normal = normals[v];
      const auto at = static_cast<std::size_t>(places[run.first + v]);
      Place& place = found[at];
      const Vec3 own = parts.meshes[run.rigMesh].world.transposed(expected[at]);
      place.isOther |= dot(own, normal) < kOther * norm(own) * norm(normal);
      if (norm(place.first) == 0) place.first = normal;
      place.isHard |= areApart(place.first, normal);
    }
  }
  return found;
}

}  // namespace

std::string lostNormals(const Document& document, const Parts& parts, const MeshRig& rig,
                        std::span<const Index> places) {
  const std::vector<Place> found = placesOf(document, parts, rig, places);
  const auto all = std::ranges::count_if(found, [](const Place& p) { return norm(p.first) > 0; });
  const auto hard = std::ranges::count_if(found, &Place::isHard),
             other = std::ranges::count_if(found, &Place::isOther);
  if (static_cast<double>(hard) > kShare * static_cast<double>(all))
    return fmt::format(
        "At {} of {} places the vertices have normals more than 30 degrees apart (flat shading or "
        "sharp edges): the surface is smooth and has one normal at each.",
        hard, all);
  if (static_cast<double>(other) > kShareOfOthers * static_cast<double>(all))
    return fmt::format(
        "At {} of {} places the vertices have normals more than 45 degrees from those of the "
        "triangles around them (made for shading, or the triangles look inwards): the surface has "
        "normals of its own.",
        other, all);
  return {};
}

}  // namespace sweepface::gltf
