#pragma once

#include "sweepface/polygons.hpp"

namespace sweepface {

/// Calls visit(a, b, face) with the vertices of every edge of every face, in the order around it.
template <typename Visit>
void eachEdge(const Polygons& faces, const Visit& visit) {
  for (Index f = 0; f < faces.faceCount(); ++f) {
    const Index* const corners = &faces.corners[faces.faceStart[f]];
    const Index size = faces.faceSize(f);
    for (Index k = 0; k < size; ++k) visit(corners[k], corners[(k + 1) % size], f);
  }
}

}  // namespace sweepface
