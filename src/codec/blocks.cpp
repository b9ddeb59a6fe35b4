#include "codec/blocks.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace sweepface::codec {

namespace {

constexpr unsigned kMasked = 1, kDouble = 2,
                   kDecimal = 4;  // bits of the form of a block of vectors

constexpr std::array<double, 2> components(const Vec2& v) { return {v.x, v.y}; }
constexpr std::array<double, 3> components(const Vec3& v) { return {v.x, v.y, v.z}; }
void assign(Vec2& v, const std::array<double, 2>& c) { v = {c[0], c[1]}; }
void assign(Vec3& v, const std::array<double, 3>& c) { v = {c[0], c[1], c[2]}; }

float rounded(double x) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -largest, largest));
}

template <typename V>
bool fitFloats(const std::vector<V>& vectors) {
  return std::ranges::all_of(vectors, [](const V& v) {
    return std::ranges::all_of(components(v), [](double x) { return rounded(x) == x; });
  });
}

// Whether a value reads back as +0. -0 is a different number.
bool isZero(double x, bool isDouble) {
  return isDouble ? std::bit_cast<std::uint64_t>(x) == 0
                  : std::bit_cast<std::uint32_t>(rounded(x)) == 0;
}

template <typename V>
std::vector<char> findNonZero(const std::vector<V>& vectors, bool isDouble) {
  std::vector<char> mask;
  for (const V& v : vectors)
    mask.push_back(
        !std::ranges::all_of(components(v), [&](double x) { return isZero(x, isDouble); }));
  return mask;
}

// Powers of ten that are exact as doubles, so that n / 10^digits is the double nearest to the
// decimal number, the same that its text would be parsed as.
constexpr std::array<double, 13> kPowersOfTen{1,   1e1, 1e2, 1e3,  1e4,  1e5, 1e6,
                                              1e7, 1e8, 1e9, 1e10, 1e11, 1e12};
constexpr double kMostDecimal = 9e15;  // whole numbers below are exact

bool isDecimal(double x, double power) {
  const double n = x * power;
  if (!(std::abs(n) < kMostDecimal)) return false;
  return std::bit_cast<std::uint64_t>(static_cast<double>(std::llround(n)) / power) ==
         std::bit_cast<std::uint64_t>(x);
}

// The fewest decimal places with which all components can be written, or -1.
template <typename V>
int decimalDigits(const std::vector<V>& vectors) {
  std::size_t digits = 0;
  for (const V& v : vectors)
    for (const double x : components(v))
      while (digits < kPowersOfTen.size() && !isDecimal(x, kPowersOfTen[digits])) ++digits;
  const bool found = digits < kPowersOfTen.size() &&
                     std::ranges::all_of(
                         vectors,
                         [&](const V& v) {
                           return std::ranges::all_of(components(v), [&](double x) {
                             return isDecimal(x, kPowersOfTen[digits]);
                           });
                         });
  return found ? static_cast<int>(digits) : -1;
}

template <typename V>
void writeDecimals(Writer& out, const std::vector<V>& vectors, int digits) {
  out.byte(kDecimal);
  out.byte(static_cast<unsigned>(digits));
  std::array<std::int64_t, components(V{}).size()> last{};
  for (const V& v : vectors)
    for (std::size_t k = 0; k < last.size(); ++k) {
      const std::int64_t n = std::llround(components(v)[k] * kPowersOfTen[digits]);
      out.signedNumber(n - last[k]);
      last[k] = n;
    }
}

template <typename V>
std::vector<V> readDecimals(Reader& in, std::size_t count) {
  const unsigned digits = in.byte();
  if (digits >= kPowersOfTen.size()) in.refuse("decimals have too many digits");
  auto value = components(V{});
  std::array<std::int64_t, value.size()> last{};
  if (count > in.left() / value.size()) in.refuse("vectors are missing");
  if (!in.ok()) return {};
  std::vector<V> vectors(count);
  for (V& v : vectors) {
    for (std::size_t k = 0; k < last.size(); ++k) {
      last[k] += in.signedNumber();
      if (std::abs(static_cast<double>(last[k])) >= kMostDecimal)
        in.refuse("a decimal is too large");
      if (!in.ok()) return {};
      value[k] = static_cast<double>(last[k]) / kPowersOfTen[digits];
    }
    assign(v, value);
  }
  return vectors;
}

std::size_t maskBytes(std::size_t count) { return count / 8 + (count % 8 != 0); }

}  // namespace

