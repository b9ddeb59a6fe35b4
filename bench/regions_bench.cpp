// What regions cost: a frame of their motion and of their blend, beside the plain ones.
#include <array>
#include <benchmark/benchmark.h>
#include <cstdlib>
#include <fmt/format.h>
#include <vector>

#include "sweepface/evaluator.hpp"
#include "sweepface/regional_motion.hpp"

#include "bench_face.hpp"

namespace sweepface::bench {
namespace {

constexpr int kRegions = 8;

template <typename T>
T orEnd(Result<T> result) {
  if (result) return std::move(*result);
  fmt::print(stderr, "sweepface_bench: {}\n", result.error().message);
  std::exit(1);
}

/// Eight bands across the face, from its lowest node to the farthest.
std::vector<Region> bands() {
  const Rig& rig = face();
  Brush brush;
  const std::vector<Vec3> vectors = blend(rig, {});
  Vec3 low = rig.surface.pointOnArc(vectors, 0, 0), high = low;
  for (Index a = 0; a < static_cast<Index>(rig.surface.wireframe().arcs.size()); ++a) {
    const Vec3 p = rig.surface.pointOnArc(vectors, a, 0);
    if (p.y < low.y) low = p;
    if (p.y > high.y) high = p;
  }
  brush.points = {low};
  brush.fade = norm(high - low);
  brush.alongSurface = false;
  std::vector<Region> regions;
  for (auto& shares : orEnd(paintBands(rig, brush, kRegions)))
    regions.push_back({fmt::format("band{}", regions.size()),
                       {1.0 + static_cast<double>(regions.size()), 1, 0},
                       std::move(shares)});
  return orEnd(dividedFace(rig, std::move(regions)));
}

/// Springs under all weights of all regions, on their way.
void moveRegions(benchmark::State& state, std::size_t count) {
  std::vector<Matter> matters(count);
  for (std::size_t r = 0; r < count; ++r) matters[r].mass = 1 + 0.5 * static_cast<double>(r);
  auto motion = orEnd(RegionalMotion::make(Weights(face().targets.size(), 0.0), matters));
  const Weights goals = someWeights(Active::all);
  Weights weights(count * goals.size());
  int frame = 0;
  for (auto _ : state) {
    if (frame++ % 64 == 0 && !motion.moveTo(goals)) return state.SkipWithError("a goal");
    motion.advance(1 / 60.0);
    motion.positions(weights);
    benchmark::DoNotOptimize(weights.data());
    benchmark::ClobberMemory();
  }
}

void evaluate(benchmark::State& state, const std::vector<Region>& regions, bool normals) {
  EvaluatorOptions options;
  options.influences = influencesOf(face().surface, regions);
  const Evaluator evaluator = orEnd(Evaluator::make(face(), options));
  const Weights plain = someWeights(Active::all);
  Weights weights;  // a little different everywhere, as on the way to a goal
  for (std::size_t r = 0; r < std::max<std::size_t>(1, regions.size()); ++r)
    for (const double w : plain) weights.push_back(w * (1 - 0.05 * static_cast<double>(r)));
  std::vector<float> out(6 * static_cast<std::size_t>(evaluator.vertexCount()));
  std::vector<std::byte> scratch(evaluator.scratchBytes());
  Evaluation frame;
  frame.evaluator = &evaluator;
  frame.weights = weights;
  frame.scratch = scratch;
  frame.positions = {out.data(), evaluator.vertexCount()};
  if (normals) frame.normals = {out.data() + out.size() / 2, evaluator.vertexCount()};
  for (auto _ : state) {
    frame.run();
    benchmark::ClobberMemory();
  }
  state.counters["bytes"] =
      static_cast<double>(evaluator.positionBytes() + (normals ? evaluator.normalBytes() : 0));
}

const bool registered = [] {
  for (const std::size_t count : {1, kRegions})
    benchmark::RegisterBenchmark(fmt::format("regions-motion/{}", count).c_str(),
                                 [=](benchmark::State& state) { moveRegions(state, count); })
        ->Unit(benchmark::kMicrosecond);
  for (const bool normals : {false, true})
    for (const bool regional : {false, true})
      benchmark::RegisterBenchmark(
          fmt::format("regions-{}/{}", normals ? "normals" : "positions", regional ? kRegions : 1)
              .c_str(),
          [=](benchmark::State& state) {
            evaluate(state, regional ? bands() : std::vector<Region>{}, normals);
          })
          ->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
}  // namespace sweepface::bench
