// Which ribbon a curve belongs to. Curves that must share their shape parameters are those of a
// side, those along which a patch sweeps, and those that run on at a node on a side.
#include <fmt/format.h>

#include "drawing/weave.hpp"
#include "surface/union_find.hpp"

namespace sweepface::drawing {

namespace {

UnionFind sharing(const Wireframe& w, const Connectivity& c) {
  UnionFind sets(static_cast<Index>(w.arcs.size()));
  const auto join = [&](HalfArc a, HalfArc b) { sets.join(arcOf(a), arcOf(b)); };
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p) {
    for (int s = 0; s < 4; ++s)
      for (HalfArc h : w.side(p, s)) join(w.side(p, s)[0], h);
    join(w.side(p, 0)[0], w.side(p, 2)[0]);
  }
  for (Index n = 0; n < static_cast<Index>(w.nodes.size()); ++n) {
    if (c.kinds[n] != NodeKind::hanging) continue;
    const auto& arms = c.stars[n].arms;
    for (int k = 0; k < 3; ++k)
      if (const int on = c.opposite(n, k); on >= 0) join(arms[k], arms[on]);
  }
  return sets;
}

}  // namespace

Result<void> chooseRibbons(const Drawing& d, Woven& woven) {
  Wireframe& w = woven.wireframe;
  w.ribbons.clear();
  for (const Drawing::Ribbon& ribbon : d.ribbons) w.ribbons.push_back(ribbon.shape);
  UnionFind sets = sharing(w, woven.connectivity);
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
