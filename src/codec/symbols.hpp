#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

#include "codec/mixing.hpp"
#include "codec/range_coder.hpp"
#include "codec/refusal.hpp"

namespace sweepface::codec {

/// Whether a coder writes. A writer takes the values it is given; a reader ignores them and returns
/// those read.
template <typename Coder>
inline constexpr bool kWrites = std::is_same_v<Coder, RangeEncoder>;

/// Codes bits and whole numbers of a payload with adaptive contexts. `tag` says what is coded, `a`
/// and `b` what it may depend on. After invalid data the values that a reader returns mean nothing:
/// see ok().
template <typename Coder>
class Symbols : public Refusal {
 public:
  explicit Symbols(Coder& coder) : model_(coder, kSlots, kSets) {}

  bool bit(std::uint32_t tag, std::uint32_t a, std::uint32_t b, bool value) {
    value = model_.code(value,
                        {{slot(tag, recent_, 0), slot(tag, a * 521 + (recent_ & 4095), 1),
                          slot(tag, a * 521 + b, 2)}},
                        tag % kSets);
    recent_ = recent_ << 4 ^ (2 * tag + value);
    return value;
  }

  /// A number below 2^32: the length in bits (unary), then the bits (Elias 1975).
  std::uint32_t number(std::uint32_t tag, std::uint32_t a, std::uint32_t b, std::uint64_t value) {
    const int length = static_cast<int>(std::bit_width(value + 1));
    int n = 1;
    while (n < 33 && bit(tag, a * 64 + n, b, length > n)) ++n;
    std::uint64_t result = 1;
    for (int k = n - 1; k-- > 0;) {
      const std::uint32_t high = static_cast<std::uint32_t>(result < 16 ? result : 0);
      const bool one = (value + 1) >> k & 1;
      result = result << 1 | bit(tag + 1, a * 64 + n, high * 32 + k, one);
    }
    return static_cast<std::uint32_t>(result - 1);
  }

  /// 0, -1, 1, -2, 2 ... are coded as 0, 1, 2, 3, 4 ...
  std::int64_t signedNumber(std::uint32_t tag, std::uint32_t a, std::uint32_t b,
                            std::int64_t value) {
    const std::uint64_t folded =
        static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
    const std::int64_t n = number(tag, a, b, folded);
    return n >> 1 ^ -(n & 1);
  }

  /// One of `count` values, all equally likely.
  std::uint32_t index(std::uint32_t tag, std::uint32_t count, std::uint32_t value) {
    std::uint32_t result = 0;
    const int length = static_cast<int>(std::bit_width(count > 0 ? count - 1 : 0u));
    for (int k = length; k-- > 0;) result = result << 1 | bit(tag, k, 0, value >> k & 1);
    if (result >= count) refuse("an index is out of range");
    return ok() ? result : 0;
  }

  /// Eight bytes verbatim.
  std::uint64_t raw(std::uint32_t tag, std::uint64_t value) {
    std::uint64_t result = 0;
    for (int k = 64; k-- > 0;) result = result << 1 | bit(tag, k, 0, value >> k & 1);
    return result;
  }

 private:
  static constexpr std::size_t kSlots = std::size_t{1} << 15, kSets = 64;

  static std::uint32_t slot(std::uint32_t tag, std::uint32_t context, std::uint32_t input) {
    return hashOf(context * 3 + input, tag) & (kSlots - 1);
  }

  Model<Coder, 3> model_;
  std::uint32_t recent_ = 0;  // the last eight bits with their tags; the last three below 2^12
};

}  // namespace sweepface::codec
