#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "codec/hierarchy.hpp"
#include "codec/steps.hpp"
#include "codec/symbols.hpp"

namespace sweepface::codec {

/// Codes the coefficients of one pose after another, coarse to fine, with adaptive contexts. Reader
/// and writer share this code, over a RangeDecoder or a RangeEncoder.
template <typename Coder>
class CoefficientCoder {
 public:
  /// One coder serves the neutral, another all targets.
  CoefficientCoder(const Hierarchy& hierarchy, Coder& coder, int axis, bool neutral)
      : h_(hierarchy),
        axis_(axis),
        neutral_(neutral),
        mask_(slotsFor(hierarchy.prediction().steps.size()) - 1),
        model_(coder, mask_ + 1, kSets, neutral ? kNeutralMemory : kTargetMemory) {
    const std::size_t sites = h_.sites().size();
    active_.resize(sites);
    below_.resize(sites);
    mirrors_.resize(sites);
    likeSite_.resize(sites);
    likeBelow_.resize(sites);
    history_.assign(sites, 0);
    siteOf_.resize(hierarchy.prediction().steps.size());
    for (std::size_t s = 0; s < sites; ++s)
      std::fill_n(siteOf_.begin() + h_.sites()[s].first, h_.sites()[s].count,
                  static_cast<Index>(s));
    residual_.resize(siteOf_.size());
    like_.resize(siteOf_.size());
  }

  /// When reading, `q` must be all zeros. `expected` is the prediction by the image of a partner
  /// pose. `like` is a further hint: a pose that moves similarly, or empty.
  void code(Coefficients& q, Symmetry symmetry, const Sparse& expected, Sparse like) {
    lookAt(std::move(like));
    if constexpr (kWrites<Coder>)
      compare(q, symmetry, expected);
    else
      begin(q, expected);
    const auto& sites = h_.sites();
    for (Index s = 0; s < static_cast<Index>(sites.size()) && length_ <= mostLength_; ++s) {
      const bool follows = symmetry == Symmetry::self && isImage(s);
      phase_ = neutral_ ? 0 : symmetry == Symmetry::partner ? 3 : 1;
      if (follows) phase_ += neutral_ ? 4 : 1;
      if (sites[s].parent < 0 || below_[sites[s].parent]) codeSite(s);
      // Later sites of this pose may be images of this one.
      if constexpr (!kWrites<Coder>) fillIn(q, s, follows);
    }
    for (std::size_t s = 0; s < sites.size(); ++s) history_[s] += active_[s];
  }

  /// Stops reading once the coefficients have more than `most` bits in all.
  void setMostBits(std::uint64_t most) { mostLength_ = most; }
  /// Adds bits of other numbers to that total.
  void countBits(std::uint64_t bits) { length_ += bits; }
  bool hasTooManyBits() const { return length_ > mostLength_; }

 private:
  // Enough that contexts hardly ever share a slot, and no more than a small rig needs.
  static std::uint32_t slotsFor(std::size_t vectors) {
    return static_cast<std::uint32_t>(
        std::bit_ceil(std::clamp<std::size_t>(32 * vectors, 1 << 10, 1 << 18)));
  }
  // Targets differ from one another, so their statistics are forgotten sooner than those of a
  // neutral.
  static constexpr std::uint16_t kNeutralMemory = 30, kTargetMemory = 16;
  static constexpr std::uint32_t kMostBits = 28;
  static constexpr int kInputs = 5, kSets = 240;

  enum BitKind { kAny, kBelow, kVector, kZero, kSign, kMore };

  // Whether a site mirrors one that was coded before it.
  bool isImage(Index s) const { return h_.sites()[s].mirror >= 0 && h_.sites()[s].mirror < s; }
  Steps3 imageAt(const Coefficients& q, Index v) const {
    const Hierarchy::Image& image = h_.images()[v];
    return image.vector < 0 ? Steps3{} : reflected(q[image.vector], image.sign, axis_);
  }

