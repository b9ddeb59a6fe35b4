#pragma once

#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface {

/// Numbers the vertices at nodes: one for each point, however many nodes share it, and one for each
/// T-node.
struct VertexNumbers {
  explicit VertexNumbers(const Wireframe& wireframe);

  std::vector<Index> ofNode;  ///< [nodes]
  Index count = 0;
};

}  // namespace sweepface
