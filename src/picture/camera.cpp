#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

#include "sweepface/picture.hpp"

namespace sweepface {
namespace {

/// A portrait lens: the height of the picture spans 19 degrees.
constexpr double kFocal = 3;

constexpr std::pair<std::string_view, View> kNamedViews[] = {
    {"front", {0, 0}}, {"side", {90, 0}}, {"three-quarter", {35, 6}}, {"back", {180, 0}}};

/// Parses all of a text as a finite number.
bool parseNumber(std::string_view text, double& number) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stop == end && std::isfinite(number);
}

}  // namespace

Result<View> parseView(std::string_view text) {
  for (const auto& [name, view] : kNamedViews)
    if (text == name) return view;
  const std::size_t comma = text.find(',');
  View view;
  if (comma != text.npos && parseNumber(text.substr(0, comma), view.azimuth) &&
      parseNumber(text.substr(comma + 1), view.elevation) && std::abs(view.elevation) <= 90 &&
      std::abs(view.azimuth) <= 360)
    return view;
  return fail(
      fmt::format("There is no view '{}'; give front, side, three-quarter, back, or "
                  "AZIMUTH,ELEVATION in degrees (up to 360 and 90).",
                  text));
}

Result<std::vector<View>> parseViews(std::string_view text) {
  std::vector<View> views;
  for (std::size_t at = 0; at <= text.size();) {
    std::size_t end = std::min(text.find(',', at), text.size());
    double number = 0;
    // A number is an azimuth; its elevation follows.
    if (parseNumber(text.substr(at, end - at), number) && end < text.size())
      end = std::min(text.find(',', end + 1), text.size());
    const Result<View> view = parseView(text.substr(at, end - at));
    if (!view) return std::unexpected(view.error());
    views.push_back(*view);
    at = end + 1;
  }
  return views;
}

std::string nameOf(const View& view) {
  for (const auto& [name, named] : kNamedViews)
    if (view == named) return std::string(name);
  return fmt::format("{}°, {}°", view.azimuth, view.elevation);
}

Vec3 Camera::project(const Vec3& p, PictureSize size) const {
  const Vec3 d = p - eye;
  const double distance = dot(d, forward), scale = focal * size.height / distance;
  return {0.5 * size.width + scale * dot(d, right), 0.5 * size.height - scale * dot(d, up),
          distance};
}

Camera frameCamera(std::span<const Vec3> points, const View& view, PictureSize size,
                   double margin) {
  constexpr double degree = std::numbers::pi / 180;
  const double a = view.azimuth * degree, e = view.elevation * degree;
  Camera camera;
  camera.right = {std::cos(a), 0, -std::sin(a)};
  camera.forward = {-std::sin(a) * std::cos(e), -std::sin(e), -std::cos(a) * std::cos(e)};
  camera.up = cross(camera.right, camera.forward);
  camera.focal = kFocal;
  // A point is inside if |x - x0| <= (z + back) tan: each side of the picture is a plane that the
  // points push outwards from the eye.
  const double tanY = (0.5 - margin) / kFocal, tanX = tanY * size.width / size.height;
  double left = -1e300, right = -1e300, bottom = -1e300, top = -1e300;
  for (const Vec3& p : points) {
    const double x = dot(p, camera.right), y = dot(p, camera.up), z = dot(p, camera.forward);
    left = std::max(left, -x - z * tanX);
    right = std::max(right, x - z * tanX);
    bottom = std::max(bottom, -y - z * tanY);
    top = std::max(top, y - z * tanY);
  }
  if (points.empty()) left = right = bottom = top = 1;
  const double back = std::max((left + right) / (2 * tanX), (bottom + top) / (2 * tanY));
  camera.eye = 0.5 * (right - left) * camera.right + 0.5 * (top - bottom) * camera.up -
               back * camera.forward;
  return camera;
}

std::vector<Camera> frameCameras(std::span<const Vec3> points, std::span<const View> views,
                                 PictureSize size, double margin) {
  Vec3 middle;
  for (const Vec3& p : points) middle += p;
  if (!points.empty()) middle *= 1 / static_cast<double>(points.size());
  std::vector<Camera> cameras;
  double furthest = 0;
  const auto distance = [&](const Camera& c) { return dot(middle - c.eye, c.forward); };
  for (const View& view : views) {
    cameras.push_back(frameCamera(points, view, size, margin));
    furthest = std::max(furthest, distance(cameras.back()));
  }
  for (Camera& c : cameras) c.eye -= (furthest - distance(c)) * c.forward;
  return cameras;
}

}  // namespace sweepface
