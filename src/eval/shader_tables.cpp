#include "eval/shader_tables.hpp"

#include <bit>
#include <cstring>

#include "eval/tile_kernels.hpp"

namespace sweepface {
namespace {

/// One number of a tile's basis.
std::int16_t basisOf(const Tile& tile, int row, int mode) {
  const TileHead& head = *tile.head;
  const int pair = mode / 2;
  if (pair >= head.modePairs) return 0;
  const std::byte* const group = tile.basis + basisBytes(head) * (row / kGroup);
  const std::size_t at = 2 * (row % kGroup) + mode % 2;
  if (pair < head.wideModePairs) {
    std::int16_t x;
    std::memcpy(&x, group + 4 * kGroup * std::size_t(pair) + 2 * at, sizeof(x));
    return x;
  }
  const std::size_t narrow = 2 * kGroup * std::size_t(pair + head.wideModePairs) + at;
  return static_cast<std::int16_t>(static_cast<std::int8_t>(group[narrow]) * (1 << kBasisShift));
}

}  // namespace

ShaderTables shaderTables(const TileTable& table, Index vertices) {
  ShaderTables out;
  out.rows = table.groups() * kGroup / kTileVertices;
  out.places.resize(3 * std::size_t(vertices));
  out.neutral.resize(3 * std::size_t(out.rows) * vertices);
  for (Index t = 0; t < table.tileCount(); ++t) {
    const Tile tile = tileAt(table.record(t));
    const int texels = texelsOf(*tile.head);
    for (int k = 0; k < tile.head->vertices; ++k) {
      const std::uint32_t vertex = vertexOf(tile, k);
      std::uint32_t* const place = out.places.data() + 3 * std::size_t(vertex);
      place[0] = static_cast<std::uint32_t>(out.basis.size() / 4);
      place[1] = static_cast<std::uint32_t>(out.modes * 64 + texels);
      place[2] = std::bit_cast<std::uint32_t>(tile.head->scale);
      for (int r = 0; r < out.rows; ++r) {
        const int row = r * kTileVertices + k;
        for (int mode = 0; mode < 4 * texels; ++mode) out.basis.push_back(basisOf(tile, row, mode));
        for (int axis = 0; axis < 3; ++axis)
          out.neutral[3 * (std::size_t(vertex) * out.rows + r) + axis] =
              tile.head->origin[axis] +
              static_cast<float>(
                  tile.neutral[(3 * (row / kGroup) + axis) * kGroup + row % kGroup]) *
                  tile.head->step;
      }
    }
    out.modes += 4 * texels;
  }
  return out;
}

float blendModes(const EvaluatorTables& tables, const TileTable& table,
                 std::span<const double> weights, std::span<std::byte> scratch,
                 std::span<std::int16_t> out) {
  const FrameWeights frame = frameWeights(tables, weights, scratch);
  blendModes(TileRange{table, 0, table.tileCount()}, frame, out.data());
  return frame.factor;
}

}  // namespace sweepface
