#include <algorithm>
#include <utility>

#include "sweepface/drawing.hpp"

#include "rig/source_quads.hpp"

namespace sweepface {
namespace {

// The index of a material by its name, which is added if it is new.
Index numberOf(const std::string& name, Polygons& faces) {
  const auto found = std::ranges::find(faces.materials, name);
  const auto number = static_cast<Index>(found - faces.materials.begin());
  if (found == faces.materials.end()) faces.materials.push_back(name);
  return number;
}

// Gives all of the source's faces on a patch the material that the drawing gives the patch. `grid`
// is the source that build() made: its faces are the quads of the patches.
Result<void> takeMaterials(const Polygons& grid, const std::vector<Index>& faceOfQuad,
                           Polygons& faces) {
  if (grid.faceMaterial.empty()) return {};
  if (faceOfQuad.empty())
    return fail(
        "The drawing names materials, and the file whose source is to be kept does not say which "
        "of its faces lie on which patch; leave the materials out, or build without it.");
  faces.faceMaterial.resize(faces.faceCount(), -1);
  std::vector<Index> numbers;
  for (const std::string& name : grid.materials) numbers.push_back(numberOf(name, faces));
  for (std::size_t quad = 0; quad < faceOfQuad.size(); ++quad)
    if (const Index material = grid.faceMaterial[quad]; material >= 0)
      faces.faceMaterial[faceOfQuad[quad]] = numbers[material];
  return {};
}

// The name of the first thing that differs in the other wireframe.
std::string difference(const Rig& rig, const Wireframe& own, const Wireframe& other) {
  const auto firstOther = [](const auto& a, const auto& b) {
    return static_cast<Index>(std::ranges::mismatch(a, b).in1 - a.begin());
  };
  const Index arc = firstOther(own.arcs, other.arcs), node = firstOther(own.nodes, other.nodes);
  if (arc < std::ssize(own.arcs)) return "Curve '" + rig.nameOf(Thing::curve, arc) + "'";
  for (Index p = 0; p < std::ssize(own.patches); ++p)
    for (int s = 0; s < 4; ++s)
      if (p >= std::ssize(other.patches) || !std::ranges::equal(own.side(p, s), other.side(p, s)))
        return "Patch '" + rig.nameOf(Thing::patch, p) + "'";
  if (node < std::ssize(own.nodes)) return "Node '" + rig.nameOf(Thing::node, node) + "'";
  return "The number of nodes, curves or patches";
}

}  // namespace

Result<void> adoptSource(Rig& rig, const Rig& like) {
  Wireframe own = rig.surface.wireframe(), other = like.surface.wireframe();
  own.ribbons = other.ribbons = {};
  for (Wireframe* w : {&own, &other}) {
    for (Node& node : w->nodes) node.stored = kPosition;
    for (Arc& arc : w->arcs) arc.ribbon = 0;
  }
  if (own != other)
    return fail(
        difference(rig, own, other) +
        " is not as in the file whose source is to be kept: nodes, curves and patches must "
        "be the same, in the same order and directions; go on from what wireframe writes of "
        "that file, or build without it.");
  SourceMesh source = like.source;
  if (auto ok = takeMaterials(rig.source.polygons, faceOfQuads(like), source.polygons); !ok)
    return ok;
  rig.source = std::move(source);
  rig.scene = like.scene;
  for (Target& target : rig.targets) {
    const Index same = like.find(target.name);
    target.looseDifference = same >= 0 ? like.targets[same].looseDifference
                                       : std::vector<Vec3>(like.source.loose.size());
  }
  return {};
}

}  // namespace sweepface
