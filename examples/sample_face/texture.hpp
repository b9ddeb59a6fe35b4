// Texture coordinates: as if wrapped round the head.
#pragma once

#include <numbers>

#include "sketch.hpp"

namespace sample {

/// Gives a mesh texture coordinates: u the angle round the head, v the height. The seam runs down
/// the back; vertices on it have one coordinate for each side.
inline void wrap(sweepface::Polygons& faces, const std::vector<Vec3>& positions) {
  double low = positions[0].y, high = low;
  for (const Vec3& p : positions) low = std::min(low, p.y), high = std::max(high, p.y);
  const auto angle = [&](Index vertex) {
    const Vec3& p = positions[vertex];
    return std::atan2(p.x, p.z + 1.5) / (2 * std::numbers::pi) + .5;
  };
  std::map<std::pair<Index, bool>, Index> known;  // by vertex, and whether beyond the seam
  for (Index f = 0; f < faces.faceCount(); ++f) {
    double least = 1, most = 0;
    for (Index c = faces.faceStart[f]; c < faces.faceStart[f + 1]; ++c) {
      least = std::min(least, angle(faces.corners[c]));
      most = std::max(most, angle(faces.corners[c]));
    }
    for (Index c = faces.faceStart[f]; c < faces.faceStart[f + 1]; ++c) {
      const Index vertex = faces.corners[c];
      const double u = angle(vertex);
      const bool beyond = most - least > .5 && u < .5;
      const auto [place, isNew] =
          known.try_emplace({vertex, beyond}, static_cast<Index>(faces.texcoords.size()));
      if (isNew)
        faces.texcoords.push_back({u + beyond, (positions[vertex].y - low) / (high - low)});
      faces.cornerTexcoords.push_back(place->second);
    }
  }
}

}  // namespace sample
