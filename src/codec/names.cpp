#include "codec/names.hpp"

#include <set>

#include "codec/blocks.hpp"
#include "codec/utf8.hpp"

namespace sweepface::codec {

namespace {

std::vector<std::string> readList(Reader& in, std::size_t things) {
  std::vector<std::string> names = readTexts(in, "names");
  if (!names.empty() && names.size() != things) in.refuse("there are too many or too few names");
  std::set<std::string_view> seen;
  for (const std::string& name : names) {
    if (!isUtf8(name)) in.refuse("a name is not UTF-8");
    if (!name.empty() && !seen.insert(name).second)
      in.refuse("there are two things named '" + name + "'");
  }
  return names;
}

}  // namespace

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
