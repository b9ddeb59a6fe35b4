#pragma once

#include <vector>

#include "gltf/affine.hpp"
#include "gltf/column.hpp"
#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// The matrices of a skin that take its mesh to each joint: those that its file has, or as many
/// unit matrices as it has joints.
Result<std::vector<Affine>> inverseBindMatrices(const Document& document, std::size_t skin);

Column packMatrices(const std::vector<Affine>& matrices);

/// Places meshes where their skins show them at rest. They may be bound from anywhere: quantized
/// ones often have their steps undone by the skin alone. Where joints have turned away from where
/// the mesh was bound, so that no one place is that of all, it stays as it stands unless it is of
/// another size; then the first joint places it.
void placeBySkins(const Document& document, Parts& parts);

/// Lets skins begin where meshes were placed by them: in a scene from which positions are taken, to
/// be filled with the rig's. Marks the views of which bytes are needed no longer, `touched`.
void bindWherePlaced(Document& document, const Parts& parts, std::vector<bool>& touched);

}  // namespace sweepface::gltf
