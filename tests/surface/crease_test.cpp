#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// `sectors` patches around node 0, which lies on a boundary.
Wireframe halfWheel(Index sectors, const std::set<Index>& creases) {
  Wireframe w = wheel(sectors + 1, creases);
  w.patches.pop_back();
  w.loops.resize(w.loops.size() - 4);
  const Index corner = 2 * (sectors + 1);  // only the last patch had this node
  w.nodes.resize(corner);
  w.points = corner;
  w.arcs.resize(3 * sectors + 1);
  return w;
}

struct Case {
  bool closed = true;
  Index valence;
  std::set<Index> creases;
  friend void PrintTo(const Case& c, std::ostream* out) {
    *out << (c.closed ? "closed " : "open ") << c.valence << " with " << c.creases.size();
  }
  Surface make() const {
    return Surface::make(closed ? wheel(valence, creases) : halfWheel(valence, creases)).value();
  }
};

class Creases : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Fans, Creases,
    ::testing::Values(Case{true, 2, {0, 1}}, Case{true, 3, {0, 1, 2}}, Case{true, 3, {1, 2}},
                      Case{true, 4, {0, 2}}, Case{true, 4, {1, 3}}, Case{true, 4, {0, 1}},
                      Case{true, 4, {0, 1, 2}}, Case{true, 4, {0, 1, 2, 3}}, Case{true, 5, {0, 2}},
                      Case{true, 5, {0, 1}}, Case{true, 5, {0, 1, 3}}, Case{true, 6, {0, 3}},
                      Case{true, 6, {0, 2, 4}}, Case{true, 6, {1, 3}}, Case{true, 9, {0, 3, 6}},
                      Case{true, 9, {0, 2, 4, 6}}, Case{true, 7, {0, 3}}, Case{false, 2, {1}},
                      Case{false, 3, {1}}, Case{false, 4, {2}}, Case{false, 5, {2}},
                      Case{false, 6, {1, 4}}, Case{false, 6, {3}}, Case{false, 3, {1, 2}}));

// For any stored vectors: there are no gaps, arcs that are not creases stay as smooth as they were,
// and the normal breaks at creases.
TEST_P(Creases, breakTheNormalAndNothingElse) {
  const Case c = GetParam();
  const Surface surface = c.make();
  ASSERT_EQ(surface.connectivity().kinds[0], NodeKind::creased);
  EXPECT_EQ(surface.connectivity().fans[0].size(), c.creases.size() + !c.closed);
  const auto pose = anyPose(surface);
  const auto joins = examineJoins(surface, pose, 7);
  for (Index a = 0; a < static_cast<Index>(joins.size()); ++a) {
    EXPECT_LT(joins[a].positionGap, 1e-11 * largest(pose)) << "arc " << a;
    const bool isCrease = surface.wireframe().arcs[a].crease;
    EXPECT_EQ(joins[a].joinClass == JoinClass::crease, isCrease) << "arc " << a;
    if (isCrease) {
      EXPECT_GT(joins[a].firstJump, 0.01) << "arc " << a;
      EXPECT_GT(joins[a].normalJump, 0.01) << "arc " << a;
    }
    if (joins[a].joinClass == JoinClass::c2) {
      EXPECT_LE(joins[a].firstJump, 1e-9) << "arc " << a;
      EXPECT_LE(joins[a].secondJump, 1e-9) << "arc " << a;
    }
  }
}

// All sectors of a fan share one tangent plane at the node.
TEST_P(Creases, leaveEveryFanSmoothAtTheNode) {
  const Surface surface = GetParam().make();
  const auto pose = anyPose(surface);
  const Connectivity& c = surface.connectivity();
  const Star& star = c.stars[0];
  for (const Fan& fan : c.fans[0]) {
    std::vector<Vec3> normals;
    for (int k = 0; k < fan.sectors; ++k) {
      const Index corner =
          star.sectors[static_cast<std::size_t>(fan.first + k) % star.sectors.size()];
      const auto along = [&](int i, int j) {
        const JetRef ref = surface.cornerJet(corner / 4, corner % 4, i, j);
        return ref.sign * pose[ref.vector];
      };
      normals.push_back(normalized(cross(along(1, 0), along(0, 1))));
    }
    for (const Vec3& n : normals) EXPECT_LT(norm(n - normals[0]), 1e-9);
  }
}

