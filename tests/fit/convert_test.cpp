#include <set>
#include <tbb/global_control.h>

#include "sweepface/codec.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/measure.hpp"

#include "cache_sizes.hpp"
#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

// The largest distance between source vertices and their surface points, over the neutral and all
// targets at weight 1.
double worstDistance(const Rig& rig, const MeshRig& source) {
  const Tessellation level1(rig.surface, 1);
  double worst = 0;
  for (std::size_t pose = 0; pose <= source.targets.size(); ++pose) {
    Weights weights(source.targets.size(), 0);
    if (pose > 0) weights[pose - 1] = 1;
    const auto& expected =
        pose == 0 ? source.neutral.positions : source.targets[pose - 1].positions;
    const auto positions = sourcePositions(rig, level1, blend(rig, weights), weights);
    if (positions.size() != expected.size()) return 1e300;
    for (std::size_t v = 0; v < positions.size(); ++v)
      worst = std::max(worst, norm(positions[v] - expected[v]));
  }
  return worst;
}

void expectSmoothJoins(const Rig& rig) {
  for (std::size_t pose = 0; pose <= rig.targets.size(); ++pose) {
    Weights weights(rig.targets.size(), 0);
    if (pose > 0) weights[pose - 1] = 1;
    for (const JoinReport& join : examineJoins(rig.surface, blend(rig, weights)))
      if (join.joinClass == JoinClass::c2) {
        EXPECT_LE(join.secondJump, 1e-9);
      }
  }
}

std::string refusal(const MeshRig& source, const ConvertOptions& options = {}) {
  const auto conversion = convert(source, options);
  return conversion ? "" : conversion.error().message;
}

MeshRig scaled(MeshRig rig, double unit, const Vec3& offset = {}) {
  const auto move = [&](std::vector<Vec3>& positions) {
    for (Vec3& p : positions) p = unit * (p + offset);
  };
  move(rig.neutral.positions);
  for (MeshTarget& t : rig.targets) move(t.positions);
  return rig;
}

class EveryFit : public ::testing::TestWithParam<Face> {
 protected:
  const MeshRig& source() const { return GetParam().rig; }
};
INSTANTIATE_TEST_SUITE_P(Convert, EveryFit, eachFace(), faceName);

TEST_P(EveryFit, meetsTheDefaultToleranceInEveryPose) {
  const auto conversion = convert(source());
  ASSERT_TRUE(conversion) << conversion.error().message;
  EXPECT_DOUBLE_EQ(conversion->rig.tolerance, 0.0002 * diagonal(source().neutral));
  EXPECT_LE(worstDistance(conversion->rig, source()), conversion->rig.tolerance);
  expectSmoothJoins(conversion->rig);
  EXPECT_TRUE(conversion->warnings.empty());
}

TEST_P(EveryFit, meetsALooseToleranceWithNoMoreVectors) {
  ConvertOptions loose;
  loose.tolerance = 0.01 * diagonal(source().neutral);
  const auto rough = convert(source(), loose), fine = convert(source());
  ASSERT_TRUE(rough) << rough.error().message;
  ASSERT_TRUE(fine) << fine.error().message;
  EXPECT_LE(worstDistance(rough->rig, source()), loose.tolerance);
  EXPECT_LE(rough->rig.surface.storedCount(), fine->rig.surface.storedCount());
}

TEST_P(EveryFit, meetsATightTolerance) {
  ConvertOptions tight;
  tight.tolerance = 1e-5 * diagonal(source().neutral);
  const auto conversion = convert(source(), tight);
  ASSERT_TRUE(conversion) << conversion.error().message;
  EXPECT_LE(worstDistance(conversion->rig, source()), tight.tolerance);
}

