#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "sweepface/surface.hpp"

#include "codec/front.hpp"
#include "codec/grid_size.hpp"
#include "codec/loop_images.hpp"
#include "codec/numbers.hpp"
#include "codec/symbols.hpp"
#include "surface/wireframe_checks.hpp"

namespace sweepface::codec {

// Numbers take two tags. The tags of the other parts of a wireframe are in wireframe_coder.cpp.
enum LoopTag : std::uint32_t {
  kFresh = 2,
  kRank = 3,
  kTake = 5,
  kOld = 6,
  kOldArc = 7,
  kNewArc = 8,
  kNewArcIndex = 9,
  kBackwards = 10,
  kRemaining = 11,
  kLength = 12,
  kCollapsed = 14,
  kCorner = 15,
  kMeets = 16,
  kOldNode = 17,
  kOldNodeIndex = 18,
  kNewNode = 19,
  kNewNodeIndex = 20,
  kBorder = 36,
  kMirrored = 39,
  kWaiting = 56
};

/// Codes the loops of the patches one after another, each glued to earlier patches
/// (docs/file-format.md, GRID). Nodes and arcs are numbered as they come. A patch is predicted from
/// its mirror image if that was coded before.
template <typename Coder>
class LoopCoder {
 public:
  /// `seeds` are pairs of half-arcs from which the mirror spreads.
  LoopCoder(Symbols<Coder>& symbols, Wireframe& w, const Wireframe* whole,
            std::span<const std::array<HalfArc, 2>> seeds, std::size_t nodes, std::size_t arcs)
      : s_(symbols),
        w_(w),
        whole_(whole),
        nodes_(nodes),
        arcs_(arcs),
        front_(w, nodes, arcs),
        images_(w, seeds, nodes, arcs) {
    w_.nodes.resize(nodes);
    w_.arcs.resize(arcs);
    if constexpr (kWrites<Coder>) {
      bounds_.resize(2 * arcs);
      for (const HalfArc h : whole_->loops) bounds_[h] = true;
    }
  }

  void run(std::size_t patches) {
    for (Index p = 0; p < static_cast<Index>(patches) && s_.ok(); ++p) codePatch(p);
    if (s_.ok() && (nodes_.next() < nodes_.count() || arcs_.next() < arcs_.count()))
      s_.refuse("a node or an arc bounds no patch");
  }

  std::vector<int> bases;  // [patches] the side at which the loop of the patch begins

 private:
  // What the writer codes: a half-arc, and whether its side ends there.
  struct Told {
    HalfArc h = -1;
    bool corner = false;
  };

  // The side at which the loop begins: the one whose first half-arc has waited longest.
  int baseOf(Index p) const {
    int best = 0;
    std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
    for (int s = 0; s < 4; ++s) {
      const HalfArc h = whole_->side(p, s)[0];
      if (!front_.isOpen(h)) continue;
      if (const std::uint32_t rank = front_.rankOf(h); rank < least) least = rank, best = s;
    }
    return best;
  }

  // Drops the half-arcs that have waited longest and bound no patch, up to the first that a patch
  // will be glued to.
  void dropBorders() {
    for (HalfArc h = front_.oldest(); h >= 0; h = front_.oldest()) {
      const std::uint32_t start = front_.degree(w_.start(h)), end = front_.degree(w_.end(h));
      if (!s_.bit(kBorder, start + 16 * borderHint(h), end, bordersNothing(h))) return;
      front_.take(h);
    }
  }
  bool bordersNothing(HalfArc h) const {
    if constexpr (kWrites<Coder>) return !bounds_[h];
    return false;
  }

