#pragma once

#include <string_view>

namespace sweepface {

/// The beginning of the error message for a conversion that met the tolerance for distances but not
/// the one for normals: a smaller one for distances may meet both.
inline constexpr std::string_view kNormalsOutOfReach = "normals came no nearer to the mesh's than";

}  // namespace sweepface
