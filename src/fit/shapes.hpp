#pragma once

#include "fit/solver.hpp"

namespace sweepface {

/// Gives ribbons shape parameters that bring the solution nearer to the source with its stored
/// vectors unchanged: candidates of the safe regime, tried ribbon by ribbon. Ribbons on which
/// T-nodes stand keep theirs. Returns how many ribbons changed.
Index chooseShapes(const Layout& layout, const Draft& draft, const SourceData& data,
                   const Solution& solution, std::vector<Shape>& ribbons);

}  // namespace sweepface
