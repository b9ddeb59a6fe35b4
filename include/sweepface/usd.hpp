#pragma once

#include <string>

#include "sweepface/clip.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/head.hpp"
#include "sweepface/result.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// What formatUsd writes.
struct UsdOptions {
  Index lod = 0;  ///< 0: the source's vertices and polygons; N: every edge cut into N
  const Tessellation* grid = nullptr;  ///< as in GlbOptions, also for a rig with a scene
  bool morphNormals = false;           ///< normals of the blend shapes too
  Weights weights{};  ///< at which the face is shown where nothing is animated; empty: 0
  /// An animation of the weights, or null: a time sample for each frame, with straight lines
  /// between them. Its names are the rig's targets.
  const Clip* clip = nullptr;
  const HeadTrack* head = nullptr;  ///< how the model turns, or null
  double timeCodesPerSecond = 24;   ///< the unit of the layer's times
  /// 0: 1 for a face that came with a scene of glTF, what the units of a drawing are, or else 0.01.
  double metersPerUnit = 0;
  bool zUp = false;  ///< whether z points up, instead of y
};

/// A layer of OpenUSD in text (.usda): the rig as a mesh whose targets are blend shapes of UsdSkel
/// (docs/usd.md). Of the scene that came with the rig it has the colours of its materials.
Result<std::string> formatUsd(const Rig& rig, const UsdOptions& options);
/// The same layer and the images of its materials in one file (.usdz).
Result<std::string> formatUsdz(const Rig& rig, const UsdOptions& options);

/// A sentence that says what these leave out of the scene that came with the rig; empty if that has
/// no other meshes, skins, animations or colours of vertices.
std::string leftOutOfUsd(const Rig& rig);

}  // namespace sweepface
