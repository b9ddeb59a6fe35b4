#include "picture/occlusion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "parallel/parallel.hpp"

namespace sweepface {
namespace {

constexpr int kSkyDirections = 192, kLampDirections = 24;

/// Directions spread evenly over the sphere (a Fibonacci lattice).
std::vector<Vec3> sphere(int count) {
  std::vector<Vec3> directions;
  for (int k = 0; k < count; ++k) {
    const double y = 1 - (2.0 * k + 1) / count, r = std::sqrt(1 - y * y);
    const double turn = 2 * std::numbers::pi * (2 - std::numbers::phi) * k;
    directions.push_back({r * std::cos(turn), y, r * std::sin(turn)});
  }
  return directions;
}

/// Directions spread evenly over a disc around one (Vogel's spiral).
std::vector<Vec3> disc(int count, const Vec3& centre, double radius) {
  const Vec3 beside = std::abs(centre.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Vec3 x = normalized(cross(beside, centre)), y = cross(centre, x);
  std::vector<Vec3> directions;
  for (int k = 0; k < count; ++k) {
    const double r = std::tan(radius) * std::sqrt((k + 0.5) / count);
    const double turn = 2 * std::numbers::pi * (2 - std::numbers::phi) * k;
    directions.push_back(normalized(centre + r * std::cos(turn) * x + r * std::sin(turn) * y));
  }
  return directions;
}

/// The light from some directions, and how much of it arrives at a vertex.
struct Arrival {
  double all = 0, arrived = 0;
  int above = 0;  ///< directions above the vertex's horizon
};

/// Computes how much light arrives at every vertex, and returns what `answer` makes of it.
std::vector<float> exposure(const Obstacles& obstacles, std::span<const Vec3> positions,
                            std::span<const Vec3> normals, const std::vector<Vec3>& directions,
                            auto brightness, auto answer, const std::atomic<bool>* cancel) {
  const double near = 1e-3 * obstacles.size(), far = 2 * obstacles.size();
  std::vector<float> result(positions.size());
  parallelFor(std::size_t{0}, positions.size(), [&](std::size_t v) {
    if (isCancelled(cancel)) return;
    Arrival light;
    for (const Vec3& d : directions) {
      const double slope = dot(normals[v], d);
      if (slope <= 0) continue;
      ++light.above;
      light.all += slope * brightness(d);
      if (!obstacles.blocks(positions[v], d, near, far)) light.arrived += slope * brightness(d);
    }
    result[v] = static_cast<float>(answer(v, light));
  });
  return result;
}

}  // namespace

std::vector<float> skyExposure(const Obstacles& obstacles, std::span<const Vec3> positions,
                               std::span<const Vec3> normals, const std::atomic<bool>* cancel) {
  // Brighter above than below, where light is reflected by the ground.
  const auto brightness = [](const Vec3& direction) { return 0.65 + 0.35 * direction.y; };
  return exposure(
      obstacles, positions, normals, sphere(kSkyDirections), brightness,
      [](std::size_t, const Arrival& a) { return a.all > 0 ? a.arrived / a.all : 1; }, cancel);
}

std::vector<float> lampExposure(const Obstacles& obstacles, std::span<const Vec3> positions,
                                std::span<const Vec3> normals, const Vec3& towards, double radius,
                                std::span<const float> sky, const std::atomic<bool>* cancel) {
  return exposure(
      obstacles, positions, normals, disc(kLampDirections, towards, radius),
      [](const Vec3&) { return 1.0; },
      [&](std::size_t v, const Arrival& a) {
        const double above = static_cast<double>(a.above) / kLampDirections;
        return (1 - above) * sky[v] + (a.all > 0 ? above * a.arrived / a.all : 0);
      },
      cancel);
}

}  // namespace sweepface
