#include "codec/wireframe_coder.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "codec/grid_size.hpp"
#include "codec/limits.hpp"
#include "codec/loop_coder.hpp"
#include "codec/wireframe_rules.hpp"

namespace sweepface::codec {

namespace {

// What is coded besides the loops; numbers take two tags.
enum WireframeTag : std::uint32_t {
  kCounts = 0,
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
  kHasCreases = 37,
  kCrease = 38,
  kMirrorAxis = 40,
  kMirrorCount = 41,
  kMirrorArc = 43
};

// Rotates the loop of a patch so that the side `base` comes first.
void turn(Wireframe& w, Index patch, int base, std::vector<HalfArc>& loop) {
  if (base == 0) return;
  auto& sides = w.patches[patch].sides;
  const std::array<Index, 5> old = sides;
  const Index begin = old[0];
  loop.assign(w.loops.begin() + begin, w.loops.begin() + old[4]);
  std::copy(loop.begin(), loop.begin() + (old[base] - begin),
            std::copy(loop.begin() + (old[base] - begin), loop.end(), w.loops.begin() + begin));
  for (int s = 0; s < 4; ++s) {
    const int from = (base + s) % 4;
    sides[s + 1] = sides[s] + old[from + 1] - old[from];
  }
}

template <typename Coder>
class WireframeCoder {
 public:
  WireframeCoder(Symbols<Coder>& symbols, const Wireframe* whole, MirrorSeeds given)
      : seeds(std::move(given)), s_(symbols), whole_(whole) {}

  Wireframe run(std::size_t most, std::int64_t mostVertices) {
    const std::size_t nodes = count(whole_ ? whole_->nodes.size() : 0, most),
                      arcs = count(whole_ ? whole_->arcs.size() : 0, most),
                      patches = count(whole_ ? whole_->patches.size() : 0, most);
    if (!s_.ok()) return {};
    codeMirror(static_cast<std::uint32_t>(2 * arcs));
    if (!s_.ok()) return {};
    LoopCoder<Coder> loops(s_, w_, whole_, seeds.pairs, nodes, arcs);
    loops.run(patches);
    if (s_.ok() && !isSmallEnough(w_, mostVertices))
      s_.refuse("the patches have too many vertices");
    if (!s_.ok()) return {};
    codeTurns(loops.bases);
    codePoints();
    codeRibbons();
    codeCreases();
    if (s_.ok()) codeMasks();
    if (s_.ok()) codeShapes();
    return std::move(w_);
  }

  MirrorSeeds seeds;
  // Derived from what was coded; shapes and masks do not change them.
  Connectivity connectivity;
  Mirror mirror;

 private:
  std::size_t count(std::size_t value, std::size_t most) {
    const std::size_t n = s_.number(kCounts, 0, 0, value);
    if (n > most) s_.refuse(kTooLarge);
    return n;
  }

  void codeMirror(std::uint32_t halves) {
    seeds.axis = static_cast<int>(s_.index(kMirrorAxis, 3, static_cast<std::uint32_t>(seeds.axis)));
    const std::uint32_t pairs = s_.number(kMirrorCount, 0, 0, seeds.pairs.size());
    if (pairs > kMostMirrorPairs) return s_.refuse("the mirror image begins in too many places");
    seeds.pairs.resize(pairs);
    for (auto& pair : seeds.pairs)
      for (HalfArc& h : pair)
        h = static_cast<HalfArc>(s_.index(kMirrorArc, halves, static_cast<std::uint32_t>(h)));
  }

  // Each loop was coded from side `base` of the patch on, so side 4 - base of the loop must come
  // first.
  void codeTurns(const std::vector<int>& bases) {
    SweepRule rule(w_);
    std::vector<HalfArc> loop;
    for (Index p = 0; p < static_cast<Index>(w_.patches.size()); ++p) {
      const bool expected = rule.turns(p, 0);
      const int first = (4 - bases[p]) % 4;
      const bool odd = s_.bit(kTurn, expected, 0, first % 2);
      const bool half = s_.bit(kHalfTurn, odd, 0, first / 2);
      turn(w_, p, 2 * half + odd, loop);
      rule.sweep(p);
    }
  }

