#include "gltf/scene.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

#include "gltf/accessor_uses.hpp"
#include "gltf/binary.hpp"
#include "gltf/image_type.hpp"
#include "gltf/left_to_face.hpp"
#include "gltf/references.hpp"
#include "gltf/resources.hpp"
#include "gltf/same_vertices.hpp"
#include "gltf/skins.hpp"
#include "io/text.hpp"

namespace sweepface::gltf {
namespace {

namespace fs = std::filesystem;

// ---- Taking out what the rig stands for ----

class Emptier {
 public:
  Emptier(Document& document, const Parts& parts, const LeftToFace& left)
      : document_(document),
        parts_(parts),
        left_(left),
        others_(usedAccessors(document, parts,
                              [&](std::string_view name, const Json& reference) {
                                return !isGeometry(name) && !left.indices.contains(&reference) &&
                                       !left.texcoords.contains(&reference);
                              })),
        touched_(document.views.size()) {}

  void run() {
    for (std::size_t p = 0; p < parts_.parts.size(); ++p) {
      const Part& part = parts_.parts[p];
      Json& primitive = primitiveOf(document_, parts_, part);
      emptyIndices(primitive, p);
      emptyAttributes(primitive["attributes"], part.run, 0);
      if (Json* const targets = find(primitive, "targets"))
        for (std::size_t t = 0; t < targets->size(); ++t)
          emptyAttributes((*targets)[t], part.run, t + 1);
    }
    for (std::size_t accessor : tangents_)
      if (!others_[accessor] && !claimed_.contains(accessor)) empty(accessor, floats);
    if (!usesUnknownExtensions(document_.json)) emptyUnused();
  }

  const std::vector<bool>& touched() const { return touched_; }

 private:
  /// Accessors that other programs left behind, such as those of targets that they took out, if
  /// they are sound.
  void emptyUnused() {
    const std::vector<std::size_t> uses = accessorUseCounts(document_);
    for (std::size_t a = 0; a < uses.size(); ++a)
      if (uses[a] == 0 && accessorAt(document_, a)) empty(a, Json(accessors()[a]["componentType"]));
  }

  static constexpr int floats = static_cast<int>(Component::float32);

  /// Their count is kept, as that of a list of triangles.
  void emptyIndices(Json& primitive, std::size_t part) {
    Json* const reference = find(primitive, "indices");
    const auto left = left_.indices.find(reference);
    if (left == left_.indices.end()) return;
    const Json type = accessors()[named(*reference)]["componentType"];
    *reference = claim({named(*reference), part, 0, "indices"}, type);
    accessors()[named(*reference)]["count"] = left->second;
    if (Json* const mode = find(primitive, "mode")) *mode = listMode;
  }

  /// `shape` is 0 for the base and 1 + k for target k.
  void emptyAttributes(Json& attributes, std::size_t run, std::size_t shape) {
    for (const char* name : {"POSITION", "NORMAL", "TEXCOORD_0"})
      if (Json* const reference = find(attributes, name))
        if (isGeometry(name) || left_.texcoords.contains(reference))
          *reference = claim({named(*reference), run, shape, name}, floats);
    if (const Json* const reference = find(attributes, "TANGENT")) {
      tangents_.insert(named(*reference));
      attributes.erase("TANGENT");
    }
  }

  std::size_t named(const Json& reference) { return *asIndex(reference, accessors().size()); }

  /// An accessor and what it is for.
  struct Claim {
    std::size_t accessor = 0;
    std::size_t place = 0;  // a run, or the part of indices
    std::size_t shape = 0;
    std::string_view name;
    auto operator<=>(const Claim&) const = default;
  };

  /// The emptied accessor that serves this use alone: the same one, or a new one if it serves
  /// others as well.
  std::size_t claim(const Claim& use, const Json& type) {
    const auto known = claims_.find(use);
    if (known != claims_.end()) return known->second;
    std::size_t accessor = use.accessor;
    if (others_[accessor] || !claimed_.insert(accessor).second) {
      // Without its name and extras: they could be long, and the uses many.
      Json copy = Json::object();
      for (const char* key : {"componentType", "count", "type"})
        copy[key] = accessors()[accessor][key];
      accessor = accessors().size();
      accessors().push_back(std::move(copy));
    }
    empty(accessor, type);
    if (use.name == "POSITION")
      for (const char* bound : {"min", "max"}) accessors()[accessor][bound] = {0, 0, 0};
    return claims_[use] = accessor;
  }

  void empty(std::size_t accessor, const Json& type) {
    Json& json = accessors()[accessor];
    touch(json);
    if (const Json* const sparse = find(json, "sparse"))
      for (const char* part : {"indices", "values"}) touch((*sparse)[part]);
    json["componentType"] = type;
    for (const char* key : {"bufferView", "byteOffset", "sparse", "normalized", "min", "max"})
      json.erase(key);
  }

  void touch(const Json& holder) {
    if (const Json* const view = find(holder, "bufferView"))
      touched_[*asIndex(*view, touched_.size())] = true;
  }

