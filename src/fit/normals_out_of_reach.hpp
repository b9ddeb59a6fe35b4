#pragma once

#include <string_view>

namespace sweepface {

/// How the sentence begins that says that the tolerance for normals, and nothing else, was not met.
inline constexpr std::string_view kNormalsOutOfReach = "normals came no nearer to the mesh's than";

}  // namespace sweepface
