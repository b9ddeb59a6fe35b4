#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface::codec {

/// Values by directed edges: a table with linear probing, a few hundred bytes of code.
template <typename Value>
class EdgeMap {
 public:
  /// Room for `count` edges; more must not be added.
  explicit EdgeMap(std::size_t count) : slots_(std::bit_ceil(2 * count + 1)) {}

  /// Keeps the first value of an edge.
  void add(Index from, Index to, const Value& value) {
    Slot& slot = slots_[placeOf(from, to)];
    if (!slot.used) slot = {from, to, true, value};
  }
  /// The value of an edge, or nothing.
  const Value* find(Index from, Index to) const {
    const Slot& slot = slots_[placeOf(from, to)];
    return slot.used ? &slot.value : nullptr;
  }

 private:
  struct Slot {
    Index from = 0, to = 0;
    bool used = false;
    Value value{};
  };

  /// Where an edge is, or would go.
  std::size_t placeOf(Index from, Index to) const {
    const std::uint64_t key =
        std::uint64_t{static_cast<std::uint32_t>(from)} << 32 | static_cast<std::uint32_t>(to);
    std::uint64_t hash = key * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
    std::size_t place = static_cast<std::size_t>(hash) & (slots_.size() - 1);
    while (slots_[place].used && (slots_[place].from != from || slots_[place].to != to))
      place = (place + 1) & (slots_.size() - 1);
    return place;
  }

  std::vector<Slot> slots_;
};

}  // namespace sweepface::codec
