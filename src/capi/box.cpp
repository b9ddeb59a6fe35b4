#ifndef __wasm__  // left out to keep the module small
#include "capi/handles.hpp"
#include "capi/message.hpp"

using namespace sweepface;
using namespace sweepface::capi;

const PoseBox& Mesh::poseBox(bool moving) const {
  Late<PoseBox>& box = moving ? movingBox : neutralBox;
  std::call_once(box.once, [&] { box.made.emplace(moving ? positions() : neutral); });
  return *box.made;
}

sweepface_status sweepface_face_box(sweepface_face* face, double low[3], double high[3]) {
  if (!face || !low || !high) return refuse("A box needs a face and places for its corners.");
  const Weights& weights = follow(*face);
  const Box box = face->mesh->poseBox(!isNeutral(weights)).of(weights);
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = box.isEmpty() ? 0 : coordinate(box.low, axis);
    high[axis] = box.isEmpty() ? 0 : coordinate(box.high, axis);
  }
  return SWEEPFACE_OK;
}
#endif