TEST_P(Creases, moveWithTheirPositions) {
  const Surface surface = GetParam().make();
  std::vector<Vec3> pose(surface.vectorCount());
  for (Index v = 0; v < surface.storedCount(); ++v)
    if (surface.stored(v).i + surface.stored(v).j == 0) pose[v] = {1, -2, 3};
  surface.settle({pose.data(), static_cast<std::size_t>(surface.storedCount())}, pose);
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (const Site& site : sitesOf(surface, p))
      EXPECT_LT(norm(surface.evaluate(pose, site) - Vec3{1, -2, 3}), 1e-12);
}

Index storedAtCentre(const Wireframe& w) {
  const Surface surface = Surface::make(w).value();
  Index count = 0;
  for (Index v = 0; v < surface.storedCount(); ++v) count += surface.stored(v).node == 0;
  return count;
}

TEST(CreasedNodes, storeWhatTheirFansShareOnce) {
  // The position, two derivatives along the common line, six vectors on either side of it.
  EXPECT_EQ(storedAtCentre(wheel(4, {0, 2})), 1 + 2 + 2 * 6);
  // The position, two derivatives along each arm, four mixed ones in each sector.
  EXPECT_EQ(storedAtCentre(wheel(3, {0, 1, 2})), 1 + 3 * 2 + 3 * 4);
  EXPECT_EQ(storedAtCentre(wheel(4, {0, 1, 2, 3})), 1 + 4 * 2 + 4 * 4);
  // The position, a chart of five vectors on one side, four for the single sector on the other.
  EXPECT_EQ(storedAtCentre(wheel(5, {0, 1})), 1 + 5 + 4);
}

TEST(CreaseEnds, areSmooth) {
  // A single crease ends smoothly at an inner node: alone it does not cut the node's star.
  const Surface surface = Surface::make(wheel(4, {0})).value();
  EXPECT_EQ(surface.connectivity().kinds[0], NodeKind::crossing);
  EXPECT_EQ(surface.connectivity().kinds[1], NodeKind::creased);  // one is enough on a boundary
  const auto joins = examineJoins(surface, anyPose(surface), 2);
  EXPECT_EQ(joins[0].joinClass, JoinClass::crease);
}

TEST(CreaseEnds, mayNotLieAlongATNode) {
  Wireframe w = tee();
  w.arcs[1].crease = true;
  EXPECT_EQ(Surface::make(w).error().message,
            "node 3 hangs on a crease; run its arc on, or end the crease");
  w.arcs[1].crease = false;
  w.arcs[8].crease = true;  // the stem may be a crease
  EXPECT_TRUE(Surface::make(w));
  Wireframe collapsed = slice();
  collapsed.arcs[3].crease = true;
  EXPECT_EQ(Surface::make(collapsed).error().message, "arc 3 is one point and cannot be a crease");
}

// Random creases wherever arcs allow them, on surfaces of every kind.
TEST(AnyCreases, leaveNoGap) {
  int made = 0, creased = 0;
  std::mt19937 random(7);
  for (const auto& [name, smooth] : everySurface())
    for (int round = 0; round < 4; ++round) {
      SCOPED_TRACE(name);
      Wireframe w = smooth.wireframe();
      const Connectivity& c = smooth.connectivity();
      for (Arc& a : w.arcs) a.crease = !a.collapsed && random() % (2u << round) == 0;
      for (std::size_t n = 0; n < w.nodes.size(); ++n)
        if (c.kinds[n] == NodeKind::hanging)
          for (HalfArc h : c.stars[n].arms) w.arcs[arcOf(h)].crease = false;
      const auto surface = Surface::make(w);
      if (!surface) continue;
      ++made;
      const auto pose = anyPose(*surface);
      for (const JoinReport& join : examineJoins(*surface, pose, 5)) {
        EXPECT_LT(join.positionGap, 1e-10 * largest(pose));
        creased += join.joinClass == JoinClass::crease;
        if (join.joinClass == JoinClass::c2) {
          EXPECT_LE(join.secondJump, 1e-8);
        }
      }
    }
  EXPECT_GT(made, 60);
  EXPECT_GT(creased, 100);
}

}  // namespace
}  // namespace sweepface
