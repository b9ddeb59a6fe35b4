#pragma once

#include <utility>
#include <vector>

#include "gltf/affine.hpp"
#include "gltf/column.hpp"
#include "gltf/parts.hpp"

namespace sweepface::gltf {

/// The matrices of a skin that take its mesh to each joint: those in its file, or an identity for
/// each joint.
Result<std::vector<Affine>> inverseBindMatrices(const Document& document, std::size_t skin);

/// The accessors of joints and of weights of each set of four, from the attributes of a primitive.
std::vector<std::pair<std::size_t, std::size_t>> jointSets(const Json& attributes,
                                                           std::size_t accessors);

/// Matrices as accessors hold them, column by column.
Column packMatrices(const std::vector<Affine>& matrices);

/// Places each mesh where its skin shows it at rest: by the joint with most of its weight, of those
/// that do not flatten it. Meshes may be bound from anywhere: the steps of quantized ones are often
/// undone by the skin alone. A mesh that nodes show with several skins, or also without one, stays
/// where it is.
void placeBySkins(const Document& document, Parts& parts);

/// Makes skins start from where placeBySkins() placed their meshes, in a scene whose positions were
/// taken out to be replaced by the rig's. Marks in `touched` the views some of whose bytes are no
/// longer needed.
void bindWherePlaced(Document& document, const Parts& parts, std::vector<bool>& touched);

}  // namespace sweepface::gltf
