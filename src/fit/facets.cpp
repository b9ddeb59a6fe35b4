#include "fit/facets.hpp"

#include <algorithm>
#include <cmath>

#include "fit/sound_face.hpp"
#include "rig/source_quads.hpp"
#include "surface/distances.hpp"

namespace sweepface {

FaceMap::FaceMap(const Rig& rig, std::vector<Index> places)
    : faceOfQuad(faceOfQuads(rig)), cornerPlaces(std::move(places)) {}

FaceMap::FaceMap(const Rig& rig, std::vector<Index> places, std::span<const Vec3> neutral)
    : FaceMap(rig, std::move(places)) {
  const Polygons& p = rig.source.polygons;
  facesAt.resize(rig.source.gridVertex.size());
  for (Index f = 0; f < p.faceCount(); ++f) {
    for (Index c = p.faceStart[f]; c < p.faceStart[f + 1]; ++c) facesAt[p.corners[c]].push_back(f);
    if (p.faceSize(f) > 4) cuts[f] = triangulate(cornerPositions(p, neutral, f));
  }
  findRims(p);
}

// Finds the edges of one face only, each with the vertices before and after it along the boundary.
void FaceMap::findRims(const Polygons& p) {
  std::map<std::pair<Index, Index>, std::pair<Index, Index>> edges;  // welded ends → corners
  for (Index f = 0; f < p.faceCount(); ++f)
    for (Index k = 0; k < p.faceSize(f); ++k) {
      const Index a = p.faceStart[f] + k, b = p.faceStart[f] + (k + 1) % p.faceSize(f);
      edges[{cornerPlaces[a], cornerPlaces[b]}] = {a, b};
    }
  std::map<Index, Index> before, after;
  for (const auto& [ends, corners] : edges)
    if (!edges.contains({ends.second, ends.first})) {
      after[ends.first] = corners.second;
      before[ends.second] = corners.first;
    }
  for (const auto& [ends, corners] : edges)
    if (!edges.contains({ends.second, ends.first}) && before.contains(ends.first) &&
        after.contains(ends.second))
      rims[{corners.first, corners.second}] = {before[ends.first], after[ends.second]};
}

// A face across an edge is listed at both of its ends; once is enough.
double Facets::distance(const Vec3& p, Index face) const {
  const Index* const corners = &polygons_.corners[polygons_.faceStart[face]];
  double best = distanceToFace(p, face);
  for (Index k = 0; k < polygons_.faceSize(face); ++k)
    for (const Index f : map_.facesAt[corners[k]])
      if (f != face && (k == 0 || !hasCorner(f, corners[k - 1])))
        best = std::min(best, distanceToFace(p, f));
  return best;
}

bool Facets::hasCorner(Index face, Index vertex) const {
  const auto corners =
      std::span(polygons_.corners).subspan(polygons_.faceStart[face], polygons_.faceSize(face));
  return std::ranges::find(corners, vertex) != corners.end();
}

Vec3 Facets::normal(Index face) const {
  Vec3 sum;
  const Index begin = polygons_.faceStart[face], size = polygons_.faceSize(face);
  for (Index k = 1; k + 1 < size; ++k)
    sum += cross(at(begin + k) - at(begin), at(begin + k + 1) - at(begin));
  return sum;
}

// How far a smooth surface with the source's vertex normals rises above the flat face: an edge
// whose end normals differ by a small angle is the chord of an arc that rises by length · angle /
// 8, and a face bulges by the sum of its two directions. A boundary edge rises within the surface
// as well: by an eighth of the second difference of the boundary's vertices.
double Facets::sag(Index face) const {
  const Index begin = polygons_.faceStart[face], size = polygons_.faceSize(face);
  double rise[2] = {0, 0};
  for (Index k = 0; k < size; ++k) {
    const Index a = begin + k, b = begin + (k + 1) % size;
    rise[k % 2] =
        std::max(rise[k % 2], std::abs(dot(normalAt(b) - normalAt(a), at(b) - at(a))) / 8);
  }
  double rim = 0;
  for (Index k = 0; k < size; ++k) {
    const Index a = begin + k, b = begin + (k + 1) % size;
    if (const auto it = map_.rims.find({a, b}); it != map_.rims.end())
      rim = std::max({rim, norm(at(it->second.first) - 2 * at(a) + at(b)) / 8,
                      norm(at(a) - 2 * at(b) + at(it->second.second)) / 8});
  }
  return rise[0] + rise[1] + rim;
}

bool Facets::isSound(Index face) const {
  const Index begin = polygons_.faceStart[face];
  return isSoundFace(
      polygons_.faceSize(face), normal(face), tolerance_, [&](Index k) { return at(begin + k); },
      [&](Index k) { return normalAt(begin + k); });
}

int Facets::folds(const std::array<Index, 4>& q, std::span<const Vec3> x, Index face) const {
  const Vec3 n = normal(face);
  int count = 0;
  for (const auto& [a, b, c] : {std::array{q[0], q[1], q[2]}, {q[0], q[2], q[3]}})
    if (dot(cross(x[b] - x[a], x[c] - x[a]), n) < 0 && isSound(face)) ++count;
  return count;
}

double Facets::distanceToFace(const Vec3& p, Index f) const {
  const Index begin = polygons_.faceStart[f], size = polygons_.faceSize(f);
  const auto distance = [&](Index a, Index b, Index c) {
    return distanceToTriangle(p, at(begin + a), at(begin + b), at(begin + c));
  };
  double best = 1e300;
  if (size == 3) best = distance(0, 1, 2);
  if (size == 4)  // both diagonals are as good
    best = std::min({distance(0, 1, 2), distance(0, 2, 3), distance(1, 2, 3), distance(1, 3, 0)});
  if (size > 4)
    for (const auto& [a, b, c] : map_.cuts.at(f)) best = std::min(best, distance(a, b, c));
  return best;
}

}  // namespace sweepface