TEST_P(EveryFit, givesTheSameBytesForAnyNumberOfThreads) {
  std::vector<std::string> bytes;
  for (std::size_t threads : {1u, 4u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto conversion = convert(source());
    ASSERT_TRUE(conversion) << conversion.error().message;
    bytes.push_back(encode(conversion->rig));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST_P(EveryFit, keepsItsToleranceThroughAFile) {
  const auto conversion = convert(source());
  ASSERT_TRUE(conversion) << conversion.error().message;
  const Rig read = decode(encode(conversion->rig), "face").value();
  EXPECT_LE(worstDistance(read, source()), conversion->rig.tolerance);
}

TEST_P(EveryFit, meetsItsToleranceWhateverIsDamaged) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const MeshRig rig = withTargets(damaged(source().neutral, seed), 1);
    ConvertOptions options;
    options.tolerance = seed % 2 ? 0.002 * diagonal(rig.neutral) : 0;
    const auto conversion = convert(rig, options);
    ASSERT_TRUE(conversion) << "seed " << seed << ": " << conversion.error().message;
    EXPECT_LE(worstDistance(conversion->rig, rig), conversion->rig.tolerance) << "seed " << seed;
    expectSmoothJoins(conversion->rig);
  }
}

/// Vectors are single precision, which halves their size in files, and negligible ones are 0.
TEST_P(EveryFit, storesSingleNumbersWithoutTraces) {
  const auto conversion = convert(source());
  ASSERT_TRUE(conversion);
  const Rig& rig = conversion->rig;
  const auto isSingle = [](const Vec3& v) {
    for (const double x : {v.x, v.y, v.z}) {
      const volatile float narrow = static_cast<float>(x);
      if (static_cast<double>(narrow) != x) return false;
    }
    return true;
  };
  EXPECT_TRUE(std::ranges::all_of(rig.neutral, isSingle));
  for (const Target& target : rig.targets) {
    EXPECT_TRUE(std::ranges::all_of(target.difference, isSingle)) << target.name;
    for (const Vec3& v : target.difference)
      EXPECT_TRUE(v == Vec3{} || norm(v) >= 0.00099 * rig.tolerance) << target.name;
  }
}

TEST_P(EveryFit, keepsTheSourcesFaces) {
  const auto conversion = convert(source());
  ASSERT_TRUE(conversion) << conversion.error().message;
  EXPECT_EQ(conversion->rig.source.polygons.corners, source().neutral.polygons.corners);
  EXPECT_EQ(conversion->rig.source.polygons.faceStart, source().neutral.polygons.faceStart);
}

class Units : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Convert, Units, ::testing::Values(1e-6, 1e-3, 1, 1e3, 1e6));

TEST_P(Units, doNotMatter) {
  for (std::size_t k : {0u, 4u, 6u, 11u}) {
    const MeshRig source = scaled(everyFace()[k].rig, GetParam());
    const auto conversion = convert(source);
    ASSERT_TRUE(conversion) << conversion.error().message;
    EXPECT_LE(worstDistance(conversion->rig, source), 0.0002 * diagonal(source.neutral));
    EXPECT_EQ(conversion->rig.surface.patchCount(),
              convert(everyFace()[k].rig)->rig.surface.patchCount());
  }
}

