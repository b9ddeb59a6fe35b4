#pragma once

#include <vector>

#include "codec/lattice.hpp"

namespace sweepface::codec {

/// An earlier target that moves similarly, whose coefficients serve as context.
struct Likeness {
  Index pose = -1;        ///< -1 if there is none
  bool mirrored = false;  ///< its mirror image is meant
  bool negated = false;   ///< in the opposite direction
};

/// Finds, among the 256 targets before a pose, the one that says most about which of its vectors
/// move: the one that minimises the conditional entropy of that set.
class Likenesses {
 public:
  Likenesses(const Lattice& lattice, const std::vector<Coefficients>& poses);
  Likeness of(Index pose) const;

 private:
  using Bits = std::vector<std::uint64_t>;
  const Lattice& lattice_;
  const std::vector<Coefficients>& poses_;
  std::vector<std::array<Bits, 2>> moved_;  // [poses] which vectors move, as is and mirrored
};

/// What a likeness tells of the vectors of a pose; empty if there is none. Poses are Coefficients
/// or Sparse.
template <typename Steps>
Sparse hintsOf(const Likeness& like, const Lattice& lattice, const std::vector<Steps>& poses) {
  if (like.pose < 0) return {};
  Sparse moved = lattice.moved(poses[like.pose], like.mirrored, 0);
  if (like.negated)
    for (Moved& m : moved)
      for (std::int32_t& x : m.steps) x = -x;
  return moved;
}

}  // namespace sweepface::codec
