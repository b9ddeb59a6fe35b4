#include "mesh/check_indices.hpp"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>

namespace sweepface {
namespace {

/// A list that names one of `count` things for each of `size` corners or faces.
struct References {
  const std::vector<Index>& numbers;
  std::size_t size, count;
  std::string_view what, things;
  bool areOptional = true;  ///< the list may be empty, or have -1 for none

  Result<void> check() const {
    if (areOptional && numbers.empty()) return {};
    if (numbers.size() != size)
      return fail(fmt::format("the mesh has {} {} for {} {}s; give one for each", numbers.size(),
                              things, size, what));
    for (std::size_t k = 0; k < size; ++k)
      if (numbers[k] < (areOptional ? -1 : 0) || numbers[k] >= static_cast<std::int64_t>(count))
        return fail(fmt::format("{} {} of the mesh is of number {} among {} {}", what, k,
                                numbers[k], count, things));
    return {};
  }
};

bool divideTheirCorners(const Polygons& polygons) {
  const std::vector<Index>& start = polygons.faceStart;
  return !start.empty() && start.front() == 0 && std::ranges::is_sorted(start) &&
         static_cast<std::size_t>(start.back()) == polygons.corners.size();
}

}  // namespace

Result<void> checkIndices(const MeshRig& meshes) {
  const auto& [positions, faces] = meshes.neutral;
  if (!divideTheirCorners(faces))
    return fail(
        "the faces of the mesh do not divide its corners; they start at 0, go on where the one "
        "before ends, and end with the last corner");
  for (Index f = 0; f < faces.faceCount(); ++f)
    if (faces.faceSize(f) < 3)
      return fail("face ", f, " of the mesh has ", faces.faceSize(f),
                  faces.faceSize(f) == 1 ? " corner" : " corners",
                  "; leave out what has fewer than 3");
  const std::size_t corners = faces.corners.size(),
                    count = static_cast<std::size_t>(faces.faceCount());
  for (const References& list : {
           References{faces.corners, corners, positions.size(), "corner", "vertices", false},
           {faces.cornerTexcoords, corners, faces.texcoords.size(), "corner",
            "texture coordinates"},
           {faces.faceMaterial, count, faces.materials.size(), "face", "materials"},
           {faces.faceGroup, count, faces.groups.size(), "face", "groups"},
       })
    if (auto ok = list.check(); !ok) return ok;
  for (const MeshTarget& target : meshes.targets)
    if (target.positions.size() != positions.size())
      return fail(fmt::format("the target '{}' has {} vertices, and the neutral {}", target.name,
                              target.positions.size(), positions.size()));
  return {};
}

}  // namespace sweepface
