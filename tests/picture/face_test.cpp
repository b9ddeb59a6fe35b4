#include <fmt/format.h>

#include "io/temporary_folder.hpp"
#include "picture/materials.hpp"
#include "picture/scenes.hpp"
#include "picture/styles.hpp"
#include "surface/surfaces.hpp"

namespace sweepface {
namespace {

using namespace testing;

class Tints : public ::testing::TestWithParam<Face> {};
INSTANTIATE_TEST_SUITE_P(, Tints, eachFace(), faceName);

TEST_P(Tints, TellNeighboursApart) {
  const Surface surface = surfaceOf(GetParam().rig, 12);
  const std::vector<Colour> tints = patchTints(surface);
  ASSERT_EQ(static_cast<Index>(tints.size()), surface.patchCount());
  const auto& patchOf = surface.connectivity().patchOf;
  for (Index h = 0; h < static_cast<Index>(patchOf.size()); h += 2)
    if (const Index a = patchOf[h], b = patchOf[h + 1]; a >= 0 && b >= 0 && a != b) {
      EXPECT_FALSE(tints[a] == tints[b]) << "patches " << a << " and " << b;
    }
}

/// A hill with two targets, and its conversion.
struct Hill {
  MeshRig source = withTargets(plane(12, 10));
  Rig rig = converted(source, 0.05);
  Weights rest = Weights(2, 0.0);
};

TEST(FaceScenes, HaveAColourForEveryPatch) {
  const Hill hill;
  const Scene scene = FaceScenes(hill.rig, 2).scene(hill.rest, Style::patches);
  EXPECT_EQ(scene.triangles.size(), 12u * 10u * 4u * 2u);
  EXPECT_EQ(scene.triangleColours.size(), scene.triangles.size());
}

TEST(FaceScenes, ShowThePose) {
  const Hill hill;
  const FaceScenes scenes(hill.rig, 1);
  const Weights posed{1, 0};
  const auto places = scenes.scene(posed, Style::shaded).positions;
  const auto expected = Tessellation(hill.rig.surface, 1).positions(blend(hill.rig, posed));
  EXPECT_EQ(places, expected);
  EXPECT_EQ(places, scenes.points(posed));
}

TEST(FaceScenes, ShowPlainSkinWhereNobodyKnowsTheMaterials) {
  Hill hill;
  hill.rig.source.quadCorners.clear();
  const Scene scene = FaceScenes(hill.rig, 1).scene(hill.rest, Style::shaded);
  EXPECT_EQ(scene.triangles.size(), 12u * 10u * 2u);
  EXPECT_TRUE(scene.triangleColours.empty());
  EXPECT_EQ(scene.colour, materialColour("skin"));
}

TEST(FaceScenes, DrawEveryCurve) {
  const Hill hill;
  const auto vectors = blend(hill.rig, hill.rest);
  const CurveNetwork net = curveNetwork(hill.rig.surface, vectors, 1);
  const Scene wires = FaceScenes(hill.rig, 1).scene(hill.rest, Style::wireframe);
  EXPECT_EQ(wires.strokes.size(), net.boundary.size() + net.control.size());
  const FaceScenes scenes(hill.rig, 1);
  const Scene joins = scenes.scene(hill.rest, Style::joins);
  EXPECT_EQ(joins.strokes.size(), net.boundary.size());
  // Every stroke has a colour of the legend, whose texts give their counts.
  for (const Key& key : scenes.legend(Style::joins)) {
    const auto drawn = std::ranges::count(joins.strokes, key.colour, &Stroke::colour);
    EXPECT_NE(key.text.find(fmt::format("({})", drawn)), std::string::npos) << key.text;
  }
  EXPECT_EQ(scenes.legend(Style::wireframe).size(), 2u);
  EXPECT_TRUE(scenes.legend(Style::shaded).empty());
}

TEST(FaceScenes, FindWhatATargetMoves) {
  MeshRig source{plane(12, 10), {}};
  const auto raised = [&](double x, double y) {
    std::vector<Vec3> p = source.neutral.positions;
    for (Vec3& v : p) v.z += std::exp(-0.5 * ((v.x - x) * (v.x - x) + (v.y - y) * (v.y - y)));
    return p;
  };
  source.targets = {
      {"mouthOpen", raised(2, 2)}, {"eyeBlink_L", raised(9, 8)}, {"mouthFollower", raised(9, 2)}};
  const Rig rig = converted(source);
  const FaceScenes scenes(rig, 1);
  const auto rest = scenes.points(Weights(3, 0.0));
  const auto mouth = scenes.region("MOUTH", 2);
  ASSERT_TRUE(mouth.has_value());
  EXPECT_GE(mouth->size(), 3u);
  for (const Index v : *mouth) EXPECT_LE(norm(rest[v] - Vec3{2, 2, rest[v].z}), 1.5);
  EXPECT_TRUE(failsWith(scenes.region("ear"), {"'ear'"}));
}

TEST(FaceScenes, KnowWhatIsAroundAVertex) {
  MeshRig source{plane(12, 10), {}};
  std::vector<Vec3> spike = source.neutral.positions;
  const Vec3 place = spike[13 * 4 + 6];
  spike[13 * 4 + 6].z += 1;
  source.targets = {{"spike", spike}};
  const Rig rig = converted(source);
  const FaceScenes scenes(rig, 2);
  const auto region = scenes.region("spike");
  ASSERT_TRUE(region.has_value());
  ASSERT_EQ(region->size(), 1u);
  const std::vector<Index> around = scenes.around(*region);
  EXPECT_EQ(around.size(), 9u);
  const auto points = scenes.points(Weights{0});
  std::vector<Vec3> shown;
  for (const Index v : around) shown.push_back(points[v]);
  // These points frame the vertex: it lies in front of the eye and near the picture's middle.
  const PictureSize size{200, 200};
  const Vec3 seen = frameCamera(shown, {}, size).project(place, size);
  EXPECT_GT(seen.z, 1);
  EXPECT_NEAR(seen.x, 100, 30);
  EXPECT_NEAR(seen.y, 100, 30);
}

TEST(FaceScenes, GetFinerWithThePicture) {
  const Hill hill;
  const Index small = lodFor(hill.rig.surface, Style::shaded, {100, 100});
  const Index large = lodFor(hill.rig.surface, Style::shaded, {800, 1000});
  EXPECT_GE(small, 1);
  EXPECT_GT(large, small);
  EXPECT_LE(lodFor(hill.rig.surface, Style::zebra, {16384, 4096}), 16);
}

// ---- The original ----

TEST(Originals, AreBlendsOfTheMeshes) {
  const Hill hill;
  const Weights weights{0.25, 0.5};
  const auto positions = originalPositions(hill.rig, hill.source, weights);
  ASSERT_TRUE(positions.has_value());
  for (std::size_t v = 0; v < positions->size(); ++v) {
    const Vec3 &n = hill.source.neutral.positions[v], a = hill.source.targets[0].positions[v],
               b = hill.source.targets[1].positions[v];
    EXPECT_LE(norm((*positions)[v] - (n + 0.25 * (a - n) + 0.5 * (b - n))), 1e-12);
  }
}

TEST(Originals, MustBelongToTheFace) {
  const Hill hill;
  const MeshRig other{plane(3, 3), {}};
  EXPECT_TRUE(failsWith(originalPositions(hill.rig, other, hill.rest), {"16 vertices", "143"}));
  const MeshRig bare{hill.source.neutral, {}};
  EXPECT_TRUE(originalPositions(hill.rig, bare, hill.rest).has_value());
  EXPECT_TRUE(failsWith(originalPositions(hill.rig, bare, Weights{0, 1}), {"'target2'"}));
}

TEST(Originals, AreShownAsTheyAre) {
  const Hill hill;
  const Scene scene = FaceScenes(hill.rig, 1).original(hill.source.neutral.positions);
  EXPECT_GE(scene.triangles.size(), 50'000u) << "fine enough to light";
  // Triangles lie on the facets and are counter-clockwise like them.
  const std::array<Index, 3>& t = scene.triangles[scene.triangles.size() / 2];
  const Vec3 n = cross(scene.positions[t[1]] - scene.positions[t[0]],
                       scene.positions[t[2]] - scene.positions[t[0]]);
  EXPECT_GT(dot(n, scene.normals[t[0]]), 0);
  double top = -1e9;
  for (const Vec3& p : scene.positions) top = std::max(top, p.z);
  double sourceTop = -1e9;
  for (const Vec3& p : hill.source.neutral.positions) sourceTop = std::max(sourceTop, p.z);
  EXPECT_EQ(top, sourceTop);
}

/// Adds a distant triangle that is degenerate to a line and so lies on no patch.
PolygonMesh withALine(PolygonMesh mesh) {
  const auto first = static_cast<Index>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{40, 40, 40}, {40, 40, 40}, {41, 40, 40}});
  for (Index k = 0; k < 3; ++k) mesh.polygons.corners.push_back(first + k);
  mesh.polygons.faceStart.push_back(static_cast<Index>(mesh.polygons.corners.size()));
  return mesh;
}

/// An L shape seen from above: none of its triangles lies in the notch.
TEST(Originals, AreCutWhereTheyBowIn) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  for (std::size_t first = 0; first < 6; ++first) {
    mesh.polygons.corners.clear();
    for (std::size_t k = 0; k < 6; ++k)
      mesh.polygons.corners.push_back(static_cast<Index>((first + k) % 6));
    mesh.polygons.faceStart = {0, 6};
    const Scene scene = FaceScenes(converted({mesh, {}}), 1).original(mesh.positions);
    double area = 0;
    for (const auto& t : scene.triangles) {
      const Vec3 n = cross(scene.positions[t[1]] - scene.positions[t[0]],
                           scene.positions[t[2]] - scene.positions[t[0]]);
      EXPECT_GE(n.z, 0);
      area += norm(n) / 2;
    }
    EXPECT_NEAR(area, 3, 1e-9) << "from corner " << first;
  }
}

