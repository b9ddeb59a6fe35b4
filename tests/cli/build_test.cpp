#include "sweepface/codec.hpp"

#include "cli/tool.hpp"
#include "drawing/drawings.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

class Build : public Tool {
 protected:
  Rig face(const std::string& name) {
    auto rig = decode(contents(folder / name), name);
    EXPECT_TRUE(rig) << (rig ? "" : rig.error().message);
    return rig ? std::move(*rig) : Rig{};
  }
};

TEST_F(Build, MakesTheVaseOfTheDocumentation) {
  folder.file("vase.wire.json", vaseText());
  const Outcome r = run("build vase.wire.json -o vase.sweep");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(r.err.empty()) << r.err;
  EXPECT_TRUE(r.out.starts_with("vase.sweep: 2 patches, 36 points, 1 targets, ")) << r.out;
  EXPECT_NE(document("wire-format.md").find("    " + r.out.substr(0, r.out.find('\n'))),
            std::string::npos)
      << "the page shows other words than " << r.out;
  EXPECT_EQ(face("vase.sweep").targets[0].name, "taller");
}

TEST_F(Build, IsNotMistakenForOtherCommands) {
  folder.file("vase.wire.json", vaseText());
  ASSERT_EQ(run("build vase.wire.json -o vase.sweep").code, 0);
  EXPECT_TRUE(fails("info vase.wire.json",
                    "make a face of it first: `sweepface build vase.wire.json -o face.sweep`."));
  folder.file("my vase.wire.json", vaseText());
  EXPECT_TRUE(
      fails("info 'my vase.wire.json'", "`sweepface build 'my vase.wire.json' -o face.sweep`."));
  EXPECT_TRUE(fails("build vase.sweep -o other.sweep",
                    "`sweepface wireframe vase.sweep -o face.wire.json`."));
  EXPECT_TRUE(fails("convert vase.sweep -o other.sweep", "vase.sweep is a face already"));
}

TEST_F(Build, WarnsOfPointsThatAreFarFromTheirCurve) {
  Json drawing = vase();
  std::ranges::reverse(drawing["controls"][2]["second"]);
  folder.file("vase.wire.json", drawing.dump());
  const Outcome r = run("build vase.wire.json -o vase.sweep --quiet");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("the control of 'rim right' in 'right' misses one of its points by"),
            std::string::npos)
      << r.err;
}

TEST_F(Build, WarnsOfNamesThatNoListOfWeightsHolds) {
  Json drawing = vase();
  for (const char* name : {"a,b", " lead"}) {
    drawing["expressions"][0]["name"] = name;
    folder.file("vase.wire.json", drawing.dump());
    const Outcome r = run("build vase.wire.json -o vase.sweep --quiet");
    EXPECT_EQ(r.code, 0);
    EXPECT_NE(r.err.find(std::string("'") + name + "' is no name for a list"), std::string::npos)
        << r.err;
  }
}

TEST_F(Build, GivesBackWhatWireframeWrote) {
  convertRig();
  ASSERT_EQ(run("wireframe face.sweep -o face.wire.json").code, 0);
  ASSERT_EQ(run("build face.wire.json -o again.sweep").code, 0);
  const Rig a = face("face.sweep"), b = face("again.sweep");
  ASSERT_EQ(a.surface.wireframe().patches.size(), b.surface.wireframe().patches.size());
  ASSERT_EQ(a.targets.size(), b.targets.size());
  const double diagonal = 9;  // of the sheet
  for (std::size_t t = 0; t < a.targets.size(); ++t) {
    Weights weights(a.targets.size());
    weights[t] = 1;
    const auto x = blend(a, weights), y = blend(b, weights);
    for (Index p = 0; p < a.surface.patchCount(); ++p)
      for (double share : {0.0, 0.37, 1.0}) {
        const Site site{p, share * a.surface.edgesU(p), 0.6 * a.surface.edgesV(p)};
        EXPECT_LT(norm(a.surface.evaluate(x, site) - b.surface.evaluate(y, site)), 1e-9 * diagonal);
      }
  }
}

TEST_F(Build, KeepsTheSourceAndItsMaterialsButForThoseThatTheTextChanged) {
  convertRig();
  ASSERT_EQ(run("wireframe face.sweep -o face.wire.json").code, 0);
  ASSERT_EQ(run("build face.wire.json -o same.sweep --source face.sweep").code, 0);
  folder.file("cube.obj", cube(3));
  ASSERT_EQ(run("convert cube.obj -o cube.sweep --quiet").code, 0);
  EXPECT_TRUE(fails("build face.wire.json -o other.sweep --source cube.sweep", "face.wire.json: "));
  const Rig before = face("face.sweep");
  EXPECT_EQ(face("same.sweep").source.polygons.faceMaterial, before.source.polygons.faceMaterial);

  Json drawing = Json::parse(contents(folder / "face.wire.json"));
  Json& patch = drawing["patches"][0];
  const std::string was = patch["material"];
  patch["material"] = "paint";
  folder.file("painted.wire.json", drawing.dump());
  ASSERT_EQ(run("build painted.wire.json -o painted.sweep --source face.sweep").code, 0);
  const Rig after = face("painted.sweep");
  const auto facesOf = [](const Rig& rig, const std::string& material) {
    const Polygons& faces = rig.source.polygons;
    return std::ranges::count_if(faces.faceMaterial,
                                 [&](Index m) { return m >= 0 && faces.materials[m] == material; });
  };
  const Index quads = after.surface.edgesU(0) * after.surface.edgesV(0);
  EXPECT_EQ(facesOf(after, "paint"), quads);
  EXPECT_EQ(facesOf(after, was), facesOf(before, was) - quads);
  EXPECT_EQ(after.source.polygons.corners, before.source.polygons.corners);
}

// Material names are bytes in an OBJ file, but text in a drawing.
TEST_F(Build, ReadsWhateverWireframeWrote) {
  const std::string tooLong(5000, 'x');
  for (const std::string& name : {std::string("h\xe9"
                                              "ad"),
                                  std::string("a\x01"
                                              "b"),
                                  tooLong}) {
    std::string text = sheet();
    const std::string skin = "usemtl skin", lips = "usemtl lips";
    for (const std::string& line : {skin, lips})
      for (auto at = text.find(line); at != text.npos; at = text.find(line))
        text.replace(at, line.size(), "usemtl " + name);
    folder.file("neutral.obj", text);
    ASSERT_EQ(run("convert neutral.obj -o face.sweep").code, 0);
    EXPECT_EQ(face("face.sweep").source.polygons.materials, std::vector{name});
    ASSERT_EQ(run("wireframe face.sweep -o face.wire.json").code, 0);
    const Outcome built = run("build face.wire.json -o again.sweep");
    EXPECT_EQ(built.code, 0) << built.err;
    EXPECT_TRUE(face("again.sweep").source.polygons.materials.empty());
  }
}

TEST_F(Build, SaysWhereAFileIsWrongAndWritesNothing) {
  folder.file("vase.wire.json", "{\n  \"format\": \"sweepface wireframe 1\",\n  \"nodez\": []\n}");
  EXPECT_TRUE(fails("build vase.wire.json -o vase.sweep", "vase.wire.json, line 3"));
  EXPECT_TRUE(fails("build none.wire.json -o vase.sweep", "none.wire.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "vase.sweep"));
}

}  // namespace
}  // namespace sweepface
