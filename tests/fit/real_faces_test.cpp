#include <tbb/global_control.h>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/io.hpp"
#include "sweepface/measure.hpp"
#include "sweepface/strip.hpp"
#include "sweepface/subdivision.hpp"

#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

Result<MeshRig> faceIn(const std::filesystem::path& folder, bool expressions) {
  std::vector<std::filesystem::path> targets;
  if (expressions) targets.push_back(folder / "expressions");
  return readRig(folder / "neutral.obj", targets);
}
// The full face with eyes, teeth, gums and lashes: 26 719 vertices in centimetres, 57 expressions.
Result<MeshRig> everything() {
  return faceIn(std::filesystem::path(realFaces()) / "ictface", true);
}
// Its skin alone: a head of 11 248 vertices.
Result<MeshRig> head(bool expressions) {
  return faceIn(std::filesystem::path(realFaces()) / "ictface" / "head", expressions);
}

double largestSecondJump(const Rig& rig, const Weights& weights) {
  double worst = 0;
  for (const JoinReport& join : examineJoins(rig.surface, blend(rig, weights)))
    if (join.joinClass == JoinClass::c2) worst = std::max(worst, join.secondJump);
  return worst;
}

TEST(RealFaceLong, aNeutralHeadNeedsAFifthOfItsVertices) {
  SKIP_WITHOUT_REAL_FACES();
  const auto source = head(false);
  ASSERT_TRUE(source) << source.error().message;
  ConvertOptions options;
  options.tolerance = 0.095;
  const auto conversion = convert(*source, options);
  ASSERT_TRUE(conversion) << conversion.error().message;
  const auto vertices = static_cast<double>(source->neutral.positions.size());
  EXPECT_EQ(vertices, 11248);
  EXPECT_LE(conversion->rig.surface.storedCount(), 0.2 * vertices);
  EXPECT_LE(measure(conversion->rig, *source)->worst.distance.max, options.tolerance);
  EXPECT_LE(largestSecondJump(conversion->rig, {}), 1e-9);
}

TEST(RealFaceLong, aHeadHasTheSameBytesForAnyNumberOfThreads) {
  SKIP_WITHOUT_REAL_FACES();
  const auto source = head(false);
  ASSERT_TRUE(source) << source.error().message;
  std::vector<std::string> bytes;
  for (std::size_t threads : {1u, 4u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ConvertOptions options;
    options.tolerance = 0.05;
    bytes.push_back(encode(convert(*source, options).value().rig));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(RealFaceLong, aHeadAndItsExpressionsStayWithinTheirTolerance) {
  SKIP_WITHOUT_REAL_FACES();
  const auto source = head(true);
  ASSERT_TRUE(source) << source.error().message;
  ASSERT_EQ(source->targets.size(), 57u);
  ConvertOptions options;
  options.tolerance = 0.02;
  const auto conversion = convert(*source, options);
  ASSERT_TRUE(conversion) << conversion.error().message;
  const auto m = measure(conversion->rig, *source);
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_LE(m->worst.distance.max, options.tolerance);
  EXPECT_LE(m->worst.angle.rms, 1);
  EXPECT_LE(m->worst.angle.p999, 6);
  for (std::size_t k = 0; k <= source->targets.size(); k += 8) {
    Weights weights(source->targets.size(), 0);
    if (k > 0) weights[k - 1] = 1;
    EXPECT_LE(largestSecondJump(conversion->rig, weights), 1e-9);
  }
}

// MakeHuman's base mesh is a cage: a surface through its vertices folds over in 300 places.
TEST(RealFaceLong, theLimitOfACageHardlyFolds) {
  SKIP_WITHOUT_REAL_FACES();
  const auto cage = faceIn(std::filesystem::path(realFaces()) / "makehuman", true);
  ASSERT_TRUE(cage) << cage.error().message;
  const auto subdivided = subdivide(*cage, 1);
  ASSERT_TRUE(subdivided) << subdivided.error().message;
  const MeshRig& limit = subdivided->rig;
  const auto conversion = convert(limit);
  ASSERT_TRUE(conversion) << conversion.error().message;
  EXPECT_TRUE(conversion->warnings.empty());
  EXPECT_LE(conversion->rig.surface.storedCount(), limit.neutral.positions.size() / 2);
  const auto m = measure(conversion->rig, limit);
  ASSERT_TRUE(m) << m.error().message;
  int folds = 0;
  for (const PoseErrors& shape : m->shapes) folds += shape.folds;
  EXPECT_LE(folds, 5);
}

// A face packed within 0.2 mm and read back, its measurement, and its size in bytes with and
// without order and texture. Packing may use up the tolerance but must not spoil the surface
// between the vertices.
struct Packed {
  Rig read;
  Measurement measured;
  std::size_t bytes = 0, bare = 0;
};
void pack(const Result<MeshRig>& source, Packed& packed) {
  ASSERT_TRUE(source) << source.error().message;
  ConvertOptions options;
  options.tolerance = 0.02;
  options.pack = true;
  auto conversion = convert(*source, options);
  ASSERT_TRUE(conversion) << conversion.error().message;
  auto read = decode(encode(conversion->rig), "face");
  ASSERT_TRUE(read) << read.error().message;
  const auto m = measure(*read, *source);
  ASSERT_TRUE(m) << m.error().message;
  EXPECT_LE(m->worst.distance.max, options.tolerance);
  EXPECT_LE(m->worst.angle.rms, 1.6);
  EXPECT_LE(m->worst.angle.p99, 5.5);
  packed = {std::move(*read), *m, 0, 0};
  packed.bytes = encode(packed.read).size();
  ASSERT_TRUE(strip(conversion->rig, {true, true, false, false}));
  packed.bare = encode(conversion->rig).size();
}

TEST(RealFaceLong, aPackedHeadIsSmallAndFoldsNowhere) {
  SKIP_WITHOUT_REAL_FACES();
  Packed packed;
  ASSERT_NO_FATAL_FAILURE(pack(head(true), packed));
  EXPECT_EQ(packed.measured.worst.folds, 0);
  EXPECT_LE(packed.read.surface.storedCount(), 0.71 * 11248);
  EXPECT_LE(packed.bytes, 37'000u);
  EXPECT_LE(packed.bare, 20'480u);
}

// Teeth and gums follow the jaw, sheets touch, and the eye sockets differ.
TEST(RealFaceLong, aPackedFaceWithAllItsPartsIsSmall) {
  SKIP_WITHOUT_REAL_FACES();
  Packed packed;
  ASSERT_NO_FATAL_FAILURE(pack(everything(), packed));
  EXPECT_FALSE(packed.read.packing.bones.empty());
  EXPECT_LE(packed.bare, 49'152u);
}

}  // namespace
}  // namespace sweepface
