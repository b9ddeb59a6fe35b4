#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"

#include "cli/tool.hpp"
#include "codec/rigs.hpp"

namespace sweepface {
namespace {

using namespace testing;
using Export = Tool;
using Wires = Tool;

TEST_F(Export, LeavesNothingBehindWhereItIsKilled) {
  convertRig();
  const int probe = open(std::filesystem::path(folder / ".").c_str(), O_TMPFILE | O_WRONLY, 0600);
  if (probe < 0) GTEST_SKIP() << "no files without a name in this file system";
  close(probe);
  // The system kills a process that writes a file beyond the limit.
  const std::string command = fmt::format(
      "cd '{}' && ulimit -f 8 && '{}' export face.sweep -o big.obj --lod 16 2>/dev/null",
      (folder / ".").string(), SWEEPFACE_TOOL);
  EXPECT_NE(std::system(command.c_str()), 0);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "."))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".sweepface")) << entry.path();
  EXPECT_FALSE(std::filesystem::exists(folder / "big.obj"));
}

TEST_F(Export, WritesTheSourcesOwnPolygons) {
  convertRig();
  EXPECT_EQ(run("export face.sweep -o out.obj").out, "out.obj: 30 faces\n");
  EXPECT_EQ(run("export face.sweep -o out.obj --quiet").out, "");
  const PolygonMesh in = mesh("neutral.obj"), out = mesh("out.obj");
  EXPECT_EQ(out.polygons.faceStart, in.polygons.faceStart);
  EXPECT_EQ(out.polygons.corners, in.polygons.corners);
  EXPECT_EQ(out.polygons.cornerTexcoords, in.polygons.cornerTexcoords);
  EXPECT_EQ(out.polygons.texcoords.size(), in.polygons.texcoords.size());
  EXPECT_EQ(out.polygons.materials, in.polygons.materials);
  EXPECT_EQ(out.polygons.faceMaterial, in.polygons.faceMaterial);
  EXPECT_EQ(out.polygons.groups, in.polygons.groups);
  EXPECT_EQ(out.polygons.faceGroup, in.polygons.faceGroup);
  EXPECT_EQ(out.polygons.materialFiles, in.polygons.materialFiles);
  EXPECT_NE(contents(folder / "out.obj").find("\nvn "), std::string::npos);
  ASSERT_EQ(run("export face.sweep -o same.obj --source-order --quiet").code, 0);
  EXPECT_EQ(contents(folder / "same.obj"), contents(folder / "out.obj"));
}

TEST_F(Export, WritesAFolderThatConvertReads) {
  convertRig();
  const Outcome r = run("export face.sweep -o all/meshes");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.out, "all/meshes: 2 targets, 30 faces each\n");
  for (const std::string command :
       {"-o one.obj", "-o all/meshes/neutral.obj", "-o two.obj --weights smile=1"})
    ASSERT_EQ(run("export face.sweep --quiet " + command).code, 0);
  const auto same = [&](const char* a, const char* b) {
    return contents(folder / a) == contents(folder / b) && !contents(folder / a).empty();
  };
  EXPECT_TRUE(same("all/meshes/neutral.obj", "one.obj"));
  EXPECT_TRUE(same("all/meshes/expressions/smile.obj", "two.obj"));
  const auto targetsOf = [&](const char* file) {
    std::vector<std::string> names;
    const Rig rig = decode(contents(folder / file), file).value();
    for (const Target& t : rig.targets) names.push_back(t.name);
    return names;
  };
  const std::string meshes = " all/meshes/neutral.obj all/meshes/expressions";
  ASSERT_EQ(run("convert" + meshes + " -o again.sweep --quiet").code, 0);
  EXPECT_EQ(targetsOf("again.sweep"), targetsOf("face.sweep"));
  const Outcome compared = run("measure face.sweep" + meshes + " --json");
  EXPECT_LT(nlohmann::json::parse(compared.out)["worst"]["distanceMax"], 1e-6);
}

TEST_F(Export, WritesAFolderOfFinerMeshes) {
  convertRig();
  ASSERT_EQ(run("export face.sweep -o fine --lod 2 --quiet").code, 0);
  ASSERT_EQ(run("export face.sweep -o fine.obj --lod 2 --weights jawOpen=1 --quiet").code, 0);
  EXPECT_EQ(contents(folder / "fine/expressions/jawOpen.obj"), contents(folder / "fine.obj"));
}

