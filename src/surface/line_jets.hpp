#pragma once

#include "surface/basis_table.hpp"
#include "surface/jet_numbers.hpp"
#include "surface/jet_rows.hpp"

namespace sweepface {

/// What crossings do not store: each component from the polynomial along one line through the node
/// that takes the values of its neighbours and what the node itself stores (docs/wireframe.md).
void predictCrossings(const Wireframe& wireframe, const Connectivity& connectivity,
                      const JetNumbers& numbers, JetRows& rows);

/// The jets of T-nodes: those of the curve and the cross-derivative curves of the rail on which
/// they hang, which the sub-patches' own curves continue because ρ, η, λ are given per unit length.
void hangNodes(const Wireframe& wireframe, const Connectivity& connectivity,
               const BasisTable& bases, const JetNumbers& numbers, JetRows& rows);

}  // namespace sweepface
