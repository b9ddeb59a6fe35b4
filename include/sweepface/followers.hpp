#pragma once

#include <span>
#include <string>
#include <vector>

#include "sweepface/rig.hpp"

namespace sweepface {

/// A target whose weight is not set: it follows from the weights of others.
struct Follower {
  enum class Kind {
    product,    ///< the product of its leaders' weights: a corrective or combination target
    inBetween,  ///< the whole expression of its one leader at the weight `at`, which it replaces
    arc         ///< 4w(1 − w) of its one leader's weight w: half-way points moved onto an arc
  };
  Kind kind = Kind::product;
  Index target = -1;
  std::vector<Index> leaders;
  double at = 0.5;  ///< of an in-between, in (0, 1)
  friend bool operator==(const Follower&, const Follower&) = default;
};

/// The followers of a rig. Weights go in as they were set and come out as `blend` takes them.
class Followers {
 public:
  Followers() = default;
  explicit Followers(std::vector<Follower> followers);

  /// The followers that the names of targets imply: `A_B` follows the product of the targets A and
  /// B (and so on for more, but not of products), `A_50`, `A50` or `A.50` is the in-between of A at
  /// 0.5.
  static std::vector<Follower> named(std::span<const std::string> targets);

  bool empty() const noexcept {
    return products_.empty() && chains_.empty() && arcs_.empty() && lateArcs_.empty();
  }

  /// Replaces the weights [K] of all followers, and of leaders that hand over to in-betweens.
  /// Products and arcs use the weights of their leaders as they were set, or, for leaders that are
  /// followers themselves, as they follow: there may be products of in-betweens, and arcs of both.
  /// All weights are then plausible (weights.hpp). Allocates nothing.
  void apply(std::span<double> weights) const noexcept;

 private:
  /// A product's leader that is an in-between: it counts as soon as it is given its weight.
  struct Factor {
    Index leader = -1, product = -1;
  };
  /// A leader and its in-betweens, by ascending weight.
  struct Chain {
    Index leader = -1;
    std::vector<Follower> stops;
    int depth = 0;  ///< how many chains must hand over before it, one after another
    std::vector<Factor> factors{};

    bool gives(Index target) const;
  };
  void orderChains();
  static void handOver(const Chain& chain, std::span<double> weights) noexcept;

  std::vector<Index> ignored_;             // in-betweens where there is another one
  std::vector<Follower> products_, arcs_;  // by leaders that are set
  std::vector<Chain> chains_;
  std::vector<Follower> lateArcs_;  // by leaders that follow
};

}  // namespace sweepface
