#include "sweepface/head.hpp"

#include <algorithm>
#include <cmath>

#include "sweepface/sweepface_head.h"

#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

namespace {

Angles anglesOf(const sweepface_angles& a) { return {a.yaw, a.pitch, a.roll}; }
bool isFinite(const sweepface_angles& a) {
  return std::isfinite(a.yaw) && std::isfinite(a.pitch) && std::isfinite(a.roll);
}

}  // namespace

void sweepface_rotation(const sweepface_angles* angles, double quaternion[4]) {
  if (angles && quaternion) std::ranges::copy(quaternionOf(anglesOf(*angles)), quaternion);
}

sweepface_status sweepface_rig_turn_eyes(sweepface_rig* rig, uint32_t* eyes) {
  if (!rig || !eyes) return refuse("Turning eyes needs a rig and a place for their number.");
  if (rig->following.eyes) return refuse("The eyes turn already.");
  if (rig->rig.use_count() > 1)
    return refuse(
        "Eyes must turn before a rig has meshes; free its meshes and faces, or load it again.");
  if (const auto status = needTargets(*rig->rig)) return status;
  if (static_cast<double>(rig->rig->surface.wireframe().quadCount()) > kMostVertices)
    return refuse("The face has too many vertices to look for eyes.");
  const std::vector<Eye> found = findEyes(*rig->rig);
  *eyes = static_cast<uint32_t>(found.size());
  if (found.empty()) return SWEEPFACE_OK;
  rig->following.eyes = std::make_shared<const EyeTurns>(EyeTurns::addTo(*rig->rig, found));
  rig->following.apply = followAll;
  divide(*rig, *rig->division);
  return SWEEPFACE_OK;
}

sweepface_status sweepface_face_look(sweepface_face* face, const sweepface_pose* pose) {
  if (!face) return refuse("Looking needs a face.");
  if (pose && (!isFinite(pose->left_eye) || !isFinite(pose->right_eye)))
    return refuse("The angles of eyes must be finite numbers.");
  face->looks.reset();
  if (pose) face->looks = {{}, anglesOf(pose->left_eye), anglesOf(pose->right_eye)};
  return SWEEPFACE_OK;
}
