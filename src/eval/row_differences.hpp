#pragma once

#include <span>
#include <vector>

#include "sweepface/rig.hpp"

#include "eval/low_rank.hpp"

namespace sweepface {

/// A row as a sum over the vectors of a settled pose; or a vertex of no face.
struct Row {
  std::vector<Term> terms;
  Index loose = -1;
};

/// What the weights of a rig move, and by how much: for a few rows at a time, so that no table of
/// all targets at all vertices is ever made.
class RowDifferences {
 public:
  /// Target k of region r is column r · K + k; no influences: one region that is everywhere.
  /// Vertices of no face follow the first region.
  RowDifferences(const Rig& rig, std::span<const std::vector<float>> influences);

  Index columns() const { return columns_; }
  /// The columns that move any of the rows, and the differences of the rows in model units.
  /// Differences beyond what single precision bears end there.
  Differences of(std::span<const Row> rows, std::vector<std::uint16_t>& moving);

 private:
  void collect(std::span<const Row> rows);
  std::vector<std::uint16_t> findMoving(std::span<const Row> rows) const;
  void settle(std::span<const std::uint16_t> moving);
  Vec3 stored(Index vector, Index column) const;
  Vec3 ofLoose(Index loose, Index column) const;

  const Rig& rig_;
  std::span<const std::vector<float>> influences_;
  Index targets_, columns_;
  std::size_t words_;
  std::vector<std::uint64_t> moves_;  // [stored][words] bit set: which columns move a stored vector
  std::vector<Index> needed_;         // vectors the rows are made of, directly or not, ascending
  std::vector<Index> placeOf_;        // [vectors] in needed_, or -1
  std::vector<float> settled_;        // [needed_][moving × 3]
};

}  // namespace sweepface
