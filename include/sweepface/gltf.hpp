#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/clip.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/head.hpp"
#include "sweepface/io.hpp"
#include "sweepface/motion.hpp"
#include "sweepface/result.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

/// The rig in a .glb or .gltf file: the meshes that `options` choose, or all primitives shown that
/// have morph targets, or all primitives if none has. Its vertices are those of the primitives, one
/// after another, in the scene's space. Quads are recovered from triangles. Messages call the file
/// `name`. External buffers and images are read only from `folder`, and not at all if that is
/// empty.
Result<RigSource> parseGltf(std::string_view bytes, std::string_view name,
                            const std::filesystem::path& folder, const SourceOptions& options = {});

/// The weights of morph targets in an animation: the first that has any, or the one of that name.
/// A frame for every key; curves are cut into straight lines of a 120th of a second.
Result<Clip> parseGltfClip(std::string_view bytes, std::string_view name,
                           const std::filesystem::path& folder, std::string_view animation = {});

/// The scene with the weights of its skins rounded to 16 bits, where they are shares of one in
/// single precision. They are off by 1/131070 at most, except for the largest of a vertex, which
/// keeps their sum. Returns the same scene if there is nothing to round.
std::string packedScene(std::string scene);

/// Whether the scene that came with a rig can take the rig, as formatGlb() requires; succeeds for a
/// rig without a scene.
Result<void> checkScene(const Rig& rig);

/// How far a head's turn may be off, in radians, when it is reduced to as few keys as possible.
inline constexpr double kHeadTolerance = 0.001;

/// What formatGlb writes.
struct GlbOptions {
  Index lod = 0;  ///< 0: the source's vertices in their order; N: every edge cut into N
  /// Instead of a level: a tessellation of the rig with a density, whose triangles are written.
  const Tessellation* grid = nullptr;
  bool morphNormals = false;  ///< normals of the morph targets too
  bool quantize = false;      ///< KHR_mesh_quantization
  /// How long a unit is, and whether z points up instead of y, in a face that came without a scene;
  /// a scene's units are metres, and y points up. Its node turns and scales it. 0: 1.
  double metersPerUnit = 0;
  bool zUp = false;
  Weights weights{};  ///< at which the face is shown; empty: as its scene says, else all 0
  /// An animation of the weights, or null. Its keys hold every law exactly.
  const Motion* motion = nullptr;
  /// Instead of a motion: one key for each frame, with straight lines between them. Its names are
  /// the rig's targets.
  const Clip* clip = nullptr;
  /// Greater than 0: writes the clip in as few keys with tangents as keep its weights within this.
  double keyTolerance = 0;
  /// How the model turns, alone or beside a motion or a clip.
  const HeadTrack* head = nullptr;
  std::string animationName{};  ///< the law's, or "clip", if empty
};

/// A GLB of the rig with its targets as morph targets, in the scene that came with it if it has
/// one.
Result<std::string> formatGlb(const Rig& rig, const GlbOptions& options);

/// A GLB of meshes as they are, in single precision, with their targets as morph targets and
/// without normals. Every target has the neutral's vertices.
Result<std::string> formatGlb(const MeshRig& meshes);

}  // namespace sweepface
