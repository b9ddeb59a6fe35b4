#include "eval/tile_integers.hpp"

#include <algorithm>
#include <cmath>

namespace sweepface {

std::int16_t toShort(double x, int shift) {
  constexpr int kUp = 1 << 15;  // truncation rounds what is above 0
  const double steps = x * (1.0 / (1 << shift)), most = 32767 >> shift;
  const int rounded = static_cast<int>(std::clamp(steps, -most, most) + (kUp + 0.5)) - kUp;
  return static_cast<std::int16_t>(rounded * (1 << shift));
}

namespace {

// The largest number of a mode, and the largest sum of a component over all targets.
struct Sizes {
  double most = 0, sum = 0;

  Sizes(const float* coefficients, int lane) {
    for (int axis = 0; axis < 3; ++axis, coefficients += lane) {
      const Extent extent = extentOf({coefficients, static_cast<std::size_t>(lane)});
      most = std::max(most, double(extent.most));
      sum = std::max(sum, 1.0001 * extent.sum);  // summed in single precision
    }
  }
  // The smallest unit in which nothing overflows, if rounding may add `room` to each number.
  double unit(double room, int targets) const {
    return std::max({most / (kMostShort - room), sum / (kMostSum - room * targets), 1e-30});
  }
};

// The largest shift whose steps are no longer than `step`.
int shiftFor(double step, double unit, int targets) {
  int shift = 0;
  while (shift < kMostShift && unit * (2 << shift) <= step && targets * (2 << shift) < kMostSum)
    ++shift;
  return shift;
}

// Rounds a target's coefficients to 8 bits, if they fit.
bool narrow(TileIntegers& integers, int target) {
  const auto each = [&](const auto& use) {
    for (int m = 0; m < integers.modes; ++m)
      for (int axis = 0; axis < 3; ++axis)
        use(integers.coefficients[std::size_t(3 * m + axis) * integers.lane + target],
            integers.shifts[m]);
  };
  bool fits = true;
  each([&](std::int16_t x, int shift) { fits = fits && std::abs(int(x)) < 127 << shift; });
  if (fits)
    each([](std::int16_t& x, int shift) {
      x = static_cast<std::int16_t>((x + (1 << shift) / 2) >> shift << shift);
    });
  return fits;
}

}  // namespace

TileIntegers toIntegers(const LowRank& found, const Planes& wanted, TileForms forms) {
  const int rows = wanted.rows, width = wanted.width();
  TileIntegers out;
  out.modes = found.modes, out.rows = rows, out.lane = wanted.lane;
  out.coefficients.resize(std::size_t(found.modes) * width);
  out.basis.resize(std::size_t(found.modes) * rows);
  out.isNarrow.assign(wanted.targets, 0);
  std::vector<double> stepOf(found.modes);  // what a c_m of 1 stands for
  std::vector<double> sums(rows);
  double most = 0;
  for (int m = 0; m < found.modes; ++m) {
    const float* const from = found.coefficients.data() + std::size_t(m) * width;
    const Sizes sizes(from, wanted.lane);
    const int shift = shiftFor(forms.step, sizes.unit(1, wanted.targets), wanted.targets);
    const double unit = sizes.unit((1 << shift) / 2 + 1, wanted.targets);
    out.shifts.push_back(shift);
    stepOf[m] = unit * 65536 / kWeightUnit;
    roundAll({from, static_cast<std::size_t>(width)}, static_cast<float>(1 / unit),
             out.coefficients.data() + std::size_t(m) * width);
    for (int r = 0; r < rows; ++r) {
      const double size = std::abs(found.basis[std::size_t(m) * rows + r]) * stepOf[m];
      sums[r] += size;
      most = std::max(most, size);
    }
  }
  for (int k = 0; forms.step > 0 && k < wanted.targets; ++k) out.isNarrow[k] = narrow(out, k);
  const double sum = std::ranges::max(sums), half = 1 << (kBasisShift - 1);
  const double rounding = found.modes + std::max(0, found.modes - forms.wideModes) * half;
  out.scale = std::max({sum / (kMostBasis - rounding), most / (kMostShort - half), 1e-30});
  for (int m = 0; m < found.modes; ++m) {
    const double factor = stepOf[m] / out.scale;
    for (int r = 0; r < rows; ++r) {
      const std::size_t at = std::size_t(m) * rows + r;
      out.basis[at] = toShort(found.basis[at] * factor, m < forms.wideModes ? 0 : kBasisShift);
    }
  }
  return out;
}

// Computes in single precision, whose errors are far below the unit.
std::vector<double> errorsOf(const TileIntegers& integers, const Planes& wanted, double enough) {
  const double scale = integers.scale * kWeightUnit / 65536;
  std::vector<float> basis(integers.basis.size()), squares(wanted.lane);
  for (std::size_t k = 0; k < basis.size(); ++k)
    basis[k] = static_cast<float>(scale * integers.basis[k]);
  const std::vector<float> coefficients(integers.coefficients.begin(), integers.coefficients.end());
  measureRest(wanted, basis, coefficients.data(), static_cast<float>(enough * enough),
              squares.data());
  std::vector<double> worst(wanted.targets);
  for (int k = 0; k < wanted.targets; ++k) worst[k] = std::sqrt(double(squares[k]));
  return worst;
}

// Each c_m is off by 1/2 from its own rounding and by 1 from the rounding of weights, as
// coefficients add up to no more than 2¹⁷. Single precision adds less than a hundredth of that.
double roundingOf(const TileIntegers& integers) {
  double most = 0;
  for (int r = 0; r < integers.rows; ++r) {
    double sum = 0;
    for (int m = 0; m < integers.modes; ++m)
      sum += std::abs(integers.basis[std::size_t(m) * integers.rows + r]);
    most = std::max(most, sum);
  }
  return 1.01 * std::sqrt(3.0) * 1.5 * integers.scale * most;
}

}  // namespace sweepface
