#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "codec/hierarchy.hpp"
#include "codec/symbols.hpp"

namespace sweepface::codec {

/// A vector in steps.
using Steps3 = std::array<std::int32_t, 3>;
inline bool isMoved(const Steps3& v) { return (v[0] | v[1] | v[2]) != 0; }
/// The stored vectors of a pose [S] as multiples of their steps beyond their predictions.
using Coefficients = std::vector<Steps3>;

/// What the coefficients of a pose are compared with before they are coded.
enum class Symmetry {
  none,    ///< with nothing
  self,    ///< with the mirror image of the half that came before
  partner  ///< with the mirror image of an earlier pose
};

/// The same in steps that are 2^finer times smaller, or larger where `finer` is negative.
inline Coefficients inFinerSteps(Coefficients q, int finer) {
  constexpr std::int64_t kMost = 1 << 26;
  for (Steps3& v : q)
    for (std::int32_t& x : v) {
      const std::int64_t y =
          finer >= 0 ? x * (std::int64_t{1} << std::min(finer, 30)) : x >> std::min(-finer, 30);
      x = static_cast<std::int32_t>(std::clamp(y, -kMost, kMost));
    }
  return q;
}

/// Codes the coefficients of one pose after the other, coarse to fine; learns as it goes. Reader
/// and writer are the same code over a RangeDecoder or a RangeEncoder.
template <typename Coder>
class CoefficientCoder {
 public:
  CoefficientCoder(const Hierarchy& hierarchy, Coder& coder, int axis)
      : h_(hierarchy),
        axis_(axis),
        mask_(slotsFor(hierarchy.prediction().steps.size()) - 1),
        model_(coder, mask_ + 1, kSets) {
    const std::size_t sites = h_.sites().size();
    active_.resize(sites);
    below_.resize(sites);
    history_.assign(sites, 0);
  }

  /// What is read comes to a `q` of zeros. `like` tells what to expect: a pose that moves much the
  /// same, or nothing.
  void code(Coefficients& q, Symmetry symmetry, const Coefficients& partner, Coefficients like,
            bool neutral) {
    const auto& sites = h_.sites();
    lookAt(std::move(like), q.size());
    residual_.assign(q.size(), Steps3{});
    constexpr bool writing = kWrites<Coder>;
    expected_.assign(q.size(), Steps3{});
    if (symmetry == Symmetry::partner) expect(partner, false);
    if (writing) {
      if (symmetry == Symmetry::self) expect(q, true);
      for (std::size_t v = 0; v < q.size(); ++v)
        for (int k = 0; k < 3; ++k) residual_[v][k] = q[v][k] - expected_[v][k];
      markBelow();
    } else {
      std::fill(active_.begin(), active_.end(), 0);
      std::fill(below_.begin(), below_.end(), 0);
    }
    for (Index s = 0; s < static_cast<Index>(sites.size()); ++s) {
      const CodedSite& site = sites[s];
      phase_ = neutral ? 0 : symmetry == Symmetry::partner ? 3 : 1;
      if (symmetry == Symmetry::self && site.mirror >= 0 && site.mirror < s)
        phase_ += neutral ? 4 : 1;
      const bool coded = site.parent < 0 || below_[site.parent];
      if (coded) codeSite(s);
      if (writing || (!coded && symmetry == Symmetry::none)) continue;
      // Fill in what the image predicts; later sites of this pose may be images of this one.
      for (Index v = site.first; v < site.first + site.count; ++v) {
        if (symmetry == Symmetry::self && site.mirror >= 0 && site.mirror < s) image(q, v);
        for (int k = 0; k < 3; ++k) q[v][k] = residual_[v][k] + expected_[v][k];
      }
    }
    for (std::size_t s = 0; s < sites.size(); ++s) history_[s] += active_[s];
  }

 private:
  // Enough that contexts hardly ever share one, and no more than a small rig needs.
  static std::uint32_t slotsFor(std::size_t vectors) {
    return static_cast<std::uint32_t>(
        std::bit_ceil(std::clamp<std::size_t>(32 * vectors, 1 << 10, 1 << 18)));
  }
  static constexpr std::uint32_t kMostBits = 28;
  static constexpr int kInputs = 5, kPhases = 6, kSets = 512;

