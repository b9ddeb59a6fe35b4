#pragma once

#include <string_view>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// The lines of a letter: y runs up from the baseline, capitals are 20 high.
struct Glyph {
  double width = 0;
  std::vector<std::vector<Vec2>> lines;
};

inline constexpr double kCapitalHeight = 20, kLetterGap = 5.2;

/// The letter of a code point; a box for what the font lacks.
const Glyph& glyphOf(char32_t letter);

/// The code points of a UTF-8 text; bytes that are none become U+FFFD.
std::vector<char32_t> codePoints(std::string_view text);

}  // namespace sweepface
