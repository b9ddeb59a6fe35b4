#include <gtest/gtest.h>
#include <random>
#include <set>

#include "sweepface/edit.hpp"

#include "codec/files.hpp"
#include "codec/lattice.hpp"
#include "codec/near_sites.hpp"
#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;
using codec::Coefficients;
using codec::Hierarchy;
using codec::Lattice;
using codec::NearSites;
using codec::NearTable;
using codec::Prediction;
using codec::stepOf;

Wireframe creased() {
  Wireframe w = twoPatches();
  w.arcs[5].crease = true;
  return w;
}

/// Wireframes of every kind: grids large and small, T-nodes, poles, creases.
std::vector<Wireframe> someWireframes() {
  return {onePatch(1, 1), onePatch(7, 4), twoPatches(),
          slice(),        tee(),          fan(3),
          fan(6),         creased(),      wheel(6, {0, 1, 2, 3, 4, 5}),
          sheet(8)};
}

std::vector<Surface> someSurfaces() {
  std::vector<Surface> surfaces;
  for (Wireframe& w : someWireframes()) surfaces.push_back(Surface::make(std::move(w)).value());
  return surfaces;
}

Coefficients anyCoefficients(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  Coefficients q(count);
  for (auto& v : q)
    for (auto& x : v) {
      const auto r = static_cast<std::int32_t>(random() >> 8);
      x = r % 3 == 0 ? 0 : r % 7 == 0 ? r % 200001 - 100000 : r % 9 - 4;
    }
  return q;
}

Packing someSteps() {
  Packing packing;
  packing.neutralStep = 0.01;
  packing.targetStep = 0.02;
  return packing;
}

TEST(Hierarchy, HasOneStepForEveryVectorOverThoseBefore) {
  for (const Surface& surface : someSurfaces()) {
    const Lattice lattice(surface, {});
    std::vector<char> known(surface.storedCount(), 0);
    for (const Prediction::Step& step : lattice.prediction(0).steps) {
      for (const Term& t : lattice.prediction(0).of(step)) EXPECT_TRUE(known[t.vector]);
      EXPECT_FALSE(known[step.vector]);
      known[step.vector] = 1;
      EXPECT_GT(step.reach, 0);
    }
    EXPECT_EQ(std::ranges::count(known, 1), surface.storedCount());
  }
}

TEST(Hierarchy, KnowsTheSiteOfEveryVector) {
  for (const Surface& surface : someSurfaces()) {
    const Lattice lattice(surface, {});
    const auto& sites = lattice.hierarchy().sites();
    for (const Prediction::Step& step : lattice.prediction(0).steps) {
      ASSERT_LT(step.site, static_cast<Index>(sites.size()));
      EXPECT_GE(step.vector, sites[step.site].first);
      EXPECT_LT(step.vector, sites[step.site].first + sites[step.site].count);
    }
    for (std::size_t s = 0; s < sites.size(); ++s)
      EXPECT_EQ(lattice.prediction(0).steps[s].vector, sites[s].first);
  }
}

TEST(NearTable, TellsTheNearestSitesBeforeEachThatIsNoRoot) {
  for (const Surface& surface : someSurfaces()) {
    const Lattice lattice(surface, someSteps());
    const auto& sites = lattice.hierarchy().sites();
    const NearTable table(surface, lattice.hierarchy());
    for (Index s = 0; s < static_cast<Index>(sites.size()); ++s) {
      const auto near = table.of(s);
      EXPECT_EQ(near.empty(), sites[s].span == 0);
      EXPECT_LE(near.size(), NearSites::kMost);
      EXPECT_EQ(std::set<Index>(near.begin(), near.end()).size(), near.size());
      for (const Index other : near) {
        EXPECT_LT(other, s);
        EXPECT_NE(other, sites[s].mirror);
      }
    }
  }
}

