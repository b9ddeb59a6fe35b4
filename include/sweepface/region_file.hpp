#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sweepface/regions.hpp"

namespace sweepface {

/// A region as its JSON form paints it (docs/regions.md).
struct PaintedRegion {
  std::string name;
  Matter matter;
  Brush brush;
  int bands = 1;  ///< above 1: this many regions, name1, name2 ..., delayed in equal steps up to
                  ///< `delay`
};

/// The `regions` of a JSON text, which may be a timeline or a capture; none if it has no such
/// member.
Result<std::vector<PaintedRegion>> parseRegions(std::string_view text, std::string_view name);

/// The regions of a face, the rest first.
Result<std::vector<Region>> paintRegions(const Rig& rig, const std::vector<PaintedRegion>& painted);

}  // namespace sweepface
