#include "eval/tile_packer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "eval/low_rank.hpp"
#include "surface/sorting.hpp"

namespace sweepface {
namespace {

constexpr double kMostScale = 1e19;  // times 2³¹ and large weights it stays finite

/// Where 8 bits do.
struct Forms {
  double step = 0;            ///< of coefficients of 8 bits, in units; 0: all have 16
  int wideModes = kMostRows;  ///< whose basis has 16 bits
};

/// Modes in the integers of the tables.
struct Integers {
  int modes = 0, rows = 0, lane = 0;
  std::vector<std::int16_t> coefficients;  // [modes][3 × lane]
  std::vector<std::int16_t> basis;         // [modes][rows]
  std::vector<int> shifts;                 // [modes] 8 bits are in units of 2^shift
  std::vector<char> isNarrow;              // [targets]
  double scale = 0;                        // of basis · c
};

/// To a whole multiple of 2^shift within 16 bits.
std::int16_t toShort(double x, int shift) {
  constexpr int kUp = 1 << 15;  // what is above 0 is rounded by cutting it off
  const double steps = x * (1.0 / (1 << shift)), most = 32767 >> shift;
  const int rounded = static_cast<int>(std::clamp(steps, -most, most) + (kUp + 0.5)) - kUp;
  return static_cast<std::int16_t>(rounded * (1 << shift));
}

/// The largest number of a mode, and the largest sum of a component over all targets.
struct Sizes {
  double most = 0, sum = 0;

