#pragma once

#include <utility>
#include <vector>

#include "gltf/affine.hpp"
#include "gltf/column.hpp"
#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// The matrices of a skin that take its mesh to each joint: those that its file has, or as many
/// unit matrices as it has joints.
Result<std::vector<Affine>> inverseBindMatrices(const Document& document, std::size_t skin);

/// The accessors of joints and of weights of each set of four, from the attributes of a primitive.
std::vector<std::pair<std::size_t, std::size_t>> jointSets(const Json& attributes,
                                                           std::size_t accessors);

/// As accessors hold them, column after column.
Column packMatrices(const std::vector<Affine>& matrices);

/// Places each mesh where its skin shows it at rest: by the joint on which most of it hangs, of
/// those that do not flatten it. Meshes may be bound from anywhere: quantized ones often have their
/// steps undone by the skin alone. One that nodes show with several skins, or without one too,
/// stays as it stands.
void placeBySkins(const Document& document, Parts& parts);

/// Lets skins begin where meshes were placed by them: in a scene from which positions are taken, to
/// be filled with the rig's. Marks the views of which bytes are needed no longer, `touched`.
void bindWherePlaced(Document& document, const Parts& parts, std::vector<bool>& touched);

}  // namespace sweepface::gltf
