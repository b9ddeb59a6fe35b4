#pragma once

#include "sweepface/surface.hpp"

#include "codec/reader.hpp"

namespace sweepface::codec {

/// The wireframe of chunk WIRE, without its ribbons. What Surface::make relies on beyond what it
/// checks itself is checked here.
Wireframe readWireframe(Reader& in);

/// How many quads the patches of a wireframe have at level 1; they are within kMostGridVertices.
std::size_t gridQuads(const Wireframe& wireframe);

/// Vertices at level 1 that a file may ask for. Arcs can be said to be long at no cost.
inline constexpr std::int64_t kMostGridVertices = 64'000'000;

}  // namespace sweepface::codec
