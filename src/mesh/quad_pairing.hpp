#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Triangles that may be joined in pairs over the edge they share, and the stars of edges around
/// their vertices.
struct PairingProblem {
  struct Pair {
    std::array<Index, 2> triangles;
    double score = 0;  ///< how much rather a diagonal than an edge: a logarithm of odds
  };
  /// The edges around a vertex in their order.
  struct Star {
    Index begin = 0, end = 0;  ///< of `spokes`
    bool closed = false;       ///< faces all round
    int edges = 4;             ///< how many there should be
  };
  Index triangles = 0;
  std::vector<Pair> pairs;
  std::vector<Star> stars;
  std::vector<Index> spokes;  ///< the pair over the edge, or -1
};

/// Whether each pair is joined. Nearly maximises the sum of the scores less what triangles left
/// alone and stars of unusual size cost; no triangle is in two pairs and no closed star is left
/// with two edges. Depends on the problem alone.
std::vector<char> choosePairs(const PairingProblem& problem);

}  // namespace sweepface
