#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "sweepface/surface.hpp"

#include "codec/grid_size.hpp"
#include "codec/loop_images.hpp"
#include "codec/symbols.hpp"

namespace sweepface::codec {

// Numbers take two tags. Those of the other parts of a wireframe are in wireframe_coder.cpp.
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

/// The loops of the patches, one after the other, each glued to those told before it
/// (docs/file-format.md, GRID). Numbers nodes and arcs as they come. Where the mirror image of a
/// patch was told before, it tells what to expect.
template <typename Coder>
class LoopCoder {
 public:
  /// `seeds` are pairs of half-arcs from which the mirror image spreads.
  LoopCoder(Symbols<Coder>& symbols, Wireframe& w, const Wireframe* whole,
            std::span<const std::array<HalfArc, 2>> seeds, std::size_t nodes, std::size_t arcs)
      : s_(symbols),
        w_(w),
        whole_(whole),
        nodeKnown_(nodes, 0),
        arcKnown_(arcs, 0),
        taken_(2 * arcs, 0),
        straight_(nodes, 0),
        corners_(nodes, 0),
        arms_(nodes),
        nextArm_(2 * arcs, -1),
        images_(w, seeds, nodes, arcs) {
    w_.nodes.resize(nodes);
    w_.arcs.resize(arcs);
  }

  void run(std::size_t patches) {
    const std::size_t nodes = w_.nodes.size(), arcs = w_.arcs.size();
    for (Index p = 0; p < static_cast<Index>(patches) && s_.ok(); ++p) codePatch(p);
    if (s_.ok() &&
        (unusedNode() < static_cast<Index>(nodes) || unusedArc() < static_cast<Index>(arcs)))
      s_.refuse("a node or an arc bounds no patch");
  }

 private:
  using Piece = LoopPiece;

  bool isOpen(HalfArc h) const { return arcKnown_[arcOf(h)] && !taken_[h] && taken_[twin(h)]; }
  // The half-arcs that leave a node, in the order in which they came: each knows the next.
  struct Arms {
    HalfArc first, last;
    std::uint32_t count;
  };
  HalfArc firstArm(Index node) const { return arms_[node].count > 0 ? arms_[node].first : -1; }
  void addArm(Index node, HalfArc h) {
    Arms& arms = arms_[node];
    (arms.count++ == 0 ? arms.first : nextArm_[arms.last]) = h;
    arms.last = h;
  }
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
  Index unusedNode() {
    while (nextNode_ < static_cast<Index>(nodeKnown_.size()) && nodeKnown_[nextNode_]) ++nextNode_;
    return nextNode_;
  }
  Index unusedArc() {
    while (nextArc_ < static_cast<Index>(arcKnown_.size()) && arcKnown_[nextArc_]) ++nextArc_;
    return nextArc_;
  }

  // The side from which the loop is told: the one whose first half-arc has waited longest.
  int baseOf(Index p) const {
    int best = 0;
    std::size_t least = queue_.size();
    for (int s = 0; s < 4; ++s) {
      const HalfArc h = whole_->side(p, s)[0];
      if (!isOpen(h)) continue;
      const auto at = static_cast<std::size_t>(
          std::find(queue_.begin() + static_cast<std::ptrdiff_t>(head_), queue_.end(), h) -
          queue_.begin());
      if (at < least) least = at, best = s;
    }
    return best;
  }

  // What has waited longest is where the next patch is glued, unless no patch ever is.
  void dropBorders() {
    while (true) {
      while (head_ < queue_.size() && !isOpen(queue_[head_])) ++head_;
      if (head_ >= queue_.size()) return;
      const HalfArc h = queue_[head_];
      if (!s_.bit(kBorder, degree(w_.start(h)) + 16 * borderHint(h), degree(w_.end(h)),
                  kWrites<Coder> && bordersNothing(h)))
        return;
      taken_[h] = 1;
    }
  }
  bool bordersNothing(HalfArc h) const {
    return std::find(whole_->loops.begin(), whole_->loops.end(), h) == whole_->loops.end();
  }

