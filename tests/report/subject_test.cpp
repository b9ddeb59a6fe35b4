#include "report/subject.hpp"

#include <gtest/gtest.h>

#include "sweepface/fit.hpp"

#include "faces.hpp"
#include "report/words.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// A tall sheet whose top rows, `moving` of 40, move forward.
Rig standing(double moving) {
  MeshRig source{grid(10, 40, [](double i, double j) { return Vec3{i, j, 0}; }), {}};
  source.targets.push_back({"nod", source.neutral.positions});
  for (Vec3& p : source.targets[0].positions)
    if (const double up = p.y - (40 - moving); up > 0) p.z += up / moving;
  auto conversion = convert(source);
  EXPECT_TRUE(conversion) << conversion.error().message;
  return conversion ? std::move(conversion->rig) : Rig{};
}

/// How much of the sheet's height fits into a picture.
double heightInPicture(const Rig& rig) {
  const Subject subject(rig);
  const FaceScenes scenes(rig, 1);
  const Camera camera = subject.cameras(scenes, Weights{1}, std::array{View{0, 0}})[0];
  const auto down = [&](double y) {
    return boxAround(std::array{Vec3{5, y, 0}}, camera, kPanel).y;
  };
  return 1 / (down(36) - down(37));
}

TEST(Subject, IsAllOfAFaceThatMovesInGoodPart) {
  const Rig rig = standing(30);
  EXPECT_GT(heightInPicture(rig), 40);
  EXPECT_EQ(Subject(rig).cutFor(kPanel).width, kPanel.width);
}

TEST(Subject, IsTheSmallPartThatMoves) {
  const Rig rig = standing(8);
  EXPECT_LT(heightInPicture(rig), 30);
  EXPECT_GT(heightInPicture(rig), 8);
  EXPECT_EQ(Subject(rig).cutFor(kPanel).width, 2 * kPanel.width);
}

}  // namespace
}  // namespace sweepface
