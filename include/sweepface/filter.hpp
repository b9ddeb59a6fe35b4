#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sweepface/clip.hpp"

namespace sweepface {

/// How the one-euro filter trades noise for lag.
struct OneEuro {
  double cutoff = 1;       ///< hertz, at rest: lower removes more noise
  double speedGain = 8;    ///< hertz per unit of speed: higher follows quick moves more closely
  double speedCutoff = 5;  ///< hertz, of the speed's own filter: lower misses movement to and fro
};

/// Removes a tracker's noise from K weights: strongly where they rest, hardly where they move.
/// After G. Casiez, N. Roussel, D. Vogel, "1 € Filter: A Simple Speed-based Low-pass Filter for
/// Noisy Input in Interactive Systems", CHI 2012.
class OneEuroFilter {
 public:
  explicit OneEuroFilter(std::size_t count, const OneEuro& settings = {});

  /// Replaces the weights [K] of a frame, `seconds` after the last one, by filtered ones. The first
  /// frame, and one after no or an unknown time, passes unchanged. Allocates nothing.
  void apply(double seconds, std::span<double> weights) noexcept;

 private:
  OneEuro settings_;
  std::vector<double> values_, speeds_;
  bool begun_ = false;
};

/// Filters all frames of a clip from both ends and averages the two, so that nothing lags.
void smooth(Clip& clip, const OneEuro& settings = {});

}  // namespace sweepface