// Predictions keep constants: the factors of positions add up to 1 for positions, else to 0.
void expectSumsOfOne(const Surface& surface, const Prediction& prediction) {
  std::vector<char> known(surface.storedCount(), 0);
  for (const Prediction::Step& step : prediction.steps) {
    const StoredVector& s = surface.stored(step.vector);
    double sum = 0;
    for (const Term& t : prediction.of(step)) {
      EXPECT_TRUE(known[t.vector]);
      const StoredVector& from = surface.stored(t.vector);
      if (from.i + from.j == 0) sum += t.factor;
    }
    known[step.vector] = 1;
    EXPECT_NEAR(sum, !prediction.of(step).empty() && s.i + s.j == 0 ? 1 : 0, 1e-12);
  }
}

TEST(Hierarchy, PredictionsAddUpToOneForPositionsAndToNothingForDerivatives) {
  for (const Surface& surface : someSurfaces())
    expectSumsOfOne(surface, Lattice(surface, {}).prediction(0));
}

TEST(PredictedMoves, AddUpToOneWhereverTheNeutralIs) {
  for (const Surface& surface : someSurfaces())
    for (const double size : {0.0, 1e-200, 1.0, 1e200}) {
      Lattice lattice(surface, someSteps());
      std::vector<Vec3> neutral;
      for (Index v = 0; v < surface.storedCount(); ++v) neutral.push_back(size * anyVector(v));
      lattice.learn(surface, neutral, 0.01);
      expectSumsOfOne(surface, lattice.prediction(1));
    }
}

// A sheet whose nodes get denser towards one corner, and how a bump in space moves them.
struct Bump {
  Rig rig = makeRig(sheet(16));
  std::vector<Vec3> neutral, move;

  Bump() {
    for (Index v = 0; v < rig.surface.storedCount(); ++v) {
      const double x = std::pow(v % 17 / 16.0, 3), y = std::pow(v / 17 / 16.0, 3);
      neutral.push_back({x, y, 0.3 * std::sin(3 * x)});
      move.push_back({0, 0, std::exp(-4 * ((x - 0.4) * (x - 0.4) + (y - 0.5) * (y - 0.5)))});
    }
  }
  double told(const Lattice& lattice) const {
    double sum = 0;
    for (const auto& q : lattice.round(1, move, 0.001)) sum += std::abs(q[2]);
    return sum;
  }
};

TEST(PredictedMoves, FollowWhatHappensInSpaceBetterThanLinesDo) {
  const Bump bump;
  Lattice lattice(bump.rig.surface, someSteps());
  const double byLines = bump.told(lattice);
  lattice.learn(bump.rig.surface, bump.neutral, 0.001);
  EXPECT_LT(bump.told(lattice), 0.85 * byLines);
}

TEST(Lattice, RoundsWhatItRestoresToTheSameCoefficients) {
  for (const Surface& surface : someSurfaces()) {
    const Lattice lattice(surface, {});
    const Coefficients q = anyCoefficients(surface.storedCount(), 3);
    std::vector<Vec3> vectors(q.size());
    lattice.restore(0, q, 0.01, vectors);
    EXPECT_EQ(lattice.round(0, vectors, 0.01), q);
  }
}

TEST(Lattice, RestoresManyPosesAsEachAlone) {
  constexpr Index kPoses = 7;  // more than are restored side by side; one has a finer step
  for (const Surface& surface : someSurfaces()) {
    const Lattice lattice(surface, {});
    const auto count = static_cast<std::size_t>(surface.storedCount());
    std::vector<codec::Sparse> moved;
    std::vector<std::vector<Vec3>> together(kPoses, std::vector<Vec3>(count)), alone = together;
    std::vector<Lattice::Restored> poses;
    for (Index k = 0; k < kPoses; ++k) {
      const double step = k == 2 ? 0.005 : 0.02;
      const Coefficients q = k == 4 ? Coefficients(count) : anyCoefficients(count, 11 + k);
      moved.push_back(codec::movedIn(q));
      lattice.restore(1, q, step, alone[k]);
    }
    for (Index k = 0; k < kPoses; ++k)
      poses.push_back({moved[k], k == 2 ? 0.005 : 0.02, together[k]});
    EXPECT_TRUE(lattice.restore(lattice.prediction(1), poses));
    EXPECT_EQ(together, alone);
  }
}

