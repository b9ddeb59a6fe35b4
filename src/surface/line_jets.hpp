#pragma once

#include "surface/basis_table.hpp"
#include "surface/jet_numbers.hpp"
#include "surface/jet_rows.hpp"

namespace sweepface {

/// Predicts what crossings do not store: each component from the polynomial along one line through
/// the node that interpolates its neighbours' values and what the node itself stores
/// (docs/wireframe.md).
void predictCrossings(const Wireframe& wireframe, const Connectivity& connectivity,
                      const JetNumbers& numbers, JetRows& rows);

/// Derives the jets of T-nodes from the curve and the cross-derivative curves of the rail on which
/// they hang. The sub-patches' own curves run along these because ρ, η, λ are given per unit
/// length.
void hangNodes(const Wireframe& wireframe, const Connectivity& connectivity,
               const BasisTable& bases, const JetNumbers& numbers, JetRows& rows);

}  // namespace sweepface