  void codePoints() {
    const std::vector<Index> expected = expectedPoints(w_);
    const auto told = [&](std::size_t n) { return whole_ ? whole_->nodes[n].point : -1; };
    bool same = true;
    for (std::size_t n = 0; n < expected.size(); ++n) same &= told(n) == expected[n];
    same = s_.bit(kAsExpected, 0, 0, same);
    for (std::size_t n = 0; n < expected.size() && s_.ok(); ++n) {
      std::int64_t point = expected[n];
      if (!same) point += s_.signedNumber(kPoint, 0, 0, std::int64_t{told(n)} - expected[n]);
      if (point < -1 || point >= static_cast<Index>(expected.size()))
        return s_.refuse("a node stands at a point that does not exist");
      w_.nodes[n].point = static_cast<Index>(point);
      w_.points = std::max(w_.points, w_.nodes[n].point + 1);
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
      std::int64_t ribbon = expected[a];
      if (!same) ribbon += s_.signedNumber(kRibbon, 0, 0, std::int64_t{told(a)} - expected[a]);
      if (ribbon < 0 || ribbon >= static_cast<Index>(expected.size()))
        return s_.refuse("an arc belongs to a ribbon that does not exist");
      w_.arcs[a].ribbon = static_cast<Index>(ribbon);
      most = std::max(most, w_.arcs[a].ribbon);
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

  // The mask of the mirror image of a node, in the frame of the node; 0 if it is not known yet.
  JetMask imageMask(const Connectivity& c, Index node) const {
    const Index image = mirror.node[node];
    if (image < 0 || image >= node || c.stars[node].arms.empty()) return 0;
    const auto& arms = c.stars[image].arms;
    const auto x = std::ranges::find(arms, mirror.halfArc[c.stars[node].arms[0]]) - arms.begin();
    const JetMask mask = w_.nodes[image].stored;
    if (x % 2 == 0) return mask;
    JetMask turned = 0;
    for (int k = 0; k < 9; ++k)
      if (mask >> k & 1) turned = static_cast<JetMask>(turned | 1 << (k % 3 * 3 + k / 3));
    return turned;
  }

  // Codes masks, which are closed downwards, component by component.
  void codeMasks() {
    auto made = Connectivity::make(w_);
    if (!made) return s_.refuseWith({"the wireframe is unsound: ", made.error().message});
    connectivity = std::move(*made);
    mirror = spreadMirror(w_, connectivity, seeds.pairs);
    for (Index n = 0; n < static_cast<Index>(w_.nodes.size()); ++n) {
      const JetMask image = imageMask(connectivity, n);
      const std::uint32_t x = lineClass(w_, connectivity, n, 0),
                          y = lineClass(w_, connectivity, n, 1);
      const JetMask told = whole_ ? whole_->nodes[n].stored : 0;
      JetMask mask = 0;
      for (int k = 0; k < 9; ++k) {
        if (k >= 3 && !(mask >> (k - 3) & 1)) continue;
        if (k % 3 > 0 && !(mask >> (k - 1) & 1)) continue;
        const std::uint32_t before = mask;
        const std::uint32_t expected = image == 0 ? 0 : 1 + (image >> k & 1);
        const std::uint32_t context = ((expected * 16 + x) * 16 + y) * 16;
        if (s_.bit(kMask, context + static_cast<std::uint32_t>(k), before, told >> k & 1))
          mask = static_cast<JetMask>(mask | 1 << k);
      }
      w_.nodes[n].stored = mask;
    }
  }

  // Most ribbons have ρ = 1, η = λ = 0. Others are coded as whole numbers c, d and l if η = -c / l²
  // and λ = d / l⁴ give the exact values, else verbatim.
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
        if (s.length == 0) s_.refuse("a value is not finite");
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

void writeWireframe(Symbols<RangeEncoder>& out, const Wireframe& wireframe, MirrorSeeds seeds) {
  WireframeCoder<RangeEncoder>(out, &wireframe, std::move(seeds)).run(SIZE_MAX, INT64_MAX);
}

CodedWireframe readWireframe(Symbols<RangeDecoder>& in, std::size_t most,
                             std::int64_t mostVertices) {
  WireframeCoder<RangeDecoder> coder(in, nullptr, {});
  Wireframe wireframe = coder.run(most, mostVertices);
  return {std::move(wireframe), std::move(coder.seeds), std::move(coder.connectivity),
          std::move(coder.mirror)};
}

}  // namespace sweepface::codec