TEST(Originals, ShowFacesThatAreOnNoPatch) {
  const MeshRig source{withALine(plane(12, 10)), {}};
  const Rig rig = converted(source);
  ASSERT_EQ(rig.source.loose.size(), 3u);
  const Scene scene = FaceScenes(rig, 1).original(source.neutral.positions);
  ASSERT_EQ(scene.normals.size(), scene.positions.size());
  double furthest = 0;
  for (const auto& triangle : scene.triangles)
    for (const Index v : triangle) {
      ASSERT_GE(v, 0);
      ASSERT_LT(v, static_cast<Index>(scene.positions.size()));
      furthest = std::max(furthest, scene.positions[v].x);
    }
  EXPECT_EQ(furthest, 41);
}

// ---- Heat maps ----

TEST(HeatMaps, GetDarkerWithTheError) {
  for (int k = 0; k < 64; ++k)
    EXPECT_GT(brightness(heatColour(k / 64.0)), brightness(heatColour((k + 1) / 64.0))) << k;
  EXPECT_EQ(heatColour(-1), heatColour(0));
  EXPECT_EQ(heatColour(7), heatColour(1));
  EXPECT_EQ(heatColour(std::nan("")), heatColour(0));
}

TEST(HeatMaps, ColourEachVertexByItsError) {
  const Hill hill;
  std::vector<Vec3> original = hill.source.neutral.positions;
  const Index moved = 70;
  original[moved].z += 0.4;
  const FaceScenes scenes(hill.rig, 1);
  const HeatMap map = scenes.heatMap(hill.rest, original, Style::error);
  const Index grid = hill.rig.source.gridVertex[moved];
  const auto places = scenes.points(hill.rest);
  EXPECT_NEAR(map.worst, norm(places[grid] - original[moved]), 1e-12);
  EXPECT_EQ(map.top, map.worst) << "beyond the tolerance";
  EXPECT_EQ(map.scene.vertexColours[grid], heatColour(1));
  for (std::size_t v = 0; v < original.size(); ++v) {
    const Index g = hill.rig.source.gridVertex[v];
    const double share = norm(places[g] - original[v]) / map.top;
    EXPECT_TRUE(near(map.scene.vertexColours[g], heatColour(share), 0.01));
  }
  ASSERT_EQ(map.scene.labels.size(), 1u);
  EXPECT_EQ(map.scene.labels[0].at, places[grid]);

  // The rendered picture shows the same.
  Scene scene = map.scene;
  scene.finish = Finish::flat;
  scene.labels.clear();
  const PictureSize size{400, 400};
  const Camera camera = frameCamera(places, {}, size);
  const Vec3 at = camera.project(places[grid], size);
  const Image image = picture(scene, camera, size);
  const auto x = static_cast<Index>(at.x), y = static_cast<Index>(at.y);
  EXPECT_TRUE(near(image.at(x, y), heatColour(1), 40));
  EXPECT_TRUE(near(image.at(x + 80, y), heatColour(0), 40));
}

