#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sweepface/io.hpp"

#include "io/target_shape.hpp"
#include "io/text.hpp"
#include "require.hpp"

/// What must hold for whatever a mesh reader accepts.
namespace sweepface::fuzzing {

inline std::string_view asText(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

inline void requireIndices(const std::vector<Index>& indices, std::size_t size, std::size_t count,
                           Index least) {
  require(indices.size() == size);
  for (const Index index : indices)
    require(index >= least && index < static_cast<std::int64_t>(count));
}

inline void requireWhole(const PolygonMesh& mesh) {
  const Polygons& polygons = mesh.polygons;
  require(polygons.faceCount() > 0 && polygons.faceStart.front() == 0);
  for (Index face = 0; face < polygons.faceCount(); ++face) require(polygons.faceSize(face) >= 3);
  const auto faces = static_cast<std::size_t>(polygons.faceCount());
  require(polygons.faceStart.back() == static_cast<std::int64_t>(polygons.corners.size()));

  requireIndices(polygons.corners, polygons.corners.size(), mesh.positions.size(), 0);
  requireIndices(polygons.faceGroup, faces, polygons.groups.size(), -1);
  requireIndices(polygons.faceMaterial, faces, polygons.materials.size(), -1);
  require(polygons.texcoords.empty() == polygons.cornerTexcoords.empty());
  if (!polygons.cornerTexcoords.empty())
    requireIndices(polygons.cornerTexcoords, polygons.corners.size(), polygons.texcoords.size(),
                   -1);
  for (const Vec3& position : mesh.positions) require(isFinite(position));
  for (const Vec2& t : polygons.texcoords) require(std::isfinite(t.x) && std::isfinite(t.y));
}

/// Whether an OBJ keeps a name as it is.
inline bool isPlain(std::string_view name) {
  return !name.empty() && name == io::trimmed(name) && name.back() != '\\' &&
         std::ranges::all_of(name, [](char c) { return static_cast<unsigned char>(c) >= ' '; });
}

inline void requireNames(const std::vector<std::string>& names, const std::vector<Index>& ofFace,
                         const std::vector<std::string>& again,
                         const std::vector<Index>& ofFaceAgain) {
  for (std::size_t f = 0; f < ofFace.size(); ++f)
    if (ofFace[f] >= 0 && isPlain(names[ofFace[f]]))
      require(f < ofFaceAgain.size() && ofFaceAgain[f] >= 0 &&
              again[ofFaceAgain[f]] == names[ofFace[f]]);
}

inline void requireSame(const PolygonMesh& a, const PolygonMesh& b) {
  require(a.positions == b.positions);
  require(a.polygons.faceStart == b.polygons.faceStart);
  require(a.polygons.corners == b.polygons.corners);
  require(a.polygons.texcoords == b.polygons.texcoords);
  require(a.polygons.cornerTexcoords == b.polygons.cornerTexcoords);
  requireNames(a.polygons.groups, a.polygons.faceGroup, b.polygons.groups, b.polygons.faceGroup);
  requireNames(a.polygons.materials, a.polygons.faceMaterial, b.polygons.materials,
               b.polygons.faceMaterial);
}

/// An error is a sentence; a mesh is whole and stays the same when written and read again.
inline void requireSound(const Result<PolygonMesh>& mesh) {
  if (!mesh) return require(isSentence(mesh.error().message));
  requireWhole(*mesh);
  const auto again = parseObj(formatObj({mesh->positions, {}, mesh->polygons}), "again");
  require(again.has_value());
  requireWhole(*again);
  requireSame(*mesh, *again);
  const auto shaded = parseObj(formatObj({mesh->positions, mesh->positions, mesh->polygons}), "n");
  require(shaded.has_value());
  requireSame(*mesh, *shaded);
}

/// A file that is a whole mesh is a target with the same positions and as many faces.
inline void requireTarget(const Result<PolygonMesh>& mesh, const Result<io::TargetShape>& target) {
  if (target)
    for (const Vec3& position : target->positions) require(isFinite(position));
  if (!mesh) return;
  require(target.has_value() && target->positions == mesh->positions);
  require(target->faceCount == mesh->polygons.faceCount());
}

}  // namespace sweepface::fuzzing
