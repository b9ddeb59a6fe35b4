#include "mesh/cage.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "mesh/face_edges.hpp"

namespace sweepface {
namespace {

/// The corners of face `f` that follow another vertex: those of a polygon without repetitions.
std::vector<Index> differentCorners(const FaceEdges& edges, const Polygons& polygons, Index f) {
  std::vector<Index> corners;
  for (Index c = polygons.faceStart[f]; c < polygons.faceStart[f + 1]; ++c)
    if (edges.vertex[c] != edges.vertex[edges.previous[c]]) corners.push_back(c);
  return corners;
}

class CageMaker {
 public:
  explicit CageMaker(const MeshRig& rig) : polygons_(rig.neutral.polygons), edges_(faceEdges(rig)) {
    numberVertices(rig.neutral.positions.size());
    for (Index f = 0; f < polygons_.faceCount(); ++f)
      if (const auto corners = differentCorners(edges_, polygons_, f); corners.size() > 2)
        addFace(f, corners);
  }

  Cage cage;

 private:
  void numberVertices(std::size_t count) {
    std::vector<char> isKept(count, 1);
    for (const Index v : polygons_.corners) isKept[v] = 0;  // of those in faces, the welded ones
    for (const Index v : edges_.vertex) isKept[v] = 1;
    number_.assign(count, -1);
    for (Index v = 0; v < std::ssize(isKept); ++v)
      if (isKept[v]) {
        number_[v] = static_cast<Index>(cage.vertices.size());
        cage.vertices.push_back(v);
      }
  }

  void addFace(Index f, const std::vector<Index>& corners) {
    cage.faces.push_back(f);
    cage.sizes.push_back(static_cast<Index>(corners.size()));
    for (const Index c : corners) cage.corners.push_back(number_[edges_.vertex[c]]);
    if (polygons_.texcoords.empty() || polygons_.cornerTexcoords.empty()) return;
    const bool isTextured =
        std::ranges::all_of(corners, [&](Index c) { return polygons_.cornerTexcoords[c] >= 0; });
    cage.isTextured.push_back(isTextured);
    for (const Index c : corners) cage.cornerTexcoords.push_back(texcoordOf(c, isTextured));
  }

  /// Corners of faces without texture coordinates share some of their own, so that those of others
  /// end there.
  Index texcoordOf(Index corner, bool isTextured) {
    const Vec2 place = isTextured ? polygons_.texcoords[polygons_.cornerTexcoords[corner]] : Vec2{};
    const auto [known, isNew] =
        texcoords_.try_emplace({edges_.vertex[corner], isTextured, place.x, place.y},
                               static_cast<Index>(cage.texcoords.size()));
    if (isNew) cage.texcoords.push_back(place);
    return known->second;
  }

  const Polygons& polygons_;
  const FaceEdges edges_;
  std::vector<Index> number_;  // [vertices] in the cage, or -1
  std::map<std::tuple<Index, bool, double, double>, Index> texcoords_;
};

}  // namespace

Cage cageOf(const MeshRig& rig) { return std::move(CageMaker(rig).cage); }

}  // namespace sweepface
