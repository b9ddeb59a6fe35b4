#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/mesh.hpp"
#include "sweepface/rig.hpp"

namespace sweepface {

struct ConvertOptions {
  /// Largest allowed distance between a source vertex and its surface point, in model units, in the
  /// neutral and in every target at weight 1; 0: 0.02 % of `diagonal`.
  double tolerance = 0;
  /// Refine also where the surface's normal is further than this from the source's vertex normal,
  /// degrees; 0: in proportion to the tolerance (docs/fitting.md); 180: never.
  double normalLimit = 0;
  /// Spend the tolerance on the size of the file: vectors become small whole numbers, most of them
  /// zero, and the wireframe is its own mirror image where the face is (docs/file-format.md).
  /// Slower, and normals are worse.
  bool pack = false;
  /// With `pack`: the normals of the result are at most this far off the source's vertex normals,
  /// in degrees, root mean square over all vertices of all poses; 0: whatever `normalLimit` brings.
  double normalTolerance = 0;
  /// With `pack`: texture coordinates become multiples of 1 / 2^textureBits, 8 to 16. 14 bits are
  /// at most an eighth of a texel off in a texture of 4096 × 4096.
  int textureBits = 14;
  /// Try shape parameters on every ribbon and keep what lowers the error.
  bool chooseShapes = true;
  /// Called now and then with what is going on and how far it is, 0 to 1; from several threads, one
  /// at a time.
  std::function<void(std::string_view what, double done)> progress;
  /// Set by another thread to give up; convert then fails.
  const std::atomic<bool>* cancel = nullptr;
};

struct Conversion {
  Rig rig;
  std::vector<std::string> warnings;
};

/// The length of the diagonal of the box around the neutral's faces, or its vertices if it has no
/// faces.
double diagonal(const PolygonMesh& mesh);
/// Fails if a tolerance is larger than that diagonal of a mesh or finer than files can hold.
Result<void> checkTolerance(double tolerance, double diagonal);

/// Turns a mesh rig into a rig of ODE sweeping surfaces. Uses all cores that the calling TBB arena
/// allows; the result does not depend on how many. Fails if the tolerance cannot be met, if a face
/// has fewer than 3 corners or more than 4096, or if a number is not finite.
Result<Conversion> convert(const MeshRig& source, const ConvertOptions& options = {});

/// The meshes of a rig in its source's order: what it was made from, as closely as the rig has it.
MeshRig meshesOf(const Rig& rig);

struct PackOptions {
  /// Largest distance by which a vertex of level 1 may move, in model units, in the neutral and in
  /// every target at weight 1; 0: the rig's own tolerance, or 0.02 % of `diagonal` if it has none.
  /// For a rig that is packed already, 0 is what its steps stand for: what that packing was
  /// allowed, or less if normals were limited.
  double tolerance = 0;
  /// As in ConvertOptions; 0: as many as the rig is packed with, or 14.
  int textureBits = 0;
  /// As in ConvertOptions.
  std::function<void(std::string_view what, double done)> progress{};
  /// Set by another thread to give up; pack then fails.
  const std::atomic<bool>* cancel = nullptr;
};

/// Packs a rig as it is, for example after an edit or made from a drawing: vectors become small
/// whole numbers, most of them zero. The rig's tolerance grows by that of packing. The file is
/// larger than if `convert` packs, which leaves room for packing and traces mirror images alike.
/// Uses all cores, and the result does not depend on how many. Returns the tolerance it kept to. If
/// it fails, the rig is unchanged.
Result<double> pack(Rig& rig, const PackOptions& options = {});

/// A last step that adds to a rig, or takes from it, before it is written.
using FinishRig = std::function<Result<void>(Rig&)>;

/// Looks for the smallest tolerance whose file takes at most `mostBytes`, packed and finished, by
/// several conversions. None is finer than `options.tolerance`, if that is given. If the first
/// tolerance cannot be met, up to 256 times as much is tried, or as little as a 256th if none is
/// given and normals are too far off.
Result<Conversion> convertToBytes(const MeshRig& source, ConvertOptions options,
                                  std::size_t mostBytes, const FinishRig& finish = {});

}  // namespace sweepface