  enum BitKind { kAny, kBelow, kVector, kZero, kSign, kMore };

  // The image of another pose's vector, negated along the mirror's axis.
  void image(const Coefficients& from, Index v) {
    const Hierarchy::Image& i = h_.images()[v];
    if (i.vector < 0) return;
    for (int k = 0; k < 3; ++k)
      expected_[v][k] = (k == axis_ ? -i.sign : i.sign) * from[i.vector][k];
  }
  void expect(const Coefficients& from, bool self) {
    for (Index s = 0; s < static_cast<Index>(h_.sites().size()); ++s) {
      const CodedSite& site = h_.sites()[s];
      if (site.mirror < 0 || (self && site.mirror >= s)) continue;
      for (Index v = site.first; v < site.first + site.count; ++v) image(from, v);
    }
  }

  void lookAt(Coefficients like, std::size_t vectors) {
    const auto& sites = h_.sites();
    const bool none = like.empty();
    like_ = std::move(like);
    like_.resize(vectors);
    likeSite_.assign(sites.size(), 0);
    likeBelow_.assign(sites.size(), 0);
    if (none) return;
    for (std::size_t s = 0; s < sites.size(); ++s) {
      const auto vectorsOfSite = std::span(like_).subspan(sites[s].first, sites[s].count);
      const bool slopes = std::ranges::any_of(vectorsOfSite.subspan(1), isMoved);
      likeSite_[s] = 1 + slopes + 2 * std::min(largest(vectorsOfSite[0], 3), 3u);
    }
    passUp(likeBelow_, [&](std::size_t s) { return likeSite_[s] > 1; });
  }

  // Marks every site with one below it that moves.
  template <typename Moves>
  void passUp(std::vector<char>& below, Moves moves) const {
    const auto& sites = h_.sites();
    for (std::size_t s = sites.size(); s-- > 0;)
      if (sites[s].parent >= 0 && (below[s] || moves(s))) below[sites[s].parent] = 1;
  }

  void markBelow() {
    const auto& sites = h_.sites();
    for (std::size_t s = 0; s < sites.size(); ++s) {
      active_[s] = 0;
      for (Index v = sites[s].first; v < sites[s].first + sites[s].count; ++v)
        active_[s] |= isMoved(residual_[v]);
    }
    below_.assign(sites.size(), 0);
    passUp(below_, [&](std::size_t s) { return active_[s] != 0; });
  }

