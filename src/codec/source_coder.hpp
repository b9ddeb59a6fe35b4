#pragma once

#include "sweepface/rig.hpp"

#include "codec/level_one.hpp"
#include "codec/symbols.hpp"

// Codes the source's vertices, faces and texture, most of which follow from the grid of the patches
// at level 1. Whatever the grid does not determine is coded in full, so that any source is
// restored.
namespace sweepface::codec {

/// Where each source vertex lies on the grid, as a walk from neighbour to neighbour.
void writeOrder(Symbols<RangeEncoder>& out, const LevelOne& grid, const SourceMesh& source);
void readOrder(Symbols<RangeDecoder>& in, const LevelOne& grid, std::size_t most,
               SourceMesh& source);

/// Faces, their corners, the corners at the grid's quads, materials and groups. Needs the order.
void writeFaces(Symbols<RangeEncoder>& out, const LevelOne& grid, const SourceMesh& source);
void readFaces(Symbols<RangeDecoder>& in, const LevelOne& grid, std::size_t most,
               SourceMesh& source);

/// The mirror image of each corner of a face [corners], -1 if there is none; empty if the source
/// does not say which corners are at the quads of the grid.
std::vector<Index> cornerImages(const GridMirror& mirror, const SourceMesh& source);

/// Whether writeTexture can represent all texture coordinates with this many bits.
bool holdsTexture(const Polygons& polygons, int bits);
/// Texture coordinates in 2^bits steps of the texture's width, and the assignment of corners to
/// them. `images` are those of cornerImages, or none.
void writeTexture(Symbols<RangeEncoder>& out, const Polygons& polygons,
                  std::span<const Index> images, int bits);
void readTexture(Symbols<RangeDecoder>& in, std::size_t most, Polygons& polygons,
                 std::span<const Index> images, int& bits);

}  // namespace sweepface::codec
