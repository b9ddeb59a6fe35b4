#pragma once

#include <string_view>
#include <vector>

#include "sweepface/result.hpp"
#include "sweepface/vec.hpp"

namespace sweepface::io {

/// What a rig needs of a target's file.
struct TargetShape {
  std::vector<Vec3> positions;
  Index faceCount = 0;  ///< 0 where the file has positions alone
};

Result<TargetShape> parseObjTarget(std::string_view text, std::string_view name);
Result<TargetShape> parsePlyTarget(std::string_view bytes, std::string_view name);

}  // namespace sweepface::io
