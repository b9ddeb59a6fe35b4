// Shorter versions of functions that are long in the C library.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

extern "C" {

std::size_t strlen(const char* text) {
  const char* end = text;
  while (*end) ++end;
  return static_cast<std::size_t>(end - text);
}

// Rounds halves away from zero.
double round(double x) {
  const double whole = __builtin_trunc(x);
  return __builtin_fabs(x - whole) >= 0.5 ? whole + __builtin_copysign(1, x) : whole;
}

double ldexp(double x, int exponent) {
  const auto power = [](int n) { return std::bit_cast<double>(std::uint64_t(n + 1023) << 52); };
  int left = std::clamp(exponent, -3000, 3000);
  for (; left > 1023; left -= 1023) x *= power(1023);
  for (; left < -969; left += 969) x *= power(-969);  // may round a subnormal result twice
  return x * power(left);
}

}  // extern "C"
