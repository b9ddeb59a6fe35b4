#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/result.hpp"
#include "sweepface/rig.hpp"

namespace sweepface::usd {

struct Image {
  std::string file;  ///< its name beside the layer: textures/skin.png
  std::string bytes;
};

/// An image on a material, by the mesh's texture coordinates.
struct Map {
  Index image = -1;  ///< or -1: none
  std::array<std::string_view, 2> wrap{"repeat", "repeat"};
  double strength = 1;  ///< of normals and occlusion: 0 is as without a map
};

/// How a material looks, as UsdPreviewSurface has it. Numbers are factors of their maps.
struct Look {
  Vec3 colour{1, 1, 1}, emission;
  double opacity = 1, metallic = 0, roughness = 0.7;
  bool isTransparent = false;          ///< whether opacity counts
  double opacityThreshold = 0;         ///< greater than 0: whatever is less opaque is left out
  double coat = 0, coatRoughness = 0;  ///< of a clear layer, such as the wet one of eyes
  double refraction = 1.5;             ///< index of refraction
  Map colourMap, normalMap, roughnessMap, occlusionMap, emissionMap, coatMap, coatRoughnessMap;
};

/// The looks of materials by their names, and the images they have.
struct Looks {
  std::map<std::string, Look, std::less<>> byName;
  std::vector<Image> images;
};

/// Those in the scene that came with a rig. Maps are left out without images, if these are neither
/// PNG nor JPEG, as USD asks, or if they have other texture coordinates than the rig.
Result<Looks> looksOf(const Rig& rig, bool withImages);

}  // namespace sweepface::usd
