#pragma once

#include <string>
#include <vector>

#include "sweepface/mesh.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// How far one pose of a rig is from the source (docs/error-metric.md). Lengths in model units,
/// angles in degrees.
struct PoseErrors {
  std::string name;
  double distanceMax = 0, distance999 = 0, distanceRms = 0;  ///< at source vertices
  double angleMax = 0, angle999 = 0, angleRms = 0;  ///< surface normal to source vertex normal
  double facetDistance = 0;  ///< largest distance of the level-4 surface to the source's facets
  double facetExcess = 0;    ///< the same beyond the facets' own sag
  Index folds = 0;           ///< level-4 triangles that look the other way than their source facet
};

struct Measurement {
  std::vector<PoseErrors> shapes;    ///< the neutral, then every target at weight 1
  std::vector<PoseErrors> mixtures;  ///< random weights, the same for the source's linear blend
  PoseErrors worst;  ///< over all shapes: maxima; RMS and 99.9 % over all of them together
};

struct MeasureOptions {
  int mixtures = 10;
  unsigned seed = 1;
};

/// Compares a rig with the mesh rig it was made from: same vertices, and a shape for every target
/// of `source`, found by name. Fails with a sentence where the two do not belong together.
Result<Measurement> measure(const Rig& rig, const MeshRig& source,
                            const MeasureOptions& options = {});

}  // namespace sweepface
