#pragma once

#include "sweepface/surface.hpp"

#include "codec/mirror.hpp"
#include "codec/symbols.hpp"

namespace sweepface::codec {

/// Codes a wireframe patch by patch: each is glued to what is there already along the first arc of
/// one of its sides, and its loop is told from there on: which arcs are old, how long new ones are
/// and where the corners are. What follows from that (lengths of opposite sides, T-nodes, points,
/// ribbons, which derivatives a node stores) is told only where it is different. Nodes and arcs
/// that are numbered as they come cost nothing; any other numbering is kept too.
///
/// `seeds` are told as well; where the mirror spreads, the second of two images costs next to
/// nothing.
void writeWireframe(Symbols<RangeEncoder>& out, const Wireframe& wireframe, MirrorSeeds seeds);

/// What is read of a wireframe, and what follows from it on the way.
struct CodedWireframe {
  Wireframe wireframe;
  MirrorSeeds seeds;
  Connectivity connectivity;
  Mirror mirror;
};

/// Fails through `in`. Has no more than `most` of anything, and `mostVertices` vertices at level 1.
CodedWireframe readWireframe(Symbols<RangeDecoder>& in, std::size_t most,
                             std::int64_t mostVertices);

}  // namespace sweepface::codec
