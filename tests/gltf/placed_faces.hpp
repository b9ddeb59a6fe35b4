#pragma once

#include <map>

#include "gltf/written.hpp"

// Faces whose vertices tell where in the source they are.
namespace sweepface::testing {

/// The triangles of all primitives of a mesh, with vertices at the same place welded.
inline std::vector<Loop> weldedTriangles(const Written& glb, std::size_t mesh = 0) {
  std::map<std::array<double, 3>, Index> places;
  std::vector<Loop> triangles;
  for (std::size_t p = 0; p < glb.json["meshes"][mesh]["primitives"].size(); ++p) {
    const std::vector<Vec3> positions = glb.vectors(glb.attribute("POSITION", mesh, p));
    const std::vector<Index> indices = glb.indices(mesh, p);
    for (std::size_t k = 0; k < indices.size(); k += 3) {
      Loop& triangle = triangles.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3& at = positions[indices[k + c]];
        triangle.push_back(places.try_emplace({at.x, at.y, at.z}, static_cast<Index>(places.size()))
                               .first->second);
      }
    }
  }
  return triangles;
}

// All attributes are mixed alike. So one of them stores a vertex's place in the source, to check
// the others by: those that are linear in the place in the source stay so.

inline void addPlaces(Glb& glb) {
  std::vector<Vec2> places;
  for (const Vec3& p : sheetPositions()) places.push_back({p.x, p.y});
  const std::size_t accessor = glb.addTexcoords(places);
  for (Json& primitive : glb.json["meshes"][0]["primitives"])
    primitive["attributes"]["TEXCOORD_1"] = accessor;
}

inline std::vector<Vec2> placesIn(const Written& glb, std::size_t primitive = 0) {
  const std::vector<double> values = glb.numbers(glb.attribute("TEXCOORD_1", 0, primitive));
  std::vector<Vec2> places;
  for (std::size_t k = 0; k < values.size(); k += 2) places.push_back({values[k], values[k + 1]});
  return places;
}

/// The small face with a cut texture: its two halves are primitives of one run.
inline Glb cutFace() {
  Glb glb = smallFace();
  Json left = glb.primitive(), right = left;
  std::vector<std::uint16_t> indices = sheetIndices(), first, second;
  for (std::size_t k = 0; k < indices.size(); ++k)
    (k / 6 % 2 == 0 ? first : second).push_back(indices[k]);
  left["indices"] = glb.addIndices(first);
  right["indices"] = glb.addIndices(second);
  right["material"] = glb.add("materials", {{"name", "lips"}});
  std::vector<Vec2> texcoords;
  for (const Vec3& p : sheetPositions()) texcoords.push_back({p.y / 4 + 0.5, p.x / 4});
  right["attributes"]["TEXCOORD_0"] = glb.addTexcoords(texcoords);
  glb.json["meshes"][0]["primitives"] = Json::array({left, right});
  addPlaces(glb);
  return glb;
}

/// The small face with every vertex bound to the joint of its own number and to a common one.
inline Glb skinnedFace(int component) {
  Glb glb = smallFace();
  std::vector<std::uint8_t> joints;
  std::vector<double> weights;
  for (int v = 0; v < 9; ++v) {
    for (const int j : {v, 9, 0, 0}) joints.push_back(static_cast<std::uint8_t>(j));
    for (const double w : {0.6, 0.4, 0.0, 0.0}) weights.push_back(w);
  }
  Json& attributes = glb.primitive()["attributes"];
  attributes["JOINTS_0"] = glb.addAccessor(glb.addView(bytesOf(joints)), 5121, "VEC4", 9);
  std::string bytes;
  if (component == 5126) bytes = bytesOf(std::vector<float>(weights.begin(), weights.end()));
  if (component == 5121) {
    std::vector<std::uint8_t> whole;
    for (const double w : weights) whole.push_back(static_cast<std::uint8_t>(std::lround(255 * w)));
    bytes = bytesOf(whole);
  }
  attributes["WEIGHTS_0"] = glb.addAccessor(glb.addView(bytes), component, "VEC4", 9);
  if (component != 5126) glb.attribute("WEIGHTS_0")["normalized"] = true;
  Json list = Json::array();
  for (int k = 0; k < 10; ++k) list.push_back(glb.add("nodes", {{"name", "joint"}}));
  glb.add("skins", {{"joints", list}});
  glb.json["nodes"][0]["skin"] = 0;
  addPlaces(glb);
  return glb;
}

/// Expects all attributes of a primitive to have as many elements as it has vertices.
inline void expectWhole(const Written& glb, std::size_t primitive) {
  const Json& count = glb.accessor(glb.attribute("POSITION", 0, primitive))["count"];
  for (const auto& [name, number] : glb.primitive(0, primitive)["attributes"].items())
    EXPECT_EQ(glb.accessor(number.get<std::size_t>())["count"], count) << name;
}

}  // namespace sweepface::testing
