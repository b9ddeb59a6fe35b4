#include "fit/listed.hpp"

#include "io/text.hpp"

namespace sweepface {

std::string listed(const std::vector<std::pair<std::string, std::string>>& namesAndDetails) {
  std::vector<std::string> texts;
  for (const auto& [name, detail] : namesAndDetails) texts.push_back(io::inQuotes(name) + detail);
  return io::fewOf(texts, 6);
}

}  // namespace sweepface
