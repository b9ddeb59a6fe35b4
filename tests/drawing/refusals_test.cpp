// What docs/wire-format.md lists under "What is refused", with the line that each message names.
#include <algorithm>
#include <fmt/format.h>
#include <tuple>

#include "drawing/drawings.hpp"

namespace sweepface::testing {
namespace {

/// Expects a drawing to be refused in these words, at the line of the value that `at` points to.
void expectRefusedAt(const Json& drawing, const std::string& at, std::string_view words) {
  const Json::json_pointer place(at);
  ASSERT_TRUE(drawing.contains(place)) << at;
  Json marked = drawing;
  marked[place] = "@";
  const std::string text = marked.dump(1);
  const auto line = 1 + std::count(text.begin(), text.begin() + text.find("\"@\""), '\n');
  const std::string why = refusal(drawing);
  EXPECT_TRUE(why.starts_with(fmt::format("a.wire.json, line {}, column ", line))) << why;
  EXPECT_NE(why.find(words), std::string::npos) << why << "\n" << words;
}

struct Fault {
  void (*make)(Json& drawing);
  const char *at, *words;
};

void expectRefused(const Json& drawing, const std::vector<Fault>& faults) {
  for (const auto& [make, at, words] : faults) {
    Json faulty = drawing;
    make(faulty);
    expectRefusedAt(faulty, at, words);
  }
}

TEST(Refusals, ofADrawingWithoutPatchesNameNoLine) {
  Json drawing = square();
  drawing["patches"] = Json::array();
  EXPECT_EQ(refusal(drawing), "a.wire.json: there is no patch, so there is no surface.");
}

TEST(Refusals, ofMembersTellWhereAndWhich) {
  for (const auto& [what, at, required] :
       std::vector<std::tuple<std::string, std::string, std::vector<const char*>>>{
           {"the drawing", "", {"format", "nodes", "curves", "patches"}},
           {"a node", "/nodes/1", {"name"}},
           {"a curve", "/curves/1", {"name", "from", "to"}},
           {"a patch", "/patches/1", {"sides"}},
           {"a control", "/controls/1", {"beside", "in", "second", "third"}},
           {"a ribbon", "/ribbons/0", {"name"}},
           {"an expression", "/expressions/0", {"name", "moves"}}}) {
    for (const char* key : required) {
      Json lacking = vase();
      lacking[Json::json_pointer(at)].erase(key);
      expectRefusedAt(lacking, at, fmt::format("{} needs '{}'.", what, key));
    }
    Json odd = vase();
    odd[Json::json_pointer(at + "/colour")] = "red";
    expectRefusedAt(odd, at + "/colour",
                    fmt::format("'colour' is not known in {}; known are '", what));
  }
}

TEST(Refusals, ofValuesTellWhere) {
  expectRefused(
      square(),
      {{[](Json& d) { d["format"] = "sweepface wireframe 9"; }, "/format",
        "the format is 'sweepface wireframe 9' and this program reads 'sweepface wireframe 1'"},
       {[](Json& d) { d["nodes"][1]["at"] = {1, 2}; }, "/nodes/1/at",
        "the place of a node has 2 numbers instead of three"},
       {[](Json& d) { d["nodes"][1]["at"][2] = 1e39; }, "/nodes/1/at/2",
        "a coordinate is beyond what a float can hold"},
       {[](Json& d) { d["patches"][0]["material"] = ""; }, "/patches/0/material",
        "the material of a patch is empty, has control characters or is no UTF-8"}});
}

TEST(Refusals, ofNamesThatAreTakenNameThem) {
  expectRefused(vase(), {{[](Json& d) { d["nodes"][1]["name"] = "foot front"; }, "/nodes/1",
                          "there are two nodes named 'foot front'"},
                         {[](Json& d) { d["curves"][1]["name"] = "foot right"; }, "/curves/1",
                          "there are two curves named 'foot right'"},
                         {[](Json& d) { d["patches"][1]["name"] = "right"; }, "/patches/1",
                          "there are two patches named 'right'"},
                         {[](Json& d) { d["ribbons"].push_back({{"name", "body"}}); }, "/ribbons/1",
                          "there are two ribbons named 'body'"},
                         {[](Json& d) { d["expressions"].push_back(Json(d["expressions"][0])); },
                          "/expressions/1", "there are two expressions named 'taller'"},
                         {[](Json& d) { d["curves"][2]["name"] = "rim front"; }, "/curves/2",
                          "a node and a curve are both named 'rim front'"}});
}

TEST(Refusals, ofNamesThatNothingHasNameThem) {
  expectRefused(vase(), {{[](Json& d) { d["nodes"][1]["with"] = "foot"; }, "/nodes/1",
                          "node 'foot back' stands with 'foot', which is no node"},
                         {[](Json& d) { d["curves"][1]["from"] = "foot"; }, "/curves/1",
                          "curve 'foot left' ends at 'foot', which is no node"},
                         {[](Json& d) { d["curves"][1]["to"] = "foot"; }, "/curves/1",
                          "curve 'foot left' ends at 'foot', which is no node"},
                         {[](Json& d) { d["curves"][1]["ribbon"] = "foot"; }, "/curves/1",
                          "curve 'foot left' belongs to 'foot', which is no ribbon"},
                         {[](Json& d) { d["patches"][1]["sides"][2] = "-foot"; }, "/patches/1",
                          "patch 'left' names '-foot', which is no curve"},
                         {[](Json& d) { d["creases"] = Json::array({"foot"}); }, "/creases/0",
                          "the crease 'foot' is no curve"},
                         {[](Json& d) { d["controls"][1]["beside"] = "foot"; }, "/controls/1",
                          "there is no curve 'foot' to stand beside"},
                         {[](Json& d) { d["controls"][1]["in"] = "foot"; }, "/controls/1",
                          "there is no patch 'foot' to stand in"},
                         {[](Json& d) { d["controls"][1]["in"] = "right"; }, "/controls/1",
                          "curve 'foot left' does not bound patch 'right'"},
                         {[](Json& d) { d["expressions"][0]["moves"]["foot"] = {0, 1, 0}; },
                          "/expressions/0/moves/foot", "'foot' is no node and no curve"}});
}

TEST(Refusals, ofPatchesNameTheirCurves) {
  expectRefused(
      square(),
      {{[](Json& d) { d["patches"][0]["sides"].erase(3); }, "/patches/0",
        "patch 'square' has 3 sides; a patch has four"},
       {[](Json& d) { d["patches"][0]["sides"][1] = Json::array(); }, "/patches/0",
        "side 2 of patch 'square' has no curve"},
       {[](Json& d) { d["patches"][0]["sides"][2] = "dc"; }, "/patches/0",
        "the curves of patch 'square' do not meet: 'bc' ends at node 'c' and 'dc' begins at node "
        "'d'"},
       {[](Json& d) {
          d["patches"].push_back(Json(d["patches"][0])), d["patches"][1].erase("name");
        },
        "/patches/1",
        "curve 'ab' is used twice in the same direction, by patch 'square' and by patch 'p1'"},
       {[](Json& d) { d["curves"].push_back({{"name", "ac"}, {"from", "a"}, {"to", "c"}}); },
        "/curves/4", "curve 'ac' bounds no patch"},
       {[](Json& d) { d["nodes"].push_back({{"name", "e"}, {"at", {2, 2, 0}}}); }, "/nodes/4",
        "node 'e' is on no curve"},
       {[](Json& d) { d["nodes"][1].erase("at"); }, "/nodes/1",
        "node 'b' needs 'at': only a node on the side of a patch"},
       {[](Json& d) { d["nodes"][1]["at"] = d["nodes"][0]["at"]; }, "/curves/0",
        "the last point of curve 'ab' coincides with the one before it; a curve needs a length"},
       {[](Json& d) { d["curves"][0]["collapsed"] = true; }, "/curves/0",
        "curve 'ab' is collapsed, so it must join two nodes at one point"},
       {[](Json& d) { d["curves"][0]["edges"] = 3, d["curves"][2]["edges"] = 4; }, "/patches/0",
        "sides 1 and 3 of patch 'square' have 3 and 4 edges; opposite sides need as many"},
       {[](Json& d) { d["curves"][0]["edges"] = 1000, d["curves"][1]["edges"] = 1001; },
        "/patches/0", "the patches have more than 1000000 quads together"}});
  expectRefused(withTNode(),
                {{[](Json& d) { d["curves"][3]["edges"] = d["curves"][4]["edges"] = 40'000; },
                  "/patches/0", "sides 1 and 3 of patch 'p0' have 0 and 80000 edges"}});
  expectRefused(cone(),
                {{[](Json& d) { d["curves"][0]["points"] = {{0, 3, 0}, {0, 3, 0}}; }, "/curves/0",
                  "curve 'turn0' is collapsed into a point and can have no points"}});
}

TEST(Refusals, ofCurvesThatSweepTogetherNameTheirRibbons) {
  expectRefused(vase(), {{[](Json& d) {
                            d["ribbons"].push_back({{"name", "back"}});
                            d["curves"][5]["ribbon"] = "back";
                          },
                          "/curves/5",
                          "curve 'seam back' belongs to ribbon 'back' and curve 'seam front' to "
                          "'body', but patches sweep along both"}});
}

TEST(Refusals, ofControlsNameTheirBoundary) {
  expectRefused(vase(), {{[](Json& d) { d["controls"][0]["third"] = d["controls"][0]["second"]; },
                          "/controls/0",
                          "the control curves beside 'foot right': Both control curves must lie "
                          "apart from the curve before them."}});
}

TEST(Refusals, ofCreasesNameThem) {
  expectRefused(vase(), {{[](Json& d) { d["creases"] = {"seam front", "rim left"}; }, "/creases/1",
                          "the crease 'rim left' bounds one patch only"},
                         {[](Json& d) { d["creases"] = {"seam front", "seam front"}; },
                          "/creases/1", "the crease 'seam front' is given twice"}});
  expectRefused(writtenCube(), {{[](Json& d) { d["creases"] = Json::array({d["creases"][0]}); },
                                 "/creases/0", "ends inside the surface at both ends"}});
}

TEST(Refusals, ofJetsNameTheirNode) {
  expectRefused(square(),
                {{[](Json& d) { d["nodes"][0]["jets"] = {{{"along", "ab"}}, {{"along", "ab"}}}; },
                  "/nodes/0", "node 'a' has 2 jets and needs 1"},
                 {[](Json& d) { d["nodes"][0]["jet"] = {{"along", "da"}}; }, "/nodes/0",
                  "a jet of node 'a' runs along 'da', which is no curve that leaves it so"},
                 {[](Json& d) { d["nodes"][0]["jet"] = {{"along", "ab"}, {"xx", {0, 0, 0}}}; },
                  "/nodes/0", "the jet of node 'a' has a derivative without those before it"}});
  expectRefused(withTNode(), {{[](Json& d) { d["nodes"][4]["jet"] = {{"along", "ec"}}; },
                               "/nodes/4", "node 'e' stands on the side of a patch"}});
  expectRefused(
      cone(),
      {{[](Json& d) { d["nodes"][0]["jet"] = {{"along", "ray0"}, {"y", {0, 0, 1}}}; }, "/nodes/0",
        "the jet of node 'tip0' along 'ray0' lacks yy x xy xx."},
       {[](Json& d) {
          d["nodes"][0]["jet"] = {{"along", "ray0"}};
          for (const char* word : {"x", "y", "xx", "xy", "yy", "xxy"})
            d["nodes"][0]["jet"][word] = {0, 0, 1};
        },
        "/nodes/0", "other than four patches meet at node 'tip0', so that its jet has no xxy."}});
}

TEST(Refusals, ofMovesNameWhatTheyAreOf) {
  expectRefused(vase(),
                {{[](Json& d) {
                    d["expressions"][0]["moves"]["rim back"]["points"] = {{0, 1, 0}, {0, 1, 0}};
                  },
                  "/expressions/0/moves/rim back", "'rim back' is a node and has no points"},
                 {[](Json& d) { d["expressions"][0]["moves"]["rim left"] = {{"x", {0, 1, 0}}}; },
                  "/expressions/0/moves/rim left", "'rim left' is a curve and has no jet"}});
}

}  // namespace
}  // namespace sweepface::testing
