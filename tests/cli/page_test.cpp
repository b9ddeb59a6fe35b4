#include <fmt/format.h>

#include "cli/tool.hpp"

namespace sweepface {
namespace {

using namespace testing;
using Page = Tool;

TEST_F(Page, IsWrittenWholeFollowsItsOptionsAndOpensInABrowser) {
  convertRig();
  const Outcome r =
      run("report face.sweep neutral.obj targets -o report.html --tolerances 0.05 "
          "--weights smile=0.25 --box jaw --gltfpack not-here");
  ASSERT_EQ(r.code, 0) << r.err;
  const std::string html = contents(folder / "report.html");
  EXPECT_EQ(r.out, fmt::format("report.html: {} bytes\n", html.size()));
  EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(html.ends_with("</html>\n"));
  EXPECT_NE(html.find("<h1>face.sweep</h1>"), std::string::npos);
  EXPECT_NE(html.find("jawOpen"), std::string::npos);
  EXPECT_NE(html.find("The expression is smile=0.25."), std::string::npos);
  EXPECT_NE(html.find("<td>0.05</td>"), std::string::npos);
  EXPECT_NE(html.find("There is no program 'not-here'"), std::string::npos);

  if (std::system("command -v chromium >/dev/null") != 0) GTEST_SKIP() << "there is no chromium";
  const std::string here = (folder / "").string();
  const std::string command = fmt::format(
      "timeout 120 chromium --headless --no-sandbox --disable-gpu --enable-logging=stderr "
      "--user-data-dir='{0}profile' --dump-dom 'file://{0}report.html' >'{0}dom' 2>'{0}log'",
      here);
  ASSERT_EQ(std::system(command.c_str()), 0) << contents(folder / "log");
  EXPECT_NE(contents(folder / "dom").find("Linear and Newton"), std::string::npos);
  EXPECT_EQ(contents(folder / "log").find("CONSOLE"), std::string::npos)  // errors of the page
      << contents(folder / "log");
}

// Eight times the tolerance would be more than the whole mesh.
TEST_F(Page, ComparesACoarseFaceWithWhatThereCanBe) {
  makeRig();
  ASSERT_EQ(run("convert neutral.obj targets -o face.sweep --tolerance 2").code, 0);
  const Outcome r = run("report face.sweep neutral.obj targets -o report.html --gltfpack not-here");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(contents(folder / "report.html").find("<td>4</td>"), std::string::npos);
}

// It warns before the long part, where it stops here since the targets are missing.
TEST_F(Page, WarnsOfMeshesThatTheFaceWasHardlyMadeFrom) {
  convertRig();
  folder.file("far.obj", sheet([](Vec3 p) { return p + Vec3{0, 0, 9}; }));
  const Outcome r = run("report face.sweep far.obj -o report.html --no-tolerances");
  EXPECT_NE(r.err.find("or these are not the meshes that it was made from"), std::string::npos)
      << r.err;
}

TEST_F(Page, SaysWhatIsWrong) {
  convertRig();
  folder.file("report.html", "old");
  folder.file("other.obj", cube(2));
  EXPECT_TRUE(fails("report face.sweep other.obj -o report.html --no-tolerances", "26 vertices"));
  EXPECT_TRUE(
      fails("report face.sweep neutral.obj targets -o report.html --weights frown=1", "frown"));
  EXPECT_TRUE(fails("report face.sweep --weights '' -o report.html", "name an expression"));
  EXPECT_TRUE(fails("report face.sweep neutral.obj targets -o report.png", "must end in"));
  EXPECT_TRUE(
      fails("report face.sweep neutral.obj targets -o no/report.html", "there is no folder no"));
  EXPECT_TRUE(
      fails("report face.sweep neutral.obj -o report.html --tolerances 0", "--tolerances", 2));
  EXPECT_TRUE(fails("report face.sweep neutral.obj targets -o report.html --tolerances 1e-12",
                    "sweepface: face.sweep: a tolerance of 1e-12 is finer than a file's numbers"));
  EXPECT_TRUE(fails("report face.sweep neutral.obj -o report.html --tolerances 1 --no-tolerances",
                    "--tolerances", 2));
  EXPECT_TRUE(fails("report face.sweep neutral.obj -o report.html --gltfpack g --no-tolerances",
                    "--gltfpack", 2));
  EXPECT_TRUE(fails("report face.sweep neutral.obj targets -o report.html --gltfpack ./not-here",
                    "There is no program ./not-here"));
  EXPECT_TRUE(fails("report face.sweep -o report.html --no-tolerances", "NEUTRAL", 2));
  EXPECT_EQ(contents(folder / "report.html"), "old");
}

}  // namespace
}  // namespace sweepface
