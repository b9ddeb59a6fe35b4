#include "drawing/told_jets.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <string>

#include "drawing/frames.hpp"
#include "drawing/words.hpp"

namespace sweepface::drawing {

ToldJets::ToldJets(const Drawing& drawing, const Woven& woven, const Surface& plain, JetAxes axes)
    : d_(drawing),
      woven_(woven),
      plain_(plain),
      jets_(plain),
      axes_(std::move(axes)),
      diagonal_(diagonalOf(drawing)),
      isTold_(plain.storedCount(), false),
      poses_(1 + drawing.expressions.size(), Pose(plain.storedCount())) {}

TextPlace ToldJets::placeIn(std::size_t pose, Index n) const {
  return pose == 0 ? d_.nodes[n].place : d_.expressions[pose - 1].place;
}

bool ToldJets::isSame(const Vec3& a, const Vec3& b) const {
  return norm(a - b) <= 1e-6 * std::max(norm(b), diagonal_);
}

void ToldJets::set(std::size_t pose, Index node, int component, const Vec3& value, int fan) {
  const Index v = jets_.at(node, component, fan);
  poses_[pose][v] = value;
  isTold_[v] = true;
}

Result<void> ToldJets::tellNeutral(Index n, std::size_t f) {
  if (auto ok = checkComplete(n, f); !ok) return ok;
  return tell(0, n, f, d_.nodes[n].jets[f].vectors);
}

Result<void> ToldJets::checkComplete(Index n, std::size_t f) const {
  if (kind(n) == NodeKind::crossing) return {};
  const Drawing::Node& node = d_.nodes[n];
  const auto fan = fanOf(n, f);
  if (!fan) return leavesNot(d_, n, f);
  for (std::size_t other = 0; other < f; ++other)
    if (fanOf(n, other) == fan)
      return failAt(d_, node.place,
                    fmt::format("two jets of node '{}' are of the part along '{}'", node.name,
                                node.jets[f].along));
  std::string needed, unknown;
  for (int k = 1; k < 9; ++k) {
    const std::string word = fmt::format(" {}", kJetWords[static_cast<std::size_t>(k)]);
    const bool stored = jets_.at(n, k, *fan) >= 0;
    if (stored && !node.jets[f].vectors[k]) needed += word;
    if (!stored && kind(n) == NodeKind::irregular && node.jets[f].vectors[k]) unknown += word;
  }
  if (!needed.empty())
    return failAt(d_, node.place,
                  fmt::format("the jet of node '{}' along '{}' lacks{}", node.name,
                              node.jets[f].along, needed));
  if (!unknown.empty())
    return failAt(d_, node.place,
                  fmt::format("other than four patches meet at node '{}', so that its jet has no{}",
                              node.name, unknown));
  return {};
}

// The fan of a creased node that a jet belongs to; 0 at other nodes. None if no fan begins at its
// curve.
std::optional<int> ToldJets::fanOf(Index n, std::size_t f) const {
  if (kind(n) != NodeKind::creased) return 0;
  const auto place = placeInStar(woven_.connectivity, n, armOf(d_.nodes[n].jets[f]));
  const auto& fans = woven_.connectivity.fans[n];
  const int arms = static_cast<int>(woven_.connectivity.stars[n].arms.size());
  for (std::size_t k = 0; place && k < fans.size(); ++k)
    if (fans[k].first % arms == *place) return static_cast<int>(k);
  return std::nullopt;
}

Result<void> ToldJets::tell(std::size_t pose, Index n, std::size_t f, const Derivatives& given) {
  if (kind(n) == NodeKind::irregular) return tellIrregular(pose, n, given);
  const int fan = fanOf(n, f).value_or(0);
  for (int k = 1; k < 9; ++k) {
    const Turned axis = kind(n) == NodeKind::crossing ? axes_[n][k] : Turned{k, 1};
    if (!given[k]) continue;
    if (jets_.at(n, axis.component, fan) >= 0)
      set(pose, n, axis.component, axis.sign * *given[k], fan);
    else if (kind(n) == NodeKind::creased && woven_.connectivity.fans[n][fan].regular)
      repeated_.push_back({pose, n, f, k, *given[k]});
  }
  return {};
}

Result<void> ToldJets::tellIrregular(std::size_t pose, Index n, const Derivatives& given) {
  const auto angle = angleAt(n);
  if (!angle) return leavesNot(d_, n, 0);
  Jet jet{};
  for (int k = 1; k < 9; ++k) jet[k] = given[k].value_or(Vec3{});
  jet = turnedJet(jet, *angle);
  for (int k = 1; k < 9; ++k) {
    const Index v = jets_.at(n, k);
    if (v < 0) continue;
    const auto [told, isFirst] = irregular_.try_emplace({pose, v}, n);
    if (!isFirst && !isSame(poses_[pose][v], jet[k]))
      return failAt(d_, placeIn(pose, n),
                    fmt::format("nodes '{}' and '{}' are one point and their jets say different "
                                "things of it; give it one jet",
                                d_.nodes[told->second].name, d_.nodes[n].name));
    set(pose, n, k, jet[k], 0);
  }
  return {};
}

// The angle in the chart of the x axis of an irregular node's jet; none if its curve leaves none of
// the nodes at the point.
std::optional<double> ToldJets::angleAt(Index n) const {
  const HalfArc arm = armOf(d_.nodes[n].jets[0]);
  if (arm < 0 || woven_.wireframe.arcs[arcOf(arm)].collapsed) return std::nullopt;
  const Index start = woven_.wireframe.start(arm);
  if (kind(start) != NodeKind::irregular || jets_.home(start) != jets_.home(n)) return std::nullopt;
  return chartAngle(plain_, jets_, n, arm);
}

Result<void> ToldJets::checkRepeated() const {
  std::vector<Vec3> vectors(plain_.vectorCount());
  std::size_t settled = poses_.size();
  for (const Repeated& r : repeated_) {
    if (r.pose != settled) plain_.settle(poses_[settled = r.pose], vectors);
    const Index v = jetVector(plain_, jets_, r.node, r.component, *fanOf(r.node, r.jet));
    if (isSame(vectors[v], r.value)) continue;
    const Drawing::Node& node = d_.nodes[r.node];
    return failAt(d_, placeIn(r.pose, r.node),
                  fmt::format("the jet of node '{}' along '{}' has its '{}' from the part of the "
                              "node before it, which says another; change it there, too",
                              node.name, node.jets[r.jet].along,
                              kJetWords[static_cast<std::size_t>(r.component)]));
  }
  return {};
}

}  // namespace sweepface::drawing
