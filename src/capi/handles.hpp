#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "sweepface/codec.hpp"
#include "sweepface/evaluator.hpp"
#include "sweepface/followers.hpp"
#include "sweepface/head.hpp"
#include "sweepface/pose_box.hpp"
#include "sweepface/regional_motion.hpp"
#include "sweepface/render_mesh.hpp"
#include "sweepface/sweepface_regions.h"

#include "capi/written.hpp"
#include "eval/shader_tables.hpp"

// The objects behind the handles of the C interface. Rigs and meshes are shared by what is made
// from them.

struct sweepface_face;
struct sweepface_rig;

namespace sweepface::capi {

/// Refuses a rig that shows only its neutral, because what its targets do was not loaded.
sweepface_status needTargets(const Rig& rig);

/// The most vertices a mesh may have, about one per quad; checked before memory is reserved for
/// them.
inline constexpr double kMostVertices = 1 << 24;

/// The regions of a face; if there are none, one that is everywhere.
struct Division {
  std::vector<std::string> names;
  std::vector<std::vector<float>> influences;
  std::vector<Matter> matters;

  std::size_t count() const { return std::max<std::size_t>(1, names.size()); }
};

/// A face divided into these regions.
Division divisionOf(const Rig& rig, const std::vector<Region>& regions);
/// Divides a rig, keeping eyes that turn whole.
void divide(sweepface_rig& rig, Division division);

/// Sets weights that depend on others, if there are any. Most faces have none, and a module without
/// them does not link this in.
struct Following {
  std::shared_ptr<const Followers> followers;  // of targets; targets added for these are not shown
  std::shared_ptr<const EyeTurns> eyes;        // if they turn
  const Weights& (*apply)(const Following&, sweepface_face&) = nullptr;
};
/// Applies all of them; used as Following::apply.
const Weights& followAll(const Following& following, sweepface_face& face);

}  // namespace sweepface::capi

struct sweepface_rig {
  std::shared_ptr<sweepface::Rig> rig;  // once there are meshes, only targets may still be loaded
  sweepface::TargetsToCome toCome;
  std::size_t shown = 0;  // targets, the first ones
  std::shared_ptr<const sweepface::capi::Division> division;
  sweepface::capi::Following following = {};
};

namespace sweepface::capi {

inline std::vector<std::string> shownNames(const sweepface_rig& rig) {
  std::vector<std::string> names;
  for (std::size_t t = 0; t < rig.shown; ++t) names.push_back(rig.rig->targets[t].name);
  return names;
}

struct Mesh {
  std::shared_ptr<const Rig> rig;
  std::size_t shown;
  std::shared_ptr<const Division> division;
  Following following;
  Index lod;
  Tessellation grid;
  Evaluator neutral;  // with the same options the others cannot fail
  RenderMesh render;

  // Tables are made on first use; until then a face shows its neutral.
  mutable std::once_flag positionsOnce = {}, normalsOnce = {};
  mutable Evaluator madePositions = {}, madeNormals = {};

  mutable std::once_flag shaderOnce = {};
  mutable ShaderTables shaderPositions = {}, shaderTangents = {};

#ifndef __wasm__  // the module is kept small, and shaders find tangents themselves
  /// The tangents of all vertices, for normal maps: with targets, or of the neutral alone, for
  /// which none need to be loaded.
  const Evaluator& mapTangents(bool moving) const;
  /// The box of any pose, likewise.
  const PoseBox& poseBox(bool moving) const;

  /// What is made when it is first asked for.
  template <typename T>
  struct Late {
    std::once_flag once = {};
    std::optional<T> made = {};
  };
  mutable std::once_flag tangentsOnce = {};
  mutable Tangents tangents = {};  // of the neutral
  mutable Late<Evaluator> neutralMap = {}, movingMap = {};
  mutable Late<PoseBox> neutralBox = {}, movingBox = {};

  /// Enough for the map tangents too.
  std::size_t scratchBytes() const {
    return neutral.scratchBytes() + sizeof(Index) * (render.copies.size() / kTileVertices + 1);
  }
#else
  std::size_t scratchBytes() const { return neutral.scratchBytes(); }
#endif

  void makeShaderTables() const {
    std::call_once(shaderOnce, [&] {
      prepareBoth();
      shaderPositions = shaderTables(madePositions.tables().positions, render.points);
      shaderTangents = shaderTables(madeNormals.tables().derivatives, render.points);
    });
  }

  const Evaluator& positions(bool withNormals = false) const {
    std::call_once(positionsOnce, [&] { madePositions = make(true, withNormals); });
    return madePositions;
  }
  const Evaluator& normals(const Evaluator* both = nullptr) const {
    std::call_once(normalsOnce,
                   [&] { madeNormals = both && both->hasNormals() ? *both : make(false, true); });
    return madeNormals;
  }
  /// Making both at once takes less than one after the other.
  void prepareBoth() const { normals(&positions(true)); }

 private:
  Evaluator make(bool ofPositions, bool ofNormals) const {
    return *Evaluator::make(*rig, grid,
                            {.level = lod,
                             .normals = ofNormals,
                             .positions = ofPositions,
                             .influences = division->influences});
  }
};

/// Refuses more vertices than there are.
sweepface_status needVertices(const Mesh& mesh, std::size_t count);
/// Fills in the vertices after the points, which repeat them, as far as they are among the first
/// `count`.
void repeatPoints(const Mesh& mesh, const sweepface_vectors& out, std::size_t count);

}  // namespace sweepface::capi

struct sweepface_mesh {
  std::shared_ptr<const sweepface::capi::Mesh> mesh;
};

struct sweepface_face {
  std::shared_ptr<const sweepface::capi::Mesh> mesh;
  sweepface::Weights weights;   // [regions × shown] as they were set
  sweepface::Weights followed;  // [regions × targets] with followers
  std::vector<std::byte> scratch;

  sweepface::capi::Written positions, normals;
  std::optional<sweepface::HeadPose> looks = {};
#ifndef __wasm__  // the module has one buffer, and must be small
  sweepface::capi::WrittenBefore positionsBefore{followed}, normalsBefore{followed};
#endif
};

namespace sweepface::capi {
inline bool isNeutral(const Weights& weights) {
  return std::ranges::all_of(weights, [](double w) { return w == 0; });
}

/// The face's weights with those that follow from them.
inline const Weights& follow(sweepface_face& face) {
  const Following& following = face.mesh->following;
  return following.apply ? following.apply(following, face) : face.weights;
}
}  // namespace sweepface::capi

struct sweepface_motion {
  sweepface::RegionalMotion state;
};
