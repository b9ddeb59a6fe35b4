// Measures what a player of faces spends its time on. Usage: sweepface_bench [Google Benchmark's
// flags]
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bench_face.hpp"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const sweepface::Rig& rig = sweepface::bench::face();
  benchmark::AddCustomContext("face", sweepface::bench::faceName());
  benchmark::AddCustomContext("vertices", fmt::format("{}", rig.source.gridVertex.size()));
  benchmark::AddCustomContext("patches", fmt::format("{}", rig.surface.patchCount()));
  benchmark::AddCustomContext("stored vectors", fmt::format("{}", rig.surface.storedCount()));
  benchmark::AddCustomContext("all vectors", fmt::format("{}", rig.surface.vectorCount()));
  benchmark::AddCustomContext("targets", fmt::format("{}", rig.targets.size()));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
