#pragma once

#include <vector>

#include "fit/solver.hpp"

namespace sweepface {

/// How far a draft is from the source, the worst over all poses.
struct DraftErrors {
  std::vector<double> distance;  ///< [vertices] of the grid mesh, model units
  std::vector<double> angle;     ///< [vertices] between surface and source normals, degrees
  std::vector<char> folded;    ///< [patches] the surface turns over against a source face somewhere
  std::vector<char> nearFold;  ///< [vertices] whether a corner of such a source face
  double largestDistance = 0;
  double weightedSquares = 0;  ///< sum over all distances, weighted as in the fit
};

DraftErrors measureDraft(const Layout& layout, const Draft& draft, const SourceData& data,
                         const Solution& solution);

}  // namespace sweepface