  static std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
    std::uint32_t x = a * 0x9e3779b1u + b * 0x85ebca6bu;
    x ^= x >> 15;
    x *= 0x2c1b3c6du;
    x ^= x >> 13;
    return x;
  }
  bool bit(BitKind kind, int sub, bool value, std::array<std::uint32_t, kInputs> contexts) {
    for (int k = 0; k < kInputs; ++k)
      contexts[k] = hash(contexts[k] * kInputs + k, kind * 64 + sub) & mask_;
    value = model_.code(value, contexts, (phase_ * 6 + kind) * 8 + std::min(sub, 7));
    recent_ = recent_ << 4 ^ static_cast<std::uint32_t>(2 * (kind ^ sub) + value);
    return value;
  }
  // A context with the last three bits, of whatever kind.
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
    const std::uint32_t mirrored =
        site.mirror >= 0 && site.mirror < s ? 1 + active_[site.mirror] : 0;
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
    std::uint32_t before = 0;
    for (Index k = 0; k < site.count; ++k) {
      const Index v = site.first + k;
      bool moved = isMoved(residual_[v]);
      if (k + 1 == site.count && before == 0) {
        moved = true;
      } else {
        const std::uint32_t p = phase_, shape = site.count * 8 + k;
        moved = bit(kVector, std::min<int>(k, 7), moved,
                    {recently(0), (p * 64 + shape) * 64 + before,
                     static_cast<std::uint32_t>(v) * 8 + p, (p * 8 + level) * 64 + before,
                     ((p * 16 + likeSite_[s]) * 2 + isMoved(like_[v])) * 128 + shape});
      }
      before = before * 2 + moved;
      if (moved) codeVector(s, k, v, level);
    }
  }

  void codeVector(Index s, Index k, Index v, std::uint32_t level) {
    Steps3& r = residual_[v];
    Steps3 around{};
    if (k == 0)
      for (const Term& t : h_.beside(s))
        for (int a = 0; a < 3; ++a)
          if (const std::int32_t beside = residual_[t.vector][a];
              std::abs(beside) > std::abs(around[a]))
            around[a] = beside;
    if (k > 0) around = residual_[h_.sites()[s].first];
    const std::uint32_t p = phase_, order = k == 0 ? 0 : k < 3 ? 1 : 2;
    std::uint32_t pattern = 0;
    for (int a = 0; a < 3; ++a) {
      bool moved = r[a] != 0;
      const std::uint32_t place = (p * 4 + order) * 4 + a;
      const std::uint32_t by = bucket(around[a]), alike = bucket(like_[v][a]);
      if (a == 2 && pattern == 0)
        moved = true;
      else
        moved = bit(kZero, order, moved,
                    {recently(0), place * 16 + pattern, place * 8 + by,
                     (static_cast<std::uint32_t>(v) * 4 + a) * 8 + p,
                     (place * 16 + likeSite_[s]) * 16 + alike});
      std::uint32_t size = 0;
      if (moved) {
        bool negative = r[a] < 0;
        const std::uint32_t lean = way(around[a]);
        negative =
            bit(kSign, order, negative,
                {recently(0), place * 16 + pattern, (static_cast<std::uint32_t>(v) * 4 + a) * 8 + p,
                 (place * 4 + lean) * 8 + level, (place * 4 + way(like_[v][a])) * 4 + lean});
        const std::uint32_t others = ((order * 3 + a) * 8 + largest(r, a)) * 8 + largest(around, 3);
        size = magnitude(static_cast<std::uint32_t>(std::abs(r[a])), place, by, level, v * 4 + a,
                         others, alike);
        r[a] = negative ? -static_cast<std::int32_t>(size) : static_cast<std::int32_t>(size);
        pattern = pattern * 4 + (size > 1 ? 2 : 1);
      } else {
        r[a] = 0;
        pattern = pattern * 4;
      }
    }
  }

  static std::uint32_t way(std::int32_t x) { return x < 0 ? 1 : x > 0 ? 2 : 0; }

  // The bucket of the largest of the first `count` values.
  static std::uint32_t largest(const Steps3& values, int count) {
    std::int32_t most = 0;
    for (int k = 0; k < count; ++k) most = std::max(most, std::abs(values[k]));
    return bucket(most);
  }

  // At least 1: its length in bits (unary) and then the bits (Elias 1975).
  std::uint32_t magnitude(std::uint32_t size, std::uint32_t place, std::uint32_t by,
                          std::uint32_t level, std::uint32_t v, std::uint32_t others,
                          std::uint32_t alike) {
    std::uint32_t n = 1;
    while (n < kMostBits) {
      const bool more = bit(kMore, static_cast<int>(std::min(n, 8u)), size >> n != 0,
                            {recent_ & 0xffff, v * 32 + n, others * 32 + n,
                             (by * 8 + level) * 32 + n, (place * 8 + alike) * 32 + n});
      if (!more) break;
      ++n;
    }
    std::uint32_t value = 1;
    for (std::uint32_t b = n - 1; b-- > 0;) {
      const std::uint32_t top = n - 1 - b, known = top < 4 ? value : 16 + top;
      const bool one = bit(kMore, 9 + std::min(top, 3u), size >> b & 1,
                           {recently(0), (known * 32 + n) * 64 + place,
                            (known * 32 + n) * 2048 + others, top, (known * 32 + n) * 8 + alike});
      value = value << 1 | static_cast<std::uint32_t>(one);
    }
    return value;
  }

  const Hierarchy& h_;
  int axis_;
  std::uint32_t mask_;  // of slots
  Model<Coder, kInputs> model_;
  std::uint32_t phase_ = 0, recent_ = 0;  // the last bits with their kinds, four each
  std::vector<char> active_, below_;      // [sites]
  std::vector<Index> history_;            // [sites] poses in which it was active
  Coefficients residual_, expected_, like_;
  std::vector<std::uint32_t> likeSite_;  // [sites]
  std::vector<char> likeBelow_;          // [sites]
};

}  // namespace sweepface::codec
