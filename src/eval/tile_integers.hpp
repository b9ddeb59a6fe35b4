#pragma once

#include <cstdint>
#include <vector>

#include "eval/low_rank.hpp"
#include "eval/tiles.hpp"

namespace sweepface {

/// Where 8 bits do.
struct TileForms {
  double step = 0;            ///< of coefficients of 8 bits, in units; 0: all have 16
  int wideModes = kMostRows;  ///< whose basis has 16 bits
};

/// Modes in the integers of the tables.
struct TileIntegers {
  int modes = 0, rows = 0, lane = 0;
  std::vector<std::int16_t> coefficients;  // [modes][3 × lane]
  std::vector<std::int16_t> basis;         // [modes][rows]
  std::vector<int> shifts;                 // [modes] 8 bits are in units of 2^shift
  std::vector<char> isNarrow;              // [targets]
  double scale = 0;                        // of basis · c
};
TileIntegers toIntegers(const LowRank& found, const Planes& wanted, TileForms forms);

/// The largest distance over all rows between the integers and what they stand for, for each target
/// at weight 1 [targets]; beyond `enough` the others are left as they are.
std::vector<double> errorsOf(const TileIntegers& integers, const Planes& wanted, double enough);

/// The most that sums of rounded numbers are off on top, for weights within [-1, 1].
double roundingOf(const TileIntegers& integers);

/// To a whole multiple of 2^shift within 16 bits.
std::int16_t toShort(double x, int shift);

}  // namespace sweepface