TEST(Lattice, SaysWhereOneOfManyPosesIsNotFinite) {
  const Surface surface = Surface::make(sheet(8)).value();
  const Lattice lattice(surface, {});
  const auto count = static_cast<std::size_t>(surface.storedCount());
  const codec::Sparse still, moved{{0, {1 << 26, 0, 0}}};
  for (std::size_t k = 0; k < 6; ++k) {
    std::vector<std::vector<Vec3>> vectors(6, std::vector<Vec3>(count));
    std::vector<Lattice::Restored> poses;
    for (std::size_t p = 0; p < 6; ++p)
      poses.push_back({p == k ? moved : still, p == k ? 1e307 : 0.01, vectors[p]});
    EXPECT_FALSE(lattice.restore(lattice.prediction(1), poses)) << k;
  }
}

TEST(Lattice, IsNeverMoreThanHalfAStepOff) {
  for (const Surface& surface : someSurfaces()) {
    const Lattice lattice(surface, {});
    std::vector<Vec3> vectors, restored(surface.storedCount());
    for (Index v = 0; v < surface.storedCount(); ++v) vectors.push_back(anyVector(v));
    lattice.restore(0, lattice.round(0, vectors, 0.25), 0.25, restored);
    for (const Prediction::Step& step : lattice.prediction(0).steps) {
      const Vec3 off = restored[step.vector] - vectors[step.vector];
      for (const double x : {off.x, off.y, off.z})
        EXPECT_LE(std::abs(x), 0.125 / step.reach + 1e-12);
    }
  }
}

/// A rig whose vectors all lie on the lattice of its steps.
Rig packed(Wireframe wireframe, unsigned seed = 1) {
  Rig rig = makeRig(std::move(wireframe));
  rig.packing = someSteps();
  rig.packing.poses = {{0, -1}, {0, -1}, {2, -1}, {0, -1}};
  Lattice lattice(rig.surface, rig.packing);
  const std::size_t count = rig.neutral.size();
  lattice.restore(0, anyCoefficients(count, seed), stepOf(rig.packing, 0), rig.neutral);
  lattice.learn(rig.surface, rig.neutral, stepOf(rig.packing, 0));
  for (Index k = 1; k <= 3; ++k)
    lattice.restore(k, k == 3 ? Coefficients(count) : anyCoefficients(count, seed + k),
                    stepOf(rig.packing, k), rig.targets[k - 1].difference);
  return rig;
}

bool hasChunk(const std::string& bytes, std::string_view code) {
  for (const FileChunk& chunk : takeApart(bytes))
    if (chunk.code == code) return true;
  return false;
}

TEST(Packing, VectorsOnTheLatticeComeBackBitForBitWithoutBeingHeldAsTheyAre) {
  for (const Wireframe& w : someWireframes()) {
    const Rig rig = packed(w);
    const std::string bytes = encode(rig);
    const auto back = decode(bytes, "a.sweep");
    ASSERT_TRUE(back) << back.error().message;
    expectEqual(*back, rig);
    EXPECT_EQ(back->packing, rig.packing);
    EXPECT_FALSE(hasChunk(bytes, "EXAC"));
    EXPECT_EQ(encode(*back), bytes);
  }
}

// The node has more vectors than an integer has bits.
TEST(Packing, OnlyTheFirstOfManyVectorsOfANodeMoves) {
  Rig rig = packed(wheel(6, {0, 1, 2, 3, 4, 5}));
  const auto isAtTheCentre = [&](Index v) { return rig.surface.stored(v).node == 0; };
  Index first = 0;
  while (!isAtTheCentre(first)) ++first;
  ASSERT_TRUE(isAtTheCentre(first + 33));
  std::ranges::fill(rig.targets[0].difference, Vec3{});
  rig.targets[0].difference[first] = {rig.packing.targetStep, 0, 0};
  expectEqual(decode(encode(rig), "a.sweep").value(), rig);
}

TEST(Packing, WhatLeavesTheLatticeIsHeldExactlyAndTheRestStays) {
  Rig rig = packed(onePatch(7, 4));
  const std::size_t before = encode(rig).size();
  rig.neutral[5] = {1.0 / 3, -0.0, 1e-300};
  rig.targets[1].difference[7].y += 1e-9;
  const std::string bytes = encode(rig);
  EXPECT_TRUE(hasChunk(bytes, "EXAC"));
  EXPECT_LE(bytes.size(), before + 150);
  const Rig back = decode(bytes, "a.sweep").value();
  expectEqual(back, rig);
  EXPECT_TRUE(std::signbit(back.neutral[5].y));
  EXPECT_EQ(encode(back), bytes);
}

