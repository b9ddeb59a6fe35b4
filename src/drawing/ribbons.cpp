// Chooses the ribbon that each curve belongs to. Curves must share their shape parameters if they
// are on one side, if a patch sweeps along both, or if one continues the other at a node on a side.
#include <fmt/format.h>

#include "codec/wireframe_rules.hpp"
#include "drawing/weave.hpp"

namespace sweepface::drawing {

namespace {

UnionFind sharing(const Wireframe& w) {
  UnionFind sets(w.arcs.size());
  codec::joinRails(w, sets);
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p)
    sets.join(arcOf(w.side(p, 0)[0]), arcOf(w.side(p, 2)[0]));
  return sets;
}

}  // namespace

Result<void> chooseRibbons(const Drawing& d, Woven& woven) {
  Wireframe& w = woven.wireframe;
  w.ribbons.clear();
  for (const Drawing::Ribbon& ribbon : d.ribbons) w.ribbons.push_back(ribbon.shape);
  UnionFind sets = sharing(w);
  std::vector<Index> speaker(w.arcs.size(), -1), ribbonOf(w.arcs.size(), -1);  // [sets]
  for (Index a = 0; a < static_cast<Index>(w.arcs.size()); ++a) {
    const Drawing::Curve& curve = d.curves[a];
    if (curve.ribbon.empty()) continue;
    const auto named = woven.ribbons.find(curve.ribbon);
    if (named == woven.ribbons.end())
      return failAt(
          d, curve.place,
          fmt::format("curve '{}' belongs to '{}', which is no ribbon", curve.name, curve.ribbon));
    const Index set = sets.find(a);
    if (speaker[set] >= 0 && ribbonOf[set] != named->second)
      return failAt(d, curve.place,
                    fmt::format("curve '{}' belongs to ribbon '{}' and curve '{}' to '{}', but "
                                "patches sweep along both: the first and third side of a patch "
                                "are of one ribbon",
                                curve.name, curve.ribbon, d.curves[speaker[set]].name,
                                d.curves[speaker[set]].ribbon));
    speaker[set] = a;
    ribbonOf[set] = named->second;
  }
  for (Index a = 0; a < static_cast<Index>(w.arcs.size()); ++a) {
    Index& ribbon = ribbonOf[sets.find(a)];
    if (ribbon < 0) {
      ribbon = static_cast<Index>(w.ribbons.size());
      w.ribbons.emplace_back();
    }
    w.arcs[a].ribbon = ribbon;
  }
  return {};
}

}  // namespace sweepface::drawing
