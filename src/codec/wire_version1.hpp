#pragma once

#include "sweepface/surface.hpp"

#include "codec/reader.hpp"

namespace sweepface::codec {

/// Reads the wireframe of chunk WIRE, without its ribbons. Checks everything that Surface::make
/// relies on but does not check itself.
Wireframe readWireframe(Reader& in);

}  // namespace sweepface::codec
