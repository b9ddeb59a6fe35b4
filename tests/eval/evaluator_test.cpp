#include "sweepface/evaluator.hpp"

#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <thread>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/io.hpp"

#include "codec/rigs.hpp"
#include "eval/play.hpp"
#include "eval/shader_tables.hpp"
#include "eval/tile_kernels.hpp"
#include "faces.hpp"
#include "greater.hpp"

#ifdef SWEEPFACE_SIMD
#include <hwy/targets.h>
#endif

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// Faces made by the converter: smooth, open and closed, with poles and irregular vertices.
const std::vector<Rig>& convertedRigs() {
  static const std::vector<Rig> rigs = [] {
    ConvertOptions options;
    options.tolerance = 0.05;
    options.chooseShapes = false;
    std::vector<Rig> list;
    for (const MeshRig& mesh : {withTargets(plane()), withTargets(cubeSphere(4)),
                                withTargets(uvSphere(8, 6)), withTargets(pinwheel(5, 3))})
      list.push_back(convert(mesh, options).value().rig);
    return list;
  }();
  return rigs;
}

/// The converted rigs and those made by hand.
const std::vector<Rig>& everyRig() {
  static const std::vector<Rig> rigs = [] {
    std::vector<Rig> list = someRigs();
    list.insert(list.end(), convertedRigs().begin(), convertedRigs().end());
    return list;
  }();
  return rigs;
}

std::vector<double> anyWeights(const Evaluator& evaluator, unsigned seed, double size = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<double> weights(evaluator.weightCount());
  for (double& w : weights) w = uniform(random);
  return weights;
}

std::vector<Vec3> surfacePositions(const Rig& rig, Index level,
                                   const std::vector<double>& weights) {
  const Tessellation grid(rig.surface, std::max<Index>(1, level));
  const auto vectors = blend(rig, weights);
  return level == 0 ? sourcePositions(rig, grid, vectors, weights) : grid.positions(vectors);
}

double largestDistance(const std::vector<float>& floats, const std::vector<Vec3>& wanted) {
  double most = 0;
  for (std::size_t v = 0; v < wanted.size(); ++v)
    most = greater(most, norm(vectorOf(floats, v) - wanted[v]));
  return most;
}

TEST(Evaluator, staysWithinItsBoundOfTheSurfaceAtAnyWeights) {
  for (const Rig& rig : everyRig())
    for (const Index level : {0, 1, 3})
      for (const double size : {0.1, 1.0, 20.0}) {
        const auto evaluator = Evaluator::make(rig, {.level = level}).value();
        const auto weights = anyWeights(evaluator, 7, size);
        const auto wanted = surfacePositions(rig, level, weights);
        ASSERT_EQ(evaluator.vertexCount(), static_cast<Index>(wanted.size()));
        EXPECT_LE(largestDistance(play(evaluator, weights).positions, wanted),
                  evaluator.positionBound(weights));
      }
}

TEST(Evaluator, dropsNoMoreOfATargetThanItsTolerance) {
  for (const Rig& rig : everyRig())
    for (const double asked : {1e-3, 1e-2, 0.0}) {
      const auto evaluator = Evaluator::make(rig, {.tolerance = asked}).value();
      const double tolerance = asked > 0 ? asked : 0.3 * rig.tolerance;
      std::vector<double> weights(evaluator.weightCount());
      for (double& weight : weights) {
        weight = 1;
        const double rounding = evaluator.positionBound({});
        EXPECT_LE(evaluator.positionBound(weights) - rounding, tolerance);
        EXPECT_LE(rounding, 2e-3);
        EXPECT_LE(
            largestDistance(play(evaluator, weights).positions, surfacePositions(rig, 0, weights)),
            evaluator.positionBound(weights));
        weight = 0;
      }
    }
}

TEST(Evaluator, playsTheNeutralTo16Bits) {
  for (const Rig& rig : everyRig()) {
    const auto evaluator = Evaluator::make(rig).value();
    const auto wanted = surfacePositions(rig, 0, {});
    double largest = 0;
    for (const Vec3& p : wanted) largest = std::max(largest, norm(p));
    EXPECT_LE(largestDistance(play(evaluator, {}).positions, wanted), largest / (1 << 15));
  }
}

