#include <algorithm>
#include <map>
#include <tuple>

#include "eval/triangulate.hpp"
#include "gltf/bound_scene.hpp"
#include "gltf/builder.hpp"
#include "io/single.hpp"

namespace sweepface::gltf {
namespace {

/// Splits vertices by texture coordinate. The first texture coordinate found at a vertex of the
/// source stays with it; others get new vertices, after all of the source's.
class VertexSplitter {
 public:
  explicit VertexSplitter(const SourceMesh& source)
      : polygons_(source.polygons), texcoords_(source.gridVertex.size()) {
    const auto count = static_cast<Index>(source.gridVertex.size());
    for (Index v = 0; v < count; ++v) vertices_.push_back(v);
    taken_.assign(count, false);
  }

  Index vertexAt(Index corner) {
    const Index v = polygons_.corners[corner];
    const Index t = polygons_.cornerTexcoords.empty() ? -1 : polygons_.cornerTexcoords[corner];
    if (t < 0) return v;
    const Vec2 texcoord = polygons_.texcoords[t];
    if (!taken_[v]) {
      taken_[v] = true;
      texcoords_[v] = texcoord;
    }
    if (texcoords_[v] == texcoord) return v;
    const auto [copy, isNew] = copies_.try_emplace({v, texcoord.x, texcoord.y}, 0);
    if (isNew) copy->second = add(v, texcoord);
    return copy->second;
  }

  bool hasTexture() const { return std::ranges::count(taken_, true) > 0; }
  const std::vector<Index>& vertices() const { return vertices_; }
  const std::vector<Vec2>& texcoords() const { return texcoords_; }

 private:
  Index add(Index source, const Vec2& texcoord) {
    vertices_.push_back(source);
    texcoords_.push_back(texcoord);
    taken_.push_back(true);
    return static_cast<Index>(vertices_.size()) - 1;
  }

  const Polygons& polygons_;
  std::vector<Index> vertices_;  // the source's vertex of each
  std::vector<Vec2> texcoords_;
  std::vector<bool> taken_;  // whether it has a texture coordinate of its own
  std::map<std::tuple<Index, double, double>, Index> copies_;  // by source and texture coordinate
};

Json materialNamed(const std::string& name) {
  // The defaults of glTF make metal, which skin is not. Mouths and lashes are seen from both sides.
  return {{"name", name},
          {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.7}}},
          {"doubleSided", true}};
}

class SceneMaker {
 public:
  SceneMaker(const Rig& rig, const std::vector<Vec3>& positions)
      : rig_(rig), polygons_(rig.source.polygons), positions_(positions), splitter_(rig.source) {}

  Result<BoundScene> make() {
    cutFaces();
    if (triangles_.empty())
      return fail("The face has no polygon with three different corners to export.");
    scene_.vertices = splitter_.vertices();
    if (!io::areSingle(polygons_.texcoords))
      return fail("A texture coordinate is not a number that a glTF can hold.");
    describe();
    auto parts = findParts(scene_.document);
    if (!parts) return std::unexpected(parts.error());
    scene_.parts = std::move(*parts);
    for (Index k = 0; k < static_cast<Index>(rig_.targets.size()); ++k) scene_.targets.push_back(k);
    return std::move(scene_);
  }

 private:
  /// Sorts every face's triangles into the primitive of its material.
  void cutFaces() {
    std::vector<Vec3> corners;
    for (Index face = 0; face < polygons_.faceCount(); ++face) {
      const Index start = polygons_.faceStart[face], size = polygons_.faceSize(face);
      corners.clear();
      for (Index k = 0; k < size; ++k) {
        scene_.cornerVertex.push_back(splitter_.vertexAt(start + k));
        corners.push_back(positions_[polygons_.corners[start + k]]);
      }
      const Index material = polygons_.faceMaterial.empty() ? -1 : polygons_.faceMaterial[face];
      faceMaterial_.push_back(material);
      for (const Triangle& t : triangulate(corners)) {
        const Index* const vertex = &scene_.cornerVertex[start];
        if (vertex[t[0]] == vertex[t[1]] || vertex[t[1]] == vertex[t[2]] ||
            vertex[t[2]] == vertex[t[0]])
          continue;
        auto& list = triangles_[material];
        for (const Index corner : t) list.push_back(vertex[corner]);
      }
    }
  }

  void describe() {
    Json& json = scene_.document.json;
    json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
    json["scenes"].push_back({{"nodes", Json::array({0})}});
    json["nodes"].push_back({{"name", "face"}, {"mesh", 0}});
    for (const char* list : {"materials", "meshes", "accessors", "bufferViews"})
      json[list] = Json::array();
    json["buffers"].push_back({{"byteLength", 0}});
    Builder builder(scene_.document);
    addAccessors(builder);
    Json mesh{{"name", "face"}, {"primitives", Json::array()}};
    std::map<Index, Index> partOfMaterial;
    for (const auto& [material, list] : triangles_) {
      partOfMaterial.emplace(material, static_cast<Index>(partOfMaterial.size()));
      mesh["primitives"].push_back({{"attributes", attributes_},
                                    {"indices", builder.add(packIndices(list), Use::indices)},
                                    {"material", json["materials"].size()}});
      if (!targets_.empty()) mesh["primitives"].back()["targets"] = targets_;
      json["materials"].push_back(
          materialNamed(material < 0 ? "face" : polygons_.materials[material]));
    }
    builder.finish();
    if (!rig_.targets.empty()) {
      mesh["weights"] = std::vector<double>(rig_.targets.size(), 0.0);
      for (const Target& target : rig_.targets)
        mesh["extras"]["targetNames"].push_back(target.name);
    }
    json["meshes"].push_back(std::move(mesh));
    // Faces without a triangle need no primitive: their vertices are never asked for.
    for (const Index material : faceMaterial_) {
      const auto part = partOfMaterial.find(material);
      scene_.facePart.push_back(part == partOfMaterial.end() ? -1 : part->second);
    }
  }

  /// Positions, normals and targets get accessors with a count only; they are filled in later.
  void addAccessors(Builder& builder) {
    const auto hollow = [&] {
      Json& accessors = scene_.document.json["accessors"];
      accessors.push_back({{"componentType", static_cast<int>(Component::float32)},
                           {"count", scene_.vertices.size()},
                           {"type", "VEC3"}});
      return accessors.size() - 1;
    };
    attributes_ = {{"POSITION", hollow()}};
    // Meshes alone have no surface to give them normals.
    if (rig_.surface.patchCount() > 0) attributes_["NORMAL"] = hollow();
    if (splitter_.hasTexture()) {
      std::vector<Vec2> texcoords = splitter_.texcoords();
      for (Vec2& t : texcoords) t.y = 1 - t.y;  // glTF counts from the top
      attributes_["TEXCOORD_0"] =
          builder.add(pack(std::span<const Vec2>(texcoords)), Use::vertices);
    }
    for (std::size_t k = 0; k < rig_.targets.size(); ++k)
      targets_.push_back({{"POSITION", hollow()}});
  }

  const Rig& rig_;
  const Polygons& polygons_;
  const std::vector<Vec3>& positions_;
  VertexSplitter splitter_;
  std::map<Index, std::vector<Index>> triangles_;  // by material: vertices
  std::vector<Index> faceMaterial_;
  Json attributes_, targets_ = Json::array();
  BoundScene scene_;
};

}  // namespace

Result<BoundScene> sceneOfPolygons(const Rig& rig, const std::vector<Vec3>& positions) {
  return SceneMaker(rig, positions).make();
}

}  // namespace sweepface::gltf
