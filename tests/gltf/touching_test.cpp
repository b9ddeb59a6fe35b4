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

std::size_t warningsAbout(const Glb& glb, std::string_view part) {
  return static_cast<std::size_t>(std::ranges::count_if(
      read(glb).warnings, [&](const std::string& warning) { return warning.contains(part); }));
}

TEST(Touching, MeshesAreNamed) {
  const auto warnings = read(withBody(standingAt({6, 7, 8}))).warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[1],
            "Beside the face, up to the tolerance from it, slits may show at mesh 1 'body', "
            "primitive 0; to close them, give what meets the face there a morph target that moves "
            "nothing, so that it is part of the face.");
}

TEST(Touching, MeshesShareSeveralPlacesThatNeverMove) {
  EXPECT_EQ(warningsAbout(withBody(standingAt({6, 7, 8})), "slits"), 1u);
  EXPECT_EQ(warningsAbout(withBody(standingAt({6, 8, 6})), "slits"), 0u) << "two places";
  EXPECT_EQ(warningsAbout(withBody(standingAt({0, 1, 8})), "slits"), 0u) << "two of them move";
  EXPECT_EQ(warningsAbout(withBody({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "slits"), 0u);
}

TEST(Touching, LinesAndWhatIsNotShownDoNotCount) {
  Glb lines = withBody(standingAt({6, 7, 8}));
  lines.primitive(1)["mode"] = 1;
  EXPECT_EQ(warningsAbout(lines, "slits"), 0u);
  Glb hidden = withBody(standingAt({6, 7, 8}));
  hidden.add("scenes", {{"nodes", Json::array({0})}});
  EXPECT_EQ(warningsAbout(hidden, "slits"), 0u);
}

TEST(Touching, WhatCannotBeReadDoesNotCount) {
  Glb broken = withBody(standingAt({6, 7, 8}));
  broken.attribute("POSITION", 1)["type"] = "SCALAR";
  EXPECT_EQ(warningsAbout(broken, "slits"), 0u);
}

}  // namespace
}  // namespace sweepface
