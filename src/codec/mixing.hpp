#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

// Logistic mixing of the bit probabilities of several contexts, with adaptive weights (Mahoney,
// Adaptive Weighing of Context Models for Lossless Data Compression, 2005). Integers only, so that
// every machine computes the same probabilities.
namespace sweepface::codec {

/// Hashes two numbers to 32 bits.
constexpr std::uint32_t hashOf(std::uint32_t a, std::uint32_t b) {
  std::uint32_t x = a * 0x9e3779b1u + b * 0x85ebca6bu;
  x ^= x >> 15;
  x *= 0x2c1b3c6du;
  x ^= x >> 13;
  return x;
}

/// 65536 / (1 + e^(-x / 256)) for x in [-3072, 3072], piecewise linear.
[[gnu::always_inline]] inline std::int32_t squash(std::int32_t x) {
  static constexpr std::array<std::int32_t, 49> kAt{
      1,     1,     1,     2,     3,     5,     8,     13,    22,    36,    60,    98,    162,
      267,   439,   720,   1179,  1921,  3108,  4971,  7812,  11955, 17625, 24743, 32768, 40793,
      47911, 53581, 57724, 60565, 62428, 63615, 64357, 64816, 65097, 65269, 65374, 65438, 65476,
      65500, 65514, 65523, 65528, 65531, 65533, 65534, 65535, 65535, 65535};
  if (x <= -3072) return kAt[0];
  if (x >= 3072) return kAt[48];
  const std::int32_t place = x + 3072, left = place >> 7, rest = place & 127;
  return kAt[left] + (((kAt[left + 1] - kAt[left]) * rest + 64) >> 7);
}

/// The inverse of squash for probabilities in 4096ths: the least x with squash(x) / 16 >= p.
/// Computed at first use rather than constexpr, so that a browser need not load its 8 KB.
using StretchTable = std::array<std::int16_t, 4096>;
inline StretchTable makeStretchTable() {
  StretchTable t{};
  std::int32_t p = 0;
  for (std::int32_t x = -3072; x <= 3072; ++x)
    for (const std::int32_t reached = squash(x) >> 4; p <= reached && p < 4096; ++p)
      t[p] = static_cast<std::int16_t>(x);
  for (; p < 4096; ++p) t[p] = 3072;
  return t;
}
inline const StretchTable& stretchTable() {
  static const StretchTable table = makeStretchTable();
  return table;
}

/// What one context knows about the next bit: the probability of a 1 in 65536ths, and how many bits
/// it has seen.
struct Slot {
  std::uint16_t one = 32768, seen = 0;
};

/// Codes bits through `Coder`, a RangeEncoder or a RangeDecoder, with the slots of several contexts
/// and a set of weights selected by one more.
template <typename Coder, int kInputs>
class Model {
 public:
  /// In a slot, bits that lie more than `memory` bits back count less and less.
  Model(Coder& coder, std::size_t slots, std::size_t sets, std::uint16_t memory = kMostSeen)
      : coder_(&coder),
        stretch_(stretchTable().data()),
        slots_(slots),
        memory_(std::min(memory, kMostSeen)) {
    weights_.assign(sets * kInputs, (1 << 18) / 3 / (kInputs + 1));
  }

  /// `contexts` selects a slot for each input, `set` the weights.
  bool code(bool bit, const std::array<std::uint32_t, kInputs>& contexts, std::uint32_t set) {
    std::int32_t stretched[kInputs];
    std::int32_t* weight = &weights_[std::size_t{set} * kInputs];
    std::int64_t sum = 0;
    for (int k = 0; k < kInputs; ++k) {
      const Slot& slot = slots_[contexts[k]];
      stretched[k] = stretch_[slot.one >> 4] * kTrust[slot.seen] / 16;
      sum += std::int64_t{stretched[k]} * weight[k];
    }
    std::int32_t x = static_cast<std::int32_t>(sum >> 16);
    x = x < -3071 ? -3071 : x > 3071 ? 3071 : x;
    const std::int32_t one = squash(x);
    bit = coder_->code(bit, static_cast<std::uint32_t>(one));
    const std::int32_t error = ((bit << 16) - one) * kRate / 16;
    for (int k = 0; k < kInputs; ++k) {
      weight[k] += static_cast<std::int32_t>((std::int64_t{stretched[k]} * error + 0x8000) >> 16);
      learn(slots_[contexts[k]], bit);
    }
    return bit;
  }

 private:
  // The more bits a context has seen, the more it is trusted and the more slowly it adapts.
  static constexpr std::uint16_t kMostSeen = 30;
  static constexpr int kRate = 14;
  static constexpr std::array<std::int32_t, 64> kTrust = [] {
    std::array<std::int32_t, 64> t{};
    for (int n = 0; n < 64; ++n) t[n] = 16 * n / (n + 1) + (n > 0 ? 4 : 0);
    return t;
  }();

  // 2^32 / (2 n + 3), rounded up. For numerators below 2^17 the product with it, shifted right by
  // 32 bits, is the quotient.
  static constexpr std::array<std::uint32_t, kMostSeen + 1> kShare = [] {
    std::array<std::uint32_t, kMostSeen + 1> t{};
    for (std::uint32_t n = 0; n <= kMostSeen; ++n) t[n] = 0xffffffffu / (2 * n + 3) + 1;
    return t;
  }();

  void learn(Slot& slot, bool bit) const {
    const std::uint32_t way = bit ? 65535u - slot.one : slot.one;
    const auto step =
        static_cast<std::uint32_t>((std::uint64_t{2 * way} * kShare[slot.seen]) >> 32);
    slot.one = static_cast<std::uint16_t>(bit ? slot.one + step : slot.one - step);
    if (slot.seen < memory_) ++slot.seen;
  }

  Coder* coder_;
  const std::int16_t* stretch_;
  std::vector<Slot> slots_;
  std::uint16_t memory_;
  std::vector<std::int32_t> weights_;
};

}  // namespace sweepface::codec
