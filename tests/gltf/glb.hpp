#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/gltf.hpp"

#include "gltf/document.hpp"
#include "io/temporary_folder.hpp"

// GLB files made piece by piece.
namespace sweepface::testing {

using gltf::Json;

template <typename T>
std::string bytesOf(const std::vector<T>& values) {
  static_assert(std::endian::native == std::endian::little);
  std::string bytes(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

inline std::string floatsOf(const std::vector<Vec3>& vectors) {
  std::vector<float> values;
  for (const Vec3& v : vectors)
    for (const double x : {v.x, v.y, v.z}) values.push_back(static_cast<float>(x));
  return bytesOf(values);
}

/// A glTF under construction. Its JSON may be changed at will.
struct Glb {
  Json json = Json::object({{"asset", Json::object({{"version", "2.0"}})}});
  std::string binary;

  /// Appends to a list of the JSON; returns the entry's index.
  std::size_t add(const char* list, Json entry) {
    json[list].push_back(std::move(entry));
    return json[list].size() - 1;
  }

  std::size_t addView(std::string_view bytes, std::size_t stride = 0) {
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    Json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) view["byteStride"] = stride;
    binary += bytes;
    return add("bufferViews", view);
  }

  std::size_t addAccessor(std::size_t view, int component, std::string_view type,
                          std::size_t count) {
    return add(
        "accessors",
        {{"bufferView", view}, {"componentType", component}, {"type", type}, {"count", count}});
  }
  /// Single precision.
  std::size_t addVectors(const std::vector<Vec3>& vectors) {
    return addAccessor(addView(floatsOf(vectors)), 5126, "VEC3", vectors.size());
  }
  std::size_t addIndices(const std::vector<std::uint16_t>& indices) {
    return addAccessor(addView(bytesOf(indices)), 5123, "SCALAR", indices.size());
  }
  std::size_t addTexcoords(const std::vector<Vec2>& texcoords) {
    std::vector<float> values;
    for (const Vec2& t : texcoords)
      for (const double x : {t.x, t.y}) values.push_back(static_cast<float>(x));
    return addAccessor(addView(bytesOf(values)), 5126, "VEC2", texcoords.size());
  }
  /// Zeros except at a few places.
  std::size_t addSparse(std::size_t count, const std::vector<std::uint16_t>& where,
                        const std::vector<Vec3>& what) {
    Json sparse = {{"count", where.size()},
                   {"indices", {{"bufferView", addView(bytesOf(where))}, {"componentType", 5123}}},
                   {"values", {{"bufferView", addView(floatsOf(what))}}}};
    return add("accessors", {{"componentType", 5126},
                             {"type", "VEC3"},
                             {"count", count},
                             {"sparse", std::move(sparse)}});
  }

  /// The primitive of a mesh, for changes.
  Json& primitive(std::size_t mesh = 0, std::size_t number = 0) {
    return json["meshes"][mesh]["primitives"][number];
  }
  Json& accessor(std::size_t number) { return json["accessors"][number]; }
  /// The accessor of a primitive's attribute.
  Json& attribute(const char* name, std::size_t mesh = 0) {
    return accessor(primitive(mesh)["attributes"][name].get<std::size_t>());
  }

  std::string bytes() const { return gltf::formatContainer(withBuffer(), binary); }
  /// A .gltf whose buffer is the file `uri`.
  std::string text(std::string_view uri) const {
    Json whole = withBuffer();
    whole["buffers"][0]["uri"] = uri;
    return whole.dump();
  }

 private:
  Json withBuffer() const {
    Json whole = json;
    if (binary.empty() && !whole.contains("buffers")) return whole;
    if (!whole.contains("buffers")) whole["buffers"].push_back(Json::object());
    if (!whole["buffers"][0].contains("byteLength"))
      whole["buffers"][0]["byteLength"] = binary.size();
    return whole;
  }
};

// ---- A small face ----

/// A sheet of 2 × 2 quads, each cut into two triangles.
inline std::vector<Vec3> sheetPositions() {
  std::vector<Vec3> positions;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) positions.push_back({1.0 * i, 1.0 * j, 0.25 * i * j});
  return positions;
}
inline std::vector<std::uint16_t> sheetIndices() {
  std::vector<std::uint16_t> indices;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      for (const int k : {0, 1, 4, 0, 4, 3})
        indices.push_back(static_cast<std::uint16_t>(3 * j + i + k));
  return indices;
}
inline std::vector<Vec3> openDeltas() {
  std::vector<Vec3> deltas;
  for (int v = 0; v < 9; ++v) deltas.push_back({0, -0.125 * v, 0.125 * v});
  return deltas;
}

/// The sheet with the targets "open", dense, and "wink", sparse; shown by one node.
inline Glb smallFace() {
  Glb glb;
  const std::size_t position = glb.addVectors(sheetPositions());
  const std::size_t normal = glb.addVectors(std::vector<Vec3>(9, Vec3{0, 0, 1}));
  std::vector<Vec2> texcoords;
  for (const Vec3& p : sheetPositions()) texcoords.push_back({p.x / 2, p.y / 2});
  const std::size_t texcoord = glb.addTexcoords(texcoords);
  const std::size_t indices = glb.addIndices(sheetIndices());
  const std::size_t open = glb.addVectors(openDeltas());
  const std::size_t wink = glb.addSparse(9, {2, 5}, {{0, 0, 1}, {0, 1, 0}});
  Json primitive = {
      {"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", texcoord}}},
      {"indices", indices},
      {"material", 0},
      {"targets",
       Json::array({Json::object({{"POSITION", open}}), Json::object({{"POSITION", wink}})})}};
  glb.add("materials", {{"name", "skin"}});
  glb.add("meshes", {{"name", "head"},
                     {"primitives", Json::array({std::move(primitive)})},
                     {"extras", {{"targetNames", {"open", "wink"}}}}});
  glb.add("nodes", {{"mesh", 0}});
  return glb;
}

inline Result<RigSource> parse(const Glb& glb) { return parseGltf(glb.bytes(), "face.glb", {}); }

/// The source that is read. If it cannot be, adds a failure that says why.
inline RigSource read(const Glb& glb) {
  auto source = parse(glb);
  if (source) return std::move(*source);
  ADD_FAILURE() << source.error().message;
  return {};
}

inline ::testing::AssertionResult refused(const Glb& glb,
                                          std::initializer_list<std::string_view> parts) {
  const auto source = parse(glb);
  if (!source && !source.error().message.starts_with("face.glb: "))
    return ::testing::AssertionFailure() << "not named: " << source.error().message;
  return failsWith(source, parts);
}

}  // namespace sweepface::testing
