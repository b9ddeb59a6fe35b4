// Surfaces of wireframes that are not known to be consistent.
#include <algorithm>
#include <cstdint>
#include <limits>

#include "sweepface/surface.hpp"

#include "surface/wireframe_checks.hpp"

namespace sweepface {

namespace {

// Checks what Connectivity takes for granted.
Result<void> checkLists(const Wireframe& w) {
  for (std::size_t n = 0; n < w.nodes.size(); ++n)
    if (!isClosed(w.nodes[n].stored))
      return fail("node ", n, " stores a derivative without those before it");
  std::int64_t edges = 0;
  for (const Arc& arc : w.arcs) edges += std::max<Index>(0, arc.edges);
  if (edges > std::numeric_limits<Index>::max())
    return fail("the arcs are too long, together ", edges, " edges");
  Index begin = 0;
  for (std::size_t p = 0; p < w.patches.size(); ++p) {
    const auto& sides = w.patches[p].sides;
    if (sides[0] != begin) return fail("patch ", p, " does not begin where the one before it ends");
    begin = sides[4];
    if (begin - sides[0] > kMostArcsAround)
      return fail("patch ", p, " has more than ", kMostArcsAround, " arcs around it; divide it");
  }
  if (begin != static_cast<Index>(w.loops.size())) return fail("the loops go on after all patches");
  return {};
}

}  // namespace

Result<Surface> Surface::make(Wireframe wireframe, std::vector<Index>* circle) {
  if (auto ok = checkLists(wireframe); !ok) return std::unexpected(ok.error());
  auto connectivity = Connectivity::make(wireframe);
  if (!connectivity) return std::unexpected(connectivity.error());
  if (const Index arc = idleArc(wireframe); arc >= 0) return fail("arc ", arc, " bounds no patch");
  return make(std::move(wireframe), std::move(*connectivity), circle);
}

}  // namespace sweepface
