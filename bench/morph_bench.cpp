// For comparison, what the same face costs as plain morph targets: a dense array of
// single-precision differences for every target, added up in the source's vertex order.
#include <algorithm>
#include <benchmark/benchmark.h>

#include "bench_face.hpp"

namespace sweepface::bench {
namespace {

using Floats = std::vector<float>;  ///< [V × 3]

struct Morphs {
  Floats neutral;
  std::vector<Floats> differences;  ///< [targets]
};

const Morphs& morphs() {
  static const Morphs made = [] {
    const Tessellation level1(face().surface, 1);
    const auto pose = [&](const Weights& weights) {
      return sourcePositions(face(), level1, blend(face(), weights), weights);
    };
    const auto append = [](Floats& out, const Vec3& p) {
      for (double x : {p.x, p.y, p.z}) out.push_back(static_cast<float>(x));
    };
    Weights weights(face().targets.size(), 0.0);
    const std::vector<Vec3> neutral = pose(weights);
    Morphs result;
    for (const Vec3& p : neutral) append(result.neutral, p);
    for (double& weight : weights) {
      weight = 1;
      const std::vector<Vec3> target = pose(weights);
      weight = 0;
      Floats& difference = result.differences.emplace_back();
      for (std::size_t v = 0; v < target.size(); ++v) append(difference, target[v] - neutral[v]);
    }
    return result;
  }();
  return made;
}

/// out[begin, end) = neutral + Σ weight · difference.
void addUp(const Morphs& face, const Floats& weights, std::size_t begin, std::size_t end,
           Floats& out) {
  float* const to = out.data();
  std::copy(face.neutral.data() + begin, face.neutral.data() + end, to + begin);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (weights[k] == 0) continue;
    const float weight = weights[k];
    const float* const difference = face.differences[k].data();
    for (std::size_t i = begin; i < end; ++i) to[i] += weight * difference[i];
  }
}

/// The sum is taken chunk by chunk, so that it stays in the innermost cache; a chunk as long as the
/// face is the naive way, target by target.
void morphBlend(benchmark::State& state, Active active, std::size_t chunk) {
  const Morphs& face = morphs();
  const Weights wanted = someWeights(active);
  Floats weights;
  for (double weight : wanted) weights.push_back(static_cast<float>(weight));
  Floats out(face.neutral.size());
  for (auto _ : state) {
    for (std::size_t begin = 0; begin < out.size(); begin += std::min(chunk, out.size() - begin))
      addUp(face, weights, begin, begin + std::min(chunk, out.size() - begin), out);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(out.size() / 3));
  const auto targets =
      std::count_if(weights.begin(), weights.end(), [](float w) { return w != 0; });
  state.SetBytesProcessed(state.iterations() * (targets + 1) *
                          static_cast<std::int64_t>(out.size() * sizeof(float)));
}
constexpr std::size_t kChunk = 3 * 1024, kWhole = static_cast<std::size_t>(-1);
BENCHMARK_CAPTURE(morphBlend, naive_ten, Active::ten, kWhole)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(morphBlend, naive_all, Active::all, kWhole)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(morphBlend, chunked_ten, Active::ten, kChunk)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(morphBlend, chunked_all, Active::all, kChunk)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace sweepface::bench
