#pragma once

#include <array>
#include <vector>

#include "sweepface/surface.hpp"

namespace sweepface {

/// ∂α^i ∂β^j in terms of a jet in axes (x, y), where (α, β) are (x, y) turned counter-clockwise by
/// a number of right angles.
struct Turned {
  int component;  ///< 3i + j in the axes (x, y)
  double sign;
};
Turned turned(int quarter, int i, int j);

/// The index of ∂x^i ∂y^j in a jet.
constexpr int jetComponent(int i, int j) { return 3 * i + j; }

/// The vectors of an irregular point and the ring of sectors around it.
struct Hub {
  Index first = -1;          ///< of its six vectors: p, A, B and the second derivatives C, D, E
  std::vector<Index> nodes;  ///< more than one only around collapsed arcs
};

/// Numbers all vectors, stored and derived, node by node, and looks them up by what they are.
class JetNumbers {
 public:
  JetNumbers(const Wireframe& wireframe, const Connectivity& connectivity);

  Index count() const { return static_cast<Index>(owners_.size()); }
  bool isStored(Index vector) const { return isStored_[vector]; }
  const StoredVector& owner(Index vector) const { return owners_[vector]; }
  const std::vector<Hub>& hubs() const { return hubs_; }  ///< [points]

  /// ∂x^i ∂y^j of a crossing or a T-node.
  Index own(Index node, int i, int j) const { return base_[node] + jetComponent(i, j); }
  /// ∂x^i ∂y^j of a fan of a creased node, i + j > 0.
  Index ofFan(Index node, std::size_t fan, int i, int j) const {
    return fanBase_[node] + 8 * static_cast<Index>(fan) + jetComponent(i, j) - 1;
  }
  /// ∂^i along an arm of an irregular or creased node, i = 1 or 2; `arm` wraps around.
  Index alongArm(Index node, std::size_t arm, int i) const {
    return armBase_[node] + 2 * static_cast<Index>(arm % c_.stars[node].arms.size()) + i - 1;
  }
  /// ∂α^i ∂β^j, i, j ≥ 1, at a corner of such a node.
  Index mixed(Index corner, int i, int j) const { return mixedBase_[corner] + 2 * (i - 1) + j - 1; }

  /// ∂α^i ∂β^j at a corner of any node.
  JetRef atCorner(Index corner, int i, int j) const;
  /// All nine of them, at 3i + j.
  std::array<JetRef, 9> atCorner(Index corner) const;

 private:
  /// The arm of a T-node along which its own x axis runs: the stem follows counter-clockwise.
  int hostArm(Index node) const;
  Index add(StoredVector owner, bool stored);
  std::size_t most() const;
  void numberRegular(Index node);
  void numberIrregular(Index node);
  void numberCreased(Index node);
  void numberArms(Index node);
  int quarterOf(Index corner) const;
  JetRef byArms(Index corner, int i, int j) const;

  const Wireframe& w_;
  const Connectivity& c_;
  std::vector<StoredVector> owners_;  // [vectors]
  std::vector<char> isStored_;        // [vectors]
  std::vector<Index> base_;           // [nodes] first of nine vectors of a crossing or a T-node
  std::vector<Index> armBase_;    // [nodes] first of two vectors per arm, if irregular or creased
  std::vector<Index> mixedBase_;  // [corners] first of four mixed vectors at such a node
  std::vector<Index> fanBase_;    // [nodes] first of eight vectors per fan of a creased node
  std::vector<Hub> hubs_;         // [points]
};

}  // namespace sweepface
