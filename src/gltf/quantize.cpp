// Positions are 16-bit shares of a cube, p = middle + half · share. For a mesh without a skin, a
// node undoes this by its scale and translation: its own node if that does nothing else, or else a
// new one below it. A skin ignores nodes; its inverse bind matrices undo it.
#include "gltf/quantize.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "sweepface/box.hpp"

#include "gltf/skins.hpp"
#include "io/text.hpp"

namespace sweepface::gltf {
namespace {

constexpr const char* extensionName = "KHR_mesh_quantization";

double largestOf(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Slightly larger, so that rounded values stay inside.
double roomy(double half) { return half > 0 ? single(half * (1 + 1e-6)) : 1; }

}  // namespace

std::vector<Encoding> chooseEncodings(const BoundScene& scene, const MorphShapes& shapes,
                                      const Places& places) {
  const Parts& parts = scene.parts;
  std::vector<Box> boxes(parts.meshes.size());
  std::vector<Affine> fromScene;
  for (const RigMesh& mesh : parts.meshes) fromScene.push_back(mesh.world.inverse());
  const auto eachPlace = [&](auto act) {
    for (std::size_t r = 0; r < places.size(); ++r)
      for (const Index place : places[r]) act(parts.runs[r].rigMesh, place);
  };
  eachPlace([&](std::size_t mesh, Index place) {
    boxes[mesh].include(fromScene[mesh].point(shapes.neutral().positions[place]));
  });
  std::vector<double> half(parts.meshes.size(), 0.0);
  for (std::size_t m = 0; m < half.size(); ++m) half[m] = 0.5 * largestOf(boxes[m].size());
  for (const Index target : scene.targets) {
    const std::vector<Vec3> moves = shapes.target(target, false).positions;
    eachPlace([&](std::size_t mesh, Index place) {
      half[mesh] = std::max(half[mesh], largestOf(fromScene[mesh].direction(moves[place])));
    });
  }
  // For a mesh that no node shows, nothing would undo it.
  std::vector<char> isShown(half.size(), false);
  for (const Index mesh : shownMeshes(scene))
    if (mesh >= 0) isShown[mesh] = true;
  std::vector<Encoding> encodings(half.size());
  for (std::size_t m = 0; m < half.size(); ++m) {
    if (!isShown[m]) continue;
    const Vec3 c = boxes[m].centre();
    const Vec3 middle{single(c.x), single(c.y), single(c.z)};
    // Rounding the middle moves the cube a little.
    encodings[m] = {true, middle, roomy(half[m] + largestOf(c - middle))};
  }
  return encodings;
}

namespace {

/// Whether an extension does not refer to nodes, so that a mesh may move to another one.
bool ignoresNodes(std::string_view extension) {
  constexpr std::array prefixes{"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                "KHR_lights_",    "KHR_mesh_",    "KHR_xmp"};
  return std::ranges::any_of(prefixes,
                             [&](const char* prefix) { return extension.starts_with(prefix); });
}

class Undoer {
 public:
  Undoer(BoundScene& scene, const std::vector<Encoding>& encodings, Builder& builder)
      : scene_(scene), json_(scene.document.json), encodings_(encodings), builder_(builder) {}

  Result<void> run() {
    if (auto ok = checkPrimitives(); !ok) return ok;
    noteUses();
    const std::vector<Index> shown = shownMeshes(scene_);
    for (std::size_t n = 0; n < shown.size(); ++n)
      if (shown[n] >= 0)
        if (auto ok = visit(n, encodings_[shown[n]]); !ok) return ok;
    redirectWeights();
    addExtension("extensionsUsed");
    addExtension("extensionsRequired");
    return {};
  }

 private:
  std::unexpected<Error> cannot(std::string_view why) const {
    return fail(fmt::format("The face cannot be quantized: {}; export it without.", why));
  }

  /// Refuses meshes with other primitives, which would be scaled with the face.
  Result<void> checkPrimitives() const {
    std::vector<std::size_t> own(encodings_.size());
    for (const Part& part : scene_.parts.parts) ++own[scene_.parts.runs[part.run].rigMesh];
    for (std::size_t m = 0; m < own.size(); ++m) {
      if (!encodings_[m].quantized) continue;
      const std::size_t mesh = scene_.parts.meshes[m].mesh;
      if (own[m] != listOf(scene_.document.list("meshes")[mesh], "primitives").size())
        return cannot(fmt::format("its mesh {} has points, lines or triangles besides it", mesh));
    }
    return {};
  }

  template <typename Act>
  void eachChannelTarget(Act act) {
    Json* const animations = find(json_, "animations");
    for (std::size_t a = 0; animations && a < animations->size(); ++a) {
      Json* const channels = find((*animations)[a], "channels");
      for (std::size_t c = 0; channels && channels->is_array() && c < channels->size(); ++c)
        if (Json* const target = find((*channels)[c], "target")) act(*target);
    }
  }
  static bool isOfWeights(const Json& target) {
    const Json* const path = find(target, "path");
    return path && *path == "weights";
  }

  /// Notes nodes that animations move, and those that move other meshes as joints.
  void noteUses() {
    used_ = jointsOf(scene_.document);
    eachChannelTarget([&](const Json& target) {
      const auto node = findIndex(target, "node", used_.size());
      if (node && !isOfWeights(target)) used_[*node] = true;
    });
  }

  /// Makes animations of weights follow their meshes to the new nodes.
  void redirectWeights() {
    eachChannelTarget([&](Json& target) {
      const auto node = findIndex(target, "node", used_.size());
      const auto below = node && isOfWeights(target) ? below_.find(*node) : below_.end();
      if (below != below_.end()) target["node"] = below->second;
    });
  }

  Result<void> visit(std::size_t number, const Encoding& encoding) {
    Json& node = json_["nodes"][number];
    if (find(node, "skin")) return rebind(node, encoding);
    if (!isPlain(node, number)) return moveBelow(number, encoding);
    scale(node, encoding);
    return {};
  }

  static void scale(Json& node, const Encoding& e) {
    node["translation"] = {e.middle.x, e.middle.y, e.middle.z};
    node["scale"] = {e.half, e.half, e.half};
  }

  bool isPlain(const Json& node, std::size_t number) const {
    constexpr std::array kept{"name", "mesh", "weights", "extras"};
    for (const auto& [key, value] : node.items())
      if (std::ranges::find(kept, key) == kept.end()) return false;
    return !used_[number] && !uses("KHR_animation_pointer");
  }
  bool uses(std::string_view extension) const {
    return std::ranges::any_of(scene_.document.list("extensionsUsed"),
                               [&](const Json& name) { return name == extension; });
  }

  /// Moves the mesh to a node of its own, below the one that had it.
  Result<void> moveBelow(std::size_t number, const Encoding& encoding) {
    std::vector<std::string> extensions;
    for (const Json& name : scene_.document.list("extensionsUsed"))
      extensions.push_back(name.is_string() ? name.get<std::string>() : "?");
    // Some files do not declare the extensions that they use.
    if (const Json* const own = find(json_["nodes"][number], "extensions"); own && own->is_object())
      for (const auto& [name, value] : own->items()) extensions.push_back(name);
    for (const std::string& name : extensions)
      if (!ignoresNodes(name))
        return cannot(
            fmt::format("its node {} is more than a place, and the extension {} may need "
                        "it as it is",
                        number, name));
    Json child = Json::object();
    Json& node = json_["nodes"][number];
    if (const Json* const name = find(node, "name")) child["name"] = *name;
    for (const char* key : {"mesh", "weights"})
      if (const Json* const value = find(node, key)) {
        child[key] = *value;
        node.erase(key);
      }
    scale(child, encoding);
    const std::size_t below = json_["nodes"].size();
    node["children"].push_back(below);
    json_["nodes"].push_back(std::move(child));
    below_[number] = below;
    return {};
  }

  /// Gives a node a skin whose matrices undo the encoding first.
  Result<void> rebind(Json& node, const Encoding& encoding) {
    const auto skin = findIndex(node, "skin", scene_.document.list("skins").size());
    if (!skin) return cannot("a skin of its scene is not in the file");
    const auto [known, isNew] = skins_.try_emplace(std::pair{*skin, &encoding}, 0);
    if (isNew) {
      auto made = boundAgain(*skin, encoding);
      if (!made) return std::unexpected(made.error());
      known->second = *made;
    }
    node["skin"] = known->second;
    return {};
  }

  Result<std::size_t> boundAgain(std::size_t number, const Encoding& e) {
    Json skin = json_["skins"][number];
    auto matrices = inverseBindMatrices(scene_.document, number);
    if (!matrices) return cannot(io::withoutAdvice(matrices.error().message));
    for (Affine& matrix : *matrices) matrix = matrix * fromCube(e);
    skin["inverseBindMatrices"] = builder_.add(packMatrices(*matrices), Use::other);
    json_["skins"].push_back(std::move(skin));
    return json_["skins"].size() - 1;
  }

  static Affine fromCube(const Encoding& e) {
    return {{{{e.half, 0, 0}, {0, e.half, 0}, {0, 0, e.half}}}, e.middle};
  }

  void addExtension(const char* list) {
    Json& names = json_[list];
    if (!names.is_array()) names = Json::array();
    if (std::ranges::find(names, extensionName) == names.end()) names.push_back(extensionName);
  }

  BoundScene& scene_;
  Json& json_;
  const std::vector<Encoding>& encodings_;
  Builder& builder_;
  std::vector<bool> used_;                    // [nodes]
  std::map<std::size_t, std::size_t> below_;  // the new node that has a node's mesh
  std::map<std::pair<std::size_t, const Encoding*>, std::size_t> skins_;
};

}  // namespace

Result<void> undoEncodings(BoundScene& scene, const std::vector<Encoding>& encodings,
                           Builder& builder) {
  return Undoer(scene, encodings, builder).run();
}

}  // namespace sweepface::gltf
