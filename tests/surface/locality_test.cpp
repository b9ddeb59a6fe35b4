#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

bool same(const Surface& a, const std::vector<Vec3>& x, const Surface& b,
          const std::vector<Vec3>& y, Index patch) {
  return std::ranges::all_of(sitesOf(a, patch),
                             [&](const Site& s) { return a.evaluate(x, s) == b.evaluate(y, s); });
}

// At irregular nodes, factors of a chart that should cancel leave rounding residues: their patches
// count as owners, but do not move.
bool isIrregular(const Surface& surface) {
  return std::ranges::count(surface.connectivity().kinds, NodeKind::irregular) > 0;
}

TEST(Owners, areThePatchesThatAStoredVectorMoves) {
  for (const auto& [name, surface] : everySurface()) {
    SCOPED_TRACE(name);
    const auto before = anyPose(surface);
    for (Index v = 0; v < surface.storedCount(); v += 1 + surface.storedCount() / 40) {
      auto after = before;
      after[v] += {0.5, -1, 2};
      surface.settle({after.data(), static_cast<std::size_t>(surface.storedCount())}, after);
      std::vector<Index> moved;
      for (Index p = 0; p < surface.patchCount(); ++p)
        if (!same(surface, before, surface, after, p)) moved.push_back(p);
      const auto owners = surface.owners(v);
      EXPECT_TRUE(std::ranges::includes(owners, moved)) << "vector " << v;
      if (!isIrregular(surface)) {
        EXPECT_EQ(owners, moved) << "vector " << v;
      }
    }
  }
}

std::set<Index> patchesOn(const Surface& surface, Index ribbon) {
  std::set<Index> result;
  for (Index p = 0; p < surface.patchCount(); ++p)
    for (int s = 0; s < 4; ++s)
      for (HalfArc h : surface.wireframe().side(p, s))
        if (surface.wireframe().arcs[arcOf(h)].ribbon == ribbon) result.insert(p);
  return result;
}

std::set<Index> changedByRibbon(const Surface& surface, const std::vector<Vec3>& pose,
                                Index ribbon) {
  Wireframe edited = surface.wireframe();
  edited.ribbons[ribbon] = {1, -2, 0.5};
  const Surface other = Surface::make(edited).value();
  EXPECT_EQ(other.storedCount(), surface.storedCount());
  std::vector<Vec3> moved(other.vectorCount());
  other.settle({pose.data(), static_cast<std::size_t>(surface.storedCount())}, moved);
  std::set<Index> changed;
  for (Index p = 0; p < surface.patchCount(); ++p)
    if (!same(surface, pose, other, moved, p)) changed.insert(p);
  return changed;
}

bool hasTNodes(const Surface& surface) {
  return std::ranges::count(surface.connectivity().kinds, NodeKind::hanging) > 0;
}

// Only through T-nodes on its rails does a ribbon affect more than its own patches.
TEST(Ribbons, areEditedWithoutTouchingOtherPatches) {
  int examined = 0;
  for (const auto& [name, surface] : everySurface()) {
    if (hasTNodes(surface)) continue;
    SCOPED_TRACE(name);
    const auto pose = anyPose(surface);
    for (Index r = 0; r < static_cast<Index>(surface.wireframe().ribbons.size()); ++r, ++examined) {
      const auto changed = changedByRibbon(surface, pose, r);
      EXPECT_TRUE(std::ranges::includes(patchesOn(surface, r), changed)) << "ribbon " << r;
      EXPECT_FALSE(changed.empty()) << "ribbon " << r;
    }
  }
  EXPECT_GT(examined, 20);
}

TEST(Ribbons, ofARailMoveItsTNodesPatchesToo) {
  int further = 0;
  for (const auto& [name, surface] : everySurface()) {
    if (!hasTNodes(surface)) continue;
    const auto pose = anyPose(surface);
    for (Index r = 0; r < static_cast<Index>(surface.wireframe().ribbons.size()); ++r)
      further += !std::ranges::includes(patchesOn(surface, r), changedByRibbon(surface, pose, r));
  }
  EXPECT_GE(further, 4);
}

TEST(Ribbons, keepTheJoinsSmoothWhenEdited) {
  for (const auto& [name, surface] : everySurface()) {
    SCOPED_TRACE(name);
    Wireframe edited = surface.wireframe();
    for (std::size_t r = 0; r < edited.ribbons.size(); ++r)
      edited.ribbons[r] = {1, -0.7 * static_cast<double>(r % 5), 0.3 * static_cast<double>(r % 3)};
    const Surface other = Surface::make(edited).value();
    for (const JoinReport& join : examineJoins(other, anyPose(other))) {
      EXPECT_LT(join.positionGap, 1e-10);
      if (join.joinClass == JoinClass::c2) {
        EXPECT_LE(join.secondJump, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace sweepface
