// The reference for what the kernels compute, without regard to speed.
#include <algorithm>
#include <bit>
#include <cstring>

#include "eval/tile_kernels.hpp"

namespace sweepface::plain {
namespace {

using Vectors = std::array<std::array<float, 3>, kMostRows>;

std::int16_t half(std::uint32_t pair, int side) {
  return static_cast<std::int16_t>(pair >> (16 * side) & 0xffff);
}

/// Reads the next number, of 16 or of 8 bits.
std::int16_t take(const std::byte*& from, bool isWide) {
  if (!isWide) return static_cast<std::int8_t>(*from++);
  std::int16_t x;
  std::memcpy(&x, from, sizeof(x));
  from += sizeof(x);
  return x;
}

/// The modes' coefficients c_m under the frame's weights, in the order of the blocks.
using Modes = std::array<std::int16_t, kMostBlocks * kGroup>;
Modes blend(const Tile& tile, const FrameWeights& frame) {
  const TileHead& head = *tile.head;
  const std::uint32_t* const pairs = frame.pairs;
  pairWeights(tile, frame, frame.pairs);
  Modes modes;
  std::int16_t* c = modes.data();
  const std::byte* from = tile.coefficients;
  for (int b = 0; b < head.blocks; ++b) {
    std::array<std::int32_t, kGroup> sums{};
    const auto [wide, narrow] = tile.pairs[b];
    for (int p = 0; p < wide + narrow; ++p)
      for (int lane = 0; lane < kGroup; ++lane)
        for (int side = 0; side < 2; ++side) {
          const bool isWide = p < wide;
          const std::int32_t weight = half(pairs[isWide ? p : head.widePairs + p - wide], side);
          sums[lane] +=
              take(from, isWide) * (1 << (isWide ? 0 : tile.shifts[kGroup * b + lane])) * weight;
        }
    for (int lane = 0; lane < kGroup; ++lane)
      *c++ = static_cast<std::int16_t>(std::clamp((sums[lane] + (1 << 15)) >> 16, -32768, 32767));
  }
  return modes;
}

float neutral(const Tile& tile, int group, int axis, int lane) {
  const float steps = tile.neutral[(3 * group + axis) * kGroup + lane];
  return tile.head->origin[axis] + steps * tile.head->step;
}

/// All rows of a tile under the frame's weights.
void combine(const Tile& tile, int groups, const FrameWeights& frame, Vectors& out) {
  const Modes c = blend(tile, frame);
  const float scale = tile.head->scale * frame.factor;
  const std::byte* basis = tile.basis;
  for (int g = 0; g < groups; ++g) {
    std::array<std::array<std::int32_t, 3>, kGroup> sums{};
    for (int p = 0; p < tile.head->modePairs; ++p)
      for (int lane = 0; lane < kGroup; ++lane)
        for (int h = 0; h < 2; ++h) {
          const bool isWide = p < tile.head->wideModePairs;
          const int x = take(basis, isWide) * (1 << (isWide ? 0 : kBasisShift));
          for (int axis = 0; axis < 3; ++axis) sums[lane][axis] += x * c[6 * p + 2 * axis + h];
        }
    for (int lane = 0; lane < kGroup; ++lane)
      for (int axis = 0; axis < 3; ++axis)
        out[kGroup * g + lane][axis] =
            neutral(tile, g, axis, lane) + static_cast<float>(sums[lane][axis]) * scale;
  }
}

float inverseRoot(float x) {
  float y = std::bit_cast<float>(kInverseRootGuess - (std::bit_cast<std::int32_t>(x) >> 1));
  for (int step = 0; step < kInverseRootSteps; ++step) y = y * (1.5f - (0.5f * x * y) * y);
  return y;
}

std::array<float, 3> unit(const std::array<float, 3>& a) {
  const float r = inverseRoot((a[0] * a[0] + a[1] * a[1]) + a[2] * a[2]);
  return {a[0] * r, a[1] * r, a[2] * r};
}

void write(const Tile& tile, int k, const std::array<float, 3>& vector, const VectorsOut& out) {
  const std::uint32_t vertex = vertexOf(tile, k);
  if (out.data && vertex < static_cast<std::uint32_t>(out.count))
    std::memcpy(vectorAt(out, vertex), vector.data(), sizeof(vector));
}

}  // namespace

void evaluatePositions(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& out) {
  Vectors rows;
  for (Index t = 0; t < tiles.count; ++t) {
    const Tile tile = tileAt(tiles.table.record(tiles[t]));
    combine(tile, 2, frame, rows);
    for (int k = 0; k < tile.head->vertices; ++k) write(tile, k, rows[k], out);
  }
}

void evaluateNormals(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& normals,
                     const VectorsOut& tangents) {
  Vectors rows;
  for (Index t = 0; t < tiles.count; ++t) {
    const Tile tile = tileAt(tiles.table.record(tiles[t]));
    combine(tile, 4, frame, rows);
    for (int k = 0; k < tile.head->vertices; ++k) {
      const auto &u = rows[k], &v = rows[k + kTileVertices];
      write(tile, k,
            unit({u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]}),
            normals);
      write(tile, k, unit(u), tangents);
    }
  }
}

void blendModes(const TileRange& tiles, const FrameWeights& frame, std::int16_t* out) {
  for (Index t = 0; t < tiles.count; ++t) {
    const Tile tile = tileAt(tiles.table.record(tiles[t]));
    out = putModes(tile, blend(tile, frame).data(), out);
  }
}

}  // namespace sweepface::plain
