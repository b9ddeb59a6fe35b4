#pragma once

#include "sweepface/mesh.hpp"

namespace sweepface {

/// Fails where there is no surface to fit, or what a file cannot hold.
Result<void> checkSource(const MeshRig& source);

/// Fails where single precision tells places or ways less finely than the tolerance.
Result<void> checkPrecision(const MeshRig& source, double tolerance);

}  // namespace sweepface
