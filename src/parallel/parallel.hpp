#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SWEEPFACE_TELL_THREAD_SANITIZER
extern "C" void __tsan_acquire(void* place);
extern "C" void __tsan_release(void* place);
#endif
#endif

namespace sweepface {

/// What a parallel loop orders: its bodies come after what was before it and before what is after
/// it. The thread sanitizer is told so, as TBB's library is not built for it; elsewhere this is
/// nothing.
class LoopOrder {
 public:
#ifdef SWEEPFACE_TELL_THREAD_SANITIZER
  LoopOrder() { __tsan_release(&begun_); }
  ~LoopOrder() { __tsan_acquire(&done_); }
  void enter() { __tsan_acquire(&begun_); }
  void leave() { __tsan_release(&done_); }

 private:
  char begun_ = 0, done_ = 0;
#else
  void enter() {}
  void leave() {}
#endif
};

/// Calls `body(begin, end)` for ranges that make up [0, count), on all cores.
template <typename Size, typename Body>
void parallelRanges(Size count, const Body& body) {
  LoopOrder order;
  tbb::parallel_for(tbb::blocked_range<Size>(0, count), [&](const tbb::blocked_range<Size>& range) {
    order.enter();
    body(range.begin(), range.end());
    order.leave();
  });
}

/// Calls `body(k)` for each k in [first, end), on all cores.
template <typename Size, typename Body>
void parallelFor(Size first, Size end, const Body& body) {
  LoopOrder order;
  tbb::parallel_for(first, end, [&](Size k) {
    order.enter();
    body(k);
    order.leave();
  });
}

}  // namespace sweepface
