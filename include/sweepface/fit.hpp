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
  /// Spend the tolerance on the size of the file: vectors become small whole numbers, of which most
  /// are zero, and the wireframe is its own mirror image where the face is (docs/file-format.md).
  /// Slower, and normals are worse.
  bool pack = false;
  /// Where it packs: what is written is at most this far off the source's vertex normals, degrees,
  /// root mean square over all vertices of all poses; 0: whatever the limit above brings.
  double normalTolerance = 0;
  /// Where it packs: texture coordinates become multiples of 1 / 2^textureBits, 8 to 16. 14 bits
  /// are at most an eighth of a texel off in a texture of 4096 × 4096.
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

/// The length of the diagonal of the box round the neutral's faces; without faces, its vertices.
double diagonal(const PolygonMesh& mesh);
/// Fails where a tolerance is larger than that diagonal of a mesh or finer than what files hold.
Result<void> checkTolerance(double tolerance, double diagonal);

/// Turns a mesh rig into a rig of ODE sweeping surfaces. Uses all cores that the calling TBB arena
/// allows; the result does not depend on how many. Fails if the tolerance cannot be met, where
/// a face has fewer than 3 corners or more than 4096, and where a number is not finite.
Result<Conversion> convert(const MeshRig& source, const ConvertOptions& options = {});

/// The meshes that a rig answers with, in its source's order: what it was made from, as nearly as
/// it has them.
MeshRig meshesOf(const Rig& rig);

struct PackOptions {
  /// Largest distance by which a vertex of level 1 may move, in model units, in the neutral and in
  /// every target at weight 1; 0: the rig's own tolerance (if it has none 0.02 % of `diagonal`), or
  /// where it is packed already what its steps stand for: what that was allowed, or less where
  /// normals were limited.
  double tolerance = 0;
  /// As in ConvertOptions; 0: as many as the rig is packed with, or 14.
  int textureBits = 0;
  /// As in ConvertOptions.
  std::function<void(std::string_view what, double done)> progress{};
  /// Set by another thread to give up; pack then fails.
  const std::atomic<bool>* cancel = nullptr;
};

/// Packs a rig as it is, after an edit for example or made from a drawing: vectors become small
/// whole numbers, of which most are zero. Its tolerance grows by that of packing. The file is
/// larger than where `convert` packs, which leaves room for it and traces mirror images alike. Uses
/// all cores, and the result does not depend on how many. Returns the tolerance it kept to; where
/// it fails the rig stays as it was.
Result<double> pack(Rig& rig, const PackOptions& options = {});

/// What a rig gets or loses before it is written.
using FinishRig = std::function<Result<void>(Rig&)>;

/// Looks for the smallest tolerance whose file takes at most `mostBytes`, packed and finished:
/// several conversions. None is finer than `options.tolerance`, if that is given; where it cannot
/// be met, up to 256 times as much is tried, or where nobody says and normals are too far off as
/// little as a 256th.
Result<Conversion> convertToBytes(const MeshRig& source, ConvertOptions options,
                                  std::size_t mostBytes, const FinishRig& finish = {});

}  // namespace sweepface