  void codePatch(Index p) {
    dropBorders();
    std::vector<Piece>&told = told_, &loop = loop_;
    told.clear();
    loop.clear();
    int base = 0;
    if constexpr (kWrites<Coder>) {
      base = baseOf(p);
      for (int s = 0; s < 4; ++s)
        for (const HalfArc h : whole_->side(p, (base + s) % 4)) told.push_back({h, s});
    }
    codeLoop(told, loop);
    if (!s_.ok()) return;
    // Loops are kept as they are told until the turns are known.
    Patch patch;
    patch.sides[0] = static_cast<Index>(w_.loops.size());
    int side = 0;
    for (const Piece& piece : loop) {
      for (; side < piece.side; ++side) patch.sides[side + 1] = static_cast<Index>(w_.loops.size());
      w_.loops.push_back(piece.h);
    }
    patch.sides[4] = static_cast<Index>(w_.loops.size());
    w_.patches.push_back(patch);
    bases.push_back(base);
    for (const Piece& piece : loop)
      if (!taken_[twin(piece.h)]) queue_.push_back(twin(piece.h));
    for (std::size_t k = 1; k < loop.size(); ++k)
      if (loop[k].side == loop[k - 1].side) straight_[w_.start(loop[k].h)] = 1;
    images_.tell(p, loop);
    for (std::size_t k = 0; k < loop.size(); ++k)
      corners_[w_.start(loop[k].h)] += images_.startsSide(loop[k].h);
  }

  // Contexts: 0 where no image tells anything.
  std::uint32_t borderHint(HalfArc open) const {
    const HalfArc image = images_.across(open);
    return image < 0 ? 0 : images_.isTold(image) ? 1 : taken_[image] ? 2 : 3;
  }
  std::uint32_t takeHint(HalfArc candidate) const {
    if (image_ < 0) return 0;
    const HalfArc expected = images_.across(image_);
    return expected < 0 ? 1 : expected == candidate ? 2 : 3;
  }
  std::uint32_t hint(bool expected) const { return image_ < 0 ? 0 : 1 + expected; }
  // The node at which the current half-arc should end.
  Index nodeExpected() const { return image_ < 0 ? -1 : images_.node(w_.start(image_)); }

  void codeLoop(const std::vector<Piece>& told, std::vector<Piece>& loop) {
    std::array<std::int64_t, 4> length{};
    int side = 0;
    start_ = -1;
    const auto askedFor = [&](std::size_t k) { return kWrites<Coder> ? told[k].h : -1; };
    for (std::size_t k = 0; s_.ok(); ++k) {
      const bool lastTold = kWrites<Coder> && k + 1 == told.size();
      const bool corner = kWrites<Coder> && (lastTold || told[k + 1].side != told[k].side);
      const Asked asked{askedFor(k), corner};
      image_ = k == 0 || image_ < 0 ? -1 : images_.before(image_);
      const bool wasKnown = k == 0 ? codeFirst(asked.h) : codeNext(asked.h);
      if (!s_.ok()) return;
      if (const HalfArc image = wasKnown ? images_.of(current_) : -1; image >= 0) image_ = image;
      if (k == 0) start_ = wasKnown ? w_.start(current_) : startOfNew_;
      const bool ends = wasKnown ? endOld(asked, side, length) : endNew(asked, side, length);
      if (!s_.ok()) return;
      if (taken_[current_]) return s_.refuse("an arc is used twice in the same direction");
      if (!kWrites<Coder> && steps_ > kMostSteps)
        return s_.refuse("the patches meet in too few places to be told apart in time");
      taken_[current_] = 1;
      loop.push_back({current_, side});
      if (ends && side == 3) {
        if (w_.end(current_) != start_) s_.refuse("a patch is not closed");
        return;
      }
      side += ends;
      if (loop.size() > 2 * w_.arcs.size()) s_.refuse("a patch is not closed");
    }
  }

  struct Asked {
    HalfArc h;
    bool corner;
  };

  // Sets current_ to a known half-arc and answers true, or prepares for a new one.
  bool codeFirst(HalfArc h) {
    const bool none = head_ >= queue_.size();
    bool fresh = none;
    if (!none) fresh = s_.bit(kFresh, 0, 0, kWrites<Coder> && !isOpen(h));
    if (!fresh) {
      std::uint32_t rank = 0;
      if constexpr (kWrites<Coder>)
        for (std::size_t at = head_; queue_[at] != h; ++at) rank += isOpen(queue_[at]);
      const HalfArc first = queue_[head_], image = images_.of(first);
      rank = s_.number(kRank, image < 0 ? 0 : 1 + images_.startsSide(images_.behind(image)),
                       around(w_.start(first)), rank);
      std::size_t at = head_;
      for (; at < queue_.size(); ++at, ++steps_)
        if (isOpen(queue_[at]) && rank-- == 0) break;
      if (at >= queue_.size()) {
        s_.refuse("a patch is glued to nothing");
        return false;
      }
      current_ = queue_[at];
      return true;
    }
    startOfNew_ = codeNode(kWrites<Coder> ? whole_->start(h) : -1, -1, 3);
    codeNewArc(h);
    return false;
  }

