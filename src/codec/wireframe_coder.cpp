#include "codec/wireframe_coder.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

namespace sweepface::codec {

namespace {

// What is coded; numbers take two tags.
enum Tag : std::uint32_t {
  kCounts = 0,
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
  kTurn = 21,
  kHalfTurn = 22,
  kAsExpected = 23,
  kPoint = 24,
  kRibbon = 26,
  kMask = 28,
  kShaped = 29,
  kShapeForm = 30,
  kShapeSize = 31,
  kShapeLength = 33,
  kShapeRaw = 35,
  kBorder = 36,
  kHasCreases = 37,
  kCrease = 38
};

class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size), size_(size, 1) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  Index find(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(Index a, Index b) {
    a = find(a), b = find(b);
    if (a == b) return;
    if (a > b) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
  }
  Index size(Index a) { return size_[find(a)]; }

 private:
  std::vector<Index> parent_, size_;
};

// ---- What usually holds, and is told only where it does not ----

// The arcs at T-nodes that run straight on: a T-node is where a patch's side has a node inside.
void joinRails(const Wireframe& w, Sets& sets) {
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p)
    for (int s = 0; s < 4; ++s) {
      const auto side = w.side(p, s);
      for (std::size_t k = 1; k < side.size(); ++k) sets.join(arcOf(side[k - 1]), arcOf(side[k]));
    }
}

// Whether a patch sweeps along the other pair of its sides than the one its loop begins with: the
// way that joins smaller sets of arcs that share their shape parameters.
struct SweepRule {
  explicit SweepRule(const Wireframe& wireframe) : w(wireframe), sets(wireframe.arcs.size()) {
    joinRails(w, sets);
  }
  Index first(Index patch, int s) const { return arcOf(w.side(patch, s & 3)[0]); }
  bool turns(Index patch, int base) {
    const auto cost = [&](int s) {
      const Index a = sets.find(first(patch, base + s)), b = sets.find(first(patch, base + s + 2));
      return a == b ? 0 : sets.size(a) + sets.size(b);
    };
    return cost(1) < cost(0);
  }
  void sweep(Index patch) { sets.join(first(patch, 0), first(patch, 2)); }

  const Wireframe& w;
  Sets sets;
};

// One ribbon a set, numbered by their first arcs.
std::vector<Index> expectedRibbons(const Wireframe& w) {
  SweepRule rule(w);
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p) rule.sweep(p);
  std::vector<Index> ribbon(w.arcs.size(), -1), result(w.arcs.size());
  Index count = 0;
  for (Index a = 0; a < static_cast<Index>(w.arcs.size()); ++a) {
    Index& r = ribbon[rule.sets.find(a)];
    if (r < 0) r = count++;
    result[a] = r;
  }
  return result;
}

// One point a node, numbered as the nodes; nodes joined by collapsed arcs share theirs; T-nodes
// have none.
std::vector<Index> expectedPoints(const Wireframe& w, std::size_t nodes) {
  Sets sets(nodes);
  std::vector<char> hanging(nodes, 0);
  for (Index p = 0; p < static_cast<Index>(w.patches.size()); ++p)
    for (int s = 0; s < 4; ++s)
      for (std::size_t k = 1; k < w.side(p, s).size(); ++k) hanging[w.start(w.side(p, s)[k])] = 1;
  for (const Arc& arc : w.arcs)
    if (arc.collapsed) sets.join(arc.from, arc.to);
  std::vector<Index> ofSet(nodes, -1), result(nodes, -1);
  Index count = 0;
  for (Index n = 0; n < static_cast<Index>(nodes); ++n) {
    if (hanging[n]) continue;
    Index& point = ofSet[sets.find(n)];
    if (point < 0) point = count++;
    result[n] = point;
  }
  return result;
}

