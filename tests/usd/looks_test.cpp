#include "usd/looks.hpp"

#include "sweepface/usd.hpp"

#include "gltf/written.hpp"
#include "usd/layer.hpp"

namespace sweepface {
namespace {

using namespace testing;

const std::string kPng = "\x89PNG\r\n\x1A\n and the rest", kJpeg = "\xFF\xD8\xFF and the rest";

/// The small face with a texture of these images.
Glb textured(const std::vector<std::string>& images) {
  Glb glb = smallFace();
  for (const std::string& image : images) {
    glb.add("images", {{"bufferView", glb.addView(image)}, {"mimeType", "image/png"}});
    glb.add("textures", {{"source", glb.json["images"].size() - 1}});
  }
  return glb;
}

Json& material(Glb& glb) { return glb.json["materials"][0]; }

usd::Look lookOf(const Glb& glb, bool withImages = true) {
  const auto looks = usd::looksOf(converted(glb), withImages);
  if (looks && looks->byName.contains("skin")) return looks->byName.at("skin");
  ADD_FAILURE() << "no look";
  return {};
}

TEST(Looks, AreThoseOfTheMaterial) {
  Glb glb = smallFace();
  material(glb) = {{"name", "skin"},
                   {"pbrMetallicRoughness",
                    {{"baseColorFactor", {0.5, 0.25, 7, 0.75}}, {"metallicFactor", 0.5}}},
                   {"alphaMode", "BLEND"},
                   {"emissiveFactor", {0, -1, 1}}};
  const usd::Look look = lookOf(glb);
  EXPECT_EQ(look.colour, (Vec3{0.5, 0.25, 1}));
  EXPECT_EQ(look.emission, (Vec3{0, 0, 1}));
  EXPECT_EQ(look.opacity, 0.75);
  EXPECT_TRUE(look.isTransparent);
  EXPECT_EQ(look.opacityThreshold, 0);
  EXPECT_EQ(look.metallic, 0.5);
  EXPECT_EQ(look.roughness, 1);
  EXPECT_EQ(look.colourMap.image, -1);
}

TEST(Looks, HaveClearLayersStrongLightsAndRefraction) {
  Glb glb = textured({kPng});
  material(glb)["emissiveFactor"] = {1, 0.5, 0};
  material(glb)["extensions"] = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}},
                                 {"KHR_materials_ior", {{"ior", 1.376}}},
                                 {"KHR_materials_clearcoat",
                                  {{"clearcoatFactor", 0.75},
                                   {"clearcoatRoughnessFactor", 0.125},
                                   {"clearcoatRoughnessTexture", {{"index", 0}}}}}};
  const usd::Look look = lookOf(glb);
  EXPECT_EQ(look.emission, (Vec3{4, 2, 0}));
  EXPECT_EQ(look.refraction, 1.376);
  EXPECT_EQ(look.coat, 0.75);
  EXPECT_EQ(look.coatRoughness, 0.125);
  EXPECT_EQ(look.coatMap.image, -1);
  EXPECT_EQ(look.coatRoughnessMap.image, 0);
  material(glb)["extensions"]["KHR_materials_clearcoat"]["clearcoatTexture"] = {{"index", 0}};
  EXPECT_EQ(lookOf(glb).coat, 0.75);
  EXPECT_EQ(lookOf(glb, false).coat, 0) << "its map is left out";
  EXPECT_EQ(lookOf(glb, false).coatRoughness, 0);
  material(glb)["extensions"] = {{"KHR_materials_emissive_strength", {{"emissiveStrength", -1}}},
                                 {"KHR_materials_ior", {{"ior", 0}}}};
  EXPECT_EQ(lookOf(glb).emission, Vec3{});
  EXPECT_EQ(lookOf(glb).refraction, 1.5);
  material(glb)["extensions"] = {{"KHR_materials_specular", {{"specularFactor", 0.5}}},
                                 {"KHR_materials_ior", {{"ior", 1000}}}};
  EXPECT_EQ(lookOf(glb).refraction, 1.5);
}

TEST(Looks, AreToldApartWhereMaterialsHaveOneName) {
  Glb glb = smallFace();
  material(glb)["pbrMetallicRoughness"]["baseColorFactor"] = {1, 0, 0, 1};
  Json blue = glb.primitive();
  blue["material"] =
      glb.add("materials",
              {{"name", "skin"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 1, 1}}}}});
  glb.json["meshes"][0]["primitives"].push_back(blue);
  const auto looks = usd::looksOf(converted(glb), false);
  ASSERT_TRUE(looks);
  EXPECT_EQ(looks->byName.at("skin").colour, (Vec3{1, 0, 0}));
  EXPECT_EQ(looks->byName.at("skin 2").colour, (Vec3{0, 0, 1}));
}

