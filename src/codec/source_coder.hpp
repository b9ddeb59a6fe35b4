#pragma once

#include "sweepface/rig.hpp"

#include "codec/level_one.hpp"
#include "codec/symbols.hpp"

// How the model answers in the source's order, of which most follows from the grid of the patches
// at level 1. What the grid does not tell is told in full, so that any source comes back.
namespace sweepface::codec {

/// Where each source vertex lies: a walk from neighbour to neighbour.
void writeOrder(Symbols<RangeEncoder>& out, const LevelOne& grid, const SourceMesh& source);
void readOrder(Symbols<RangeDecoder>& in, const LevelOne& grid, std::size_t most,
               SourceMesh& source);

/// Faces, their corners, the corners of the grid's quads, materials and groups. The order is known.
void writeFaces(Symbols<RangeEncoder>& out, const LevelOne& grid, const SourceMesh& source);
void readFaces(Symbols<RangeDecoder>& in, const LevelOne& grid, std::size_t most,
               SourceMesh& source);

/// The corner of a face at the mirror image of each corner [corners], -1 where there is none; empty
/// where the source does not say which corners are at the quads of the grid.
std::vector<Index> cornerImages(const GridMirror& mirror, const SourceMesh& source);

/// Whether all texture coordinates lie within what writeTexture can tell with so many bits.
bool holdsTexture(const Polygons& polygons, int bits);
/// Texture coordinates in 2^bits steps of the texture's width, and which corner has which. `images`
/// are those of the corners, or none.
void writeTexture(Symbols<RangeEncoder>& out, const Polygons& polygons,
                  std::span<const Index> images, int bits);
void readTexture(Symbols<RangeDecoder>& in, std::size_t most, Polygons& polygons,
                 std::span<const Index> images, int& bits);

}  // namespace sweepface::codec
