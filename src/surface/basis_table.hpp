#pragma once

#include <array>
#include <vector>

#include "sweepface/ode.hpp"
#include "sweepface/vec.hpp"

namespace sweepface {

/// The sweep basis of every ribbon at every length that occurs. Ribbons of the same shape share
/// bases, and each basis is solved once.
class BasisTable {
 public:
  /// Fails if a ribbon's shape parameters are refused at one of its lengths.
  static Result<BasisTable> make(const std::vector<Shape>& ribbons,
                                 const std::vector<std::array<Index, 2>>& ribbonsAndEdges);
  Index find(Index ribbon, Index edges) const;
  const SweepBasis& at(Index ribbon, Index edges) const { return bases_[find(ribbon, edges)]; }
  const SweepBasis& operator[](Index basis) const { return bases_[basis]; }

  /// inEdges() of a basis; for a short one at whole t, from a table.
  std::array<double, 6> values(Index basis, double t, int order) const;
  /// The six functions, or their derivatives, with t ∈ [0, edges] instead of u = t / edges, also in
  /// the jets that they weight.
  static std::array<double, 6> inEdges(const SweepBasis& basis, double t, Index edges, int order);

 private:
  void tabulate();

  using Key = std::array<Index, 2>;  // shape and length
  Key keyOf(Index ribbon, Index edges) const { return {shapes_[ribbon], edges}; }

  std::vector<Index> shapes_;  // [ribbons] the first ribbon of the same shape
  std::vector<Key> keys_;      // sorted
  std::vector<SweepBasis> bases_;
  std::vector<Index> firstValue_;              // [bases] in values_, or -1
  std::vector<std::array<double, 6>> values_;  // at t = 0 … edges, then the first derivatives
};

}  // namespace sweepface
