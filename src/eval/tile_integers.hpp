#pragma once

#include <cstdint>
#include <vector>

#include "eval/low_rank.hpp"
#include "eval/tiles.hpp"

namespace sweepface {

/// Which numbers are stored in 8 bits.
struct TileForms {
  double step = 0;            ///< longest step of 8-bit coefficients, in units; 0: all have 16 bits
  int wideModes = kMostRows;  ///< how many modes, from the first on, have a basis of 16 bits
};

/// Modes as the integers that the tables hold.
struct TileIntegers {
  int modes = 0, rows = 0, lane = 0;
  std::vector<std::int16_t> coefficients;  // [modes][3 × lane]
  std::vector<std::int16_t> basis;         // [modes][rows]
  std::vector<int> shifts;                 // [modes] 8-bit coefficients are in units of 2^shift
  std::vector<char> isNarrow;              // [targets]
  double scale = 0;                        // of basis · c
};
TileIntegers toIntegers(const LowRank& found, const Planes& wanted, TileForms forms);

/// For each target at weight 1 [targets], the largest distance over all rows between the integers
/// and what they represent. Stops once one exceeds `enough`, leaving those not yet measured 0.
std::vector<double> errorsOf(const TileIntegers& integers, const Planes& wanted, double enough);

/// The most that rounded sums may be off in addition, for weights within [-1, 1].
double roundingOf(const TileIntegers& integers);

/// Rounds to a multiple of 2^shift that fits 16 bits.
std::int16_t toShort(double x, int shift);

}  // namespace sweepface
