#include "eval/tile_packer.hpp"

#include <cmath>
#include <cstring>

#include "eval/low_rank.hpp"
#include "surface/sorting.hpp"

namespace sweepface {
namespace {

constexpr double kMostScale = 1e19;  // times 2³¹ and large weights it stays finite

/// How many modes keep 16 bits of their coefficients and of their basis.
struct Wide {
  int coefficients, basis;
};

/// Modes in the integers of the tables.
struct Integers {
  int modes = 0, rows = 0, lane = 0;
  std::vector<std::int16_t> coefficients;  // [modes][3 × lane]
  std::vector<std::int16_t> basis;         // [modes][rows]
  double scale = 0;                        // of basis · c
};

/// To whole multiples of 1 or of 256.
std::int16_t toShort(double x, bool wide) {
  const int step = wide ? 1 : kNarrow;
  const double most = std::floor(kMostShort / step);
  return static_cast<std::int16_t>(step * std::clamp(std::floor(x / step + 0.5), -most, most));
}

/// The unit of a mode's coefficients: the smallest with which neither one of them nor the sum of a
/// component over all targets overflows.
double coefficientUnit(const float* coefficients, int lane, int targets, bool wide) {
  double most = 0, largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (int k = 0; k < targets; ++k) {
      const double size = std::abs(double(coefficients[axis * lane + k]));
      most = std::max(most, size);
      sum += size;
    }
    largest = std::max(largest, sum);
  }
  const double room = wide ? 1 : kNarrow / 2;  // for rounding
  return std::max({most / (kMostShort - room), largest / (kMostSum - room * targets), 1e-30});
}

/// With too many targets, rounding to 8 bits could overflow.
bool allowsNarrow(int targets) { return targets * kNarrow < kMostSum / 2; }

Integers toIntegers(const LowRank& found, const Planes& wanted, Wide wide) {
  const int rows = wanted.rows, width = wanted.width();
  Integers out;
  out.modes = found.modes, out.rows = rows, out.lane = wanted.lane;
  out.coefficients.resize(std::size_t(found.modes) * width);
  out.basis.resize(std::size_t(found.modes) * rows);
  std::vector<double> stepOf(found.modes);  // what 1 of c_m is
  std::vector<double> sums(rows);
  double most = 0;
  for (int m = 0; m < found.modes; ++m) {
    const float* const from = found.coefficients.data() + std::size_t(m) * width;
    const bool isWide = m < wide.coefficients;
    const double unit = coefficientUnit(from, wanted.lane, wanted.targets, isWide);
    stepOf[m] = unit * 65536 / kWeightUnit;
    std::int16_t* const to = out.coefficients.data() + std::size_t(m) * width;
    for (int c = 0; c < width; ++c) to[c] = toShort(from[c] / unit, isWide);
    for (int r = 0; r < rows; ++r) {
      const double size = std::abs(found.basis[std::size_t(m) * rows + r]) * stepOf[m];
      sums[r] += size;
      most = std::max(most, size);
    }
  }
  const double sum = rows > 0 ? std::ranges::max(sums) : 0;
  const int narrow = std::max(0, found.modes - wide.basis);
  const double rounding = found.modes + narrow * (kNarrow / 2);
  out.scale = std::max({sum / (kMostBasis - rounding), most / (kMostShort - kNarrow / 2), 1e-30});
  for (int m = 0; m < found.modes; ++m)
    for (int r = 0; r < rows; ++r) {
      const std::size_t at = std::size_t(m) * rows + r;
      out.basis[at] = toShort(found.basis[at] * stepOf[m] / out.scale, m < wide.basis);
    }
  return out;
}

/// The largest distance over all rows between the integers and what they stand for, for each target
/// at weight 1. Errors of single precision are far below the unit.
std::vector<double> measure(const Integers& integers, const Planes& wanted) {
  const double scale = integers.scale * kWeightUnit / 65536;
  std::vector<float> basis(integers.basis.size()), squares(wanted.lane);
  for (std::size_t k = 0; k < basis.size(); ++k)
    basis[k] = static_cast<float>(scale * integers.basis[k]);
  const std::vector<float> coefficients(integers.coefficients.begin(), integers.coefficients.end());
  measureRest(wanted, basis, coefficients.data(), squares.data());
  std::vector<double> worst(wanted.targets);
  for (int k = 0; k < wanted.targets; ++k) worst[k] = std::sqrt(double(squares[k]));
  return worst;
}

/// Each c_m is off by 1/2 from rounding it and by 1 from rounding weights, as coefficients add up
/// to no more than 2¹⁷; single precision adds less than a hundredth of that.
double roundingOf(const Integers& integers) {
  double most = 0;
  for (int r = 0; r < integers.rows; ++r) {
    double sum = 0;
    for (int m = 0; m < integers.modes; ++m)
      sum += std::abs(integers.basis[std::size_t(m) * integers.rows + r]);
    most = std::max(most, sum);
  }
  return 1.01 * std::sqrt(3.0) * 1.5 * integers.scale * most;
}

constexpr int pairsOf(int count) { return (count + 1) / 2; }
/// The block that coefficients of a mode begin in.
constexpr int blockOf(int mode) { return 6 * (mode / 2) / kGroup; }
/// The first mode of which a block has a coefficient.
constexpr int firstModeOf(int block) { return kGroup * block / 6 * 2; }

class Packer {
 public:
  Packer(const TileSource& source, const LowRank& found, const Integers& integers, Wide wide)
      : source_(source),
        integers_(integers),
        modesOf_(found.modesOf),
        wide_(wide),
        order_(found.modesOf.size()) {
    for (std::size_t k = 0; k < order_.size(); ++k)  // those with most modes first
      order_[k] = (kMostRows - modesOf_[k]) << 16 | static_cast<int>(k);
    sortSmall(std::span(order_));
    for (int& k : order_) k &= 0xffff;
    while (!order_.empty() && modesOf_[order_.back()] == 0) order_.pop_back();
  }

