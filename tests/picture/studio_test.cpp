#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "io/temporary_folder.hpp"
#include "picture/scenes.hpp"

namespace sweepface {
namespace {

using namespace testing;

// ---- What is seen ----

TEST(Studio, SeesTheSilhouetteOfASphere) {
  const Image image = picture(sphere(), before(), {400, 300});
  // Rays that touch a sphere at distance d form a cone whose half-angle has the tangent
  // r / sqrt(d² - r²).
  const double radius = 3 * 300 / std::sqrt(99);
  const double all = 400 * 300, inside = std::numbers::pi * radius * radius;
  EXPECT_NEAR(all - countNear(image, kPaper), inside, 2 * std::numbers::pi * radius);
  EXPECT_NEAR(countNear(image, kRed), inside, 2 * std::numbers::pi * radius);
  const auto y = static_cast<Index>(150);
  EXPECT_TRUE(near(image.at(static_cast<Index>(200 + radius - 2), y), kRed));
  EXPECT_TRUE(near(image.at(static_cast<Index>(200 + radius + 2), y), kPaper));
}

TEST(Studio, SmoothsEdges) {
  const Image image = picture(sphere());
  int between = 0;
  for (Index x = 0; x < image.width; ++x)
    for (Index y = 0; y < image.height; ++y) {
      const Colour c = image.at(x, y);
      between += !near(c, kRed) && !near(c, kPaper);
    }
  EXPECT_GT(between, 300) << "along a circle of 380 pixels";
  EXPECT_LT(between, 600);
}

TEST(Studio, ShowsWhatIsNearer) {
  for (const bool swapped : {false, true}) {
    Scene scene = squares();
    addSquare(scene, {0, 0, swapped ? 1.0 : 0.0}, 1, kRed);
    addSquare(scene, {0.5, 0, swapped ? 0.0 : 1.0}, 1, kGreen);
    const Image image = picture(scene);
    EXPECT_TRUE(near(image.at(130, 100), swapped ? kRed : kGreen)) << "both are there";
    EXPECT_TRUE(near(image.at(60, 100), kRed));
    EXPECT_TRUE(near(image.at(175, 100), kGreen));
  }
}

TEST(Studio, BlendsColoursInLight) {
  Scene scene = squares();
  addSquare(scene, {}, 1, {0, 0, 0});
  for (const std::size_t right : {1u, 2u}) scene.vertexColours[right] = {1, 1, 1};
  const Image image = picture(scene);
  // Half the light of white is 0.735 on a screen.
  EXPECT_NEAR(image.at(99, 100).g, 0.735, 0.01);
  EXPECT_LT(image.at(45, 100).g, 0.3);
  EXPECT_GT(image.at(155, 100).g, 0.95);
}

TEST(Studio, CountsForeshorteningIn) {
  // A square tilted away: its middle is not the middle of its picture.
  Scene scene = squares();
  addSquare(scene, {}, 1, {0, 0, 0});
  for (const std::size_t far : {2u, 3u}) {
    scene.positions[far].z = -8;
    scene.vertexColours[far] = {1, 1, 1};
  }
  const PictureSize size{200, 200};
  const Image image = picture(scene, before(), size);
  const Vec3 middle = before().project({0, 0, -4}, size);
  EXPECT_NEAR(image.at(100, static_cast<Index>(middle.y)).g, 0.735, 0.02);
}

TEST(Studio, ShowsInnerSidesInAColourOfTheirOwn) {
  Scene scene = squares();
  addSquare(scene, {}, 1, kRed);
  Camera behind = before();
  behind.eye = {0, 0, -10};
  behind.forward = {0, 0, 1};
  behind.right = {-1, 0, 0};
  const Colour c = picture(scene, behind).at(100, 100);
  EXPECT_FALSE(near(c, kRed));
  EXPECT_FALSE(near(c, kPaper));
  EXPECT_GT(brightness(c), 0.25) << "not black";
}

TEST(Studio, LeavesOutWhatIsBehindTheEye) {
  Scene scene = squares();
  addSquare(scene, {0, 0, 20}, 1, kRed);
  scene.strokes.push_back({{{-1, 1, 20}, {1, 1, 20}}, kBlue, 10});
  scene.strokes.push_back({{{0, 0, -1}, {0.1, 0.1, 20}}, kBlue, 10});
  scene.labels.push_back({{0, 0, 20}, "behind", kBlue});
  EXPECT_EQ(countNear(picture(scene), kPaper), 200 * 200);
}

// ---- Light ----

TEST(Studio, LightsFromTheUpperLeft) {
  for (const Finish finish : {Finish::skin, Finish::matte}) {
    Scene scene = sphere();
    scene.finish = finish;
    scene.colour = {0.8f, 0.8f, 0.8f};
    const Image image = picture(scene);
    EXPECT_GT(brightness(image.at(75, 75)), brightness(image.at(125, 125)) + 0.03);
    for (Index x = 45; x < 155; x += 10)
      EXPECT_GT(brightness(image.at(x, 100)), 0.3) << "no black shadows";
  }
}

TEST(Studio, ShadesHollows) {
  // A plate just above a ground that faces the camera.
  const auto ground = [](bool plate) {
    Scene scene = squares();
    for (Index j = -20; j < 20; ++j)
      for (Index i = -20; i < 20; ++i)
        addSquare(scene, {0.1 * i + 0.05, 0.1 * j + 0.05, 0}, 0.05, {0.8f, 0.8f, 0.8f});
    if (plate) addSquare(scene, {-1, 1, 0.4}, 0.8, kBlue);
    scene.finish = Finish::skin;
    return picture(scene);
  };
  const Image open = ground(false), covered = ground(true);
  EXPECT_LT(brightness(covered.at(115, 85)), brightness(open.at(115, 85)) - 0.03);
  EXPECT_NEAR(brightness(covered.at(150, 150)), brightness(open.at(150, 150)), 0.03);
}

TEST(Studio, ReflectsStripes) {
  Scene scene = sphere();
  scene.finish = Finish::zebra;
  const Image image = picture(scene);
  int dark = 0, bright = 0, changes = 0;
  bool last = false;
  for (Index x = 45; x < 155; ++x) {
    const bool isBright = brightness(image.at(x, 100)) > 0.5;
    (isBright ? bright : dark) += 1;
    changes += x > 45 && isBright != last;
    last = isBright;
  }
  EXPECT_GT(dark, 30);
  EXPECT_GT(bright, 30);
  EXPECT_GE(changes, 6);
}

// ---- Lines and labels ----

/// The sphere with a straight line from left to right at depth z.
Image withLine(double z) {
  Scene scene = sphere();
  scene.strokes.push_back({{{-1.6, 0, z}, {1.6, 0, z}}, kBlue, 10});
  return picture(scene);
}

TEST(Studio, HidesLinesBehindTheSurface) {
  const Image front = withLine(1.1), behind = withLine(-1.1);
  for (const Index x : {60, 100, 140}) {
    EXPECT_TRUE(near(front.at(x, 100), kBlue));
    EXPECT_TRUE(near(behind.at(x, 100), kRed));
  }
  for (const Index x : {20, 180}) EXPECT_TRUE(near(behind.at(x, 100), kBlue));
}

TEST(Studio, EndsLinesWhereTheyGoBehind) {
  const Image behind = withLine(-1.1);
  // The silhouette is 60.3 pixels from the middle; the line's round end is one pixel further.
  EXPECT_TRUE(near(behind.at(157, 100), kRed));
  EXPECT_TRUE(near(behind.at(163, 100), kBlue));
}

TEST(Studio, DrawsLinesOnTheSurface) {
  Scene scene = sphere();
  Stroke equator{{}, kBlue, 10};
  for (int k = 0; k <= 64; ++k)
    equator.points.push_back({std::sin(turn(k / 64.0)), 0, std::cos(turn(k / 64.0))});
  scene.strokes.push_back(equator);
  const Image image = picture(scene);
  for (const Index x : {50, 75, 100, 125, 150}) EXPECT_TRUE(near(image.at(x, 100), kBlue)) << x;
}

TEST(Studio, DrawsLabelsWhereTheirPointIsSeen) {
  Scene scene = sphere();
  scene.labels.push_back({{0, 0, 1}, "worst", kBlue});
  EXPECT_GT(countNear(picture(scene), kBlue), 10);
  scene.labels[0].at = {0, 0, -1};
  EXPECT_EQ(countNear(picture(scene), kBlue), 0);
}

TEST(Studio, WritesLabelsWithinThePicture) {
  Scene scene = sphere();
  scene.labels.push_back({{0, 0, 1}, "as long as half of it", kBlue});
  const auto bluish = [&](PictureSize size) {
    const Image image = picture(scene, before(), size);
    int count = 0;
    for (Index x = 0; x < image.width; ++x)
      for (Index y = 0; y < image.height; ++y) count += image.at(x, y).b > image.at(x, y).r + 0.1f;
    return count;
  };
  EXPECT_GT(bluish({600, 200}), 200);
  EXPECT_NEAR(bluish({200, 200}), bluish({600, 200}), 0.1 * bluish({600, 200}));
}

// ---- Promises ----

TEST(Studio, MakesTheSamePictureWithAnyNumberOfThreads) {
  Scene scene = sphere();
  scene.finish = Finish::skin;
  addSquare(scene, {0, 0, 1.2}, 0.4, kGreen);
  scene.vertexColours.assign(scene.positions.size(), kGreen);
  scene.strokes.push_back({{{-1.6, 0, -1}, {1.6, 0.5, 1}}, kBlue, 3});
  scene.labels.push_back({{0, 0, 1.2}, "here", kBlue});
  const auto withThreads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(static_cast<int>(threads));
    return arena.execute([&] { return picture(scene); });
  };
  const Image one = withThreads(1);
  EXPECT_EQ(withThreads(2), one);
  EXPECT_EQ(withThreads(8), one);
}

TEST(Studio, SurvivesEmptyAndFlatScenes) {
  EXPECT_EQ(countNear(picture({}), kPaper), 200 * 200);
  Scene point = squares();
  addSquare(point, {}, 0, kRed);
  point.finish = Finish::skin;
  const Camera camera = frameCamera(point.positions, {}, {200, 200});
  EXPECT_EQ(countNear(picture(point, camera), kPaper), 200 * 200);
}

TEST(Studio, RefusesScenesThatMakeNoSense) {
  const auto refuses = [](auto spoil, std::string_view part) {
    Scene scene = squares();
    addSquare(scene, {}, 1, kRed);
    spoil(scene);
    return failsWith(Studio::make(scene), {part});
  };
  const double nan = std::nan("");
  EXPECT_TRUE(refuses([](Scene& s) { s.triangles[1][2] = 4; }, "Triangle 1"));
  EXPECT_TRUE(refuses([](Scene& s) { s.triangles[0][0] = -1; }, "vertex -1"));
  EXPECT_TRUE(refuses([](Scene& s) { s.normals.pop_back(); }, "3 normals"));
  EXPECT_TRUE(
      refuses([](Scene& s) { s.vertexColours.pop_back(); }, "3 colours for its 4 vertices"));
  EXPECT_TRUE(refuses([](Scene& s) { s.triangleColours.push_back(kRed); }, "2 triangles"));
  EXPECT_TRUE(refuses([=](Scene& s) { s.positions[2].y = nan; }, "Vertex 2"));
  EXPECT_TRUE(refuses([=](Scene& s) { s.strokes.push_back({{{0, 0, nan}}, kRed, 1}); }, "line"));
  EXPECT_TRUE(refuses([=](Scene& s) { s.labels.push_back({{nan, 0, 0}, "", kRed}); }, "label"));
}

TEST(Studio, EndsWhenItIsCancelled) {
  std::atomic<bool> cancel = false;
  const auto studio = Studio::make(sphere(), &cancel);
  ASSERT_TRUE(studio.has_value());
  EXPECT_TRUE(studio->shoot(before(), {100, 100}).has_value());
  cancel = true;
  EXPECT_TRUE(failsWith(studio->shoot(before(), {100, 100}), {"interrupted"}));
  EXPECT_TRUE(failsWith(Studio::make(sphere(), &cancel), {"interrupted"}));
  EXPECT_TRUE(failsWith(render(sphere(), before(), {100, 100}, &cancel), {"interrupted"}));
}

TEST(Studio, RefusesSizesThatMakeNoSense) {
  const auto studio = Studio::make(sphere());
  ASSERT_TRUE(studio.has_value());
  for (const PictureSize size :
       {PictureSize{0, 0}, {100, 15}, {16385, 100}, {-5, 100}, {16000, 16000}})
    EXPECT_TRUE(failsWith(studio->shoot(before(), size), {"cannot be made"}));
}

}  // namespace
}  // namespace sweepface
