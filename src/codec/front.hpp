#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "sweepface/surface.hpp"

#include "codec/loop_images.hpp"

namespace sweepface::codec {

/// The border of the patches coded so far, a queue of half-arcs that wait for the patch on their
/// side (the cut-border of Gumhold and Straßer, Real Time Compression of Triangle Mesh
/// Connectivity, 1998).
class Front {
 public:
  /// Keeps a reference to `wireframe`, whose arcs are known once they are added.
  Front(const Wireframe& wireframe, std::size_t nodes, std::size_t arcs)
      : w_(wireframe), at_(nodes), nextArm_(2 * arcs, -1), taken_(2 * arcs, 0) {}

  /// Adds a new arc, given by its half-arc in the loop.
  void add(HalfArc h) {
    addArm(w_.start(h), h);
    addArm(w_.end(h), twin(h));
  }
  /// Marks a half-arc as used: no further patch takes it.
  void take(HalfArc h) { taken_[h] = 1; }
  bool isTaken(HalfArc h) const { return taken_[h]; }
  bool isOpen(HalfArc h) const { return !taken_[h] && taken_[twin(h)]; }

  /// Adds a coded patch, whose half-arcs are taken.
  void tell(std::span<const LoopPiece> loop) {
    for (const LoopPiece& piece : loop)
      if (!isTaken(twin(piece.h))) queue_.push_back(twin(piece.h));
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Surroundings& at = at_[w_.start(loop[k].h)];
      if (k > 0 && loop[k].side == loop[k - 1].side)
        at.straight = true;
      else
        ++at.corners;
    }
  }

  /// The open half-arc that has waited longest, or -1.
  HalfArc oldest() {
    while (head_ < queue_.size() && !isOpen(queue_[head_])) ++head_;
    return head_ < queue_.size() ? queue_[head_] : -1;
  }
  /// The open half-arc that has `rank` others before it in the queue, or -1.
  HalfArc waiting(std::uint32_t rank) const {
    return find([&](HalfArc) { return rank-- == 0; });
  }
  /// How many open half-arcs precede an open one in the queue.
  std::uint32_t rankOf(HalfArc open) const {
    std::uint32_t rank = 0;
    find([&](HalfArc h) { return h == open || (++rank, false); });
    return rank;
  }
  /// The first open half-arc in the queue that leaves a node, or -1.
  HalfArc waitingAt(Index node) const {
    return find([&](HalfArc h) { return w_.start(h) == node; });
  }

  /// The first open half-arc that leaves a node, or arrives at it, or -1.
  HalfArc openFrom(Index node) const {
    HalfArc h = firstArm(node);
    for (; h >= 0 && !isOpen(h); ++steps_) h = nextArm_[h];
    return h;
  }
  HalfArc openTo(Index node) const {
    HalfArc h = firstArm(node);
    for (; h >= 0 && !isOpen(twin(h)); ++steps_) h = nextArm_[h];
    return h < 0 ? -1 : twin(h);
  }

  /// Contexts at a node: degree() from its arms and whether a side runs through it, around() from
  /// its corners as well, openCount() from how many open half-arcs leave it.
  std::uint32_t degree(Index node) const {
    return std::min(at_[node].arms, 6u) + (at_[node].straight ? 8 : 0);
  }
  std::uint32_t around(Index node) const {
    return degree(node) + 16 * std::min(at_[node].corners, 7u);
  }
  std::uint32_t openCount(Index node) const {
    std::uint32_t open = 0;
    for (HalfArc h = firstArm(node); h >= 0; h = nextArm_[h], ++steps_) open += isOpen(h);
    return std::min(open, 3u);
  }

  /// Whether the searches took more steps than any sound wireframe needs.
  bool isLost() const { return steps_ > kMostSteps; }

 private:
  static constexpr std::uint64_t kMostSteps = std::uint64_t{1} << 28;  // half a second

  // The half-arcs that leave a node, as a list in the order in which they were added.
  struct Surroundings {
    HalfArc first, last;
    std::uint32_t arms = 0, corners = 0;
    bool straight = false;
  };
  HalfArc firstArm(Index node) const { return at_[node].arms > 0 ? at_[node].first : -1; }
  void addArm(Index node, HalfArc h) {
    Surroundings& at = at_[node];
    (at.arms++ == 0 ? at.first : nextArm_[at.last]) = h;
    at.last = h;
  }

  template <typename IsIt>
  HalfArc find(IsIt isIt) const {
    for (std::size_t at = head_; at < queue_.size(); ++at, ++steps_)
      if (isOpen(queue_[at]) && isIt(queue_[at])) return queue_[at];
    return -1;
  }

  const Wireframe& w_;
  std::vector<Surroundings> at_;  // [nodes]
  std::vector<HalfArc> nextArm_;  // [half-arcs]
  std::vector<char> taken_;       // [half-arcs]
  std::vector<HalfArc> queue_;    // all that were opened; those from head_ on may still be open
  std::size_t head_ = 0;
  mutable std::uint64_t steps_ = 0;  // along arms of nodes and the queue
};

}  // namespace sweepface::codec
