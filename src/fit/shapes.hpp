#pragma once

#include "fit/solver.hpp"

namespace sweepface {

/// Shape parameters for every ribbon that fit the solution better than those it has, the stored
/// vectors being what they are: candidates of the safe regime, tried ribbon by ribbon. Ribbons on
/// which T-nodes stand keep theirs. Returns how many ribbons changed.
Index chooseShapes(const Layout& layout, const Draft& draft, const SourceData& data,
                   const Solution& solution, std::vector<Shape>& ribbons);

}  // namespace sweepface
