#pragma once

#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "drawing/bend.hpp"
#include "drawing/jet_axes.hpp"
#include "drawing/weave.hpp"
#include "surface/stored_jets.hpp"

namespace sweepface::drawing {

/// The stored vectors that a drawing tells, in every pose: the neutral, and what each expression
/// adds to it. Refers to what it is made of.
class ToldJets {
 public:
  using Derivatives = std::array<std::optional<Vec3>, 9>;

  /// `plain`: the surface with plain ribbons, whose jets a drawing tells.
  ToldJets(const Drawing& drawing, const Woven& woven, const Surface& plain, JetAxes axes);

  std::vector<Pose>& poses() { return poses_; }
  /// Which vectors are told in some pose [storedCount].
  const std::vector<bool>& isTold() const { return isTold_; }

  /// Where a node stands, or how far it moves.
  void place(std::size_t pose, Index node, const Vec3& at) { set(pose, node, 0, at, 0); }
  /// A jet of a node in the neutral; where nothing is predicted it has all its vectors.
  Result<void> tellNeutral(Index node, std::size_t jet);
  /// A jet of a node, or what an expression adds to it.
  Result<void> tell(std::size_t pose, Index node, std::size_t jet, const Derivatives& given);
  /// What a creased node's jet has from the part beside it must be said the same in both; to be
  /// asked when all poses are whole.
  Result<void> checkRepeated() const;

 private:
  NodeKind kind(Index n) const { return woven_.connectivity.kinds[n]; }
  HalfArc armOf(const Drawing::Jet& jet) const { return woven_.halfArc(jet.along); }
  /// Where it is said how a node stands in a pose.
  TextPlace placeIn(std::size_t pose, Index n) const;
  /// Whether vectors of a jet differ by rounding alone.
  bool isSame(const Vec3& a, const Vec3& b) const;

  void set(std::size_t pose, Index node, int component, const Vec3& value, int fan);
  Result<void> checkComplete(Index n, std::size_t f) const;
  std::optional<int> fanOf(Index n, std::size_t f) const;
  Result<void> tellIrregular(std::size_t pose, Index n, const Derivatives& given);
  std::optional<double> angleAt(Index n) const;

  const Drawing& d_;
  const Woven& woven_;
  const Surface& plain_;
  StoredJets jets_;
  JetAxes axes_;
  double diagonal_;
  std::vector<bool> isTold_;
  std::vector<Pose> poses_;
  // What jets tell that other ones decide, in the order of poses.
  struct Repeated {
    std::size_t pose;
    Index node;
    std::size_t jet;
    int component;
    Vec3 value;
  };
  std::vector<Repeated> repeated_;
  // Of irregular points: pose and vector → the node that told it.
  std::map<std::pair<std::size_t, Index>, Index> irregular_;
};

}  // namespace sweepface::drawing
