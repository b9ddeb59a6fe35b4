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

/// What an output holds, and where; at NULL: nothing.
struct Written {
  float* data = nullptr;
  std::size_t stride = 0, count = 0;
  Weights weights;

  bool is(const sweepface_vectors& to, std::size_t vertices) const {
    return data == to.data && stride == to.stride && count == vertices;
  }
  bool overlaps(const sweepface_vectors& to, std::size_t vertices) const {
    const Written other{to.data, to.stride, vertices, {}};
    const std::less<> before;
    return data && to.data && before(begin(), other.end()) && before(other.begin(), end());
  }
  /// Whether writing another output of `size` bytes a vertex there changes this one: both may be
  /// parts of the same structs.
  bool isHitBy(const sweepface_vectors& to, std::size_t vertices, std::size_t size = kTight) const {
    const std::size_t own = strideOf({data, stride}), theirs = strideOf(to, size);
    if (!overlaps({to.data, theirs}, vertices)) return false;
    const auto period = static_cast<std::ptrdiff_t>(own);
    const std::ptrdiff_t apart = reinterpret_cast<const char*>(to.data) - begin();
    const auto from = static_cast<std::size_t>((apart % period + period) % period);
    return own != theirs || from < kTight || own - from < size;
  }

 private:
  const char* begin() const { return reinterpret_cast<const char*>(data); }
  const char* end() const { return begin() + strideOf({data, stride}) * count; }
};

/// Where an output was written before the last time: buffers are often written in turn.
class WrittenBefore {
 public:
  explicit WrittenBefore(const Weights& rest) {
    for (Written& place : places_) place.weights = rest;
  }

  /// Makes the place of an output the last one, if it is among these.
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

  /// Something else is written there.
  void forget(const sweepface_vectors& to, std::size_t count, std::size_t size = kTight) {
    for (Written& w : places_)
      if (w.isHitBy(to, count, size)) w.data = nullptr;
  }

 private:
  std::array<Written, 2> places_;
};

}  // namespace sweepface::capi
