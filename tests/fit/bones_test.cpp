#include "fit/bones.hpp"

#include <gtest/gtest.h>

#include "sweepface/fit.hpp"

#include "codec/bones.hpp"
#include "faces.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

constexpr double kTolerance = 0.01;

// A hill with a wavy sheet above it that stands for teeth; each target moves the sheet alone.
MeshRig hillAndSheet(const std::vector<std::function<Vec3(const Vec3&)>>& moves) {
  const PolygonMesh hill = plane(),
                    sheet = grid(8, 6, [](double i, double j) {
                      return Vec3{0.3 * i, 0.3 * j, 5 + 0.2 * std::sin(i) * std::cos(j)};
                    });
  MeshRig rig{joined(hill, sheet, {}), {}};
  for (const auto& move : moves) {
    MeshTarget target{"t" + std::to_string(rig.targets.size()), rig.neutral.positions};
    for (std::size_t v = hill.positions.size(); v < target.positions.size(); ++v)
      target.positions[v] = move(target.positions[v]);
    rig.targets.push_back(std::move(target));
  }
  return rig;
}

Vec3 turned(const Vec3& p, double angle) {
  return {std::cos(angle) * p.x - std::sin(angle) * p.y,
          std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
}
Vec3 bent(const Vec3& p) { return {p.x, p.y, p.z + 0.4 * p.x * p.x}; }

Rig packedRig(const MeshRig& source) {
  ConvertOptions options;
  options.tolerance = kTolerance;
  options.pack = true;
  return convert(source, options).value().rig;
}

// The largest distance between a bone's positions as carried and where the target puts them.
double farthest(const Rig& rig, Index target) {
  const codec::Bones bones(rig.surface, rig.packing, rig.neutral);
  const auto left =
      bones.beyond(rig.packing.poses[target + 1].carries, rig.targets[target].difference);
  double most = 0;
  for (Index v = 0; v < rig.surface.storedCount(); ++v)
    if (rig.packing.bones[v] >= 0 && rig.surface.stored(v).i + rig.surface.stored(v).j == 0)
      most = std::max(most, norm(left[v]));
  return most;
}

TEST(Bones, CarryWhatTurnsAsAWhole) {
  const Rig rig = packedRig(hillAndSheet({[](const Vec3& p) { return turned(p, 0.4); },
                                          [](const Vec3& p) { return turned(p, -0.2); }}));
  ASSERT_EQ(rig.packing.bones.size(), rig.neutral.size());
  for (Index v = 0; v < rig.surface.storedCount(); ++v)
    if (rig.surface.stored(v).i + rig.surface.stored(v).j == 0) {
      const bool above = rig.neutral[v].z > 4;
      EXPECT_EQ(rig.packing.bones[v], above ? 0 : -1);
    }
  for (const Index target : {0, 1}) {
    EXPECT_EQ(rig.packing.poses[target + 1].carries.size(), 1u);
    EXPECT_LT(farthest(rig, target), 2 * kTolerance);
  }
}

TEST(Bones, CarryOneTargetAndLeaveTheNextWhereItBends) {
  const Rig rig = packedRig(hillAndSheet({[](const Vec3& p) { return turned(p, 0.4); }, bent}));
  EXPECT_EQ(rig.packing.poses[1].carries.size(), 1u);
  EXPECT_TRUE(rig.packing.poses[2].carries.empty());
}

TEST(Bones, AreNoneWhereNothingMovesAsAWholeOrIsWorthIt) {
  EXPECT_TRUE(packedRig(hillAndSheet({bent})).packing.bones.empty());
  EXPECT_TRUE(packedRig(hillAndSheet({[](const Vec3& p) { return p; }})).packing.bones.empty());
}

}  // namespace
}  // namespace sweepface