/// The sine of the largest angle by which a normal of length `sine` may turn when each of its two
/// unit derivatives is off by `error`.
double mostTurn(double error, double sine) { return error * (2 + error) / sine; }

TEST(Evaluator, hasTheSurfacesOwnNormals) {
  for (const Rig& rig : convertedRigs()) {
    for (const Index level : {0, 2}) {
      const auto evaluator =
          Evaluator::make(rig, {.level = level, .derivativeTolerance = 1e-3}).value();
      const auto weights = anyWeights(evaluator, 3, 0.5);
      const Tessellation grid(rig.surface, std::max<Index>(1, level));
      const auto vectors = blend(rig, weights);
      const auto wanted = level == 0 ? sourceNormals(rig, grid, vectors) : grid.normals(vectors);
      const auto played = play(evaluator, weights);
      double squares = 0;
      for (std::size_t v = 0; v < wanted.size(); ++v) {
        const Vec3 n = vectorOf(played.normals, v);
        EXPECT_NEAR(norm(n), 1, 1e-5);
        EXPECT_NEAR(norm(vectorOf(played.tangents, v)), 1, 1e-5);
        EXPECT_NEAR(dot(n, vectorOf(played.tangents, v)), 0, 1e-5);
        EXPECT_LE(norm(n - wanted[v]), mostTurn(evaluator.derivativeBound(weights), 0.05)) << v;
        squares += std::pow(angleDegrees(n, wanted[v]), 2);
      }
      EXPECT_LE(std::sqrt(squares / static_cast<double>(wanted.size())), 0.2);
    }
  }
}

// A part that is closed in the neutral, next to the skin of another part that moves.
TEST(Evaluator, hasTheNormalsOfWhatATargetOpens) {
  const PolygonMesh skin = cubeSphere(4), part = cubeSphere(2, 0.8);
  for (const double shut : {0.0, 1e-12, 1e-6, 1e-3}) {
    const auto scaled = [&](double size) {
      PolygonMesh mesh = part;
      for (Vec3& p : mesh.positions) p = size * p;
      return joined(skin, mesh, {4.1, 0.8, 0.4});
    };
    MeshRig mesh{scaled(shut), {{"open", scaled(1).positions}}};
    auto& open = mesh.targets[0].positions;
    for (std::size_t v = 0; v < skin.positions.size(); ++v)
      open[v].y += 0.1 * open[v].x * open[v].x;
    ConvertOptions options;
    options.tolerance = 0.02;
    options.chooseShapes = false;
    const Rig rig = convert(mesh, options).value().rig;
    for (const Index level : {0, 3}) {
      const auto evaluator = Evaluator::make(rig, {.level = level}).value();
      const Tessellation grid(rig.surface, std::max<Index>(1, level));
      const auto vectors = blend(rig, Weights{1.0});
      const auto wanted = level == 0 ? sourceNormals(rig, grid, vectors) : grid.normals(vectors);
      const auto played = play(evaluator, {1.0});
      for (std::size_t v = 0; v < wanted.size(); ++v)
        EXPECT_LE(angleDegrees(vectorOf(played.normals, v), wanted[v]), 2) << shut << " " << v;
      for (const double far : {-1e6, 1e6})
        for (const float x : play(evaluator, {far}).normals) EXPECT_LE(std::abs(x), 1.001f);
    }
  }
}

/// As of files that double vertices where attributes differ: rounding must open no cracks there.
TEST(Evaluator, putsSourceVerticesInOnePlaceToTheBit) {
  for (Rig rig : convertedRigs()) {
    std::vector<Index>& places = rig.source.gridVertex;
    const auto count = static_cast<Index>(places.size());
    for (const Index other : {Index{1}, Index{7}})
      for (Index v = 0; v < count; ++v) places.push_back(places[(v * other) % count]);
    const auto evaluator = Evaluator::make(rig).value();
    const auto played = play(evaluator, anyWeights(evaluator, 5));
    std::map<Index, Index> first;
    for (Index v = 0; v < static_cast<Index>(places.size()); ++v) {
      const Index same = first.emplace(places[v], v).first->second;
      EXPECT_EQ(vectorOf(played.positions, v), vectorOf(played.positions, same));
      EXPECT_EQ(vectorOf(played.normals, v), vectorOf(played.normals, same));
    }
  }
}

