#include "gltf/glb.hpp"

namespace sweepface {
namespace {

using namespace sweepface::testing;

/// The small face, of which one target alone moves the first two vertices, and a body of triangles
/// with vertices at `positions`.
Glb withBody(const std::vector<Vec3>& positions) {
  Glb glb = smallFace();
  const std::size_t still = glb.addSparse(9, {0, 1}, {{0, 0, 1}, {0, 0, 1}});
  for (Json& target : glb.primitive()["targets"]) target["POSITION"] = still;
  const Json body = {{"attributes", {{"POSITION", glb.addVectors(positions)}}}};
  glb.add("meshes", {{"name", "body"}, {"primitives", Json::array({body})}});
  glb.add("nodes", {{"mesh", 1}, {"translation", {5, 0, 0}}, {"scale", {2, 2, 2}}});
  return glb;
}

/// Where these vertices of the face are, for the body's node.
std::vector<Vec3> standingAt(const std::vector<std::size_t>& vertices) {
  std::vector<Vec3> positions;
  for (const std::size_t v : vertices)
    positions.push_back(0.5 * (sheetPositions()[v] - Vec3{5, 0, 0}));
  return positions;
}

/// These and as many below.
std::vector<Vec3> hangingFrom(const std::vector<std::size_t>& vertices) {
  std::vector<Vec3> positions = standingAt(vertices);
  for (const Vec3& p : standingAt(vertices)) positions.push_back(p + Vec3{0.1, 7, 0});
  return positions;
}

std::size_t warningsAbout(const Glb& glb, std::string_view part) {
  return static_cast<std::size_t>(std::ranges::count_if(
      read(glb).warnings, [&](const std::string& warning) { return warning.contains(part); }));
}

TEST(Touching, MeshesAreNamedOnce) {
  Glb glb = withBody(hangingFrom({6, 7, 8}));
  for (int copy = 0; copy < 3; ++copy) glb.add("nodes", Json(glb.json["nodes"][1]));
  const auto warnings = read(glb).warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[1],
            "Slits as wide as the tolerance may show between the face and mesh 1 'body', primitive "
            "0; to close them, have that be part of the face: choose all meshes of the face by "
            "their names (--mesh), and give --tolerance, as what is assumed grows with them.");
}

TEST(Touching, MeshesShareSeveralPlacesOfTheRimThatNeverMove) {
  EXPECT_EQ(warningsAbout(withBody(hangingFrom({6, 8, 6})), "Slits"), 0u) << "two places";
  EXPECT_EQ(warningsAbout(withBody(hangingFrom({0, 1, 8})), "Slits"), 0u) << "two of them move";
  EXPECT_EQ(warningsAbout(withBody(hangingFrom({4, 7, 8})), "Slits"), 0u) << "4 is inside";
  EXPECT_EQ(warningsAbout(withBody({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "Slits"), 0u);
}

TEST(Touching, CopiesOfTheFaceDoNotCount) {
  EXPECT_EQ(warningsAbout(withBody(standingAt({2, 3, 4, 5, 6, 7, 8})), "Slits"), 0u);
}

TEST(Touching, VerticesOfNoTriangleDoNotCount) {
  Glb glb = withBody(hangingFrom({6, 7, 8}));
  glb.primitive(1)["indices"] = glb.addIndices({0, 1, 0});
  EXPECT_EQ(warningsAbout(glb, "Slits"), 0u);
}

TEST(Touching, LinesAndWhatIsNotShownDoNotCount) {
  Glb lines = withBody(hangingFrom({6, 7, 8}));
  lines.primitive(1)["mode"] = 1;
  EXPECT_EQ(warningsAbout(lines, "Slits"), 0u);
  Glb hidden = withBody(hangingFrom({6, 7, 8}));
  hidden.add("scenes", {{"nodes", Json::array({0})}});
  EXPECT_EQ(warningsAbout(hidden, "Slits"), 0u);
}

TEST(Touching, WhatCannotBeReadDoesNotCount) {
  Glb broken = withBody(hangingFrom({6, 7, 8}));
  broken.attribute("POSITION", 1)["type"] = "SCALAR";
  EXPECT_EQ(warningsAbout(broken, "Slits"), 0u);
  Glb beyond = withBody(hangingFrom({6, 7, 8}));
  const std::size_t indices = beyond.addIndices({0, 65535, 300});
  beyond.primitive(1)["indices"] = indices;
  beyond.accessor(indices)["componentType"] = 5122;  // and so some are below 0
  EXPECT_EQ(warningsAbout(beyond, "Slits"), 0u);
}

}  // namespace
}  // namespace sweepface
