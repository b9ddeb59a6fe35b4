#pragma once

#include "sweepface/surface.hpp"

#include "codec/reader.hpp"

namespace sweepface::codec {

/// The wireframe of chunk WIRE, without its ribbons. What Surface::make relies on beyond what it
/// checks itself is checked here.
Wireframe readWireframe(Reader& in);

}  // namespace sweepface::codec
