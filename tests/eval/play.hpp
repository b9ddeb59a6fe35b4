#pragma once

#include <gtest/gtest.h>
#include <vector>

#include "sweepface/evaluator.hpp"

namespace sweepface::testing {

/// What an evaluator writes.
struct Played {
  std::vector<float> positions, normals, tangents;
  friend bool operator==(const Played&, const Played&) = default;
};

inline Played play(const Evaluator& evaluator, const std::vector<double>& weights,
                   Index parts = 1) {
  const Index count = evaluator.vertexCount();
  Played out;
  if (evaluator.hasPositions()) out.positions.resize(3 * count);
  if (evaluator.hasNormals()) out.normals.resize(3 * count), out.tangents.resize(3 * count);
  std::vector<std::byte> scratch(evaluator.scratchBytes());
  for (Index part = 0; part < parts; ++part) {
    const Evaluation job{&evaluator,
                         weights,
                         scratch,
                         {out.positions.data(), count},
                         {out.normals.data(), count},
                         {out.tangents.data(), count},
                         part,
                         parts};
    EXPECT_TRUE(job.validate());
    job.run();
  }
  return out;
}

inline Vec3 vectorOf(const std::vector<float>& floats, std::size_t v) {
  return {floats[3 * v], floats[3 * v + 1], floats[3 * v + 2]};
}

}  // namespace sweepface::testing
