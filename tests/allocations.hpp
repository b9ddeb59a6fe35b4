#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <malloc.h>
#include <new>

#ifdef _WIN32
#define malloc_usable_size _msize
#endif

// Tracks every allocation of a test program. Include it in exactly one of the program's files.

namespace sweepface::testing {

struct Allocations {
  std::size_t count = 0;
  std::size_t largest = 0;  ///< bytes
  std::size_t held = 0;     ///< bytes not yet freed
  std::size_t most = 0;     ///< peak of `held`
};
inline Allocations allocations;

// The thread sanitizer defines its own operators, which cannot be replaced.
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SWEEPFACE_OPERATORS_ARE_TAKEN
#endif
#endif
#ifdef SWEEPFACE_OPERATORS_ARE_TAKEN
inline constexpr bool watchesAllocations = false;
#else
inline constexpr bool watchesAllocations = true;
#endif

}  // namespace sweepface::testing

#ifndef SWEEPFACE_OPERATORS_ARE_TAKEN
// Kept out of line, or GCC sees memory from malloc passed to delete and warns.
[[gnu::noinline]] void* operator new(std::size_t size) {
  auto& seen = sweepface::testing::allocations;
  ++seen.count;
  seen.largest = std::max(seen.largest, size);
  void* const memory = std::malloc(size ? size : 1);
  if (!memory) std::abort();
  seen.held += malloc_usable_size(memory);
  seen.most = std::max(seen.most, seen.held);
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  sweepface::testing::allocations.held -= malloc_usable_size(memory);
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}
#endif
