#include "drawing/naming.hpp"

#include <fmt/format.h>
#include <map>

#include "drawing/weave.hpp"

namespace sweepface::drawing {
namespace {

template <typename Things>
void keep(const Rig& rig, Thing kind, const Things& things, std::vector<std::string>& names) {
  std::vector<std::string> own;
  bool any = false;
  for (const auto& thing : things) {
    const auto index = static_cast<Index>(own.size());
    const bool plain = thing.name == rig.nameOf(kind, index);
    own.push_back(plain ? "" : thing.name);
    any |= !own.back().empty();
  }
  if (any) names = std::move(own);
}

// A thing without a name goes by its letter and number, which no other thing may be named.
template <typename Things>
Result<void> check(const Drawing& drawing, const Rig& rig, Thing kind, const Things& things,
                   const std::vector<std::string>& names) {
  std::map<std::string, const TextPlace*> places;
  for (const auto& thing : things) places.emplace(thing.name, &thing.place);
  for (std::size_t k = 0; k < names.size(); ++k)
    if (const std::string called = rig.nameOf(kind, static_cast<Index>(k));
        names[k].empty() && places.contains(called) &&
        (k >= things.size() || things[k].name != called))
      return failAt(
          drawing, *places.at(called),
          fmt::format("'{}' is what number {}, which has no name, goes by; choose another", called,
                      k));
  return {};
}

}  // namespace

Result<void> nameThings(const Drawing& d, Rig& rig) {
  Names& names = rig.names;
  names.units = d.units;
  keep(rig, Thing::node, d.nodes, names.nodes);
  keep(rig, Thing::curve, d.curves, names.curves);
  keep(rig, Thing::patch, d.patches, names.patches);
  keep(rig, Thing::ribbon, d.ribbons, names.ribbons);
  if (!names.ribbons.empty()) names.ribbons.resize(rig.surface.wireframe().ribbons.size());
  if (auto ok = check(d, rig, Thing::patch, d.patches, names.patches); !ok) return ok;
  return check(d, rig, Thing::ribbon, d.ribbons, names.ribbons);
}

}  // namespace sweepface::drawing
