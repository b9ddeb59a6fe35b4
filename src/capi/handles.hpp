#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "sweepface/evaluator.hpp"
#include "sweepface/followers.hpp"
#include "sweepface/live_motion.hpp"
#include "sweepface/render_mesh.hpp"
#include "sweepface/sweepface.h"

#include "eval/shader_tables.hpp"

// What the handles of the C interface stand for. Rigs and meshes are shared by what is made from
// them.

struct sweepface_rig {
  std::shared_ptr<sweepface::Rig> rig;  // only read once there are meshes
  sweepface::Followers followers;  // of its targets; those that were added for them are not shown
  std::size_t shown = 0;           // targets, the first ones
};

namespace sweepface::capi {

/// Tables are made when they are first asked for: until then a face shows its neutral.
class LazyEvaluator {
 public:
  const Evaluator& get(const Rig& rig, const Tessellation& grid,
                       const EvaluatorOptions& options) const {
    std::call_once(once_, [&] { made_ = *Evaluator::make(rig, grid, options); });
    return made_;
  }

 private:
  mutable std::once_flag once_;
  mutable Evaluator made_;
};

struct Mesh {
  std::shared_ptr<const Rig> rig;
  Followers followers;
  std::size_t shown;
  Index lod;
  Tessellation grid;
  Evaluator neutral;  // with the same options the others cannot fail
  RenderMesh render;
  LazyEvaluator lazyPositions = {}, lazyNormals = {};

  mutable std::once_flag shaderOnce = {};
  mutable ShaderTables shaderPositions = {}, shaderTangents = {};

  void makeShaderTables() const {
    std::call_once(shaderOnce, [&] {
      shaderPositions = shaderTables(positions().tables().positions, render.points);
      shaderTangents = shaderTables(normals().tables().derivatives, render.points);
    });
  }

  const Evaluator& positions() const {
    return lazyPositions.get(*rig, grid, {.level = lod, .normals = false});
  }
  const Evaluator& normals() const {
    return lazyNormals.get(*rig, grid, {.level = lod, .positions = false});
  }
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

  /// What an output holds, and where.
  struct Written {
    float* data = nullptr;
    std::size_t stride = 0, count = 0;
    sweepface::Weights weights;
  };
  Written positions, normals;
};

namespace sweepface::capi {
/// The face's weights with what follows them.
const Weights& follow(sweepface_face& face);
}  // namespace sweepface::capi

struct sweepface_motion {
  sweepface::MotionState state;
};
