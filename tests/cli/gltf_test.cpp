#include <nlohmann/json.hpp>

#include "cli/tool.hpp"
#include "gltf/glb.hpp"
#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

class GltfSource : public Tool {
 protected:
  void SetUp() override { folder.file("face.glb", smallFace().bytes()); }
  nlohmann::json report(const std::string& arguments) {
    const Outcome r = run(arguments + " --json");
    EXPECT_EQ(r.code, 0) << r.err;
    return r.code == 0 ? nlohmann::json::parse(r.out) : nlohmann::json();
  }
};

TEST_F(GltfSource, BecomesAFaceWithItsTargets) {
  EXPECT_EQ(report("convert face.glb -o face.sweep --tolerance 0.001")["targets"], 2);
  EXPECT_EQ(report("info face.sweep")["targets"], (std::vector<std::string>{"open", "wink"}));
  const auto measured = report("measure face.sweep face.glb");
  ASSERT_EQ(measured["shapes"].size(), 3u);
  EXPECT_LE(measured["worst"]["distanceMax"], 0.001);
  ASSERT_EQ(run("export face.sweep -o open.obj --weights open=1").code, 0);
  std::vector<Vec3> open = sheetPositions();
  for (std::size_t v = 0; v < open.size(); ++v) open[v] += openDeltas()[v];
  EXPECT_LE(largestDistance(mesh("open.obj").positions, open), 0.001);
}

TEST_F(GltfSource, ItsSceneIsKeptUnlessTheFaceIsToBeBare) {
  const auto told = report("convert face.glb -o face.sweep --tolerance 0.1");
  EXPECT_EQ(report("convert face.glb -o bare.sweep --tolerance 0.1 --bare")["sceneBytes"], 0);
  const auto whole = report("info face.sweep"), bare = report("info bare.sweep");
  const std::string scene = parse(smallFace())->scene;
  EXPECT_EQ(told["sceneBytes"], scene.size() + 2);
  EXPECT_EQ(whole["parts"]["scene"], scene.size() + 2);
  EXPECT_FALSE(bare["parts"].contains("scene"));
  EXPECT_NE(contents(folder / "face.sweep").find(scene), std::string::npos);
  EXPECT_EQ(whole["bytes"], bare["bytes"].get<std::size_t>() + scene.size() + 2 + 12);
  EXPECT_NE(
      run("convert face.glb -o face.sweep --tolerance 0.1")
          .out.find(fmt::format("{} of them are what face.glb holds besides", scene.size() + 2)),
      std::string::npos);
}

// What is left out need not be sound, and nor need what meshes are only compared with.
TEST_F(GltfSource, ItsSceneIsCheckedOnlyWhereItIsKept) {
  Glb glb = smallFace();
  glb.json["cameras"] = nlohmann::json::array();
  glb.json["nodes"][0]["camera"] = 7;
  folder.file("bad.glb", glb.bytes());
  EXPECT_TRUE(fails("convert bad.glb -o face.sweep", "'camera' is 7"));
  EXPECT_EQ(run("convert bad.glb -o face.sweep --bare").code, 0);
  EXPECT_EQ(run("convert bad.glb -o face.sweep --strip scene").code, 0);
  EXPECT_EQ(run("measure face.sweep bad.glb").code, 0);
}

TEST_F(GltfSource, HasWeightsOf16BitsWherePacked) {
  Glb glb = smallFace();
  std::vector<float> shares;
  for (int v = 0; v < 9; ++v) shares.insert(shares.end(), {0.7f, 0.2f, 0.1f, 0});
  glb.primitive()["attributes"]["WEIGHTS_0"] =
      glb.addAccessor(glb.addView(bytesOf(shares)), 5126, "VEC4", 9);
  folder.file("face.glb", glb.bytes());
  const auto written = [&](const std::string& options) {
    EXPECT_EQ(run("convert face.glb -o face.sweep --tolerance 0.1 " + options).code, 0);
    EXPECT_EQ(run("export face.sweep -o out.glb").code, 0);
    const Written out(contents(folder / "out.glb"));
    const std::size_t weights = out.attribute("WEIGHTS_0");
    EXPECT_NEAR(out.numbers(weights)[0], 0.7, 1e-4);
    return out.json["accessors"][weights]["componentType"].get<int>();
  };
  EXPECT_EQ(written(""), 5126);
  EXPECT_EQ(written("--pack"), 5123);
  EXPECT_EQ(written("--max-bytes 2000"), 5123);
}

