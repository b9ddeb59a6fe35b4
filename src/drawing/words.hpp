#pragma once

#include <array>
#include <string_view>

#include "codec/utf8.hpp"

// The words of the format (docs/wire-format.md).
namespace sweepface::drawing {

inline constexpr std::string_view kFormat = "sweepface wireframe 1";

/// The derivatives of a jet: ∂x^i ∂y^j at index 3i + j.
inline constexpr std::array<std::string_view, 9> kJetWords{"",    "y",  "yy",  "x",   "xy",
                                                           "xyy", "xx", "xxy", "xxyy"};

/// Whether a text can be a name, in messages and in the file.
inline bool isName(std::string_view text) { return !text.empty() && codec::isUtf8(text); }

}  // namespace sweepface::drawing