TEST_F(Export, CallsFilesAsFarAsTheyMayBeCalled) {
  convertRig();
  Rig rig = decode(contents(folder / "face.sweep"), "face").value();
  rig.targets[0].name = "a/b", rig.targets[1].name = ".hidden";
  folder.file("odd.sweep", encode(rig));
  const Outcome r = run("export odd.sweep -o all");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.err,
            "sweepface: warning: The target 'a/b' is in a_b.obj.\n"
            "sweepface: warning: The target '.hidden' is in _hidden.obj.\n");
  for (const char* file : {"a_b.obj", "_hidden.obj"})
    EXPECT_TRUE(std::filesystem::exists(folder / "all/expressions" / file));
}

TEST_F(Export, CutsNamesThatAreTooLongForFiles) {
  convertRig();
  Rig rig = decode(contents(folder / "face.sweep"), "face").value();
  std::string name;
  for (int k = 0; k < 130; ++k) name += "ö";
  rig.targets[0].name = name;
  folder.file("long.sweep", encode(rig));
  const Outcome r = run("export long.sweep -o all");
  EXPECT_EQ(r.code, 0) << r.err;
  const std::string cut = name.substr(0, 250) + ".obj";  // a letter has two bytes
  EXPECT_NE(r.err.find("' is in " + cut), std::string::npos) << r.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "all/expressions" / cut));
}

TEST_F(Export, KeepsTheFaceThatItReads) {
  convertRig();
  folder.file("meshes/neutral.obj", contents(folder / "face.sweep"));
  EXPECT_TRUE(fails("export meshes/neutral.obj -o meshes", "it is what is read"));
  EXPECT_TRUE(contents(folder / "meshes/neutral.obj").starts_with("SWEEPFC"));
}

TEST_F(Export, RefusesFoldersThatCannotBeMeant) {
  convertRig();
  EXPECT_TRUE(fails("export face.sweep -o all --weights smile=1", "leave --weights out"));
  EXPECT_TRUE(fails("export face.sweep -o all --vertices 9", "is for one file"));
  EXPECT_TRUE(fails("export face.sweep -o all --combine", "A folder holds all targets"));
  EXPECT_TRUE(fails("export face.sweep -o all --quantize", "is for .glb files"));
  EXPECT_TRUE(fails("export face.sweep -o face.sweep/all", "Cannot make the folder"));
  folder.file("file", "");
  for (const char* file : {"file", "file/"})
    EXPECT_TRUE(fails(std::string("export face.sweep -o ") + file, "a file is in its place"));
  Rig rig = decode(contents(folder / "face.sweep"), "face").value();
  rig.targets[0].name = "a/b", rig.targets[1].name = "a_b";
  folder.file("odd.sweep", encode(rig));
  EXPECT_TRUE(fails("export odd.sweep -o all", "The targets 'a/b' and 'a_b' would both be in"));
  EXPECT_FALSE(std::filesystem::exists(folder / "all"));
}

TEST_F(Export, GuessesWhichTargetIsMeant) {
  convertRig();
  const std::string command = "export face.sweep -o out.obj --weights ";
  EXPECT_TRUE(fails(command + "jaw_open=1",
                    "--weights: Did you mean 'jawOpen'? There is no target "
                    "named 'jaw_open'; its targets are jawOpen, smile."));
  EXPECT_TRUE(fails(command + "jawOpen=1,smle=0.5", "Did you mean 'smile'? There is no target"));
  EXPECT_TRUE(fails(command + "'jawOpen=1, smle '", "Did you mean 'smile'? There is no target"));
  EXPECT_TRUE(fails(command + "frown=1", "--weights: There is no target named 'frown'"));
  EXPECT_TRUE(fails(command + "smile=1000001", "--weights: The weight of 'smile' must be"));
}

