#include "fit/listed.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "io/text.hpp"

namespace sweepface {

std::string listed(const std::vector<std::pair<std::string, std::string>>& namesAndDetails) {
  constexpr std::size_t most = 6;
  const std::size_t count = namesAndDetails.size();
  std::string list;
  for (std::size_t k = 0; k < std::min(count, most); ++k)
    list += (k ? ", " : "") + io::inQuotes(namesAndDetails[k].first) + namesAndDetails[k].second;
  return count <= most ? list : fmt::format("{} and {} more", list, count - most);
}

}  // namespace sweepface
