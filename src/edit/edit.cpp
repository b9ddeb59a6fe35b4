#include "sweepface/edit.hpp"

#include "edit/affected.hpp"
#include "edit/rest.hpp"
#include "surface/stored_jets.hpp"

namespace sweepface {

using edit::Affected;

Result<Patches> setShape(Rig& rig, Index ribbon, const Shape& shape) {
  Wireframe wireframe = rig.surface.wireframe();
  wireframe.ribbons[ribbon] = shape;
  auto surface = Surface::make(std::move(wireframe));
  if (!surface) {
    const std::string& why = surface.error().message;
    const std::size_t colon = why.find(": ");
    return fail("Ribbon '" + rig.nameOf(Thing::ribbon, ribbon) +
                "' cannot have these parameters. " +
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

}  // namespace

Result<Patches> moveNodes(Rig& rig, std::span<const NodeMove> moves, Index target) {
  const StoredJets jets(rig.surface);
  for (const NodeMove& move : moves)
    if (rig.surface.connectivity().kinds[move.node] == NodeKind::hanging)
      return fail("Node '" + rig.nameOf(Thing::node, move.node) +
                  "' stands on the side of a patch and goes with it; move the curve there.");
  if (target < 0) edit::keepRest(rig);
  Affected affected(rig.surface);
  for (const NodeMove& move : moves) {
    const Index stored = jets.at(move.node, 0);
    poseOf(rig, target)[stored] += move.by;
    affected.addVector(stored);
  }
  return affected.patches();
}

Result<std::vector<Index>> endsOf(const Rig& rig, Index curve) {
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
