#pragma once

#include <optional>
#include <string_view>

#include "sweepface/picture.hpp"

namespace sweepface {

/// What a material looks like, judged by its name: "M_Teeth" is ivory, whatever is not known is
/// skin. Nothing where it is clear, such as tears and corneas, or a sheet with lashes painted on.
std::optional<Colour> materialColour(std::string_view name);

/// The colour of every face of a mesh, likewise [F].
std::vector<std::optional<Colour>> faceColours(const Polygons& polygons);

}  // namespace sweepface
