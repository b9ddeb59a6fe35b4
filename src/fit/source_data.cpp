#include "fit/source_data.hpp"

#include <algorithm>

namespace sweepface {

SourceData gatherSource(const MeshRig& rig, const GridMesh& mesh, double tolerance) {
  SourceData data;
  data.tolerance = tolerance;
  const Index points = mesh.pointCount();
  data.poses = 1 + static_cast<Index>(rig.targets.size());
  data.points.resize(points, 3 * data.poses);
  data.normals.resize(points, 3 * data.poses);
  for (Index k = 0; k < data.poses; ++k) {
    const auto& positions = k == 0 ? rig.neutral.positions : rig.targets[k - 1].positions;
    const auto normals = vertexNormals(rig.neutral.polygons, positions, mesh.pointOfSource, points);
    for (Index p = 0; p < points; ++p) {
      const Vec3 &x = positions[mesh.source[p]], &n = normals[p];
      data.points.row(p).segment<3>(3 * k) << x.x, x.y, x.z;
      data.normals.row(p).segment<3>(3 * k) << n.x, n.y, n.z;
    }
  }

  data.placeEmphasis.assign(points, 1);
  data.slopeEmphasis.assign(points, 1);
  data.edgeLength.assign(points, 1e300);
  for (HalfEdge h = 0; h < static_cast<HalfEdge>(mesh.twin.size()); ++h) {
    if (mesh.collapsed[h]) continue;
    const Index a = mesh.point[mesh.from(h)], b = mesh.point[mesh.to(h)];
    const double length = norm(data.point(a, 0) - data.point(b, 0));
    for (Index p : {a, b}) data.edgeLength[p] = std::min(data.edgeLength[p], length);
  }
  // Points move by a good part of the tolerance anyway: shorter edges than that mean nothing.
  const double least = tolerance / 2;
  for (Index p = 0; p < points; ++p) {
    data.weight.push_back(1 / (data.edgeLength[p] * data.edgeLength[p] + least * least));
  }
  return data;
}

}  // namespace sweepface
