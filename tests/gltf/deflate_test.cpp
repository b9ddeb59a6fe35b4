#include "gltf/deflate.hpp"

#include <gtest/gtest.h>
#include <random>

namespace sweepface {
namespace {

using gltf::deflated, gltf::inflated;

std::string noise(std::size_t size) {
  std::mt19937 random(5);
  std::string bytes(size, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random() & 255);
  return bytes;
}

std::string whyNot(const std::string& stream) {
  const auto found = inflated(stream);
  return found ? "" : found.error().message;
}

TEST(Deflate, ComesBackWhateverItIs) {
  for (const std::string& bytes :
       {std::string(), std::string("glTF"), std::string(65'536, 'x'), noise(65536), noise(65537),
        noise(200'000) + std::string(200'000, '\0')}) {
    const auto again = inflated(deflated(bytes));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, bytes);
  }
}

TEST(Deflate, RefusesWhatIsCutOrChangedOrFollowed) {
  const std::string bytes = "a scene, a scene, a scene and " + noise(300);
  const std::string stream = deflated(bytes);
  for (std::size_t size = 0; size < stream.size(); ++size)
    EXPECT_EQ(whyNot(stream.substr(0, size)), "it is damaged") << size;
  for (std::size_t at = 0; at < stream.size(); ++at) {
    std::string changed = stream;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    const auto found = inflated(changed);
    EXPECT_TRUE(!found || *found == bytes) << at;
  }
  EXPECT_EQ(whyNot(stream + "x"), "it is damaged");
}

TEST(Deflate, RefusesFarMoreThanItsSizeCanMean) {
  EXPECT_EQ(whyNot(deflated(std::string(10'000'000, '\0'))),
            "it holds far more than its size can mean");
}

}  // namespace
}  // namespace sweepface