// The buffers already hold the previous frame; an update must leave the result of a full one.
TEST(Evaluator, writesOnlyWhatOtherWeightsMoveAndTheSameAsAWholeFrame) {
  for (const Rig& rig : everyRig())
    for (const double size : {1.0, 3.0}) {
      const auto evaluator = Evaluator::make(rig, {.level = 2}).value();
      const Index count = evaluator.vertexCount();
      const auto first = anyWeights(evaluator, 3, size);
      for (std::size_t k = 0; k <= first.size(); ++k) {
        auto second = first;
        if (k < first.size()) second[k] = 0.5 * second[k] + 0.1;
        Played shown = play(evaluator, first);
        std::vector<std::byte> scratch(evaluator.scratchBytes());
        Evaluation job{&evaluator,
                       second,
                       scratch,
                       {shown.positions.data(), count},
                       {shown.normals.data(), count},
                       {shown.tangents.data(), count}};
        job.previous = first;
        ASSERT_TRUE(job.validate());
        job.run();
        EXPECT_EQ(shown, play(evaluator, second));
      }
    }
}

TEST(Evaluator, leavesAloneWhatNoOtherWeightMoves) {
  const Rig rig = dressed(makeRig(onePatch(2, 3)));
  const auto evaluator = Evaluator::make(rig).value();
  const auto weights = anyWeights(evaluator, 3);
  std::vector<float> marks(3 * evaluator.vertexCount(), 7.0f);
  std::vector<std::byte> scratch(evaluator.scratchBytes());
  Evaluation job{&evaluator, weights, scratch, {marks.data(), evaluator.vertexCount()}, {}, {}};
  job.previous = weights;
  job.run();
  EXPECT_EQ(marks, std::vector<float>(marks.size(), 7.0f));
  const std::vector<double> tooMany(weights.size() + 1);
  job.previous = tooMany;
  EXPECT_FALSE(job.validate());
}

TEST(Evaluator, playsLooseVerticesWhichLookAlongZ) {
  const Rig rig = dressed(makeRig(onePatch(2, 3)));
  const auto evaluator = Evaluator::make(rig).value();
  const std::size_t last = rig.source.gridVertex.size() - 1;
  const auto played = play(evaluator, {0.5, 1, 0});
  EXPECT_LE(norm(vectorOf(played.positions, last) - Vec3{4.75, 5, 6}), 1e-3);
  EXPECT_LE(norm(vectorOf(played.normals, last) - Vec3{0, 0, 1}), 2e-5);
}

TEST(Evaluator, blendsEachRegionByItsOwnWeights) {
  for (const Rig& rig : everyRig()) {
    const auto stored = static_cast<std::size_t>(rig.surface.storedCount());
    const std::size_t targets = rig.targets.size();
    std::vector<float> left(stored), right(stored);
    for (std::size_t v = 0; v < stored; ++v)
      left[v] = v % 3 == 0 ? 0.0f : v % 3 == 1 ? 0.25f : 1.0f, right[v] = 1 - left[v];
    const auto evaluator = Evaluator::make(rig, {.influences = {left, right}}).value();
    ASSERT_EQ(evaluator.weightCount(), static_cast<Index>(2 * targets));
    const auto weights = anyWeights(evaluator, 5);
    std::vector<Vec3> vectors(rig.surface.vectorCount());
    for (std::size_t v = 0; v < stored; ++v) {
      vectors[v] = rig.neutral[v];
      for (std::size_t k = 0; k < targets; ++k)
        vectors[v] +=
            (weights[k] * left[v] + weights[targets + k] * right[v]) * rig.targets[k].difference[v];
    }
    rig.surface.settle({vectors.data(), stored}, vectors);
    auto ofFirst = weights;
    ofFirst.resize(targets);
    EXPECT_LE(largestDistance(play(evaluator, weights).positions,
                              sourcePositions(rig, Tessellation(rig.surface, 1), vectors, ofFirst)),
              evaluator.positionBound(weights));
  }
}

