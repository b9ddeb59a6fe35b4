#pragma once

#include <array>
#include <span>
#include <vector>

#include "sweepface/vec.hpp"

namespace sweepface::codec {

/// Goes around vertices from one neighbour to the next, in a time that hardly more than doubles
/// where a vertex has twice as many: poles may have thousands.
class FanWalk {
 public:
  explicit FanWalk(std::size_t vertices)
      : first_(vertices, -1), arriving_(vertices, 0), metIn_(vertices, 0) {}

  /// From one neighbour of a vertex to the next, across a corner.
  using Step = std::array<Index, 2>;
  /// Appends the neighbours of `centre` that its steps meet, each once and never itself. Begins
  /// with the first step to whose start no other leads, else with the first of all, and goes on
  /// with the first that starts where the last has led; begins again until none is left.
  void around(Index centre, std::span<const Step> steps, std::vector<Index>& neighbours);

 private:
  void offerRest(Index vertex);
  Index takeHead(Index otherwise);

  // By vertex, as they are between two calls:
  std::vector<Index> first_;     // of the steps that are left and start there: -1
  std::vector<Index> arriving_;  // how many that are left lead there: 0
  std::vector<Index> metIn_;     // the last walk that met it
  Index walk_ = 0;
  // By step:
  std::vector<Index> next_;  // of those that start at the same vertex, or -1
  std::vector<char> taken_;
  std::vector<Index> heads_;  // a heap of steps to begin with, some of them taken since
};

}  // namespace sweepface::codec
