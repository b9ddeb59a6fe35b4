#include "sweepface/edit.hpp"

#include <map>

#include "edit/affected.hpp"
#include "edit/checks.hpp"
#include "edit/rest.hpp"
#include "surface/stored_jets.hpp"

namespace sweepface {

using edit::Affected;
using edit::checkIndex;

Result<Patches> setShape(Rig& rig, Index ribbon, const Shape& shape) {
  if (auto ok = checkIndex(ribbon, rig.surface.wireframe().ribbons.size(), "ribbon"); !ok)
    return std::unexpected(ok.error());
  if (auto ok = edit::checkWhole(rig); !ok) return std::unexpected(ok.error());
  Wireframe wireframe = rig.surface.wireframe();
  if (wireframe.ribbons[ribbon] == shape) return Patches{};
  wireframe.ribbons[ribbon] = shape;
  auto surface = Surface::make(std::move(wireframe));
  if (!surface) {
    const std::string& why = surface.error().message;
    const std::size_t colon = why.find(": ");
    return fail("Ribbon '" + rig.nameOf(Thing::ribbon, ribbon) +
                "' cannot have these parameters: " +
                why.substr(colon == std::string::npos ? 0 : colon + 2));
  }
  rig.surface = std::move(*surface);
  Affected affected(rig.surface);
  affected.addRibbon(ribbon);
  return affected.patches();
}

namespace {

std::vector<Vec3>& poseOf(Rig& rig, Index target) {
  return target < 0 ? rig.neutral : rig.targets[target].difference;
}

Result<void> check(const Rig& rig, const NodeMove& move) {
  if (auto ok = checkIndex(move.node, rig.surface.wireframe().nodes.size(), "node"); !ok) return ok;
  const auto refused = [&](const char* why) {
    return fail("Node '" + rig.nameOf(Thing::node, move.node) + "' " + why);
  };
  if (rig.surface.connectivity().kinds[move.node] == NodeKind::hanging)
    return refused("stands on the side of a patch and goes with it; move the curve there.");
  if (!isFinite(move.by)) return refused("cannot move by what is not finite.");
  return {};
}

}  // namespace

Result<Patches> moveNodes(Rig& rig, std::span<const NodeMove> moves, Index target) {
  if (target >= 0)
    if (auto ok = checkIndex(target, rig.targets.size(), "target"); !ok)
      return std::unexpected(ok.error());
  if (auto ok = edit::checkWhole(rig); !ok) return std::unexpected(ok.error());
  // Several nodes may share one point, which moves once and takes all of them along.
  const Wireframe& w = rig.surface.wireframe();
  std::map<Index, NodeMove> ofPoint;
  for (const NodeMove& move : moves) {
    if (auto ok = check(rig, move); !ok) return std::unexpected(ok.error());
    const auto [place, isNew] = ofPoint.try_emplace(w.nodes[move.node].point, move);
    if (!isNew && place->second.by != move.by)
      return fail("Nodes '" + rig.nameOf(Thing::node, place->second.node) + "' and '" +
                  rig.nameOf(Thing::node, move.node) +
                  "' are one point and cannot move to different places.");
  }
  std::erase_if(ofPoint, [](const auto& move) { return move.second.by == Vec3{}; });
  if (ofPoint.empty()) return Patches{};
  if (target < 0) edit::keepRest(rig);
  const StoredJets jets(rig.surface);
  std::map<Index, Vec3> ofStored;
  for (Index n = 0; n < static_cast<Index>(w.nodes.size()); ++n)
    if (const auto move = ofPoint.find(w.nodes[n].point); move != ofPoint.end())
      ofStored.insert_or_assign(jets.at(n, 0), move->second.by);
  Affected affected(rig.surface);
  for (const auto& [stored, by] : ofStored) {
    poseOf(rig, target)[stored] += by;
    affected.addVector(stored);
  }
  return affected.patches();
}

Result<std::vector<Index>> endsOf(const Rig& rig, Index curve) {
  if (auto ok = checkIndex(curve, rig.surface.wireframe().arcs.size(), "curve"); !ok)
    return std::unexpected(ok.error());
  const Connectivity& c = rig.surface.connectivity();
  std::vector<Index> ends;
  for (HalfArc h : {2 * curve + 1, 2 * curve}) {
    const Index node = rig.surface.wireframe().end(c.rails[h].last);
    if (c.kinds[node] == NodeKind::hanging)
      return fail("Curve '" + rig.nameOf(Thing::curve, curve) + "' ends at node '" +
                  rig.nameOf(Thing::node, node) +
                  "', which stands on the side of a patch and goes with it; move the curve there.");
    ends.push_back(node);
  }
  return ends;
}

}  // namespace sweepface