// Whichever weight is the large one: weights are scaled by the largest.
TEST(Evaluator, bearsOneLargeWeight) {
  const Rig rig = makeRig(onePatch(3, 2));
  const std::vector<float> everywhere(rig.surface.storedCount(), 1.0f);
  const auto evaluator = Evaluator::make(rig, {.influences = {2, everywhere}}).value();
  for (std::size_t k = 0; k < 6; ++k) {
    std::vector<double> weights(6), sums(3);
    weights[k] = sums[k % 3] = 20;
    EXPECT_LE(largestDistance(play(evaluator, weights).positions, surfacePositions(rig, 0, sums)),
              evaluator.positionBound(weights))
        << k;
  }
}

/// A face with enough tiles for several parts.
const Rig& largeRig() {
  static const Rig rig = makeRig(onePatch(17, 13));
  return rig;
}

TEST(Evaluator, givesTheSameInParts) {
  const auto evaluator = Evaluator::make(largeRig()).value();
  const auto weights = anyWeights(evaluator, 1);
  for (const Index parts : {2, 3, 7, 1000})
    EXPECT_EQ(play(evaluator, weights, parts), play(evaluator, weights));
}

TEST(Evaluator, givesTheSameFromAColdCache) {
  const auto evaluator = Evaluator::make(largeRig()).value();
  const auto weights = anyWeights(evaluator, 1);
  const Index count = evaluator.vertexCount();
  std::vector<float> positions(3 * count);
  std::vector<std::byte> scratch(evaluator.scratchBytes());
  Evaluation job{&evaluator, weights, scratch, {positions.data(), count}, {}, {}};
  job.cold = true;
  job.run();
  EXPECT_EQ(positions, play(evaluator, weights).positions);
}

TEST(Evaluator, mayBeUsedByManyThreads) {
  const auto evaluator = Evaluator::make(largeRig()).value();
  std::vector<Played> played(4);
  {
    std::vector<std::jthread> threads;
    for (unsigned t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        for (int k = 0; k < 20; ++k) played[t] = play(evaluator, anyWeights(evaluator, t));
      });
  }
  for (unsigned t = 0; t < 4; ++t) EXPECT_EQ(played[t], play(evaluator, anyWeights(evaluator, t)));
}

TEST(Evaluator, letsThreadsShareOneFrame) {
  const auto evaluator = Evaluator::make(largeRig()).value();
  const auto weights = anyWeights(evaluator, 1);
  const Index count = evaluator.vertexCount();
  std::vector<float> positions(3 * count);
  {
    std::vector<std::jthread> threads;
    for (Index t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        std::vector<std::byte> scratch(evaluator.scratchBytes());
        Evaluation{&evaluator, weights, scratch, {positions.data(), count}, {}, {}, t, 4}.run();
      });
  }
  EXPECT_EQ(positions, play(evaluator, weights).positions);
}

TEST(Evaluator, writesAtAnyStrideAndNothingBesides) {
  const auto evaluator = Evaluator::make(largeRig()).value();
  const auto weights = anyWeights(evaluator, 2);
  const auto tight = play(evaluator, weights);
  std::vector<std::byte> scratch(evaluator.scratchBytes());
  constexpr float kUntouched = 12345;
  const Index all = evaluator.vertexCount();
  for (const std::size_t floats : {3, 4, 5, 8})
    for (const Index count : {0, 1, 15, 16, 17, 31, 32, 33, all - 1, all, all + 1}) {
      std::vector<float> out(floats * all, kUntouched), normals = out;
      Evaluation{&evaluator,
                 weights,
                 scratch,
                 {out.data(), count, 4 * floats},
                 {normals.data(), count, 4 * floats},
                 {}}
          .run();
      for (Index v = 0; v < all; ++v)
        for (std::size_t c = 0; c < floats; ++c) {
          const bool written = v < count && c < 3;
          EXPECT_EQ(out[floats * v + c], written ? tight.positions[3 * v + c] : kUntouched);
          EXPECT_EQ(normals[floats * v + c], written ? tight.normals[3 * v + c] : kUntouched);
        }
    }
}

