#include "gltf/triangles.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace sweepface::gltf {
namespace {

/// The corners of triangle t, as positions in the list of the primitive's indices.
std::array<std::size_t, 3> cornersOf(std::size_t mode, std::size_t t) {
  if (mode == listMode) return {3 * t, 3 * t + 1, 3 * t + 2};
  // Every other triangle of a strip would face the other way.
  if (mode == stripMode) return {t, t + 1 + t % 2, t + 2 - t % 2};
  return {0, t + 1, t + 2};
}

std::vector<Triangle> arranged(std::size_t mode, const std::vector<Index>& indices) {
  const std::size_t count =
      mode == listMode ? indices.size() / 3 : std::max<std::size_t>(indices.size(), 2) - 2;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < count; ++t) {
    const auto [a, b, c] = cornersOf(mode, t);
    const Triangle triangle{indices[a], indices[b], indices[c]};
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      triangles.push_back(triangle);
  }
  return triangles;
}

/// The vertex of the run at each corner.
Result<std::vector<Index>> readIndices(const Document& document, Members& in,
                                       std::size_t vertices) {
  std::vector<Index> indices;
  const auto given = in.optionalIndex("indices", document.list("accessors").size(), "accessors");
  if (!in.ok()) return in.error();
  if (!given) {
    for (std::size_t v = 0; v < vertices; ++v) indices.push_back(static_cast<Index>(v));
    return indices;
  }
  const auto accessor = accessorAt(document, *given);
  if (!accessor) return std::unexpected(accessor.error());
  if (accessor->components() != 1 || !isOfIndices(accessor->type) || accessor->normalized ||
      !accessor->hasData())
    in.refuse(fmt::format("its indices, accessor {}, are not data of unsigned integers", *given));
  if (!in.ok()) return in.error();
  const auto values = decode(document, *accessor);
  if (!values) return std::unexpected(values.error());
  const auto beyond =
      std::ranges::find_if(*values, [&](double v) { return v >= static_cast<double>(vertices); });
  if (beyond != values->end())
    in.refuse(fmt::format("it refers to vertex {}, but has {}", *beyond, vertices));
  if (!in.ok()) return in.error();
  for (const double v : *values) indices.push_back(static_cast<Index>(v));
  return indices;
}

}  // namespace

Result<PartTriangles> trianglesOf(const Document& document, const Parts& parts, const Part& part) {
  const Run& run = parts.runs[part.run];
  Members in(primitiveOf(document, parts, part),
             placeOf(document, parts.meshes[run.rigMesh].mesh, part.primitive));
  const auto indices = readIndices(document, in, run.count);
  if (!indices) return std::unexpected(indices.error());
  PartTriangles found{arranged(in.size("mode", listMode), *indices), indices->size()};
  if (!in.ok()) return in.error();
  return found;
}

}  // namespace sweepface::gltf
