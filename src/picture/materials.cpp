#include "picture/materials.hpp"

#include "picture/lowered.hpp"

namespace sweepface {
namespace {

constexpr Colour kSkin{0.86f, 0.715f, 0.63f}, kLips{0.76f, 0.50f, 0.46f},
    kTeeth{0.93f, 0.90f, 0.84f}, kGums{0.74f, 0.45f, 0.43f}, kWhite{0.93f, 0.92f, 0.90f},
    kIris{0.38f, 0.46f, 0.50f}, kPupil{0.12f, 0.11f, 0.11f}, kHair{0.25f, 0.19f, 0.16f},
    kHollow{0.45f, 0.27f, 0.23f};

struct Look {
  std::string_view word;
  std::optional<Colour> colour;
};

// The first of these words that a name contains decides.
constexpr Look kLooks[] = {
    {"occlusion", {}}, {"lacrimal", {}},   {"tear", {}},        {"cornea", {}},
    {"fluid", {}},     {"eyeblend", {}},   {"lash", {}},        {"eyebrow", kHair},
    {"hair", kHair},   {"beard", kHair},   {"teeth", kTeeth},   {"tooth", kTeeth},
    {"gum", kGums},    {"tongue", kGums},  {"lip", kLips},      {"iris", kIris},
    {"pupil", kPupil}, {"sclera", kWhite}, {"eyeball", kWhite}, {"nostril", kHollow},
};

}  // namespace

std::optional<Colour> materialColour(std::string_view name) {
  const std::string lower = lowered(name);
  for (const Look& look : kLooks)
    if (lower.find(look.word) != lower.npos) return look.colour;
  return kSkin;
}

std::vector<std::optional<Colour>> faceColours(const Polygons& polygons) {
  std::vector<std::optional<Colour>> ofMaterial;
  for (const std::string& name : polygons.materials) ofMaterial.push_back(materialColour(name));
  std::vector<std::optional<Colour>> result(polygons.faceCount(), kSkin);
  if (polygons.faceMaterial.empty()) return result;
  for (Index f = 0; f < polygons.faceCount(); ++f)
    if (const Index m = polygons.faceMaterial[f]; m >= 0) result[f] = ofMaterial[m];
  return result;
}

}  // namespace sweepface
