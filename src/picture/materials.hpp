#pragma once

#include <optional>
#include <string_view>

#include "sweepface/picture.hpp"

namespace sweepface {

/// The colour of a material, guessed from its name: "M_Teeth" is ivory, anything unknown is skin.
/// Nothing if it is clear, such as tears and corneas, or a sheet with lashes painted on.
std::optional<Colour> materialColour(std::string_view name);

/// The colour of every face of a mesh, guessed likewise [F].
std::vector<std::optional<Colour>> faceColours(const Polygons& polygons);

}  // namespace sweepface
