#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface {

/// Triangles that may be joined in pairs across the edge they share, and the stars of edges around
/// their vertices. Scores are logarithms of odds.
struct PairingProblem {
  struct Pair {
    std::array<Index, 2> triangles;
    double score = 0;  ///< that the shared edge is a diagonal rather than an edge
  };
  /// The edges around a vertex in order, and the choices of those that are diagonals.
  struct Star {
    Index firstSpoke = 0, endSpoke = 0;    ///< of `spokes`; at most 16 where there are choices
    Index firstChoice = 0, endChoice = 0;  ///< of `choices`; none: all are equally good
  };
  struct Choice {
    std::uint16_t diagonals = 0;  ///< a bit for each spoke of the star
    double score = 0;
  };
  Index triangles = 0;
  double loneCost = 0;  ///< of a triangle that is not joined
  std::vector<Pair> pairs;
  std::vector<Star> stars;
  std::vector<Index> spokes;    ///< the pair across the edge, or -1; each pair twice at most
  std::vector<Choice> choices;  ///< of each star with ascending `diagonals`, the first of them 0
};

/// Whether each pair should be joined, for a total score near the maximum. No triangle is in two
/// joined pairs, and every star has one of its choices. Depends on the problem alone.
std::vector<char> choosePairs(const PairingProblem& problem);

}  // namespace sweepface