TEST(Convert, givesTheSameBytesOnProcessorsWithOtherCaches) {
  const auto place = [](double x, double y) { return onHill(x / 4, y / 4); };
  const MeshRig source = withTargets(grid(40, 32, place), 3);
  ConvertOptions options;
  options.tolerance = 0.01;
  std::vector<std::string> bytes;
  for (const std::ptrdiff_t first : {16 << 10, 128 << 10}) {
    const CacheSizes sizes(first, 16 * first, 64 * first);
    const auto conversion = convert(source, options);
    ASSERT_TRUE(conversion) << conversion.error().message;
    bytes.push_back(encode(conversion->rig));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(Convert, meetsItsToleranceFarFromTheOrigin) {
  const MeshRig source = scaled(withTargets(cubeSphere()), 1, {1000, -500, 200});
  const auto conversion = convert(source);
  ASSERT_TRUE(conversion) << conversion.error().message;
  EXPECT_LE(worstDistance(conversion->rig, source), conversion->rig.tolerance);
}

TEST(Convert, copesWithASourceThatIsNoSurface) {
  PolygonMesh mesh = plane(6, 6);
  mesh.positions[24] = mesh.positions[25];  // a quad becomes a triangle
  mesh.positions.push_back({3, 3, 9});
  addFace(mesh, {10, 11, 49});  // a fin: three faces at an edge
  addFace(mesh, {0, 1, 1});     // no surface
  const MeshRig source = withTargets(mesh);
  const auto conversion = convert(source);
  ASSERT_TRUE(conversion) << conversion.error().message;
  EXPECT_EQ(conversion->warnings.size(), 2u);
  EXPECT_LE(worstDistance(conversion->rig, source), conversion->rig.tolerance);
}

TEST(Convert, refusesAtOnceWhatSinglePrecisionCannotTell) {
  ConvertOptions options;
  options.tolerance = 0.001;
  MeshRig source = withTargets(cubeSphere());
  const auto far = convert(scaled(source, 1, {0, 0, 1e6}), options);
  ASSERT_FALSE(far);
  EXPECT_NE(far.error().message.find("stands 1e+06 from the origin"), std::string::npos)
      << far.error().message;
  for (Vec3& p : source.targets[0].positions) p = 1e6 * p;
  const auto large = convert(source, options);
  ASSERT_FALSE(large);
  EXPECT_NE(large.error().message.find("moves a vertex by 4.49e+06"), std::string::npos)
      << large.error().message;
}

TEST(Convert, bendsNothingWhereFacesHaveManyCorners) {
  constexpr Index kAround = 12;
  MeshRig rig{cylinder(kAround), {}};
  Loop bottom, top;
  for (Index k = 0; k < kAround; ++k) {
    bottom.insert(bottom.begin(), k);
    top.push_back(static_cast<Index>(rig.neutral.positions.size()) - kAround + k);
  }
  addFace(rig.neutral, bottom);
  addFace(rig.neutral, top);
  const auto converted = convert(rig);
  ASSERT_TRUE(converted);
  EXPECT_LT(normalErrors(converted->rig, rig).rms, 1);
}

/// A bent strip, one quad wide, that ends in a triangle and is flat in one expression.
TEST(Convert, hasNormalsAtTheTipsOfLashes) {
  constexpr Index kLong = 5;
  PolygonMesh lash;
  for (Index k = 0; k < kLong; ++k) {
    for (const double side : {-1.0, 1.0})
      lash.positions.push_back({side * (1 - 0.15 * k), 1.0 * k, 0.08 * k * k});
    if (k > 0) addFace(lash, {2 * k - 2, 2 * k - 1, 2 * k + 1, 2 * k});
  }
  lash.positions.push_back({0, kLong, 0.08 * kLong * kLong});
  addFace(lash, {2 * kLong - 2, 2 * kLong - 1, 2 * kLong});
  MeshRig rig{lash, {{"flat", lash.positions}}};
  for (Vec3& p : rig.targets[0].positions) p.z = 0;
  const auto converted = convert(rig);
  ASSERT_TRUE(converted) << converted.error().message;
  EXPECT_LE(worstDistance(converted->rig, rig), converted->rig.tolerance);
  EXPECT_LT(normalErrors(converted->rig, rig).rms, 3);
}

TEST(Convert, givesLooseVerticesBackExactly) {
  MeshRig source = withTargets(plane(5, 4));
  const Vec3 lonely{1.0 / 3, 1e-7, -123.456789};
  source.neutral.positions.insert(source.neutral.positions.begin() + 3, lonely);
  for (Index& c : source.neutral.polygons.corners) c += c >= 3;
  for (MeshTarget& t : source.targets)
    t.positions.insert(t.positions.begin() + 3, lonely + Vec3{0.5, 0, 0.25});
  ConvertOptions options;
  options.tolerance = 0.01;
  const auto conversion = convert(source, options);
  ASSERT_TRUE(conversion) << conversion.error().message;
  const Rig& rig = conversion->rig;
  const Tessellation level1(rig.surface, 1);
  const Weights rest{0, 0}, one{1, 0};
  EXPECT_EQ(sourcePositions(rig, level1, blend(rig, rest), rest)[3], lonely);
  EXPECT_EQ(sourcePositions(rig, level1, blend(rig, one), one)[3], source.targets[0].positions[3]);
}

TEST(Convert, isAsFineAsItsFacesAreLarge) {
  const MeshRig plain = withTargets(cubeSphere(), 1, 2);
  MeshRig stray = plain;
  for (auto* positions : {&stray.neutral.positions, &stray.targets[0].positions})
    positions->push_back({1e6, 0, 0});  // in no face
  const auto a = convert(plain), b = convert(stray);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->rig.tolerance, b->rig.tolerance);
}

TEST(Convert, ofASingleFaceWorks) {
  for (Index corners : {3, 4, 5, 7}) {
    PolygonMesh mesh;
    Loop face;
    for (Index k = 0; k < corners; ++k) {
      face.push_back(k);
      mesh.positions.push_back(
          {std::cos(turn(1.0 * k / corners)), std::sin(turn(1.0 * k / corners)), 0});
    }
    addFace(mesh, face);
    const MeshRig source = withTargets(mesh, 1, 2);
    const auto conversion = convert(source);
    ASSERT_TRUE(conversion) << corners << " corners: " << conversion.error().message;
    EXPECT_LE(worstDistance(conversion->rig, source), conversion->rig.tolerance);
  }
}

TEST(Progress, risesToItsEnd) {
  const MeshRig& source = everyFace()[3].rig;
  enum class Way { fit, pack, bytes };
  for (const Way way : {Way::fit, Way::pack, Way::bytes}) {
    std::vector<double> heard;
    ConvertOptions options;
    options.pack = way == Way::pack;
    options.progress = [&](std::string_view what, double done) {
      EXPECT_FALSE(what.empty());
      heard.push_back(done);
    };
    ASSERT_TRUE(way == Way::bytes ? convertToBytes(source, options, 2000)
                                  : convert(source, options));
    ASSERT_FALSE(heard.empty());
    EXPECT_TRUE(std::ranges::is_sorted(heard)) << ::testing::PrintToString(heard);
    EXPECT_GE(heard.front(), 0);
    EXPECT_EQ(heard.back(), 1);
    EXPECT_EQ(std::ranges::count(heard, 1), 1);
    if (way == Way::fit) continue;
    // Packing, the slowest step, reports progress as it runs.
    EXPECT_GT(std::ranges::count_if(heard, [](double done) { return done > 0.3 && done < 1; }), 2);
  }
}

TEST(Cancel, endsAConversion) {
  std::atomic<bool> cancel = true;
  ConvertOptions options;
  options.cancel = &cancel;
  EXPECT_EQ(refusal(withTargets(plane()), options), "the conversion was interrupted");
}

TEST(Cancel, isHeardBetweenRounds) {
  std::atomic<bool> cancel = false;
  ConvertOptions options;
  options.cancel = &cancel;
  options.tolerance = 1e-4;
  options.progress = [&](std::string_view, double) { cancel = true; };
  EXPECT_EQ(refusal(withTargets(torus()), options), "the conversion was interrupted");
}

TEST(Cancel, endsTheSearchForATolerance) {
  std::atomic<bool> cancel = false;
  ConvertOptions options;
  options.cancel = &cancel;
  options.progress = [&](std::string_view what, double) {
    cancel = cancel || what == "try 1: done";
  };
  const auto conversion = convertToBytes(withTargets(plane()), options, 1 << 20);
  ASSERT_FALSE(conversion) << "though its first try did fit";
  EXPECT_EQ(conversion.error().message, "the conversion was interrupted");
}

/// Normals far more accurate than the quantisation steps of the tolerance alone would give.
TEST(Packed, normalsComeAsNearAsIsAskedWithFinerSteps) {
  const MeshRig source = withTargets(torus());
  ConvertOptions options;
  options.pack = true;
  options.tolerance = 0.002 * diagonal(source.neutral);
  const auto usual = convert(source, options);
  ASSERT_TRUE(usual) << usual.error().message;
  options.normalTolerance = normalErrors(usual->rig, source).rms / 10;
  std::set<std::string> told;
  options.progress = [&](std::string_view what, double) { told.emplace(what); };
  const auto near = convert(source, options);
  ASSERT_TRUE(near) << near.error().message;
  EXPECT_LE(normalErrors(near->rig, source).rms, options.normalTolerance);
  EXPECT_LT(near->rig.packing.targetStep, usual->rig.packing.targetStep);
  EXPECT_TRUE(std::ranges::any_of(
      told, [](const std::string& what) { return what.starts_with("packing, normals "); }));
}

/// The normals meet their own tolerance with a fine tolerance but not with a coarse one.
TEST(Search, forAToleranceDoesNotEndWhereOneCannotBeMet) {
  ConvertOptions options;
  options.normalTolerance = 2;
  for (const std::size_t most : {1, 200}) {
    const auto conversion = convertToBytes(withTargets(plane()), options, most);
    if (conversion) {
      EXPECT_LE(encode(conversion->rig).size(), most);
    } else {
      EXPECT_TRUE(conversion.error().message.starts_with("the face does not fit into"))
          << conversion.error().message;
    }
  }
}

/// The bytes of a mesh as small as this go up and down with the tolerance.
TEST(Search, forAToleranceFindsWhatFitsMoreWhereLessFits) {
  MeshRig source = withTargets(plane(8, 8), 4);
  for (std::size_t v = 0; v < source.neutral.positions.size(); ++v) {
    const Vec3 bump{0, 0, 0.05 * std::sin(3.7 * static_cast<double>(v * v % 31))};
    source.neutral.positions[v] += bump;
    for (MeshTarget& target : source.targets) target.positions[v] += bump;
  }
  ConvertOptions coarse;
  coarse.pack = true, coarse.tolerance = 0.125 * diagonal(source.neutral);
  const auto coarsest = convert(source, coarse);
  ASSERT_TRUE(coarsest) << coarsest.error().message;
  const std::size_t least = encode(coarsest->rig).size();
  for (std::size_t most = least; most < 3 * least; most += least / 4) {
    const auto conversion = convertToBytes(source, {}, most);
    ASSERT_TRUE(conversion) << most << ": " << conversion.error().message;
    EXPECT_LE(encode(conversion->rig).size(), most);
  }
}

/// The first tolerance leaves the normals too inaccurate.
TEST(Search, forAToleranceGoesOnWithSmallerOnesWhereNormalsAreTooFarOff) {
  const MeshRig source = withTargets(plane());
  ConvertOptions options;
  options.pack = true;
  options.tolerance = 0.0005 * diagonal(source.neutral);
  options.normalTolerance = 0.02;
  EXPECT_TRUE(refusal(source, options).starts_with("normals came no nearer"))
      << refusal(source, options);
  options.tolerance = 0;
  const auto conversion = convertToBytes(source, options, 1 << 20);
  ASSERT_TRUE(conversion) << conversion.error().message;
  EXPECT_LT(conversion->rig.tolerance, 0.0005 * diagonal(source.neutral));
}

TEST(Search, forAToleranceIsDoneWhereTheFinestThatIsWantedFits) {
  ConvertOptions options;
  options.tolerance = 0.05;
  const auto conversion = convertToBytes(withTargets(plane()), options, 1 << 20);
  ASSERT_TRUE(conversion) << conversion.error().message;
  EXPECT_EQ(conversion->rig.tolerance, 0.05);
}

TEST(Search, forAToleranceRefusesWhatConvertRefuses) {
  ConvertOptions options;
  for (const double bad : {-1.0, std::nan("")}) {
    options.tolerance = bad;
    const auto none = convertToBytes(withTargets(plane()), options, 1 << 20);
    ASSERT_FALSE(none) << bad;
    EXPECT_TRUE(none.error().message.starts_with("the tolerance is a number from 0"));
  }
  MeshRig broken = withTargets(plane());
  broken.neutral.polygons.corners[0] = 2'000'000'000;
  const auto none = convertToBytes(broken, {}, 1 << 20);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, refusal(broken, {}));
}