TEST(HeatMaps, SayNothingOfRounding) {
  const Hill hill;
  const Tessellation grid(hill.rig.surface, 1);
  auto original = sourcePositions(hill.rig, grid, blend(hill.rig, {}), {});
  for (Vec3& p : original) p.x += 1e-14;
  const HeatMap map = FaceScenes(hill.rig, 1).heatMap(hill.rest, original, Style::error);
  EXPECT_EQ(map.worst, 0);
  EXPECT_TRUE(map.scene.labels.empty());
}

TEST(HeatMaps, EndAtTheTolerance) {
  const Hill hill;
  const HeatMap map =
      FaceScenes(hill.rig, 2).heatMap(hill.rest, hill.source.neutral.positions, Style::error);
  EXPECT_EQ(map.top, 0.05);
  EXPECT_LE(map.worst, 0.05);
  EXPECT_NE(map.title.find(fmt::format("{:.3g} at worst", map.worst)), std::string::npos);
}

TEST(HeatMaps, ShowAnglesOfNormals) {
  const Hill hill;
  // The same hill tilted by ten degrees, which turns every normal by as much.
  std::vector<Vec3> original = hill.source.neutral.positions;
  const double a = turn(10.0 / 360);
  for (Vec3& p : original)
    p = {std::cos(a) * p.x + std::sin(a) * p.z, p.y, std::cos(a) * p.z - std::sin(a) * p.x};
  const HeatMap map = FaceScenes(hill.rig, 1).heatMap(hill.rest, original, Style::angle);
  EXPECT_NEAR(map.worst, 10, 4);
  EXPECT_GE(map.top, 8);
  EXPECT_LE(map.top, 16);
  EXPECT_NE(map.title.find("degrees"), std::string::npos);
}

