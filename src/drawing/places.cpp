// Error messages about places in a drawing.
#include <algorithm>
#include <cctype>
#include <fmt/format.h>

#include "drawing/weave.hpp"
#include "io/text.hpp"

namespace sweepface::drawing {

namespace {

struct Spoken {
  std::string name;
  TextPlace place;
};

// The drawing's name for what the surface calls `word` and a number; empty if that means something
// else.
Spoken spoken(const Drawing& d, const Wireframe& w, std::string_view word, std::size_t number) {
  const auto named = [number](const char* kind, const auto& things) -> Spoken {
    if (number >= things.size()) return {};
    return {fmt::format("{} '{}'", kind, things[number].name), things[number].place};
  };
  if (word == "node" || word == "T-node") return named("node", d.nodes);
  if (word == "arc") return named("curve", d.curves);
  if (word == "patch") return named("patch", d.patches);
  if (word == "ribbon" && number < d.ribbons.size()) return named("ribbon", d.ribbons);
  // A ribbon that the drawing does not name is identified by its first curve.
  if (word == "ribbon")
    for (std::size_t a = 0; a < w.arcs.size() && a < d.curves.size(); ++a)
      if (w.arcs[a].ribbon == static_cast<Index>(number))
        return {fmt::format("the ribbon of curve '{}'", d.curves[a].name), d.curves[a].place};
  return {};
}

}  // namespace

std::unexpected<Error> failAt(const Drawing& d, const TextPlace& place, const std::string& what) {
  const std::string source = d.source.empty() ? "The drawing" : d.source;
  if (place.line == 0) return fail(fmt::format("{}: {}.", source, what));
  return fail(fmt::format("{}, line {}, column {}: {}.", source, place.line, place.column, what));
}

std::unexpected<Error> failNamed(const Drawing& d, const Wireframe& w, const std::string& message) {
  std::string text;
  TextPlace first;
  for (std::size_t at = 0; at < message.size();) {
    const std::size_t end = std::min(message.find(' ', at), message.size());
    const std::string_view word(message.data() + at, end - at);
    std::size_t digits = end + 1, number = 0;
    while (digits < message.size() && std::isdigit(static_cast<unsigned char>(message[digits])) &&
           digits < end + 10)
      number = 10 * number + static_cast<std::size_t>(message[digits++] - '0');
    const Spoken thing = digits > end + 1 ? spoken(d, w, word, number) : Spoken{};
    if (thing.name.empty()) {
      text.append(message, at, end + 1 - at);
      at = end + 1;
      continue;
    }
    if (first.line == 0) first = thing.place;
    text += thing.name;
    at = digits;
  }
  return failAt(d, first, io::withoutPeriod(text));
}

}  // namespace sweepface::drawing
