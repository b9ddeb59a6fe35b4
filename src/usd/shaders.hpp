#pragma once

#include <string>
#include <vector>

#include "usd/looks.hpp"
#include "usd/text.hpp"

namespace sweepface::usd {

/// Adds the shaders of a material to its prim at `path`: the surface `shader`, and what reads its
/// maps.
void addShaders(Text& text, const std::string& path, const Look& look,
                const std::vector<Image>& images);

}  // namespace sweepface::usd
