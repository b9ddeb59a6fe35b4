#pragma once

#include <cmath>
#include <numbers>

#include "sweepface/fit.hpp"
#include "sweepface/picture.hpp"

#include "faces.hpp"

// Handmade scenes, and helpers that inspect pictures.
namespace sweepface::testing {

inline constexpr Colour kRed{0.8f, 0.1f, 0.1f}, kGreen{0.1f, 0.7f, 0.2f}, kBlue{0.1f, 0.2f, 0.8f};

/// A triangulated sphere, fine enough to count as round.
inline Scene sphere(double radius = 1, const Vec3& centre = {}) {
  constexpr Index around = 128, rings = 64;
  Scene scene;
  for (Index j = 0; j <= rings; ++j)
    for (Index i = 0; i < around; ++i) {
      const double a = turn(1.0 * i / around), b = std::numbers::pi * j / rings;
      const Vec3 n{std::sin(b) * std::sin(a), std::cos(b), std::sin(b) * std::cos(a)};
      scene.positions.push_back(centre + radius * n);
      scene.normals.push_back(n);
    }
  for (Index j = 0; j < rings; ++j)
    for (Index i = 0; i < around; ++i) {
      const Index a = j * around + i, b = j * around + (i + 1) % around;
      scene.triangles.push_back({a, a + around, b + around});
      scene.triangles.push_back({a, b + around, b});
    }
  scene.finish = Finish::flat;
  scene.colour = kRed;
  return scene;
}

/// Adds a square that faces +z.
inline void addSquare(Scene& scene, const Vec3& centre, double half, const Colour& colour) {
  const auto first = static_cast<Index>(scene.positions.size());
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    scene.positions.push_back(centre + Vec3{x * half, y * half, 0});
    scene.normals.push_back({0, 0, 1});
    scene.vertexColours.push_back(colour);
  }
  scene.triangles.push_back({first, first + 1, first + 2});
  scene.triangles.push_back({first, first + 2, first + 3});
}

inline Scene squares() {
  Scene scene;
  scene.finish = Finish::flat;
  return scene;
}

/// A camera on the z axis, by default 10 in front of the origin.
inline Camera before(double distance = 10) {
  return {{0, 0, distance}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 3};
}

/// Whether two colours are equal up to the rounding of 8-bit channels.
inline bool near(const Colour& a, const Colour& b, double bytes = 1.01) {
  const auto close = [&](float x, float y) { return std::abs(x - y) <= bytes / 255; };
  return close(a.r, b.r) && close(a.g, b.g) && close(a.b, b.b);
}

inline Image picture(Scene scene, const Camera& camera = before(), PictureSize size = {200, 200}) {
  Result<Image> image = render(std::move(scene), camera, size);
  EXPECT_TRUE(image.has_value()) << (image ? "" : image.error().message);
  return image ? std::move(*image) : Image::filled(size, {});
}

/// How many pixels of a part of an image are near a colour.
inline int countNear(const Image& image, const Colour& colour, Index top = 0, double bytes = 1.01) {
  int count = 0;
  for (Index y = top; y < image.height; ++y)
    for (Index x = 0; x < image.width; ++x) count += near(image.at(x, y), colour, bytes);
  return count;
}

inline double brightness(const Colour& c) { return 0.3 * c.r + 0.6 * c.g + 0.1 * c.b; }

inline Rig converted(const MeshRig& source, double tolerance = 0.02) {
  ConvertOptions options;
  options.tolerance = tolerance;
  Result<Conversion> conversion = convert(source, options);
  EXPECT_TRUE(conversion.has_value()) << (conversion ? "" : conversion.error().message);
  return std::move(conversion.value().rig);
}

}  // namespace sweepface::testing
