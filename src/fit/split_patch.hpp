#pragma once

#include "fit/source_data.hpp"
#include "layout/layout.hpp"

namespace sweepface {

/// Cuts a patch of a layout where that promises most: along one line, or along two where the poses
/// are as far from parabolas both ways. False if it is too small.
bool splitPatch(Layout& layout, const GridPatch& grid, const SourceData& data);

}  // namespace sweepface
