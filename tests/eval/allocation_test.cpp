#include <gtest/gtest.h>
#include <vector>

#include "sweepface/eval.hpp"
#include "sweepface/evaluator.hpp"

#include "allocations.hpp"
#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

TEST(Evaluator, allocatesNothingWhenRun) {
  if (!watchesAllocations) GTEST_SKIP() << "allocations cannot be watched here";
  const auto evaluator = Evaluator::make(makeRig(sheet(12))).value();
  const std::vector<double> weights(evaluator.weightCount(), 0.5);
  const Index count = evaluator.vertexCount();
  std::vector<float> positions(3 * count), normals(3 * count);
  std::vector<std::byte> scratch(evaluator.scratchBytes());
  const Evaluation job{
      &evaluator, weights, scratch, {positions.data(), count}, {normals.data(), count}, {}};
  const std::size_t before = allocations.count;
  EXPECT_TRUE(job.validate());
  job.run();
  EXPECT_EQ(allocations.count, before);
}

TEST(Density, takesLittleMemoryBeforeItRefuses) {
  if (!watchesAllocations) GTEST_SKIP() << "allocations cannot be watched here";
  const Surface surface = Surface::make(onePatch(60000, 60000)).value();
  const Index stored = surface.storedCount();
  std::vector<Vec3> vectors(surface.vectorCount());
  for (Index v = 0; v < stored; ++v) vectors[v] = anyVector(v);
  surface.settle({vectors.data(), static_cast<std::size_t>(stored)}, vectors);
  allocations.most = allocations.held;
  const std::size_t before = allocations.held;
  EXPECT_FALSE(densityFor(surface, vectors, {Budget::Kind::edgeLength, 1e-7}));
  EXPECT_LT(allocations.most - before, 100'000u);
}

}  // namespace
}  // namespace sweepface