TEST(Evaluator, writesEachOutputAlone) {
  const auto evaluator = Evaluator::make(largeRig()).value();
  const auto weights = anyWeights(evaluator, 2);
  const Played all = play(evaluator, weights);
  std::vector<std::byte> scratch(evaluator.scratchBytes());
  for (const auto& [output, expected] : {std::pair(&Evaluation::positions, &all.positions),
                                         {&Evaluation::normals, &all.normals},
                                         {&Evaluation::tangents, &all.tangents}}) {
    std::vector<float> alone(expected->size());
    Evaluation job{&evaluator, weights, scratch, {}, {}, {}};
    job.*output = {alone.data(), evaluator.vertexCount()};
    job.run();
    EXPECT_EQ(alone, *expected);
  }
}

TEST(Evaluator, fillsExactlyItsVertices) {
  // Counts just above and below the sizes of tiles and SIMD vectors; sanitizers catch overruns.
  for (const Index n : {1, 2, 3, 4, 5, 6, 7, 10, 11}) {
    const Rig rig = makeRig(onePatch(n, 2));
    for (const Index level : {1, 2}) {
      const auto evaluator = Evaluator::make(rig, {.level = level}).value();
      const auto weights = anyWeights(evaluator, 4);
      EXPECT_LE(largestDistance(play(evaluator, weights).positions,
                                surfacePositions(rig, level, weights)),
                evaluator.positionBound(weights));
    }
  }
}

TEST(Evaluator, playsTheVerticesOfADensityWhateverTheLevel) {
  Rig rig = makeRig(onePatch(4, 4));
  rig.source.gridVertex.clear();  // the source order is not needed
  const Tessellation coarse(rig.surface, Density{std::vector<Index>(4, 1), {{1, 1}}});
  ASSERT_LT(coarse.vertexCount(), Tessellation(rig.surface, 1).vertexCount());
  for (const Index level : {0, 1, 5}) {
    const auto evaluator = Evaluator::make(rig, coarse, {.level = level});
    ASSERT_TRUE(evaluator) << evaluator.error().message;
    const auto weights = anyWeights(*evaluator, 4);
    EXPECT_LE(
        largestDistance(play(*evaluator, weights).positions, coarse.positions(blend(rig, weights))),
        evaluator->positionBound(weights));
  }
}

TEST(Evaluator, countsMissingWeightsAsZero) {
  const auto evaluator = Evaluator::make(largeRig()).value();
  auto weights = anyWeights(evaluator, 2);
  std::fill(weights.begin() + 3, weights.end(), 0.0);
  EXPECT_EQ(play(evaluator, {weights.begin(), weights.begin() + 3}), play(evaluator, weights));
}

TEST(Evaluator, staysFiniteAtHugeNumbers) {
  Rig rig = makeRig(twoPatches());
  for (Vec3& v : rig.neutral) v *= 1e300;
  for (Target& target : rig.targets)
    for (Vec3& v : target.difference) v *= 1e299;
  const auto evaluator = Evaluator::make(rig).value();
  for (const double size : {1.0, 1e6, 1e300})
    for (const float x : play(evaluator, anyWeights(evaluator, 1, size)).positions)
      EXPECT_TRUE(std::isfinite(x));
}

TEST(Evaluator, hasUnitNormalsOrNoneAtHugeWeights) {
  for (Rig rig : everyRig()) {
    for (Target& target : rig.targets)
      for (Vec3& v : target.difference) v *= 30;
    const auto evaluator = Evaluator::make(rig).value();
    for (const double size : {1.0, 1e6, 1e9, 1e300}) {
      const auto normals = play(evaluator, anyWeights(evaluator, 1, size)).normals;
      for (std::size_t v = 0; v < normals.size() / 3; ++v) {
        const double length = norm(vectorOf(normals, v));
        EXPECT_TRUE(length == 0 || std::abs(length - 1) < 1e-5) << length << " at " << size;
      }
    }
  }
}

