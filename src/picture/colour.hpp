#pragma once

#include <algorithm>
#include <cmath>

#include "sweepface/picture.hpp"

namespace sweepface {

/// Light as RGB, linear in intensity.
struct Light {
  double r = 0, g = 0, b = 0;

  Light& operator+=(const Light& o) {
    r += o.r, g += o.g, b += o.b;
    return *this;
  }
};

inline Light operator+(Light a, const Light& b) { return a += b; }
inline Light operator*(const Light& a, double s) { return {a.r * s, a.g * s, a.b * s}; }
inline Light operator*(double s, const Light& a) { return a * s; }
inline Light operator*(const Light& a, const Light& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }

/// The sRGB transfer functions (IEC 61966-2-1).
inline double linearFromScreen(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
inline double screenFromLinear(double c) {
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}
inline Light toLight(const Colour& c) {
  return {linearFromScreen(c.r), linearFromScreen(c.g), linearFromScreen(c.b)};
}
inline Colour toColour(const Light& l) {
  const auto screen = [](double c) {
    return static_cast<float>(screenFromLinear(std::clamp(c, 0.0, 1.0)));
  };
  return {screen(l.r), screen(l.g), screen(l.b)};
}

inline Colour mix(const Colour& a, const Colour& b, float t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

inline std::uint8_t toByte(float c) {
  return c > 0 ? static_cast<std::uint8_t>(std::lround(255 * std::min(c, 1.0f))) : 0;
}

}  // namespace sweepface
