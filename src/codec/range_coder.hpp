#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sweepface::codec {

/// Binary range coder: each bit narrows an interval of 32-bit numbers in proportion to its
/// probability, and bytes are output as soon as both ends agree on them (Martin 1979, in the
/// carryless form of Mahoney's PAQ). `one` is the probability of a 1 in 65536ths, within (0,
/// 65536).
class RangeEncoder {
 public:
  bool code(bool bit, std::uint32_t one) {
    const std::uint32_t middle = low_ + split(low_, high_, one);
    (bit ? high_ : low_) = bit ? middle : middle + 1;
    for (; (low_ ^ high_) >> 24 == 0; low_ <<= 8, high_ = high_ << 8 | 255)
      bytes_ += static_cast<char>(high_ >> 24);
    return bit;
  }

  /// The bytes so far, followed by as few more as identify the final interval.
  std::string finish() {
    // Missing bytes read as zero, so find the number in the interval with the fewest bytes before
    // its zeros.
    for (int bytes = 1; low_ > 0; ++bytes) {
      const std::uint32_t mask = bytes >= 4 ? 0 : 0xffffffffu >> (8 * bytes);
      const std::uint64_t number = (std::uint64_t{low_} + mask) & ~std::uint64_t{mask};
      if (number > high_) continue;
      for (int k = 0; k < bytes; ++k) bytes_ += static_cast<char>(number >> (24 - 8 * k) & 255);
      break;
    }
    while (!bytes_.empty() && bytes_.back() == 0) bytes_.pop_back();
    return std::move(bytes_);
  }

  static std::uint32_t split(std::uint32_t low, std::uint32_t high, std::uint32_t one) {
    return static_cast<std::uint32_t>((std::uint64_t{high - low} * one) >> 16);
  }

 private:
  std::uint32_t low_ = 0, high_ = 0xffffffff;
  std::string bytes_;
};

/// Reads what RangeEncoder has written. Beyond the end it reads zeros, since the encoder cuts them
/// off.
class RangeDecoder {
 public:
  explicit RangeDecoder(std::string_view bytes) : bytes_(bytes) {
    for (int k = 0; k < 4; ++k) number_ = number_ << 8 | next();
  }

  [[gnu::always_inline]] bool code(bool, std::uint32_t one) {
    const std::uint32_t middle = low_ + RangeEncoder::split(low_, high_, one);
    const bool bit = number_ <= middle;
    (bit ? high_ : low_) = bit ? middle : middle + 1;
    for (; (low_ ^ high_) >> 24 == 0; low_ <<= 8, high_ = high_ << 8 | 255)
      number_ = number_ << 8 | next();
    return bit;
  }

  /// Whether all bytes have been consumed.
  bool exhausted() const { return at_ == bytes_.size(); }

 private:
  std::uint32_t next() {
    return at_ < bytes_.size() ? static_cast<unsigned char>(bytes_[at_++]) : 0;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint32_t low_ = 0, high_ = 0xffffffff, number_ = 0;
};

}  // namespace sweepface::codec
