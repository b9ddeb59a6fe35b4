#include "mesh/face_edges.hpp"

#include <algorithm>
#include <tuple>

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

// Finds the twins; says between which vertices edges are left that more faces share.
std::vector<std::pair<Index, Index>> pairUp(FaceEdges& edges) {
  struct Edge {
    Index low, high, corner;
  };
  std::vector<Edge> sorted;
  for (Index c = 0; c < static_cast<Index>(edges.vertex.size()); ++c) {
    const Index a = edges.vertex[c], b = edges.vertex[edges.next[c]];
    if (a != b) sorted.push_back({std::min(a, b), std::max(a, b), c});
  }
  std::sort(sorted.begin(), sorted.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  edges.twin.assign(edges.vertex.size(), -1);
  std::vector<std::pair<Index, Index>> cut;
  for (std::size_t k = 0, end = 0; k < sorted.size(); k = end) {
    const auto [low, high, corner] = sorted[k];
    while (end < sorted.size() && sorted[end].low == low && sorted[end].high == high) ++end;
    if (end - k == 2 && edges.vertex[corner] != edges.vertex[sorted[k + 1].corner]) {
      edges.twin[corner] = sorted[k + 1].corner;
      edges.twin[sorted[k + 1].corner] = corner;
    } else if (end - k > 1) {
      cut.emplace_back(low, high);
    }
  }
  return cut;
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
