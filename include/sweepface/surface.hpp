#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "sweepface/ode.hpp"
#include "sweepface/result.hpp"
#include "sweepface/vec.hpp"

namespace sweepface {

/// A direction of travel along an arc: 2·arc, plus 1 when travelled from its end to its start.
using HalfArc = Index;
inline HalfArc twin(HalfArc h) { return h ^ 1; }
inline Index arcOf(HalfArc h) { return h >> 1; }

/// A curve between two nodes, stored once and shared by the patches on both sides.
struct Arc {
  Index from = -1, to = -1;  ///< nodes
  Index edges = 1;           ///< its length: the number of source edges it runs along
  Index ribbon = 0;          ///< whose shape parameters govern it
  bool collapsed = false;    ///< all of it is one point (the pole of a fan of triangles)
  bool crease = false;       ///< the patches on both sides share nothing but the curve
  friend bool operator==(const Arc&, const Arc&) = default;
};

/// Components of a jet: bit 3i + j is ∂x^i ∂y^j S. A node stores a set that is closed downwards;
/// what it does not store is predicted from its neighbours (docs/wireframe.md).
using JetMask = std::uint16_t;
inline constexpr JetMask kPosition = 1;
inline constexpr JetMask kWholeJet = 0x1ff;

/// A point where arcs meet.
struct Node {
  Index point = -1;  ///< place in the numbering of points; -1 for a T-node, which stores nothing
  JetMask stored = kPosition;  ///< used by crossings only
  friend bool operator==(const Node&, const Node&) = default;
};

/// A four-sided loop of arcs, counter-clockwise seen from outside. Side 0 runs along v = 0 in the
/// direction of the sweep u, side 1 along u = 1, side 2 back along v = 1, side 3 back along u = 0.
struct Patch {
  std::array<Index, 5> sides{};  ///< side s is loops[sides[s] .. sides[s+1])
  friend bool operator==(const Patch&, const Patch&) = default;
};

/// The curves of a face and the loops that bound its patches.
struct Wireframe {
  Index points = 0;
  std::vector<Node> nodes;
  std::vector<Arc> arcs;
  std::vector<Patch> patches;
  std::vector<HalfArc> loops;
  std::vector<Shape> ribbons;  ///< shape parameters, per source edge

  std::span<const HalfArc> side(Index patch, int s) const {
    const Patch& p = patches[patch];
    return {loops.data() + p.sides[s], loops.data() + p.sides[s + 1]};
  }
  Index start(HalfArc h) const { return h & 1 ? arcs[arcOf(h)].to : arcs[arcOf(h)].from; }
  Index end(HalfArc h) const { return start(twin(h)); }
  /// Length of a side in source edges.
  Index sideEdges(Index patch, int s) const;
  /// Quads of all patches at level 1.
  std::size_t quadCount() const;
  friend bool operator==(const Wireframe&, const Wireframe&) = default;
};

inline constexpr Index kStraight = -1;
/// A node's surroundings. sectors[i] lies counter-clockwise of arms[i].
struct Star {
  std::vector<HalfArc> arms;   ///< leaving the node, counter-clockwise
  std::vector<Index> sectors;  ///< 4·patch + corner, or kStraight where a patch's side runs through
  bool closed = false;         ///< no boundary: as many sectors as arms, else one fewer

  /// Of a T-node: the sector of the patch on whose side it hangs.
  std::size_t straight() const;
  /// Its arms along that side, ahead and behind: pieces of one line.
  std::array<HalfArc, 2> line() const;
};

enum class NodeKind {
  crossing,   ///< a full jet in its own frame: four patches, or one or two at a boundary
  irregular,  ///< a second-order jet in the characteristic chart of its valence
  hanging,    ///< a T-node: derived from the arc it stands on
  creased     ///< creases cut its star into fans, each with a jet of its own
};

/// Consecutive sectors of a star between creases or boundaries, smooth among themselves. An arm
/// between two fans has the derivatives that the first of them gives it.
struct Fan {
  int first = 0;            ///< arm; the fan's own x axis leaves along it
  int sectors = 0;          ///< counter-clockwise of it
  bool regular = true;      ///< every sector a right angle: one jet of nine vectors
  double step = 0;          ///< else: of the chart of its second-order jet, by sector
  bool firstGiven = false;  ///< an earlier fan gives the derivatives along the first arm
  bool lastGiven = false;   ///< and those along the last
  friend bool operator==(const Fan&, const Fan&) = default;
};

/// A straight run of arcs, up to the next node that does not merely hang on it.
struct Rail {
  HalfArc last = -1;  ///< arrives at the rail's end
  Index edges = 0;
};

/// The connectivity of a wireframe; derived, never stored.
struct Connectivity {
  std::vector<Index> patchOf;   ///< [half-arcs] the patch on the left, or -1
  std::vector<Index> cornerAt;  ///< [half-arcs] 4·patch + corner if a side starts with it, or -1
  std::vector<HalfArc> next, prev;     ///< [half-arcs] in the loop of the patch on the left
  std::vector<Star> stars;             ///< [nodes]
  std::vector<NodeKind> kinds;         ///< [nodes]
  std::vector<Index> cornerSector;     ///< [4·patches] sector of the corner in its node's star
  std::vector<Index> cornerNode;       ///< [4·patches]
  std::vector<Rail> rails;             ///< [half-arcs] the rest of the rail from each on
  std::vector<std::vector<Fan>> fans;  ///< [nodes] of those that are creased