  bool codeNext(HalfArc h) {
    const Index node = end_;
    const HalfArc candidate = openFrom(node);
    if (candidate >= 0 &&
        s_.bit(kTake, openCount(node) + 4 * takeHint(candidate), degree(node), h == candidate)) {
      current_ = candidate;
      return true;
    }
    const bool known = kWrites<Coder> && arcKnown_[arcOf(h)];
    if (s_.bit(kOld, candidate >= 0, 0, known)) {
      current_ = static_cast<HalfArc>(
          s_.index(kOldArc, static_cast<std::uint32_t>(2 * w_.arcs.size()), h));
      if (s_.ok() && (!arcKnown_[arcOf(current_)] || w_.start(current_) != node))
        s_.refuse("a patch is not a closed loop of arcs");
      return true;
    }
    startOfNew_ = node;
    codeNewArc(h);
    return false;
  }

  void codeNewArc(HalfArc h) {
    const Index expected = unusedArc();
    Index arc = kWrites<Coder> ? arcOf(h) : expected;
    if (expected >= static_cast<Index>(w_.arcs.size()))
      return s_.refuse("there are more arcs than announced");
    if (!s_.bit(kNewArc, 0, 0, arc == expected))
      arc = static_cast<Index>(
          s_.index(kNewArcIndex, static_cast<std::uint32_t>(w_.arcs.size()), arc));
    else
      arc = expected;
    if (arcKnown_[arc]) return s_.refuse("an arc comes twice");
    const bool backwards = s_.bit(kBackwards, 0, 0, kWrites<Coder> && (h & 1));
    current_ = 2 * arc + backwards;
  }

  std::uint32_t degree(Index node) const {
    return std::min(arms_[node].count, 6u) + (straight_[node] ? 8 : 0);
  }
  std::uint32_t around(Index node) const {
    return degree(node) + 16 * static_cast<std::uint32_t>(std::min(corners_[node], 7));
  }
  std::uint32_t openCount(Index node) const {
    std::uint32_t open = 0;
    for (HalfArc h = firstArm(node); h >= 0; h = nextArm_[h], ++steps_) open += isOpen(h);
    return std::min(open, 3u);
  }

  // Whether the side ends with the current half-arc. On sides 2 and 3 the lengths of the opposite
  // ones tell.
  bool codeCorner(const Asked& asked, int side, const std::array<std::int64_t, 4>& length,
                  std::uint32_t context, std::uint32_t more) {
    const bool expected = image_ >= 0 && images_.startsSide(image_);
    if (side < 2) return s_.bit(kCorner, context + 32 * hint(expected), more, asked.corner);
    if (length[side] > length[side - 2])
      s_.refuse("a patch has opposite sides of different length");
    return length[side] == length[side - 2];
  }

  bool endOld(const Asked& asked, int side, std::array<std::int64_t, 4>& length) {
    length[side] += w_.arcs[arcOf(current_)].edges;
    end_ = w_.end(current_);
    return codeCorner(asked, side, length, 1 + degree(end_) * 2 + (side == 0), openCount(end_));
  }

  bool endNew(const Asked& asked, int side, std::array<std::int64_t, 4>& length) {
    const Index id = arcOf(current_);
    const Arc* known = kWrites<Coder> ? &whole_->arcs[id] : nullptr;
    Arc arc;
    arc.edges = codeLength(known ? known->edges : 0, side, length);
    const bool expected = image_ >= 0 && w_.arcs[arcOf(image_)].collapsed;
    arc.collapsed = s_.bit(kCollapsed, hint(expected), 0, known && known->collapsed);
    length[side] += arc.edges;
    const bool corner = codeCorner(asked, side, length, 0, side);
    if (!s_.ok()) return false;
    if (corner && side == 3) {
      end_ = start_;
    } else {
      // A node on the way back from the start, where the rest of the loop is as long as it must be.
      std::int64_t rest = -1;
      if (side == 1 && corner) rest = length[0] + length[1];
      if (side == 2) rest = length[0] - length[2] + length[1];
      if (side == 3) rest = length[1] - length[3];
      end_ = codeNode(known ? whole_->end(current_) : -1, rest, side);
    }
    if (!s_.ok()) return false;
    (current_ & 1 ? arc.to : arc.from) = startOfNew_;
    (current_ & 1 ? arc.from : arc.to) = end_;
    w_.arcs[id] = arc;
    arcKnown_[id] = 1;
    addArm(startOfNew_, current_);
    addArm(end_, twin(current_));
    return corner;
  }

