// What happens to one tile, for vectors of 4, 8 or 16 numbers. Included once for every instruction
// set by tile_kernels.cpp.
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

namespace hn = hwy::HWY_NAMESPACE;
using Ints = hn::CappedTag<std::int32_t, kGroup>;
using Shorts = hn::Repartition<std::int16_t, Ints>;
using Halves = hn::Rebind<std::int16_t, Ints>;
using Floats = hn::Rebind<float, Ints>;
using Int = hn::Vec<Ints>;
using Short = hn::Vec<Shorts>;
using Float = hn::Vec<Floats>;
constexpr Ints kInts;
constexpr Shorts kShorts;
constexpr Halves kHalves;
constexpr Floats kFloats;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(kInts));
constexpr int kParts = kGroup / kLanes;  // vectors in a group

/// A sum of products of 16-bit integers, two by two. Where an instruction adds up other products
/// than neighbouring ones, the rest is kept beside until the end.
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
  HWY_INLINE Int total() const { return hn::RearrangeToOddPlusEven(low, high); }
};

HWY_INLINE Short broadcast(const void* pair) {
  std::int32_t bits;
  std::memcpy(&bits, pair, sizeof(bits));
  return hn::BitCast(kShorts, hn::Set(kInts, bits));
}

/// The weights of a tile's targets, two by two.
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
  /// Among many weights those of a tile lie in a few runs of 64, two registers each.
  HWY_INLINE void chooseByWindows(const Tile& tile, std::uint32_t* pairs) const {
    for (int p = 0; p < tile.head->pairs; p += kGroup) {
      const __m512i targets = _mm512_loadu_si512(tile.targets + 2 * p);
      const __m512i window = _mm512_srli_epi16(targets, 6);
      __m512i chosen = _mm512_setzero_si512();
      for (std::uint64_t left = tile.head->windows; left != 0; left &= left - 1) {
        const int w = __builtin_ctzll(left);
        const std::int16_t* const shorts = frame_.shorts + 64 * w;
        const __m512i found = _mm512_permutex2var_epi16(_mm512_loadu_si512(shorts), targets,
                                                        _mm512_loadu_si512(shorts + 32));
        const __mmask32 here =
            _mm512_cmpeq_epi16_mask(window, _mm512_set1_epi16(static_cast<short>(w)));
        chosen = _mm512_mask_mov_epi16(chosen, here, found);
      }
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

HWY_INLINE void blend(const Tile& tile, const std::uint32_t* pairs, std::int16_t* c) {
  const std::int16_t* from = tile.coefficients;
  for (int b = 0; b < tile.head->blocks; ++b, c += kGroup) {
    Sum sums[kParts], others[kParts];  // two chains of sums, or each would wait for the one before
    const auto add = [&](Sum* to, int p) HWY_ATTR {
      const Short weights = broadcast(pairs + p);
      for (int s = 0; s < kParts; ++s, from += 2 * kLanes)
        to[s].add(hn::Load(kShorts, from), weights);
    };
    const int count = tile.head->blockPairs[b];
    for (int p = 0; p + 1 < count; p += 2) add(sums, p), add(others, p + 1);
    if (count % 2 == 1) add(sums, count - 1);
    for (int s = 0; s < kParts; ++s) {
      const Int sum = hn::Add(sums[s].total(), others[s].total());
      const Int rounded = hn::Add(sum, hn::Set(kInts, 1 << 15));
      hn::Store(hn::DemoteTo(kHalves, hn::ShiftRight<16>(rounded)), kHalves, c + kLanes * s);
    }
  }
}

/// As many vectors as fit, a register for each coordinate.
struct Vectors {
  Float x, y, z;
};

struct Combined {
  Vectors first, second;
};

/// Two registers of rows at once: lanes from `part` on of groups a and b.
struct Place {
  int group, part;
};

HWY_INLINE Vectors finish(const Tile& tile, Place at, Float scale, const Sum& x, const Sum& y,
                          const Sum& z) {
  const float* neutral = tile.neutral + 3 * kGroup * at.group + kLanes * at.part;
  const auto one = [&](const Sum& sum, int axis) HWY_ATTR {
    return hn::Add(hn::Load(kFloats, neutral + kGroup * axis),
                   hn::Mul(hn::ConvertTo(kFloats, sum.total()), scale));
  };
  return {one(x, 0), one(y, 1), one(z, 2)};
}

HWY_INLINE Combined combine(const Tile& tile, const std::int16_t* c, Place a, Place b,
                            Float scale) {
  const int modePairs = tile.head->modePairs;
  const auto basisOf = [&](Place at) {
    return tile.basis + 2 * (kGroup * modePairs * at.group + kLanes * at.part);
  };
  const std::int16_t *basisA = basisOf(a), *basisB = basisOf(b);
  Sum xA, yA, zA, xB, yB, zB;
  for (int p = 0; p < modePairs; ++p, c += 6, basisA += 2 * kGroup, basisB += 2 * kGroup) {
    const Short rowsA = hn::Load(kShorts, basisA), rowsB = hn::Load(kShorts, basisB);
    const Short x = broadcast(c), y = broadcast(c + 2), z = broadcast(c + 4);
    xA.add(rowsA, x), yA.add(rowsA, y), zA.add(rowsA, z);
    xB.add(rowsB, x), yB.add(rowsB, y), zB.add(rowsB, z);
  }
  return {finish(tile, a, scale, xA, yA, zA), finish(tile, b, scale, xB, yB, zB)};
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

/// Where the vectors of a tile wait to be written, four floats each. Every four lanes of three
/// registers become four vectors, so that in a register's share of the memory vector 4j + i stands
/// at place kRows · i + j.
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

HWY_INLINE void write(const Tile& tile, bool all, const Waiting& from, const VectorsOut& out) {
  if (all && out.stride == 12 && tile.head->vertices == kTileVertices) {
    char* const to = reinterpret_cast<char*>(out.data);
    const std::uint32_t* vertex = tile.vertices;
    const float* xyz = from.xyz;
    for (int first = 0; first < kTileVertices; first += kLanes, xyz += 4 * kLanes)
      for (int j = 0; j < Waiting::kRows; ++j, vertex += 4)
        for (int i = 0; i < 4; ++i)
          write3(xyz + 4 * (Waiting::kRows * i + j), to + std::size_t(12) * vertex[i]);
    return;
  }
  for (int k = 0; k < tile.head->vertices; ++k)
    if (tile.vertices[k] < static_cast<std::uint32_t>(out.count))
      write3(from.at(k), vectorAt(out, tile.vertices[k]));
}

}  // namespace

#endif
}  // namespace HWY_NAMESPACE
}  // namespace sweepface
HWY_AFTER_NAMESPACE();

#endif
