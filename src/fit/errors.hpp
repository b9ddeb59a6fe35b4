#pragma once

#include <vector>

#include "fit/solver.hpp"

namespace sweepface {

/// How far a draft is from the source, at its worst over all poses.
struct DraftErrors {
  std::vector<double> distance;  ///< [vertices] of the grid mesh, model units
  std::vector<double> angle;     ///< [vertices] between surface and source normals, degrees
  std::vector<char> folded;    ///< [patches] the surface turns over against a source face somewhere
  std::vector<char> nearFold;  ///< [vertices] corners of those source faces
  double largestDistance = 0;
  double weightedSquares = 0;  ///< of all distances, as the fit counts them
};

DraftErrors measureDraft(const Layout& layout, const Draft& draft, const SourceData& data,
                         const Solution& solution);

}  // namespace sweepface
