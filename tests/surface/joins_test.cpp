#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

// For any stored vectors: patches share what lies on their joins, so they cannot separate.
TEST(Joins, areC2ForAnyPoseOfAnyLayout) {
  int smooth = 0, onTNodes = 0;
  for (const auto& [name, surface] : everySurface()) {
    SCOPED_TRACE(name);
    const auto pose = anyPose(surface);
    const auto reports = examineJoins(surface, pose, 9);
    for (Index a = 0; a < static_cast<Index>(reports.size()); ++a) {
      const JoinReport& join = reports[a];
      EXPECT_LT(join.positionGap, 1e-11 * largest(pose)) << "arc " << a;
      if (join.joinClass != JoinClass::c2) continue;
      ++smooth;
      const Arc& arc = surface.wireframe().arcs[a];
      for (Index node : {arc.from, arc.to})
        onTNodes += surface.connectivity().kinds[node] == NodeKind::hanging;
      EXPECT_LE(join.firstJump, 1e-9) << "arc " << a;
      EXPECT_LE(join.secondJump, 1e-9) << "arc " << a;
    }
  }
  EXPECT_GT(smooth, 200);
  EXPECT_GT(onTNodes, 50);
}

TEST(Joins, knowTheirClass) {
  const Surface two = Surface::make(twoPatches()).value();
  for (Index a = 0; a < 7; ++a)
    EXPECT_EQ(joinClass(two, a), a == 5 ? JoinClass::c2 : JoinClass::boundary);
  const Surface cube = surfaceOf(MeshRig{cubeSphere(2), {}});
  for (Index a = 0; a < 12; ++a) EXPECT_EQ(joinClass(cube, a), JoinClass::spoke);
  const Surface umbrella = Surface::make(fan(5)).value();
  for (Index a = 1; a < 15; a += 3) EXPECT_EQ(joinClass(umbrella, a), JoinClass::c2);  // its rays
}

TEST(Joins, measureJumpsAsSharesWhateverTheSize) {
  const Surface cube = surfaceOf(MeshRig{cubeSphere(4), {}});
  auto pose = anyPose(cube);
  const auto small = examineJoins(cube, pose, 5);
  for (Vec3& v : pose) v = 1000 * v;
  const auto large = examineJoins(cube, pose, 5);
  double most = 0;
  for (std::size_t a = 0; a < small.size(); ++a) {
    EXPECT_NEAR(large[a].firstJump, small[a].firstJump, 1e-9);
    EXPECT_NEAR(large[a].secondJump, small[a].secondJump, 1e-9);
    most = std::max(most, small[a].secondJump);
  }
  EXPECT_GT(most, 1e-3);
}

TEST(Joins, countTowardsTheMeanByTheirLength) {
  JoinSummary sum;
  JoinReport bent, flat;
  bent.length = 4, bent.normalJump = 3;
  flat.length = 5;
  sum.add(bent);
  sum.add(flat);
  EXPECT_DOUBLE_EQ(sum.normalRms(), 2);
}

TEST(Joins, aSpokeIsC2AtItsEndsInItsNodesChart) {
  const Surface cube = surfaceOf(MeshRig{cubeSphere(4), {}});
  const auto pose = anyPose(cube);
  for (const JoinReport& ends : examineJoins(cube, pose, 2)) EXPECT_LT(ends.normalJump, 1e-5);
}

TEST(Joins, measureTheLengthOfAnArc) {
  Wireframe w = onePatch(3, 2);
  const Surface surface = Surface::make(w).value();
  std::vector<Vec3> pose(surface.vectorCount());
  for (Index v = 0; v < surface.storedCount(); ++v) {
    const StoredVector& s = surface.stored(v);
    if (s.i + s.j > 0) continue;
    pose[v] = {s.node == 1 || s.node == 2 ? 3.0 : 0.0, s.node >= 2 ? 2.0 : 0.0, 0};
  }
  surface.settle({pose.data(), static_cast<std::size_t>(surface.storedCount())}, pose);
  const auto reports = examineJoins(surface, pose);
  EXPECT_NEAR(reports[0].length, 3, 1e-12);
  EXPECT_NEAR(reports[1].length, 2, 1e-12);
}

}  // namespace
}  // namespace sweepface
