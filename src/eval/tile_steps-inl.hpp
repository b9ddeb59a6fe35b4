// The steps of evaluating one tile, for registers of 4, 8 or 16 numbers. Included once for every
// instruction set by tile_kernels.cpp.
#if defined(SWEEPFACE_TILE_STEPS) == defined(HWY_TARGET_TOGGLE)
#ifdef SWEEPFACE_TILE_STEPS
#undef SWEEPFACE_TILE_STEPS
#else
#define SWEEPFACE_TILE_STEPS
#endif

#include <cstring>
#include <hwy/highway.h>

#include "eval/tile_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace sweepface {
namespace HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR
namespace {

// A browser downloads every inlined copy, so there each step exists only once.
#if HWY_TARGET == HWY_WASM
#define SWEEPFACE_STEP HWY_NOINLINE
#else
#define SWEEPFACE_STEP HWY_INLINE
#endif

namespace hn = hwy::HWY_NAMESPACE;
using Ints = hn::CappedTag<std::int32_t, kGroup>;
using Shorts = hn::Repartition<std::int16_t, Ints>;
using Halves = hn::Rebind<std::int16_t, Ints>;
using Bytes = hn::Rebind<std::int8_t, Shorts>;
using Small = hn::Rebind<std::uint8_t, Ints>;
using Floats = hn::Rebind<float, Ints>;
using Int = hn::Vec<Ints>;
using Short = hn::Vec<Shorts>;
using Float = hn::Vec<Floats>;
constexpr Ints kInts;
constexpr Shorts kShorts;
constexpr Halves kHalves;
constexpr Bytes kBytes;
constexpr Small kSmall;
constexpr Floats kFloats;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(kInts));
constexpr int kParts = kGroup / kLanes;  // registers in a group

/// A sum of products of 16-bit integers, pair by pair. Where the instruction does not add up
/// neighbouring products, `high` holds the rest until the end.
struct Sum {
  Int low, high;

  HWY_INLINE Sum() : low(hn::Zero(kInts)), high(hn::Zero(kInts)) {}
  HWY_INLINE void add(Short a, Short b) {
#if HWY_TARGET == HWY_AVX3_DL
    // Highway 1.0 compiles for avxvnni here, without the intrinsic for 512 bits.
    asm("vpdpwssd %2, %1, %0" : "+v"(low.raw) : "v"(a.raw), "v"(b.raw));
#else
    low = hn::ReorderWidenMulAccumulate(kInts, a, b, low, high);
#endif
  }
  /// The pair is the same in all lanes.
  HWY_INLINE void addPair(Short a, const void* pair);
  HWY_INLINE Int total() const { return hn::RearrangeToOddPlusEven(low, high); }
};

HWY_INLINE Short broadcast(const void* pair) {
  std::int32_t bits;
  std::memcpy(&bits, pair, sizeof(bits));
  return hn::BitCast(kShorts, hn::Set(kInts, bits));
}

HWY_INLINE void Sum::addPair(Short a, const void* pair) {
#if HWY_TARGET == HWY_AVX3_DL
  asm("vpdpwssd %2%{1to16%}, %1, %0"
      : "+v"(low.raw)
      : "v"(a.raw), "m"(*static_cast<const std::int32_t*>(pair)));
#else
  add(a, broadcast(pair));
#endif
}