TEST_F(Export, RefusesBudgetsThatAreNone) {
  convertRig();
  for (const char* budget : {"--error nan", "--edge-length inf", "--error -1"}) {
    const Outcome r = run(std::string("export face.sweep -o out.obj ") + budget);
    EXPECT_EQ(r.code, 2) << budget;
    EXPECT_NE(r.err.find("finite number greater than 0"), std::string::npos) << r.err;
  }
  EXPECT_EQ(run("export face.sweep -o out.obj --source-order --error 0.1").code, 2);
  EXPECT_NE(run("export face.sweep -o ''").err.find("the output is empty"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.obj"));
}

TEST_F(Export, NamesSayWhatIsWritten) {
  convertRig();
  EXPECT_TRUE(fails("export face.sweep -o smile.png", "must end in .obj or .glb"));
  EXPECT_TRUE(fails("wireframe face.sweep -o lines.glb", "must end in .obj or .json"));
  EXPECT_TRUE(fails("render face.sweep -o view.svg", "must end in .png"));
  EXPECT_TRUE(fails("report face.sweep -o page.pdf", "must end in .html"));
  EXPECT_TRUE(fails("convert neutral.obj -o face.json", "must end in .sweep"));
  EXPECT_TRUE(fails("animate face.sweep --to smile=1 -o move.mp4",
                    "must end in .glb, .usda, .usdz or .csv"));
  EXPECT_TRUE(fails("plot face.sweep --to smile=1 -o plot.png", "must end in .svg"));
  EXPECT_EQ(run("export face.sweep -o SMILE.OBJ --quiet").code, 0);
}

TEST_F(Export, ReachesNoFileThroughAnotherNameOfAStream) {
  convertRig();
  EXPECT_TRUE(fails("export face.sweep --quiet -o /dev/fd/1", "it leads into a file; name that"));
  for (int time : {1, 2})  // no stream, whatever folder leads there
    EXPECT_EQ(run("export face.sweep --quiet -o /proc/self/cwd/out.obj").code, 0) << time;
}

TEST_F(Export, RefusesWhatAnEmptyVariableLeaves) {
  convertRig();
  for (const std::string command :
       {"export face.sweep -o out.obj --limits ''", "convert neutral.obj -o f.sweep --strip ','",
        "render face.sweep -o out.png --size ' '", "render face.sweep -o out.png --close ''",
        "animate face.sweep -o out.glb --to jawOpen --regions ''",
        "animate face.sweep -o out.glb --to jawOpen --keys ''",
        "build face.wire.json -o f.sweep --source ''", "edit face.sweep -o f.sweep --ribbon ''",
        "edit face.sweep -o f.sweep --target ''", "report face.sweep -o r.html --box ''",
        "plot face.sweep -o p.svg --to jawOpen --weight ''"})
    EXPECT_TRUE(fails(command, "This is empty", 2)) << command;
}

TEST_F(Export, BlendsLinearly) {
  convertRig();
  const auto exported = [&](const std::string& weights) {
    EXPECT_EQ(run("export face.sweep -o out.obj --weights '" + weights + "'").code, 0);
    return mesh("out.obj").positions;
  };
  const auto neutral = exported(""), open = exported("jawOpen"), smile = exported("smile=1"),
             both = exported("jawOpen=+0.5,smile=-2");
  for (std::size_t v = 0; v < neutral.size(); ++v) {
    const Vec3 expected = neutral[v] + 0.5 * (open[v] - neutral[v]) - 2 * (smile[v] - neutral[v]);
    EXPECT_LE(norm(both[v] - expected), 1e-12);
  }
}

TEST_F(Export, WritesAMeshWithinABudget) {
  convertRig();
  std::size_t before = 0;
  for (const int most : {60, 500}) {
    ASSERT_EQ(run("export face.sweep -o out.obj --vertices " + std::to_string(most)).code, 0);
    const PolygonMesh out = mesh("out.obj");
    EXPECT_LE(out.positions.size(), static_cast<std::size_t>(most));
    EXPECT_GT(out.positions.size(), before);
    EXPECT_FALSE(out.polygons.cornerTexcoords.empty());
    before = out.positions.size();
  }
  EXPECT_EQ(run("export face.sweep -o out.obj --error 0.01").code, 0);
  EXPECT_EQ(run("export face.sweep -o out.obj --edge-length 0.5").err, "");
  for (const char* option : {"--edge-length", "--error"}) {
    const Outcome r = run(fmt::format("export face.sweep -o out.obj {} 1e-9", option));
    EXPECT_EQ(r.code, 0);
    EXPECT_NE(r.err.find(fmt::format("may still be coarser than {} asks", option)),
              std::string::npos)
        << r.err;
  }
  EXPECT_NE(run("export face.sweep -o out.obj --vertices 2").code, 0);
  for (const char* count : {"60.5", "0", "16777217"})
    EXPECT_TRUE(fails(std::string("export face.sweep -o out.obj --vertices ") + count,
                      "a whole number from 1 to 16777216", 2));
  EXPECT_NE(run("export face.sweep -o folder --vertices 500").code, 0);
  EXPECT_NE(run("export face.sweep -o out.obj --vertices 500 --lod 2").code, 0);
}

TEST_F(Export, KeepsLooseVertices) {
  folder.file("neutral.obj", sheet() + "v 9 9 9\n");
  ASSERT_EQ(run("convert neutral.obj -o face.sweep --tolerance 0.01").code, 0);
  ASSERT_EQ(run("export face.sweep -o out.obj").code, 0);
  const auto positions = mesh("out.obj").positions;
  ASSERT_EQ(positions.size(), 43u);
  EXPECT_EQ(positions.back(), (Vec3{9, 9, 9}));
}

// A face of 160,000 quads.
TEST_F(Export, RefusesMoreQuadsThanMemoryHolds) {
  folder.file("sheet.wire.json", R"({
    "format": "sweepface wireframe 1",
    "nodes": [{"name": "a", "at": [0, 0, 0]}, {"name": "b", "at": [1, 0, 0]},
              {"name": "c", "at": [1, 1, 0]}, {"name": "d", "at": [0, 1, 0]}],
    "curves": [{"name": "south", "from": "a", "to": "b", "edges": 400},
               {"name": "east", "from": "b", "to": "c", "edges": 400},
               {"name": "north", "from": "d", "to": "c"}, {"name": "west", "from": "a", "to": "d"}],
    "patches": [{"name": "all", "sides": ["south", "east", "-north", "-west"]}],
    "expressions": [{"name": "longer", "moves": {"east": [1, 0, 0]}}]
  })");
  const Outcome built = run("build sheet.wire.json -o sheet.sweep");
  ASSERT_EQ(built.code, 0) << built.err;
  for (const std::string command :
       {"export sheet.sweep -o out.obj", "export sheet.sweep -o out.glb",
        "animate sheet.sweep --to longer=1 -o out", "animate sheet.sweep --to longer=1 -o out.glb",
        "render sheet.sweep -o out.png"}) {
    EXPECT_TRUE(fails(command + " --lod 64", "655.4 million quads")) << command;
    EXPECT_TRUE(fails(command + " --lod 8", "10.2 million quads, of which 8 million are the most"))
        << command;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

/// A file of a few hundred bytes can have a patch of any size.
TEST_F(Export, RefusesAFaceOfMoreQuadsThanMemoryHolds) {
  Rig rig;
  rig.surface = Surface::make(onePatch(3000, 3000)).value();
  rig.neutral.resize(rig.surface.storedCount(), {1, 2, 3});
  const std::string bytes = encode(rig);
  EXPECT_LT(bytes.size(), 1000u);
  folder.file("wide.sweep", bytes);
  for (const std::string command : {"info", "check", "export -o out.obj", "render -o out.png",
                                    "wireframe -o out.json", "report -o out.html"})
    EXPECT_TRUE(fails(command + " wide.sweep",
                      "wide.sweep: its patches have 9.0 million quads, of "
                      "which this program opens at most 8 million"))
        << command;
}

/// How often each directed edge is used.
std::map<std::pair<Index, Index>, int> edgeUses(const Polygons& polygons) {
  std::map<std::pair<Index, Index>, int> uses;
  for (Index f = 0; f < polygons.faceCount(); ++f)
    for (Index k = 0, size = polygons.faceSize(f); k < size; ++k) {
      const Index* face = &polygons.corners[polygons.faceStart[f]];
      ++uses[{face[k], face[(k + 1) % size]}];
    }
  return uses;
}

TEST_F(Export, FinerMeshesStayClosed) {
  folder.file("cube.obj", cube(3));
  ASSERT_EQ(run("convert cube.obj -o face.sweep --tolerance 0.2").code, 0);
  for (const int lod : {1, 2, 5}) {
    ASSERT_EQ(run(fmt::format("export face.sweep -o out.obj --lod {}", lod)).code, 0);
    const PolygonMesh out = mesh("out.obj");
    EXPECT_EQ(out.polygons.faceCount(), 54 * lod * lod);
    EXPECT_EQ(static_cast<int>(out.positions.size()), 54 * lod * lod + 2);
    const auto uses = edgeUses(out.polygons);
    for (const auto& [edge, count] : uses) {
      EXPECT_EQ(count, 1);
      EXPECT_TRUE(uses.contains({edge.second, edge.first}));
    }
  }
}

/// Texture coordinates that are affine on the sheet stay so at every level, so each corner's follow
/// from the source's face alone.
TEST_F(Export, CarriesTextureAndMaterialsOver) {
  convertRig();
  ASSERT_EQ(run("export face.sweep -o out.obj --lod 4").code, 0);
  const PolygonMesh in = mesh("neutral.obj"), out = mesh("out.obj");
  const Polygons& p = out.polygons;
  EXPECT_EQ(p.faceCount(), 30 * 16);
  EXPECT_EQ(p.texcoords.size(), 25u * 21u);
  EXPECT_EQ(std::set(p.materials.begin(), p.materials.end()),
            (std::set<std::string>{"skin", "lips"}));
  EXPECT_EQ(std::set(p.groups.begin(), p.groups.end()), (std::set<std::string>{"row0", "row1"}));
  ASSERT_EQ(p.cornerTexcoords.size(), p.corners.size());
  for (Index f = 0; f < p.faceCount(); ++f) {
    Vec2 middle;
    for (Index c = p.faceStart[f]; c < p.faceStart[f + 1]; ++c) {
      const Vec2 t = p.texcoords[p.cornerTexcoords[c]];
      const Vec3 at = out.positions[p.corners[c]];
      EXPECT_NEAR(6 * t.x, at.x, 0.05);
      EXPECT_NEAR(5 * t.y, at.y / 1.1, 0.05);
      middle = {middle.x + t.x / 4, middle.y + t.y / 4};
    }
    const int row = static_cast<int>(5 * middle.y);
    EXPECT_EQ(p.materials[p.faceMaterial[f]], row % 2 ? "skin" : "lips");
    EXPECT_EQ(p.groups[p.faceGroup[f]], fmt::format("row{}", row / 3));
  }
}

TEST_F(Export, CarriesGroupsAndFacesWithoutTextureOverWithinABudget) {
  folder.file("two.obj",
              "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
              "vt 0 1\ng left\nf 1/1 2/2 5/3 4/4\ng right\nf 2 3 6 5\n");
  ASSERT_EQ(run("convert two.obj -o face.sweep --tolerance 0.01 -q").code, 0);
  ASSERT_EQ(run("export face.sweep -o out.obj --edge-length 0.4").code, 0);
  const PolygonMesh out = mesh("out.obj");
  const Polygons& p = out.polygons;
  ASSERT_EQ(p.cornerTexcoords.size(), p.corners.size());
  std::map<std::string, int> faces;
  for (Index f = 0; f < p.faceCount(); ++f) {
    double x = 0;
    for (Index c = p.faceStart[f]; c < p.faceStart[f + 1]; ++c) {
      const Vec3& at = out.positions[p.corners[c]];
      const Index t = p.cornerTexcoords[c];
      x += at.x / 3;
      EXPECT_EQ(t >= 0, p.groups[p.faceGroup[f]] == "left");
      if (t >= 0) {
        EXPECT_NEAR(p.texcoords[t].x, at.x, 0.02);
      }
    }
    EXPECT_EQ(p.groups[p.faceGroup[f]], x < 1 ? "left" : "right");
    ++faces[p.groups[p.faceGroup[f]]];
  }
  EXPECT_GT(faces["left"], 8);
  EXPECT_GT(faces["right"], 8);
}

TEST_F(Export, HasTrianglesAtCollapsedSides) {
  // A fan of six triangles around a raised middle.
  std::string text = "v 0 0 0.5\n";
  for (int k = 0; k < 6; ++k)
    text += fmt::format("v {} {} 0\n", std::cos(1.0472 * k), std::sin(1.0472 * k));
  for (int k = 0; k < 6; ++k) text += fmt::format("f 1 {} {}\n", k + 2, (k + 1) % 6 + 2);
  const auto fan = parseObj(text, "fan");
  ASSERT_TRUE(fan.has_value()) << fan.error().message;
  ConvertOptions options;
  options.tolerance = 0.05;
  const auto conversion = convert({*fan, {}}, options);
  ASSERT_TRUE(conversion.has_value()) << conversion.error().message;
  folder.file("fan.sweep", encode(conversion->rig));
  ASSERT_EQ(run("export fan.sweep -o fine.obj --lod 2").code, 0);
  const Polygons polygons = mesh("fine.obj").polygons;
  EXPECT_EQ(polygons.faceCount(), 6 * 4);
  int triangles = 0;
  for (Index f = 0; f < polygons.faceCount(); ++f) {
    triangles += polygons.faceSize(f) == 3;
    EXPECT_GE(polygons.faceSize(f), 3);
  }
  EXPECT_EQ(triangles, 6 * 2);
  for (const auto& [edge, count] : edgeUses(polygons)) {
    EXPECT_NE(edge.first, edge.second);
    EXPECT_EQ(count, 1);
  }
}

TEST_F(Export, LeavesTheOldFileWhereItFails) {
  convertRig();
  folder.file("out.obj", "old");
  const std::string face = contents(folder / "face.sweep");
  EXPECT_TRUE(fails("export face.sweep -o out.obj --weights frown=1",
                    "no target named 'frown'; its targets are jawOpen, smile"));
  EXPECT_TRUE(fails("export face.sweep -o out.obj --weights smile=x", "a number within"));
  EXPECT_TRUE(fails("export neutral.obj -o out.obj", "neutral.obj"));
  EXPECT_TRUE(fails("export face.sweep -o no/out.obj", "there is no folder no"));
  EXPECT_TRUE(fails("export face.sweep -o face.sweep", "it is what is read"));
  EXPECT_TRUE(fails("export face.sweep -o out.ply", "must end in"));
  for (const std::string lod : {"0", "65", "-2", "1.5", "fine"})
    EXPECT_TRUE(fails("export face.sweep -o out.obj --lod " + lod, "whole number from 1 to 64", 2))
        << lod;
  EXPECT_TRUE(fails("export face.sweep -o out.obj --lod 2 --source-order", "--lod", 2));
  EXPECT_EQ(contents(folder / "out.obj"), "old");
  EXPECT_EQ(contents(folder / "face.sweep"), face);
}

TEST_F(Export, NeedsPolygonsForFinerMeshes) {
  convertRig();
  auto rig = decode(contents(folder / "face.sweep"), "face.sweep");
  ASSERT_TRUE(rig.has_value());
  rig->source.quadCorners.clear();
  folder.file("bare.sweep", encode(*rig));
  EXPECT_TRUE(
      fails("export bare.sweep -o out.obj --lod 2", "does not tell of its source's polygons"));
  EXPECT_TRUE(fails("animate bare.sweep --to smile=1 -o frames --lod 2", "convert it again"));
  EXPECT_EQ(run("export bare.sweep -o out.obj").code, 0);
  EXPECT_EQ(run("export bare.sweep -o out.glb --lod 2").code, 0) << "polygons of the surface";
}

/// The points and lines of an OBJ text, by group.
struct Lines {
  std::vector<Vec3> points;
  std::map<std::string, std::vector<std::vector<std::size_t>>> groups;
};

Lines readLines(const std::filesystem::path& path) {
  Lines lines;
  std::ifstream file(path);
  std::string line, group;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "g") words >> group;
    if (keyword == "v") {
      Vec3& p = lines.points.emplace_back();
      words >> p.x >> p.y >> p.z;
    }
    if (keyword == "p" || keyword == "l")
      lines.groups[group].emplace_back(std::istream_iterator<std::size_t>(words),
                                       std::istream_iterator<std::size_t>());
  }
  return lines;
}

TEST_F(Wires, HasNodesBoundariesAndControls) {
  folder.file("cube.obj", cube(3));
  ASSERT_EQ(run("convert cube.obj -o face.sweep --tolerance 0.2").code, 0);
  const Outcome r = run("wireframe face.sweep -o wire.obj --lod 4");
  ASSERT_EQ(r.code, 0) << r.err;
  Lines lines = readLines(folder / "wire.obj");
  EXPECT_EQ(lines.groups.size(), 3u);
  const auto boundaries = lines.groups["boundary_curves"].size();
  // Every arc of a closed face has a patch on both sides.
  EXPECT_EQ(lines.groups["control_curves"].size(), 4 * boundaries);
  EXPECT_GE(lines.groups["nodes"].size(), 8u);
  for (const auto& [group, curves] : lines.groups)
    for (const auto& curve : curves) {
      EXPECT_EQ(curve.size() % 4, 1u);
      for (const std::size_t v : curve) EXPECT_LE(v, lines.points.size());
    }
}

TEST_F(Wires, CountsTheNodesThatItWrites) {
  std::string fan = "v 0 0 1\n";
  for (int k = 0; k < 6; ++k) fan += fmt::format("v {} {} 0\n", std::cos(k), std::sin(k));
  for (int k = 0; k < 6; ++k) fan += fmt::format("f 1 {} {}\n", k + 2, (k + 1) % 6 + 2);
  folder.file("fan.obj", fan);
  ASSERT_EQ(run("convert fan.obj -o face.sweep").code, 0);
  const Outcome r = run("wireframe face.sweep -o wire.obj");
  const auto nodes = readLines(folder / "wire.obj").groups["nodes"].size();
  EXPECT_NE(r.out.find(fmt::format(": {} nodes, ", nodes)), std::string::npos) << r.out;
}

TEST_F(Wires, ControlsOfAPlaneLieAtTheirShares) {
  std::string plane;
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 4; ++i) plane += fmt::format("v {} {} 0\n", i, j);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const int a = 5 * j + i + 1;
      plane += fmt::format("f {} {} {} {}\n", a, a + 1, a + 6, a + 5);
    }
  folder.file("plane.obj", plane);
  ASSERT_EQ(run("convert plane.obj -o face.sweep").code, 0);
  ASSERT_EQ(run("wireframe face.sweep -o wire.obj --lod 1").code, 0);
  Lines lines = readLines(folder / "wire.obj");
  ASSERT_EQ(lines.groups["boundary_curves"].size(), 4u) << "the plane is one patch";
  std::set<double> away;
  for (const auto& curve : lines.groups["control_curves"]) {
    const Vec3 p = lines.points[curve[curve.size() / 2] - 1];
    EXPECT_NEAR(p.z, 0, 1e-5);
    away.insert(std::round(1e3 * std::min({p.x, p.y, 4 - p.x, 4 - p.y})) / 1e3);
  }
  EXPECT_EQ(away, (std::set<double>{0.4, 1}));
}