  void codePatch(Index p) {
    dropBorders();
    told_.clear();
    loop_.clear();
    int base = 0;
    if constexpr (kWrites<Coder>) {
      base = baseOf(p);
      for (int s = 0; s < 4; ++s) {
        for (const HalfArc h : whole_->side(p, (base + s) % 4)) told_.push_back({h, false});
        told_.back().corner = true;
      }
    }
    codeLoop();
    if (!s_.ok()) return;
    // Loops are kept as coded until the turns are known.
    Patch patch;
    patch.sides[0] = static_cast<Index>(w_.loops.size());
    int side = 0;
    for (const LoopPiece& piece : loop_) {
      for (; side < piece.side; ++side) patch.sides[side + 1] = static_cast<Index>(w_.loops.size());
      w_.loops.push_back(piece.h);
    }
    patch.sides[4] = static_cast<Index>(w_.loops.size());
    w_.patches.push_back(patch);
    bases.push_back(base);
    front_.tell(loop_);
    images_.tell(p, loop_);
  }

  // Contexts: 0 where there is no image to predict from.
  std::uint32_t borderHint(HalfArc open) const {
    const HalfArc image = images_.across(open);
    return image < 0 ? 0 : images_.isTold(image) ? 1 : front_.isTaken(image) ? 2 : 3;
  }
  std::uint32_t takeHint(HalfArc candidate) const {
    if (image_ < 0) return 0;
    const HalfArc expected = images_.across(image_);
    return expected < 0 ? 1 : expected == candidate ? 2 : 3;
  }
  std::uint32_t hint(bool expected) const { return image_ < 0 ? 0 : 1 + expected; }
  // The node at which the current half-arc should end.
  Index nodeExpected() const { return image_ < 0 ? -1 : images_.node(w_.start(image_)); }

  void codeLoop() {
    length_ = {};
    side_ = 0;
    start_ = -1;
    for (std::size_t k = 0; s_.ok(); ++k) {
      const Told told = kWrites<Coder> ? told_[k] : Told{};
      image_ = k == 0 || image_ < 0 ? -1 : images_.before(image_);
      const bool wasKnown = k == 0 ? codeFirst(told.h) : codeNext(told.h);
      if (!s_.ok()) return;
      if (const HalfArc image = wasKnown ? images_.of(current_) : -1; image >= 0) image_ = image;
      if (k == 0) start_ = wasKnown ? w_.start(current_) : startOfNew_;
      const bool ends = wasKnown ? endOld(told.corner) : endNew(told.corner);
      if (!s_.ok()) return;
      if (front_.isTaken(current_)) return s_.refuse("an arc is used twice in the same direction");
      if (!kWrites<Coder> && front_.isLost())
        return s_.refuse("the patches meet in too few places to be told apart in time");
      front_.take(current_);
      loop_.push_back({current_, side_});
      if (ends && side_ == 3) {
        if (w_.end(current_) != start_) s_.refuse("a patch is not closed");
        return;
      }
      side_ += ends;
      if (!kWrites<Coder> && loop_.size() >= kMostArcsAround)
        s_.refuse("a patch has too many arcs around it");
    }
  }

  // Sets current_ to a known half-arc and returns true, or to one of a new arc and returns false.
  bool codeFirst(HalfArc h) {
    const HalfArc first = front_.oldest();
    if (first >= 0 && !s_.bit(kFresh, 0, 0, kWrites<Coder> && !front_.isOpen(h))) {
      const HalfArc image = images_.of(first);
      const std::uint32_t rank =
          s_.number(kRank, image < 0 ? 0 : 1 + images_.startsSide(images_.behind(image)),
                    front_.around(w_.start(first)), kWrites<Coder> ? front_.rankOf(h) : 0);
      current_ = front_.waiting(rank);
      if (current_ < 0) s_.refuse("a patch is glued to nothing");
      return true;
    }
    startOfNew_ = codeNode(kWrites<Coder> ? whole_->start(h) : -1, -1, 3);
    codeNewArc(h);
    return false;
  }

