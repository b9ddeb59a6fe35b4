// Kernels that blend morph targets, compiled by Highway for every instruction set, like the
// library's own.
#include "peer_kernels.hpp"

#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "peer_kernels.cpp"
#define HWY_WANT_AVX3_DL
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sweepface::bench {
namespace HWY_NAMESPACE {
#if HWY_TARGET != HWY_SCALAR
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats32 = hn::CappedTag<float, 16>;
using Ints = hn::Rebind<std::int32_t, Floats32>;
using Shorts = hn::Rebind<std::int16_t, Floats32>;
using Pairs = hn::Repartition<std::int16_t, Ints>;
using Float = hn::Vec<Floats32>;
using Int = hn::Vec<Ints>;
constexpr Floats32 kFloats;
constexpr Ints kInts;
constexpr Shorts kShorts;
constexpr Pairs kPairs;
constexpr std::size_t kLanes = hn::MaxLanes(kFloats);
constexpr std::size_t kParts = kChunk / kLanes;
constexpr std::size_t kBlock = 16;

HWY_INLINE Float floatsOf(const std::int16_t* from) {
  return hn::ConvertTo(kFloats, hn::PromoteTo(kInts, hn::LoadU(kShorts, from)));
}

struct Active {
  std::size_t count = 0;
  std::uint16_t targets[kMostTargets];
  float weights[kMostTargets];

  HWY_INLINE Active(const PeerData& data, const double* w, bool steps) {
    for (std::size_t k = 0; k < data.targets; ++k)
      if (w[k] != 0) {
        targets[count] = static_cast<std::uint16_t>(k);
        weights[count++] = static_cast<float>(w[k]) * (steps ? data.steps[k] : 1.0f);
      }
  }
};

template <typename T>
HWY_INLINE void addChunk(float weight, const T* from, Float* sums) {
  const Float w = hn::Set(kFloats, weight);
  for (std::size_t s = 0; s < kParts; ++s) {
    Float x;
    if constexpr (sizeof(T) == 4)
      x = hn::Load(kFloats, from + kLanes * s);
    else
      x = floatsOf(from + kLanes * s);
    sums[s] = hn::MulAdd(w, x, sums[s]);
  }
}

HWY_INLINE void loadChunk(const float* from, Float* sums) {
  for (std::size_t s = 0; s < kParts; ++s) sums[s] = hn::Load(kFloats, from + kLanes * s);
}
HWY_INLINE void storeChunk(const Float* sums, float* to) {
  for (std::size_t s = 0; s < kParts; ++s) hn::StoreU(sums[s], kFloats, to + kLanes * s);
}

template <typename T>
HWY_INLINE void runDense(const PeerData& data, const T* values, const Active& active, float* out) {
  Float sums[kParts];
  for (std::size_t q = 0; q < data.chunks; ++q, values += data.targets * kChunk) {
    loadChunk(data.neutral.data() + kChunk * q, sums);
    for (std::size_t a = 0; a < active.count; ++a)
      addChunk(active.weights[a], values + kChunk * active.targets[a], sums);
    storeChunk(sums, out + kChunk * q);
  }
}

}  // namespace

void dense32(const PeerData& data, const double* weights, float* out) {
  runDense(data, data.floats.data(), Active(data, weights, false), out);
}

void dense16(const PeerData& data, const double* weights, float* out) {
  runDense(data, data.shorts.data(), Active(data, weights, true), out);
}

void sparse32(const PeerData& data, const double* weights, float* out) {
  std::memcpy(out, data.neutral.data(), data.neutral.bytes());
  for (std::size_t k = 0; k < data.targets; ++k) {
    const float w = static_cast<float>(weights[k]);
    if (w == 0) continue;
    const float* x = data.vectors.data() + 3 * std::size_t(data.starts[k]);
    for (std::size_t e = data.starts[k]; e < data.starts[k + 1]; ++e, x += 3) {
      float* const p = out + data.vertices[e];
      p[0] += w * x[0], p[1] += w * x[1], p[2] += w * x[2];
    }
  }
}

void block16(const PeerData& data, const double* weights, float* out) {
  std::memcpy(out, data.neutral.data(), data.neutral.bytes());
  for (std::size_t k = 0; k < data.targets; ++k) {
    if (weights[k] == 0) continue;
    const Float w = hn::Set(kFloats, static_cast<float>(weights[k]) * data.steps[k]);
    const std::int16_t* x = data.shorts.data() + kBlock * data.starts[k];
    for (std::size_t e = data.starts[k]; e < data.starts[k + 1]; ++e)
      for (std::size_t i = 0; i < kBlock; i += kLanes, x += kLanes) {
        float* const p = out + kBlock * data.places[e] + i;
        hn::StoreU(hn::MulAdd(w, floatsOf(x), hn::LoadU(kFloats, p)), kFloats, p);
      }
  }
}

void chunk16(const PeerData& data, const double* weights, float* out) {
  float scaled[kMostTargets];
  for (std::size_t k = 0; k < data.targets; ++k)
    scaled[k] = static_cast<float>(weights[k]) * data.steps[k];
  Float sums[kParts];
  for (std::size_t q = 0; q < data.chunks; ++q) {
    loadChunk(data.neutral.data() + kChunk * q, sums);
    for (std::size_t e = data.starts[q]; e < data.starts[q + 1]; ++e) {
      const float w = scaled[data.places[e]];
      if (w != 0) addChunk(w, data.shorts.data() + kChunk * e, sums);
    }
    storeChunk(sums, out + kChunk * q);
  }
}

namespace {

HWY_INLINE void addProducts(Int& low, Int& high, hn::Vec<Pairs> a, hn::Vec<Pairs> b) {
#if HWY_TARGET == HWY_AVX3_DL
  (void)high;
  asm("vpdpwssd %2, %1, %0" : "+v"(low.raw) : "v"(a.raw), "v"(b.raw));
#else
  low = hn::ReorderWidenMulAccumulate(kInts, a, b, low, high);
#endif
}

/// The weights of a chunk's targets, in pairs.
struct PairWeights {
  static constexpr float kUnit = 1 << 14;
  std::int16_t all[kMostTargets + 64] = {};
  HWY_ALIGN std::int16_t chosen[kMostTargets + 64];
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  __m512i low, high;
#endif

  HWY_INLINE PairWeights(const PeerData& data, const double* weights) {
    for (std::size_t k = 0; k < data.targets; ++k)
      all[k] = static_cast<std::int16_t>(std::floor(weights[k] * kUnit + 0.5));
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
    low = _mm512_loadu_si512(all), high = _mm512_loadu_si512(all + 32);
#endif
  }

  HWY_INLINE void choose(std::size_t targets, const std::uint16_t* places, std::size_t count) {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
    if (targets < 64) {
      for (std::size_t i = 0; i < count; i += 32)
        _mm512_store_si512(chosen + i,
                           _mm512_permutex2var_epi16(low, _mm512_loadu_si512(places + i), high));
      return;
    }
#endif
    (void)targets;
    for (std::size_t i = 0; i < count; ++i) chosen[i] = all[places[i]];
  }
};

}  // namespace

void paired16(const PeerData& data, const double* weights, float* out) {
  PairWeights w(data, weights);
  const Float scale = hn::Set(kFloats, data.step / PairWeights::kUnit);
  for (std::size_t q = 0; q < data.chunks; ++q) {
    const std::size_t first = data.starts[q], count = data.starts[q + 1] - first;
    w.choose(data.targets, data.places.data() + 2 * first, 2 * count);
    const std::int16_t* x = data.shorts.data() + 2 * kChunk * first;
    Int low[kParts], high[kParts];
    for (std::size_t s = 0; s < kParts; ++s) low[s] = high[s] = hn::Zero(kInts);
    for (std::size_t p = 0; p < count; ++p) {
      std::int32_t pair;
      std::memcpy(&pair, w.chosen + 2 * p, sizeof(pair));
      const auto both = hn::BitCast(kPairs, hn::Set(kInts, pair));
      for (std::size_t s = 0; s < kParts; ++s, x += 2 * kLanes)
        addProducts(low[s], high[s], hn::Load(kPairs, x), both);
    }
    for (std::size_t s = 0; s < kParts; ++s) {
      const std::size_t at = kChunk * q + kLanes * s;
      const Int sum = hn::RearrangeToOddPlusEven(low[s], high[s]);
      hn::StoreU(hn::MulAdd(hn::ConvertTo(kFloats, sum), scale,
                            hn::Load(kFloats, data.neutral.data() + at)),
                 kFloats, out + at);
    }
  }
}

void normaliseAll(float* vectors, std::size_t count) {
  std::size_t v = 0;
  for (; v + kLanes <= count; v += kLanes, vectors += 3 * kLanes) {
    Float x, y, z;
    hn::LoadInterleaved3(kFloats, vectors, x, y, z);
    const Float squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    const Float l = hn::Max(squared, hn::Set(kFloats, 1e-30f));
    Float r = hn::ApproximateReciprocalSqrt(l);
    const Float half = hn::Mul(hn::Set(kFloats, 0.5f), l);
    r = hn::Mul(r, hn::NegMulAdd(hn::Mul(half, r), r, hn::Set(kFloats, 1.5f)));
    hn::StoreInterleaved3(hn::Mul(x, r), hn::Mul(y, r), hn::Mul(z, r), kFloats, vectors);
  }
  for (; v < count; ++v, vectors += 3) {
    const float r = 1 / std::sqrt(vectors[0] * vectors[0] + vectors[1] * vectors[1] +
                                  vectors[2] * vectors[2] + 1e-30f);
    vectors[0] *= r, vectors[1] *= r, vectors[2] *= r;
  }
}

#else  // nobody measures a processor without vectors

void dense32(const PeerData&, const double*, float*) {}
void dense16(const PeerData&, const double*, float*) {}
void sparse32(const PeerData&, const double*, float*) {}
void block16(const PeerData&, const double*, float*) {}
void chunk16(const PeerData&, const double*, float*) {}
void paired16(const PeerData&, const double*, float*) {}
void normaliseAll(float*, std::size_t) {}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace sweepface::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sweepface::bench {

HWY_EXPORT(dense32);
HWY_EXPORT(dense16);
HWY_EXPORT(sparse32);
HWY_EXPORT(block16);
HWY_EXPORT(chunk16);
HWY_EXPORT(paired16);
HWY_EXPORT(normaliseAll);

void runDense32(const PeerData& data, const double* weights, float* out) {
  HWY_DYNAMIC_DISPATCH(dense32)(data, weights, out);
}
void runDense16(const PeerData& data, const double* weights, float* out) {
  HWY_DYNAMIC_DISPATCH(dense16)(data, weights, out);
}
void runSparse32(const PeerData& data, const double* weights, float* out) {
  HWY_DYNAMIC_DISPATCH(sparse32)(data, weights, out);
}
void runBlock16(const PeerData& data, const double* weights, float* out) {
  HWY_DYNAMIC_DISPATCH(block16)(data, weights, out);
}
void runChunk16(const PeerData& data, const double* weights, float* out) {
  HWY_DYNAMIC_DISPATCH(chunk16)(data, weights, out);
}
void runPaired16(const PeerData& data, const double* weights, float* out) {
  HWY_DYNAMIC_DISPATCH(paired16)(data, weights, out);
}
void normalise(float* vectors, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(normaliseAll)(vectors, count);
}

}  // namespace sweepface::bench
#endif
