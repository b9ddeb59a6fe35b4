#pragma once

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "sweepface/drawing.hpp"
#include "sweepface/eval.hpp"

// Drawings made by hand.
namespace sweepface::testing {

using Json = nlohmann::ordered_json;

inline std::string document(const std::string& name) {
  std::ifstream file(std::string(SWEEPFACE_SOURCE_DIR) + "/docs/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The vase of docs/wire-format.md, the only block of JSON there.
inline std::string vaseText() {
  const std::string page = document("wire-format.md");
  const std::string fence = "```json\n";
  const std::size_t start = page.find(fence) + fence.size();
  return page.substr(start, page.find("```", start) - start);
}

inline Json vase() { return Json::parse(vaseText()); }

inline Result<Built> buildText(const std::string& text) {
  const auto drawing = parseDrawing(text, "a.wire.json");
  if (!drawing) return std::unexpected(drawing.error());
  return build(*drawing);
}
inline Result<Built> buildJson(const Json& json) { return buildText(json.dump(1)); }

/// Why a drawing cannot be built; empty if it can.
inline std::string refusal(const Json& json) {
  const auto built = buildJson(json);
  return built ? "" : built.error().message;
}

/// The rig of a drawing that must be valid.
inline Rig made(const Json& json) {
  auto built = buildJson(json);
  EXPECT_TRUE(built.has_value()) << (built ? "" : built.error().message);
  return built ? std::move(built->rig) : Rig{};
}

/// A square of one patch in the plane z = 0, (0, 0) to (4, 4).
inline Json square() {
  return Json::parse(R"({
    "format": "sweepface wireframe 1",
    "nodes": [{"name": "a", "at": [0, 0, 0]}, {"name": "b", "at": [4, 0, 0]},
              {"name": "c", "at": [4, 4, 0]}, {"name": "d", "at": [0, 4, 0]}],
    "curves": [{"name": "ab", "from": "a", "to": "b"}, {"name": "bc", "from": "b", "to": "c"},
               {"name": "dc", "from": "d", "to": "c"}, {"name": "da", "from": "d", "to": "a"}],
    "patches": [{"name": "square", "sides": ["ab", "bc", "-dc", "da"]}]
  })");
}

/// A tube of one patch around the y axis; its foot and its rim are closed curves.
inline Json tube() {
  Json drawing = Json::parse(R"({"format": "sweepface wireframe 1",
    "nodes": [{"name": "low", "at": [2, 0, 0]}, {"name": "high", "at": [2, 5, 0]}],
    "curves": [{"name": "foot", "from": "low", "to": "low"}, {"name": "rim", "from": "high", "to": "high"},
               {"name": "seam", "from": "low", "to": "high"}],
    "patches": [{"name": "tube", "sides": ["seam", "-rim", "-seam", "foot"]}]})");
  for (int ring : {0, 1})
    for (int k = 1; k < 8; ++k) {
      const double a = 2 * M_PI * k / 8;
      drawing["curves"][ring]["points"].push_back({2 * std::cos(a), 5.0 * ring, -2 * std::sin(a)});
    }
  return drawing;
}

/// The square with a second row of two patches on top of it; e lies on dc.
inline Json withTNode() {
  Json drawing = square();
  drawing["nodes"].push_back({{"name", "e"}});
  for (const auto& [name, x] : {std::pair{"f", 0.0}, {"g", 4.0 / 3}, {"h", 4.0}})
    drawing["nodes"].push_back({{"name", name}, {"at", {x, 8, 0}}});
  drawing["curves"].erase(2);
  for (const auto& [from, to] : {std::pair{"d", "e"},
                                 {"e", "c"},
                                 {"f", "g"},
                                 {"g", "h"},
                                 {"d", "f"},
                                 {"e", "g"},
                                 {"c", "h"}})
    drawing["curves"].push_back({{"name", std::string(from) + to}, {"from", from}, {"to", to}});
  drawing["patches"] = Json::parse(R"([{"sides": ["ab", "bc", ["-ec", "-de"], "da"]},
      {"sides": ["de", "eg", "-fg", "-df"]}, {"sides": ["ec", "ch", "-gh", "-eg"]}])");
  return drawing;
}

