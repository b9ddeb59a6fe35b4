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

/// The stored vectors that a drawing specifies, in every pose: the neutral, and what each
/// expression adds to it. Keeps references to `drawing`, `woven` and `plain`.
class ToldJets {
 public:
  using Derivatives = std::array<std::optional<Vec3>, 9>;

  /// `plain` is the surface with plain ribbons, whose jets a drawing specifies.
  ToldJets(const Drawing& drawing, const Woven& woven, const Surface& plain, JetAxes axes);

  std::vector<Pose>& poses() { return poses_; }
  /// Which vectors are specified in some pose [storedCount].
  const std::vector<bool>& isTold() const { return isTold_; }

  /// Sets the position of a node, or how far it moves.
  void place(std::size_t pose, Index node, const Vec3& at) { set(pose, node, 0, at, 0); }
  /// Sets a jet of a node in the neutral. It must be complete where nothing is predicted.
  Result<void> tellNeutral(Index node, std::size_t jet);
  /// Sets a jet of a node, or what an expression adds to it.
  Result<void> tell(std::size_t pose, Index node, std::size_t jet, const Derivatives& given);
  /// Checks that derivatives which a creased node's jet takes from the fan beside it are the same
  /// in both. To be called when all poses are complete.
  Result<void> checkRepeated() const;

 private:
  NodeKind kind(Index n) const { return woven_.connectivity.kinds[n]; }
  HalfArc armOf(const Drawing::Jet& jet) const { return woven_.halfArc(jet.along); }
  /// Where the drawing specifies a node in a pose.
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
  // Derivatives given by jets but determined by others, in the order of poses.
  struct Repeated {
    std::size_t pose;
    Index node;
    std::size_t jet;
    int component;
    Vec3 value;
  };
  std::vector<Repeated> repeated_;
  // For irregular points: pose and vector → the node that specified it.
  std::map<std::pair<std::size_t, Index>, Index> irregular_;
};

}  // namespace sweepface::drawing