  // Sets the residuals, which are what is coded: the differences from what images predict.
  void compare(const Coefficients& q, Symmetry symmetry, const Sparse& expected) {
    residual_ = q;
    const auto subtract = [&](Index v, const Steps3& image) {
      for (int k = 0; k < 3; ++k) residual_[v][k] -= image[k];
    };
    for (const Moved& m : expected) subtract(m.vector, m.steps);
    const auto& sites = h_.sites();
    for (Index s = 0; s < static_cast<Index>(sites.size()); ++s) {
      const CodedSite& site = sites[s];
      const bool follows = symmetry == Symmetry::self && isImage(s);
      active_[s] = 0;
      for (Index v = site.first; v < site.first + site.count; ++v) {
        if (follows) subtract(v, imageAt(q, v));
        active_[s] |= isMoved(residual_[v]);
      }
    }
    std::ranges::fill(below_, 0);
    for (std::size_t s = sites.size(); s-- > 0;)
      if (active_[s]) passUp(below_, static_cast<Index>(s));
  }

  void begin(Coefficients& q, const Sparse& expected) {
    for (const Index v : told_) residual_[v] = {};
    told_.clear();
    std::ranges::fill(active_, 0);
    std::ranges::fill(below_, 0);
    std::ranges::fill(mirrors_, 0);
    for (const Moved& m : expected) q[m.vector] = m.steps;
  }

  // Adds the residuals read for a site to what its image predicts, if it `follows` that image.
  void fillIn(Coefficients& q, Index s, bool follows) {
    const CodedSite& site = h_.sites()[s];
    const bool mirrors = follows && mirrors_[site.mirror];
    if (!mirrors && !active_[s]) return;
    mirrors_[s] = 1;
    for (Index v = site.first; v < site.first + site.count; ++v) {
      if (mirrors) q[v] = imageAt(q, v);
      for (int k = 0; k < 3; ++k) q[v][k] += residual_[v][k];
    }
  }

  void lookAt(Sparse like) {
    for (const Moved& m : likes_) like_[m.vector] = {};
    likes_ = std::move(like);
    std::ranges::fill(likeSite_, likes_.empty() ? 0 : 1);
    std::ranges::fill(likeBelow_, 0);
    for (const Moved& m : likes_) {
      const Index s = siteOf_[m.vector];
      like_[m.vector] = m.steps;
      if (m.vector == h_.sites()[s].first)
        likeSite_[s] += 2 * std::min(largest(m.steps, 3), 3u);
      else
        likeSite_[s] += likeSite_[s] & 1;  // once for all slopes
      passUp(likeBelow_, s);
    }
  }

  // Marks all ancestors of a site that moves.
  void passUp(std::vector<char>& below, Index s) const {
    const auto& sites = h_.sites();
    for (Index up = sites[s].parent; up >= 0 && !below[up]; up = sites[up].parent) below[up] = 1;
  }

  bool bit(BitKind kind, int sub, bool value, std::array<std::uint32_t, kInputs> contexts) {
    for (int k = 0; k < kInputs; ++k)
      contexts[k] = hashOf(contexts[k] * kInputs + k, kind * 64 + sub) & mask_;
    value = model_.code(value, contexts, (phase_ * 6 + kind) * 8 + std::min(sub, 7));
    recent_ = recent_ << 4 ^ static_cast<std::uint32_t>(2 * (kind ^ sub) + value);
    return value;
  }
  // A context combined with the last three bits, of any kind.
  std::uint32_t recently(std::uint32_t context) const { return context << 12 | (recent_ & 0xfff); }

  static std::uint32_t bucket(std::int32_t x) {
    x = std::abs(x);
    return x < 3 ? x : x < 5 ? 3 : x < 9 ? 4 : x < 17 ? 5 : x < 40 ? 6 : 7;
  }

