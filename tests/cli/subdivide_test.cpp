#include <nlohmann/json.hpp>

#include "sweepface/subdivision.hpp"

#include "cli/tool.hpp"

namespace sweepface {
namespace {

using namespace testing;
using Subdivide = Tool;

TEST_F(Subdivide, FitsTheLimitOfEveryExpression) {
  makeRig();
  const Outcome made =
      run("convert neutral.obj targets -o face.sweep --subdivide 2 --tolerance 0.002 --json");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(nlohmann::json::parse(made.out)["vertices"], 25 * 21);
  for (const std::string target : {"", "jawOpen", "smile"}) {
    const std::string file = target.empty() ? "neutral" : "targets/" + target;
    const MeshRig limit = subdivide({mesh(file + ".obj"), {}}, 2).value().rig;
    ASSERT_EQ(run("export face.sweep -o out.obj --weights '" + target + "'").code, 0);
    const PolygonMesh out = mesh("out.obj");
    EXPECT_LE(largestDistance(out.positions, limit.neutral.positions), 0.002);
    EXPECT_EQ(out.polygons.corners, limit.neutral.polygons.corners);
    EXPECT_EQ(out.polygons.materials, (std::vector<std::string>{"lips", "skin"}));
    EXPECT_GT(largestDistance(mesh(file + ".obj").positions,
                              {out.positions.begin(), out.positions.begin() + 42}),
              0.01);
  }
}

TEST_F(Subdivide, IsGivenAgainToCompareWithTheCage) {
  makeRig();
  ASSERT_EQ(run("convert neutral.obj targets -o face.sweep --subdivide 1 --tolerance 0.01").code,
            0);
  const Outcome measured =
      run("measure face.sweep neutral.obj targets --subdivide 1 --mixtures 0 --json");
  ASSERT_EQ(measured.code, 0) << measured.err;
  const auto report = nlohmann::json::parse(measured.out);
  EXPECT_LE(report["worst"]["distanceMax"], report["tolerance"]);
  EXPECT_TRUE(fails("measure face.sweep neutral.obj targets",
                    "made from 143; give the mesh it was converted from, chosen and subdivided in "
                    "the same way."));
  EXPECT_TRUE(
      fails("render face.sweep -o r.png --size 200x200 --weights smile "
            "--compare neutral.obj targets",
            "made from 143; give the mesh it was converted from, chosen and subdivided in the same "
            "way."));
  EXPECT_EQ(
      run("report face.sweep neutral.obj targets --subdivide 1 --no-tolerances -o r.html").err, "");
  EXPECT_EQ(run("render face.sweep -o r.png --size 200x200 --weights smile "
                "--compare neutral.obj targets --subdivide 1")
                .err,
            "");
}

TEST_F(Subdivide, IsRefusedWhereItCannotBe) {
  makeRig();
  const std::string convert = "convert neutral.obj targets -o face.sweep --subdivide ";
  for (const char* levels : {"0", "6", "1.5", "x"})
    EXPECT_TRUE(fails(convert + levels, "--subdivide", 2)) << levels;
  folder.file("point.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\n");
  EXPECT_TRUE(fails("convert point.obj -o face.sweep --subdivide 1",
                    "point.obj: the mesh has no face with an area to be subdivided."));
  ASSERT_EQ(run("convert neutral.obj targets -o face.sweep").code, 0);
  EXPECT_TRUE(fails("report face.sweep -o r.html --subdivide 1", "NEUTRAL", 2));
  EXPECT_TRUE(fails("render face.sweep -o r.png --subdivide 1", "--compare", 2));
}

TEST_F(Subdivide, WarnsOfFacesInTheCagesNumbers) {
  folder.file("twice.obj", sheet() + "f 1 2 9 8\nf 1 2 20\n");
  const Outcome r = run("convert twice.obj -o face.sweep --subdivide 1 --tolerance 0.1");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("warning: 1 face has the corners of another one"), std::string::npos)
      << r.err;
  EXPECT_NE(r.err.find("warning: Of the subdivided mesh: "), std::string::npos) << r.err;
}

TEST_F(Subdivide, TakesAGlbWithoutItsScene) {
  convertRig();
  ASSERT_EQ(run("export face.sweep -o face.glb").code, 0);
  const std::string convert = "convert face.glb -o out.sweep --subdivide 1";
  EXPECT_TRUE(fails(convert, "leave it out with --bare"));
  ASSERT_EQ(run(convert + " --bare").code, 0);
  EXPECT_EQ(run("measure out.sweep face.glb --subdivide 1").code, 0);
  const Outcome r = run(convert + " --strip order");  // which loses the scene anyway
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("is left out with the order"), std::string::npos) << r.err;
}

}  // namespace
}  // namespace sweepface
