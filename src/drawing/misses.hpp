#pragma once

#include "drawing/wishes.hpp"

namespace sweepface::drawing {

/// The wish that is missed by the largest distance in any pose; none if all are met exactly.
struct Miss {
  double by = 0;
  Index wish = -1;
  std::size_t pose = 0;  ///< to blame for most of it: 0, the neutral, or 1 + e, expression e
};
Miss largestMiss(const DrawnWishes& drawn, const Surface& surface, const std::vector<Pose>& poses);

/// What a wish belongs to: "curve 'rim'", "the control of 'rim' in 'lip'".
std::string nameOf(const Drawing& drawing, const DrawnWishes& drawn, Index wish);
TextPlace placeOf(const Drawing& drawing, const DrawnWishes& drawn, Index wish);

}  // namespace sweepface::drawing
