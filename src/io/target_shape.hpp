#pragma once

#include <string_view>
#include <vector>

#include "sweepface/result.hpp"
#include "sweepface/vec.hpp"

namespace sweepface::io {

/// What a rig needs from a target's file.
struct TargetShape {
  std::vector<Vec3> positions;
  Index faceCount = 0;  ///< 0 if the file has only positions
};

Result<TargetShape> parseObjTarget(std::string_view text, std::string_view name);
Result<TargetShape> parsePlyTarget(std::string_view bytes, std::string_view name);

}  // namespace sweepface::io
