#include "drawing/jet_axes.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "drawing/frames.hpp"
#include "surface/wireframe_checks.hpp"

namespace sweepface::drawing {

namespace {

Result<void> checkJetCount(const Drawing& d, const Woven& woven, Index n) {
  const auto given = d.nodes[n].jets.size();
  const auto fans = std::max<std::size_t>(1, woven.connectivity.fans[n].size());
  if (given == 0 || given == fans) return {};
  return failAt(d, d.nodes[n].place,
                fmt::format("node '{}' has {} jets and needs {}; only creases that meet cut a "
                            "node into parts with a jet each",
                            d.nodes[n].name, given, fans));
}

/// Makes a crossing store the derivatives that its jet gives.
Result<std::array<Turned, 9>> storeGiven(const Drawing& d, Woven& woven, Index n) {
  const Drawing::Jet& jet = d.nodes[n].jets[0];
  const auto quarter = placeInStar(woven.connectivity, n, woven.halfArc(jet.along));
  if (!quarter) return leavesNot(d, n, 0);
  std::array<Turned, 9> axes;
  JetMask& stored = woven.wireframe.nodes[n].stored;
  for (int k = 0; k < 9; ++k) {
    axes[k] = turned(*quarter, k / 3, k % 3);
    if (k > 0 && jet.vectors[k]) stored |= static_cast<JetMask>(1 << axes[k].component);
  }
  if (isClosed(stored)) return axes;
  return failAt(d, d.nodes[n].place,
                fmt::format("the jet of node '{}' has a derivative without those before it: "
                            "xx needs x, xy needs x and y",
                            d.nodes[n].name));
}

}  // namespace

Result<JetAxes> chooseStored(const Drawing& d, Woven& woven) {
  JetAxes axes(d.nodes.size());
  for (Index n = 0; n < static_cast<Index>(d.nodes.size()); ++n) {
    if (auto ok = checkJetCount(d, woven, n); !ok) return std::unexpected(ok.error());
    if (woven.connectivity.kinds[n] != NodeKind::crossing) continue;
    if (d.nodes[n].jets.empty()) {
      woven.wireframe.nodes[n].stored = kWholeJet;
      continue;
    }
    const auto given = storeGiven(d, woven, n);
    if (!given) return std::unexpected(given.error());
    axes[n] = *given;
  }
  return axes;
}

std::unexpected<Error> leavesNot(const Drawing& d, Index n, std::size_t jet) {
  return failAt(d, d.nodes[n].place,
                fmt::format("a jet of node '{}' runs along '{}', which is no curve that leaves "
                            "it so; a '-' stands before a curve that arrives",
                            d.nodes[n].name, d.nodes[n].jets[jet].along));
}

}  // namespace sweepface::drawing
