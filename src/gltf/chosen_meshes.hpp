#pragma once

#include <span>
#include <string>
#include <vector>

#include "gltf/document.hpp"

namespace sweepface::gltf {

// Which meshes are the face may be a choice. It stands in the document itself, in an extension of
// its root, {"SWEEPFACE_face": {"meshes": [0, 2]}}: so the scene that is made of a source has the
// same parts as the source.

/// [meshes] whether each was chosen; empty if there was no choice.
Result<std::vector<bool>> chosenMeshes(const Document& document);

/// Chooses the meshes that nodes of these names show; or else meshes of these names; or else what
/// nodes below those of these names show; or else meshes of these numbers.
Result<void> chooseByName(Document& document, std::span<const std::string> names);

/// If the scene that viewers show has some of these meshes, but not all, chooses those that it has.
/// Returns the others, which are then not part of the face.
std::vector<std::size_t> chooseShown(Document& document, std::span<const std::size_t> meshes);

/// Removes the choice: it means nothing to other programs.
void forgetChoice(Json& gltf);

}  // namespace sweepface::gltf