  /// Fails, naming the place, if the loops do not form a surface. Their half-arcs must follow each
  /// other without a gap, which Surface::make ensures.
  static Result<Connectivity> make(const Wireframe& wireframe);
  /// The arm opposite to `arm` of a node's star: the line runs straight on; -1 if it ends here.
  int opposite(Index node, int arm) const;
  /// The half-arc that leaves the start of `h` in the opposite direction; -1 if there is none.
  HalfArc opposite(const Wireframe& wireframe, HalfArc h) const;
};

/// One term of a linear combination of vectors.
struct Term {
  Index vector = -1;
  double factor = 0;
};

/// A vector of the model, or its opposite.
struct JetRef {
  Index vector = -1;
  double sign = 1;
};

/// What a stored vector is: a component of the jet of a node, or of all nodes at a point.
struct StoredVector {
  Index node = -1;
  int i = 0, j = 0;  ///< ∂x^i ∂y^j in the node's frame
  int fan = 0;       ///< whose frame it is, at a creased node

  bool isPosition() const { return i + j == 0; }
};

/// Where the surface is asked for: (u, v) in source edges from the patch's first corner.
struct Site {
  Index patch = -1;
  double u = 0, v = 0;
};

/// A wireframe made ready for evaluation. A pose is its stored vectors; everything else is linear
/// in them. Building costs a few microseconds a patch; afterwards nothing changes and any number of
/// threads may read.
class Surface {
 public:
  /// Fails, naming the place, if the wireframe is inconsistent. If derivatives depend on
  /// themselves, `circle` (if given) receives one node for each such circle that could break it.
  static Result<Surface> make(Wireframe wireframe, std::vector<Index>* circle = nullptr);
  /// The same for a wireframe that is known to be consistent, with its connectivity.
  static Result<Surface> make(Wireframe wireframe, Connectivity connectivity,
                              std::vector<Index>* circle = nullptr);

  const Wireframe& wireframe() const { return wireframe_; }
  const Connectivity& connectivity() const { return connectivity_; }
  Index patchCount() const { return static_cast<Index>(wireframe_.patches.size()); }
  Index storedCount() const { return static_cast<Index>(stored_.size()); }
  Index vectorCount() const { return storedCount() + static_cast<Index>(rowStart_.size()) - 1; }
  const StoredVector& stored(Index vector) const { return stored_[vector]; }

  /// Terms of the derived vector `vector` ≥ storedCount(), in vectors before it.
  std::span<const Term> derivation(Index vector) const;

  /// Completes a pose: the stored vectors [storedCount()] followed by all derived ones
  /// [vectorCount()]. Both may be the same memory.
  void settle(std::span<const Vec3> stored, std::span<Vec3> vectors) const;

  /// ∂α^i ∂β^j at a patch's corner; α leaves along side `corner`, β back along the side before.
  JetRef cornerJet(Index patch, int corner, int i, int j) const {
    return corners_[(4 * patch + corner) * 9 + 3 * i + j];
  }
  /// The vector ∂^i along a half-arc at its start.
  JetRef alongJet(HalfArc h, int i) const;

  /// Lengths of a patch in source edges.
  Index edgesU(Index patch) const { return frames_[patch].m; }
  Index edgesV(Index patch) const { return frames_[patch].n; }