TEST_F(Wires, FollowsTheWeights) {
  convertRig();
  ASSERT_EQ(run("wireframe face.sweep -o a.obj").code, 0);
  ASSERT_EQ(run("wireframe face.sweep -o b.obj --weights smile=1").code, 0);
  EXPECT_EQ(readLines(folder / "a.obj").points.size(), readLines(folder / "b.obj").points.size());
  EXPECT_NE(contents(folder / "a.obj"), contents(folder / "b.obj"));
  EXPECT_TRUE(fails("wireframe face.sweep -o b.obj --weights frown=1", "frown"));
  EXPECT_TRUE(fails("wireframe face.sweep -o b.obj --lod 0", "--lod", 2));
  EXPECT_TRUE(fails("wireframe face.sweep -o b.json --weights smile=1", "are for .obj"));
  EXPECT_TRUE(fails("wireframe face.sweep -o b.json --lod 4", "are for .obj"));
  ASSERT_EQ(run("wireframe face.sweep -o b.obj --weights smile=1 --lod 8").code, 0);
  ASSERT_EQ(run("wireframe face.sweep -o c.obj --weights smile=1").code, 0);
  EXPECT_EQ(contents(folder / "b.obj"), contents(folder / "c.obj")) << "8 if not given";
}

}  // namespace
}  // namespace sweepface