  void codeSite(Index s) {
    const CodedSite& site = h_.sites()[s];
    const std::uint32_t level = site.span == 0    ? 0
                                : site.span <= 2  ? 1
                                : site.span <= 4  ? 2
                                : site.span <= 8  ? 3
                                : site.span <= 16 ? 4
                                                  : 5;
    const std::uint32_t parent = site.parent < 0 ? 2 : active_[site.parent];
    std::uint32_t near = 0;
    for (const Term& t : h_.beside(s)) near += isMoved(residual_[t.vector]);
    near = std::min(near, 4u);
    const std::uint32_t past = std::min<std::uint32_t>(history_[s], 6);
    const std::uint32_t mirrored = isImage(s) ? 1 + active_[site.mirror] : 0;
    const std::uint32_t p = phase_;
    bool any = active_[s];
    any = bit(kAny, site.leaf, any,
              {recently(p * 64 + level * 8 + parent), static_cast<std::uint32_t>(s) * 8 + p,
               (p * 4 + mirrored) * 8 + near, ((p * 8 + past) * 8 + level) * 8 + near,
               ((p * 16 + likeSite_[s]) * 8 + near) * 2 + likeBelow_[s]});
    active_[s] = any;
    if (any) codeVectors(s, level);
    if (!site.leaf) {
      bool below = below_[s];
      below = bit(kBelow, any, below,
                  {recently(p * 64 + level * 8 + parent), static_cast<std::uint32_t>(s) * 8 + p,
                   (p * 4 + mirrored) * 2 + any, ((p * 8 + past) * 8 + level) * 2 + any,
                   ((p * 16 + likeSite_[s]) * 2 + any) * 2 + likeBelow_[s]});
      below_[s] = below;
    } else {
      below_[s] = 0;
    }
  }

  void codeVectors(Index s, std::uint32_t level) {
    const CodedSite& site = h_.sites()[s];
    std::uint32_t before = 0;  // which of the last 32 vectors moved
    bool some = false;
    for (Index k = 0; k < site.count; ++k) {
      const Index v = site.first + k;
      bool moved = isMoved(residual_[v]);
      if (k + 1 == site.count && !some) {
        moved = true;
      } else {
        const std::uint32_t p = phase_, shape = site.count * 8 + k;
        moved = bit(kVector, std::min<int>(k, 7), moved,
                    {recently(0), (p * 64 + shape) * 64 + before,
                     static_cast<std::uint32_t>(v) * 8 + p, (p * 8 + level) * 64 + before,
                     ((p * 16 + likeSite_[s]) * 2 + isMoved(like_[v])) * 128 + shape});
      }
      before = before * 2 + moved;
      if (!moved) continue;
      some = true;
      codeVector(s, k, v, level);
      if constexpr (!kWrites<Coder>) told_.push_back(v);
    }
  }

  // The contexts shared by the bits of one coordinate of a coefficient.
  struct Component {
    std::uint32_t order;    // of the vector: 0 position, 1 slope, 2 higher derivative
    std::uint32_t place;    // order, phase and axis combined
    std::uint32_t id;       // the coefficient
    std::uint32_t level;    // of the site
    std::uint32_t pattern;  // sizes of the previous components: 0, 1 or 2 each
    std::uint32_t others;   // bucket of the largest of those, and of the vector around
    std::int32_t around, like;
  };

  void codeVector(Index s, Index k, Index v, std::uint32_t level) {
    Steps3& r = residual_[v];
    const Steps3 around = k > 0 ? residual_[h_.sites()[s].first] : largestBeside(s);
    const std::uint32_t order = k == 0 ? 0 : k < 3 ? 1 : 2;
    std::uint32_t pattern = 0;
    for (std::uint32_t a = 0; a < 3; ++a) {
      const Component c{order,
                        (phase_ * 4 + order) * 4 + a,
                        static_cast<std::uint32_t>(v) * 4 + a,
                        level,
                        pattern,
                        ((order * 3 + a) * 8 + largest(r, a)) * 8 + largest(around, 3),
                        around[a],
                        like_[v][a]};
      const bool must = a == 2 && pattern == 0;
      r[a] = must || codeMoved(r[a] != 0, c, likeSite_[s]) ? codeComponent(r[a], c) : 0;
      pattern = pattern * 4 + std::min<std::uint32_t>(std::abs(r[a]), 2);
    }
  }

