#pragma once

#include "sweepface/mesh.hpp"

namespace sweepface {

/// Fails where there is no surface to fit, or what a file cannot hold.
Result<void> checkSource(const MeshRig& source);

/// The largest coordinate, and the most that single precision is off of one.
struct Reach {
  double away = 0, off = 0;
  void include(const Vec3& v);
};
/// Of what faces use.
Reach reachOf(const PolygonMesh& mesh);

/// Fails where single precision tells places or ways less finely than the tolerance.
Result<void> checkPrecision(const MeshRig& source, double tolerance);

/// Fails where an option, which messages call `what`, is no number from 0.
Result<void> checkFromZero(double value, std::string_view what);

/// Fails where texture coordinates cannot be packed to so many bits.
Result<void> checkTextureBits(int bits);

}  // namespace sweepface
