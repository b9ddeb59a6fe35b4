#pragma once

#include <functional>
#include <span>
#include <utility>

namespace sweepface {

/// Heapsort (Williams 1964): slower than std::sort, but a tenth of its code, which a browser would
/// load once per type. It is not stable: equal elements end in any order.
template <typename T, typename Before = std::less<>>
void sortSmall(std::span<T> items, const Before& before = {}) {
  std::size_t unsorted = items.size(), heap = unsorted / 2;  // [heap, unsorted) is a heap
  while (unsorted > 1) {
    if (heap > 0)
      --heap;
    else
      std::swap(items[0], items[--unsorted]);
    T moved = std::move(items[heap]);
    std::size_t at = heap, child;
    while ((child = 2 * at + 1) < unsorted) {
      if (child + 1 < unsorted && before(items[child], items[child + 1])) ++child;
      if (!before(moved, items[child])) break;
      items[at] = std::move(items[child]);
      at = child;
    }
    items[at] = std::move(moved);
  }
}

}  // namespace sweepface
