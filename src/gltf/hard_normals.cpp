#include "gltf/hard_normals.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace sweepface::gltf {
namespace {

// Cosines: more than 30 degrees apart, but not the two sides of a doubled sheet.
constexpr double kFar = 0.866, kOpposite = -0.999;
// A smaller share is lashes and rims, which a smooth surface may have.
constexpr double kShare = 0.01;

bool areApart(const Vec3& a, const Vec3& b) {
  const double lengths = norm(a) * norm(b), cosine = dot(a, b);
  return cosine < kFar * lengths && cosine > kOpposite * lengths;
}

/// The normals of a primitive's vertices; empty if it has none or some are not numbers: the face
/// can do without.
std::vector<double> normalsOf(const Document& document, const Json& primitive) {
  const Json* const number = find(*find(primitive, "attributes"), "NORMAL");
  if (!number) return {};
  const auto accessor = accessorAt(document, number->get<std::size_t>());
  if (!accessor || !accessor->hasData()) return {};
  return decode(document, *accessor).value_or(std::vector<double>{});
}

}  // namespace

std::string hardNormals(const Document& document, const Parts& parts,
                        std::span<const Index> places) {
  std::vector<Vec3> first(places.size());  // [places] a normal there, 0 if there is none yet
  std::vector<bool> isHard(places.size()), isRead(parts.runs.size());
  for (const Part& part : parts.parts) {
    if (isRead[part.run]) continue;
    isRead[part.run] = true;
    const std::vector<double> normals = normalsOf(document, primitiveOf(document, parts, part));
    const std::size_t begin = parts.runs[part.run].first;
    for (std::size_t v = 0; v < normals.size() / 3; ++v) {
      const double* const n = normals.data() + 3 * v;
      const Vec3 normal{n[0], n[1], n[2]};
      const auto place = static_cast<std::size_t>(places[begin + v]);
      if (norm(first[place]) == 0) first[place] = normal;
      isHard[place] = isHard[place] || areApart(first[place], normal);
    }
  }
  const auto hard = std::ranges::count(isHard, true);
  const auto all = std::ranges::count_if(first, [](const Vec3& n) { return norm(n) > 0; });
  if (static_cast<double>(hard) <= kShare * static_cast<double>(all)) return {};
  return fmt::format(
      "At {} of {} places the vertices have normals more than 30 degrees apart (flat shading or "
      "sharp edges): the surface is smooth and has one normal at each.",
      hard, all);
}

}  // namespace sweepface::gltf
