#include "picture/shading.hpp"

#include <cmath>
#include <numbers>

namespace sweepface {
namespace {

constexpr Light kSkyAbove{0.62, 0.64, 0.68}, kSkyBelow{0.34, 0.30, 0.27};
constexpr Light kKey{0.92, 0.87, 0.80}, kFill{0.16, 0.18, 0.22}, kRim{0.50, 0.53, 0.58};
/// The inner side of an open surface: neither bright nor black.
constexpr Light kInside{0.17, 0.125, 0.11};

Light bent(const Light& l, double r, double g, double b) {
  return {std::pow(l.r, r), std::pow(l.g, g), std::pow(l.b, b)};
}

/// Light that is occluded in a hollow comes back from its walls, in their colour (Jimenez et al.,
/// Practical Realtime Strategies for Accurate Indirect Occlusion, 2016).
Light withBounces(double visible, const Light& colour) {
  const auto channel = [&](double c) {
    const double a = 2.0404 * c - 0.3324, b = -4.7951 * c + 0.6417, d = 2.7552 * c + 0.6903;
    return std::max(visible, ((visible * a + b) * visible + d) * visible);
  };
  return {channel(colour.r), channel(colour.g), channel(colour.b)};
}

Light skyOver(const Vec3& normal) {
  const double up = 0.5 + 0.5 * normal.y;
  return up * kSkyAbove + (1 - up) * kSkyBelow;
}

/// Diffuse lighting by a lamp of a surface that light enters and leaves some way off.
double wrapped(double cosine, double width) {
  return std::max(0.0, (cosine + width) / ((1 + width) * (1 + width)));
}

double highlight(const SurfacePoint& p, const Vec3& lamp, double sharpness) {
  const Vec3 half = normalized(p.toEye + lamp);
  return std::pow(std::max(0.0, dot(p.normal, half)), sharpness);
}

Light skin(const SurfacePoint& p, const Lamps& lamps) {
  const double key = dot(p.normal, lamps.key), fill = dot(p.normal, lamps.fill);
  // Red light travels further under the skin, into the shadow.
  const Light shadow = bent({p.lamp, p.lamp, p.lamp}, 0.75, 1, 1.1);
  // However deep a hollow, some light reaches it.
  Light light = withBounces(0.06 + 0.94 * p.sky, p.colour) * skyOver(p.normal);
  light += kKey * Light{wrapped(key, 0.34), wrapped(key, 0.2), wrapped(key, 0.15)} * shadow;
  light += kFill * (wrapped(fill, 0.5) * p.sky);
  const double grazing = std::pow(1 - std::clamp(dot(p.normal, p.toEye), 0.0, 1.0), 3);
  light += kRim * (wrapped(dot(p.normal, lamps.rim), 0.3) * p.sky);
  const double shine =
      p.lamp * (0.055 * highlight(p, lamps.key, 14) + 0.045 * highlight(p, lamps.key, 60)) +
      p.sky * grazing * (0.05 + 0.25 * std::max(0.0, dot(p.normal, lamps.rim)));
  return p.colour * light + kKey * shine;
}

/// White light only, and never a deep shadow.
Light matte(const SurfacePoint& p, const Lamps& lamps) {
  const double key = p.lamp * wrapped(dot(p.normal, lamps.key), 0.5);
  const double facing = std::clamp(dot(p.normal, p.toEye), 0.0, 1.0);
  return p.colour * (0.34 + 0.32 * p.sky + 0.32 * key + 0.12 * facing);
}

Light zebra(const SurfacePoint& p, double stripe) {
  const Light dark{0.03, 0.035, 0.05}, bright{0.93, 0.93, 0.92};
  const double form = 0.72 + 0.28 * std::clamp(dot(p.normal, p.toEye), 0.0, 1.0);
  return (stripe > 0 ? bright : dark) * form;
}

/// The sine of the reflected stripes, which run round the room from front to back.
double stripeOf(const SurfacePoint& p, const Lamps& lamps) {
  constexpr double stripes = 14;
  const Vec3 r = 2 * dot(p.normal, p.toEye) * p.normal - p.toEye;
  const Vec3 across = normalized(cross(lamps.key, Vec3{0, 1, 0}));
  return std::sin(stripes * std::acos(std::clamp(dot(r, across), -1.0, 1.0)));
}

/// Keeps highlights from clipping.
double shoulder(double x) {
  constexpr double knee = 0.75;
  return x <= knee ? x : knee + (1 - knee) * (1 - std::exp(-(x - knee) / (1 - knee)));
}

}  // namespace

Lamps::Lamps(const Camera& camera) {
  const auto at = [&](double right, double up, double back) {
    return normalized(right * camera.right + up * camera.up - back * camera.forward);
  };
  key = at(-0.62, 0.62, 0.75);
  fill = at(0.85, 0.05, 0.5);
  rim = at(0.75, 0.35, -0.65);
}

Light shade(Finish finish, const SurfacePoint& point, const Lamps& lamps) {
  if (!point.front) {
    const double facing = std::clamp(dot(point.normal, point.toEye), 0.0, 1.0);
    return kInside * (0.55 + 0.45 * facing);
  }
  if (finish == Finish::flat) return point.colour;
  if (finish == Finish::zebra) return zebra(point, stripeOf(point, lamps));
  const Light light = finish == Finish::skin ? skin(point, lamps) : matte(point, lamps);
  return {shoulder(light.r), shoulder(light.g), shoulder(light.b)};
}

}  // namespace sweepface