TEST(Search, forAToleranceCountsWhatIsAddedBeforeTheFileIsWritten) {
  const MeshRig source = withTargets(plane());
  const auto finish = [](Rig& rig) -> Result<void> {
    rig.names.units = std::string(100, 'm');
    return {};
  };
  for (const std::size_t most : {600, 1200}) {
    auto conversion = convertToBytes(source, {}, most, finish);
    ASSERT_TRUE(conversion) << conversion.error().message;
    ASSERT_TRUE(finish(conversion->rig));
    EXPECT_LE(encode(conversion->rig).size(), most);
  }
}

TEST(Search, forAToleranceGoesOnWithLargerOnesWhereTheFirstCannotBeMet) {
  MeshRig far = withTargets(plane(4, 4), 0);
  for (Vec3& p : far.neutral.positions) p.x += 1e6 + 1.0 / 3;
  ConvertOptions options;
  options.tolerance = 0.002;
  const std::string why = refusal(far, options);
  EXPECT_TRUE(why.starts_with("the mesh stands 1e+06 from the origin")) << why;
  const auto conversion = convertToBytes(far, options, 1 << 20);
  ASSERT_TRUE(conversion) << conversion.error().message;
  EXPECT_GT(conversion->rig.tolerance, 0.0457);
  options.tolerance = 0;  // also with a tolerance for normals, which is not the cause
  options.normalTolerance = 60;
  const auto nearEnough = convertToBytes(far, options, 1 << 20);
  ASSERT_TRUE(nearEnough) << nearEnough.error().message;
  EXPECT_GT(nearEnough->rig.tolerance, 0.0457);
  options.normalTolerance = 0;
  options.tolerance = 1e-6;
  const auto none = convertToBytes(far, options, 1 << 20);
  ASSERT_FALSE(none);
  EXPECT_TRUE(none.error().message.ends_with("allow a larger tolerance than 1e-06"))
      << none.error().message;
}

