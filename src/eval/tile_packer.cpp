#include "eval/tile_packer.hpp"

#include <cmath>
#include <cstring>

namespace sweepface {
namespace {

constexpr double kMostScale = 1e19;  // times 2³¹ and large weights it stays finite

/// Modes in the integers of the tables.
struct Integers {
  int modes = 0, targets = 0;
  std::vector<std::int16_t> coefficients;  // [modes][targets × 3]
  std::vector<std::int16_t> basis;         // [modes][rows]
  double scale = 0;                        // of basis · c
};

std::int16_t toShort(double x) {
  return static_cast<std::int16_t>(std::clamp(std::floor(x + 0.5), -kMostShort, kMostShort));
}

/// The unit of a mode's coefficients: the smallest with which neither one of them nor the sum of a
/// component over all targets overflows.
double coefficientUnit(std::span<const float> coefficients, int targets) {
  double most = 0, sums[3] = {};
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const double size = std::abs(double(coefficients[i]));
    most = std::max(most, size);
    sums[i % 3] += size;
  }
  const double sum = std::max({sums[0], sums[1], sums[2]});
  return std::max({most / kMostShort, sum / (kMostSum - targets), 1e-30});
}

Integers toIntegers(const LowRank& found, int rows, int targets) {
  Integers out{found.modes, targets, {}, {}, 0};
  const int columns = 3 * targets;
  std::vector<double> stepOf(found.modes);  // what 1 of c_m is
  for (int m = 0; m < found.modes; ++m) {
    const std::span<const float> coefficients(found.coefficients.data() + std::size_t(m) * columns,
                                              columns);
    const double unit = coefficientUnit(coefficients, targets);
    stepOf[m] = unit * 65536 / kWeightUnit;
    for (const float x : coefficients) out.coefficients.push_back(toShort(x / unit));
  }
  double sum = 0, most = 0;
  for (int r = 0; r < rows; ++r) {
    double ofRow = 0;
    for (int m = 0; m < found.modes; ++m) {
      const double size = std::abs(found.basis[std::size_t(m) * rows + r]) * stepOf[m];
      ofRow += size;
      most = std::max(most, size);
    }
    sum = std::max(sum, ofRow);
  }
  out.scale = std::max({sum / (kMostBasis - found.modes), most / kMostShort, 1e-30});
  for (int m = 0; m < found.modes; ++m)
    for (int r = 0; r < rows; ++r)
      out.basis.push_back(toShort(found.basis[std::size_t(m) * rows + r] * stepOf[m] / out.scale));
  return out;
}

/// The largest distance over all rows between the integers and what they stand for, for each target
/// at weight 1.
std::vector<double> measure(const Integers& integers, const Differences& wanted) {
  std::vector<double> worst(wanted.targets);
  std::vector<float> sums(wanted.columns());  // errors of single precision are far below the unit
  const double scale = integers.scale * kWeightUnit / 65536;
  for (int r = 0; r < wanted.rows; ++r) {
    std::ranges::fill(sums, 0.0f);
    for (int m = 0; m < integers.modes; ++m) {
      const float b = static_cast<float>(scale * integers.basis[std::size_t(m) * wanted.rows + r]);
      const std::int16_t* from = integers.coefficients.data() + std::size_t(m) * sums.size();
      for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += b * from[c];
    }
    for (int k = 0; k < wanted.targets; ++k) {
      double squared = 0;
      for (int c = 3 * k; c < 3 * k + 3; ++c) {
        const double off = sums[c] - wanted.row(r)[c];
        squared += off * off;
      }
      worst[k] = std::max(worst[k], squared);
    }
  }
  for (double& x : worst) x = std::sqrt(x);
  return worst;
}

/// Each c_m is off by 1/2 from rounding it and by 1 from rounding weights, as coefficients add up
/// to no more than 2¹⁷; single precision adds less than a hundredth of that.
double roundingOf(const Integers& integers, int rows) {
  double most = 0;
  for (int r = 0; r < rows; ++r) {
    double sum = 0;
    for (int m = 0; m < integers.modes; ++m)
      sum += std::abs(integers.basis[std::size_t(m) * rows + r]);
    most = std::max(most, sum);
  }
  return 1.01 * std::sqrt(3.0) * 1.5 * integers.scale * most;
}

class Packer {
 public:
  Packer(const TileSource& source, const LowRank& found, const Integers& integers)
      : source_(source),
        integers_(integers),
        modesOf_(found.modesOf),
        order_(found.modesOf.size()) {
    for (std::size_t k = 0; k < order_.size(); ++k)  // those with most modes first
      order_[k] = (kMostRows - modesOf_[k]) << 16 | static_cast<int>(k);
    std::ranges::sort(order_);
    for (int& k : order_) k &= 0xffff;
    while (!order_.empty() && modesOf_[order_.back()] == 0) order_.pop_back();
  }

