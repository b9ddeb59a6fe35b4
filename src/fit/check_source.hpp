#pragma once

#include "sweepface/mesh.hpp"

namespace sweepface {

/// Fails where there is no surface to fit, or what a file cannot hold.
Result<void> checkSource(const MeshRig& source);

}  // namespace sweepface