TEST(Convert, RefusesMeshesWhoseIndicesDoNotBelongTogether) {
  const MeshRig sound = withTargets(plane(4, 4));
  const auto broken = [&](auto&& change) {
    MeshRig meshes = sound;
    change(meshes, meshes.neutral.polygons);
    return refusal(meshes);
  };
  const auto expect = [&](std::string_view part, auto&& change) {
    const std::string why = broken(change);
    EXPECT_NE(why.find(part), std::string::npos) << why;
  };
  expect("0 vertices, and the neutral", [](auto& m, auto&) { m.targets[1].positions.clear(); });
  expect("vertices, and the neutral", [](auto& m, auto&) { m.targets[0].positions.pop_back(); });
  for (const Index corner : {-3, -1, 99, 100'000'000})
    expect("corner 0 of the mesh is of number", [&](auto&, Polygons& p) { p.corners[0] = corner; });
  for (const std::vector<Index>& start :
       {std::vector<Index>{}, {0, 99}, {1, 64}, {0, 8, 4, 64}, {0}})
    expect("do not divide its corners", [&](auto&, Polygons& p) { p.faceStart = start; });
  expect("among 0 materials", [](auto&, Polygons& p) { p.faceMaterial.assign(16, 5); });
  expect("give one for each", [](auto&, Polygons& p) { p.faceGroup.assign(7, -1); });
  expect("among 0 texture", [](auto&, Polygons& p) { p.cornerTexcoords.assign(64, 3); });
  for (const Index size : {0, 1, 2})
    expect("face 16 of the mesh has " + std::to_string(size), [&](auto&, Polygons& p) {
      for (Index v = 0; v < size; ++v) p.corners.push_back(v);
      p.faceStart.push_back(static_cast<Index>(p.corners.size()));
    });
  for (const Vec2 bad : {Vec2{HUGE_VAL, 0}, Vec2{0, std::nan("")}, Vec2{0, 1e39}})
    expect("texture coordinate 1 of the mesh is not finite",
           [&](auto&, Polygons& p) { p.texcoords = {{0, 0}, bad}; });
  expect("no place that a file", [](auto& m, auto&) { m.neutral.positions[2].y = std::nan(""); });
}

