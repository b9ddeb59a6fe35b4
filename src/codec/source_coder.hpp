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

/// Texture coordinates in 2^bits steps of the texture's width, and which corner has which.
void writeTexture(Symbols<RangeEncoder>& out, const Polygons& polygons, int bits);
void readTexture(Symbols<RangeDecoder>& in, std::size_t most, Polygons& polygons, int& bits);

}  // namespace sweepface::codec