TEST_F(GltfSource, ItsSceneGoesWithItsOrder) {
  const std::string command = "convert face.glb -o bare.sweep --tolerance 0.1 -q ";
  const Outcome r = run(command + "--strip order");
  EXPECT_EQ(r.code, 0);
  EXPECT_TRUE(r.err.starts_with("sweepface: warning: What face.glb holds besides")) << r.err;
  EXPECT_FALSE(report("info bare.sweep")["parts"].contains("scene"));
  EXPECT_EQ(run("export bare.sweep -o out.glb").code, 0);
  EXPECT_EQ(run(command + "--strip order,scene").err, "");
  EXPECT_EQ(run(command + "--strip order --bare").err, "");
}

TEST_F(GltfSource, IsRefusedWhereItsSceneAloneTakesMoreThanIsAllowed) {
  const std::string command = "convert face.glb -o face.sweep --tolerance 0.1 --max-bytes 20";
  EXPECT_TRUE(fails(command, "What face.glb holds besides the face takes "));
  EXPECT_EQ(run(command + "00").code, 0);
}

/// The face is the mesh 'head', and 'hat' has none of its targets.
TEST_F(GltfSource, MayBeSomeOfItsMeshes) {
  Glb glb = smallFace();
  Json hat = glb.primitive();
  hat.erase("targets");
  glb.add("meshes", {{"name", "hat"}, {"primitives", Json::array({hat})}});
  glb.add("nodes", {{"name", "Hat"}, {"mesh", 1}, {"translation", {0, 4, 0}}});
  folder.file("face.glb", glb.bytes());
  const std::string both = " --mesh head --mesh Hat ", made = "convert face.glb -o face.sweep";
  EXPECT_EQ(report(made + " --tolerance 0.1")["vertices"], 9);
  EXPECT_EQ(report(made + " --tolerance 0.1 --mesh head")["vertices"], 9);
  EXPECT_EQ(report(made + " --tolerance 0.1" + both)["vertices"], 18);
  EXPECT_TRUE(fails("measure face.sweep face.glb", "converted from, chosen and"));
  EXPECT_EQ(run("measure face.sweep face.glb" + both).code, 0);
  EXPECT_EQ(run("render face.sweep -o a.png --size 64x64 --compare face.glb" + both).code, 0);
  EXPECT_EQ(run("report face.sweep face.glb -o a.html --no-tolerances -q" + both).code, 0);
  EXPECT_TRUE(fails("render face.sweep -o a.png --mesh head", "--mesh requires --compare", 2));
}

TEST_F(GltfSource, IsRefusedWithoutAMeshOfTheName) {
  EXPECT_TRUE(fails("convert face.glb -o face.sweep --mesh haed",
                    "face.glb: no object with meshes and no mesh is named 'haed'; there are "
                    "'head'."));
  EXPECT_TRUE(fails("convert face.glb -o face.sweep --mesh head hat",
                    "name it without hat, or with --mesh before each mesh."));
  EXPECT_TRUE(fails("report face.sweep -o a.html --mesh head", "--mesh requires NEUTRAL", 2));
  EXPECT_TRUE(fails("convert face.glb -o face.sweep --mesh ''", "--mesh: This is empty", 2));
  folder.file("quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_TRUE(fails("convert quad.obj -o face.sweep --mesh quad",
                    "quad.obj has a single mesh, which is the face; choose meshes by their names "
                    "only from a .glb, .gltf or .vrm."));
}

TEST_F(GltfSource, MayBeAnAvatar) {
  folder.file("face.VRM", smallFace().bytes());
  EXPECT_EQ(report("convert face.VRM -o face.sweep --tolerance 0.1")["targets"], 2);
}

