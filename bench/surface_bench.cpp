// From weights to vertices: what every frame costs, and what is done once before the first.
#include <benchmark/benchmark.h>

#include "bench_face.hpp"

namespace sweepface::bench {
namespace {

void countVertices(benchmark::State& state, Index perRound) {
  state.SetItemsProcessed(state.iterations() * perRound);
}

void makeSurface(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Surface::make(face().surface.wireframe()));
  state.SetItemsProcessed(state.iterations() * face().surface.patchCount());
}
BENCHMARK(makeSurface)->Unit(benchmark::kMillisecond);

void settle(benchmark::State& state) {
  const Surface& surface = face().surface;
  std::vector<Vec3> vectors(surface.vectorCount());
  for (auto _ : state) {
    surface.settle(face().neutral, vectors);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(settle)->Unit(benchmark::kMicrosecond);

void blendVectors(benchmark::State& state, Active active) {
  const Weights weights = someWeights(active);
  std::vector<Vec3> vectors(face().surface.vectorCount());
  for (auto _ : state) {
    blend(face(), weights, vectors);
    benchmark::ClobberMemory();
  }
}
BENCHMARK_CAPTURE(blendVectors, ten, Active::ten)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(blendVectors, all, Active::all)->Unit(benchmark::kMicrosecond);

void makeTessellation(benchmark::State& state) {
  const auto level = static_cast<Index>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(Tessellation(face().surface, level));
  countVertices(state, Tessellation(face().surface, level).vertexCount());
}
BENCHMARK(makeTessellation)->ArgName("level")->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

void positions(benchmark::State& state) {
  const Tessellation mesh(face().surface, static_cast<Index>(state.range(0)));
  const std::vector<Vec3> vectors = blend(face(), someWeights(Active::all));
  std::vector<Vec3> out(mesh.vertexCount());
  for (auto _ : state) {
    mesh.positions(vectors, out);
    benchmark::ClobberMemory();
  }
  countVertices(state, mesh.vertexCount());
}
BENCHMARK(positions)->ArgName("level")->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

void normals(benchmark::State& state) {
  const Tessellation mesh(face().surface, static_cast<Index>(state.range(0)));
  const std::vector<Vec3> vectors = blend(face(), someWeights(Active::all));
  for (auto _ : state) benchmark::DoNotOptimize(mesh.normals(vectors));
  countVertices(state, mesh.vertexCount());
}
BENCHMARK(normals)->ArgName("level")->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

/// A whole frame: blend, then the positions of level 1, as many as the source has.
void frame(benchmark::State& state, Active active) {
  const Tessellation mesh(face().surface, 1);
  const Weights weights = someWeights(active);
  std::vector<Vec3> vectors(face().surface.vectorCount()), out(mesh.vertexCount());
  for (auto _ : state) {
    blend(face(), weights, vectors);
    mesh.positions(vectors, out);
    benchmark::ClobberMemory();
  }
  countVertices(state, mesh.vertexCount());
}
BENCHMARK_CAPTURE(frame, ten, Active::ten)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(frame, all, Active::all)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace sweepface::bench
