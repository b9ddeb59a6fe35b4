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

// Finds the twins; returns the ends of the edges that faces share otherwise.
std::vector<std::pair<Index, Index>> pairUp(FaceEdges& edges) {
  std::vector<EdgeSide> sides;
  for (Index c = 0; c < static_cast<Index>(edges.vertex.size()); ++c) {
    const Index a = edges.vertex[c], b = edges.vertex[edges.next[c]];
    if (a != b) sides.emplace_back(a, b, c);
  }
  edges.twin.resize(edges.vertex.size());
  return pairSides(sides, edges.twin);
}

}  // namespace

FaceEdges faceEdges(const MeshRig& rig) {
  const Polygons& polygons = rig.neutral.polygons;
  FaceEdges edges;
  goRound(edges, polygons);
  for (std::vector<Index> first = weld(rig);;) {
    edges.vertex.clear();
    for (Index v : polygons.corners) edges.vertex.push_back(first[v]);
    if (const auto cut = pairUp(edges); cut.empty() || !takeApart(first, cut)) return edges;
  }
}

}  // namespace sweepface
