#include <gtest/gtest.h>
#include <string>

#include "sweepface/region_file.hpp"

namespace sweepface {
namespace {

TEST(RegionsJson, HoldWhereAndHow) {
  const auto regions = parseRegions(R"({"regions": [
    {"name": "cheeks", "points": [[1, 2, 3], [-1, 2, 3]], "whole": 1, "fade": 2.5, "over": "space",
     "mass": 4, "stiffness": 2, "delay": 0.1},
    {"name": "wave", "line": [[0, 0, 0], [1, 0, 0]], "curves": ["c1"], "parts": ["skin"],
     "nodes": {"n3": 0.5}, "fade": 9, "bands": 6}]})",
                                    "r.json");
  ASSERT_TRUE(regions) << regions.error().message;
  ASSERT_EQ(regions->size(), 2u);
  const PaintedRegion &cheeks = (*regions)[0], &wave = (*regions)[1];
  EXPECT_EQ(cheeks.name, "cheeks");
  EXPECT_EQ(cheeks.matter, (Matter{4, 2, 0.1}));
  EXPECT_EQ(cheeks.brush.points, (std::vector<Vec3>{{1, 2, 3}, {-1, 2, 3}}));
  EXPECT_EQ(cheeks.brush.fade, 2.5);
  EXPECT_FALSE(cheeks.brush.alongSurface);
  EXPECT_EQ(cheeks.bands, 1);
  EXPECT_EQ(wave.bands, 6);
  EXPECT_EQ(wave.brush.line.size(), 2u);
  EXPECT_EQ(wave.brush.curves, (std::vector<std::string>{"c1"}));
  EXPECT_EQ(wave.brush.parts, (std::vector<std::string>{"skin"}));
  ASSERT_EQ(wave.brush.nodes.size(), 1u);
  EXPECT_EQ(wave.brush.nodes[0].second, 0.5);
}

TEST(RegionsJson, TimelinesMayHaveNone) {
  const auto regions = parseRegions(R"({"seconds": 1, "events": []})", "t.json");
  ASSERT_TRUE(regions);
  EXPECT_TRUE(regions->empty());
}

TEST(RegionsJson, NameNoMoreThanAFaceMayHave) {
  PaintedRegion wave{"wave", {}, {}, static_cast<int>(kMostRegions)};
  for (const std::vector<PaintedRegion>& painted :
       {std::vector<PaintedRegion>(kMostRegions + 1), {wave, {}}}) {
    const auto regions = paintRegions({}, painted);
    ASSERT_FALSE(regions);
    EXPECT_TRUE(regions.error().message.starts_with("A face has at most"))
        << regions.error().message;
  }
}

void expectError(std::string_view inside, std::string_view part) {
  const auto regions = parseRegions(R"({"regions": [)" + std::string(inside) + "]}", "r.json");
  ASSERT_FALSE(regions) << inside;
  EXPECT_NE(regions.error().message.find(part), std::string::npos) << regions.error().message;
}

TEST(RegionsJson, SayWhatIsWrongAndWhere) {
  EXPECT_FALSE(parseRegions("{", "r.json"));
  EXPECT_FALSE(parseRegions(R"({"regions": 1})", "r.json"));
  expectError("1", "regions[0] is not an object");
  expectError(R"({"points": [[1, 2, 3]]})", "has no 'name'");
  expectError(R"({"name": "a"})", "says nowhere where it is");
  expectError(R"({"name": "a\nb", "parts": ["skin"]})", "regions[0] has control characters");
  expectError(R"({"name": "a", "points": [1, 2, 3]})", "[[x, y, z]]");
  expectError(R"({"name": "a", "parts": "skin"})", "'parts' that are not a list");
  expectError(R"({"name": "a", "parts": [1]})", "'parts' that are not names");
  expectError(R"({"name": "a", "nodes": {"n1": "x"}})", "node 'n1'");
  expectError(R"({"name": "a", "parts": ["b"], "over": "air"})", "neither surface nor space");
  expectError(R"({"name": "a", "parts": ["b"], "mass": 0})", "regions[0]: A mass");
  expectError(R"({"name": "a", "parts": ["b"], "mass": "x"})", "'mass' that is not a number");
  expectError(R"({"name": "a", "parts": ["b"], "bands": 1.5})", "a whole number from 1");
  expectError(R"({"name": "a", "parts": ["b"], "fade": -1})", "below 0");
  expectError(R"({"name": "a", "parts": ["b"], "whole": -1})", "below 0");
  expectError(R"({"name": "a", "parts": ["b"], "radius": 1})", "unknown key 'radius'");
}

}  // namespace
}  // namespace sweepface
