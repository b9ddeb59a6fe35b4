#pragma once

#include <string_view>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// The strokes of a letter: y runs up from the baseline, capitals are 20 high.
struct Glyph {
  double width = 0;
  std::vector<std::vector<Vec2>> lines;
};

inline constexpr double kCapitalHeight = 20, kLetterGap = 5.2;

/// The glyph of a code point; a box if the font lacks it.
const Glyph& glyphOf(char32_t letter);

/// The code points of a UTF-8 text; invalid bytes become U+FFFD.
std::vector<char32_t> codePoints(std::string_view text);

}  // namespace sweepface
