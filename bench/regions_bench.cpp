// What regions cost: a frame of their motion and of their blend, next to plain ones.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <vector>

#include "sweepface/evaluator.hpp"
#include "sweepface/regional_motion.hpp"

#include "add.hpp"
#include "bench_face.hpp"
#include "give_up.hpp"

namespace sweepface::bench {
namespace {

constexpr int kRegions = 8;

/// Places of the nodes.
std::vector<Vec3> nodes() {
  const Rig& rig = face();
  const std::vector<Vec3> vectors = blend(rig, {});
  std::vector<Vec3> places(rig.surface.wireframe().nodes.size());
  for (Index a = 0; a < static_cast<Index>(rig.surface.wireframe().arcs.size()); ++a)
    places[rig.surface.wireframe().arcs[a].from] = rig.surface.pointOnArc(vectors, a, 0);
  return places;
}

std::vector<Region> divided(std::vector<std::vector<double>> shares) {
  std::vector<Region> regions;
  for (auto& painted : shares)
    regions.push_back({fmt::format("region{}", regions.size()),
                       {1.0 + static_cast<double>(regions.size()), 1, 0},
                       std::move(painted)});
  return orEnd(dividedFace(face(), std::move(regions)));
}

/// Seven round regions far from each other, a third of each fading, and the rest.
std::vector<Region> islands() {
  const std::vector<Vec3> places = nodes();
  std::vector<double> nearest(places.size(), 1e30);
  std::vector<Vec3> centres{places[0]};
  const auto farthest = [&] {
    for (std::size_t n = 0; n < places.size(); ++n)
      nearest[n] = std::min(nearest[n], norm(places[n] - centres.back()));
    return static_cast<std::size_t>(std::ranges::max_element(nearest) - nearest.begin());
  };
  while (centres.size() < kRegions - 1) centres.push_back(places[farthest()]);
  const double reach = nearest[farthest()] / 2;
  std::vector<std::vector<double>> shares;
  for (const Vec3& centre : centres) {
    Brush brush;
    brush.points = {centre};
    brush.alongSurface = false;
    brush.whole = 2 * reach / 3, brush.fade = reach / 3;
    shares.push_back(orEnd(paint(face(), brush)));
  }
  return divided(std::move(shares));
}

/// Eight bands across the face that fade into each other everywhere.
std::vector<Region> bands() {
  const std::vector<Vec3> places = nodes();
  const auto [low, high] = std::ranges::minmax(places, {}, &Vec3::y);
  Brush brush;
  brush.points = {low};
  brush.fade = norm(high - low);
  brush.alongSurface = false;
  return divided(orEnd(paintBands(face(), brush, kRegions)));
}

/// Every node in another region than its neighbours: not a realistic face, but the worst case.
std::vector<Region> patchwork() {
  const std::size_t count = nodes().size();
  std::vector<std::vector<double>> shares(kRegions, std::vector<double>(count));
  for (std::size_t n = 0; n < count; ++n) shares[n * 5 % kRegions][n] = 1;
  return divided(std::move(shares));
}

enum class Goals { together, oneByOne };

/// Springs on all weights of all regions, with new goals for all every four seconds, or for one
/// weight every frame.
void moveRegions(benchmark::State& state, std::size_t count, Goals goals) {
  std::vector<Matter> matters(count);
  for (std::size_t r = 0; r < count; ++r) matters[r].mass = 1 + 0.5 * static_cast<double>(r);
  auto motion = orEnd(RegionalMotion::make(Weights(face().targets.size(), 0.0), matters));
  Weights wanted = someWeights(Active::all);
  Weights weights(count * wanted.size());
  std::size_t frame = 0;
  for (auto _ : state) {
    if (goals == Goals::oneByOne) {
      const std::size_t k = frame++ % wanted.size();
      if (!motion.moveTo(k, wanted[k] = 1 - wanted[k])) return state.SkipWithError("a goal");
    } else if (frame++ % 256 == 0) {
      for (double& goal : wanted) goal = 1 - goal;
      if (!motion.moveTo(wanted)) return state.SkipWithError("a goal");
    }
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
  Weights weights;  // slightly different in every region, as on the way to a goal
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
  for (const std::size_t count : {1, kRegions}) {
    add(fmt::format("regions-motion/{}", count),
        [=](auto& state) { moveRegions(state, count, Goals::together); });
    add(fmt::format("regions-motion/{}-one-by-one", count),
        [=](auto& state) { moveRegions(state, count, Goals::oneByOne); });
  }
  for (const bool normals : {false, true}) {
    const std::string group = normals ? "regions-normals/" : "regions-positions/";
    add(group + "none", [=](auto& state) { evaluate(state, {}, normals); });
    add(group + "islands", [=](auto& state) { evaluate(state, islands(), normals); });
    add(group + "bands", [=](auto& state) { evaluate(state, bands(), normals); });
    add(group + "patchwork", [=](auto& state) { evaluate(state, patchwork(), normals); });
  }
  return true;
}();

}  // namespace
}  // namespace sweepface::bench