  // For each component, the value of largest magnitude among the vectors that predict the site.
  Steps3 largestBeside(Index s) const {
    Steps3 most{};
    for (const Term& t : h_.beside(s))
      for (int a = 0; a < 3; ++a)
        if (const std::int32_t beside = residual_[t.vector][a];
            std::abs(beside) > std::abs(most[a]))
          most[a] = beside;
    return most;
  }

  bool codeMoved(bool moved, const Component& c, std::uint32_t likeSite) {
    return bit(kZero, c.order, moved,
               {recently(0), c.place * 16 + c.pattern, c.place * 8 + bucket(c.around),
                c.id * 8 + phase_, (c.place * 16 + likeSite) * 16 + bucket(c.like)});
  }

  // A component that is not zero.
  std::int32_t codeComponent(std::int32_t value, const Component& c) {
    const std::uint32_t lean = way(c.around);
    const bool negative =
        bit(kSign, c.order, value < 0,
            {recently(0), c.place * 16 + c.pattern, c.id * 8 + phase_,
             (c.place * 4 + lean) * 8 + c.level, (c.place * 4 + way(c.like)) * 4 + lean});
    const auto size =
        static_cast<std::int32_t>(magnitude(static_cast<std::uint32_t>(std::abs(value)), c));
    return negative ? -size : size;
  }

  static std::uint32_t way(std::int32_t x) { return x < 0 ? 1 : x > 0 ? 2 : 0; }

  // The bucket of the largest of the first `count` values.
  static std::uint32_t largest(const Steps3& values, std::uint32_t count) {
    std::int32_t most = 0;
    for (std::uint32_t k = 0; k < count; ++k) most = std::max(most, std::abs(values[k]));
    return bucket(most);
  }

  // A number of at least 1: its length in bits (unary), then its bits (Elias 1975).
  std::uint32_t magnitude(std::uint32_t size, const Component& c) {
    const std::uint32_t by = bucket(c.around), alike = bucket(c.like);
    std::uint32_t n = 1;
    while (n < kMostBits) {
      const bool more = bit(kMore, static_cast<int>(std::min(n, 8u)), size >> n != 0,
                            {recent_ & 0xffff, c.id * 32 + n, c.others * 32 + n,
                             (by * 8 + c.level) * 32 + n, (c.place * 8 + alike) * 32 + n});
      if (!more) break;
      ++n;
    }
    length_ += n;
    std::uint32_t value = 1;
    for (std::uint32_t b = n - 1; b-- > 0;) {
      const std::uint32_t top = n - 1 - b, known = (top < 4 ? value : 16 + top) * 32 + n;
      const bool one =
          bit(kMore, 9 + std::min(top, 3u), size >> b & 1,
              {recently(0), known * 64 + c.place, known * 2048 + c.others, top, known * 8 + alike});
      value = value << 1 | static_cast<std::uint32_t>(one);
    }
    return value;
  }

  const Hierarchy& h_;
  int axis_;
  bool neutral_;
  std::uint32_t mask_;  // selects a slot
  Model<Coder, kInputs> model_;
  std::uint64_t length_ = 0, mostLength_ = std::numeric_limits<std::uint64_t>::max();
  std::uint32_t phase_ = 0, recent_ = 0;  // recent_: the last bits with their kinds, four bits each
  std::vector<Index> siteOf_;             // [S]
  std::vector<char> active_, below_, mirrors_;  // [sites]
  std::vector<Index> history_;    // [sites] number of poses in which the site was active
  Coefficients residual_, like_;  // [S]
  std::vector<Index> told_;       // vectors whose residuals were read
  Sparse likes_;
  std::vector<std::uint32_t> likeSite_;  // [sites]
  std::vector<char> likeBelow_;          // [sites]
};

}  // namespace sweepface::codec
