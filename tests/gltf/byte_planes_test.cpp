#include "gltf/byte_planes.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "gltf/deflate.hpp"
#include "gltf/glb.hpp"

namespace sweepface {
namespace {

using gltf::ByteTable, gltf::toPlanes, gltf::fromPlanes, gltf::deflated;

/// Rows of smooth floats, like those of vertices.
std::string floats(std::size_t rows, std::size_t width) {
  std::vector<float> values;
  for (std::size_t k = 0; k < rows * width; ++k)
    values.push_back(
        std::sin(0.0017f * static_cast<float>(k / width) + static_cast<float>(k % width)));
  return testing::bytesOf(values);
}

std::string number(std::size_t value) {
  std::string bytes;
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 255);
  return bytes;
}

void expectRefused(const std::string& planes, const char* why) {
  const auto found = fromPlanes(planes);
  ASSERT_FALSE(found) << why;
  EXPECT_EQ(found.error().message, "it is damaged") << why;
}

TEST(BytePlanes, ComeBackWhateverTheTables) {
  std::mt19937 random(3);
  int made = 0;
  for (int round = 0; round < 200; ++round) {
    std::string bytes;
    std::vector<ByteTable> tables;
    for (int k = 0; k < 4; ++k) {
      bytes.append(random() % 9, static_cast<char>(random() & 255));
      const std::size_t width = 1 + random() % 4, rows = 1 + random() % 200;
      tables.push_back({bytes.size(), 4 * width, rows});
      bytes += floats(rows, width);
    }
    const std::string planes = toPlanes(bytes, tables);
    if (planes.empty()) continue;
    ++made;
    const auto again = fromPlanes(planes);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, bytes) << round;
  }
  EXPECT_GT(made, 100);
}

TEST(BytePlanes, OfNumbersDeflateBetter) {
  const std::string bytes = floats(3000, 3);
  const std::string planes = toPlanes(bytes, std::vector<ByteTable>{{0, 12, 3000}});
  EXPECT_LT(deflated(planes).size(), 4 * deflated(bytes).size() / 5);
}

TEST(BytePlanes, AreNotMadeWhereNothingIsGained) {
  EXPECT_EQ(toPlanes("a scene", {}), "");
  std::string text;
  while (text.size() < 4000) text += "the same again; ";
  EXPECT_EQ(toPlanes(text, std::vector<ByteTable>{{0, 7, 500}}), "");
}

TEST(BytePlanes, AreAsDescribed) {
  const std::string head = number(1) + number(1) + number(2) + number(3) + std::string("\0\1", 2);
  EXPECT_EQ(fromPlanes(head + "<abc" + "A\1\1" + ">").value(), "<aAbBcC>");
}

TEST(BytePlanes, RefuseTablesThatAreNotThere) {
  const auto table = [](std::size_t begin, std::size_t width, std::size_t rows) {
    return number(begin) + number(width) + number(rows) + std::string(width & 15, '\0');
  };
  EXPECT_TRUE(fromPlanes(number(2) + table(0, 2, 3) + table(6, 2, 3) + std::string(12, 'x')));
  expectRefused("", "no head");
  expectRefused(number(1), "no table");
  expectRefused(number(4'000'000'000) + table(0, 1, 1) + "x", "too few tables");
  expectRefused(number(1) + table(0, 2, 3) + "12345", "beyond the bytes");
  expectRefused(number(1) + table(0, 0, 3) + "12345", "no columns");
  expectRefused(number(1) + table(0, 2, 0) + "12345", "no rows");
  expectRefused(number(1) + table(0xffffffff, 0xffffffff, 0xffffffff) + "12345", "huge");
  expectRefused(number(1) + table(0, 1, 0xffffffff) + "12345", "long");
  expectRefused(number(2) + table(0, 2, 3) + table(5, 2, 3) + std::string(12, 'x'), "overlapping");
  expectRefused(number(1) + number(0) + number(1) + number(1) + "\2x", "an unknown form");
}

}  // namespace
}  // namespace sweepface