  Json& accessors() { return document_.json["accessors"]; }

  Document& document_;
  const Parts& parts_;
  const LeftToFace& left_;
  std::vector<bool> others_;  // accessors that something else uses
  std::vector<bool> touched_;
  std::map<Claim, std::size_t> claims_;
  std::set<std::size_t> claimed_, tangents_;
};

// ---- Images ----

/// Moves images that are stored elsewhere into the document.
class ImageEmbedder {
 public:
  ImageEmbedder(Document& document, const fs::path& folder, std::vector<std::string>& warnings)
      : document_(document), folder_(folder), warnings_(warnings) {}

  Result<void> run() {
    Json* const images = find(document_.json, "images");
    for (std::size_t k = 0; images && k < images->size(); ++k) {
      Json& image = (*images)[k];
      const Json* const uri = find(image, "uri");
      if (!uri || !uri->is_string()) continue;
      const Json* const type = find(image, "mimeType");
      const Embedded& embedded =
          embedOnce(uri->get_ref<const std::string&>(),
                    type && type->is_string() ? type->get<std::string>() : std::string());
      if (total_ > io::maxFileBytes)
        return fail("its images are larger than 2 GiB; export only the face.");
      if (!embedded.problem.empty()) {
        warnings_.push_back(
            fmt::format("Image {} stays a reference to a file, which may be missing "
                        "where the face is written: {}",
                        k, embedded.problem));
        continue;
      }
      image.erase("uri");
      image["bufferView"] = embedded.view;
      if (!type) image["mimeType"] = embedded.mimeType;
    }
    return {};
  }

 private:
  struct Embedded {
    std::size_t view = 0;
    std::string mimeType, problem;
  };

  /// `given` is the type that the image says it has.
  const Embedded& embedOnce(const std::string& uri, const std::string& given) {
    const auto [known, isNew] = embedded_.try_emplace(identityOf(uri, folder_));
    if (isNew) known->second = embed(uri, given);
    return known->second;
  }

  Embedded embed(const std::string& uri, const std::string& given) {
    auto fetched = fetch(uri, folder_);
    if (!fetched) return {0, {}, fetched.error().message};
    const std::string kind = imageTypeOf(fetched->bytes);
    const std::string type = !kind.empty()                ? kind
                             : !fetched->mimeType.empty() ? fetched->mimeType
                                                          : given;
    if (fetched->bytes.empty() || type.empty())
      return {0, {}, fmt::format("the file {} is no image of a known kind.", io::inQuotes(uri))};
    total_ += fetched->bytes.size();
    return {document_.addBuffer(std::move(fetched->bytes)), type, {}};
  }

  Document& document_;
  const fs::path& folder_;
  std::vector<std::string>& warnings_;
  std::map<std::string, Embedded> embedded_;  // by identityOf()
  std::size_t total_ = 0;                     // bytes of them all
};

// ---- Warnings ----

bool hasNormalMap(const Json& material) {
  const auto isNormalMap = [](const std::string& key) {
    return key == "normalTexture" || key.ends_with("NormalTexture");
  };
  for (const auto& [key, value] : material.items()) {
    if (isNormalMap(key)) return true;
    if (key != "extensions" || !value.is_object()) continue;
    for (const Json& extension : value)
      if (extension.is_object())
        for (const auto& [inner, unused] : extension.items())
          if (isNormalMap(inner)) return true;
  }
  return false;
}

/// Whether a normal map of a part relies on tangents in the file.
bool losesTangents(const Document& document, const Parts& parts) {
  const Json& materials = document.list("materials");
  return std::ranges::any_of(parts.parts, [&](const Part& part) {
    const Json& primitive = primitiveOf(document, parts, part);
    const Json* const reference = find(primitive, "material");
    const auto material = reference ? asIndex(*reference, materials.size()) : std::nullopt;
    return material && find(primitive["attributes"], "TANGENT") &&
           hasNormalMap(materials[*material]);
  });
}

}  // namespace

Result<Scene> makeScene(Document document, const Parts& parts, const Polygons& polygons,
                        const fs::path& folder) {
  if (auto ok = checkReferences(document); !ok) return std::unexpected(ok.error());
  const auto left = leftToFace(document, parts, polygons);
  if (!left) return std::unexpected(left.error());
  Scene scene;
  if (losesTangents(document, parts))
    scene.warnings.push_back(
        "The tangents of the face are not carried over, since the surface has other normals; "
        "programs compute them for its normal maps.");
  Emptier emptier(document, parts, *left);
  emptier.run();
  std::vector<bool> touched = emptier.touched();
  bindWherePlaced(document, parts, touched);
  if (auto ok = ImageEmbedder(document, folder, scene.warnings).run(); !ok)
    return std::unexpected(ok.error());
  touched.resize(document.views.size());
  const std::string binary = gatherBinary(document, touched);
  scene.glb = formatContainer(document.json, binary);
  if (scene.glb.size() <= io::maxFileBytes) return scene;
  return fail("what it holds besides the face is larger than 2 GiB; export only the face.");
}

}  // namespace sweepface::gltf
