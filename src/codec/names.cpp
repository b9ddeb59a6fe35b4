#include "codec/names.hpp"

#include <algorithm>
#include <span>

#include "sweepface/result.hpp"

#include "codec/blocks.hpp"
#include "codec/utf8.hpp"
#include "surface/sorting.hpp"

namespace sweepface::codec {

namespace {

std::vector<std::string> readList(Reader& in, std::size_t things) {
  std::vector<std::string> names = readTexts(in, "names");
  if (!names.empty() && names.size() != things) in.refuse("there are too many or too few names");
  for (const std::string& name : names)
    if (!isUtf8(name)) in.refuse("a name is not UTF-8");
  refuseTwins(in, {names.begin(), names.end()}, "things");
  return names;
}

}  // namespace

void refuseTwins(Reader& in, std::vector<std::string_view> names, const char* what) {
  sortSmall(std::span(names));
  const auto twin = std::ranges::adjacent_find(
      names, [](std::string_view a, std::string_view b) { return a == b && !a.empty(); });
  if (twin != names.end()) in.refuseWith({"there are two ", what, " named '", *twin, "'"});
}

bool hasNames(const Names& names) { return names != Names{}; }

void writeNames(Writer& out, const Names& names) {
  out.text(names.units);
  for (const auto* list : {&names.nodes, &names.curves, &names.patches, &names.ribbons})
    writeTexts(out, *list);
}

Names readNames(Reader& in, const Wireframe& w) {
  Names names;
  names.units = in.text();
  if (!isUtf8(names.units)) in.refuse("the units are not UTF-8");
  names.nodes = readList(in, w.nodes.size());
  names.curves = readList(in, w.arcs.size());
  names.patches = readList(in, w.patches.size());
  names.ribbons = readList(in, w.ribbons.size());
  return names;
}

}  // namespace sweepface::codec
