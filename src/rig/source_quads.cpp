#include "rig/source_quads.hpp"

namespace sweepface {

std::vector<Index> facesOfCorners(const Polygons& polygons) {
  std::vector<Index> faces;
  faces.reserve(polygons.corners.size());
  for (Index f = 0; f < polygons.faceCount(); ++f)
    faces.insert(faces.end(), polygons.faceSize(f), f);
  return faces;
}

bool knowsQuads(const Rig& rig) {
  const std::size_t quads = rig.surface.wireframe().quadCount();
  return quads > 0 && rig.source.quadCorners.size() == 4 * quads;
}

std::vector<Index> faceOfQuads(const Rig& rig) {
  if (!knowsQuads(rig)) return {};
  const std::vector<Index> faceOfCorner = facesOfCorners(rig.source.polygons);
  std::vector<Index> faces;
  for (std::size_t k = 0; k < rig.source.quadCorners.size(); k += 4)
    faces.push_back(faceOfCorner[rig.source.quadCorners[k]]);
  return faces;
}

}  // namespace sweepface
