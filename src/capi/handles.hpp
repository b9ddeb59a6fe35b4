#pragma once

#include <memory>
#include <vector>

#include "sweepface/evaluator.hpp"
#include "sweepface/live_motion.hpp"
#include "sweepface/render_mesh.hpp"
#include "sweepface/sweepface.h"

// What the handles of the C interface stand for. Rigs and meshes are shared by what is made from
// them.

struct sweepface_rig {
  std::shared_ptr<const sweepface::Rig> rig;
};

namespace sweepface::capi {

struct Mesh {
  std::shared_ptr<const Rig> rig;
  Evaluator evaluator;
  RenderMesh render;
};

}  // namespace sweepface::capi

struct sweepface_mesh {
  std::shared_ptr<const sweepface::capi::Mesh> mesh;
};

struct sweepface_face {
  std::shared_ptr<const sweepface::capi::Mesh> mesh;
  sweepface::Weights weights;
  std::vector<std::byte> scratch;
};

struct sweepface_motion {
  sweepface::MotionState state;
};
