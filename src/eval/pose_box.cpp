#include "sweepface/pose_box.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface {
namespace {

std::vector<float> positionsOf(const Evaluator& evaluator, std::span<const double> weights,
                               std::span<std::byte> scratch) {
  std::vector<float> positions(3 * static_cast<std::size_t>(evaluator.vertexCount()));
  Evaluation job;
  job.evaluator = &evaluator;
  job.weights = weights;
  job.scratch = scratch;
  job.positions = {positions.data(), evaluator.vertexCount()};
  job.run();
  return positions;
}

Vec3 vectorAt(const std::vector<float>& floats, std::size_t k) {
  return {floats[k], floats[k + 1], floats[k + 2]};
}

Box grown(Box box, double by) {
  const Vec3 margin{by, by, by};
  box.low -= margin, box.high += margin;
  return box;
}

}  // namespace

// Evaluations are within positionBound() of the exact surface, which is linear in the weights.
PoseBox::PoseBox(const Evaluator& evaluator) : evaluator_(evaluator) {
  std::vector<std::byte> scratch(evaluator.scratchBytes());
  std::vector<double> weights(evaluator.weightCount(), 0.0);
  const auto rest = positionsOf(evaluator, weights, scratch);
  const double restBound = evaluator.positionBound(weights);
  for (std::size_t k = 0; k < rest.size(); k += 3) neutral_.include(vectorAt(rest, k));
  neutral_ = grown(neutral_, restBound);
  for (double& weight : weights) {
    weight = 1;
    const auto moved = positionsOf(evaluator, weights, scratch);
    Box way;
    for (std::size_t k = 0; k < rest.size(); k += 3)
      way.include(vectorAt(moved, k) - vectorAt(rest, k));
    ways_.push_back(grown(way, restBound + evaluator.positionBound(weights)));
    weight = 0;
  }
}

Box PoseBox::of(std::span<const double> weights) const {
  if (neutral_.isEmpty()) return neutral_;
  Box box = neutral_;
  for (std::size_t k = 0; k < std::min(weights.size(), ways_.size()); ++k) {
    const double w = weights[k];
    if (w == 0) continue;
    box.low += w * (w > 0 ? ways_[k].low : ways_[k].high);
    box.high += w * (w > 0 ? ways_[k].high : ways_[k].low);
  }
  return grown(box, evaluator_.positionBound(weights));
}

}  // namespace sweepface