// How many derivatives the lengths of a node's lines speak for, along both of its axes: context
// for what it stores.
std::uint32_t lineClass(const Wireframe& w, const Connectivity& c, Index node, int axis) {
  const Star& star = c.stars[node];
  if (c.kinds[node] != NodeKind::crossing) return 15;
  std::int64_t reach[2] = {1, 1};  // in half edges
  int arms = 0;
  for (std::size_t k = static_cast<std::size_t>(axis); k < star.arms.size() && k < 4; k += 2) {
    const Rail& rail = c.rails[star.arms[k]];
    reach[arms++] =
        c.kinds[w.end(rail.last)] == NodeKind::hanging ? 2 * rail.edges - 1 : rail.edges;
  }
  const std::int64_t shorter = std::min(reach[0], reach[1]), longer = std::max(reach[0], reach[1]);
  const std::int64_t own = arms < 2 ? shorter + longer : shorter + std::min(longer, 3 * shorter);
  const std::uint32_t count = own < 4 ? 1 : own < 6 ? 2 : 3;
  return arms < 2 ? 4 + std::max(2u, count) : count;
}

// ---- The loops ----

template <typename Coder>
class LoopCoder {
 public:
  LoopCoder(Symbols<Coder>& symbols, Wireframe& w, const Wireframe* whole)
      : s_(symbols), w_(w), whole_(whole) {}

  void run(std::size_t nodes, std::size_t arcs, std::size_t patches) {
    nodeKnown_.assign(nodes, 0);
    arms_.resize(nodes);
    w_.nodes.resize(nodes);
    w_.arcs.resize(arcs);
    arcKnown_.assign(arcs, 0);
    taken_.assign(2 * arcs, 0);
    straight_.assign(nodes, 0);
    for (Index p = 0; p < static_cast<Index>(patches) && s_.ok(); ++p) codePatch(p);
    if (s_.ok() &&
        (unusedNode() < static_cast<Index>(nodes) || unusedArc() < static_cast<Index>(arcs)))
      s_.refuse("a node or an arc bounds no patch");
  }

 private:
  struct Piece {
    HalfArc h;
    int side;
  };

