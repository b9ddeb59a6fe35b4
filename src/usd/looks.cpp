#include "usd/looks.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

#include "gltf/image_type.hpp"
#include "gltf/scene.hpp"
#include "io/text.hpp"
#include "usd/prim_names.hpp"

namespace sweepface::usd {
namespace {

using gltf::Json;

/// The ending of an image's name, or nothing if it is of a type that USD does not know.
std::string_view endingOf(std::string_view bytes) {
  const std::string type = gltf::imageTypeOf(bytes);
  return type == "image/png" ? ".png" : type == "image/jpeg" ? ".jpg" : "";
}

double numberOf(const Json& object, std::string_view key, double absent) {
  const Json* const found = gltf::find(object, key);
  return found && found->is_number() ? found->get<double>() : absent;
}

/// From 0 to 1, as glTF has them.
double shareOf(const Json& object, std::string_view key, double absent) {
  return std::clamp(numberOf(object, key, absent), 0.0, 1.0);
}

const Json& none() {
  static const Json json;
  return json;
}

const Json& memberOf(const Json& object, std::string_view key) {
  const Json* const found = gltf::find(object, key);
  return found ? *found : none();
}

Vec3 colourOf(const Json& object, std::string_view key, const Vec3& absent) {
  const Json& list = memberOf(object, key);
  Vec3 colour = absent;
  for (int c = 0; c < 3; ++c)
    if (list.is_array() && list.size() >= 3 && list[c].is_number())
      coordinate(colour, c) = std::clamp(list[c].get<double>(), 0.0, 1.0);
  return colour;
}

const Json& extensionOf(const Json& object, std::string_view name) {
  return memberOf(memberOf(object, "extensions"), name);
}

/// With KHR_materials_specular, or if it is 0, the index does not mean what it does in USD.
double refractionOf(const Json& material) {
  const double usual = Look{}.refraction;
  if (!extensionOf(material, "KHR_materials_specular").is_null()) return usual;
  const double index = numberOf(extensionOf(material, "KHR_materials_ior"), "ior", usual);
  return index >= 1 && index <= 1e6 ? index : usual;
}

class SceneLooks {
 public:
  SceneLooks(const gltf::Document& document, bool withImages)
      : document_(document), withImages_(withImages), images_(document.list("images").size()) {}

  /// The looks of materials with these names.
  Looks read(const std::vector<std::string>& wanted) {
    const Json& materials = document_.list("materials");
    const std::vector<std::string> names = gltf::materialNames(document_);
    for (std::size_t m = 0; m < materials.size(); ++m)
      if (std::ranges::find(wanted, names[m]) != wanted.end())
        looks_.byName.emplace(names[m], lookOf(materials[m]));
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
    if (mode == "MASK") look.opacityThreshold = shareOf(material, "alphaCutoff", 0.5);
    look.isTransparent = mode == "BLEND" || look.opacityThreshold > 0;
    look.metallic = shareOf(pbr, "metallicFactor", 1);
    look.roughness = shareOf(pbr, "roughnessFactor", 1);
    look.emission = std::clamp(numberOf(extensionOf(material, "KHR_materials_emissive_strength"),
                                        "emissiveStrength", 1),
                               0.0, 1e6) *
                    colourOf(material, "emissiveFactor", {});
    look.refraction = refractionOf(material);
    look.colourMap = mapOf(base, base);
    look.roughnessMap = mapOf(memberOf(pbr, "metallicRoughnessTexture"), base);
    look.normalMap = mapOf(memberOf(material, "normalTexture"), base);
    look.normalMap.strength =
        std::clamp(numberOf(memberOf(material, "normalTexture"), "scale", 1), -1e6, 1e6);
    look.occlusionMap = mapOf(memberOf(material, "occlusionTexture"), base);
    look.occlusionMap.strength = shareOf(memberOf(material, "occlusionTexture"), "strength", 1);
    look.emissionMap = mapOf(memberOf(material, "emissiveTexture"), base);
    // Factors of maps are mostly 1: alone they would make metal of skin, and let it glow.
    if (gltf::find(pbr, "metallicRoughnessTexture") && look.roughnessMap.image < 0)
      look.metallic = 0;
    if (gltf::find(material, "emissiveTexture") && look.emissionMap.image < 0) look.emission = {};
    addCoat(look, extensionOf(material, "KHR_materials_clearcoat"), base);
    return look;
  }