TEST(Looks, OfAFaceWithoutASceneAreUnknown) {
  const auto looks = usd::looksOf(converted(withTargets(plane(4, 4), 1)), true);
  ASSERT_TRUE(looks);
  EXPECT_TRUE(looks->byName.empty());
}

TEST(Looks, HaveTheImagesThatTheyUseOnce) {
  Glb glb = textured({"unused", kPng, kJpeg, "a webp"});
  glb.json["images"][1]["name"] = "my skin";
  const auto texture = [](int index) { return Json::object({{"index", index}}); };
  material(glb)["pbrMetallicRoughness"] = {{"baseColorTexture", texture(1)},
                                           {"metallicRoughnessTexture", texture(2)}};
  material(glb)["normalTexture"] = texture(1);
  material(glb)["occlusionTexture"] = texture(3);
  const auto looks = usd::looksOf(converted(glb), true);
  ASSERT_TRUE(looks);
  ASSERT_EQ(looks->images.size(), 2u);
  EXPECT_EQ(looks->images[0].file, "textures/my_skin.png");
  EXPECT_EQ(looks->images[0].bytes, kPng);
  EXPECT_EQ(looks->images[1].file, "textures/image.jpg");
  const usd::Look& look = looks->byName.at("skin");
  EXPECT_EQ(look.colourMap.image, 0);
  EXPECT_EQ(look.roughnessMap.image, 1);
  EXPECT_EQ(look.normalMap.image, 0);
  EXPECT_EQ(look.occlusionMap.image, -1);
  EXPECT_EQ(look.emissionMap.image, -1);
}

// The reader gives the rig the texture coordinates of the base colour.
TEST(Looks, LeaveOutMapsWithOtherTextureCoordinates) {
  Glb glb = textured({kPng});
  const Json moved = {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}};
  material(glb)["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}, {"extensions", moved}};
  material(glb)["normalTexture"] = {{"index", 0}};
  material(glb)["emissiveTexture"] = {{"index", 0}, {"extensions", moved}};
  material(glb)["occlusionTexture"] = {{"index", 0}, {"texCoord", 1}};
  const usd::Look look = lookOf(glb);
  EXPECT_EQ(look.colourMap.image, 0);
  EXPECT_EQ(look.emissionMap.image, 0);
  EXPECT_EQ(look.normalMap.image, -1);
  EXPECT_EQ(look.occlusionMap.image, -1);
}

TEST(Looks, KeepMapsThatAreMovedAlikeHoweverThatIsWritten) {
  Glb glb = textured({kPng});
  const auto moved = [&](const char* of, const char* how) {
    Json& map = of == std::string("base")
                    ? material(glb)["pbrMetallicRoughness"]["baseColorTexture"]
                    : material(glb)[of];
    map = {{"index", 0}, {"extensions", {{"KHR_texture_transform", Json::parse(how)}}}};
  };
  moved("base", R"({"offset": [0.5, 0], "scale": [2, 2]})");
  moved("normalTexture", R"({"scale": [2, 2], "rotation": 0, "offset": [0.5, 0.0]})");
  moved("emissiveTexture", R"({"scale": [2, 1], "offset": [0.5, 0]})");
  usd::Look look = lookOf(glb);
  EXPECT_EQ(look.normalMap.image, 0);
  EXPECT_EQ(look.emissionMap.image, -1);
  material(glb)["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  moved("normalTexture", R"({"offset": [0, 0]})");
  look = lookOf(glb);
  EXPECT_EQ(look.normalMap.image, 0);
}

// A base colour of the second set leaves the rig the first as it is.
TEST(Looks, HaveNoMapsThatAreMovedAlone) {
  Glb glb = textured({kPng});
  const Json moved = {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}};
  material(glb)["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", 0}, {"texCoord", 1}, {"extensions", moved}};
  material(glb)["normalTexture"] = {{"index", 0}, {"extensions", moved}};
  material(glb)["occlusionTexture"] = {{"index", 0}};
  const usd::Look look = lookOf(glb);
  EXPECT_EQ(look.colourMap.image, -1);
  EXPECT_EQ(look.normalMap.image, -1);
  EXPECT_EQ(look.occlusionMap.image, 0);
}

TEST(Looks, AreNeitherMetalNorGlowIfTheirMapsAreLeftOut) {
  Glb glb = textured({kPng});
  material(glb)["pbrMetallicRoughness"] = {{"metallicRoughnessTexture", {{"index", 0}}}};
  material(glb)["emissiveFactor"] = {1, 1, 1};
  material(glb)["emissiveTexture"] = {{"index", 0}};
  const usd::Look whole = lookOf(glb), plain = lookOf(glb, false);
  EXPECT_EQ(whole.metallic, 1);
  EXPECT_EQ(whole.emission, (Vec3{1, 1, 1}));
  EXPECT_EQ(plain.metallic, 0);
  EXPECT_EQ(plain.emission, Vec3{});
  EXPECT_EQ(plain.emissionMap.image, -1);
}

