#pragma once

#include <span>
#include <string>

#include "sweepface/mesh.hpp"

#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// A sentence about normals of a file that a face cannot keep, as its surface has one of its own at
/// each place: vertices of one place with normals far apart, as with flat shading and sharp edges,
/// or else normals far from those of the triangles, as where they were made for shading or the
/// triangles look inwards. Empty if there are hardly any. `rig` is that of the parts, `places` the
/// result of weld() for it.
std::string lostNormals(const Document& document, const Parts& parts, const MeshRig& rig,
                        std::span<const Index> places);

}  // namespace sweepface::gltf
