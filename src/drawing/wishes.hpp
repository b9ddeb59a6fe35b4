#pragma once

#include <optional>

#include "drawing/bend.hpp"
#include "drawing/weave.hpp"

namespace sweepface::drawing {

/// How an expression moves the things of a drawing.
struct Offsets {
  std::vector<std::optional<Vec3>> nodes;        ///< [nodes]
  std::vector<Vec3> curves;                      ///< [curves]
  std::vector<const std::vector<Vec3>*> points;  ///< [curves] added for their points, or null
};

/// Resolves what an expression moves. A curve takes its ends along.
Result<Offsets> offsetsOf(const Drawing& drawing, const Woven& woven,
                          const Drawing::Expression& expression);

/// What a drawing says about its curves, and the curve or control that each wish belongs to.
struct DrawnWishes {
  Wishes wishes;
  std::vector<Index> curves;                      ///< [wishes]
  std::vector<const Drawing::Control*> controls;  ///< [wishes] or null
};

/// Collects the points of curves, of control curves and of nodes on sides, in the neutral and in
/// every expression, as wishes for positions on a surface.
Result<DrawnWishes> gatherWishes(const Drawing& drawing, const Woven& woven, const Surface& surface,
                                 const std::vector<Offsets>& expressions);

}  // namespace sweepface::drawing
