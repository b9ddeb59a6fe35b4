#pragma once

#include <memory>
#include <vector>

#include "sweepface/evaluator.hpp"
#include "sweepface/followers.hpp"
#include "sweepface/live_motion.hpp"
#include "sweepface/render_mesh.hpp"
#include "sweepface/sweepface.h"

// What the handles of the C interface stand for. Rigs and meshes are shared by what is made from
// them.

struct sweepface_rig {
  std::shared_ptr<const sweepface::Rig> rig;
  sweepface::Followers followers;  // of its targets; those that were added for them are not shown
  std::size_t shown = 0;           // targets, the first ones
};

namespace sweepface::capi {

struct Mesh {
  std::shared_ptr<const Rig> rig;
  Followers followers;
  std::size_t shown;
  Evaluator evaluator;
  RenderMesh render;
};

}  // namespace sweepface::capi

struct sweepface_mesh {
  std::shared_ptr<const sweepface::capi::Mesh> mesh;
};

struct sweepface_face {
  std::shared_ptr<const sweepface::capi::Mesh> mesh;
  sweepface::Weights weights;   // [shown] as they were set
  sweepface::Weights followed;  // [targets] with followers
  std::vector<std::byte> scratch;
};

struct sweepface_motion {
  sweepface::MotionState state;
};
