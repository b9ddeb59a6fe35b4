#include <nlohmann/json.hpp>

#include "cli/tool.hpp"

namespace sweepface {
namespace {

using namespace testing;
using Pack = Tool;

TEST_F(Pack, LeavesPartsOut) {
  makeRig();
  ASSERT_EQ(run("convert neutral.obj targets -o face.sweep --tolerance 0.01 --pack").code, 0);
  const Outcome r =
      run("convert neutral.obj targets -o bare.sweep --tolerance 0.01 --pack --strip order,uv");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto whole = nlohmann::json::parse(run("info face.sweep --json").out),
             bare = nlohmann::json::parse(run("info bare.sweep --json").out);
  EXPECT_TRUE(whole["parts"].contains("source order"));
  EXPECT_FALSE(bare["parts"].contains("source order"));
  EXPECT_FALSE(bare["parts"].contains("texture coordinates"));
  EXPECT_EQ(bare["bytes"], whole["bareBytes"]);
  EXPECT_LT(bare["bytes"], whole["bytes"]);
}

TEST_F(Pack, RoundsTextureCoordinatesAsToldAndNoFurther) {
  makeRig();
  const auto packed = [&](const std::string& options) {
    EXPECT_EQ(
        run("convert neutral.obj targets -o face.sweep --tolerance 0.01 --pack " + options).code,
        0);
    EXPECT_EQ(run("export face.sweep -o out.obj --source-order").code, 0);
    return mesh("out.obj").polygons;
  };
  for (const auto& [options, bits] : {std::pair{"", 14}, {"--uv-bits 8", 8}}) {
    const Polygons found = packed(options);
    const Polygons source = mesh("neutral.obj").polygons;
    ASSERT_EQ(found.cornerTexcoords.size(), source.cornerTexcoords.size());
    double most = 0;
    for (std::size_t c = 0; c < source.cornerTexcoords.size(); ++c) {
      const Vec2 a = source.texcoords[source.cornerTexcoords[c]],
                 b = found.texcoords[found.cornerTexcoords[c]];
      most = std::max({most, std::abs(a.x - b.x), std::abs(a.y - b.y)});
      EXPECT_EQ(std::remainder(b.x * (1 << bits), 1), 0);
    }
    EXPECT_LE(most, 0.5 / (1 << bits));
    EXPECT_GT(most, 0);
  }
  EXPECT_TRUE(fails("convert neutral.obj -o face.sweep --pack --uv-bits 7", "--uv-bits", 2));
  EXPECT_TRUE(fails("convert neutral.obj -o face.sweep --uv-bits 12", "--pack or --max-bytes"));
  EXPECT_TRUE(fails("convert neutral.obj -o face.sweep --pack --uv-bits 12 --strip uv",
                    "--strip uv leaves them out"));
  EXPECT_TRUE(
      fails("convert neutral.obj -o face.sweep --normal-tolerance 1", "--pack or --max-bytes"));
}

TEST_F(Pack, KeepsTextureCoordinatesThatAreTooFarForStepsExactly) {
  std::string text;  // in pixels, of a texture that repeats
  for (std::size_t at = 0, line; at < sheet().size(); at = line + 1) {
    line = sheet().find('\n', at);
    const std::string row = sheet().substr(at, line - at);
    double u = 0, v = 0;
    if (std::sscanf(row.c_str(), "vt %lf %lf", &u, &v) == 2)
      text += fmt::format("vt {} {}\n", 8192 * u, 8192 * v);
    else
      text += row + "\n";
  }
  folder.file("pixels.obj", text);
  ASSERT_EQ(run("convert pixels.obj -o face.sweep --tolerance 0.01 --pack").code, 0);
  ASSERT_EQ(run("export face.sweep -o out.obj --source-order").code, 0);
  const Polygons found = mesh("out.obj").polygons, source = mesh("pixels.obj").polygons;
  for (std::size_t c = 0; c < source.cornerTexcoords.size(); ++c)
    EXPECT_EQ(found.texcoords[found.cornerTexcoords[c]],
              source.texcoords[source.cornerTexcoords[c]]);
}

TEST_F(Pack, MakesAnEditedFaceSmall) {
  convertRig();
  ASSERT_EQ(run("edit face.sweep --move n0 0,0,0.5 -o edited.sweep").code, 0);
  const Outcome r = run("pack edited.sweep -o small.sweep --tolerance 0.05");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(r.out.starts_with("small.sweep: ")) << r.out;
  EXPECT_NE(r.out.find(" of 0.05 allowed"), std::string::npos) << r.out;
  EXPECT_LT(contents(folder / "small.sweep").size(), contents(folder / "edited.sweep").size() / 5);
  for (const char* weights : {"", "--weights smile", "--weights jawOpen"}) {
    for (const char* face : {"edited", "small"})
      ASSERT_EQ(
          run(fmt::format("export {0}.sweep -o {0}.obj --source-order {1}", face, weights)).code,
          0);
    EXPECT_LE(largestDistance(mesh("edited.obj").positions, mesh("small.obj").positions), 0.0501);
  }
  EXPECT_EQ(run("check small.sweep").code, 0);
  const auto info = nlohmann::json::parse(run("info small.sweep --json").out);
  EXPECT_NEAR(info["tolerance"].get<double>(), 0.06, 1e-12);
}

TEST_F(Pack, MakesADrawnFaceSmallAndKeepsItsNames) {
  ASSERT_EQ(
      run(fmt::format("build '{}/examples/sheet.wire.json' -o drawn.sweep", SWEEPFACE_SOURCE_DIR))
          .code,
      0);
  ASSERT_EQ(run("pack drawn.sweep -o small.sweep --tolerance 0.01 --quiet").out, "");
  EXPECT_LT(contents(folder / "small.sweep").size(), contents(folder / "drawn.sweep").size() / 4);
  EXPECT_NE(run("info small.sweep --list").out.find("curve b3-c3"), std::string::npos);
}

TEST_F(Pack, LeavesPartsOutOfAFace) {
  convertRig();
  ASSERT_EQ(run("pack face.sweep -o small.sweep").code, 0);
  ASSERT_EQ(run("pack face.sweep -o bare.sweep --strip order,uv").code, 0);
  EXPECT_EQ(nlohmann::json::parse(run("info small.sweep --json").out)["bareBytes"],
            contents(folder / "bare.sweep").size());
  // The same for a face without a vertex order.
  ASSERT_EQ(run("pack bare.sweep -o again.sweep --tolerance 0.1").code, 0);
  EXPECT_LT(contents(folder / "again.sweep").size(), contents(folder / "bare.sweep").size());
}

TEST_F(Pack, WarnsOfAFileThatGrowsAndOfASceneThatIsLost) {
  convertRig("--pack");
  EXPECT_NE(run("pack face.sweep -o large.sweep --tolerance 0.0001").err.find("no smaller than"),
            std::string::npos);
  ASSERT_EQ(run("export face.sweep -o face.glb").code, 0);
  ASSERT_EQ(run("convert face.glb -o scene.sweep").code, 0);
  EXPECT_EQ(run("pack scene.sweep -o small.sweep").err, "");
  EXPECT_EQ(run("pack scene.sweep -o small.sweep --strip order,scene").err, "");
  EXPECT_NE(
      run("pack scene.sweep -o small.sweep --strip order").err.find("left out with the order"),
      std::string::npos);
}

TEST_F(Pack, RefusesWhatCannotBePackedAndLeavesFilesAlone) {
  convertRig();
  folder.file("kept.sweep", "kept");
  EXPECT_TRUE(fails("pack face.sweep -o kept.sweep --tolerance 1e9", "larger than the mesh"));
  EXPECT_TRUE(fails("pack face.sweep -o kept.sweep --strip hair", "no part 'hair'"));
  EXPECT_TRUE(fails("pack face.sweep -o kept.sweep --uv-bits 7", "--uv-bits", 2));
  EXPECT_TRUE(
      fails("pack face.sweep -o kept.sweep --uv-bits 9 --strip uv", "--strip uv leaves them out"));
  EXPECT_TRUE(fails("pack neutral.obj -o kept.sweep", "neutral.obj"));
  EXPECT_TRUE(fails("pack face.sweep -o face.sweep", "face.sweep"));
  EXPECT_EQ(contents(folder / "kept.sweep"), "kept");
}

TEST_F(Pack, WithoutItsOrderAFaceStillExportsButSaysSo) {
  makeRig();
  ASSERT_EQ(run("convert neutral.obj targets -o bare.sweep --tolerance 0.01 --strip order").code,
            0);
  EXPECT_EQ(run("export bare.sweep -o out.obj").code, 0);
  EXPECT_EQ(mesh("out.obj").positions.size(), mesh("neutral.obj").positions.size());
  const Outcome r = run("export bare.sweep -o ordered.obj --source-order");
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.err.find("has no source order"), std::string::npos) << r.err;
  const Outcome m = run("measure bare.sweep neutral.obj targets");
  EXPECT_EQ(m.code, 1);
  EXPECT_NE(m.err.find("no source order"), std::string::npos) << m.err;
}

TEST_F(Pack, WithoutTheOrderNoVertexIsTakenForAnother) {
  makeRig();
  ASSERT_EQ(run("convert neutral.obj targets -o bare.sweep --tolerance 0.01 --strip order").code,
            0);
  for (const char* command :
       {"plot bare.sweep --to smile=1 --vertex 5 -o out.svg",
        "render bare.sweep -o out.png --style error --compare neutral.obj targets",
        "measure bare.sweep neutral.obj targets"}) {
    const Outcome r = run(command);
    EXPECT_NE(r.code, 0) << command;
    EXPECT_NE(r.err.find("no source order"), std::string::npos) << r.err;
  }
}

TEST_F(Pack, SaysWhichPartsThereAre) {
  const Outcome r = run("convert missing.obj -o bare.sweep --strip hair");
  EXPECT_NE(r.code, 0);
  EXPECT_NE(r.err.find("order, uv, groups and scene"), std::string::npos) << r.err;
}

TEST_F(Pack, FindsTheToleranceThatFitsIntoSoManyBytes) {
  makeRig();
  for (const int most : {900, 1500, 3000}) {  // the finest fit takes more
    const Outcome r = run(fmt::format(
        "convert neutral.obj targets -o face.sweep --json --uv-bits 12 --max-bytes {}", most));
    ASSERT_EQ(r.code, 0) << r.err;
    const auto report = nlohmann::json::parse(r.out);
    EXPECT_LE(report["bytes"], most);
    EXPECT_LE(report["worstDistance"], report["tolerance"]);
  }
  const Outcome r = run("convert neutral.obj targets -o face.sweep --max-bytes 100");
  EXPECT_EQ(r.code, 1);
  // The part that does not depend on the tolerance is already too large, as two tries show.
  EXPECT_NE(r.err.find("does not fit into 100 bytes; the smallest of 3 tries takes "),
            std::string::npos)
      << r.err;
  // Nothing turns, so no room has to be left for it.
  const auto sizeWith = [&](const std::string& more) {
    const Outcome o =
        run("convert neutral.obj targets -o face.sweep --json --max-bytes 900" + more);
    return nlohmann::json::parse(o.out)["bytes"].get<int>();
  };
  EXPECT_EQ(sizeWith(" --arcs"), sizeWith(""));
  for (const char* bytes : {"0", "1e300", "99999999999999999999"})
    EXPECT_EQ(run("convert neutral.obj -o huge.sweep --max-bytes " + std::string(bytes)).code, 2);
}

TEST_F(Pack, BringsNormalsWithinATolerance) {
  makeRig();
  const std::string command = "convert neutral.obj targets -o face.sweep --tolerance 0.05 --pack ";
  const auto rms = [&](const std::string& options) {
    const auto told = nlohmann::json::parse(run(command + options + " --json").out);
    const auto measured = nlohmann::json::parse(
        run("measure face.sweep neutral.obj targets --mixtures 0 --json").out);
    for (const char* angle : {"angleRms", "angleMax"})
      EXPECT_NEAR(told[angle].get<double>(), measured["worst"][angle], 1e-9) << angle;
    return told["angleRms"].get<double>();
  };
  const double usual = rms("");
  EXPECT_LE(rms(fmt::format("--normal-tolerance {}", 0.7 * usual)), 0.7 * usual);
  EXPECT_NE(run(command).out.find(fmt::format("normals {:.4g} degrees off, ", usual)),
            std::string::npos);
}

}  // namespace
}  // namespace sweepface