// ---- Styles and materials ----

TEST(Styles, HaveNames) {
  const std::map<Style, std::string_view> names{
      {Style::shaded, "shaded"},   {Style::patches, "patches"}, {Style::wireframe, "wireframe"},
      {Style::joins, "joins"},     {Style::error, "error"},     {Style::angle, "angle"},
      {Style::normals, "normals"}, {Style::zebra, "zebra"}};
  for (const Style style : styles) {
    EXPECT_EQ(nameOf(style), names.at(style));
    EXPECT_EQ(styleFromName(names.at(style)).value(), style);
  }
  EXPECT_TRUE(failsWith(styleFromName("shiny"), {"'shiny'", "zebra"}));
}

TEST(Materials, AreToldByTheirNames) {
  const auto skin = materialColour("M_Face");
  ASSERT_TRUE(skin.has_value());
  EXPECT_EQ(materialColour("anything"), skin);
  EXPECT_NE(materialColour("M_Teeth"), skin);
  EXPECT_NE(materialColour("Lips"), skin);
  EXPECT_FALSE(materialColour("LacrimalFluid").has_value());
  Polygons polygons;
  polygons.faceStart = {0, 4, 8, 12};
  polygons.materials = {"skin", "Cornea"};
  polygons.faceMaterial = {0, 1, -1};
  const auto colours = faceColours(polygons);
  EXPECT_EQ(colours[0], skin);
  EXPECT_FALSE(colours[1].has_value());
  EXPECT_EQ(colours[2], skin);
}

TEST(Materials, LeaveClearFacesOut) {
  MeshRig source{plane(12, 10), {}};
  source.neutral.polygons.materials = {"skin", "tears"};
  source.neutral.polygons.faceMaterial.assign(120, 0);
  std::fill_n(source.neutral.polygons.faceMaterial.begin(), 30, 1);
  const Rig rig = converted(source);
  const FaceScenes scenes(rig, 2);
  EXPECT_EQ(scenes.scene({}, Style::shaded).triangles.size(), 90u * 8u);
  EXPECT_EQ(scenes.scene({}, Style::patches).triangles.size(), 120u * 8u);
}

}  // namespace
}  // namespace sweepface
