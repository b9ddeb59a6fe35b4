#include "usd/looks.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

#include "gltf/scene.hpp"
#include "usd/prim_names.hpp"

namespace sweepface::usd {
namespace {

using gltf::Json;

/// The ending of an image's name, or nothing if it is of a type that USD does not know.
std::string_view endingOf(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG\r\n\x1A\n")) return ".png";
  if (bytes.starts_with("\xFF\xD8\xFF")) return ".jpg";
  return {};
}

double numberOf(const Json& object, std::string_view key, double absent) {
  const Json* const found = gltf::find(object, key);
  return found && found->is_number() ? found->get<double>() : absent;
}

/// From 0 to 1, as glTF has them.
double shareOf(const Json& object, std::string_view key, double absent) {
  return std::clamp(numberOf(object, key, absent), 0.0, 1.0);
}

/// Member by member; empty where there is none.
const Json& memberOf(const Json& object, std::string_view key) {
  static const Json none;
  const Json* const found = gltf::find(object, key);
  return found ? *found : none;
}

std::string nameOf(const Json& object) {
  const Json& name = memberOf(object, "name");
  return name.is_string() ? name.get<std::string>() : "";
}

Vec3 colourOf(const Json& object, std::string_view key, const Vec3& absent) {
  const Json& list = memberOf(object, key);
  Vec3 colour = absent;
  for (int c = 0; c < 3; ++c)
    if (list.is_array() && list.size() >= 3 && list[c].is_number())
      coordinate(colour, c) = std::clamp(list[c].get<double>(), 0.0, 1.0);
  return colour;
}

class SceneLooks {
 public:
  explicit SceneLooks(const gltf::Document& document)
      : document_(document), images_(document.list("images").size()) {}

  /// The looks of materials with these names.
  Looks read(const std::vector<std::string>& wanted) {
    const Json& materials = document_.list("materials");
    for (std::size_t m = 0; m < materials.size(); ++m) {
      std::string name = nameOf(materials[m]);
      if (name.empty()) name = fmt::format("material_{}", m);
      if (std::ranges::find(wanted, name) == wanted.end() || looks_.byName.contains(name)) continue;
      looks_.byName.emplace(std::move(name), lookOf(materials[m]));
    }
    return std::move(looks_);
  }

 private:
  Look lookOf(const Json& material) {
    const Json& pbr = memberOf(material, "pbrMetallicRoughness");
    const Json& base = memberOf(pbr, "baseColorTexture");
    const Json& mode = memberOf(material, "alphaMode");
    const Json& factors = memberOf(pbr, "baseColorFactor");
    Look look;
    look.colour = colourOf(pbr, "baseColorFactor", {1, 1, 1});
    if (factors.is_array() && factors.size() == 4 && factors[3].is_number())
      look.opacity = std::clamp(factors[3].get<double>(), 0.0, 1.0);
    look.isTransparent = mode == "BLEND" || mode == "MASK";
    if (mode == "MASK") look.opacityThreshold = shareOf(material, "alphaCutoff", 0.5);
    look.metallic = shareOf(pbr, "metallicFactor", 1);
    look.roughness = shareOf(pbr, "roughnessFactor", 1);
    look.emission = colourOf(material, "emissiveFactor", {});
    look.colourMap = mapOf(base, base);
    look.roughnessMap = mapOf(memberOf(pbr, "metallicRoughnessTexture"), base);
    look.normalMap = mapOf(memberOf(material, "normalTexture"), base);
    look.occlusionMap = mapOf(memberOf(material, "occlusionTexture"), base);
    look.emissionMap = mapOf(memberOf(material, "emissiveTexture"), base);
    return look;
  }

  /// The rig's texture coordinates are those of the base colour.
  static bool areOfTheRig(const Json& map, const Json& base) {
    const auto transform = [](const Json& of) -> const Json& {
      return memberOf(memberOf(of, "extensions"), "KHR_texture_transform");
    };
    const double set = numberOf(transform(map), "texCoord", numberOf(map, "texCoord", 0));
    return set == 0 && transform(map) == transform(base);
  }

  Map mapOf(const Json& map, const Json& base) {
    if (!map.is_object() || !areOfTheRig(map, base)) return {};
    const Json& textures = document_.list("textures");
    const auto texture = gltf::findIndex(map, "index", textures.size());
    if (!texture) return {};
    const auto source = gltf::findIndex(textures[*texture], "source", images_.size());
    if (!source) return {};
    const Json& samplers = document_.list("samplers");
    const auto sampler = gltf::findIndex(textures[*texture], "sampler", samplers.size());
    const Json& wraps = sampler ? samplers[*sampler] : memberOf(map, "");
    return {imageOf(*source), {wrapOf(wraps, "wrapS"), wrapOf(wraps, "wrapT")}};
  }

  static std::string_view wrapOf(const Json& sampler, std::string_view key) {
    constexpr double clamp = 33071, mirror = 33648;  // as OpenGL numbers them
    const double wrap = numberOf(sampler, key, 0);
    return wrap == clamp ? "clamp" : wrap == mirror ? "mirror" : "repeat";
  }

  /// The image's place among those that are used, or -1.
  Index imageOf(std::size_t image) {
    if (images_[image]) return *images_[image];
    images_[image] = -1;
    const Json& json = document_.list("images")[image];
    const auto view = gltf::findIndex(json, "bufferView", document_.views.size());
    if (!view) return -1;
    const std::string_view bytes = document_.bytesOf(*view), ending = endingOf(bytes);
    if (ending.empty()) return -1;
    const std::string name = nameOf(json);
    const std::string file = names_.take(name.empty() ? "image" : name);
    images_[image] = static_cast<Index>(looks_.images.size());
    looks_.images.push_back({fmt::format("textures/{}{}", file, ending), std::string(bytes)});
    return *images_[image];
  }

  const gltf::Document& document_;
  std::vector<std::optional<Index>> images_;  // of the scene: where each is among those used
  PrimNames names_;
  Looks looks_;
};

}  // namespace

Result<Looks> looksOf(const Rig& rig) {
  if (rig.scene.empty()) return Looks{};
  const auto document = gltf::parseScene(rig.scene);
  if (!document) return std::unexpected(document.error());
  return SceneLooks(*document).read(rig.source.polygons.materials);
}

}  // namespace sweepface::usd