  Sizes(const float* coefficients, int lane) {
    for (int axis = 0; axis < 3; ++axis, coefficients += lane) {
      const Extent extent = extentOf({coefficients, static_cast<std::size_t>(lane)});
      most = std::max(most, double(extent.most));
      sum = std::max(sum, 1.0001 * extent.sum);  // added up in single precision
    }
  }
  /// The smallest unit with which nothing overflows, where rounding may add `room` to each.
  double unit(double room, int targets) const {
    return std::max({most / (kMostShort - room), sum / (kMostSum - room * targets), 1e-30});
  }
};

/// The largest shift with which steps are no longer than `step`.
int shiftFor(double step, double unit, int targets) {
  int shift = 0;
  while (shift < kMostShift && unit * (2 << shift) <= step &&
         double(targets) * (2 << shift) <= kMostSum)
    ++shift;
  return shift;
}

/// Rounds a target's coefficients to what 8 bits hold, if they do.
bool narrow(Integers& integers, int target) {
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

Integers toIntegers(const LowRank& found, const Planes& wanted, Forms forms) {
  const int rows = wanted.rows, width = wanted.width();
  Integers out;
  out.modes = found.modes, out.rows = rows, out.lane = wanted.lane;
  out.coefficients.resize(std::size_t(found.modes) * width);
  out.basis.resize(std::size_t(found.modes) * rows);
  out.isNarrow.assign(wanted.targets, 0);
  std::vector<double> stepOf(found.modes);  // what 1 of c_m is
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

/// The largest distance over all rows between the integers and what they stand for, for each target
/// at weight 1. Errors of single precision are far below the unit.
std::vector<double> measure(const Integers& integers, const Planes& wanted, double enough) {
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

constexpr int pairsOf(std::ptrdiff_t count) { return static_cast<int>(count + 1) / 2; }
/// The first mode of which a block has a coefficient.
constexpr int firstModeOf(int block) { return kGroup * block / 6 * 2; }
/// The mode of coefficient i.
constexpr int modeOf(int i) { return i / 6 * 2 + i % 2; }

class Packer {
 public:
  Packer(const TileSource& source, const LowRank& found, const Integers& integers, Forms forms)
      : source_(source), integers_(integers), modesOf_(found.modesOf), forms_(forms) {
    for (std::size_t k = 0; k < modesOf_.size(); ++k)
      if (modesOf_[k] > 0) (integers.isNarrow[k] ? narrow_ : wide_).push_back(static_cast<int>(k));
    for (auto* list : {&wide_, &narrow_})  // those with most modes first
      sortSmall(std::span(*list), [&](int a, int b) {
        return modesOf_[a] > modesOf_[b] || (modesOf_[a] == modesOf_[b] && a < b);
      });
  }

  /// Gives what the neutral is rounded to.
  float write(std::uint16_t nobody, TileTable& table) {
    const TileHead head = makeHead(table.groups());
    std::byte* const record = table.add(head.bytes);
    std::memcpy(record, &head, sizeof(head));
    const Tile tile = tileAt(record);
    writePairs(const_cast<BlockPairs*>(tile.pairs));
    writeShifts(const_cast<std::uint8_t*>(tile.shifts));
    writeTargets(const_cast<std::uint16_t*>(tile.targets), nobody);
    writeCoefficients(record + head.coefficientsAt);
    writeBasis(head, record + head.basisAt);
    writeNeutral(head, reinterpret_cast<std::int16_t*>(record + head.neutralAt));
    writeVertices(head.wideVertices, record + head.neutralAt + kNeutralBytes * head.groups);
    return head.step;
  }

 private:
  int modePairs() const { return pairsOf(integers_.modes); }
  int blocks() const { return (6 * modePairs() + kGroup - 1) / kGroup; }
  int usersOf(const std::vector<int>& list, int block) const {
    const int first = firstModeOf(block);
    return pairsOf(std::ranges::count_if(list, [&](int k) { return modesOf_[k] > first; }));
  }

  TileHead makeHead(int groups) const {
    TileHead head;
    head.scale = static_cast<float>(std::min(integers_.scale * source_.unit, kMostScale));
    head.vertices = static_cast<std::uint8_t>(source_.vertices.size());
    head.groups = static_cast<std::uint8_t>(groups);
    head.wideVertices = std::ranges::any_of(source_.vertices, [](auto v) { return v > 0xffff; });
    boxNeutral(head);
    head.windows = windows();
    head.widePairs = static_cast<std::uint16_t>(pairsOf(std::ssize(wide_)));
    head.pairs = static_cast<std::uint16_t>(head.widePairs + pairsOf(std::ssize(narrow_)));
    head.modePairs = static_cast<std::uint8_t>(modePairs());
    head.wideModePairs =
        static_cast<std::uint8_t>(std::min(pairsOf(forms_.wideModes), modePairs()));
    head.blocks = static_cast<std::uint8_t>(blocks());
    std::size_t coefficients = 0;
    for (int b = 0; b < blocks(); ++b)
      coefficients += kGroup * (4 * std::size_t(usersOf(wide_, b)) + 2 * usersOf(narrow_, b));
    std::size_t at =
        roundUp32(sizeof(head) + (sizeof(BlockPairs) + kGroup) * head.blocks + 4 * head.pairs);
    const auto place = [&](std::size_t bytes) {
      return static_cast<std::uint32_t>(std::exchange(at, at + bytes));
    };
    head.coefficientsAt = place(coefficients);
    head.basisAt = place(basisBytes(head) * groups);
    head.neutralAt = place(kNeutralBytes * groups);
    place((head.wideVertices ? 4 : 2) * kTileVertices);
    head.bytes = place(0);
    return head;
  }

  std::uint64_t windows() const {
    std::uint64_t mask = 0;
    for (const auto* list : {&wide_, &narrow_})
      for (const int k : *list) {
        const int window = source_.targets[k] / 64;
        if (window >= 64) return 0;
        mask |= std::uint64_t(1) << window;
      }
    return mask;
  }

  void boxNeutral(TileHead& head) const {
    double longest = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double low = source_.neutral[0][c], high = low;
      for (const auto& row : source_.neutral)
        low = std::min(low, double(row[c])), high = std::max(high, double(row[c]));
      head.origin[c] = static_cast<float>((low + high) / 2);
      longest = std::max({longest, high - head.origin[c], head.origin[c] - low});
    }
    head.step = static_cast<float>(longest / kMostShort);
  }

  void writePairs(BlockPairs* out) const {
    for (int b = 0; b < blocks(); ++b)
      out[b] = {static_cast<std::uint16_t>(usersOf(wide_, b)),
                static_cast<std::uint16_t>(usersOf(narrow_, b))};
  }

  void writeShifts(std::uint8_t* out) const {
    for (int i = 0; i < kGroup * blocks(); ++i) out[i] = static_cast<std::uint8_t>(shiftOf(i));
  }

  void writeTargets(std::uint16_t* out, std::uint16_t nobody) const {
    for (const auto* list : {&wide_, &narrow_}) {
      for (const int k : *list) *out++ = source_.targets[k];
      if (list->size() % 2 == 1) *out++ = nobody;
    }
  }

  static void put(std::byte*& out, int x, bool isWide) {
    *out++ = static_cast<std::byte>(x & 0xff);
    if (isWide) *out++ = static_cast<std::byte>(x >> 8 & 0xff);
  }

  void writeCoefficients(std::byte* out) const {
    for (int b = 0; b < blocks(); ++b)
      for (const bool isWide : {true, false}) {
        const std::vector<int>& list = isWide ? wide_ : narrow_;
        const int users = usersOf(list, b);
        for (int p = 0; p < users; ++p)
          for (int i = kGroup * b; i < kGroup * (b + 1); ++i)
            for (int place = 2 * p; place < 2 * p + 2; ++place)
              put(out, coefficient(list, place, i) >> (isWide ? 0 : shiftOf(i)), isWide);
      }
  }

  int shiftOf(int i) const { return modeOf(i) < integers_.modes ? integers_.shifts[modeOf(i)] : 0; }

  int coefficient(const std::vector<int>& list, int place, int i) const {
    const int mode = modeOf(i), axis = i % 6 / 2;
    if (place >= std::ssize(list) || mode >= modesOf_[list[place]]) return 0;
    return integers_.coefficients[std::size_t(3 * mode + axis) * integers_.lane + list[place]];
  }

  void writeBasis(const TileHead& head, std::byte* out) const {
    for (int g = 0; g < head.groups; ++g)
      for (int p = 0; p < head.modePairs; ++p) {
        const bool isWide = p < head.wideModePairs;
        for (int row = kGroup * g; row < kGroup * (g + 1); ++row)
          for (int mode = 2 * p; mode < 2 * p + 2; ++mode) {
            const int x = mode < integers_.modes
                              ? integers_.basis[std::size_t(mode) * integers_.rows + row]
                              : 0;
            put(out, x >> (isWide ? 0 : kBasisShift), isWide);
          }
      }
  }

  void writeNeutral(const TileHead& head, std::int16_t* out) const {
    const double perStep = head.step > 0 ? 1 / double(head.step) : 0;
    for (std::size_t row = 0; row < source_.neutral.size(); ++row)
      for (std::size_t c = 0; c < 3; ++c)
        out[(row / kGroup * 3 + c) * kGroup + row % kGroup] =
            toShort((double(source_.neutral[row][c]) - double(head.origin[c])) * perStep, 0);
  }

  void writeVertices(bool isWide, std::byte* out) const {
    for (const std::uint32_t vertex : source_.vertices)
      for (int byte = 0; byte < (isWide ? 4 : 2); ++byte)
        *out++ = static_cast<std::byte>(vertex >> 8 * byte & 0xff);
  }

  const TileSource& source_;
  const Integers& integers_;
  const std::vector<int>& modesOf_;
  Forms forms_;
  std::vector<int> wide_, narrow_;  // targets that have modes
};

bool isEnough(const std::vector<double>& errors) {
  return std::ranges::all_of(errors, [](double e) { return e <= 1; });
}

}  // namespace

PackedErrors packTile(const TileSource& source, std::uint16_t nobody, TileTable& table) {
  // Rounding the modes takes its share; where that is too much, more modes make up for it.
  constexpr Forms kForms[] = {
      {1.4, 4}, {1.0, kMostRows}, {0.5, kMostRows}, {}};  // the smallest first
  const Planes& wanted = source.differences;
  PackedErrors errors;
  LowRank found;
  Integers integers;
  Forms used;
  double share = 0.85;
  bool isDone = false;
  for (int attempt = 0; attempt < 4 && !isDone; ++attempt, share *= 0.6) {
    found = factorise(wanted, static_cast<float>(share));
    for (const Forms& forms : kForms) {
      used = forms;
      integers = toIntegers(found, wanted, used);
      const bool isLast = forms.step == 0;
      errors.ofTarget = measure(integers, wanted, isLast ? kMostScale : 1);
      isDone = isEnough(errors.ofTarget);
      if (isDone) break;
    }
  }
  errors.rounding = roundingOf(integers);
  const float step = Packer(source, found, integers, used).write(nobody, table);
  errors.rounding += std::sqrt(3.0) / 2 * step / source.unit;
  return errors;
}

}  // namespace sweepface
