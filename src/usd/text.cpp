#include "usd/text.hpp"

#include <fmt/format.h>
#include <iterator>
#include <utility>

#include "usd/values.hpp"

namespace sweepface::usd {

void Text::open(std::string_view type, std::string_view name, Lines metadata) {
  separate();
  fmt::format_to(std::back_inserter(text_), "{}def {} {}", indent(), type, inQuotes(name));
  addMetadata(metadata);
  fmt::format_to(std::back_inserter(text_), "\n{}{{\n", indent());
  ++depth_;
}

void Text::close() {
  --depth_;
  text_ += indent() + "}\n";
}

void Text::set(std::string_view property, std::string_view value, Lines metadata) {
  fmt::format_to(std::back_inserter(text_), "{}{} = {}", indent(), property, value);
  addMetadata(metadata);
  text_ += '\n';
}

void Text::declare(std::string_view property) {
  fmt::format_to(std::back_inserter(text_), "{}{}\n", indent(), property);
}

void Text::openSamples(std::string_view property) {
  fmt::format_to(std::back_inserter(text_), "{}{}.timeSamples = {{\n", indent(), property);
  ++depth_;
}

void Text::addSample(std::string_view time, std::string_view value) {
  fmt::format_to(std::back_inserter(text_), "{}{}: {},\n", indent(), time, value);
}

void Text::append(Text&& prims) {
  separate();
  text_ += std::exchange(prims.text_, {});  // large: there is no room for all of it twice
}

/// Adds an empty line before a prim that is not the first thing in another.
void Text::separate() {
  if (!text_.empty() && !text_.ends_with("{\n")) text_ += '\n';
}

void Text::addMetadata(Lines metadata) {
  if (metadata.size() == 0) return;
  text_ += " (\n";
  for (const std::string_view line : metadata)
    fmt::format_to(std::back_inserter(text_), "{}    {}\n", indent(), line);
  text_ += indent() + ')';
}

}  // namespace sweepface::usd
