#pragma once

#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "sweepface/rig.hpp"

#include "eval/triangulate.hpp"

namespace sweepface {

/// Level of the tessellation that is compared with the facets and whose triangles may fold.
inline constexpr Index kFineLevel = 4;

/// The source face of each quad of the tessellation at level 1, and what surrounds each face.
struct FaceMap {
  std::vector<Index> faceOfQuad;    ///< [grid quads]; empty if the rig does not know
  std::vector<Index> cornerPlaces;  ///< [C] see cornerPlaces() (fit/corner_places.hpp)
  // Needed for distances and sags; only the second constructor fills them.
  std::vector<std::vector<Index>> facesAt;  ///< [V] faces that have the vertex
  std::map<std::pair<Index, Index>, std::pair<Index, Index>>
      rims;                                     ///< boundary edge → corners before and after
  std::map<Index, std::vector<Triangle>> cuts;  ///< faces of more than four corners → triangles

  FaceMap(const Rig& rig, std::vector<Index> cornerPlaces);
  /// Also finds what surrounds faces; larger faces are cut by the neutral's positions.
  FaceMap(const Rig& rig, std::vector<Index> cornerPlaces, std::span<const Vec3> neutral);

 private:
  void findRims(const Polygons& polygons);
};

/// The facets of one pose of the source.
class Facets {
 public:
  Facets(const SourceMesh& source, const FaceMap& map, std::span<const Vec3> positions,
         std::span<const Vec3> gridNormals, double tolerance)
      : polygons_(source.polygons),
        map_(map),
        positions_(positions),
        gridNormals_(gridNormals),
        tolerance_(tolerance) {}

  /// Distance of a point from a face or from its neighbours, whichever is nearest.
  double distance(const Vec3& p, Index face) const;
  /// Twice the vector area.
  Vec3 normal(Index face) const;
  /// How far a smooth surface with the source's vertex normals rises above the flat face.
  double sag(Index face) const;
  /// How many triangles of a small quad face away from the source face it lies on; 0 if that face
  /// does not say which way is out (docs/error-metric.md).
  int folds(const std::array<Index, 4>& quad, std::span<const Vec3> positions, Index face) const;

 private:
  bool isSound(Index face) const;
  double distanceToFace(const Vec3& p, Index f) const;
  bool hasCorner(Index face, Index vertex) const;
  Vec3 at(Index corner) const { return positions_[polygons_.corners[corner]]; }
  Vec3 normalAt(Index corner) const {
    const Index g = map_.cornerPlaces[corner];
    return g >= 0 ? gridNormals_[g] : Vec3{};
  }

  const Polygons& polygons_;
  const FaceMap& map_;
  std::span<const Vec3> positions_, gridNormals_;
  double tolerance_;
};

}  // namespace sweepface
