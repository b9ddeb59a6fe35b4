#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sweepface {

/// Names in quotes, each followed by its detail, six of them at most: "'a' (twice), 'b' (thrice)
/// and 3 more"; empty if there are none.
std::string listed(const std::vector<std::pair<std::string, std::string>>& namesAndDetails);

}  // namespace sweepface