TEST(Convert, RefusesOptionsThatAreNoNumbersFromZero) {
  const MeshRig source = withTargets(plane(4, 4));
  for (const double value : {-1.0, std::nan(""), HUGE_VAL}) {
    for (double ConvertOptions::* option :
         {&ConvertOptions::tolerance, &ConvertOptions::normalLimit,
          &ConvertOptions::normalTolerance}) {
      ConvertOptions options;
      options.*option = value;
      EXPECT_NE(refusal(source, options).find("is a number from 0, not"), std::string::npos);
    }
    Rig rig = convert(source)->rig;
    PackOptions options;
    options.tolerance = value;
    EXPECT_FALSE(pack(rig, options));
  }
}

TEST(Refusal, isASentenceOfWhatIsWrong) {
  MeshRig flat = withTargets(plane(2, 2), 0);
  for (Vec3& p : flat.neutral.positions) p = {1, 2, 3};
  EXPECT_EQ(refusal(flat),
            "all vertices of the neutral stand at one place, as far as numbers tell; there is no "
            "surface to fit");
  MeshRig faceless;
  faceless.neutral.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(refusal(faceless), "the mesh has no face with an area; nothing can be converted");
}

TEST(Refusal, toPackAMeshThatIsFarAwaySaysSo) {
  MeshRig far = withTargets(plane(4, 4));
  for (Vec3& p : far.neutral.positions) p.x += 1e6;
  for (MeshTarget& t : far.targets)
    for (Vec3& p : t.positions) p.x += 1e6;
  ConvertOptions options;
  options.pack = true;
  options.tolerance = 0.05;
  EXPECT_NE(refusal(far, options).find("too far to be packed"), std::string::npos);
  options.pack = false;
  EXPECT_EQ(refusal(far, options), "");
}

TEST(Refusal, ofNormalsOutOfReachSaysHowNearTheyCome) {
  MeshRig source = withTargets(plane(6, 6), 0);
  for (std::size_t v = 0; v < source.neutral.positions.size(); v += 2)
    source.neutral.positions[v].z += 0.5;
  ConvertOptions options;
  options.pack = true;
  options.normalTolerance = 1e-9;
  const std::string why = refusal(source, options);
  double nearest = 0;
  ASSERT_EQ(std::sscanf(why.c_str(), "normals came no nearer to the mesh's than %lf", &nearest), 1)
      << why;
  for (const double times : {1.0, 1.2, 1.7, 3.0}) {
    options.normalTolerance = times * nearest;
    EXPECT_EQ(refusal(source, options), "") << times;
  }
  options.normalTolerance = 0.9 * nearest;
  const std::string again = refusal(source, options);
  EXPECT_TRUE(again.empty() || again == why) << again;
}

