#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "sweepface/evaluator.hpp"
#include "sweepface/sweepface.h"

namespace sweepface::capi {

inline constexpr std::size_t kTight = 3 * sizeof(float);

inline bool fits(const sweepface_vectors& out, std::size_t tight = kTight) {
  return out.stride == 0 || (out.stride >= tight && out.stride <= kMostStride);
}

inline std::size_t strideOf(const sweepface_vectors& out, std::size_t tight = kTight) {
  return out.stride ? out.stride : tight;
}

/// What an output holds, and where; if `data` is NULL, nothing.
struct Written {
  float* data = nullptr;
  std::size_t stride = 0, count = 0;
  Weights weights;

  bool is(const sweepface_vectors& to, std::size_t vertices) const {
    return data == to.data && stride == to.stride && count == vertices;
  }
  /// Whether the range of bytes from the first to the last of this output overlaps that of another,
  /// with `size` bytes per vertex.
  bool overlaps(const sweepface_vectors& to, std::size_t vertices,
                std::size_t size = kTight) const {
    const char* const other = reinterpret_cast<const char*>(to.data);
    const std::less<> before;
    return data && to.data && count > 0 && vertices > 0 &&
           before(begin(), endOf(other, strideOf(to, size), vertices, size)) &&
           before(other, endOf(begin(), strideOf({data, stride}), count, kTight));
  }
  /// Whether writing the other output changes this one. They may be different members of the same
  /// structs.
  bool isHitBy(const sweepface_vectors& to, std::size_t vertices, std::size_t size = kTight) const {
    if (!overlaps(to, vertices, size)) return false;
    const auto own = static_cast<std::ptrdiff_t>(strideOf({data, stride})),
               theirs = static_cast<std::ptrdiff_t>(strideOf(to, size));
    const std::ptrdiff_t apart = reinterpret_cast<const char*>(to.data) - begin();
    const auto hits = [&](std::ptrdiff_t from) {  // bytes after the start of one of our vertices
      return from < static_cast<std::ptrdiff_t>(kTight) ||
             own - from < static_cast<std::ptrdiff_t>(size);
    };
    if (own == theirs) return hits((apart % own + own) % own);
    const auto last = own * static_cast<std::ptrdiff_t>(count - 1);
    for (std::size_t v = 0; v < vertices; ++v) {
      const std::ptrdiff_t at = apart + theirs * static_cast<std::ptrdiff_t>(v);
      const std::ptrdiff_t vertex = std::clamp(at / own * own, std::ptrdiff_t{0}, last);
      for (const std::ptrdiff_t each : {vertex, std::min(vertex + own, last)})
        if (at < each + static_cast<std::ptrdiff_t>(kTight) &&
            each < at + static_cast<std::ptrdiff_t>(size))
          return true;
    }
    return false;
  }

 private:
  const char* begin() const { return reinterpret_cast<const char*>(data); }
  static const char* endOf(const char* first, std::size_t stride, std::size_t count,
                           std::size_t size) {
    return first + stride * (count - 1) + size;
  }
};

/// Where an output was written before the last time, as buffers are often written in turn.
class WrittenBefore {
 public:
  explicit WrittenBefore(const Weights& rest) {
    for (Written& place : places_) place.weights = rest;
  }

  /// Makes the place of an output the last one, if it is among the earlier ones.
  void bringBack(Written& last, const sweepface_vectors& to, std::size_t count) {
    if (last.is(to, count)) return;
    auto place = std::ranges::find_if(places_, [&](const Written& w) { return w.is(to, count); });
    const bool isNew = place == places_.end();
    if (isNew) --place;
    std::rotate(places_.begin(), place, place + 1);
    std::swap(places_.front(), last);
    if (!isNew) return;
    for (Written& w : places_)
      if (w.overlaps(to, count)) w.data = nullptr;
  }

  /// Forgets what is overwritten by something else.
  void forget(const sweepface_vectors& to, std::size_t count, std::size_t size = kTight) {
    for (Written& w : places_)
      if (w.isHitBy(to, count, size)) w.data = nullptr;
  }

 private:
  std::array<Written, 2> places_;
};

}  // namespace sweepface::capi
