#pragma once

#include <string_view>

namespace sweepface {

/// How the sentence begins that says that the tolerance for distances could be met, but not the one
/// for normals: a smaller one may bring both.
inline constexpr std::string_view kNormalsOutOfReach = "normals came no nearer to the mesh's than";

}  // namespace sweepface