/// The weights of a tile's targets, in pairs.
class TileWeights {
 public:
  HWY_INLINE explicit TileWeights(const FrameWeights& frame) : frame_(frame) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
    few_ = frame.count <= 64;
    if (few_) {
      low_ = _mm512_loadu_si512(frame.shorts);
      high_ = _mm512_loadu_si512(frame.shorts + 32);
    }
#endif
  }

  HWY_INLINE void choose(const Tile& tile, std::uint32_t* pairs) const {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
    if (few_) {  // all of them lie in two registers
      for (int p = 0; p < tile.head->pairs; p += kGroup)
        _mm512_storeu_si512(pairs + p, _mm512_permutex2var_epi16(
                                           low_, _mm512_loadu_si512(tile.targets + 2 * p), high_));
      return;
    }
    if (tile.head->windows != 0) return chooseByWindows(tile, pairs);
#endif
    pairWeights(tile, frame_, pairs);
  }

 private:
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  /// A run of 64 weights, in two registers.
  struct Window {
    __m512i number, low, high;

    HWY_INLINE Window(const std::int16_t* shorts, std::uint64_t windows) {
      const auto w = _tzcnt_u64(windows) & 63;  // 0 if there are no windows, which does no harm
      number = _mm512_set1_epi16(static_cast<short>(w));
      low = _mm512_loadu_si512(shorts + 64 * w);
      high = _mm512_loadu_si512(shorts + 64 * w + 32);
    }
    /// The weights of those targets that are in this window; for others, what was `chosen` before.
    HWY_INLINE __m512i choose(__m512i targets, __m512i chosen) const {
      const __mmask32 here = _mm512_cmpeq_epi16_mask(_mm512_srli_epi16(targets, 6), number);
      return _mm512_mask_mov_epi16(chosen, here, _mm512_permutex2var_epi16(low, targets, high));
    }
  };

  /// Among many weights, a tile's lie in a few windows. Always takes four of these, and any further
  /// ones singly, as the number of windows cannot be predicted.
  HWY_INLINE void chooseByWindows(const Tile& tile, std::uint32_t* pairs) const {
    const std::uint64_t first = tile.head->windows, second = first & (first - 1),
                        third = second & (second - 1), fourth = third & (third - 1);
    const Window a(frame_.shorts, first), b(frame_.shorts, second), c(frame_.shorts, third),
        d(frame_.shorts, fourth);
    for (int p = 0; p < tile.head->pairs; p += kGroup) {
      const __m512i targets = _mm512_loadu_si512(tile.targets + 2 * p);
      __m512i chosen = _mm512_permutex2var_epi16(a.low, targets, a.high);
      chosen = d.choose(targets, c.choose(targets, b.choose(targets, chosen)));
      for (std::uint64_t left = fourth & (fourth - 1); left != 0; left &= left - 1)
        chosen = Window(frame_.shorts, left).choose(targets, chosen);
      _mm512_storeu_si512(pairs + p, chosen);
    }
  }
#endif

  const FrameWeights& frame_;
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  bool few_;
  __m512i low_, high_;
#endif
};

/// Loads numbers of 16 bits, or of 8.
HWY_INLINE Short load(const std::int16_t* from) { return hn::LoadU(kShorts, from); }
HWY_INLINE Short load(const std::int8_t* from) {
  return hn::PromoteTo(kShorts, hn::LoadU(kBytes, from));
}

/// Adds the coefficients of some pairs of targets times their weights.
template <typename Number>
HWY_INLINE const Number* addPairs(const Number* from, int count, const std::uint32_t* pairs,
                                  Sum* sums) {
  for (int p = 0; p < count; ++p) {
    for (int s = 0; s < kParts; ++s, from += 2 * kLanes) sums[s].addPair(load(from), pairs + p);
  }
  return from;
}

SWEEPFACE_STEP void blend(const Tile& tile, const std::uint32_t* pairs, std::int16_t* c) {
  const TileHead& head = *tile.head;
  const std::byte* from = tile.coefficients;
  for (int b = 0; b < head.blocks; ++b, c += kGroup) {
    Sum wide[kParts], narrow[kParts];
    const auto* const rest =
        addPairs(reinterpret_cast<const std::int16_t*>(from), tile.pairs[b].wide, pairs, wide);
    from = reinterpret_cast<const std::byte*>(addPairs(reinterpret_cast<const std::int8_t*>(rest),
                                                       tile.pairs[b].narrow, pairs + head.widePairs,
                                                       narrow));
    for (int s = 0; s < kParts; ++s) {
      const Int shifts =
          hn::PromoteTo(kInts, hn::LoadU(kSmall, tile.shifts + kGroup * b + kLanes * s));
      const Int sum = hn::Add(wide[s].total(), hn::Shl(narrow[s].total(), shifts));
      const Int rounded = hn::Add(sum, hn::Set(kInts, 1 << 15));
      hn::Store(hn::DemoteTo(kHalves, hn::ShiftRight<16>(rounded)), kHalves, c + kLanes * s);
    }
  }
}

