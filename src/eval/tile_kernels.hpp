#pragma once

#include "sweepface/evaluator.hpp"

#include "eval/tiles.hpp"

// The kernels that evaluate tiles: a plain one that serves as the reference, and one for every
// instruction set. All give the same bits.
namespace sweepface {

/// The weights of a frame, followed by zeros.
struct FrameWeights {
  const std::int16_t* shorts;  ///< [roundUp64(W + 1)]
  std::uint32_t* pairs;        ///< [4 × pairsRoom] scratch
  std::size_t pairsRoom;       ///< roundUp64(W / 2 + 1)
  float factor;                ///< what weights were divided by to lie within [-1, 1]
  Index count;                 ///< W + 1
  bool cold = false;           ///< whether to prefetch the tables
};

/// Some tiles of a table: `count` of them from `first` on, or those listed.
struct TileRange {
  const TileTable& table;
  Index first, count;
  const Index* listed = nullptr;

  Index operator[](Index k) const { return listed ? listed[k] : first + k; }
};

/// Quantises the weights of a frame into the scratch memory of an evaluation.
FrameWeights frameWeights(const EvaluatorTables& tables, std::span<const double> weights,
                          std::span<std::byte> scratch);

namespace plain {
void evaluatePositions(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& out);
void evaluateNormals(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& normals,
                     const VectorsOut& tangents);
void blendModes(const TileRange& tiles, const FrameWeights& frame, std::int16_t* out);
}  // namespace plain

/// `vertices` is the vertex count of the whole evaluator.
void evaluatePositions(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& out,
                       Index vertices);
void evaluateNormals(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& normals,
                     const VectorsOut& tangents, Index vertices);
/// The modes of the tiles under the frame's weights, laid out for shaders: see ShaderTables.
void blendModes(const TileRange& tiles, const FrameWeights& frame, std::int16_t* out);

/// Writes the weights of a tile's targets in pairs, as dot products of 16-bit integers take them.
inline void pairWeights(const Tile& tile, const FrameWeights& frame, std::uint32_t* pairs) {
  const auto weight = [&](int k) {
    return static_cast<std::uint32_t>(static_cast<std::uint16_t>(frame.shorts[tile.targets[k]]));
  };
  for (int p = 0; p < tile.head->pairs; ++p) pairs[p] = weight(2 * p) | weight(2 * p + 1) << 16;
}

/// Texels that a row of a tile's basis takes in a shader's texture, with numbers for four modes in
/// each.
inline int texelsOf(const TileHead& head) { return (head.modePairs + 1) / 2; }

/// Writes a tile's modes, which its blocks hold in pairs, one by one as four numbers each. Returns
/// where the modes of the next tile go.
inline std::int16_t* putModes(const Tile& tile, const std::int16_t* c, std::int16_t* to) {
  const int modes = 2 * tile.head->modePairs;
  for (int m = 0; m < 4 * texelsOf(*tile.head); ++m)
    for (int axis = 0; axis < 4; ++axis)
      *to++ = m < modes && axis < 3 ? c[6 * (m / 2) + 2 * axis + m % 2] : std::int16_t(0);
  return to;
}

inline char* vectorAt(const VectorsOut& out, std::uint32_t vertex) {
  return reinterpret_cast<char*>(out.data) + std::size_t(vertex) * out.stride;
}

/// The inverse square root by Newton's method from an initial guess (Lomont 2003), so that it is
/// the same on every machine; accurate to better than 5·10⁻⁶. Finite for 0.
inline constexpr std::int32_t kInverseRootGuess = 0x5f375a86;
inline constexpr int kInverseRootSteps = 2;

}  // namespace sweepface
