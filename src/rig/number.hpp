#pragma once

#include <optional>
#include <string_view>

namespace sweepface {

/// The finite decimal number that the whole text spells, with a decimal point in every locale;
/// empty if it spells none.
std::optional<double> numberOf(std::string_view text);

/// A text without leading and trailing blanks.
std::string_view trimmed(std::string_view text);

/// Removes the first item of a comma-separated list and returns it, trimmed.
std::string_view takeItem(std::string_view& list);

}  // namespace sweepface
