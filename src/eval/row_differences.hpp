#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sweepface/rig.hpp"

#include "eval/planes.hpp"

namespace sweepface {

/// A row: a weighted sum over the vectors of a settled pose, or a vertex of no face.
struct Row {
  std::span<const Index> vectors;
  std::span<const double> factors;
  double scale = 1;  ///< multiplies all factors
  Index loose = -1;
};

/// Computes what the weights of a rig move, and by how much. Works on a few rows at a time, so that
/// no table of all targets at all vertices is ever made.
class RowDifferences {
 public:
  /// Column r · K + k is target k of region r; no influences means one region that is everywhere.
  /// Vertices of no face follow the first region.
  RowDifferences(const Rig& rig, std::span<const std::vector<float>> influences);

  /// Sets `moving` to the columns that move any of the rows, and `out` to the differences of the
  /// rows times `scale`.
  void of(std::span<const Row> rows, double scale, std::vector<std::uint16_t>& moving, Planes& out);

 private:
  struct Move {
    std::uint32_t column;
    float x, y, z;
  };

  void listMoves(std::span<const std::vector<float>> influences);
  void collect(std::span<const Row> rows);
  void need(Index vector);
  void findMoving(std::span<const Row> rows, std::vector<std::uint16_t>& moving);
  void settle();
  Vec3 ofLoose(Index loose, Index column) const;

  const Rig& rig_;
  Index targets_, columns_;
  std::vector<std::size_t> firstMove_;  // [stored + 1]
  std::vector<Move> moves_;             // of each stored vector
  // For the current rows:
  std::vector<Index> needed_;            // vectors the rows are made of, directly or not, ascending
  std::vector<std::uint64_t> isNeeded_;  // [vectors] a bit for each
  std::vector<Index> stack_;
  std::vector<Index> placeOf_;  // [vectors] index in needed_, if needed
  std::vector<int> columnAt_;   // [columns] among those that move, or -1
  std::vector<Scaled> terms_;
  Planes settled_;  // [needed_]
};

}  // namespace sweepface