/// As many vectors as fit in three registers, one for each coordinate.
struct Vectors {
  Float x, y, z;
};

struct Combined {
  Vectors first, second;
};

/// The place of a register of rows: its group, and which part of that. Two registers, a and b, are
/// combined at once.
struct Place {
  int group, part;
};

HWY_INLINE Vectors finish(const Tile& tile, Place at, Float scale, const Sum& x, const Sum& y,
                          const Sum& z) {
  const std::int16_t* neutral = tile.neutral + 3 * kGroup * at.group + kLanes * at.part;
  const Float step = hn::Set(kFloats, tile.head->step);
  const auto one = [&](const Sum& sum, int axis) HWY_ATTR {
    const Int steps = hn::PromoteTo(kInts, hn::LoadU(kHalves, neutral + kGroup * axis));
    const Float whole = hn::Add(hn::Set(kFloats, tile.head->origin[axis]),
                                hn::Mul(hn::ConvertTo(kFloats, steps), step));
    return hn::Add(whole, hn::Mul(hn::ConvertTo(kFloats, sum.total()), scale));
  };
  return {one(x, 0), one(y, 1), one(z, 2)};
}

/// The sums of two registers of rows.
struct Sums {
  Sum xA, yA, zA, xB, yB, zB;
  HWY_INLINE Sums() {}
};

HWY_INLINE Short loadRows(const std::int16_t* from) { return load(from); }
HWY_INLINE Short loadRows(const std::int8_t* from) {
  return hn::ShiftLeft<kBasisShift>(load(from));
}

/// Adds pairs of modes, whose coefficients start at c and whose rows start at a and b. Sums are
/// passed and returned by value, so that they stay in registers.
template <typename Number>
HWY_INLINE Sums addModes(Sums sums, const std::int16_t* c, const Number* a, const Number* b,
                         int pairs) {
  for (int p = 0; p < pairs; ++p, c += 6, a += 2 * kGroup, b += 2 * kGroup) {
    const Short rowsA = loadRows(a), rowsB = loadRows(b);
    const Short x = broadcast(c), y = broadcast(c + 2), z = broadcast(c + 4);
    sums.xA.add(rowsA, x), sums.yA.add(rowsA, y), sums.zA.add(rowsA, z);
    sums.xB.add(rowsB, x), sums.yB.add(rowsB, y), sums.zB.add(rowsB, z);
  }
  return sums;
}

HWY_INLINE Combined combine(const Tile& tile, const std::int16_t* c, Place a, Place b,
                            Float scale) {
  const int wide = tile.head->wideModePairs;
  const std::size_t ofGroup = basisBytes(*tile.head);
  const auto wideOf = [&](Place at) {
    return reinterpret_cast<const std::int16_t*>(tile.basis + ofGroup * at.group) +
           2 * kLanes * at.part;
  };
  const auto narrowOf = [&](Place at) {
    return reinterpret_cast<const std::int8_t*>(tile.basis + ofGroup * at.group) +
           4 * kGroup * wide + 2 * kLanes * at.part;
  };
  Sums sums = addModes(Sums(), c, wideOf(a), wideOf(b), wide);
  sums = addModes(sums, c + 6 * wide, narrowOf(a), narrowOf(b), tile.head->modePairs - wide);
  return {finish(tile, a, scale, sums.xA, sums.yA, sums.zA),
          finish(tile, b, scale, sums.xB, sums.yB, sums.zB)};
}

HWY_INLINE Vectors cross(const Vectors& a, const Vectors& b) {
  const auto minor = [](Float p, Float q, Float r, Float s)
                         HWY_ATTR { return hn::Sub(hn::Mul(p, q), hn::Mul(r, s)); };
  return {minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x)};
}

HWY_INLINE Float inverseRoot(Float x) {
  const Int bits = hn::BitCast(kInts, x);
  Float y =
      hn::BitCast(kFloats, hn::Sub(hn::Set(kInts, kInverseRootGuess), hn::ShiftRight<1>(bits)));
  const Float half = hn::Mul(hn::Set(kFloats, 0.5f), x);
  for (int step = 0; step < kInverseRootSteps; ++step)
    y = hn::Mul(y, hn::Sub(hn::Set(kFloats, 1.5f), hn::Mul(hn::Mul(half, y), y)));
  return y;
}

