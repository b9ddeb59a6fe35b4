#include "eval/planes.hpp"

#include <algorithm>

// Where the linker can choose by processor, loops are also compiled for wider registers.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(SWEEPFACE_PLAIN_KERNELS)
#if defined(__has_feature)
#if !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer)
#define SWEEPFACE_CLONES __attribute__((target_clones("avx2", "default")))
#endif
#else
#define SWEEPFACE_CLONES __attribute__((target_clones("avx2", "default")))
#endif
#endif
#ifndef SWEEPFACE_CLONES
#define SWEEPFACE_CLONES
#endif

namespace sweepface {
namespace {

// As many floats as WebAssembly, or elsewhere AVX, processes at once; other processors take them in
// halves. In memory they need no alignment.
#ifdef __wasm__
constexpr int kWide = 4;
#else
constexpr int kWide = 8;
#endif
using Wide [[gnu::vector_size(4 * kWide)]] = float;
using WideThere [[gnu::vector_size(4 * kWide), gnu::aligned(4), gnu::may_alias]] = float;
using WideInts [[gnu::vector_size(4 * kWide)]] = std::int32_t;
using WideShorts [[gnu::vector_size(2 * kWide), gnu::aligned(2), gnu::may_alias]] = std::int16_t;

[[gnu::always_inline]] inline WideThere& at(float* p) { return *reinterpret_cast<WideThere*>(p); }
[[gnu::always_inline]] inline const WideThere& at(const float* p) {
  return *reinterpret_cast<const WideThere*>(p);
}

// Whatever the width, eight sums are added up in the same order.
constexpr int kSums = 8;

// Raises each lane of `most` to that of x.
[[gnu::always_inline]] inline void raise(Wide& most, const Wide& x) { most = most < x ? x : most; }

// In here, as GCC makes every function that has clones visible outside its shared library. Clang
// does not emit inline functions that only such functions call: iterators of spans, constructors.
namespace loops {

// Three registers at once, as additions to a single one wait for each other.
SWEEPFACE_CLONES
void sumRows(const Scaled* terms, std::size_t count, int width, float* out) {
  for (int c = 0; c < width; c += 3 * kWide) {
    Wide a{}, b{}, d{};
    for (std::size_t t = 0; t < count; ++t) {
      const float* const row = terms[t].row + c;
      a += terms[t].factor * at(row);
      b += terms[t].factor * at(row + kWide);
      d += terms[t].factor * at(row + 2 * kWide);
    }
    at(out + c) = a, at(out + c + kWide) = b, at(out + c + 2 * kWide) = d;
  }
}

SWEEPFACE_CLONES
void project(const Planes& planes, const float* factors, float* out) {
  const int width = planes.width();
  for (int c = 0; c < width; c += 3 * kWide) {
    Wide a{}, b{}, d{};
    const float* row = planes.values.data() + c;
    for (int r = 0; r < planes.rows; ++r, row += width) {
      a += factors[r] * at(row);
      b += factors[r] * at(row + kWide);
      d += factors[r] * at(row + 2 * kWide);
    }
    at(out + c) = a, at(out + c + kWide) = b, at(out + c + 2 * kWide) = d;
  }
}

SWEEPFACE_CLONES
void dotRows(const Planes& planes, const float* vector, float* out) {
  const int width = planes.width();
  for (int r = 0; r < planes.rows; ++r) {
    const float* const row = planes.row(r);
    Wide sums[kSums / kWide] = {};
    for (int c = 0; c < width;)
      for (Wide& sum : sums) {
        sum += at(row + c) * at(vector + c);
        c += kWide;
      }
    float x[kSums];
    for (int s = 0; s < kSums; s += kWide) at(x + s) = sums[s / kWide];
    out[r] = ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
  }
}

SWEEPFACE_CLONES
void takeAway(Planes& planes, const float* factors, const float* vector) {
  const int width = planes.width();
  for (int r = 0; r < planes.rows; ++r) {
    float* const row = planes.row(r);
    const float factor = factors[r];
    for (int c = 0; c < width; c += kWide) at(row + c) -= factor * at(vector + c);
  }
}

SWEEPFACE_CLONES
void measureSquares(const Planes& planes, float* sums, float* largest) {
  const int lane = planes.lane;
  for (int c = 0; c < lane; c += kWide) {
    Wide x2{}, y2{}, z2{}, most{};
    for (int r = 0; r < planes.rows; ++r) {
      const float* const row = planes.row(r) + c;
      const Wide x = at(row) * at(row), y = at(row + lane) * at(row + lane),
                 z = at(row + 2 * lane) * at(row + 2 * lane), all = x + y + z;
      x2 += x, y2 += y, z2 += z;
      raise(most, all);
    }
    at(sums + c) = x2, at(sums + lane + c) = y2, at(sums + 2 * lane + c) = z2;
    at(largest + c) = most;
  }
}

SWEEPFACE_CLONES
void measureRest(const Planes& wanted, std::span<const float> basis, const float* coefficients,
                 float enough, float* largest) {
  const int lane = wanted.lane, width = wanted.width(), rows = wanted.rows;
  const int modes = static_cast<int>(basis.size()) / rows;
  for (int c = 0; c < lane; c += kWide) {
    Wide most{};
    for (int r = 0; r < rows; ++r) {
      Wide x{}, y{}, z{};
      for (int m = 0; m < modes; ++m) {
        const float* const from = coefficients + static_cast<std::size_t>(m) * width + c;
        const float factor = basis[static_cast<std::size_t>(m) * rows + r];
        x += factor * at(from);
        y += factor * at(from + lane);
        z += factor * at(from + 2 * lane);
      }
      const float* const to = wanted.row(r) + c;
      x -= at(to), y -= at(to + lane), z -= at(to + 2 * lane);
      const Wide squares = x * x + y * y + z * z;
      raise(most, squares);
    }
    at(largest + c) = most;
    if (*std::max_element(largest + c, largest + c + kWide) > enough) return;
  }
}

SWEEPFACE_CLONES
void clampAll(std::span<float> values, float most) {
  const Wide high = most - Wide{}, low = -high;
  for (std::size_t k = 0; k < values.size(); k += kWide) {
    Wide x = at(values.data() + k);
    raise(x, low);
    at(values.data() + k) = high < x ? high : x;
  }
}

SWEEPFACE_CLONES
Extent extentOf(std::span<const float> values) {
  Wide most{}, sums[kSums / kWide] = {};
  for (std::size_t k = 0; k < values.size();)
    for (Wide& sum : sums) {
      Wide size = at(values.data() + k);
      raise(size, -size);
      raise(most, size);
      sum += size;
      k += kWide;
    }
  float largest = 0, sum = 0;
  for (int s = 0; s < kWide; ++s) largest = std::max(largest, most[s]);
  for (int s = 0; s < kSums; ++s) sum += sums[s / kWide][s % kWide];
  return {largest, sum};
}

SWEEPFACE_CLONES
void roundAll(std::span<const float> values, float factor, std::int16_t* out) {
  constexpr float kWhole = 3 << 22;  // floats near this are whole, and their last bits say which
  for (std::size_t k = 0; k < values.size(); k += kWide) {
    const Wide rounded = at(values.data() + k) * factor + kWhole;
    const auto bits = (WideInts)rounded;
    reinterpret_cast<WideShorts&>(out[k]) = __builtin_convertvector(bits, WideShorts);
  }
}

}  // namespace loops
}  // namespace

void sumRows(std::span<const Scaled> terms, int width, float* out) {
  loops::sumRows(terms.data(), terms.size(), width, out);
}
void project(const Planes& planes, const float* factors, float* out) {
  loops::project(planes, factors, out);
}
void dotRows(const Planes& planes, const float* vector, float* out) {
  loops::dotRows(planes, vector, out);
}
void takeAway(Planes& planes, const float* factors, const float* vector) {
  loops::takeAway(planes, factors, vector);
}
void measureSquares(const Planes& planes, float* sums, float* largest) {
  loops::measureSquares(planes, sums, largest);
}
void measureRest(const Planes& wanted, std::span<const float> basis, const float* coefficients,
                 float enough, float* largest) {
  loops::measureRest(wanted, basis, coefficients, enough, largest);
}
void clampAll(std::span<float> values, float most) { loops::clampAll(values, most); }
Extent extentOf(std::span<const float> values) { return loops::extentOf(values); }
void roundAll(std::span<const float> values, float factor, std::int16_t* out) {
  loops::roundAll(values, factor, out);
}

}  // namespace sweepface