  Index codeLength(Index edges, int side, const std::array<std::int64_t, 4>& length) {
    const std::int64_t remaining = side < 2 ? 0 : length[side - 2] - length[side];
    const std::int64_t image = image_ < 0 ? 0 : w_.arcs[arcOf(image_)].edges;
    if (side >= 2 && s_.bit(kRemaining,
                            static_cast<std::uint32_t>(std::min<std::int64_t>(remaining, 9)) +
                                16 * hint(image == remaining),
                            side, edges == remaining))
      return checkedLength(remaining, kLongestArc);
    const auto context =
        static_cast<std::uint32_t>(image > 0   ? 16 + std::min<std::int64_t>(image, 15)
                                   : side == 0 ? 0
                                               : 1 + std::min<std::int64_t>(length[side - 1], 8));
    return checkedLength(
        1 + std::int64_t{s_.number(kLength, context, side,
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
    if (candidate >= 0 && s_.bit(kMeets, side + 4 * (image_ < 0 ? 0 : 1 + meets), around(candidate),
                                 node == candidate))
      return candidate;
    const bool known = kWrites<Coder> && nodeKnown_[node];
    const auto nodes = static_cast<std::uint32_t>(nodeKnown_.size());
    if (s_.bit(kOldNode, side + 4 * hint(mirrored >= 0), candidate >= 0, known)) {
      if (mirrored >= 0 && s_.bit(kMirrored, 0, 0, node == mirrored)) return mirrored;
      const Index waiting = codeWaiting(node);
      const Index found =
          waiting >= 0 ? waiting : static_cast<Index>(s_.index(kOldNodeIndex, nodes, node));
      if (s_.ok() && !nodeKnown_[found]) s_.refuse("an arc ends at a node that does not exist");
      return found;
    }
    const Index expected = unusedNode();
    if (expected >= static_cast<Index>(nodes)) {
      s_.refuse("there are more nodes than announced");
      return 0;
    }
    Index fresh = expected;
    if (!s_.bit(kNewNode, 0, 0, node == expected))
      fresh = static_cast<Index>(s_.index(kNewNodeIndex, nodes, node));
    if (nodeKnown_[fresh]) s_.refuse("a node comes twice");
    nodeKnown_[fresh] = 1;
    return fresh;
  }

  // A node from which an open half-arc leaves, by how many have waited longer; -1 if there is none.
  Index codeWaiting(Index node) {
    const auto waiting = [&](const auto& isIt) {
      std::uint32_t place = 0;
      for (std::size_t at = head_; at < queue_.size(); ++at, ++steps_)
        if (isOpen(queue_[at]) && isIt(++place, w_.start(queue_[at]))) return place;
      return std::uint32_t{0};
    };
    std::uint32_t told = 0;
    if constexpr (kWrites<Coder>) told = waiting([&](auto, Index start) { return start == node; });
    told = s_.number(kWaiting, 0, 0, told);
    Index found = -1;
    if (told > 0 && waiting([&](std::uint32_t place, Index start) {
                      found = start;
                      return place == told;
                    }) == 0)
      s_.refuse("an arc ends at a node that does not exist");
    return found;
  }

  // Back along what is open from the start of the loop.
  Index nodeBefore(std::int64_t rest) const {
    if (rest <= 0 || start_ < 0) return -1;
    Index node = start_;
    for (int steps = 0; rest > 0 && steps < 64; ++steps) {
      const HalfArc h = openTo(node);
      if (h < 0) return -1;
      rest -= w_.arcs[arcOf(h)].edges;
      node = w_.start(h);
    }
    return rest == 0 ? node : -1;
  }

 public:
  std::vector<int> bases;  // [patches] the side of the patch from which its loop was told

 private:
  Symbols<Coder>& s_;
  Wireframe& w_;
  const Wireframe* whole_;
  std::vector<char> nodeKnown_, arcKnown_, taken_, straight_;
  std::vector<int> corners_;        // [nodes] of patches that were told
  std::vector<Arms> arms_;          // [nodes]
  std::vector<HalfArc> nextArm_;    // [half-arcs]
  std::vector<Piece> told_, loop_;  // of the patch that is being coded
  LoopImages images_;
  HalfArc image_ = -1;  // mirrors the half-arc at hand, in a loop that was told
  std::vector<HalfArc> queue_;
  std::size_t head_ = 0;
  static constexpr std::uint64_t kMostSteps = std::uint64_t{1} << 28;  // half a second of searching
  mutable std::uint64_t steps_ = 0;  // along arms of nodes and the queue
  Index nextNode_ = 0, nextArc_ = 0;
  HalfArc current_ = -1;
  Index start_ = -1, end_ = -1, startOfNew_ = -1;
};

}  // namespace sweepface::codec
