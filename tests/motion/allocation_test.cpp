#include <cstddef>
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>
#include <vector>

#include "sweepface/live_motion.hpp"
#include "sweepface/motion.hpp"

namespace {
std::size_t allocations = 0;
}

// Counted. Kept out of line, or GCC sees malloc meet delete and warns.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  std::abort();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace sweepface {
namespace {

TEST(Motion, EvaluatesWithoutAllocating) {
  const std::vector<double> from(50, 0.0), to(50, 1.0);
  std::vector<double> out(50);
  for (const TimeLaw law : timeLaws) {
    const std::size_t before = allocations;
    const Result<Motion> motion = Motion::make(from, to, law, 1);
    const std::size_t made = allocations;
    EXPECT_GT(made, before);  // the counter counts
    motion->at(0.3, out);
    motion->velocities(0.3, out);
    motion->forces(0.3, out);
    EXPECT_EQ(allocations, made);
  }
}

TEST(MotionState, MovesWithoutAllocating) {
  Result<MotionState> state = MotionState::make(std::vector<double>(57, 0.0));
  const std::vector<double> goals(57, 1.0);
  std::vector<double> out(57);
  const std::size_t before = allocations;
  for (int frame = 0; frame < 100; ++frame) {
    state->advance(1.0 / 60);
    ASSERT_TRUE(state->moveTo(goals));
    ASSERT_TRUE(state->push(3, 0.1, 1));
    state->positions(out);
    state->velocities(out);
  }
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace sweepface
