#pragma once

#include "fit/source_data.hpp"
#include "layout/layout.hpp"

namespace sweepface {

/// Cuts a patch of a layout where that promises most: along one line, or along two if the poses are
/// about as far from parabolas in both directions. False if the patch is too small.
bool splitPatch(Layout& layout, const GridPatch& grid, const SourceData& data);

}  // namespace sweepface
