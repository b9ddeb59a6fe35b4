#include <algorithm>
#include <array>

#include "sweepface/rig.hpp"

namespace sweepface {

namespace {

struct Kind {
  char letter;
  const char* word;
  std::vector<std::string> Names::* list;
};
constexpr std::array<Kind, 4> kKinds{{{'n', "node", &Names::nodes},
                                      {'c', "curve", &Names::curves},
                                      {'p', "patch", &Names::patches},
                                      {'r', "ribbon", &Names::ribbons}}};

const Kind& kindOf(Thing thing) { return kKinds[static_cast<std::size_t>(thing)]; }

std::size_t count(const Wireframe& w, Thing thing) {
  switch (thing) {
    case Thing::node:
      return w.nodes.size();
    case Thing::curve:
      return w.arcs.size();
    case Thing::patch:
      return w.patches.size();
    default:
      return w.ribbons.size();
  }
}

/// The number that the whole text spells if it is below `end`, else -1.
Index toIndex(std::string_view digits, std::size_t end) {
  if (digits.empty() || digits.size() > 9) return -1;
  Index number = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') return -1;
    number = 10 * number + (c - '0');
  }
  return static_cast<std::size_t>(number) < end ? number : -1;
}

}  // namespace

std::string Rig::nameOf(Thing thing, Index index) const {
  const Kind& kind = kindOf(thing);
  const auto& list = names.*kind.list;
  const auto k = static_cast<std::size_t>(index);
  if (k < list.size() && !list[k].empty()) return list[k];
  return kind.letter + std::to_string(index);
}

Result<Index> Rig::find(Thing thing, std::string_view name) const {
  const Kind& kind = kindOf(thing);
  const auto& list = names.*kind.list;
  const auto found = std::ranges::find(list, name);
  if (!name.empty() && found != list.end()) return static_cast<Index>(found - list.begin());
  const std::size_t size = count(surface.wireframe(), thing);
  const std::string_view digits = name.starts_with(kind.letter) ? name.substr(1) : name;
  if (const Index index = toIndex(digits, size); index >= 0) return index;
  const std::string word = kind.word;
  return fail("There is no ", word, " named '", name, "'; ",
              (size == 0 ? "this face has none."
                         : "there are " + std::to_string(size) + ", '" + nameOf(thing, 0) +
                               "' to '" + nameOf(thing, static_cast<Index>(size) - 1) +
                               "' (`sweepface info --list` shows them)."));
}

}  // namespace sweepface
