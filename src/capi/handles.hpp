#pragma once

#include <memory>
#include <vector>

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
  Tessellation grid;
  RenderMesh render;
  std::vector<Index> placeOf;  // [vertices] in the grid's vertices and then the loose ones
};

}  // namespace sweepface::capi

struct sweepface_mesh {
  std::shared_ptr<const sweepface::capi::Mesh> mesh;
};

struct sweepface_face {
  std::shared_ptr<const sweepface::capi::Mesh> mesh;
  sweepface::Weights weights;
  std::vector<sweepface::Vec3> vectors;  // a settled pose
  std::vector<sweepface::Vec3> places;   // [grid's vertices and loose ones]
};

struct sweepface_motion {
  sweepface::MotionState state;
};