TEST(Evaluator, refusesWhatDoesNotFit) {
  const Rig rig = makeRig(onePatch(3, 2));
  const auto evaluator = Evaluator::make(rig).value();
  const auto bare = Evaluator::make(rig, {.normals = false}).value();
  const auto directions = Evaluator::make(rig, {.positions = false}).value();
  const Index count = evaluator.vertexCount();
  std::vector<std::byte> scratch(evaluator.scratchBytes());
  std::vector<float> out(3 * count);
  std::vector<double> weights(3), tooMany(4);
  const Evaluation good{&evaluator, weights, scratch, {out.data(), count}, {}, {}};
  EXPECT_TRUE(good.validate());
  const auto refuses = [&](auto change, const char* why) {
    Evaluation job = good;
    change(job);
    const auto result = job.validate();
    return !result && result.error().message.find(why) != std::string::npos;
  };
  EXPECT_TRUE(refuses([](auto& job) { job.evaluator = nullptr; }, "evaluator"));
  const Evaluator none;
  EXPECT_TRUE(refuses([&](auto& job) { job.evaluator = &none; }, "evaluator"));
  EXPECT_TRUE(refuses([&](auto& job) { job.weights = tooMany; }, "4 weights for 3 targets"));
  EXPECT_TRUE(refuses([&](auto& job) { job.scratch = job.scratch.subspan(1); }, "scratch"));
  EXPECT_TRUE(refuses([](auto& job) { job.positions.count = -1; }, "negative"));
  EXPECT_TRUE(refuses([](auto& job) { job.positions.stride = 8; }, "stride"));
  EXPECT_TRUE(refuses([](auto& job) { job.positions.stride = kMostStride + 1; }, "stride"));
  EXPECT_TRUE(refuses([](auto& job) { job.part = 1; }, "no part 1 of 1"));
  EXPECT_TRUE(refuses([](auto& job) { job.part = -1; }, "no part -1 of 1"));
  EXPECT_TRUE(refuses([](auto& job) { job.parts = 0; }, "no part"));
  EXPECT_TRUE(refuses([&](auto& job) { job.evaluator = &bare, job.normals = job.positions; },
                      "without normals"));
  EXPECT_TRUE(refuses([&](auto& job) { job.evaluator = &bare, job.tangents = job.positions; },
                      "without normals"));
  EXPECT_TRUE(refuses([&](auto& job) { job.evaluator = &directions; }, "without positions"));
  const std::vector<double> odd{0, std::nan("")};
  EXPECT_TRUE(refuses([&](auto& job) { job.weights = odd; }, "Weight 1 is not finite"));
  EXPECT_TRUE(refuses([&](auto& job) { job.previous = odd; }, "Weight 1 is not finite"));
}

TEST(Evaluator, bearsAnyTolerance) {
  const Rig rig = makeRig(onePatch(3, 2));
  for (const double tolerance : {1e-300, 1e-20, 1e20, 1e300}) {
    const auto evaluator = Evaluator::make(rig, {.tolerance = tolerance}).value();
    const auto weights = anyWeights(evaluator, 1);
    EXPECT_LE(
        largestDistance(play(evaluator, weights).positions, surfacePositions(rig, 0, weights)),
        evaluator.positionBound(weights))
        << tolerance;
  }
}

TEST(Evaluator, bearsAnyToleranceOfDerivatives) {
  const Rig& rig = convertedRigs().front();
  const Tessellation grid(rig.surface, 1);
  const auto vectors = blend(rig, Weights(rig.targets.size(), 0.5));
  const auto wanted = sourceNormals(rig, grid, vectors);
  for (const double tolerance : {1e-300, 1e-20, 1e-12, 1e-9, 1e-7, 1e-4}) {
    const auto evaluator = Evaluator::make(rig, {.derivativeTolerance = tolerance}).value();
    const std::vector<double> weights(evaluator.weightCount(), 0.5);
    const auto played = play(evaluator, weights);
    EXPECT_LE(evaluator.derivativeBound(weights), 0.01) << tolerance;
    for (std::size_t v = 0; v < wanted.size(); ++v)
      EXPECT_LE(norm(vectorOf(played.normals, v) - wanted[v]), 0.01) << tolerance;
  }
  for (const double tolerance : {1e20, 1e300})
    EXPECT_GE(Evaluator::make(rig, {.derivativeTolerance = tolerance})
                  .value()
                  .derivativeBound(std::vector(rig.targets.size(), 0.5)),
              0.1);
}

