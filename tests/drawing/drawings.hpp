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
