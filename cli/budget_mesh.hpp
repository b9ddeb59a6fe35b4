#pragma once

#include <string>

#include "sweepface/eval.hpp"

namespace sweepface::cli {

/// An expression at the level of detail that a budget asks for: an OBJ text, and its size.
struct BudgetMesh {
  std::string obj;
  Index vertices = 0, triangles = 0;
  Index cutMost = 0;  ///< curves cut as finely as possible that may still be too coarse
};
Result<BudgetMesh> meshWithin(const Rig& rig, const Budget& budget,
                              std::span<const double> weights);

}  // namespace sweepface::cli
