#include "mesh/check_indices.hpp"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>

namespace sweepface {
namespace {

/// One of `count` things for each of `size`, or with `orNone` also -1; `what` has it, in messages.
Result<void> checkEach(const std::vector<Index>& indices, std::size_t size, std::size_t count,
                       bool orNone, std::string_view what, std::string_view things) {
  if (indices.size() != size)
    return fail(
        fmt::format("the mesh has {} {} for {}; give one for each", indices.size(), things, size));
  for (std::size_t k = 0; k < size; ++k)
    if (indices[k] < (orNone ? -1 : 0) || indices[k] >= static_cast<std::int64_t>(count))
      return fail(fmt::format("{} {} of the mesh is of number {} among {} {}", what, k, indices[k],
                              count, things));
  return {};
}

Result<void> checkFaces(const Polygons& polygons) {
  const std::vector<Index>& start = polygons.faceStart;
  if (start.empty() || start.front() != 0 || !std::ranges::is_sorted(start) ||
      static_cast<std::size_t>(start.back()) != polygons.corners.size())
    return fail(
        "the faces of the mesh do not divide its corners; they start at 0, go on where the one "
        "before ends, and end with the last corner");
  return {};
}

}  // namespace

Result<void> checkIndices(const MeshRig& meshes) {
  const auto& [positions, polygons] = meshes.neutral;
  if (auto ok = checkFaces(polygons); !ok) return ok;
  const std::size_t corners = polygons.corners.size(),
                    faces = static_cast<std::size_t>(polygons.faceCount());
  if (auto ok = checkEach(polygons.corners, corners, positions.size(), false, "corner", "vertices");
      !ok)
    return ok;
  if (!polygons.cornerTexcoords.empty())
    if (auto ok = checkEach(polygons.cornerTexcoords, corners, polygons.texcoords.size(), true,
                            "corner", "texture coordinates");
        !ok)
      return ok;
  if (!polygons.faceMaterial.empty())
    if (auto ok = checkEach(polygons.faceMaterial, faces, polygons.materials.size(), true, "face",
                            "materials");
        !ok)
      return ok;
  if (!polygons.faceGroup.empty())
    if (auto ok =
            checkEach(polygons.faceGroup, faces, polygons.groups.size(), true, "face", "groups");
        !ok)
      return ok;
  for (const MeshTarget& target : meshes.targets)
    if (target.positions.size() != positions.size())
      return fail(fmt::format("the target '{}' has {} vertices, and the neutral {}", target.name,
                              target.positions.size(), positions.size()));
  return {};
}

}  // namespace sweepface