/// A cone of three slices whose tip is three nodes at one point.
inline Json cone() {
  Json drawing = Json::parse(
      R"({"format": "sweepface wireframe 1", "nodes": [], "curves": [], "patches": []})");
  for (int k = 0; k < 3; ++k) {
    const std::string n = std::to_string(k), next = std::to_string((k + 1) % 3);
    const double a = 2 * M_PI * k / 3, b = 2 * M_PI * (k + 0.5) / 3;
    Json tip{{"name", "tip" + n}};
    if (k == 0) tip["at"] = {0, 3, 0};
    if (k > 0) tip["with"] = "tip0";
    drawing["nodes"].push_back(tip);
    drawing["nodes"].push_back({{"name", "base" + n}, {"at", {std::cos(a), 0, -std::sin(a)}}});
    drawing["curves"].push_back(
        {{"name", "turn" + n}, {"from", "tip" + n}, {"to", "tip" + next}, {"collapsed", true}});
    drawing["curves"].push_back({{"name", "ray" + n}, {"from", "tip" + n}, {"to", "base" + n}});
    drawing["curves"].push_back({{"name", "arc" + n},
                                 {"from", "base" + n},
                                 {"to", "base" + next},
                                 {"points", {{std::cos(b), 0, -std::sin(b)}}}});
    drawing["patches"].push_back(
        {{"name", "slice" + n}, {"sides", {"-ray" + n, "-turn" + n, "ray" + next, "-arc" + n}}});
  }
  for (Json& patch : drawing["patches"]) {  // counter-clockwise
    const std::string n = patch["name"].get<std::string>().substr(5),
                      next = std::to_string((std::stoi(n) + 1) % 3);
    patch["sides"] = {"ray" + n, "arc" + n, "-ray" + next, "-turn" + n};
  }
  return drawing;
}

/// A cube with only sharp edges, as it is written: three jets at every corner, each of which shares
/// a derivative with the next.
inline Json writtenCube() {
  Json drawing = Json::parse(R"({"format": "sweepface wireframe 1", "nodes": [], "curves": [],
      "patches": [], "creases": []})");
  const auto name = [](int x, int y, int z) {
    return "n" + std::to_string(x) + std::to_string(y) + std::to_string(z);
  };
  for (int k = 0; k < 8; ++k) {
    const int x = k & 1, y = k >> 1 & 1, z = k >> 2;
    drawing["nodes"].push_back({{"name", name(x, y, z)}, {"at", {x, y, z}}});
    for (int axis = 0; axis < 3; ++axis) {
      if (k >> axis & 1) continue;
      const int to = k | 1 << axis;
      const std::string end = name(to & 1, to >> 1 & 1, to >> 2);
      drawing["curves"].push_back(
          {{"name", name(x, y, z) + "-" + end}, {"from", name(x, y, z)}, {"to", end}});
      drawing["creases"].push_back(name(x, y, z) + "-" + end);
    }
  }
  const auto patch = [&](std::array<const char*, 4> corners) {
    Json sides = Json::array();
    for (std::size_t s = 0; s < 4; ++s) {
      const std::string a = std::string("n") + corners[s],
                        b = std::string("n") + corners[(s + 1) % 4];
      sides.push_back(a < b ? a + "-" + b : "-" + b + "-" + a);
    }
    drawing["patches"].push_back({{"sides", std::move(sides)}});
  };
  patch({"000", "010", "110", "100"}), patch({"001", "101", "111", "011"});
  patch({"000", "100", "101", "001"}), patch({"010", "011", "111", "110"});
  patch({"000", "001", "011", "010"}), patch({"100", "110", "111", "101"});
  return Json::parse(formatDrawing(draw(made(drawing))));
}

inline std::vector<Vec3> neutralPose(const Rig& rig) {
  return blend(rig, Weights(rig.targets.size()));
}

inline Vec3 middleOf(const Rig& rig, const std::string& curve, double share,
                     const std::vector<double>& weights = {}) {
  const Index arc = rig.find(Thing::curve, curve).value();
  const auto pose = weights.empty() ? neutralPose(rig) : blend(rig, weights);
  return rig.surface.pointOnArc(pose, arc, share * rig.surface.wireframe().arcs[arc].edges);
}

}  // namespace sweepface::testing
