#include <cmath>
#include <random>

#include "gltf/accessor.hpp"
#include "gltf/scene.hpp"
#include "gltf/written.hpp"

namespace sweepface {
namespace {

using namespace testing;

/// Random shares for every vertex of the small face: `sets` × 4 that sum to one.
std::vector<std::vector<float>> anyShares(std::size_t sets, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<std::vector<float>> shares(sets);
  for (int v = 0; v < 9; ++v) {
    std::vector<float> all(4 * sets);
    float sum = 0;
    for (float& w : all) sum += w = uniform(random) < 0.4 ? 0 : uniform(random);
    if (sum == 0) sum = all[0] = 1;
    for (std::size_t k = 0; k < all.size(); ++k) shares[k / 4].push_back(all[k] / sum);
  }
  return shares;
}

std::size_t addShares(Glb& glb, const std::vector<float>& shares) {
  return glb.addAccessor(glb.addView(bytesOf(shares)), 5126, "VEC4", shares.size() / 4);
}

/// The small face with weights.
Glb weighted(const std::vector<std::vector<float>>& shares) {
  Glb glb = smallFace();
  for (std::size_t k = 0; k < shares.size(); ++k)
    glb.primitive()["attributes"]["WEIGHTS_" + std::to_string(k)] = addShares(glb, shares[k]);
  return glb;
}

std::vector<double> valuesOf(const gltf::Document& document, const char* name,
                             std::size_t part = 0) {
  const Json& reference = document.json["meshes"][0]["primitives"][part]["attributes"][name];
  return gltf::decode(document, *gltf::accessorAt(document, reference.get<std::size_t>())).value();
}
gltf::Document packed(const Glb& glb) {
  return gltf::parseScene(packedScene(gltf::formatScene(glb.bytes()))).value();
}

TEST(SkinWeights, OfSeveralSetsStaySharesOfOne) {
  for (const std::size_t sets : {1, 2}) {
    const auto shares = anyShares(sets);
    const gltf::Document document = packed(weighted(shares));
    for (int v = 0; v < 9; ++v) {
      double sum = 0, most = 0;
      for (std::size_t k = 0; k < 4 * sets; ++k) {
        const std::string name = "WEIGHTS_" + std::to_string(k / 4);
        const double now = valuesOf(document, name.c_str())[4 * v + k % 4];
        EXPECT_NEAR(now, shares[k / 4][4 * v + k % 4], static_cast<double>(4 * sets) / 131070);
        sum += now, most = std::max(most, now);
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      EXPECT_LE(most, 1);
    }
  }
}

TEST(SkinWeights, TakeHalfTheBytesAndNothingElseChanges) {
  const Glb glb = weighted(anyShares(1));
  const gltf::Document before = gltf::parseDocument(glb.bytes(), {}).value();
  const gltf::Document after = packed(glb);
  EXPECT_EQ(before.buffers[0].size() - after.buffers[0].size(), 9 * 4 * 2u);
  EXPECT_EQ(valuesOf(after, "POSITION"), valuesOf(before, "POSITION"));
  const auto weights = after.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"];
  EXPECT_EQ(after.json["accessors"][weights.get<std::size_t>()]["normalized"], true);
  const std::string scene = packedScene(gltf::formatScene(glb.bytes()));
  EXPECT_EQ(packedScene(scene), scene);
}

TEST(SkinWeights, ThatAreRoundedAwayLetTheirJointsGo) {
  const std::vector<std::uint16_t> joints(36, 7);
  for (const bool isShared : {false, true}) {
    std::vector<float> shares(36, 0.25f);
    shares[0] = 1 - 4e-6f, shares[1] = 4e-6f, shares[2] = shares[3] = 0;
    Glb glb = weighted({shares});
    const std::size_t accessor = glb.addAccessor(glb.addView(bytesOf(joints)), 5123, "VEC4", 9);
    glb.primitive()["attributes"]["JOINTS_0"] = accessor;
    if (isShared) {  // with other weights
      glb.json["meshes"].push_back(Json(glb.json["meshes"][0]));
      glb.primitive(1)["attributes"]["WEIGHTS_0"] = addShares(glb, std::vector<float>(36, 0.25f));
    }
    std::vector<double> expected(36, 7);
    if (!isShared) expected[1] = expected[2] = expected[3] = 0;
    EXPECT_EQ(valuesOf(packed(glb), "JOINTS_0"), expected);
  }
}

TEST(SkinWeights, AreRoundedWhateverTheJoints) {
  Glb glb = weighted(anyShares(1));
  glb.json["meshes"][0]["primitives"].push_back(Json(glb.primitive()));
  for (std::size_t part : {0, 1}) {
    const std::vector<std::uint8_t> joints(36, static_cast<std::uint8_t>(part + 1));
    Json& attributes = glb.json["meshes"][0]["primitives"][part]["attributes"];
    attributes["JOINTS_0"] = glb.addAccessor(glb.addView(bytesOf(joints)), 5121, "VEC4", 9);
  }
  const gltf::Document document = packed(glb);
  const auto weights = document.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"];
  EXPECT_EQ(document.json["accessors"][weights.get<std::size_t>()]["componentType"], 5123);
}

TEST(SkinWeights, OfPrimitivesThatShareThemAreRoundedOnce) {
  Glb glb = weighted(anyShares(1));
  glb.json["meshes"][0]["primitives"].push_back(glb.primitive());
  const gltf::Document document = packed(glb);
  const auto once = valuesOf(document, "WEIGHTS_0", 0);
  EXPECT_EQ(valuesOf(document, "WEIGHTS_0", 1), once);
  EXPECT_EQ(std::fmod(65535 * once[1], 1), 0);
}

TEST(SkinWeights, ThatAreNoSharesStayAsTheyAre) {
  const auto stays = [](const Glb& glb) {
    const std::string scene = gltf::formatScene(glb.bytes());
    return packedScene(scene) == scene;
  };
  EXPECT_TRUE(stays(smallFace()));
  auto shares = anyShares(1);
  shares[0][0] += 0.02f;
  EXPECT_TRUE(stays(weighted(shares)));
  // So many that rounding them takes more than the largest has.
  std::vector<std::vector<float>> many(32, std::vector<float>(36, 1.009f / 128));
  for (auto& set : many)
    for (std::size_t k = 0; k < set.size(); ++k) set[k] += k % 2 ? 2e-6f : -2e-6f;
  EXPECT_TRUE(stays(weighted(many)));
  shares[0][0] = -1, shares[0][1] = 2;
  EXPECT_TRUE(stays(weighted(shares)));
  // Some are given separately, as sparse values.
  Glb sparse = weighted(anyShares(1));
  const std::size_t where = sparse.addView(bytesOf(std::vector<std::uint16_t>{0})),
                    what = sparse.addView(bytesOf(std::vector<float>{0, 1, 0, 0}));
  sparse.attribute("WEIGHTS_0")["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", where}, {"componentType", 5123}}},
      {"values", {{"bufferView", what}}}};
  EXPECT_TRUE(stays(sparse));
  // Something else uses them, too.
  Glb glb = weighted(anyShares(1));
  glb.primitive()["attributes"]["_OWN"] = glb.primitive()["attributes"]["WEIGHTS_0"];
  EXPECT_TRUE(stays(glb));
  // Shares that two primitives combine with different others.
  Glb two = weighted(anyShares(2));
  two.json["meshes"][0]["primitives"].push_back(two.primitive());
  two.primitive(0, 1)["attributes"]["WEIGHTS_1"] = addShares(two, anyShares(2)[1]);
  EXPECT_TRUE(stays(two));
  EXPECT_EQ(packedScene("no scene"), "no scene");
}

}  // namespace
}  // namespace sweepface
