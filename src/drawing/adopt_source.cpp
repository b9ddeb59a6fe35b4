#include "sweepface/drawing.hpp"

namespace sweepface {

Result<void> adoptSource(Rig& rig, const Rig& like) {
  Wireframe own = rig.surface.wireframe(), other = like.surface.wireframe();
  own.ribbons = other.ribbons = {};
  for (Wireframe* w : {&own, &other}) {
    for (Node& node : w->nodes) node.stored = kPosition;
    for (Arc& arc : w->arcs) arc.ribbon = 0;
  }
  if (own != other)
    return fail(
        "The curves or patches are others than those of the file whose source is to be "
        "kept; build without it.");
  rig.source = like.source;
  rig.scene = like.scene;
  for (Target& target : rig.targets) {
    const Index same = like.find(target.name);
    target.looseDifference = same >= 0 ? like.targets[same].looseDifference
                                       : std::vector<Vec3>(like.source.loose.size());
  }
  return {};
}

}  // namespace sweepface