  bool isOpen(HalfArc h) const { return arcKnown_[arcOf(h)] && !taken_[h] && taken_[twin(h)]; }
  HalfArc openFrom(Index node) const {
    for (const HalfArc h : arms_[node])
      if (isOpen(h)) return h;
    return -1;
  }
  HalfArc openTo(Index node) const {
    for (const HalfArc h : arms_[node])
      if (isOpen(twin(h))) return twin(h);
    return -1;
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
      if (!s_.bit(kBorder, degree(w_.start(h)), degree(w_.end(h)),
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
    std::vector<Piece> told;
    int base = 0;
    if constexpr (kWrites<Coder>) {
      base = baseOf(p);
      for (int s = 0; s < 4; ++s)
        for (const HalfArc h : whole_->side(p, (base + s) % 4)) told.push_back({h, s});
    }
    std::vector<Piece> loop;
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
  }

  void codeLoop(const std::vector<Piece>& told, std::vector<Piece>& loop) {
    std::array<std::int64_t, 4> length{};
    int side = 0;
    start_ = -1;
    const auto askedFor = [&](std::size_t k) { return kWrites<Coder> ? told[k].h : -1; };
    for (std::size_t k = 0; s_.ok(); ++k) {
      const bool lastTold = kWrites<Coder> && k + 1 == told.size();
      const bool corner = kWrites<Coder> && (lastTold || told[k + 1].side != told[k].side);
      const Asked asked{askedFor(k), corner};
      const bool wasKnown = k == 0 ? codeFirst(asked.h) : codeNext(asked.h);
      if (!s_.ok()) return;
      if (k == 0) start_ = wasKnown ? w_.start(current_) : startOfNew_;
      const bool ends = wasKnown ? endOld(asked, side, length) : endNew(asked, side, length);
      if (!s_.ok()) return;
      if (taken_[current_]) return s_.refuse("an arc is used twice in the same direction");
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
      rank = s_.number(kRank, 0, 0, rank);
      std::size_t at = head_;
      for (; at < queue_.size(); ++at)
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
    if (candidate >= 0 && s_.bit(kTake, openCount(node), degree(node), h == candidate)) {
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
    return static_cast<std::uint32_t>(std::min<std::size_t>(arms_[node].size(), 6)) +
           (straight_[node] ? 8 : 0);
  }
  std::uint32_t openCount(Index node) const {
    std::uint32_t open = 0;
    for (const HalfArc h : arms_[node]) open += isOpen(h);
    return std::min(open, 3u);
  }

  // Whether the side ends with the current half-arc. On sides 2 and 3 the lengths of the opposite
  // ones tell.
  bool codeCorner(const Asked& asked, int side, const std::array<std::int64_t, 4>& length,
                  std::uint32_t context, std::uint32_t more) {
    if (side < 2) return s_.bit(kCorner, context, more, asked.corner);
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
    arc.collapsed = s_.bit(kCollapsed, 0, 0, known && known->collapsed);
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
    arms_[startOfNew_].push_back(current_);
    arms_[end_].push_back(twin(current_));
    return corner;
  }

  Index codeLength(Index edges, int side, const std::array<std::int64_t, 4>& length) {
    constexpr Index kLongest = 65535;
    const std::int64_t remaining = side < 2 ? 0 : length[side - 2] - length[side];
    if (side >= 2 &&
        s_.bit(kRemaining, static_cast<std::uint32_t>(std::min<std::int64_t>(remaining, 9)), side,
               edges == remaining))
      return checkedLength(remaining, kLongest);
    const auto context =
        static_cast<std::uint32_t>(side == 0 ? 0 : 1 + std::min<std::int64_t>(length[side - 1], 8));
    return checkedLength(
        1 + std::int64_t{s_.number(kLength, context, side,
                                   static_cast<std::uint64_t>(std::max(0, edges - 1)))},
        kLongest);
  }
  Index checkedLength(std::int64_t edges, Index longest) {
    if (edges >= 1 && edges <= longest) return static_cast<Index>(edges);
    s_.refuse("the length of an arc is out of range");
    return 1;
  }

  // The end of a new arc: a node that is `rest` before the start, any other old one, or a new one.
  Index codeNode(Index node, std::int64_t rest, int side) {
    const Index candidate = nodeBefore(rest);
    if (candidate >= 0 && s_.bit(kMeets, side, 0, node == candidate)) return candidate;
    const bool known = kWrites<Coder> && nodeKnown_[node];
    const auto nodes = static_cast<std::uint32_t>(nodeKnown_.size());
    if (s_.bit(kOldNode, side, candidate >= 0, known)) {
      const auto found = static_cast<Index>(s_.index(kOldNodeIndex, nodes, node));
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
  std::vector<std::vector<HalfArc>> arms_;
  std::vector<HalfArc> queue_;
  std::size_t head_ = 0;
  Index nextNode_ = 0, nextArc_ = 0;
  HalfArc current_ = -1;
  Index start_ = -1, end_ = -1, startOfNew_ = -1;
};

// Turns the loop of a patch so that the side `base` comes first.
void turn(Wireframe& w, Index patch, int base) {
  auto& sides = w.patches[patch].sides;
  const std::array<Index, 5> old = sides;
  const Index begin = old[0];
  std::rotate(w.loops.begin() + begin, w.loops.begin() + old[base], w.loops.begin() + old[4]);
  for (int s = 0; s < 4; ++s) {
    const int from = (base + s) % 4;
    sides[s + 1] = sides[s] + old[from + 1] - old[from];
  }
}

template <typename Coder>
class WireframeCoder {
 public:
  WireframeCoder(Symbols<Coder>& symbols, const Wireframe* whole) : s_(symbols), whole_(whole) {}

  Wireframe run(std::size_t most, std::int64_t mostQuads) {
    const std::size_t nodes = count(whole_ ? whole_->nodes.size() : 0, most),
                      arcs = count(whole_ ? whole_->arcs.size() : 0, most),
                      patches = count(whole_ ? whole_->patches.size() : 0, most);
    if (!s_.ok()) return {};
    LoopCoder<Coder> loops(s_, w_, whole_);
    loops.run(nodes, arcs, patches);
    if (!s_.ok() || !isSmallEnough(mostQuads)) return {};
    codeTurns(loops.bases);
    codePoints();
    codeRibbons();
    codeCreases();
    if (s_.ok()) codeMasks();
    if (s_.ok()) codeShapes();
    return std::move(w_);
  }

 private:
  std::size_t count(std::size_t value, std::size_t most) {
    const std::size_t n = s_.number(kCounts, 0, 0, value);
    if (n > most) s_.refuse("the wireframe is larger than its bytes or the memory allow");
    return n;
  }

  bool isSmallEnough(std::int64_t mostQuads) {
    std::int64_t quads = 0;
    for (const Arc& arc : w_.arcs) quads += arc.edges;
    for (Index p = 0; p < static_cast<Index>(w_.patches.size()); ++p) {
      std::int64_t m = 0, n = 0;
      for (const HalfArc h : w_.side(p, 0)) m += w_.arcs[arcOf(h)].edges;
      for (const HalfArc h : w_.side(p, 1)) n += w_.arcs[arcOf(h)].edges;
      if (m > mostQuads || n > mostQuads || quads > mostQuads) break;
      quads += m * n;
    }
    if (quads > mostQuads) s_.refuse("the patches have too many vertices");
    return quads <= mostQuads;
  }

  // Every loop was told from side `base` of the patch on: side 4 - base of the loop comes first.
  void codeTurns(const std::vector<int>& bases) {
    SweepRule rule(w_);
    for (Index p = 0; p < static_cast<Index>(w_.patches.size()); ++p) {
      const bool expected = rule.turns(p, 0);
      const int first = (4 - bases[p]) % 4;
      const bool odd = s_.bit(kTurn, expected, 0, first % 2);
      const bool half = s_.bit(kHalfTurn, odd, 0, first / 2);
      turn(w_, p, 2 * half + odd);
      rule.sweep(p);
    }
  }

  void codePoints() {
    const std::vector<Index> expected = expectedPoints(w_, w_.nodes.size());
    const auto told = [&](std::size_t n) { return whole_ ? whole_->nodes[n].point : -1; };
    bool same = true;
    for (std::size_t n = 0; n < expected.size(); ++n) same &= told(n) == expected[n];
    same = s_.bit(kAsExpected, 0, 0, same);
    for (std::size_t n = 0; n < expected.size() && s_.ok(); ++n) {
      Index point = expected[n];
      if (!same)
        point = expected[n] + s_.signedNumber(kPoint, 0, 0, std::int64_t{told(n)} - expected[n]);
      if (point < -1 || point >= static_cast<Index>(expected.size()))
        s_.refuse("a node stands at a point that does not exist");
      w_.nodes[n].point = point;
      w_.points = std::max(w_.points, point + 1);
    }
    for (const Arc& arc : w_.arcs)
      if (arc.collapsed &&
          (w_.nodes[arc.from].point < 0 || w_.nodes[arc.from].point != w_.nodes[arc.to].point))
        s_.refuse("a collapsed arc joins two points");
    const auto extra = s_.number(kCounts, 1, 0, whole_ ? whole_->points - w_.points : 0);
    if (extra > expected.size()) return s_.refuse("there are more points than nodes");
    w_.points += static_cast<Index>(extra);
  }

  void codeRibbons() {
    const std::vector<Index> expected = expectedRibbons(w_);
    const auto told = [&](std::size_t a) { return whole_ ? whole_->arcs[a].ribbon : -1; };
    bool same = true;
    for (std::size_t a = 0; a < expected.size(); ++a) same &= told(a) == expected[a];
    same = s_.bit(kAsExpected, 1, 0, same);
    Index most = -1;
    for (std::size_t a = 0; a < expected.size() && s_.ok(); ++a) {
      Index ribbon = expected[a];
      if (!same) ribbon += s_.signedNumber(kRibbon, 0, 0, std::int64_t{told(a)} - expected[a]);
      if (ribbon < 0 || ribbon >= static_cast<Index>(expected.size()))
        s_.refuse("an arc belongs to a ribbon that does not exist");
      w_.arcs[a].ribbon = ribbon;
      most = std::max(most, ribbon);
    }
    const auto extra = s_.number(
        kCounts, 2, 0, whole_ ? static_cast<Index>(whole_->ribbons.size()) - most - 1 : 0);
    if (extra > expected.size()) return s_.refuse("there are more ribbons than arcs");
    if (s_.ok()) w_.ribbons.resize(static_cast<std::size_t>(most) + 1 + extra);
  }

  void codeCreases() {
    const bool any =
        whole_ && std::ranges::find(whole_->arcs, true, &Arc::crease) != whole_->arcs.end();
    if (!s_.bit(kHasCreases, 0, 0, any)) return;
    bool last = false;
    for (std::size_t a = 0; a < w_.arcs.size() && s_.ok(); ++a)
      w_.arcs[a].crease = last = s_.bit(kCrease, last, 0, whole_ && whole_->arcs[a].crease);
  }

  // A set that is closed downwards, component by component.
  void codeMasks() {
    const auto connectivity = Connectivity::make(w_);
    if (!connectivity)
      return s_.refuse("the wireframe is unsound: " + connectivity.error().message);
    for (Index n = 0; n < static_cast<Index>(w_.nodes.size()); ++n) {
      const std::uint32_t x = lineClass(w_, *connectivity, n, 0),
                          y = lineClass(w_, *connectivity, n, 1);
      const JetMask told = whole_ ? whole_->nodes[n].stored : 0;
      JetMask mask = 0;
      for (int k = 0; k < 9; ++k) {
        if (k >= 3 && !(mask >> (k - 3) & 1)) continue;
        if (k % 3 > 0 && !(mask >> (k - 1) & 1)) continue;
        const std::uint32_t before = mask;
        if (s_.bit(kMask, (x * 16 + y) * 16 + static_cast<std::uint32_t>(k), before, told >> k & 1))
          mask = static_cast<JetMask>(mask | 1 << k);
      }
      w_.nodes[n].stored = mask;
    }
  }

  // ρ = 1, η = λ = 0 for most; else η = -c / l² and λ = d / l⁴ with whole numbers where that gives
  // exactly what is meant; else as they are.
  void codeShapes() {
    for (std::size_t r = 0; r < w_.ribbons.size() && s_.ok(); ++r) {
      const Shape shape = whole_ ? whole_->ribbons[r] : Shape{};
      if (!s_.bit(kShaped, 0, 0, shape != Shape{})) continue;
      const std::optional<Stiffness> stiffness = whole_ ? stiffnessOf(shape) : std::nullopt;
      if (s_.bit(kShapeForm, 0, 0, stiffness.has_value())) {
        Stiffness s = stiffness.value_or(Stiffness{});
        s.eta = s_.number(kShapeSize, 0, 0, s.eta);
        s.lambda = s_.number(kShapeSize, 1, 0, s.lambda);
        s.length = 1 + s_.number(kShapeLength, 0, 0, s.length - 1);
        w_.ribbons[r] = s.shape();
        continue;
      }
      double values[3] = {shape.rho, shape.eta, shape.lambda};
      for (double& x : values) {
        x = std::bit_cast<double>(s_.raw(kShapeRaw, std::bit_cast<std::uint64_t>(x)));
        if (!(x - x == 0)) s_.refuse("a value is not finite");
      }
      w_.ribbons[r] = {values[0], values[1], values[2]};
    }
  }

  struct Stiffness {
    std::uint32_t eta = 0, lambda = 0, length = 1;
    Shape shape() const {
      const double square = static_cast<double>(length) * length;
      return {1, eta == 0 ? 0 : -static_cast<double>(eta) / square,
              lambda == 0 ? 0 : static_cast<double>(lambda) / (square * square)};
    }
  };
  static std::optional<Stiffness> stiffnessOf(const Shape& shape) {
    for (std::uint32_t length = 1; length <= 1024; ++length) {
      const double square = static_cast<double>(length) * length;
      const double eta = -shape.eta * square, lambda = shape.lambda * square * square;
      if (!(eta >= 0 && eta < 1e9 && lambda >= 0 && lambda < 1e9)) continue;
      const Stiffness s{static_cast<std::uint32_t>(eta + 0.5),
                        static_cast<std::uint32_t>(lambda + 0.5), length};
      if (s.shape() == shape) return s;
    }
    return std::nullopt;
  }

  Symbols<Coder>& s_;
  const Wireframe* whole_;
  Wireframe w_;
};

}  // namespace

void writeWireframe(Symbols<RangeEncoder>& out, const Wireframe& wireframe) {
  WireframeCoder<RangeEncoder>(out, &wireframe).run(SIZE_MAX, INT64_MAX);
}

Wireframe readWireframe(Symbols<RangeDecoder>& in, std::size_t most, std::int64_t mostQuads) {
  return WireframeCoder<RangeDecoder>(in, nullptr).run(most, mostQuads);
}

}  // namespace sweepface::codec
