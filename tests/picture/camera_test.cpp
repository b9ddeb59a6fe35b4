#include "io/temporary_folder.hpp"
#include "picture/scenes.hpp"

namespace sweepface {
namespace {

using namespace testing;

std::vector<Vec3> cloud() {
  std::mt19937 random(7);
  std::vector<Vec3> points;
  const auto any = [&] { return static_cast<double>(random() % 1000) / 1000 - 0.5; };
  for (int k = 0; k < 200; ++k) points.push_back({3 * any() + 5, 4 * any() - 7, 2 * any() + 100});
  return points;
}

TEST(Views, HaveNamesAndNumbers) {
  EXPECT_EQ(parseView("front").value(), (View{0, 0}));
  EXPECT_EQ(parseView("side").value(), (View{90, 0}));
  EXPECT_EQ(parseView("-20,15.5").value(), (View{-20, 15.5}));
  EXPECT_EQ(nameOf(View{180, 0}), "back");
  EXPECT_EQ(nameOf(View{-20, 15.5}), "-20°, 15.5°");
  for (const std::string_view text :
       {"", "top", "10", "10,", ",10", "10,91", "400,0", "1,2,3", "nan,0"})
    EXPECT_TRUE(failsWith(parseView(text), {"There is no view"})) << text;
}

TEST(Views, StandInLists) {
  const auto views = parseViews("front,20,-5,side");
  ASSERT_TRUE(views.has_value());
  EXPECT_EQ(*views, (std::vector<View>{{0, 0}, {20, -5}, {90, 0}}));
  for (const std::string_view text : {"", "front,", "front,20", "front,,side"})
    EXPECT_FALSE(parseViews(text).has_value()) << text;
}

TEST(Cameras, LookWhereTheViewSays) {
  const auto points = cloud();
  const Camera front = frameCamera(points, {0, 0}, {100, 100});
  EXPECT_NEAR(front.forward.z, -1, 1e-12) << "into a face that looks along +z";
  EXPECT_NEAR(front.right.x, 1, 1e-12);
  const Camera side = frameCamera(points, {90, 0}, {100, 100});
  EXPECT_NEAR(side.forward.x, -1, 1e-12) << "at its left side, +x";
  EXPECT_NEAR(side.up.y, 1, 1e-12);
  const Camera above = frameCamera(points, {0, 90}, {100, 100});
  EXPECT_NEAR(above.forward.y, -1, 1e-12);
}

TEST(Cameras, HaveEverythingInThePicture) {
  const auto points = cloud();
  for (const View view : {View{0, 0}, {35, 6}, {90, 0}, {180, 0}, {-60, -80}, {0, 90}})
    for (const PictureSize size : {PictureSize{300, 400}, {900, 300}}) {
      const Camera camera = frameCamera(points, view, size, 0.1);
      double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
      for (const Vec3& p : points) {
        const Vec3 seen = camera.project(p, size);
        EXPECT_GT(seen.z, 0);
        left = std::min(left, seen.x), right = std::max(right, seen.x);
        top = std::min(top, seen.y), bottom = std::max(bottom, seen.y);
      }
      EXPECT_GE(left, 0.1 * size.width - 1e-6);
      EXPECT_LE(right, 0.9 * size.width + 1e-6);
      EXPECT_GE(top, 0.1 * size.height - 1e-6);
      EXPECT_LE(bottom, 0.9 * size.height + 1e-6);
      // The picture fills one of the two directions up to the margins.
      const double spare = std::min(left - 0.1 * size.width, top - 0.1 * size.height);
      EXPECT_NEAR(spare, 0, 1e-6);
    }
}

TEST(Cameras, ShowSeveralViewsAtTheSameSize) {
  const auto points = cloud();
  const std::array views{View{0, 0}, View{90, 0}, View{35, 6}};
  const PictureSize size{300, 400};
  const auto cameras = frameCameras(points, views, size);
  ASSERT_EQ(cameras.size(), 3u);
  Vec3 middle;
  for (const Vec3& p : points) middle += (1.0 / static_cast<double>(points.size())) * p;
  for (const Camera& camera : cameras) {
    EXPECT_NEAR(camera.project(middle, size).z, cameras[0].project(middle, size).z, 1e-9);
    for (const Vec3& p : points) {
      const Vec3 seen = camera.project(p, size);
      EXPECT_TRUE(seen.x > 0 && seen.x < size.width && seen.y > 0 && seen.y < size.height);
    }
  }
}

TEST(Boxes, AreReadAndFound) {
  const auto box = parseBox("0.1,0.2,0.3,0.4");
  ASSERT_TRUE(box.has_value());
  EXPECT_EQ((std::array{box->x, box->y, box->width, box->height}),
            (std::array{0.1, 0.2, 0.3, 0.4}));
  for (const std::string_view text :
       {"", "0.1,0.2,0.3", "0.1,0.2,0.3,0.4,0.5", "0,0,0,1", "0,0,1,0", "2,0,1,1", "a,b,c,d"})
    EXPECT_TRUE(failsWith(parseBox(text), {"no box"})) << text;
  EXPECT_TRUE(failsWith(parseBox("0.9,0.9,0.5,0.1"), {"no box in the picture"}));
  EXPECT_TRUE(parseBox("0.7,0.9,0.3,0.1"));
  const std::array corners{Vec3{-1, -1, 0}, Vec3{1, 1, 0}};
  const PictureBox around = boxAround(corners, before(), {200, 200});
  // At distance 10 a length of 1 is 60 pixels of 200; there is room of 3 pixels on every side.
  for (const double start : {around.x, around.y}) EXPECT_NEAR(start, 0.2 - 0.015, 1e-3);
  for (const double size : {around.width, around.height}) EXPECT_NEAR(size, 0.6 + 0.03, 1e-3);
}

}  // namespace
}  // namespace sweepface