  /// The 36 vectors a patch is made of and their weights in ∂u^du ∂v^dv S at a site.
  struct Weights {
    std::array<Index, 36> vectors;
    std::array<double, 36> factors;
  };
  Weights weights(const Site& site, int du = 0, int dv = 0) const;
  /// The same as if the sweep and the curves at u = 0 and u = m had other bases: what a change of
  /// shape parameters would do.
  struct PatchBasis {
    const SweepBasis *u, *v0, *v1;
  };
  PatchBasis patchBasis(Index patch) const;
  Weights weights(const Site& site, const PatchBasis& basis, int du = 0, int dv = 0) const;
  /// ∂u^du ∂v^dv S; `vectors` is a settled pose.
  Vec3 evaluate(std::span<const Vec3> vectors, const Site& site, int du = 0, int dv = 0) const;
  /// The outward unit normal; at a collapsed side or a vanishing derivative its limit from inside.
  Vec3 normal(std::span<const Vec3> vectors, const Site& site) const;
  /// The six vectors an arc is made of and their weights in its point at t ∈ [0, edges].
  struct ArcWeights {
    std::array<Index, 6> vectors;
    std::array<double, 6> factors;
  };
  ArcWeights arcWeights(Index arc, double t) const;
  /// A point at t ∈ [0, edges] on an arc: computed from the arc alone, never from a patch.
  Vec3 pointOnArc(std::span<const Vec3> vectors, Index arc, double t) const;

  /// The site a thousandth of the way to the middle of its patch. There, derivatives that
  /// vanish on a collapsed side nearly have the directions to which they tend.
  Site inside(const Site& site) const {
    const Frame& f = frames_[site.patch];
    return {site.patch, site.u + (f.m * 0.5 - site.u) * 1e-3, site.v + (f.n * 0.5 - site.v) * 1e-3};
  }

  /// Where a half-arc lies on the patch on its left: the site at distance t from its start.
  Site siteOnArc(HalfArc h, double t) const;

  /// The patches that a stored vector moves, ascending.
  std::vector<Index> owners(Index stored) const;

 private:
  struct Frame {
    Index m = 1, n = 1;          // source edges along u and v
    Index u = 0, v[2] = {0, 0};  // bases of the sweep and of the curves at u = 0 and u = m
  };
  void frame();
  // Of the values of the sweep and of the curves at u = 0 and u = m.
  Weights combine(Index patch, const std::array<double, 6>& gu, const std::array<double, 6>& g0,
                  const std::array<double, 6>& g1) const;

  Wireframe wireframe_;
  Connectivity connectivity_;
  std::vector<StoredVector> stored_;
  std::vector<Index> rowStart_{0};
  std::vector<Term> terms_;
  std::vector<JetRef> corners_;  // [patches × 4 × 9]
  std::shared_ptr<const class BasisTable> bases_;
  std::vector<Frame> frames_;    // [patches]
  std::vector<Index> arcBases_;  // [arcs]
};

/// What kind of join an arc is.
enum class JoinClass {
  boundary,  ///< one patch only
  c2,        ///< position, first and second cross derivatives agree along the whole arc
  spoke,     ///< ends at an irregular node: C² at both ends in the node's chart, C⁰ between
  crease     ///< declared: C⁰
};
inline constexpr std::size_t kJoinClasses = 4;

struct JoinReport {
  JoinClass joinClass = JoinClass::boundary;
  bool collapsed = false;  ///< the arc is one point, at which nothing joins
  double length = 0;       ///< of the arc, in model units
  double positionGap = 0;  ///< largest distance between the two sides
  double firstJump = 0;    ///< of the first cross derivative, relative to the largest of the model
  double secondJump = 0;   ///< of the second, likewise
  double normalJump = 0;   ///< largest angle between the normals, degrees
};

/// Joins summed up.
struct JoinSummary {
  std::size_t count = 0;
  double length = 0;
  double positionGap = 0, firstJump = 0, secondJump = 0, normalJump = 0;  ///< largest ones
  double normalSquares = 0;  ///< of the angles, times length

  void add(const JoinReport& join);
  /// The RMS of each arc's largest angle, weighted by length.
  double normalRms() const;
};

/// The class of an arc by the nodes at its ends.
JoinClass joinClass(const Surface& surface, Index arc);
/// Both sides of every arc compared at `samples` points along it.
std::vector<JoinReport> examineJoins(const Surface& surface, std::span<const Vec3> vectors,
                                     int samples = 5);

}  // namespace sweepface