TEST(Packing, AnEditOfTheNeutralLeavesTargetsOnTheirSteps) {
  Rig rig = packed(sheet(8));
  const std::size_t before = encode(rig).size();
  const NodeMove move{40, {0.123, 0, 0.1}};
  ASSERT_TRUE(moveNodes(rig, std::span(&move, 1)));
  const std::string bytes = encode(rig);
  EXPECT_LE(bytes.size(), before + 60);
  const Rig back = decode(bytes, "a.sweep").value();
  expectEqual(back, rig);
  EXPECT_EQ(encode(back), bytes);
}

TEST(Packing, FormsThatCannotBeAreMadeSound) {
  Rig rig = packed(tee());
  rig.packing.poses = {{-3, 7}, {99, 0}, {0, 2}};
  rig.packing.axis = 9;
  rig.packing.textureBits = 99;
  rig.packing.mirror = {{-1, 0}, {0, 20}, {0, 1 << 20}};  // there are half-arcs 0 to 19
  rig.packing.rest = {{1, 2, 3}};
  const std::string bytes = encode(rig);
  const auto back = decode(bytes, "a.sweep");
  ASSERT_TRUE(back) << back.error().message;
  expectEqual(*back, rig);
  EXPECT_EQ(encode(*back), bytes);
  EXPECT_TRUE(back->packing.mirror.empty());
  rig.packing.mirror.assign(100, {0, 0});
  EXPECT_TRUE(decode(encode(rig), "a.sweep"));
}

// Two patches side by side, mirrored across the arc between them.
TEST(Packing, AMirroredHalfCostsHardlyAnything) {
  Wireframe w = twoPatches();
  for (Arc& arc : w.arcs) arc.edges = 2;
  Rig rig = makeRig(w);
  rig.targets.clear();
  rig.packing = someSteps();
  rig.packing.mirror = {{0, 2}};  // 0 to 1 and 1 to 2, each with its patch on the left
  const Lattice lattice(rig.surface, rig.packing);
  Coefficients q = anyCoefficients(rig.neutral.size(), 5);
  const auto& images = lattice.hierarchy().images();
  for (std::size_t v = 0; v < q.size(); ++v) {
    ASSERT_GE(images[v].vector, 0);
    const int sign = images[v].sign;
    for (int a = 0; a < 3; ++a) {
      const int turned = a == 0 ? -sign : sign;
      if (images[v].vector == static_cast<Index>(v) && turned < 0) q[v][a] = 0;
      if (images[v].vector > static_cast<Index>(v)) q[images[v].vector][a] = turned * q[v][a];
    }
  }
  lattice.restore(0, q, 0.01, rig.neutral);
  rig.packing.poses = {{0, 0}};
  const std::size_t mirrored = encode(rig).size();
  expectEqual(decode(encode(rig), "a.sweep").value(), rig);
  rig.packing.poses = {{0, -1}};
  EXPECT_LT(mirrored, encode(rig).size());
}

TEST(Packing, AWireframeInAnyNumberingComesBackAsItIs) {
  std::mt19937 random(11);
  for (const Wireframe& w : someWireframes()) {
    Wireframe other = w;
    std::vector<Index> arcs(w.arcs.size());
    for (std::size_t k = 0; k < arcs.size(); ++k) arcs[k] = static_cast<Index>(k);
    std::ranges::shuffle(arcs, random);
    for (std::size_t k = 0; k < arcs.size(); ++k) other.arcs[arcs[k]] = w.arcs[k];
    for (HalfArc& h : other.loops) h = 2 * arcs[arcOf(h)] + (h & 1);
    Rig rig;
    rig.surface = Surface::make(other).value();
    rig.neutral.resize(rig.surface.storedCount());
    const auto back = decode(encode(rig), "a.sweep");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->surface.wireframe(), other);
  }
}

}  // namespace
}  // namespace sweepface
