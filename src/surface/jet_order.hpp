#pragma once

#include "sweepface/result.hpp"

#include "surface/jet_numbers.hpp"
#include "surface/jet_rows.hpp"
#include "surface/jets.hpp"

namespace sweepface {

/// Puts vectors into an order in which every row needs only earlier ones: the stored first, then
/// the derived as soon as all they need is there (Kahn 1962). Fails where rows run in a circle, as
/// `buildJets` says. The corners of the table are left empty; `place` receives the place of every
/// numbered vector.
Result<JetTable> orderJets(const JetNumbers& numbers, const JetRows& rows,
                           const Connectivity& connectivity, std::vector<Index>& place,
                           std::vector<Index>* circle);

}  // namespace sweepface
