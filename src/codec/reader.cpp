#include "codec/reader.hpp"

#include <bit>
#include <cmath>
#include <cstring>

#include "sweepface/result.hpp"

namespace sweepface::codec {

std::string_view Reader::raw(std::size_t size) {
  if (size > left()) {
    refuse("the chunk ends within a value");
    return {};
  }
  at_ += size;
  return bytes_.substr(at_ - size, size);
}

unsigned Reader::byte() {
  const std::string_view taken = raw(1);
  return taken.empty() ? 0 : static_cast<unsigned char>(taken[0]);
}

// The lowest byte first.
template <typename Number>
Number Reader::fixed() {
  static_assert(std::endian::native == std::endian::little);
  Number value = 0;
  if (const std::string_view taken = raw(sizeof value); !taken.empty())
    std::memcpy(&value, taken.data(), sizeof value);
  return value;
}

double Reader::f32() {
  const float value = fixed<float>();
  if (!std::isfinite(value)) refuse("a coordinate is not finite");
  return ok() ? value : 0;
}

double Reader::f64() {
  const double value = fixed<double>();
  if (!std::isfinite(value)) refuse("a value is not finite");
  return ok() ? value : 0;
}

std::size_t Reader::size() {
  const std::uint64_t value = number();
  if (value > 0x7fffffff) refuse("a count is beyond what any index can hold");
  return ok() ? static_cast<std::size_t>(value) : 0;
}

std::uint64_t Reader::number() {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 56; shift += 7) {
    const unsigned next = byte();
    value |= std::uint64_t{next & 127} << shift;
    if (next >= 128) continue;
    if (next == 0 && shift > 0) refuse("a number is not in its shortest form");
    return ok() ? value : 0;
  }
  refuse("a number is too large");
  return 0;
}

std::int64_t Reader::signedNumber() {
  const std::uint64_t value = number();
  return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

std::string_view Reader::text() { return raw(count(1, "letters")); }

std::size_t Reader::count(std::size_t leastBytes, const char* what) {
  const std::uint64_t entries = number();
  if (entries <= left() / leastBytes) return static_cast<std::size_t>(entries);
  refuseCount(what, static_cast<long long>(entries));
  return 0;
}

Index Reader::number(std::int64_t low, std::int64_t high, const char* what) {
  return checked(static_cast<std::int64_t>(number()), low, high, what);
}

Index Reader::step(Index previous, std::int64_t low, std::int64_t high, const char* what) {
  return checked(previous + signedNumber(), low, high, what);
}

Index Reader::checked(std::int64_t value, std::int64_t low, std::int64_t high, const char* what) {
  if (ok() && value >= low && value < high) return static_cast<Index>(value);
  refuseNumber(what, value);
  return static_cast<Index>(low);
}

}  // namespace sweepface::codec
