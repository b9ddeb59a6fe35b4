// Measures what a player of faces spends its time on. Usage: sweepface_bench [Google Benchmark's
// flags]
//
// SWEEPFACE_BENCH_FACE and others say what is measured (scripts/bench); SWEEPFACE_BENCH_SIMD=avx2
// does without wider vectors.
#include <benchmark/benchmark.h>
#include <cstdlib>
#include <fmt/format.h>
#include <hwy/targets.h>
#include <string_view>

#include "bench_face.hpp"
#include "give_up.hpp"
#include "play_bench.hpp"

namespace {

void chooseVectors() {
  const char* wanted = std::getenv("SWEEPFACE_BENCH_SIMD");
  if (wanted == nullptr || *wanted == '\0') return;
  if (std::string_view(wanted) != "avx2")
    sweepface::bench::giveUp(fmt::format("SWEEPFACE_BENCH_SIMD may be avx2, not '{}'.", wanted));
  hwy::DisableTargets(HWY_AVX3 | HWY_AVX3_DL);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  chooseVectors();
  const sweepface::Rig& rig = sweepface::bench::face();
  benchmark::AddCustomContext("face", sweepface::bench::faceName());
  benchmark::AddCustomContext("vertices", fmt::format("{}", rig.source.gridVertex.size()));
  benchmark::AddCustomContext("patches", fmt::format("{}", rig.surface.patchCount()));
  benchmark::AddCustomContext("stored vectors", fmt::format("{}", rig.surface.storedCount()));
  benchmark::AddCustomContext("all vectors", fmt::format("{}", rig.surface.vectorCount()));
  benchmark::AddCustomContext("targets", fmt::format("{}", rig.targets.size()));
  benchmark::AddCustomContext("vectors of",
                              hwy::TargetName(hwy::SupportedTargets() & -hwy::SupportedTargets()));
  sweepface::bench::registerPlayers();
  sweepface::bench::Ratios ratios;
  benchmark::RunSpecifiedBenchmarks(&ratios);
  benchmark::Shutdown();
  if (const std::string line = ratios.line("-equal"); !line.empty())
    fmt::print("to kernels that drop as much: {}\n", line);
  fmt::print("{}\n", ratios.line());
}
