#include "fit/source_data.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace sweepface {

namespace {

/// The shortest edge at every point, but no less than a part of that of any neighbour. Otherwise a
/// row of faces far thinner than those beside it would dominate the derivatives that it shares with
/// them, and bend them out of shape.
std::vector<double> shortestEdges(const GridMesh& mesh, const SourceData& data) {
  constexpr double kLeastPart = 0.1;
  std::vector<double> shortest(mesh.pointCount(), std::numeric_limits<double>::infinity());
  std::vector<std::array<Index, 2>> edges;
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mesh.twin.size()); ++h) {
    if (mesh.collapsed[h]) continue;
    const std::array<Index, 2> ends{mesh.point[mesh.from(h)], mesh.point[mesh.to(h)]};
    const double length = norm(data.point(ends[0], 0) - data.point(ends[1], 0));
    for (const Index p : ends) shortest[p] = std::min(shortest[p], length);
    edges.push_back(ends);
  }
  for (bool grew = true; grew;) {
    grew = false;
    for (const auto& [a, b] : edges)
      for (const auto& [small, large] : {std::pair{a, b}, {b, a}})
        if (const double least = kLeastPart * shortest[large]; shortest[small] < least)
          shortest[small] = least, grew = true;
  }
  return shortest;
}

/// Sheets that touch at a vertex each have a point of their own there.
std::vector<Index> pointsOfCorners(const Polygons& polygons, const GridMesh& mesh) {
  std::vector<Index> points;
  for (const Index v : polygons.corners) points.push_back(mesh.pointOfSource[v]);
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    for (std::size_t k = 0; k < 4; ++k)
      points[mesh.quadCorners[q][k]] = mesh.point[mesh.quads[q][k]];
  return points;
}

}  // namespace

SourceData gatherSource(const MeshRig& rig, const GridMesh& mesh, double tolerance) {
  SourceData data;
  data.tolerance = tolerance;
  const Index points = mesh.pointCount();
  data.poses = 1 + static_cast<Index>(rig.targets.size());
  data.points.resize(points, 3 * data.poses);
  data.normals.resize(points, 3 * data.poses);
  const std::vector<Index> pointOfCorner = pointsOfCorners(rig.neutral.polygons, mesh);
  const std::span quadCorners(mesh.quadCorners.front().data(), 4 * mesh.quadCorners.size());
  for (Index k = 0; k < data.poses; ++k) {
    const std::vector<Vec3>& positions = rig.positionsOf(k);
    const auto normals =
        vertexNormals(rig.neutral.polygons, positions, pointOfCorner, points, quadCorners);
    for (Index p = 0; p < points; ++p) {
      const Vec3 &x = positions[mesh.source[p]], &n = normals[p];
      data.points.row(p).segment<3>(3 * k) << x.x, x.y, x.z;
      data.normals.row(p).segment<3>(3 * k) << n.x, n.y, n.z;
    }
  }

  data.placeEmphasis.assign(points, 1);
  data.slopeEmphasis.assign(points, 1);
  const std::vector<double> lengths = shortestEdges(mesh, data);
  // Points move by a good part of the tolerance anyway, so edges shorter than that mean nothing.
  const double least = tolerance / 2;
  for (const double length : lengths) data.weight.push_back(1 / (length * length + least * least));
  return data;
}

}  // namespace sweepface