TEST(Looks, HaveNoMapsWithoutTextureCoordinates) {
  Glb glb = textured({kPng});
  material(glb)["normalTexture"] = {{"index", 0}};
  Rig rig = converted(glb);
  const auto imagesOf = [&] { return usd::looksOf(rig, true).value().images.size(); };
  EXPECT_EQ(imagesOf(), 1u);
  rig.source.polygons.texcoords.clear();
  rig.source.polygons.cornerTexcoords.clear();
  EXPECT_EQ(imagesOf(), 0u);
}

TEST(Looks, WithoutACutoffAreOpaque) {
  Glb glb = smallFace();
  material(glb)["alphaMode"] = "MASK";
  EXPECT_TRUE(lookOf(glb).isTransparent);
  material(glb)["alphaCutoff"] = 0;
  EXPECT_FALSE(lookOf(glb).isTransparent);
}

TEST(Looks, AreWrittenAsShaders) {
  Glb glb = textured({kPng});
  material(glb)["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 0.5, 0.25, 0.75}},
                                           {"baseColorTexture", {{"index", 0}}},
                                           {"metallicRoughnessTexture", {{"index", 0}}}};
  material(glb)["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
  material(glb)["occlusionTexture"] = {{"index", 0}, {"strength", 0.25}};
  material(glb)["alphaMode"] = "MASK";
  material(glb)["extensions"] = {{"KHR_materials_ior", {{"ior", 1.25}}},
                                 {"KHR_materials_clearcoat",
                                  {{"clearcoatFactor", 0.75},
                                   {"clearcoatTexture", {{"index", 0}}},
                                   {"clearcoatRoughnessFactor", 0.5}}}};
  const Rig rig = converted(glb);
  const std::string text = formatUsd(rig, {}).value();
  EXPECT_EQ(text.find("clearcoat"), std::string::npos) << "its map is left out";
  const Layer plain(text);
  const std::string skin = "/face/materials/skin/";
  EXPECT_EQ(plain.value(skin + "shader.color3f inputs:diffuseColor"), "(1, 0.5, 0.25)");
  EXPECT_EQ(plain.value(skin + "shader.float inputs:opacity"), "0.75");
  EXPECT_EQ(plain.value(skin + "shader.float inputs:opacityThreshold"), "0.5");
  EXPECT_EQ(plain.value(skin + "shader.float inputs:ior"), "1.25");
  EXPECT_EQ(plain.type(skin + "colour"), "");
  const std::string archive = formatUsdz(rig, {}).value();
  EXPECT_NE(archive.find(kPng), std::string::npos);
  const std::size_t start = archive.find("#usda"), end = archive.find("PK\x03\x04", start);
  const Layer layer(archive.substr(start, end - start));
  EXPECT_EQ(layer.value(skin + "shader.color3f inputs:diffuseColor.connect"),
            "<" + skin + "colour.outputs:rgb>");
  EXPECT_EQ(layer.value(skin + "shader.float inputs:opacity.connect"),
            "<" + skin + "colour.outputs:a>");
  EXPECT_EQ(layer.value(skin + "shader.float inputs:metallic.connect"),
            "<" + skin + "rough.outputs:b>");
  EXPECT_EQ(layer.value(skin + "shader.float inputs:clearcoat.connect"),
            "<" + skin + "coat.outputs:r>");
  EXPECT_EQ(layer.value(skin + "shader.float inputs:clearcoatRoughness"), "0.5");
  EXPECT_EQ(layer.value(skin + "coat.float4 inputs:scale"), "(0.75, 1, 1, 1)");
  EXPECT_EQ(layer.value(skin + "colour.asset inputs:file"), "@textures/image.png@");
  EXPECT_EQ(layer.value(skin + "colour.float4 inputs:scale"), "(1, 0.5, 0.25, 0.75)");
  EXPECT_EQ(layer.value(skin + "colour.token inputs:sourceColorSpace"), R"("sRGB")");
  EXPECT_EQ(layer.value(skin + "rough.token inputs:sourceColorSpace"), R"("raw")");
  EXPECT_EQ(layer.value(skin + "normal.float4 inputs:scale"), "(1, 1, 2, 1)");
  EXPECT_EQ(layer.value(skin + "normal.float4 inputs:bias"), "(-0.5, -0.5, -1, 0)");
  EXPECT_EQ(layer.value(skin + "occlusion.float4 inputs:scale"), "(0.25, 0.25, 0.25, 1)");
  EXPECT_EQ(layer.value(skin + "occlusion.float4 inputs:bias"), "(0.75, 0.75, 0.75, 0)");
}

}  // namespace
}  // namespace sweepface
