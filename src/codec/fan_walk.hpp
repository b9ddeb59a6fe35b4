#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface::codec {

/// Goes around vertices from one neighbour to the next. The time is little more than linear in the
/// number of neighbours, since poles may have thousands.
class FanWalk {
 public:
  explicit FanWalk(std::size_t vertices)
      : first_(vertices, -1), arriving_(vertices, 0), metIn_(vertices, 0) {}

  /// From one neighbour of a vertex to the next, across a corner.
  using Step = std::array<Index, 2>;
  /// Appends the neighbours of `centre` that its steps meet, each once and never itself. Begins
  /// with the first step to whose start no other step leads, or else with the first of all, and
  /// goes on with the first that starts where the previous one ended. Begins again until no step is
  /// left.
  void around(Index centre, std::span<const Step> steps, std::vector<Index>& neighbours);

 private:
  void offerRest(Index vertex);
  Index takeHead(Index otherwise);

  // By vertex, each with its value between two calls:
  std::vector<Index> first_;     // the first remaining step that starts there: -1
  std::vector<Index> arriving_;  // how many remaining steps lead there: 0
  std::vector<Index> metIn_;     // the last walk that met it
  Index walk_ = 0;
  // By step:
  std::vector<Index> next_;  // the next step that starts at the same vertex, or -1
  std::vector<char> taken_;
  std::vector<Index> heads_;  // a heap of steps to begin with, some of them taken since
};

}  // namespace sweepface::codec
