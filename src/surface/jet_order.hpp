#pragma once

#include "sweepface/result.hpp"

#include "surface/jet_numbers.hpp"
#include "surface/jet_rows.hpp"
#include "surface/jets.hpp"

namespace sweepface {

/// Sorts the vectors topologically, so that every row needs only earlier ones: the stored ones
/// first, then each derived one once all that it needs is there (Kahn 1962). Fails if rows form a
/// cycle, as documented at `buildJets`. Leaves the corners of the table empty; `place` receives the
/// position of every numbered vector.
Result<JetTable> orderJets(const JetNumbers& numbers, const JetRows& rows,
                           const Connectivity& connectivity, std::vector<Index>& place,
                           std::vector<Index>* circle);

}  // namespace sweepface
