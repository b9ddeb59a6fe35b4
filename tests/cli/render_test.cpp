#include <fmt/format.h>

#include "sweepface/codec.hpp"
#include "sweepface/picture.hpp"

#include "cli/tool.hpp"

namespace sweepface {
namespace {

using namespace testing;
using Render = Tool;

/// Width and height of a PNG file, as its header says.
std::pair<unsigned, unsigned> sizeOf(const std::string& png) {
  if (png.size() < 33 || !png.starts_with("\x89PNG\r\n\x1a\n")) return {0, 0};
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t k = at; k < at + 4; ++k)
      value = value << 8 | static_cast<unsigned char>(png[k]);
    return value;
  };
  return {number(16), number(20)};
}

TEST_F(Render, MakesEveryStyle) {
  convertRig();
  std::map<std::string, std::string> pictures;
  for (const std::string style : {"shaded", "patches", "wireframe", "joins", "normals", "zebra"}) {
    const Outcome r = run("render face.sweep -o out.png --size 200x240 --style " + style);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.out.find("out.png: 200 × 240 pixels"), std::string::npos) << r.out;
    const std::string png = contents(folder / "out.png");
    EXPECT_EQ(sizeOf(png), (std::pair{200u, 240u}));
    for (const auto& [other, bytes] : pictures) EXPECT_NE(bytes, png) << style << " and " << other;
    pictures[style] = png;
  }
}

TEST_F(Render, FollowsWeightsViewAndLod) {
  convertRig();
  const auto rendered = [&](const std::string& more) {
    EXPECT_EQ(run("render face.sweep -o out.png --size 100x100 -q " + more).code, 0) << more;
    return contents(folder / "out.png");
  };
  const std::string plain = rendered("");
  EXPECT_EQ(rendered("--view front --weights smile=0"), plain);
  EXPECT_NE(rendered("--weights smile=1"), plain);
  EXPECT_NE(rendered("--view side"), plain);
  EXPECT_NE(rendered("--lod 1"), rendered("--lod 8"));
  EXPECT_EQ(rendered("--view 0,0"), plain);
  EXPECT_EQ(rendered("--view -360,0"), plain);
}

TEST_F(Render, GoesClose) {
  convertRig();
  const auto rendered = [&](const std::string& more) {
    EXPECT_EQ(run("render face.sweep -o out.png --size 100x100 -q " + more).code, 0) << more;
    return contents(folder / "out.png");
  };
  EXPECT_NE(rendered("--close smile"), rendered(""));
  EXPECT_NE(rendered("--close smile --to smile=1"), rendered("--to smile=1"));
  // As fine as a picture of twice the size.
  const Rig face = decode(contents(folder / "face.sweep"), "face.sweep").value();
  const Index lod = lodFor(face.surface, Style::shaded, {200, 200});
  EXPECT_EQ(rendered("--close smile --lod " + std::to_string(lod)), rendered("--close smile"));
  const Outcome r = run("render face.sweep -o out.png --close beard");
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.err.find("beard"), std::string::npos) << r.err;
}

TEST_F(Render, GoesCloseToASingleVertex) {
  const auto flat = [](Vec3 p) { return Vec3{p.x, p.y, 0}; };
  folder.file("neutral.obj", sheet(flat));
  folder.file("dent.obj", sheet([&](Vec3 p) {
                return flat(p) + Vec3{0, 0, p.x == 3 && p.y == 2.2 ? 0.5 : 0};
              }));
  ASSERT_EQ(run("convert neutral.obj dent.obj -o face.sweep --tolerance 0.01").code, 0);
  const auto rendered = [&](const std::string& style) {
    EXPECT_EQ(run("render face.sweep -o out.png --size 100x100 --close dent --style " + style).code,
              0);
    return contents(folder / "out.png");
  };
  EXPECT_NE(rendered("shaded"), rendered("normals")) << "something can be seen";
}

TEST_F(Render, PutsViewsBesideEachOther) {
  convertRig();
  ASSERT_EQ(run("render face.sweep -o out.png --views front,side,-30,10").code, 0);
  const auto [width, height] = sizeOf(contents(folder / "out.png"));
  EXPECT_EQ(width, 3u * 640u);
  EXPECT_GT(height, 800u) << "captions below them";
}

