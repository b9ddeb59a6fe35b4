#pragma once

#include "gltf/fill.hpp"

namespace sweepface::gltf {

/// Chooses cubes around the vertices of every mesh that has parts, large enough for every target's
/// differences as well (KHR_mesh_quantization).
std::vector<Encoding> chooseEncodings(const BoundScene& scene, const MorphShapes& shapes,
                                      const Places& places);

/// Makes the nodes and skins that show quantized meshes undo the encoding. Fails if one cannot.
Result<void> undoEncodings(BoundScene& scene, const std::vector<Encoding>& encodings,
                           Builder& builder);

}  // namespace sweepface::gltf
