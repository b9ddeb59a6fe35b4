#include "codec/likeness.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sweepface::codec {

namespace {

std::vector<std::uint64_t> movedBits(const Coefficients& q) {
  std::vector<std::uint64_t> bits((q.size() + 63) / 64, 0);
  for (std::size_t v = 0; v < q.size(); ++v)
    if (isMoved(q[v])) bits[v / 64] |= std::uint64_t{1} << v % 64;
  return bits;
}

// Bits needed to code which `some` of `all` are meant. Rounded, since the last digits of logarithms
// differ between platforms.
double entropy(double some, double all) {
  if (some <= 0 || some >= all) return 0;
  const double bits =
      all * std::log2(all) - some * std::log2(some) - (all - some) * std::log2(all - some);
  return std::round(1024 * bits) / 1024;
}

}  // namespace

Likenesses::Likenesses(const Lattice& lattice, const std::vector<Coefficients>& poses)
    : lattice_(lattice), poses_(poses) {
  for (const Coefficients& q : poses) moved_.push_back({movedBits(q), movedBits(lattice.image(q))});
}

Likeness Likenesses::of(Index pose) const {
  constexpr Index kMostBack = 256;  // so that the time for each of thousands of targets is bounded
  const Bits& own = moved_[pose][0];
  const auto all = static_cast<double>(poses_[pose].size());
  double count = 0;
  for (const std::uint64_t word : own) count += std::popcount(word);
  constexpr double kWorthwhile = 32;  // bits
  double least = entropy(count, all) - kWorthwhile;
  Likeness best;
  for (Index other = std::max<Index>(1, pose - kMostBack); other < pose; ++other)
    for (const bool mirrored : {false, true}) {
      const Bits& its = moved_[other][mirrored];
      double moved = 0, both = 0;
      for (std::size_t k = 0; k < own.size(); ++k) {
        moved += std::popcount(its[k]);
        both += std::popcount(its[k] & own[k]);
      }
      const double left = entropy(both, moved) + entropy(count - both, all - moved);
      if (left < least) least = left, best = {other, mirrored, false};
    }
  if (best.pose < 0) return best;
  std::int64_t agreement = 0;
  for (const Moved& m : hintsOf(best, lattice_, poses_))
    for (int a = 0; a < 3; ++a)
      agreement += std::clamp(m.steps[a], -2, 2) * std::clamp(poses_[pose][m.vector][a], -2, 2);
  best.negated = agreement < 0;
  return best;
}

}  // namespace sweepface::codec
