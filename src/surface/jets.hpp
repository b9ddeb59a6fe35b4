#pragma once

#include "sweepface/surface.hpp"

#include "surface/basis_table.hpp"

namespace sweepface {

/// Every vector of a model and how the derived ones follow from the stored ones.
struct JetTable {
  std::vector<StoredVector> stored;
  std::vector<Index> rowStart{
      0};  ///< rows of the derived vectors, in an order that can be evaluated
  std::vector<Term> terms;
  std::vector<JetRef> corners;  ///< [patches × 4 × 9], index 3i + j: ∂α^i ∂β^j
};

/// Works out the jets of all corners of all patches: stored, predicted, from charts and of T-nodes.
/// Fails if the derivations form a cycle; `circle`, if given, then receives one node of each cycle
/// that could break it by storing its whole jet (or, a T-node, by becoming a crossing).
Result<JetTable> buildJets(const Wireframe& wireframe, const Connectivity& connectivity,
                           const BasisTable& bases, std::vector<Index>* circle = nullptr);

}  // namespace sweepface
