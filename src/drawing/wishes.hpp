#pragma once

#include <optional>

#include "drawing/bend.hpp"
#include "drawing/weave.hpp"

namespace sweepface::drawing {

/// How an expression moves the things of a drawing.
struct Offsets {
  std::vector<std::optional<Vec3>> nodes;        ///< [nodes]
  std::vector<Vec3> curves;                      ///< [curves]
  std::vector<const std::vector<Vec3>*> points;  ///< [curves] of their points on top, or null
};

/// Looks up what an expression moves: a curve takes its ends along.
Result<Offsets> offsetsOf(const Drawing& drawing, const Woven& woven,
                          const Drawing::Expression& expression);

/// What a drawing says of its curves, and which curve or control each wish is of.
struct DrawnWishes {
  Wishes wishes;
  std::vector<Index> curves;                      ///< [wishes]
  std::vector<const Drawing::Control*> controls;  ///< [wishes] or null
};

/// The points of curves, of control curves and of nodes on sides, for the neutral and for every
/// expression, as places on a surface.
Result<DrawnWishes> gatherWishes(const Drawing& drawing, const Woven& woven, const Surface& surface,
                                 const std::vector<Offsets>& expressions);

}  // namespace sweepface::drawing