HWY_INLINE Vectors unit(const Vectors& a) {
  const Float squared = hn::Add(hn::Add(hn::Mul(a.x, a.x), hn::Mul(a.y, a.y)), hn::Mul(a.z, a.z));
  const Float r = inverseRoot(squared);
  return {hn::Mul(a.x, r), hn::Mul(a.y, r), hn::Mul(a.z, r)};
}

/// Holds the vectors of a tile until they are written, four floats each. Every four lanes of three
/// registers become four vectors, so that within the share of one register, vector 4j + i is at
/// place kRows · i + j.
struct Waiting {
  static constexpr int kRows = kLanes / 4;
  HWY_ALIGN float xyz[4 * kTileVertices];

  HWY_INLINE void put(int k, const Vectors& a) {
    const hn::Repartition<double, Floats> doubles;
    const auto join = [&](int i, Float xy, Float zz) HWY_ATTR {
      const auto p = hn::BitCast(doubles, xy), q = hn::BitCast(doubles, zz);
      float* const to = xyz + 4 * (k + kRows * i);
      hn::Store(hn::BitCast(kFloats, hn::InterleaveLower(doubles, p, q)), kFloats, to);
      hn::Store(hn::BitCast(kFloats, hn::InterleaveUpper(doubles, p, q)), kFloats, to + kLanes);
    };
    join(0, hn::InterleaveLower(kFloats, a.x, a.y), hn::InterleaveLower(kFloats, a.z, a.z));
    join(2, hn::InterleaveUpper(kFloats, a.x, a.y), hn::InterleaveUpper(kFloats, a.z, a.z));
  }

  HWY_INLINE const float* at(int k) const {
    return xyz + 4 * (k / kLanes * kLanes + k % 4 * kRows + k % kLanes / 4);
  }
};

HWY_INLINE void write3(const float* from, char* to) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  _mm_mask_storeu_ps(to, 7, _mm_load_ps(from));
#else
  std::memcpy(to, from, 8);
  std::memcpy(to + 8, from + 2, 4);
#endif
}

/// Where the vertices of a tile go.
struct Places {
  HWY_ALIGN std::uint32_t of[kTileVertices];

  SWEEPFACE_STEP void take(const Tile& tile) {
    const hn::Repartition<std::uint32_t, Ints> words;
    const hn::Rebind<std::uint16_t, Ints> shorts;
    const auto* const wide = reinterpret_cast<const std::uint32_t*>(tile.vertices);
    const auto* const narrow = reinterpret_cast<const std::uint16_t*>(tile.vertices);
    for (int k = 0; k < kTileVertices; k += kLanes)
      hn::Store(tile.head->wideVertices
                    ? hn::LoadU(words, wide + k)
                    : hn::BitCast(words, hn::PromoteTo(kInts, hn::LoadU(shorts, narrow + k))),
                words, of + k);
  }
};

SWEEPFACE_STEP void write(const Tile& tile, const Places& places, bool all, const Waiting& from,
                          const VectorsOut& out) {
  if (all && out.stride == 12 && tile.head->vertices == kTileVertices) {
    char* const to = reinterpret_cast<char*>(out.data);
    const std::uint32_t* vertex = places.of;
    const float* xyz = from.xyz;
    for (int first = 0; first < kTileVertices; first += kLanes, xyz += 4 * kLanes)
      for (int j = 0; j < Waiting::kRows; ++j, vertex += 4)
        for (int i = 0; i < 4; ++i)
          write3(xyz + 4 * (Waiting::kRows * i + j), to + std::size_t(12) * vertex[i]);
    return;
  }
  for (int k = 0; k < tile.head->vertices; ++k)
    if (places.of[k] < static_cast<std::uint32_t>(out.count))
      write3(from.at(k), vectorAt(out, places.of[k]));
}

#undef SWEEPFACE_STEP
}  // namespace

#endif
}  // namespace HWY_NAMESPACE
}  // namespace sweepface
HWY_AFTER_NAMESPACE();

#endif
