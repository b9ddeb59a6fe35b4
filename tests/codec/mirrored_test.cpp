#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

#include "sweepface/eval.hpp"

#include "codec/files.hpp"
#include "codec/mirror.hpp"
#include "codec/packed.hpp"
#include "codec/rigs.hpp"
#include "codec/source_coder.hpp"

namespace sweepface {
namespace {

using namespace codec;
using namespace sweepface::testing;

// A symmetric face, without its source's vertex order.
const Rig& face() {
  static const Rig rig = decode(goldenFile("golden_sample.sweep"), "sample").value();
  return rig;
}

Mirror mirrorOf(const Rig& rig) {
  return spreadMirror(rig.surface.wireframe(), rig.surface.connectivity(), rig.packing.mirror);
}
LevelOne mirroredGrid() { return {face().surface, mirrorOf(face())}; }
LevelOne plainGrid() {
  Rig rig = face();
  rig.packing.mirror.clear();
  return {rig.surface, mirrorOf(rig)};
}

template <typename Write>
double bytesOf(Write write) {
  RangeEncoder coder;
  Symbols<RangeEncoder> symbols(coder);
  write(symbols);
  return static_cast<double>(coder.finish().size());
}

// A node far away must not make the whole face so small that any two of its nodes are images.
TEST(Mirrored, AFarNodeMakesNoImages) {
  Rig rig = makeRig(sheet(12));
  const auto apart = [](Index k) { return 100.0 * k + 10.0 * k * k; };  // unlike from the other end
  for (Index v = 0; v < rig.surface.storedCount(); ++v) {
    const Index x = rig.surface.stored(v).node % 13, y = rig.surface.stored(v).node / 13;
    if (rig.surface.stored(v).isPosition()) rig.neutral[v] = {100.0 * x, apart(y), 0.2 * apart(x)};
  }
  EXPECT_TRUE(findMirror(rig.surface, rig.neutral).pairs.empty());
  rig.neutral[0].x = 1e6;
  EXPECT_TRUE(findMirror(rig.surface, rig.neutral).pairs.empty());
}

TEST(Mirrored, VerticesOfTheGridStandWhereTheirImagesDo) {
  const LevelOne grid = mirroredGrid();
  const auto& image = grid.mirror().vertex;
  const auto positions = Tessellation(face().surface, 1).positions(blend(face(), {}));
  ASSERT_EQ(positions.size(), image.size());
  Index mirrored = 0;
  for (std::size_t v = 0; v < image.size(); ++v) {
    if (image[v] < 0) continue;
    ++mirrored;
    EXPECT_EQ(image[image[v]], static_cast<Index>(v));
    const Vec3 &a = positions[v], &b = positions[image[v]];
    EXPECT_LT(norm(a - Vec3{-b.x, b.y, b.z}), 2 * face().tolerance) << v;
  }
  EXPECT_GT(mirrored, grid.vertexCount() * 9 / 10);
}

TEST(Mirrored, QuadsOfTheGridGoAroundTheOtherWay) {
  const LevelOne grid = mirroredGrid();
  const GridMirror& mirror = grid.mirror();
  for (std::size_t q = 0; q < mirror.quad.size(); ++q)
    for (int k = 0; mirror.quad[q] >= 0 && k < 4; ++k) {
      EXPECT_EQ(mirror.quad[mirror.quad[q]], static_cast<Index>(q));
      EXPECT_EQ(grid.quads()[mirror.quad[q]][(mirror.turn[q] - k) & 3],
                mirror.vertex[grid.quads()[q][k]]);
    }
}

TEST(Mirrored, OfAWireframeTheSecondHalfCostsLittle) {
  Rig rig = face();
  const auto bytes = [&] {
    auto chunks = takeApart(encode(rig));
    return static_cast<double>(chunkOf(chunks, "GRID").payload.size());
  };
  const double mirrored = bytes();
  rig.packing.mirror.clear();
  EXPECT_LT(mirrored, 0.9 * bytes());
}

// The items on one side in random order, then their images in the same order.
std::vector<Index> oneSideAndThenTheOther(std::span<const Index> images) {
  std::vector<Index> order(images.size());
  std::iota(order.begin(), order.end(), 0);
  const auto other = std::partition(order.begin(), order.end(), [&](Index item) {
    return images[item] < 0 || item <= images[item];
  });
  std::shuffle(order.begin(), other, std::mt19937(3));
  order.erase(other, order.end());
  for (std::size_t k = 0, count = order.size(); k < count; ++k)
    if (const Index image = images[order[k]]; image > order[k]) order.push_back(image);
  return order;
}

TEST(Mirrored, OfAnOrderTheSecondHalfCostsLittle) {
  SourceMesh source;
  const LevelOne mirrored = mirroredGrid(), plain = plainGrid();
  source.gridVertex = oneSideAndThenTheOther(mirrored.mirror().vertex);
  const auto bytes = [&](const LevelOne& grid) {
    return bytesOf([&](auto& symbols) { writeOrder(symbols, grid, source); });
  };
  EXPECT_LT(bytes(mirrored), 0.65 * bytes(plain));
}

TEST(Mirrored, OfFacesTheSecondHalfCostsLittle) {
  const LevelOne mirrored = mirroredGrid(), plain = plainGrid();
  const GridMirror& mirror = mirrored.mirror();
  SourceMesh source;
  source.gridVertex.resize(mirrored.vertexCount());
  std::iota(source.gridVertex.begin(), source.gridVertex.end(), 0);
  source.quadCorners.resize(4 * mirrored.quads().size());
  source.polygons.faceStart = {0};
  std::mt19937 random(4);
  std::vector<int> first(mirrored.quads().size(), -1);  // corner of each quad
  for (const Index q : oneSideAndThenTheOther(mirror.quad)) {
    const Index image = mirror.quad[q];
    first[q] = image >= 0 && first[image] >= 0 ? (mirror.turn[q] - first[image]) & 3
                                               : static_cast<int>(random() % 4);
    for (int k = first[q]; k < first[q] + 4; ++k) {
      source.quadCorners[4 * q + k % 4] = static_cast<Index>(source.polygons.corners.size());
      source.polygons.corners.push_back(mirrored.quads()[q][k % 4]);
    }
    source.polygons.faceStart.push_back(static_cast<Index>(source.polygons.corners.size()));
  }
  const auto bytes = [&](const LevelOne& grid) {
    return bytesOf([&](auto& symbols) { writeFaces(symbols, grid, source); });
  };
  EXPECT_LT(bytes(mirrored), 0.65 * bytes(plain));
}

}  // namespace
}  // namespace sweepface