TEST(Refusal, ofNamesThatFilesCannotHold) {
  const auto named = [](std::string_view first, std::string_view second) {
    MeshRig rig = withTargets(plane(4, 4));
    rig.targets[0].name = first, rig.targets[1].name = second;
    return refusal(rig);
  };
  EXPECT_EQ(named("r\xC3\xA9sum\xC3\xA9", "\"quoted\""), "");
  EXPECT_EQ(named("a", "sm\xEFle"),
            "the name of the target 'sm?le' has control characters or is not UTF-8; rename it");
  EXPECT_EQ(named("a\nb", "b"),
            "the name of the target 'a?b' has control characters or is not UTF-8; rename it");
  EXPECT_EQ(named("a", ""), "a target has no name; name it");
  EXPECT_EQ(named("a", "a"), "two targets are named 'a'; rename one of them");
  EXPECT_EQ(named(std::string(4096, 'x'), "b"), "");
  EXPECT_TRUE(
      named(std::string(4097, 'x'), "b").ends_with("is longer than 4096 bytes; shorten it"));
}

TEST(Refusal, ofAToleranceBelowTheFilesPrecision) {
  ConvertOptions options;
  options.tolerance = 1e-12;
  EXPECT_EQ(
      refusal(withTargets(plane(4, 4)), options),
      "a tolerance of 1e-12 is finer than a file's numbers, 1.75e-07 for a mesh of this size; "
      "allow a larger one");
  MeshRig far = withTargets(plane(4, 4));
  for (Vec3& p : far.neutral.positions) p.x += 1e6 + 1.0 / 3;
  options.tolerance = 1e-4;
  EXPECT_EQ(refusal(far, options),
            "the mesh stands 1e+06 from the origin, where a file's numbers are off by 0.021; move "
            "it there, or allow a larger tolerance than 0.0001");
}

TEST(Refusal, ofAToleranceThatNoCoordinateButTheirDistanceExceeds) {
  MeshRig far = withTargets(plane(4, 4), 0);
  for (Vec3& p : far.neutral.positions) p += (1e6 + 1.0 / 3) * Vec3{1, 1, 1};
  ConvertOptions options;
  options.tolerance = 0.0313;
  const std::string why = refusal(far, options);
  EXPECT_TRUE(why.starts_with("a tolerance of 0.0313 is out of reach: the surface comes no nearer"))
      << why;
}

// A pole of hundreds of rays in a target that bends it: normals near the mesh's are out of reach.
TEST(ConvertLong, leavesNormalsToThemselvesWhereTheyKeepItFromItsTolerance) {
  MeshRig rig{uvSphere(384, 20, 1), {}};
  MeshTarget bent{"bent", rig.neutral.positions};
  for (Vec3& p : bent.positions) {
    const Vec3 way = p - Vec3{0.1, 0.05, 1};
    p += std::exp(-dot(way, way) / 0.16) * Vec3{0.1, 0.05, 0.1};
  }
  rig.targets.push_back(std::move(bent));
  ConvertOptions options;
  options.tolerance = 0.0007;
  for (const bool packs : {false, true}) {
    options.pack = packs;
    const auto conversion = convert(rig, options);
    ASSERT_TRUE(conversion) << conversion.error().message;
    EXPECT_LE(worstDistance(conversion->rig, rig), 0.0007);
    ASSERT_FALSE(conversion->warnings.empty());
    EXPECT_NE(conversion->warnings.back().find("--normal-limit 180"), std::string::npos);
  }
}

// The large coordinates are single-precision numbers, as those in files often are.
TEST(Convert, takesNumbersThatAFileHoldsFarFromTheOrigin) {
  MeshRig far = withTargets(plane(4, 4), 0);
  for (Vec3& p : far.neutral.positions) p.x = static_cast<float>(p.x + 1e6);
  ConvertOptions options;
  options.tolerance = 0.01;
  const auto conversion = convert(far, options);
  ASSERT_TRUE(conversion) << conversion.error().message;
  EXPECT_LE(worstDistance(conversion->rig, far), 0.01);
}

TEST(Convert, comesNearerToATroughWithShapeParameters) {
  const MeshRig trough{grid(8, 4,
                            [](double i, double j) {
                              return Vec3{i, j,
                                          1 - std::cosh(14.1 * (i / 8 - 0.5)) / std::cosh(7.05)};
                            }),
                       {}};
  ConvertOptions options;
  options.tolerance = 0.02;
  options.normalLimit = 180;
  const auto rms = [&](bool chooseShapes) {
    options.chooseShapes = chooseShapes;
    return measure(convert(trough, options).value().rig, trough, {.facets = false})
        ->worst.distance.rms;
  };
  EXPECT_LT(rms(true), 0.9 * rms(false));
}

