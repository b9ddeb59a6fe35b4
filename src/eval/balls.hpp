#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sweepface/eval.hpp"

namespace sweepface {

/// Vertices of a tessellation that hang together.
using Part = std::vector<Index>;
std::vector<Part> partsOf(const Tessellation& grid);

struct Ball {
  Vec3 centre;
  double radius = 0;
};

/// The ball that points lie on, if they are most of one.
std::optional<Ball> ballOf(std::span<const Vec3> points);

}  // namespace sweepface