TEST(Evaluator, isNotMadeOfWhatDoesNotFit) {
  const Rig rig = makeRig(onePatch(3, 2));
  const auto refuses = [&](const EvaluatorOptions& options, const char* why) {
    const auto made = Evaluator::make(rig, options);
    return !made && made.error().message.find(why) != std::string::npos;
  };
  EXPECT_TRUE(refuses({.level = -1}, "level"));
  EXPECT_TRUE(refuses({.level = kMostLevel + 1}, "level"));
  Rig vast;
  vast.surface = Surface::make(onePatch(30000, 30000)).value();
  EXPECT_FALSE(Evaluator::make(vast, {.level = kMostLevel + 1}));  // before it is tessellated
  EXPECT_TRUE(refuses({.tolerance = -1}, "tolerances"));
  EXPECT_TRUE(refuses({.tolerance = std::nan("")}, "tolerances"));
  EXPECT_TRUE(refuses({.derivativeTolerance = 0}, "tolerances"));
  EXPECT_TRUE(refuses({.influences = {{1, 1}}}, "2 influences for"));
  std::vector<float> influences(rig.surface.storedCount(), 1.0f);
  influences[5] = std::nanf("");
  EXPECT_TRUE(refuses({.influences = {influences}}, "finite"));
  influences[5] = 1;
  EXPECT_TRUE(refuses({.influences = std::vector(40000, influences)}, "at most 65534 weights"));
  EXPECT_FALSE(Evaluator::make(rig, Tessellation(rig.surface, 2), {.level = 3}));
  const Rig other = makeRig(fan(5));
  EXPECT_FALSE(Evaluator::make(rig, Tessellation(other.surface, 2), {.level = 2}));
  EXPECT_FALSE(Evaluator::make(rig, Tessellation(other.surface, 1), {.level = 0}));
  Rig undecoded = rig;
  undecoded.targets[1].difference.clear();
  EXPECT_FALSE(Evaluator::make(undecoded));
  EXPECT_TRUE(Evaluator::make(undecoded, {.targets = false}));
  Rig sourceless = rig;
  sourceless.source = {};
  EXPECT_FALSE(Evaluator::make(sourceless));
  EXPECT_TRUE(Evaluator::make(sourceless, {.level = 1}));
}

/// Random frame weights, some beyond 1, in scratch memory of the size that an evaluation has.
struct AnyFrame {
  explicit AnyFrame(const Evaluator& evaluator) : scratch(evaluator.scratchBytes()) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1.25, 1.25);
    std::vector<double> weights(evaluator.weightCount());
    for (double& weight : weights) weight = uniform(random);
    frame = frameWeights(evaluator.tables(), weights, scratch);
  }

  std::vector<std::byte> scratch;
  FrameWeights frame;
};

TileRange all(const TileTable& table) { return {table, 0, table.tileCount()}; }

/// Positions, normals and tangents computed directly by the kernels.
template <typename Positions, typename Normals>
Played playWith(const Evaluator& evaluator, const Positions& positions, const Normals& normals) {
  const EvaluatorTables& tables = evaluator.tables();
  const AnyFrame any(evaluator);
  const std::size_t floats = 3 * static_cast<std::size_t>(tables.vertices);
  Played out{std::vector<float>(floats), std::vector<float>(floats), std::vector<float>(floats)};
  const VectorsOut to[3] = {{out.positions.data(), tables.vertices},
                            {out.normals.data(), tables.vertices},
                            {out.tangents.data(), tables.vertices}};
  positions(all(tables.positions), any.frame, to[0]);
  normals(all(tables.derivatives), any.frame, to[1], to[2]);
  return out;
}

/// A table's modes as a kernel blends them.
template <typename Blend>
std::vector<std::int16_t> modesOf(const Evaluator& evaluator, const TileTable& table,
                                  const Blend& blend) {
  std::vector<std::int16_t> out(4 * std::size_t(shaderTables(table, evaluator.vertexCount()).modes),
                                7);
  blend(all(table), AnyFrame(evaluator).frame, out.data());
  return out;
}

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), 4 * a.size()) == 0;
}