void writeMask(Writer& out, const std::vector<char>& mask) {
  for (std::size_t k = 0; k < mask.size(); k += 8) {
    unsigned bits = 0;
    for (std::size_t bit = 0; bit < std::min<std::size_t>(8, mask.size() - k); ++bit)
      bits |= static_cast<unsigned>(mask[k + bit]) << bit;
    out.byte(bits);
  }
}

std::vector<char> readMask(Reader& in, std::size_t count) {
  const std::string_view bytes = in.raw(maskBytes(count));
  if (!in.ok()) return {};
  const auto bit = [&](std::size_t k) { return static_cast<char>(bytes[k / 8] >> (k % 8) & 1); };
  std::vector<char> mask(count);
  for (std::size_t k = 0; k < count; ++k) mask[k] = bit(k);
  for (std::size_t k = count; k < 8 * bytes.size(); ++k)
    if (bit(k)) in.refuse("a mask has bits beyond its end");
  return mask;
}

template <typename V>
void writeVectors(Writer& out, const std::vector<V>& vectors, Precision precision) {
  const bool isDouble = precision == Precision::exact && !fitFloats(vectors);
  if (const int digits = isDouble ? decimalDigits(vectors) : -1; digits >= 0)
    return writeDecimals(out, vectors, digits);
  const std::vector<char> mask = findNonZero(vectors, isDouble);
  const std::size_t size = components(V{}).size() * (isDouble ? 8 : 4);
  const auto zeros = static_cast<std::size_t>(std::ranges::count(mask, false));
  const bool masked = maskBytes(vectors.size()) < zeros * size;
  out.byte((masked ? kMasked : 0) | (isDouble ? kDouble : 0));
  if (masked) writeMask(out, mask);
  for (std::size_t k = 0; k < vectors.size(); ++k)
    if (!masked || mask[k])
      for (const double x : components(vectors[k])) isDouble ? out.f64(x) : out.f32(rounded(x));
}

template <typename V>
std::vector<V> readVectors(Reader& in, std::size_t count, Precision precision) {
  const unsigned form = in.byte();
  const bool isDouble = form & kDouble;
  if (form == kDecimal && precision == Precision::exact) return readDecimals<V>(in, count);
  if (form > (precision == Precision::exact ? kMasked | kDouble : kMasked))
    in.refuse("vectors are held in a form this program does not know");
  std::vector<char> mask;
  if (form & kMasked) mask = readMask(in, count);
  auto value = components(V{});
  const std::size_t held = mask.empty() ? count : std::ranges::count(mask, true);
  if (held > in.left() / (value.size() * (isDouble ? 8 : 4))) in.refuse("vectors are missing");
  if (!in.ok()) return {};
  std::vector<V> vectors(count);
  for (std::size_t k = 0; k < count; ++k) {
    if (!mask.empty() && !mask[k]) continue;
    for (double& x : value) {
      x = isDouble ? in.f64() : in.f32();
      if (std::abs(x) > std::numeric_limits<float>::max())
        in.refuse("a coordinate is beyond single precision");
    }
    assign(vectors[k], value);
  }
  return vectors;
}

template void writeVectors(Writer&, const std::vector<Vec2>&, Precision);
template void writeVectors(Writer&, const std::vector<Vec3>&, Precision);
template std::vector<Vec2> readVectors(Reader&, std::size_t, Precision);
template std::vector<Vec3> readVectors(Reader&, std::size_t, Precision);

void writeRuns(Writer& out, const std::vector<Index>& values) {
  std::vector<std::size_t> starts;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (k == 0 || values[k] != values[k - 1]) starts.push_back(k);
  out.number(starts.size());
  starts.push_back(values.size());
  for (std::size_t r = 0; r + 1 < starts.size(); ++r) {
    out.signedNumber(values[starts[r]]);
    out.number(starts[r + 1] - starts[r]);
  }
}

std::vector<Index> readRuns(Reader& in, Index low, Index high, std::size_t most, const char* what) {
  std::vector<Index> values;
  for (std::size_t runs = in.count(2, "runs"); runs > 0 && in.ok(); --runs) {
    const Index value = in.step(0, low, high, what);
    const std::uint64_t length = in.number();
    if (length == 0 || length > most - values.size()) in.refuse("a run has a wrong length");
    if (in.ok()) values.insert(values.end(), static_cast<std::size_t>(length), value);
  }
  return values;
}

void writeTexts(Writer& out, const std::vector<std::string>& texts) {
  out.number(texts.size());
  for (const std::string& text : texts) out.text(text);
}

std::vector<std::string> readTexts(Reader& in, const char* what) {
  std::vector<std::string> texts;
  for (std::size_t count = in.count(1, what); count > 0 && in.ok(); --count)
    texts.emplace_back(in.text());
  return texts;
}

}  // namespace sweepface::codec
