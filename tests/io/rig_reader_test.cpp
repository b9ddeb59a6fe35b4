#include <array>
#include <gtest/gtest.h>

#include "sweepface/io.hpp"

#include "io/temporary_folder.hpp"

namespace sweepface {
namespace {

namespace fs = std::filesystem;
using testing::failsWith;
using testing::TemporaryFolder;

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string trianglePly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 2 0\n3 0 1 2\n";

/// A triangle whose third vertex is at the given height.
std::string raised(int height) {
  return "v 0 0 0\nv 1 0 0\nv 0 1 " + std::to_string(height) + "\nf 1 2 3\n";
}

class RigReader : public ::testing::Test {
 protected:
  auto read(std::vector<fs::path> targets) { return readRig(neutral, targets); }

  std::vector<std::string> names(const std::vector<fs::path>& targets) {
    const auto rig = read(targets);
    EXPECT_TRUE(rig.has_value()) << rig.error().message;
    std::vector<std::string> found;
    if (rig)
      for (const MeshTarget& target : rig->targets) found.push_back(target.name);
    return found;
  }

  TemporaryFolder folder;
  fs::path neutral = folder.file("rig/neutral.obj", triangle);
};

TEST_F(RigReader, NamesTargetsAfterTheirFiles) {
  const auto rig =
      read({folder.file("jawOpen.obj", raised(5)), folder.file("smile.v2.PLY", trianglePly)});
  ASSERT_TRUE(rig.has_value()) << rig.error().message;
  EXPECT_EQ(rig->neutral.positions.size(), 3u);
  EXPECT_EQ(rig->neutral.polygons.faceCount(), 1);
  ASSERT_EQ(rig->targets.size(), 2u);
  EXPECT_EQ(rig->targets[0].name, "jawOpen");
  EXPECT_EQ(rig->targets[0].positions[2], (Vec3{0, 1, 5}));
  EXPECT_EQ(rig->targets[1].name, "smile.v2");
  EXPECT_EQ(rig->targets[1].positions[2], (Vec3{0, 2, 0}));
}

TEST_F(RigReader, TakesAFolderForTheMeshesInItByName) {
  for (const auto* name :
       {"rig/b.obj", "rig/a.PLY.obj", "rig/C.OBJ", "rig/._b.obj", "rig/deep/d.obj"})
    folder.file(name, triangle);
  folder.file("rig/a.ply", trianglePly);
  folder.file("rig/notes.txt", "not a mesh");
  fs::create_directory(folder / "rig/x.obj");
  EXPECT_EQ(names({neutral.parent_path()}), (std::vector<std::string>{"C", "a.PLY", "a", "b"}));
}

TEST_F(RigReader, KeepsTheOrderOfWhatItIsGiven) {
  const fs::path z = folder.file("z.obj", triangle);
  folder.file("more/a.obj", triangle);
  EXPECT_EQ(names({z, folder / "more", folder.file("b.obj", triangle)}),
            (std::vector<std::string>{"z", "a", "b"}));
}

TEST_F(RigReader, MayHaveNoTargets) { EXPECT_TRUE(names({}).empty()); }

TEST_F(RigReader, NeedsOnlyThePositionsOfATarget) {
  EXPECT_EQ(names({folder.file("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")}).size(), 1u);
  EXPECT_EQ(names({folder.file("odd.obj", triangle + "vt nan\n")}).size(), 1u);
}

TEST_F(RigReader, ReportsEachTargetFile) {
  for (int i = 0; i < 20; ++i) folder.file("many/t" + std::to_string(i) + ".obj", raised(i));
  const std::array<fs::path, 1> targets{folder / "many"};
  std::vector<std::size_t> reported;
  const auto rig = readRig(neutral, targets, [&](std::size_t done, std::size_t total) {
    EXPECT_EQ(total, 20u);
    reported.push_back(done);
  });
  ASSERT_TRUE(rig.has_value());
  ASSERT_EQ(reported.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(reported[i], i + 1);
  for (const MeshTarget& target : rig->targets)
    EXPECT_EQ(target.name, "t" + std::to_string(int(target.positions[2].z)));
}

TEST_F(RigReader, SaysBothCountsOfATargetThatDiffers) {
  const fs::path more = folder.file("more.obj", triangle + "v 2 2 2\n");
  EXPECT_TRUE(failsWith(read({more}), {"more.obj has 4 vertices", "neutral.obj has 3"}));
  const fs::path faces = folder.file("faces.obj", triangle + "f 3 2 1\n");
  EXPECT_TRUE(failsWith(read({faces}), {"faces.obj has 2 faces", "neutral.obj has 1"}));
  const fs::path one = folder.file("one.obj", "v 0 0 0\n");
  EXPECT_TRUE(failsWith(read({one}), {"one.obj has 1 vertex but"}));
}

TEST_F(RigReader, ReportsTheFirstOfManyErrors) {
  std::vector<fs::path> targets;
  for (int i = 0; i < 20; ++i)
    targets.push_back(
        folder.file("bad" + std::to_string(i) + ".obj", i < 3 ? triangle : "v 0 0\n"));
  EXPECT_TRUE(failsWith(read(targets), {"bad3.obj, line 1"}));
}

TEST_F(RigReader, RefusesTwoTargetsOfOneName) {
  const fs::path a = folder.file("a/smile.obj", triangle),
                 b = folder.file("b/smile.ply", trianglePly);
  EXPECT_TRUE(failsWith(read({a, b}), {"a/smile.obj", "b/smile.ply", "both named 'smile'"}));
}

TEST_F(RigReader, RefusesAFileNamedTwice) {
  const fs::path smile = folder.file("rig/smile.obj", triangle);
  EXPECT_TRUE(failsWith(read({neutral}), {"neutral.obj is the neutral; leave it out"}));
  EXPECT_TRUE(failsWith(read({smile, smile}), {"smile.obj is named twice; name it once"}));
  EXPECT_TRUE(failsWith(read({smile, folder / "rig"}), {"smile.obj is named twice"}));
}

TEST_F(RigReader, RefusesTargetsWithoutAName) {
  EXPECT_TRUE(failsWith(read({folder.file(".obj", triangle)}), {"no name before its extension"}));
  EXPECT_TRUE(failsWith(read({folder.file(" .obj", triangle)}), {"no name before its extension"}));
}

TEST_F(RigReader, RefusesNamesThatNoFileHolds) {
#ifdef _WIN32  // knows neither
  GTEST_SKIP();
#endif
  for (const char* name : {"a\nb.obj", "sm\xeele.obj"})
    EXPECT_TRUE(failsWith(read({folder.file(name, triangle)}),
                          {"The name of the target", ".obj", "rename the file"}));
}

TEST_F(RigReader, SaysWhichFileIsMissingOrNoMesh) {
  EXPECT_TRUE(failsWith(read({folder / "none.obj"}), {"none.obj", "no such file"}));
  EXPECT_TRUE(
      failsWith(read({folder.file("a.fbx", "x")}), {"a.fbx", "neither an .obj nor a .ply"}));
  fs::create_directory(folder / "empty");
  EXPECT_TRUE(failsWith(read({folder / "empty"}), {"empty", "no .obj or .ply files"}));
  EXPECT_TRUE(failsWith(readRig(folder / "no.obj", {}), {"no.obj", "no such file"}));
  EXPECT_TRUE(failsWith(readRig(folder / "rig", {}), {"rig is a folder; name the mesh"}));
}

TEST_F(RigReader, SaysThatThereIsNothingOfAName) {
  EXPECT_TRUE(
      failsWith(read({folder / "expresions"}), {"There is no file or folder", "expresions;"}));
  EXPECT_TRUE(failsWith(read({folder / "expresions/"}), {"There is no file or folder"}));
  EXPECT_TRUE(failsWith(readRig(folder / "neutral", {}), {"There is no file or folder"}));
  EXPECT_TRUE(failsWith(read({""}), {"name of a mesh is empty"}));
  EXPECT_TRUE(failsWith(readRig("", {}), {"name of a mesh is empty"}));
}

TEST_F(RigReader, NeedsFacesOfTheNeutral) {
  const fs::path points = folder.file("points.obj", "v 0 0 0\n");
  EXPECT_TRUE(failsWith(readRig(points, {}), {"points.obj", "no faces"}));
}

TEST(MeshReader, TellsFormatsByExtension) {
  const TemporaryFolder folder;
  EXPECT_TRUE(readMesh(folder.file("a.Obj", triangle)).has_value());
  EXPECT_TRUE(readMesh(folder.file("a.PLY", trianglePly)).has_value());
  EXPECT_TRUE(failsWith(readMesh(folder.file("a.stl", "x")), {"a.stl", "neither"}));
  EXPECT_TRUE(failsWith(readMesh(folder.file("a.glb", "x")), {"a.glb", "name it alone"}));
  EXPECT_TRUE(failsWith(readMesh(folder.file("b.ply", triangle)), {"b.ply", "'ply'"}));
  EXPECT_TRUE(failsWith(readMesh(folder / "none.obj"), {"none.obj", "no such file"}));
}

// Two squares side by side, and the same cut into triangles.
const std::string corners = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n";

/// Some exporters give every triangle vertices of its own.
TEST_F(RigReader, JoinsTrianglesOfDoubledVertices) {
  const std::string apart =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
  const auto facesOf = [&](const std::string& faces) {
    const auto source = readSource(folder.file("face.obj", apart + faces), {});
    return source ? source->rig.neutral.polygons.faceCount() : -1;
  };
  EXPECT_EQ(facesOf("f 1 2 3\nf 4 5 6\n"), 1);
  EXPECT_EQ(facesOf("f 1/1 2/2 3/3\nf 4/1 5/3 6/4\n"), 1);
  EXPECT_EQ(facesOf("f 1/1 2/2 3/3\nf 4/2 5/3 6/4\n"), 2) << "a seam of the texture";
}

TEST_F(RigReader, WarnsOfColoursThatAreLeftOut) {
  const auto warnings = [&](const std::string& name, const std::string& text) {
    return readSource(folder.file(name, text), {}).value().faceWarnings;
  };
  const std::string faces = "f 1 2 3\n";
  EXPECT_TRUE(warnings("a.obj", "v 0 0 0 1\nv 1 0 0 1\nv 1 1 0 1\n" + faces).empty());
  const auto left = warnings("a.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\n" + faces);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_TRUE(left[0].starts_with("The colours of vertices in ") && left[0].contains("a.obj"));
  const std::string start =
                        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                        "property float y\nproperty float z\n",
                    end = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_TRUE(warnings("a.ply", start + end + "0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n").empty());
  EXPECT_EQ(warnings("a.ply",
                     start + "property uchar red\n" + end + "0 0 0 9\n1 0 0 9\n1 1 0 9\n3 0 1 2\n")
                .size(),
            1u);
}

TEST_F(RigReader, JoinsTrianglesToQuadsWhereThereIsNothingElse) {
  const auto facesOf = [&](const std::string& faces) {
    const auto source = readSource(folder.file("face.obj", corners + faces), {});
    return source ? source->rig.neutral.polygons.faceCount() : -1;
  };
  EXPECT_EQ(facesOf("f 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\n"), 2);
  EXPECT_EQ(facesOf("f 1 2 5 4\nf 2 3 6\nf 2 6 5\n"), 3) << "whoever has quads means them";
}

}  // namespace
}  // namespace sweepface