/// Expects the plain kernels' results on every instruction set.
void expectSameBits(const Evaluator& evaluator) {
  const Index count = evaluator.vertexCount();
  const EvaluatorTables& tables = evaluator.tables();
  const Played right = playWith(evaluator, plain::evaluatePositions, plain::evaluateNormals);
  const auto check = [&] {
    const Played fast = playWith(
        evaluator,
        [&](const TileRange& tiles, const FrameWeights& frame, const VectorsOut& out) {
          evaluatePositions(tiles, frame, out, count);
        },
        [&](const TileRange& tiles, const FrameWeights& frame, const VectorsOut& normals,
            const VectorsOut& tangents) {
          evaluateNormals(tiles, frame, normals, tangents, count);
        });
    EXPECT_TRUE(sameBits(fast.positions, right.positions));
    EXPECT_TRUE(sameBits(fast.normals, right.normals));
    EXPECT_TRUE(sameBits(fast.tangents, right.tangents));
    for (const TileTable* table : {&tables.positions, &tables.derivatives}) {
      const auto modes = [](auto&&... x) { blendModes(x...); };
      EXPECT_EQ(modesOf(evaluator, *table, modes), modesOf(evaluator, *table, plain::blendModes));
    }
  };
#ifdef SWEEPFACE_SIMD
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    hwy::SetSupportedTargetsForTest(left & -left);
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
#endif
  check();
}

TEST(Kernels, giveTheSameBitsOnEveryInstructionSet) {
  for (const Rig& rig : everyRig()) expectSameBits(Evaluator::make(rig).value());
}

// Weights are looked up in windows of 64: no windows, a few, more than are read at once, too many.
TEST(Kernels, giveTheSameBitsForAnyNumberOfRegions) {
  const Rig& rig = convertedRigs().front();
  const std::size_t stored = static_cast<std::size_t>(rig.surface.storedCount()),
                    targets = rig.targets.size();
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(0.1f, 1);
  for (const std::size_t weights : {60, 130, 256, 500, 4200}) {
    EvaluatorOptions options;
    options.tolerance = 1e-4;
    options.influences.resize(weights / targets + 1, std::vector<float>(stored));
    for (auto& region : options.influences)
      std::ranges::generate(region, [&] { return uniform(random); });
    expectSameBits(Evaluator::make(rig, options).value());
    for (std::size_t r = 0; r < options.influences.size(); ++r)  // regions that do not overlap
      for (std::size_t v = 0; v < stored; ++v)
        if (v * options.influences.size() / stored != r) options.influences[r][v] = 0;
    expectSameBits(Evaluator::make(rig, options).value());
  }
}

// A tile with the maximum number of 16-bit and 8-bit target pairs.
TEST(Kernels, giveTheSameBitsWhereEveryTargetMovesEveryTile) {
  Rig rig = convertedRigs().front();
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const std::size_t targets : {64, 127, 128, 129, 256}) {
    rig.targets.clear();
    for (std::size_t k = 0; k < targets; ++k) {
      Target target{std::to_string(k), rig.neutral, rig.source.loose};
      const double size = k % 2 ? 1 : 0.01;
      for (auto* differences : {&target.difference, &target.looseDifference})
        for (Vec3& d : *differences)
          d = size * Vec3{uniform(random), uniform(random), uniform(random)};
      rig.targets.push_back(std::move(target));
    }
    expectSameBits(Evaluator::make(rig).value());
  }
}

TEST(LongEvaluator, playsARealHead) {
  SKIP_WITHOUT_REAL_FACES();
  const std::string folder = realFaces() + "/ictface/head/";
  const std::filesystem::path expressions[] = {folder + "expressions"};
  const auto source = readRig(folder + "neutral.obj", expressions).value();
  ConvertOptions options;
  options.tolerance = 0.02;
  const Rig rig = convert(source, options).value().rig;
  const auto evaluator = Evaluator::make(rig).value();
  const auto weights = anyWeights(evaluator, 1);
  EXPECT_LE(largestDistance(play(evaluator, weights).positions, surfacePositions(rig, 0, weights)),
            evaluator.positionBound(weights));
  EXPECT_LE(evaluator.positionBytes(), std::size_t(1) << 20);
}

}  // namespace
}  // namespace sweepface
