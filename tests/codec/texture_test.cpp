#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "codec/source_coder.hpp"

namespace sweepface {
namespace {

using namespace codec;

constexpr int kBits = 14;
constexpr Index kQuads = 24;  // per row and per column

// A sheet of quads with a texture coordinate for each vertex, in whole steps.
template <typename At>
Polygons sheetWith(At at) {
  Polygons sheet;
  const auto vertex = [](Index x, Index y) { return y * (kQuads + 1) + x; };
  for (Index y = 0; y <= kQuads; ++y)
    for (Index x = 0; x <= kQuads; ++x) {
      const std::array<int, 2> whole = at(x, y);
      sheet.texcoords.push_back({std::ldexp(whole[0], -kBits), std::ldexp(whole[1], -kBits)});
    }
  sheet.faceStart = {0};
  for (Index y = 0; y < kQuads; ++y)
    for (Index x = 0; x < kQuads; ++x) {
      for (const Index v : {vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1)})
        sheet.corners.push_back(v);
      sheet.faceStart.push_back(static_cast<Index>(sheet.corners.size()));
    }
  sheet.cornerTexcoords = sheet.corners;
  return sheet;
}

std::string written(const Polygons& polygons, std::span<const Index> images = {}) {
  RangeEncoder coder;
  Symbols<RangeEncoder> symbols(coder);
  writeTexture(symbols, polygons, images, kBits);
  return coder.finish();
}

void expectReadBack(const Polygons& polygons, std::span<const Index> images = {}) {
  const std::string bytes = written(polygons, images);
  RangeDecoder coder(bytes);
  Symbols<RangeDecoder> symbols(coder);
  Polygons back = polygons;
  back.texcoords.clear();
  back.cornerTexcoords.clear();
  int bits = 0;
  readTexture(symbols, polygons.texcoords.size(), back, images, bits);
  ASSERT_TRUE(symbols.ok()) << symbols.problem();
  EXPECT_EQ(bits, kBits);
  EXPECT_EQ(back.cornerTexcoords, polygons.cornerTexcoords);
  ASSERT_EQ(back.texcoords.size(), polygons.texcoords.size());
  for (std::size_t t = 0; t < back.texcoords.size(); ++t) {
    EXPECT_EQ(back.texcoords[t].x, polygons.texcoords[t].x);
    EXPECT_EQ(back.texcoords[t].y, polygons.texcoords[t].y);
  }
}

TEST(Texture, OfWhatIsEvenlyLaidOutCostsHardlyAnything) {
  const Polygons even = sheetWith([](int x, int y) { return std::array{31 * x + 5 * y, 40 * y}; });
  expectReadBack(even);
  EXPECT_LT(written(even).size(), 120u) << "the indices of " << even.corners.size() << " corners";
}

// Without learning from the bends of earlier quads, each of 625 coordinates would cost its own
// bend, up to 47 and 94 steps.
TEST(Texture, FollowsWhatBendsMoreAndMore) {
  const Polygons bent = sheetWith(
      [](int x, int y) { return std::array{31 * x + x * x * y, 40 * y - 2 * x * y * y}; });
  expectReadBack(bent);
  EXPECT_LT(written(bent).size(), 250u);
}

// For each face corner of a sheet, the corner at its mirror image across the sheet.
std::vector<Index> acrossTheSheet() {
  std::vector<Index> images;
  for (Index y = 0; y < kQuads; ++y)
    for (Index x = 0; x < kQuads; ++x)
      for (const Index k : {1, 0, 3, 2}) images.push_back(4 * (y * kQuads + kQuads - 1 - x) + k);
  return images;
}

// A rough sheet whose right half is the left one, flipped and transposed in one of eight ways.
Polygons mirroredSheet(int way) {
  std::mt19937 random(7);
  std::array<std::array<std::array<int, 2>, kQuads / 2 + 1>, kQuads + 1> half;
  for (auto& row : half)
    for (auto& t : row) t = {static_cast<int>(random() % 4096), static_cast<int>(random() % 4096)};
  return sheetWith([&](int x, int y) {
    auto t = half[y][std::min(x, kQuads - x)];
    if (x <= kQuads / 2) return t;
    if (way & 1) t[0] = 9000 - t[0];
    if (way & 2) t[1] = 5000 - t[1];
    if (way & 4) std::swap(t[0], t[1]);
    return t;
  });
}

TEST(Texture, OfAMirrorImageCostsHardlyAnythingWhicheverWayItIsTurned) {
  for (int way = 0; way < 8; ++way) {
    const Polygons mirrored = mirroredSheet(way);
    expectReadBack(mirrored, acrossTheSheet());
    EXPECT_LT(100 * written(mirrored, acrossTheSheet()).size(), 65 * written(mirrored).size())
        << way;
  }
}

TEST(Texture, OfWhatIsNotMirroredCostsNoMoreForImages) {
  std::mt19937 random(8);
  const Polygons bent = sheetWith([&](int x, int y) {
    return std::array{31 * x + 3 * x * x + static_cast<int>(random() % 4), 40 * y};
  });
  expectReadBack(bent, acrossTheSheet());
  EXPECT_LT(100 * written(bent, acrossTheSheet()).size(), 110 * written(bent).size());
}

TEST(Texture, SeamsAreWhereTheMirrorImageHasThem) {
  Polygons cut = sheetWith([](int x, int y) { return std::array{31 * x, 40 * y}; });
  const auto images = acrossTheSheet();
  std::mt19937 random(9);
  std::vector<char> isCut(images.size());
  for (std::size_t c = 0; c < isCut.size(); ++c)
    if (random() % 8 == 0) isCut[c] = isCut[images[c]] = 1;
  std::vector<Index> had(cut.texcoords.size(), -1);
  const std::vector<Vec2> at = std::exchange(cut.texcoords, {});
  for (std::size_t c = 0; c < isCut.size(); ++c) {
    Index& t = had[cut.corners[c]];
    if (t < 0 || isCut[c]) {
      t = static_cast<Index>(cut.texcoords.size());
      cut.texcoords.push_back(at[cut.corners[c]]);
    }
    cut.cornerTexcoords[c] = t;
  }
  expectReadBack(cut, images);
  EXPECT_LT(100 * written(cut, images).size(), 90 * written(cut).size());
}

TEST(Texture, ComesBackHoweverRoughItIs) {
  std::mt19937 random(5);
  Polygons rough = sheetWith([&](int, int) {
    return std::array{static_cast<int>(random() % 100'000) - 50'000,
                      static_cast<int>(random() % 9)};
  });
  for (Index& t : rough.cornerTexcoords)  // seams, corners without any, coordinates without corners
    if (random() % 10 == 0) t = static_cast<Index>(random() % (rough.texcoords.size() + 1)) - 1;
  expectReadBack(rough);
}

TEST(Texture, ComesBackOnTrianglesAndLargeFaces) {
  Polygons mixed = sheetWith([](int x, int y) { return std::array{31 * x * x, 40 * y}; });
  mixed.faceStart.clear();
  for (Index c = 0; c < static_cast<Index>(mixed.corners.size()); c += 3 + c % 5)
    mixed.faceStart.push_back(c);
  mixed.faceStart.push_back(static_cast<Index>(mixed.corners.size()));
  expectReadBack(mixed);
}

}  // namespace
}  // namespace sweepface
