#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/polygons.hpp"
#include "sweepface/surface.hpp"
#include "sweepface/weights.hpp"

namespace sweepface {

/// A named expression: what its weight adds to every stored vector.
struct Target {
  std::string name;
  std::vector<Vec3> difference;       ///< [storedCount]
  std::vector<Vec3> looseDifference;  ///< [loose vertices]
  friend bool operator==(const Target&, const Target&) = default;
};

/// What an expression turns about: lids about an eyeball, a jaw about its hinge (docs/arcs.md).
struct Turn {
  Index target = -1;
  Vec3 pivot;
  Vec3 axis;  ///< unit, through the pivot; zero where points keep their distance from the pivot
  friend bool operator==(const Turn&, const Turn&) = default;
};

/// Maps the model to the source's own order of vertices.
struct SourceMesh {
  std::vector<Index>
      gridVertex;        ///< [V] vertex of the tessellation at level 1, or -1 - k: loose vertex k
  bool ownOrder = true;  ///< false: the source's order was left out, `gridVertex` counts up
  std::vector<Vec3> loose;  ///< vertices of no face, kept as they are
  Polygons polygons;
  /// [grid quads × 4] face corner of the source at each corner of the patches' quads, patch by
  /// patch in rows of constant v, counter-clockwise from (i, j).
  std::vector<Index> quadCorners;
};

/// How a file stores the vectors of a rig (docs/file-format.md): as whole multiples of steps, minus
/// what neighbours and mirror images predict. The fit chooses it; `decode` returns what it found in
/// the file. Vectors that are not such multiples, and all if there are no steps, are stored as they
/// are.
struct Packing {
  double neutralStep = 0, targetStep = 0;  ///< model units; 0: no steps
  int axis = 0;                            ///< 0, 1, 2: the mirror lies across x, y, z
  /// Half-arcs that mirror each other, each with its patch on the left; one pair for every part of
  /// the wireframe that has a mirror image.
  std::vector<std::array<HalfArc, 2>> mirror;
  /// How a pose carries everything that hangs on a bone, in fractions of the targets' step
  /// (codec/bones.hpp): how far the bone's middle moves, then how much further what lies away from
  /// there along x, y and z.
  struct Carry {
    Index bone = 0;
    std::array<std::array<std::int32_t, 3>, 4> by{};
    friend bool operator==(const Carry&, const Carry&) = default;
  };
  struct Pose {
    int finer = 0;     ///< its step is divided by 2^finer
    Index image = -1;  ///< the pose whose mirror image it is compared with, itself or an earlier
                       ///< one; -1: none
    std::vector<Carry> carries{};  ///< by bone; the pose is stored relative to them
    friend bool operator==(const Pose&, const Pose&) = default;
  };
  std::vector<Pose> poses;  ///< the neutral, then the targets
  /// [S] or empty: the bone that carries each stored vector (teeth and lower gums by the jaw, say),
  /// or -1.
  std::vector<Index> bones;
  /// [S] or empty: the neutral before an edit. The prediction of targets goes by it, so that an
  /// edit of the neutral leaves their coefficients as they are.
  std::vector<Vec3> rest;
  /// Texture coordinates are stored as multiples of 1 / 2^textureBits; 0: exactly.
  int textureBits = 0;
  friend bool operator==(const Packing&, const Packing&) = default;
};

/// The names that a drawing gives its parts (docs/wire-format.md): one each, empty for those
/// without one, or an empty list if none has a name.
struct Names {
  std::string units;  ///< of all coordinates, e.g. cm; empty: unknown
  std::vector<std::string> nodes, curves, patches, ribbons;
  friend bool operator==(const Names&, const Names&) = default;
};

/// What has a name, or is called by a letter and its number: n5, c12, p0, r3.
enum class Thing { node, curve, patch, ribbon };

/// A neutral model and its targets over one wireframe.
struct Rig {
  Surface surface;
  std::vector<Vec3> neutral;  ///< [storedCount] the neutral's stored vectors
  std::vector<Target> targets;
  SourceMesh source;
  double tolerance = 0;  ///< the error it was made for, in model units
  /// What the source's scene held besides the rig, as a GLB, mostly in a zlib stream (docs/glb.md),
  /// or empty. Opaque to playback.
  std::string scene;
  Names names{};

  Packing packing;

  /// What its targets turn about, by ascending target, each at most once; empty if they have not
  /// been looked for. Files store them in single precision.
  std::vector<Turn> turns{};

  /// The stored vectors of pose 0, the neutral, or what target pose - 1 adds to them.
  std::vector<Vec3>& vectorsOf(Index pose) {
    return pose == 0 ? neutral : targets[pose - 1].difference;
  }
  const std::vector<Vec3>& vectorsOf(Index pose) const {
    return pose == 0 ? neutral : targets[pose - 1].difference;
  }
  /// The weights that put a face into that pose: [targets].
  Weights weightsOf(Index pose) const;

  std::vector<std::string> targetNames() const;

  /// Whether it is known what every target does: not yet after `decodeNeutral`.
  bool knowsTargets() const;
  bool knows(const Target& target) const;
  /// Index of a target by its name, or -1.
  Index find(std::string_view name) const;
  /// The name of a thing, or its letter and number.
  std::string nameOf(Thing thing, Index index) const;
  /// A thing by its name, by its letter and number, or by its number alone. The error lists what
  /// there is.
  Result<Index> find(Thing thing, std::string_view name) const;
};

/// The target with this name; the error lists the names there are.
Result<Index> findTarget(const Rig& rig, std::string_view name);
/// The same among the first `count`.
Result<Index> findTarget(const Rig& rig, std::string_view name, std::size_t count);

/// Parses "jawOpen=1,eyeBlink_L=0.5" into weights for the rig's targets. The error names what is
/// unknown or malformed and what there is instead.
Result<Weights> parseWeights(const Rig& rig, std::string_view text);

/// Neutral + Σ weight · difference on the stored vectors, settled: [vectorCount]. Blending happens
/// here, never on vertices.
void blend(const Rig& rig, std::span<const double> weights, std::span<Vec3> vectors);
std::vector<Vec3> blend(const Rig& rig, std::span<const double> weights);
/// The loose vertices under the same weights.
void blendLoose(const Rig& rig, std::span<const double> weights, std::span<Vec3> loose);
std::vector<Vec3> blendLoose(const Rig& rig, std::span<const double> weights);

}  // namespace sweepface
