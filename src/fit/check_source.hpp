#pragma once

#include <string_view>

#include "sweepface/mesh.hpp"

namespace sweepface {

/// Fails if there is no surface to fit, or if a file cannot hold the source.
Result<void> checkSource(const MeshRig& source);

/// The largest absolute coordinate, and the largest error of one in single precision.
struct Reach {
  double away = 0, off = 0;
  void include(const Vec3& v);
};
/// The reach of the vertices that faces use.
Reach reachOf(const PolygonMesh& mesh);

/// Fails if single precision resolves positions or movements less finely than the tolerance.
Result<void> checkPrecision(const MeshRig& source, double tolerance);

/// Fails unless an option, which messages call `what`, is finite and not negative.
Result<void> checkFromZero(double value, std::string_view what);

/// Fails if texture coordinates cannot be packed to this many bits.
Result<void> checkTextureBits(int bits);

/// The beginning of the error message for a conversion that met the tolerance for distances but not
/// the one for normals: a smaller one for distances may meet both.
inline constexpr std::string_view kNormalsOutOfReach = "normals came no nearer to the mesh's than";

}  // namespace sweepface