  void addCoat(Look& look, const Json& coat, const Json& base) {
    look.coat = shareOf(coat, "clearcoatFactor", 0);
    look.coatRoughness = shareOf(coat, "clearcoatRoughnessFactor", 0);
    look.coatMap = mapOf(memberOf(coat, "clearcoatTexture"), base);
    look.coatRoughnessMap = mapOf(memberOf(coat, "clearcoatRoughnessTexture"), base);
    if (gltf::find(coat, "clearcoatTexture") && look.coatMap.image < 0) look.coat = 0;
    if (gltf::find(coat, "clearcoatRoughnessTexture") && look.coatRoughnessMap.image < 0)
      look.coatRoughness = 0;
  }

  static const Json& toldOf(const Json& map) { return extensionOf(map, "KHR_texture_transform"); }

  /// Offset, scale and rotation.
  static std::array<double, 5> transformOf(const Json& told) {
    const auto at = [&](std::string_view key, std::size_t k, double usual) {
      const Json& list = memberOf(told, key);
      return list.is_array() && k < list.size() && list[k].is_number() ? list[k].get<double>()
                                                                       : usual;
    };
    return {at("offset", 0, 0), at("offset", 1, 0), at("scale", 0, 1), at("scale", 1, 1),
            numberOf(told, "rotation", 0)};
  }

  static bool areOfTheFirstSet(const Json& map) {
    return numberOf(toldOf(map), "texCoord", numberOf(map, "texCoord", 0)) == 0;
  }

  /// The rig's texture coordinates are those of the base colour, or else the first set.
  static bool areOfTheRig(const Json& map, const Json& base) {
    return areOfTheFirstSet(map) &&
           transformOf(toldOf(map)) == transformOf(areOfTheFirstSet(base) ? toldOf(base) : none());
  }

  Map mapOf(const Json& map, const Json& base) {
    if (!withImages_ || !map.is_object() || !areOfTheRig(map, base)) return {};
    const Json& textures = document_.list("textures");
    const auto texture = gltf::findIndex(map, "index", textures.size());
    if (!texture) return {};
    const auto source = gltf::findIndex(textures[*texture], "source", images_.size());
    if (!source) return {};
    const Json& samplers = document_.list("samplers");
    const auto sampler = gltf::findIndex(textures[*texture], "sampler", samplers.size());
    const Json& wraps = sampler ? samplers[*sampler] : none();
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
    const Json& name = memberOf(json, "name");
    const std::string called = name.is_string() ? name.get<std::string>() : "";
    const std::string file = names_.take(called.empty() ? "image" : called);
    images_[image] = static_cast<Index>(looks_.images.size());
    looks_.images.push_back({fmt::format("textures/{}{}", file, ending), std::string(bytes)});
    return *images_[image];
  }

  const gltf::Document& document_;
  bool withImages_;
  std::vector<std::optional<Index>> images_;  // of the scene: where each is among those used
  PrimNames names_;
  Looks looks_;
};

}  // namespace

Result<Looks> looksOf(const Rig& rig, bool withImages) {
  if (rig.scene.empty()) return Looks{};
  const auto document = gltf::parseScene(rig.scene);
  if (!document)
    return fail(fmt::format(
        "The scene that came with the face cannot be read ({}); convert the face again, or with "
        "--bare.",
        io::withoutAdvice(document.error().message)));
  const Polygons& polygons = rig.source.polygons;
  return SceneLooks(*document, withImages && !polygons.cornerTexcoords.empty())
      .read(polygons.materials);
}

}  // namespace sweepface::usd