  bool codeNext(HalfArc h) {
    const Index node = end_;
    const HalfArc candidate = front_.openFrom(node);
    if (candidate >= 0 && s_.bit(kTake, front_.openCount(node) + 4 * takeHint(candidate),
                                 front_.degree(node), h == candidate)) {
      current_ = candidate;
      return true;
    }
    const bool known = kWrites<Coder> && arcs_.has(arcOf(h));
    if (s_.bit(kOld, candidate >= 0, 0, known)) {
      current_ = static_cast<HalfArc>(
          s_.index(kOldArc, static_cast<std::uint32_t>(2 * w_.arcs.size()), h));
      if (s_.ok() && (!arcs_.has(arcOf(current_)) || w_.start(current_) != node))
        s_.refuse("a patch is not a closed loop of arcs");
      return true;
    }
    startOfNew_ = node;
    codeNewArc(h);
    return false;
  }

  void codeNewArc(HalfArc h) {
    const Index arc = codeNew(arcs_, kNewArc, kNewArcIndex, kWrites<Coder> ? arcOf(h) : -1,
                              "there are more arcs than announced", "an arc comes twice");
    current_ = 2 * arc + s_.bit(kBackwards, 0, 0, kWrites<Coder> && (h & 1));
  }
  // The number of a new node or arc, as a rule the next free one.
  Index codeNew(Numbers& numbers, LoopTag isNext, LoopTag which, Index number, const char* tooMany,
                const char* twice) {
    const Index expected = numbers.next();
    if (expected == numbers.count()) {
      s_.refuse(tooMany);
      return 0;
    }
    const bool next = s_.bit(isNext, 0, 0, number == expected);
    number = next ? expected : static_cast<Index>(s_.index(which, numbers.count(), number));
    if (numbers.has(number)) s_.refuse(twice);
    numbers.take(number);
    return number;
  }

  // Whether the side ends with the current half-arc. On sides 2 and 3 this follows from the length
  // of the opposite side.
  bool codeCorner(bool told, std::uint32_t context, std::uint32_t more) {
    const bool expected = image_ >= 0 && images_.startsSide(image_);
    if (side_ < 2) return s_.bit(kCorner, context + 32 * hint(expected), more, told);
    if (length_[side_] > length_[side_ - 2])
      s_.refuse("a patch has opposite sides of different length");
    return length_[side_] == length_[side_ - 2];
  }

  bool endOld(bool corner) {
    length_[side_] += w_.arcs[arcOf(current_)].edges;
    end_ = w_.end(current_);
    return codeCorner(corner, 1 + front_.degree(end_) * 2 + (side_ == 0), front_.openCount(end_));
  }

  bool endNew(bool corner) {
    const Index id = arcOf(current_);
    const Arc* known = kWrites<Coder> ? &whole_->arcs[id] : nullptr;
    Arc arc;
    arc.edges = codeLength(known ? known->edges : 0);
    const bool expected = image_ >= 0 && w_.arcs[arcOf(image_)].collapsed;
    arc.collapsed = s_.bit(kCollapsed, hint(expected), 0, known && known->collapsed);
    length_[side_] += arc.edges;
    corner = codeCorner(corner, 0, side_);
    if (!s_.ok()) return false;
    if (corner && side_ == 3) {
      end_ = start_;
    } else {
      // Look for a node on the way back from the start at which the rest of the loop has the right
      // length.
      std::int64_t rest = -1;
      if (side_ == 1 && corner) rest = length_[0] + length_[1];
      if (side_ == 2) rest = length_[0] - length_[2] + length_[1];
      if (side_ == 3) rest = length_[1] - length_[3];
      end_ = codeNode(known ? whole_->end(current_) : -1, rest, side_);
    }
    if (!s_.ok()) return false;
    (current_ & 1 ? arc.to : arc.from) = startOfNew_;
    (current_ & 1 ? arc.from : arc.to) = end_;
    w_.arcs[id] = arc;
    front_.add(current_);
    return corner;
  }

