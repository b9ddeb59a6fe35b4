#pragma once

#include "sweepface/surface.hpp"

#include "codec/mirror.hpp"
#include "codec/symbols.hpp"

namespace sweepface::codec {

/// Codes a wireframe patch by patch. Each patch is glued to earlier ones along the first arc of one
/// of its sides, and its loop is coded from there: which arcs are old, how long new ones are and
/// where the corners are. What usually follows from that (lengths of opposite sides, T-nodes,
/// points, ribbons, which derivatives a node stores) is coded only where it differs. Nodes and arcs
/// numbered in order of appearance cost nothing; any other numbering is preserved too.
///
/// `seeds` are coded as well. Where the mirror spreads, the second of two images costs next to
/// nothing.
void writeWireframe(Symbols<RangeEncoder>& out, const Wireframe& wireframe, MirrorSeeds seeds);

/// A wireframe as read, and what was derived from it on the way.
struct CodedWireframe {
  Wireframe wireframe;
  MirrorSeeds seeds;
  Connectivity connectivity;
  Mirror mirror;
};

/// Fails through `in`. Refuses more than `most` nodes, arcs or patches, or more than `mostVertices`
/// vertices at level 1.
CodedWireframe readWireframe(Symbols<RangeDecoder>& in, std::size_t most,
                             std::int64_t mostVertices);

}  // namespace sweepface::codec
