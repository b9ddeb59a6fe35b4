#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

constexpr double kCentimetre = 0.01;

/// Where a point of a face in centimetres, with z up, is in metres with y up.
Vec3 inMetres(const Vec3& p) { return kCentimetre * Vec3{p.x, p.z, -p.y}; }

/// A face of a plane that came without a scene.
Rig sceneless() { return convert(withTargets(plane())).value().rig; }

GlbOptions standing() { return {.metersPerUnit = kCentimetre, .zUp = true}; }

std::vector<Vec3> inMetres(std::vector<Vec3> positions) {
  for (Vec3& p : positions) p = inMetres(p);
  return positions;
}

TEST(Standing, AFaceWithoutASceneIsInMetresWithYUp) {
  const Rig rig = sceneless();
  const MeshRig asItIs = parseGltf(formatGlb(rig, {}).value(), "as it is.glb", {}).value().rig;
  for (const bool quantized : {false, true}) {
    GlbOptions options = standing();
    options.quantize = quantized;
    const auto glb = parseGltf(formatGlb(rig, options).value(), "face.glb", {});
    ASSERT_TRUE(glb) << glb.error().message;
    const double within = kCentimetre * (quantized ? 1e-3 : 1e-5);
    testing::expectNear(glb->rig.neutral.positions, inMetres(asItIs.neutral.positions), within);
    for (std::size_t k = 0; k < rig.targets.size(); ++k)
      testing::expectNear(glb->rig.targets[k].positions, inMetres(asItIs.targets[k].positions),
                          within);
  }
}

TEST(Standing, TheHeadTurnsAboutThePointThatItIsGiven) {
  GlbOptions options = standing();
  const HeadTrack head{{0, 1}, {{0, 0, 0, 1}, {0, 1, 0, 0}}, {1, 2, 3}};
  options.head = &head;
  const Written glb(formatGlb(sceneless(), options).value());
  const Json& track = glb.json["animations"][0]["channels"][0]["target"];
  const Json& place = glb.json["nodes"][track["node"].get<std::size_t>()]["translation"];
  const Vec3 expected = inMetres(head.pivot);
  EXPECT_EQ(place, Json({expected.x, expected.y, expected.z}));
}

TEST(Standing, ScenesAreInMetresAlready) {
  const Rig rig = converted(smallFace());
  GlbOptions options;
  for (const double unit : {0.0, 1.0}) {
    options.metersPerUnit = unit;
    options.zUp = unit == 0;
    const auto refused = formatGlb(rig, options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(
        refused.error().message,
        "The scene that the face came with is in metres, with y up; leave metres a unit and z "
        "up out.");
  }
}

TEST(Standing, UnitsAreOfAPlausibleLength) {
  for (const double unit : {std::nan(""), -1.0, 1e-10, 1e10}) {
    const auto refused = formatGlb(sceneless(), {.metersPerUnit = unit});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              "Metres a unit are between 1e-9 and 1e9, or 0 for what is usual.");
  }
}

}  // namespace
}  // namespace sweepface