  void write(std::uint16_t nobody, TileTable& table) {
    TileHead head = makeHead(table.groups());
    std::byte* const record = table.add(head.bytes, head.pairs);
    std::memcpy(record, &head, sizeof(head));
    const Tile tile = tileAt(record);
    writeTargets(const_cast<std::uint16_t*>(tile.targets), nobody);
    writeCoefficients(head, const_cast<std::int16_t*>(tile.coefficients));
    writeBasis(table.groups(), const_cast<std::int16_t*>(tile.basis));
    writeNeutral(const_cast<float*>(tile.neutral));
    std::ranges::copy(source_.vertices, const_cast<std::uint32_t*>(tile.vertices));
  }

 private:
  int modePairs() const { return (integers_.modes + 1) / 2; }
  int pairs() const { return static_cast<int>(order_.size() + 1) / 2; }

  TileHead makeHead(int groups) const {
    TileHead head;
    head.scale = static_cast<float>(std::min(integers_.scale * source_.unit, kMostScale));
    head.vertices = static_cast<std::uint16_t>(source_.vertices.size());
    head.pairs = static_cast<std::uint16_t>(pairs());
    head.modePairs = static_cast<std::uint16_t>(modePairs());
    head.blocks = static_cast<std::uint16_t>((6 * modePairs() + kGroup - 1) / kGroup);
    std::size_t units = 0;
    for (int b = 0; b < head.blocks; ++b) {
      const int firstMode = kGroup * b / 6 * 2;
      const auto users =
          std::ranges::count_if(order_, [&](int k) { return modesOf_[k] > firstMode; });
      head.blockPairs[b] = static_cast<std::uint16_t>((users + 1) / 2);
      units += head.blockPairs[b];
    }
    head.windows = windows();
    std::size_t at = sizeof(head);
    const auto place = [&](std::size_t bytes) {
      return static_cast<std::uint32_t>(std::exchange(at, at + bytes));
    };
    place(roundUp64(4 * head.pairs));
    head.coefficientsAt = place(64 * units);
    head.basisAt = place(std::size_t(64) * groups * head.modePairs);
    head.neutralAt = place(std::size_t(192) * groups);
    head.verticesAt = place(4 * kTileVertices);
    head.bytes = place(0);
    return head;
  }

  std::uint64_t windows() const {
    std::uint64_t mask = 0;
    for (const int k : order_) {
      const int window = source_.targets[k] / 64;
      if (window >= 64) return 0;
      mask |= std::uint64_t(1) << window;
    }
    return mask;
  }

  void writeTargets(std::uint16_t* out, std::uint16_t nobody) const {
    for (int i = 0; i < 2 * pairs(); ++i)
      out[i] = i < static_cast<int>(order_.size()) ? source_.targets[order_[i]] : nobody;
  }

  std::int16_t coefficient(int mode, int place, int component) const {
    if (mode >= integers_.modes || place >= static_cast<int>(order_.size())) return 0;
    const int k = order_[place];
    if (mode >= modesOf_[k]) return 0;
    return integers_.coefficients[std::size_t(mode) * 3 * integers_.targets + 3 * k + component];
  }

  void writeCoefficients(const TileHead& head, std::int16_t* out) const {
    for (int b = 0; b < head.blocks; ++b)
      for (int p = 0; p < head.blockPairs[b]; ++p)
        for (int lane = 0; lane < kGroup; ++lane)
          for (int side = 0; side < 2; ++side) {
            const int i = kGroup * b + lane;
            *out++ = coefficient(i / 6 * 2 + i % 2, 2 * p + side, i % 6 / 2);
          }
  }

  void writeBasis(int groups, std::int16_t* out) const {
    const int rows = source_.differences.rows;
    for (int g = 0; g < groups; ++g)
      for (int p = 0; p < modePairs(); ++p)
        for (int lane = 0; lane < kGroup; ++lane)
          for (int mode = 2 * p; mode < 2 * p + 2; ++mode) {
            const int row = kGroup * g + lane;
            *out++ = mode < integers_.modes ? integers_.basis[std::size_t(mode) * rows + row] : 0;
          }
  }

  void writeNeutral(float* out) const {
    for (std::size_t row = 0; row < source_.neutral.size(); ++row)
      for (std::size_t c = 0; c < 3; ++c)
        out[(row / kGroup * 3 + c) * kGroup + row % kGroup] = source_.neutral[row][c];
  }

  const TileSource& source_;
  const Integers& integers_;
  const std::vector<int>& modesOf_;
  std::vector<int> order_;  // of targets
};

}  // namespace

PackedErrors packTile(const TileSource& source, std::uint16_t nobody, TileTable& table) {
  // Rounding the modes takes its share; where that is too much, more modes make up for it.
  PackedErrors errors;
  LowRank found;
  Integers integers;
  double share = 0.95;
  for (int attempt = 0; attempt < 4; ++attempt, share *= 0.6) {
    found = factorise(source.differences, static_cast<float>(share));
    integers = toIntegers(found, source.differences.rows, source.differences.targets);
    errors.ofTarget = measure(integers, source.differences);
    if (std::ranges::all_of(errors.ofTarget, [](double e) { return e <= 1; })) break;
  }
  errors.rounding = roundingOf(integers, source.differences.rows);
  Packer(source, found, integers).write(nobody, table);
  return errors;
}

}  // namespace sweepface