  void write(std::uint16_t nobody, TileTable& table) {
    const TileHead head = makeHead(table.groups());
    std::byte* const record = table.add(head.bytes, head.pairs);
    std::memcpy(record, &head, sizeof(head));
    writeTargets(reinterpret_cast<std::uint16_t*>(record + sizeof(head)), nobody);
    writeCoefficients(head, record + head.coefficientsAt);
    writeBasis(head, table.groups(), record + head.basisAt);
    writeNeutral(reinterpret_cast<float*>(record + head.neutralAt));
    std::ranges::copy(source_.vertices, reinterpret_cast<std::uint32_t*>(record + head.verticesAt));
  }

 private:
  int pairs() const { return pairsOf(static_cast<int>(order_.size())); }

  TileHead makeHead(int groups) const {
    TileHead head;
    head.scale = static_cast<float>(std::min(integers_.scale * source_.unit, kMostScale));
    head.vertices = static_cast<std::uint16_t>(source_.vertices.size());
    head.pairs = static_cast<std::uint16_t>(pairs());
    head.modePairs = static_cast<std::uint16_t>(pairsOf(integers_.modes));
    head.wideModePairs =
        static_cast<std::uint16_t>(std::min<int>(pairsOf(wide_.basis), head.modePairs));
    head.blocks = static_cast<std::uint16_t>((6 * head.modePairs + kGroup - 1) / kGroup);
    std::size_t coefficients = 0;
    for (int b = 0; b < head.blocks; ++b) {
      const auto users =
          std::ranges::count_if(order_, [&](int k) { return modesOf_[k] > firstModeOf(b); });
      head.blockPairs[b] = static_cast<std::uint16_t>(pairsOf(static_cast<int>(users)));
      const bool isWide = firstModeOf(b) < wide_.coefficients;
      head.wideBlocks = static_cast<std::uint16_t>(head.wideBlocks + isWide);
      coefficients += (isWide ? 4 : 2) * kGroup * std::size_t(head.blockPairs[b]);
    }
    std::size_t at = sizeof(head);
    const auto place = [&](std::size_t bytes) {
      return static_cast<std::uint32_t>(std::exchange(at, at + bytes));
    };
    place(roundUp32(4 * head.pairs));
    head.coefficientsAt = place(coefficients);
    head.basisAt = place(basisBytes(head) * groups);
    head.neutralAt = place(std::size_t(192) * groups);
    head.verticesAt = place(4 * kTileVertices);
    head.bytes = place(0);
    return head;
  }

