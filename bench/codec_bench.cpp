// Reading and writing .sweep files, from and to memory.
#include <benchmark/benchmark.h>

#include "sweepface/codec.hpp"

#include "bench_face.hpp"

namespace sweepface::bench {
namespace {

void encodeFace(benchmark::State& state) {
  std::size_t size = 0;
  for (auto _ : state) {
    const std::string bytes = encode(face());
    benchmark::DoNotOptimize(bytes.data());
    size = bytes.size();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(size));
}
BENCHMARK(encodeFace)->Unit(benchmark::kMillisecond);

void decodeFace(benchmark::State& state) {
  const std::string bytes = encode(face());
  for (auto _ : state) {
    const Result<Rig> rig = decode(bytes, "bench");
    if (!rig) return state.SkipWithError(rig.error().message.c_str());
    benchmark::DoNotOptimize(rig->neutral.data());
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}
BENCHMARK(decodeFace)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sweepface::bench
