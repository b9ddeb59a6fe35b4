#include "eval/tile_packer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "eval/tile_integers.hpp"
#include "surface/sorting.hpp"

namespace sweepface {
namespace {

constexpr double kMostScale = 1e19;  // stays finite when multiplied by 2³¹ and large weights

constexpr int pairsOf(std::ptrdiff_t count) { return static_cast<int>(count + 1) / 2; }
/// The first mode with a coefficient in a block.
constexpr int firstModeOf(int block) { return kGroup * block / 6 * 2; }
/// The mode of coefficient i.
constexpr int modeOf(int i) { return i / 6 * 2 + i % 2; }

class Packer {
 public:
  Packer(const TileSource& source, const LowRank& found, const TileIntegers& integers,
         TileForms forms)
      : source_(source), integers_(integers), modesOf_(found.modesOf), forms_(forms) {
    for (std::size_t k = 0; k < modesOf_.size(); ++k)
      if (modesOf_[k] > 0) (integers.isNarrow[k] ? narrow_ : wide_).push_back(static_cast<int>(k));
    for (auto* list : {&wide_, &narrow_})  // those with most modes first
      sortSmall(std::span(*list), [&](int a, int b) {
        return modesOf_[a] > modesOf_[b] || (modesOf_[a] == modesOf_[b] && a < b);
      });
  }

  /// Returns the step that the neutral is rounded to.
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
  const TileIntegers& integers_;
  const std::vector<int>& modesOf_;
  TileForms forms_;
  std::vector<int> wide_, narrow_;  // targets that have modes
};

bool isEnough(const std::vector<double>& errors) {
  return std::ranges::all_of(errors, [](double e) { return e <= 1; });
}

}  // namespace

PackedErrors packTile(const TileSource& source, std::uint16_t nobody, TileTable& table) {
  // Rounding the modes uses up part of the tolerance; where that is too much, more modes make up
  // for it.
  constexpr TileForms kForms[] = {
      {1.4, 4}, {1.0, kMostRows}, {0.5, kMostRows}, {}};  // the smallest first
  const Planes& wanted = source.differences;
  PackedErrors errors;
  LowRank found;
  TileIntegers integers;
  TileForms used;
  double share = 0.85;
  bool isDone = false;
  for (int attempt = 0; attempt < 4 && !isDone; ++attempt, share *= 0.6) {
    found = factorise(wanted, static_cast<float>(share));
    for (const TileForms& forms : kForms) {
      used = forms;
      integers = toIntegers(found, wanted, used);
      const bool isLast = forms.step == 0;
      errors.ofTarget = errorsOf(integers, wanted, isLast ? kMostScale : 1);
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