TEST(Refusal, ofAToleranceBeyondTheMesh) {
  ConvertOptions options;
  options.tolerance = 6;
  const MeshRig square{grid(3, 4, [](double x, double y) { return Vec3{x, y, 0}; }), {}};
  EXPECT_EQ(refusal(square, options),
            "a tolerance of 6 is larger than the mesh, which is 5 across; ask for a finer one");
}

TEST(Refusal, ofDifferencesBeyondSinglePrecision) {
  MeshRig rig = withTargets(plane(4, 4), 1);
  rig.neutral.positions[3].z = 3e38, rig.targets[0].positions[3].z = -3e38;
  EXPECT_EQ(refusal(rig),
            "vertex 3 of the target '" + rig.targets[0].name +
                "' is further from the neutral's than a file can tell; scale the meshes down");
}

// Single-precision numbers, so that nothing is lost but what lies beyond all of them.
TEST(Convert, givesFiniteVectorsOrNone) {
  const auto jagged = [](float height) {
    MeshRig rig{grid(4, 4, [](double x, double y) { return Vec3{x, y, 0}; }), {}};
    rig.targets = {{"jagged", rig.neutral.positions}};
    for (std::size_t v = 0; v < rig.neutral.positions.size(); ++v)
      rig.targets[0].positions[v].z = v % 2 ? height : -height;
    return rig;
  };
  EXPECT_NE(refusal(jagged(3e38f)).find("is out of reach"), std::string::npos);
  const auto conversion = convert(jagged(1e37f));
  ASSERT_TRUE(conversion) << conversion.error().message;
  for (const Vec3& difference : conversion->rig.targets[0].difference)
    EXPECT_LT(norm(difference), std::numeric_limits<float>::max());
}

TEST(Diagonal, spansTheBoundingBox) {
  EXPECT_DOUBLE_EQ(diagonal(grid(3, 4, [](double x, double y) { return Vec3{x, y, 0}; })), 5);
}

// Supporting edge loops: one row of faces is a fiftieth as wide as its neighbours.
TEST(ThinRows, DoNotBendWhatIsBesideThem) {
  const MeshRig sheet{grid(20, 20,
                           [](double i, double j) {
                             const double x = -1 + 0.1 * i, y = j == 11 ? 0.002 : 0.12 * (j - 10);
                             return Vec3{x, y, 0.64 * std::cos(1.2 * x) * std::cos(0.9 * y)};
                           }),
                      {}};
  const MeshRig ring{grid(
                         24, 16,
                         [](double i, double j) {
                           constexpr double step = std::numbers::pi / 12;
                           const double u = i == 5 ? 4 * step + 0.005 : step * i;
                           const double v = std::numbers::pi / 8 * j, r = 1 + 0.35 * std::cos(v);
                           return Vec3{r * std::cos(u), r * std::sin(u), 0.35 * std::sin(v)};
                         },
                         true, true),
                     {}};
  for (const MeshRig* source : {&sheet, &ring})
    for (const bool pack : {false, true}) {
      ConvertOptions options;
      options.pack = pack;
      const auto conversion = convert(*source, options);
      ASSERT_TRUE(conversion) << conversion.error().message;
      const auto found = measure(conversion->rig, *source);
      ASSERT_TRUE(found) << found.error().message;
      EXPECT_LT(found->worst.angle.rms, 1.5) << pack;
      EXPECT_LT(found->worst.facetExcess, 0.01) << pack;
    }
}

// Closing lids and lips: a row of faces is a fiftieth as wide as in the neutral, whose rows are
// even.
TEST(ThinRows, OfATargetDoNotFoldOver) {
  const auto sheet = [](double row) {
    return grid(10, 10, [=](double x, double y) {
      return Vec3{x, y < 6 ? y : y - 1 + row, 0.3 * std::sin(0.8 * x) * std::cos(0.7 * y)};
    });
  };
  const MeshRig source{sheet(1), {{"squash", sheet(0.02).positions}}};
  for (const bool pack : {false, true}) {
    ConvertOptions options;
    options.pack = pack;
    options.tolerance = 0.005;
    const auto conversion = convert(source, options);
    ASSERT_TRUE(conversion) << conversion.error().message;
    EXPECT_EQ(countFolds(conversion->rig, source), (std::vector<Index>{0, 0})) << pack;
  }
}

}  // namespace
}  // namespace sweepface
