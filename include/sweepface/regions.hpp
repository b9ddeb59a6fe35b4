#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface {

/// How heavy and how stiff a part of a face is compared with the rest, and how much later it sets
/// out (docs/regions.md).
struct Matter {
  double mass = 1, stiffness = 1;
  double delay = 0;  ///< seconds
  friend bool operator==(const Matter&, const Matter&) = default;
};

/// Refuses masses and stiffnesses outside [1e-4, 1e4] and delays outside [0, 60].
Result<void> check(const Matter& matter);

/// A part of a face that moves in its own way.
struct Region {
  std::string name;
  Matter matter;
  std::vector<double> shares;  ///< [nodes] how much of each node is its own, in [0, 1]
};

std::vector<std::string> namesOf(std::span<const Region> regions);  ///< [R]
std::vector<Matter> mattersOf(std::span<const Region> regions);     ///< [R]

/// Where a region is: everything that is named, and what is near it.
struct Brush {
  std::vector<std::string> parts;                     ///< materials and groups of the source
  std::vector<Vec3> points;                           ///< separate points, model units
  std::vector<Vec3> line;                             ///< through these points
  std::vector<std::string> curves;                    ///< of the wireframe, by name or number
  std::vector<std::pair<std::string, double>> nodes;  ///< by name or number: exact shares
  double whole = 0;                                   ///< wholly its own up to this distance
  double fade = 0;           ///< then less and less over this much more, model units
  bool alongSurface = true;  ///< distances along the curves of the neutral, or through space
};

/// Shares of the nodes [nodes]. The fading is twice continuously differentiable in the distance. A
/// brush that reaches no node is refused.
Result<std::vector<double>> paint(const Rig& rig, const Brush& brush);

/// `count` ≥ 2 neighbouring bands that cover the face and fade into each other: the first is what
/// the brush takes wholly, the last what lies beyond its fade. Their shares sum to 1.
Result<std::vector<std::vector<double>>> paintBands(const Rig& rig, const Brush& brush, int count);

/// The most regions of a face.
inline constexpr std::size_t kMostRegions = 32;

/// Regions whose shares sum to 1 at every node. Where painted ones overlap, they get less in
/// proportion; what none has belongs to a first region "rest", unless there is nothing left.
/// Refuses shares of another count or outside [0, 1], and names that are empty or used twice.
Result<std::vector<Region>> dividedFace(const Rig& rig, std::vector<Region> painted);

/// EvaluatorOptions::influences of regions [R][storedCount]; one region needs none.
std::vector<std::vector<float>> influencesOf(const Surface& surface,
                                             std::span<const Region> regions);

/// Blends every region by its own weights [R × K], of which missing ones are 0, into a settled pose
/// [vectorCount].
void blend(const Rig& rig, std::span<const Region> regions, std::span<const double> weights,
           std::span<Vec3> vectors);

/// Parts of targets as targets of their own, for programs without regions. The weight of a whole
/// target is the smallest of all its regions; that of a part is how far its region is ahead. So no
/// weight is below 0 if none was: some programs stop weights there.
class RegionalTargets {
 public:
  RegionalTargets() = default;
  /// Adds the parts of `targets`, named by partName(), to the end of a rig with K targets: one for
  /// every region that holds a part that moves, if there are several.
  static RegionalTargets addTo(Rig& rig, std::span<const Region> regions,
                               std::span<const Index> targets);

  /// For each of the rig's targets [K + parts], the target that it is a part of, or itself.
  std::vector<Index> wholes() const;

  /// Weights of the regions [R × K] as weights of the rig's targets, `out`.
  void spread(std::span<const double> ofRegions, std::span<double> out) const noexcept;

 private:
  /// A target and the regions that move some of it; their parts stand together.
  struct Split {
    Index target = -1, firstPart = -1;
    std::vector<std::size_t> regions;
  };
  std::size_t count_ = 0;  // K
  std::vector<Split> splits_;
};

/// "jawOpen@cheeks".
std::string partName(std::string_view target, std::string_view region);

}  // namespace sweepface
