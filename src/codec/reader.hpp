#pragma once

#include <cstdint>
#include <string_view>

#include "sweepface/vec.hpp"

#include "codec/refusal.hpp"

namespace sweepface::codec {

/// Reads values from a chunk's payload. The first failure sticks: from then on nothing is left and
/// everything reads as zero, so callers need to check ok() only before they rely on what they have
/// read.
class Reader : public Refusal {
 public:
  Reader(std::string_view bytes, std::size_t offset) : bytes_(bytes), offset_(offset) {}

  /// Offset in the file of the failure, or of the next byte.
  std::size_t place() const { return offset_ + at_; }
  std::size_t left() const { return ok() ? bytes_.size() - at_ : 0; }

  unsigned byte();
  std::uint64_t number();  // below 2^56
  std::size_t size();      // a number that an Index can hold
  std::int64_t signedNumber();
  double f32();  // finite
  double f64();  // finite
  std::string_view text();
  std::string_view raw(std::size_t size);

  /// The number of entries that follow, each of at least `leastBytes`. A number that cannot fit in
  /// the rest is refused before any memory is allocated for it.
  std::size_t count(std::size_t leastBytes, const char* what);

  /// A number, or a step from `previous`, within [low, high).
  Index number(std::int64_t low, std::int64_t high, const char* what);
  Index step(Index previous, std::int64_t low, std::int64_t high, const char* what);

 private:
  template <typename Number>
  Number fixed();
  Index checked(std::int64_t value, std::int64_t low, std::int64_t high, const char* what);

  std::string_view bytes_;
  std::size_t offset_, at_ = 0;
};

}  // namespace sweepface::codec
