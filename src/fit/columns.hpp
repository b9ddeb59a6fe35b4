#pragma once

#include <array>
#include <vector>

#include "sweepface/eval.hpp"

#include "codec/hierarchy.hpp"

namespace sweepface {

/// The effect of a step of each coefficient on the vertices of level 1, as sparse columns and rows.
struct Columns {
  std::vector<Index> start;  ///< [S + 1]
  std::vector<Index> vertex;
  /// For a step of 1: how far it moves the vertex and changes the tangents along u and v there.
  std::vector<std::array<float, 3>> weight;
  /// The transpose: the coefficients that move a vertex, and how far.
  std::vector<Index> rowStart;  ///< [vertices + 1]
  std::vector<Index> rowVector;
  std::vector<float> rowWeight;

  Index length(Index vector) const { return start[vector + 1] - start[vector]; }
};

/// `inStored` is every vector as a combination of stored ones (surface/terms.hpp). Uses all cores;
/// memory and time grow with the number of coefficients that move each vertex, about 150.
Columns columnsOf(const Surface& surface, const Tessellation& grid,
                  const codec::Prediction& prediction,
                  const std::vector<std::vector<Term>>& inStored);

}  // namespace sweepface
