// Many faces of one rig, each with weights and vertices of its own, over the cores.
#include <benchmark/benchmark.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <thread>

#include "sweepface/evaluator.hpp"

#include "bench_face.hpp"

namespace sweepface::bench {
namespace {

void playCrowd(benchmark::State& state) {
  const auto faces = static_cast<std::size_t>(state.range(0));
  EvaluatorOptions options;
  options.normals = false;
  const auto evaluator = Evaluator::make(face(), options);
  if (!evaluator) return state.SkipWithError(evaluator.error().message.c_str());
  const Index count = evaluator->vertexCount();
  const std::size_t floats = 3 * static_cast<std::size_t>(count);
  std::vector<float> out(faces * floats);
  std::vector<Weights> weights(faces, someWeights(Active::all));
  for (std::size_t f = 0; f < faces; ++f)
    for (double& w : weights[f]) w *= 0.5 + 0.5 * static_cast<double>(f % 97) / 97;
  tbb::task_arena arena(static_cast<int>(state.range(1)));
  tbb::enumerable_thread_specific<std::vector<std::byte>> scratch(
      std::vector<std::byte>(evaluator->scratchBytes()));
  for (auto _ : state)
    arena.execute([&] {
      tbb::parallel_for(std::size_t(0), faces, [&](std::size_t f) {
        Evaluation job;
        job.evaluator = &*evaluator;
        job.weights = weights[f];
        job.scratch = scratch.local();
        job.positions = {out.data() + f * floats, count};
        job.run();
      });
    });
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(faces));
}

void upToAllCores(benchmark::internal::Benchmark* crowd) {
  crowd->ArgNames({"faces", "threads"});
  for (std::int64_t threads = 1; threads <= std::thread::hardware_concurrency(); threads *= 2)
    for (const std::int64_t faces : {100, 300, 1000}) crowd->Args({faces, threads});
}

BENCHMARK(playCrowd)
    ->Apply(upToAllCores)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sweepface::bench