  Index codeLength(Index edges) {
    const std::int64_t remaining = side_ < 2 ? 0 : length_[side_ - 2] - length_[side_];
    const std::int64_t image = image_ < 0 ? 0 : w_.arcs[arcOf(image_)].edges;
    if (side_ >= 2 && s_.bit(kRemaining,
                             static_cast<std::uint32_t>(std::min<std::int64_t>(remaining, 9)) +
                                 16 * hint(image == remaining),
                             side_, edges == remaining))
      return checkedLength(remaining, kLongestArc);
    const auto context = static_cast<std::uint32_t>(
        image > 0    ? 16 + std::min<std::int64_t>(image, 15)
        : side_ == 0 ? 0
                     : 1 + std::min<std::int64_t>(length_[side_ - 1], 8));
    return checkedLength(
        1 + std::int64_t{s_.number(kLength, context, side_,
                                   static_cast<std::uint64_t>(std::max(0, edges - 1)))},
        kLongestArc);
  }
  Index checkedLength(std::int64_t edges, Index longest) {
    if (edges >= 1 && edges <= longest) return static_cast<Index>(edges);
    s_.refuse("the length of an arc is out of range");
    return 1;
  }

  // The end of a new arc: a node that is `rest` before the start, any other old one, or a new one.
  Index codeNode(Index node, std::int64_t rest, int side) {
    const Index candidate = nodeBefore(rest), mirrored = nodeExpected();
    const std::uint32_t meets = mirrored < 0 ? 0 : mirrored == candidate ? 1 : 2;
    if (candidate >= 0 && s_.bit(kMeets, side + 4 * (image_ < 0 ? 0 : 1 + meets),
                                 front_.around(candidate), node == candidate))
      return candidate;
    const bool known = kWrites<Coder> && nodes_.has(node);
    if (s_.bit(kOldNode, side + 4 * hint(mirrored >= 0), candidate >= 0, known)) {
      if (mirrored >= 0 && s_.bit(kMirrored, 0, 0, node == mirrored)) return mirrored;
      const Index waiting = codeWaiting(node);
      const Index found = waiting >= 0
                              ? waiting
                              : static_cast<Index>(s_.index(kOldNodeIndex, nodes_.count(), node));
      if (s_.ok() && !nodes_.has(found)) s_.refuse("an arc ends at a node that does not exist");
      return found;
    }
    return codeNew(nodes_, kNewNode, kNewNodeIndex, node, "there are more nodes than announced",
                   "a node comes twice");
  }

  // A node that an open half-arc leaves, coded by the place of that half-arc in the queue; -1 if
  // there is none.
  Index codeWaiting(Index node) {
    HalfArc h = kWrites<Coder> ? front_.waitingAt(node) : -1;
    const std::uint32_t place = s_.number(kWaiting, 0, 0, h < 0 ? 0 : 1 + front_.rankOf(h));
    if (place == 0) return -1;
    h = front_.waiting(place - 1);
    if (h < 0) s_.refuse("an arc ends at a node that does not exist");
    return h < 0 ? -1 : w_.start(h);
  }

  // The node `rest` edges back from the start of the loop along open half-arcs, or -1.
  Index nodeBefore(std::int64_t rest) const {
    if (rest <= 0 || start_ < 0) return -1;
    Index node = start_;
    for (int steps = 0; rest > 0 && steps < 64; ++steps) {
      const HalfArc h = front_.openTo(node);
      if (h < 0) return -1;
      rest -= w_.arcs[arcOf(h)].edges;
      node = w_.start(h);
    }
    return rest == 0 ? node : -1;
  }

  Symbols<Coder>& s_;
  Wireframe& w_;
  const Wireframe* whole_;
  Numbers nodes_, arcs_;  // which ones are known
  Front front_;
  LoopImages images_;
  std::vector<Told> told_;  // of the current patch
  // [half-arcs] Writer only: whether each bounds a patch.
  struct None {};
  [[no_unique_address]] std::conditional_t<kWrites<Coder>, std::vector<bool>, None> bounds_;
  std::vector<LoopPiece> loop_;
  std::array<std::int64_t, 4> length_{};  // [sides] lengths coded so far, in source edges
  int side_ = 0;
  Index start_ = -1;      // where the loop starts
  HalfArc image_ = -1;    // the mirror image of the current half-arc, in an earlier loop
  HalfArc current_ = -1;  // the current half-arc
  Index startOfNew_ = -1, end_ = -1;
};

}  // namespace sweepface::codec
