#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sweepface {

/// Names in quotes, each with what is to be said of it, of which six are told at most: "'a'
/// (twice), 'b' (thrice) and 3 more"; empty if there is none.
std::string listed(const std::vector<std::pair<std::string, std::string>>& namesAndDetails);

}  // namespace sweepface
