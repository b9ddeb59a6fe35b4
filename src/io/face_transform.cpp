#include "io/face_transform.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace sweepface::io {

namespace {

using Json = nlohmann::json;

/// The numbers of a matrix of 4 × 4, row after row or column after column as they stand; or none.
std::optional<std::array<double, 16>> numbersOf(const Json& list) {
  std::array<double, 16> numbers{};
  std::size_t count = 0;
  const auto take = [&](const Json& number) {
    if (!number.is_number() || count == numbers.size()) return false;
    numbers[count] = number.get<double>();
    return std::isfinite(numbers[count++]);
  };
  for (const Json& item : list) {
    const bool isRow = item.is_array() && item.size() == 4;
    if (isRow ? !std::ranges::all_of(item, take) : !take(item)) return {};
  }
  if (count != numbers.size()) return {};
  return numbers;
}

struct Columns {
  Vec3 x, y, z;
};

std::optional<Columns> columnsOf(const Json& matrix) {
  const bool isObject = matrix.is_object() && matrix.contains("data");
  const Json& list = isObject ? matrix["data"] : matrix;
  if (!list.is_array() || list.size() != (isObject ? 16 : 4)) return {};
  const auto m = numbersOf(list);
  if (!m) return {};
  const std::size_t down = isObject ? 1 : 4, across = isObject ? 4 : 1;
  const auto column = [&](std::size_t c) {
    return Vec3{(*m)[c * across], (*m)[c * across + down], (*m)[c * across + 2 * down]};
  };
  return Columns{column(0), column(1), column(2)};
}

/// The angles of Ry · Rx · Rz, with columns of any length.
std::optional<Angles> anglesOf(const Columns& turned) {
  const double x = norm(turned.x), y = norm(turned.y), z = norm(turned.z);
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
