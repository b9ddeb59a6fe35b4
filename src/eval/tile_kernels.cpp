// The kernels of src/eval/tile_kernels_plain.cpp for registers of 4, 8 or 16 numbers, compiled once
// for every instruction set by Highway.
#include "eval/tile_kernels.hpp"

#ifdef SWEEPFACE_PLAIN_KERNELS

namespace sweepface {

void evaluatePositions(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& out,
                       Index) {
  plain::evaluatePositions(tiles, frame, out);
}
void evaluateNormals(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& normals,
                     const VectorsOut& tangents, Index) {
  plain::evaluateNormals(tiles, frame, normals, tangents);
}
void blendModes(const TileRange& tiles, const FrameWeights& frame, std::int16_t* out) {
  plain::blendModes(tiles, frame, out);
}

}  // namespace sweepface

#else

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "eval/tile_kernels.cpp"
#define HWY_WANT_AVX3_DL  // dot products in one instruction
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "eval/tile_steps-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace sweepface {
namespace HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR  // a processor without vector instructions

void evaluatePositions(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& out,
                       bool) {
  plain::evaluatePositions(tiles, frame, out);
}
void evaluateNormals(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& normals,
                     const VectorsOut& tangents, bool) {
  plain::evaluateNormals(tiles, frame, normals, tangents);
}
void blendModes(const TileRange& tiles, const FrameWeights& frame, std::int16_t* out) {
  plain::blendModes(tiles, frame, out);
}

#else
namespace {

/// A tile in the pipeline.
struct Stage {
  Tile tile;
  std::uint32_t* pairs;
  HWY_ALIGN std::int16_t c[kMostBlocks * kGroup];
  Places places;
  Waiting first, second;
};

/// Prefetches a tile's record before its turn comes.
HWY_INLINE void prefetch(const TileTable& table, Index tile) {
  const std::byte* const record = table.record(tile);
  const std::byte* const end = tile + 1 < table.tileCount() ? table.record(tile + 1) : record;
  for (const std::byte* line = record; line < end; line += 64) hwy::Prefetch(line);
}

/// Calls `combine` and `write` with every tile. Each step waits for the one before, so four tiles
/// are in the pipeline at once, each a step behind the one before it.
template <typename Combine, typename Write>
HWY_INLINE void eachTile(const TileRange& tiles, const FrameWeights& frame, const Combine& combine,
                         const Write& write) {
  const TileWeights weights(frame);
  Stage stages[4];
  for (int s = 0; s < 4; ++s) stages[s].pairs = frame.pairs + s * frame.pairsRoom;
  const Index count = tiles.count;
  const auto at = [&](Index k) -> Stage& { return stages[k & 3]; };
  for (Index k = 0; k < count + 3; ++k) {
    if (k < count) {
      if (frame.cold && k + 1 < count) prefetch(tiles.table, tiles[k + 1]);
      at(k).tile = tileAt(tiles.table.record(tiles[k]));
      weights.choose(at(k).tile, at(k).pairs);
      at(k).places.take(at(k).tile);
    }
    if (k >= 1 && k < count + 1) blend(at(k - 1).tile, at(k - 1).pairs, at(k - 1).c);
    if (k >= 2 && k < count + 2)
      combine(at(k - 2), hn::Set(kFloats, at(k - 2).tile.head->scale * frame.factor));
    if (k >= 3) write(at(k - 3));
  }
}

}  // namespace

void evaluatePositions(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& out,
                       bool all) {
  const auto combineTile = [](Stage& stage, Float scale) HWY_ATTR {
    for (int part = 0; part < kParts; ++part) {
      const Combined rows = combine(stage.tile, stage.c, {0, part}, {1, part}, scale);
      stage.first.put(kLanes * part, rows.first);
      stage.first.put(kGroup + kLanes * part, rows.second);
    }
  };
  eachTile(tiles, frame, combineTile, [&](const Stage& stage) HWY_ATTR {
    write(stage.tile, stage.places, all, stage.first, out);
  });
}

void evaluateNormals(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& normals,
                     const VectorsOut& tangents, bool all) {
  const auto combineTile = [&](Stage& stage, Float scale) HWY_ATTR {
    for (int part = 0; part < 2 * kParts; ++part) {
      const int group = part / kParts, inGroup = part % kParts;
      const Combined rows =
          combine(stage.tile, stage.c, {group, inGroup}, {group + 2, inGroup}, scale);
      stage.first.put(kLanes * part, unit(cross(rows.first, rows.second)));
      if (tangents.data) stage.second.put(kLanes * part, unit(rows.first));
    }
  };
  eachTile(tiles, frame, combineTile, [&](const Stage& stage) HWY_ATTR {
    if (normals.data) write(stage.tile, stage.places, all, stage.first, normals);
    if (tangents.data) write(stage.tile, stage.places, all, stage.second, tangents);
  });
}

void blendModes(const TileRange& tiles, const FrameWeights& frame, std::int16_t* out) {
  const TileWeights weights(frame);
  HWY_ALIGN std::int16_t c[kMostBlocks * kGroup];
  for (Index k = 0; k < tiles.count; ++k) {
    const Tile tile = tileAt(tiles.table.record(tiles[k]));
    weights.choose(tile, frame.pairs);
    blend(tile, frame.pairs, c);
    out = putModes(tile, c, out);
  }
}

#endif
}  // namespace HWY_NAMESPACE
}  // namespace sweepface
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sweepface {

HWY_EXPORT(evaluatePositions);
HWY_EXPORT(evaluateNormals);
HWY_EXPORT(blendModes);

void evaluatePositions(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& out,
                       Index vertices) {
  HWY_DYNAMIC_DISPATCH(evaluatePositions)(tiles, frame, out, out.count >= vertices);
}

void evaluateNormals(const TileRange& tiles, const FrameWeights& frame, const VectorsOut& normals,
                     const VectorsOut& tangents, Index vertices) {
  const auto hasRoom = [&](const VectorsOut& out) { return !out.data || out.count >= vertices; };
  HWY_DYNAMIC_DISPATCH(evaluateNormals)
  (tiles, frame, normals, tangents, hasRoom(normals) && hasRoom(tangents));
}

void blendModes(const TileRange& tiles, const FrameWeights& frame, std::int16_t* out) {
  HWY_DYNAMIC_DISPATCH(blendModes)(tiles, frame, out);
}

}  // namespace sweepface
#endif

#endif  // SWEEPFACE_PLAIN_KERNELS
