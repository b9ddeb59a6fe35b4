#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "sweepface/vec.hpp"

// Values as they stand in a USD layer. Numbers have single precision and as few digits as tell them
// apart.
namespace sweepface::usd {

/// Bytes beyond ASCII become U+FFFD if the text is not UTF-8.
std::string inQuotes(std::string_view text);
std::string number(double value);
std::string tuple(std::span<const double> numbers);
inline std::string tuple(const Vec3& v) { return tuple(std::array{v.x, v.y, v.z}); }

std::string list(std::span<const std::string> texts);
std::string list(std::span<const Index> numbers);
std::string list(std::span<const double> numbers);
std::string list(std::span<const Vec2> points);
std::string list(std::span<const Vec3> points);

}  // namespace sweepface::usd
