#include "eval/planes.hpp"

#include <algorithm>

// Where the linker can choose by processor, loops exist for wider registers as well.
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

constexpr int kWide = 8;

}  // namespace

SWEEPFACE_CLONES
void sumRows(std::span<const Scaled> terms, int width, float* out) {
  for (int c = 0; c < width; c += kWide) {
    float sums[kWide] = {};
    for (const Scaled& term : terms)
      for (int s = 0; s < kWide; ++s) sums[s] += term.factor * term.row[c + s];
    for (int s = 0; s < kWide; ++s) out[c + s] = sums[s];
  }
}

SWEEPFACE_CLONES
void project(const Planes& planes, const float* factors, float* out) {
  const int width = planes.width();
  for (int c = 0; c < width; c += kWide) {
    float sums[kWide] = {};
    const float* from = planes.values.data() + c;
    for (int r = 0; r < planes.rows; ++r, from += width)
      for (int s = 0; s < kWide; ++s) sums[s] += factors[r] * from[s];
    for (int s = 0; s < kWide; ++s) out[c + s] = sums[s];
  }
}

SWEEPFACE_CLONES
void dotRows(const Planes& planes, const float* vector, float* out) {
  const int width = planes.width();
  for (int r = 0; r < planes.rows; ++r) {
    const float* const row = planes.row(r);
    float sums[kWide] = {};
    for (int c = 0; c < width; c += kWide)
      for (int s = 0; s < kWide; ++s) sums[s] += row[c + s] * vector[c + s];
    out[r] =
        ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
  }
}

SWEEPFACE_CLONES
void takeAway(Planes& planes, const float* factors, const float* vector) {
  const int width = planes.width();
  for (int r = 0; r < planes.rows; ++r) {
    float* const row = planes.row(r);
    const float factor = factors[r];
    for (int c = 0; c < width; c += kWide)
      for (int s = 0; s < kWide; ++s) row[c + s] -= factor * vector[c + s];
  }
}

SWEEPFACE_CLONES
void measureSquares(const Planes& planes, float* sums, float* largest) {
  const int lane = planes.lane;
  for (int c = 0; c < lane; c += kWide) {
    float x2[kWide] = {}, y2[kWide] = {}, z2[kWide] = {}, most[kWide] = {};
    for (int r = 0; r < planes.rows; ++r) {
      const float* const row = planes.row(r) + c;
      for (int s = 0; s < kWide; ++s) {
        const float x = row[s] * row[s], y = row[lane + s] * row[lane + s],
                    z = row[2 * lane + s] * row[2 * lane + s], all = x + y + z;
        x2[s] += x, y2[s] += y, z2[s] += z;
        most[s] = all > most[s] ? all : most[s];
      }
    }
    for (int s = 0; s < kWide; ++s) {
      sums[c + s] = x2[s], sums[lane + c + s] = y2[s], sums[2 * lane + c + s] = z2[s];
      largest[c + s] = most[s];
    }
  }
}

SWEEPFACE_CLONES
void measureRest(const Planes& wanted, std::span<const float> basis, const float* coefficients,
                 float enough, float* largest) {
  const int lane = wanted.lane, width = wanted.width(), rows = wanted.rows;
  const int modes = static_cast<int>(basis.size()) / rows;
  for (int c = 0; c < lane; c += kWide) {
    float most[kWide] = {};
    for (int r = 0; r < rows; ++r) {
      float squares[kWide] = {};
      for (int axis = 0; axis < 3; ++axis) {
        float sums[kWide] = {};
        for (int m = 0; m < modes; ++m) {
          const float b = basis[static_cast<std::size_t>(m) * rows + r];
          const float* const from =
              coefficients + static_cast<std::size_t>(m) * width + axis * lane + c;
          for (int s = 0; s < kWide; ++s) sums[s] += b * from[s];
        }
        const float* const to = wanted.row(r) + axis * lane + c;
        for (int s = 0; s < kWide; ++s) squares[s] += (sums[s] - to[s]) * (sums[s] - to[s]);
      }
      for (int s = 0; s < kWide; ++s) most[s] = squares[s] > most[s] ? squares[s] : most[s];
    }
    for (int s = 0; s < kWide; ++s) largest[c + s] = most[s];
    if (*std::max_element(most, most + kWide) > enough) return;
  }
}

}  // namespace sweepface
