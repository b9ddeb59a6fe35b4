#include "mesh/face_edges.hpp"

#include "mesh/shared_edges.hpp"
#include "mesh/weld.hpp"

namespace sweepface {

namespace {

void goRound(FaceEdges& edges, const Polygons& polygons) {
  for (Index f = 0; f < polygons.faceCount(); ++f) {
    const Index begin = polygons.faceStart[f], end = polygons.faceStart[f + 1];
    for (Index c = begin; c < end; ++c) {
      edges.face.push_back(f);
      edges.next.push_back(c + 1 < end ? c + 1 : begin);
      edges.previous.push_back(c > begin ? c - 1 : end - 1);
    }
  }
}

// Finds the twins of faces that share edges; returns the ends of those that are shared otherwise.
std::vector<std::pair<Index, Index>> pairUp(FaceEdges& edges, const std::vector<char>& shares) {
  std::vector<EdgeSide> sides;
  for (Index c = 0; c < static_cast<Index>(edges.vertex.size()); ++c) {
    const Index a = edges.vertex[c], b = edges.vertex[edges.next[c]];
    if (a != b && shares[edges.face[c]]) sides.emplace_back(a, b, c);
  }
  edges.twin.resize(edges.vertex.size());
  return pairSides(sides, edges.twin);
}

}  // namespace

std::vector<Index> differentCorners(const FaceEdges& edges, const Polygons& polygons, Index face) {
  std::vector<Index> corners;
  for (Index c = polygons.faceStart[face]; c < polygons.faceStart[face + 1]; ++c)
    if (edges.vertex[c] != edges.vertex[edges.previous[c]]) corners.push_back(c);
  return corners;
}

FaceEdges faceEdges(const MeshRig& rig, std::span<const FaceRepeat> repeats) {
  const Polygons& polygons = rig.neutral.polygons;
  const auto count = static_cast<Index>(rig.neutral.positions.size());
  FaceEdges edges;
  goRound(edges, polygons);
  std::vector<char> shares(polygons.faceCount(), 1);
  for (std::vector<Index> first = weld(rig);;) {
    edges.vertex.clear();
    for (std::size_t c = 0; c < polygons.corners.size(); ++c) {
      const bool isBack = !repeats.empty() && repeats[edges.face[c]] == FaceRepeat::back;
      edges.vertex.push_back(first[polygons.corners[c]] + (isBack ? count : 0));
    }
    for (Index f = 0; f < static_cast<Index>(repeats.size()); ++f)
      shares[f] =
          repeats[f] != FaceRepeat::again && differentCorners(edges, polygons, f).size() > 2;
    auto cut = pairUp(edges, shares);
    for (auto& [a, b] : cut) a %= count, b %= count;
    if (cut.empty() || !takeApart(first, cut)) return edges;
  }
}

}  // namespace sweepface
