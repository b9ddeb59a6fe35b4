#pragma once

#include <optional>
#include <string_view>

namespace sweepface {

/// The decimal number that all of a text spells, with a point in every locale; no infinity and
/// nothing that is no number.
std::optional<double> numberOf(std::string_view text);

/// A text without the blanks around it.
std::string_view trimmed(std::string_view text);

/// Cuts what stands before the next comma off a list, and the blanks around it.
std::string_view takeItem(std::string_view& list);

}  // namespace sweepface
