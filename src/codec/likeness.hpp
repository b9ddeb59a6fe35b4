#pragma once

#include <vector>

#include "codec/lattice.hpp"

namespace sweepface::codec {

/// An earlier target that moves much the same as one: what it does tells what to expect.
struct Likeness {
  Index pose = -1;        ///< or none
  bool mirrored = false;  ///< it is the mirror image that is like it
  bool negated = false;   ///< moved the other way
};

/// The one of the 256 targets before `pose` that says most about which of its vectors move: with
/// the least entropy of that, given which of the other's do.
class Likenesses {
 public:
  Likenesses(const Lattice& lattice, const std::vector<Coefficients>& poses);
  Likeness of(Index pose) const;

 private:
  using Bits = std::vector<std::uint64_t>;
  const Lattice& lattice_;
  const std::vector<Coefficients>& poses_;
  std::vector<std::array<Bits, 2>> moved_;  // [poses] by itself and in its image
};

/// What moves in a likeness, nothing where there is none. Poses are Coefficients or Sparse.
template <typename Steps>
Sparse movedIn(const Likeness& like, const Lattice& lattice, const std::vector<Steps>& poses) {
  if (like.pose < 0) return {};
  Sparse moved = lattice.moved(poses[like.pose], like.mirrored, 0);
  if (like.negated)
    for (Moved& m : moved)
      for (std::int32_t& x : m.steps) x = -x;
  return moved;
}

}  // namespace sweepface::codec
