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

/// What moves in a likeness, nothing where there is none.
Sparse movedIn(const Likeness& like, const Lattice& lattice,
               const std::vector<Coefficients>& poses);

}  // namespace sweepface::codec