  void writeTargets(std::uint16_t* out, std::uint16_t nobody) const {
    for (int i = 0; i < 2 * pairs(); ++i)
      out[i] = i < static_cast<int>(order_.size()) ? source_.targets[order_[i]] : nobody;
  }

  /// A number with all of its bits, or with the upper half.
  static void put(std::byte*& out, std::int16_t x, bool isWide) {
    *out = static_cast<std::byte>((isWide ? x : x / kNarrow) & 0xff);
    ++out;
    if (isWide) *out++ = static_cast<std::byte>(x >> 8 & 0xff);
  }

  void writeCoefficients(const TileHead& head, std::byte* out) const {
    const int users = static_cast<int>(order_.size());
    for (int b = 0; b < head.blocks; ++b) {
      const bool isWide = b < head.wideBlocks;
      for (int p = 0; p < head.blockPairs[b]; ++p)
        for (int i = kGroup * b; i < kGroup * (b + 1); ++i)
          for (int place = 2 * p; place < 2 * p + 2; ++place) {
            const int mode = i / 6 * 2 + i % 2, axis = i % 6 / 2;
            const bool has = place < users && mode < modesOf_[order_[place]];
            put(out,
                has ? integers_.coefficients[std::size_t(3 * mode + axis) * integers_.lane +
                                             order_[place]]
                    : std::int16_t(0),
                isWide);
          }
    }
  }

  void writeBasis(const TileHead& head, int groups, std::byte* out) const {
    for (int g = 0; g < groups; ++g)
      for (int p = 0; p < head.modePairs; ++p)
        for (int row = kGroup * g; row < kGroup * (g + 1); ++row)
          for (int mode = 2 * p; mode < 2 * p + 2; ++mode)
            put(out,
                mode < integers_.modes ? integers_.basis[std::size_t(mode) * integers_.rows + row]
                                       : std::int16_t(0),
                p < head.wideModePairs);
  }

  void writeNeutral(float* out) const {
    for (std::size_t row = 0; row < source_.neutral.size(); ++row)
      for (std::size_t c = 0; c < 3; ++c)
        out[(row / kGroup * 3 + c) * kGroup + row % kGroup] = source_.neutral[row][c];
  }

  const TileSource& source_;
  const Integers& integers_;
  const std::vector<int>& modesOf_;
  Wide wide_;
  std::vector<int> order_;  // of targets
};

bool isEnough(const std::vector<double>& errors) {
  return std::ranges::all_of(errors, [](double e) { return e <= 1; });
}

}  // namespace

PackedErrors packTile(const TileSource& source, std::uint16_t nobody, TileTable& table) {
  // Rounding the modes takes its share; where that is too much, more modes make up for it.
  const Planes& wanted = source.differences;
  PackedErrors errors;
  LowRank found;
  Integers integers;
  Wide wide{};
  double share = 0.95;
  for (int attempt = 0; attempt < 4; ++attempt, share *= 0.6) {
    found = factorise(wanted, static_cast<float>(share));
    // As many bits as the first block of coefficients needs, then as all may have.
    for (const int first : {firstModeOf(1), kMostRows}) {
      wide = {first, first == kMostRows ? kMostRows : 4};
      if (first != kMostRows && !allowsNarrow(wanted.targets)) continue;
      integers = toIntegers(found, wanted, wide);
      errors.ofTarget = measure(integers, wanted);
      if (isEnough(errors.ofTarget)) break;
    }
    if (isEnough(errors.ofTarget)) break;
  }
  errors.rounding = roundingOf(integers);
  Packer(source, found, integers, wide).write(nobody, table);
  return errors;
}

}  // namespace sweepface
