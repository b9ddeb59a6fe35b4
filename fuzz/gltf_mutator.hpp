#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "gltf/document.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

/// Mutates a GLB so that it stays one: hardly any change to its raw bytes would get past the
/// container and the syntax of JSON.
namespace sweepface::fuzzing {

using gltf::Json;

struct Pieces {
  Json json;
  std::string binary;
};

/// Splits a GLB, however broken; nothing if there is no JSON in it.
inline std::optional<Pieces> takeApart(std::string_view bytes) {
  const auto chunk = [&](std::size_t at) -> std::string_view {
    if (bytes.size() < at + 8) return {};
    std::uint32_t size = 0;
    for (std::size_t k = 0; k < 4; ++k)
      size |= std::uint32_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
    return bytes.substr(at + 8, size);
  };
  const std::string_view text = chunk(12);
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  return Pieces{std::move(json), std::string(chunk(20 + text.size()))};
}

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  void mutate(Pieces& pieces) {
    const std::size_t changes = 1 + below(4);
    for (std::size_t k = 0; k < changes; ++k)
      if (below(3) == 0)
        mutateBytes(pieces.binary);
      else
        mutateJson(pieces.json);
    // Usually, keep the buffer as long as it says.
    Json* const buffers = gltf::find(pieces.json, "buffers");
    if (buffers && buffers->is_array() && !buffers->empty() && (*buffers)[0].is_object() &&
        below(8) != 0)
      (*buffers)[0]["byteLength"] = pieces.binary.size();
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }

  void mutateBytes(std::string& bytes) {
    std::size_t size = bytes.size();
    bytes.resize(size + 64);
    size = LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size());
    bytes.resize(size);
  }

  static void collect(Json& json, std::vector<Json*>& values) {
    values.push_back(&json);
    if (json.is_structured())
      for (Json& value : json) collect(value, values);
  }

  void mutateJson(Json& json) {
    std::vector<Json*> values;
    collect(json, values);
    Json& value = *values[below(values.size())];
    const Json& other = *values[below(values.size())];
    switch (below(6)) {
      case 0:
        value = number();
        break;
      case 1:
        value = text();
        break;
      case 2:
        value = Json(other);
        break;
      case 3:
        erase(value);
        break;
      case 4:
        add(value, other);
        break;
      default:
        if (value.is_number()) value = value.get<double>() + static_cast<double>(below(9)) - 4;
    }
    if (!json.is_object()) json = Json::object();
  }

  void erase(Json& value) {
    if (value.empty()) return;
    const std::size_t chosen = below(value.size());
    if (value.is_array()) value.erase(chosen);
    if (value.is_object()) {
      auto member = value.begin();
      std::advance(member, static_cast<std::ptrdiff_t>(chosen));
      value.erase(member);
    }
  }

  void add(Json& value, const Json& other) {
    Json copy = below(2) ? Json(other) : number();
    if (value.is_array()) value.push_back(value.empty() ? copy : Json(value[below(value.size())]));
    if (value.is_object()) value[std::string(keys[below(keys.size())])] = std::move(copy);
  }

  Json number() {
    switch (below(5)) {
      case 0:
        return below(8);
      case 1:
        return below(300);
      case 2:
        return -static_cast<std::int64_t>(below(4));
      case 3:
        return (std::uint64_t{1} << below(64)) + below(3) - 1;
      default:
        return std::array{0.5, -1e-3, 1e30, 1e300, -2e9}[below(5)];
    }
  }

  Json text() { return std::string(texts[below(texts.size())]); }

  static constexpr std::array<std::string_view, 40> keys{
      "bufferView",    "byteOffset",     "byteLength",
      "byteStride",    "buffer",         "count",
      "componentType", "type",           "normalized",
      "sparse",        "indices",        "values",
      "mode",          "targets",        "attributes",
      "POSITION",      "NORMAL",         "TANGENT",
      "TEXCOORD_0",    "COLOR_0",        "material",
      "mesh",          "skin",           "children",
      "matrix",        "translation",    "rotation",
      "scale",         "extras",         "targetNames",
      "uri",           "extensions",     "EXT_meshopt_compression",
      "filter",        "extensionsUsed", "images",
      "mimeType",      "primitives",     "inverseBindMatrices",
      "normalTexture"};
  static constexpr std::array<std::string_view, 24> texts{"SCALAR",
                                                          "VEC2",
                                                          "VEC3",
                                                          "VEC4",
                                                          "MAT2",
                                                          "MAT4",
                                                          "ATTRIBUTES",
                                                          "TRIANGLES",
                                                          "INDICES",
                                                          "OCTAHEDRAL",
                                                          "QUATERNION",
                                                          "EXPONENTIAL",
                                                          "NONE",
                                                          "open",
                                                          "",
                                                          "2.0",
                                                          "face.bin",
                                                          "data:;base64,AAAAAAAAgD8",
                                                          "data:,%41%42",
                                                          "../up.bin",
                                                          "EXT_hair",
                                                          "KHR_mesh_quantization",
                                                          "KHR_draco_mesh_compression",
                                                          "image/png"};

  std::mt19937 random_;
};

}  // namespace sweepface::fuzzing
