#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sweepface/eval.hpp"

namespace sweepface {

/// A connected component of a tessellation: its vertices.
using Part = std::vector<Index>;
std::vector<Part> partsOf(const Tessellation& grid);

struct Ball {
  Vec3 centre;
  double radius = 0;
};

/// The ball on whose surface the points lie, if they cover most of it.
std::optional<Ball> ballOf(std::span<const Vec3> points);

}  // namespace sweepface
