#include "io/face_transform.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace sweepface::io {

namespace {

using Json = nlohmann::json;

/// Appends the numbers of a list of so many; false if it is anything else.
bool takeNumbers(const Json& list, std::size_t count, std::vector<double>& numbers) {
  if (!list.is_array() || list.size() != count) return false;
  for (const Json& item : list) {
    if (!item.is_number() || !std::isfinite(item.get<double>())) return false;
    numbers.push_back(item.get<double>());
  }
  return true;
}

struct Columns {
  Vec3 x, y, z;
};

std::optional<Columns> columnsOf(const Json& matrix) {
  std::vector<double> m;
  const auto data = matrix.is_object() ? matrix.find("data") : matrix.end();
  const bool isObject = data != matrix.end();
  if (isObject ? !takeNumbers(*data, 16, m)
               : !matrix.is_array() || matrix.size() != 4 ||
                     !std::ranges::all_of(matrix,
                                          [&](const Json& row) { return takeNumbers(row, 4, m); }))
    return {};
  const std::size_t down = isObject ? 1 : 4, across = isObject ? 4 : 1;
  const auto column = [&](std::size_t c) {
    return Vec3{m[c * across], m[c * across + down], m[c * across + 2 * down]};
  };
  return Columns{column(0), column(1), column(2)};
}

/// The angles of Ry · Rx · Rz, with columns of any length.
std::optional<Angles> anglesOf(const Columns& turned) {
  const auto length = [](const Vec3& v) { return std::hypot(v.x, v.y, v.z); };
  const double x = length(turned.x), y = length(turned.y), z = length(turned.z);
  if (!(x > 0 && y > 0 && z > 0)) return {};
  return Angles{.yaw = std::atan2(turned.z.x, turned.z.z),
                .pitch = std::asin(std::clamp(-turned.z.y / z, -1.0, 1.0)),
                .roll = std::atan2(turned.x.y / x, turned.y.y / y)};
}

}  // namespace

FaceTransform faceTransformOf(const Json& frame) {
  for (const char* key : {"facialTransformationMatrixes", "facial_transformation_matrixes"}) {
    const auto matrices = frame.find(key);
    if (matrices == frame.end() || matrices->is_null()) continue;
    if (!matrices->is_array()) return {.isBroken = true};
    if (matrices->empty()) return {};
    const auto columns = columnsOf((*matrices)[0]);
    const auto angles = columns ? anglesOf(*columns) : std::nullopt;
    if (!angles) return {.isBroken = true};
    return {betweenHands(*angles), false};
  }
  return {};
}

}  // namespace sweepface::io