TEST_F(Render, ComparesWithTheMeshes) {
  convertRig();
  for (const std::string style : {"shaded", "error", "angle", "joins"}) {
    const Outcome r =
        run("render face.sweep -o out.png --size 400x300 --weights smile=0.5 --style " + style +
            " --compare neutral.obj targets");
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "");
  }
  folder.file("far.obj", sheet([](Vec3 p) { return p + Vec3{0, 0, 9}; }));
  EXPECT_NE(run("render face.sweep -o far.png --size 400x300 --compare far.obj")
                .err.find("or these are not the meshes that it was made from"),
            std::string::npos);
  ASSERT_EQ(run("render face.sweep -o out.png --size 400x300 --compare neutral.obj").code, 0);
  EXPECT_NE(contents(folder / "far.png"), contents(folder / "out.png"));
  ASSERT_EQ(run("render face.sweep -o out.png --size 400x400 --views front,side --style error "
                "--compare neutral.obj")
                .code,
            0);
  EXPECT_TRUE(fails("render face.sweep -o out.png --style error", "--compare"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --weights smile=1 --compare neutral.obj",
                    "no mesh of 'smile'"));
  folder.file("other.obj", cube(2));
  EXPECT_TRUE(fails("render face.sweep -o out.png --compare other.obj", "26 vertices"));
}

TEST_F(Render, ShowsTheWayToAnExpression) {
  convertRig();
  const Outcome r =
      run("render face.sweep -o out.png --size 600x300 --to jawOpen=1 --frames 4 "
          "--law linear,newton --box jaw --box 0.1,0.1,0.5,0.5");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(sizeOf(contents(folder / "out.png")), (std::pair{600u, 300u}));
  EXPECT_TRUE(fails("render face.sweep -o out.png --to jawOpen=1 --box ear", "'ear'"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --to jawOpen=1 --box 1,2,3", "no box"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --to jawOpen=1 --box ''", "--box", 2));
  EXPECT_TRUE(fails("render face.sweep -o out.png --to jawOpen=1 --law spring",
                    "There is no strip of a law 'spring'"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --to jawOpen=1 --views front,side", "one view"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --frames 4", "--to", 2));
  EXPECT_TRUE(fails("render face.sweep -o out.png --to jawOpen=1 --frames 1", "--frames", 2));
  EXPECT_TRUE(
      fails("render face.sweep -o out.png --to jawOpen=1 --compare neutral.obj", "--to", 2));
  EXPECT_TRUE(fails("render face.sweep -o out.png --to jawOpen=1 --weights smile=1", "--to", 2));
}

TEST_F(Render, FramesWhatLimitsLeaveOfTheWay) {
  convertRig();
  const auto strip = [&](const std::string& more) {
    const Outcome r =
        run("render face.sweep -o out.png --size 300x200 --frames 2 --box jaw " + more);
    EXPECT_EQ(r.code, 0) << r.err;
    return contents(folder / "out.png");
  };
  EXPECT_EQ(strip("--to jawOpen=4 --limits 0:0.5"), strip("--to jawOpen=0.5"));
}

TEST_F(Render, TheWayMayEndAtTheNeutral) {
  convertRig();
  const auto strip = [&](const std::string& more) {
    const Outcome r = run("render face.sweep -o out.png --size 600x300 " + more);
    EXPECT_EQ(r.code, 0) << r.err;
    return contents(folder / "out.png");
  };
  const std::string back = strip("--from smile=1 --to ''");
  EXPECT_EQ(back, strip("--from smile=1 --to smile=0"));
  EXPECT_NE(back, strip(""));
}

TEST_F(Render, HeatMapsAreOfOneExpression) {
  convertRig();
  for (const std::string style : {"error", "angle"})
    for (const std::string more : {"--combine", "--arcs on", ""})
      EXPECT_TRUE(fails("render face.sweep -o out.png --to jawOpen=1 --style " + style + " " + more,
                        "leave --to out"))
          << style << more;
  EXPECT_FALSE(std::filesystem::exists(folder / "out.png"));
}

TEST_F(Render, SaysWhatIsWrong) {
  convertRig();
  folder.file("out.png", "old");
  EXPECT_TRUE(fails("render face.sweep -o out.png --style shiny", "no style 'shiny'"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --view above", "no view 'above'"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --size 0x0", "cannot be made"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --size 100000x100000", "cannot be made"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --size large", "no size"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --size 64x64 --views front,side,back,front,side",
                    "no room"));
  EXPECT_TRUE(fails("render face.sweep -o out.png --weights frown=1", "frown"));
  EXPECT_TRUE(fails("render face.sweep -o out.obj", "must end in"));
  EXPECT_TRUE(fails("render face.sweep -o no/out.png", "there is no folder no"));
  EXPECT_TRUE(fails("render neutral.obj -o out.png", "neutral.obj"));
  EXPECT_EQ(contents(folder / "out.png"), "old");
}

}  // namespace
}  // namespace sweepface
