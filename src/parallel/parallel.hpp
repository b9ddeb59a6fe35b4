#pragma once

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SWEEPFACE_PLAIN_THREADS
#endif
#endif

#if defined(SWEEPFACE_PLAIN_THREADS)
#include <array>
#include <atomic>
#include <thread>
#elif !defined(__wasi__)
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#endif

namespace sweepface {

/// Calls `body(k)` for each k in [first, end), on all cores.
template <typename Size, typename Body>
void parallelFor(Size first, Size end, const Body& body) {
#if defined(SWEEPFACE_PLAIN_THREADS)
  // The thread sanitizer does not see the synchronisation in TBB's library, which is not built for
  // it.
  std::atomic<Size> next = first;
  const auto work = [&] {
    for (Size k = next++; k < end; k = next++) body(k);
  };
  std::array<std::thread, 3> others{std::thread(work), std::thread(work), std::thread(work)};
  work();
  for (std::thread& other : others) other.join();
#elif defined(__wasi__)
  for (Size k = first; k < end; ++k) body(k);  // has one core
#else
  // One by one: what takes seconds may be beside what takes none.
  tbb::parallel_for(first, end, body, tbb::simple_partitioner());
#endif
}

/// Calls `body(begin, end)` for ranges that make up [0, count), on all cores.
template <typename Size, typename Body>
void parallelRanges(Size count, const Body& body) {
#if defined(SWEEPFACE_PLAIN_THREADS)
  constexpr Size kRanges = 8;
  parallelFor(Size{0}, kRanges,
              [&](Size k) { body(k * count / kRanges, (k + 1) * count / kRanges); });
#elif defined(__wasi__)
  if (count > 0) body(Size{0}, count);
#else
  tbb::parallel_for(tbb::blocked_range<Size>(0, count), [&](const tbb::blocked_range<Size>& range) {
    body(range.begin(), range.end());
  });
#endif
}

}  // namespace sweepface
