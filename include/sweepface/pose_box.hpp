#pragma once

#include <span>
#include <vector>

#include "sweepface/box.hpp"
#include "sweepface/evaluator.hpp"

namespace sweepface {

/// A box around a face in any pose, without evaluating the pose: the neutral's box, each side moved
/// as far as the targets can take it. For culling.
class PoseBox {
 public:
  /// Evaluates the neutral and every weight once. The evaluator must have positions.
  explicit PoseBox(const Evaluator& evaluator);

  /// Contains every vertex of an evaluation with these weights, within ±10⁶, and every vertex of
  /// the exact surface. Where targets move different parts of the face it is larger than needed.
  /// Empty if there are no vertices, infinite where positionBound() is. Allocates nothing.
  Box of(std::span<const double> weights) const;

 private:
  Evaluator evaluator_;  // shares its tables
  Box neutral_;
  std::vector<Box> ways_;  // [weights] how far weight 1 moves vertices along the axes
};

}  // namespace sweepface
