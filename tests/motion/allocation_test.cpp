#include <cstddef>
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>
#include <vector>

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

}  // namespace
}  // namespace sweepface