TEST_F(GltfSource, MayHaveItsBufferBesideIt) {
  folder.file("sub/face.gltf", smallFace().text("face.bin"));
  EXPECT_TRUE(fails("convert sub/face.gltf -o face.sweep", "sub/face.gltf: buffer 0: the file "));
  folder.file("sub/face.bin", smallFace().binary);
  EXPECT_EQ(report("convert sub/face.gltf -o face.sweep --tolerance 0.1")["targets"], 2);
  folder.file("face.GLTF", smallFace().text("face.bin"));
  folder.file("face.bin", smallFace().binary);
  EXPECT_EQ(report("convert face.GLTF -o face.sweep --tolerance 0.1")["targets"], 2);
}

TEST_F(GltfSource, WarnsOfWhatIsNotCarriedOver) {
  Glb glb = smallFace();
  glb.json["images"] = {{{"uri", "missing.png"}}};
  folder.file("face.glb", glb.bytes());
  const Outcome r = run("convert face.glb -o face.sweep --tolerance 0.1 -q");
  EXPECT_EQ(r.code, 0);
  EXPECT_TRUE(r.err.starts_with("sweepface: warning: Image 0 stays a reference")) << r.err;
  for (const char* without : {"--bare", "--strip scene"})
    EXPECT_EQ(run(fmt::format("convert face.glb -o face.sweep --tolerance 0.1 -q {}", without)).err,
              "");
}

TEST_F(GltfSource, WarnsOfFlatShadingWithAndWithoutAScene) {
  Glb glb;
  std::vector<Vec3> positions, normals;
  std::vector<std::uint16_t> indices;
  for (const std::uint16_t corner : sheetIndices()) {
    normals.push_back(positions.size() / 3 % 2 == 0 ? Vec3{0, 0, 1} : Vec3{1, 0, 0});
    indices.push_back(static_cast<std::uint16_t>(positions.size()));
    positions.push_back(sheetPositions()[corner]);
  }
  const Json attributes = {{"POSITION", glb.addVectors(positions)},
                           {"NORMAL", glb.addVectors(normals)}};
  const Json primitive = {{"attributes", attributes}, {"indices", glb.addIndices(indices)}};
  glb.add("meshes", {{"primitives", Json::array({primitive})}});
  folder.file("flat.glb", glb.bytes());
  for (const std::string options : {"", " --bare", " --strip order"}) {
    const Outcome r = run("convert flat.glb -o flat.sweep --tolerance 0.01" + options);
    EXPECT_NE(r.err.find("places the vertices have normals"), std::string::npos) << r.err;
  }
}

TEST_F(GltfSource, WarnsOfAFaceWithoutExpressions) {
  Glb glb = smallFace();
  for (auto& mesh : glb.json["meshes"])
    for (auto& primitive : mesh["primitives"]) primitive.erase("targets");
  folder.file("face.glb", glb.bytes());
  const Outcome r = run("convert face.glb -o face.sweep --tolerance 0.1 -q --bare");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("face.glb has no morph targets"), std::string::npos) << r.err;
}

TEST_F(GltfSource, StandsAlone) {
  makeRig();
  EXPECT_TRUE(fails("convert face.glb targets -o face.sweep",
                    "face.glb holds a face and its expressions; name it without targets."));
  EXPECT_TRUE(fails("measure face.glb face.glb", "face.glb is a file of meshes, not a face"));
  EXPECT_TRUE(fails("convert neutral.obj face.glb -o face.sweep",
                    "face.glb cannot be read as one mesh of several"));
}

TEST_F(GltfSource, IsNotOverwritten) {
  EXPECT_TRUE(fails("convert face.glb -o face.glb", "it is what is read"));
  EXPECT_TRUE(fails("convert face.glb -o other.glb", "must end in"));
  EXPECT_TRUE(fails("convert face.glb -o other.gltf", "must end in"));
}

TEST_F(GltfSource, ThatIsBrokenIsNamed) {
  folder.file("face.glb", smallFace().bytes().substr(0, 100));
  EXPECT_TRUE(fails("convert face.glb -o face.sweep", "face.glb: its header says"));
}

}  // namespace
}  // namespace sweepface
