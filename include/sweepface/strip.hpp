#pragma once

#include "sweepface/rig.hpp"

namespace sweepface {

/// The parts that a file can do without.
struct Strip {
  bool order = false;   ///< the source's order of vertices and faces, and with it the scene
  bool uv = false;      ///< texture coordinates
  bool groups = false;  ///< groups, materials and their files
  bool scene = false;   ///< what the source's scene held besides the face
};

/// Parses "uv,order". The error names what there is.
Result<Strip> parseStrip(std::string_view text);

/// Leaves parts out. Without the source's order, vertices are those of the tessellation at level 1
/// in its order (vertices of no face are gone), faces come as the patches' quads do (those without
/// a surface are gone, and so are corners at the tips of spikes), and the scene is gone, since it
/// depends on the source's order. Fails if a face has a corner that is on no patch and the rig does
/// not know its quads.
Result<void> strip(Rig& rig, const Strip& parts);

/// The bytes that the file would take without the source's order, scene and texture coordinates; 0
/// if they cannot be left out. Costs a copy of the rig and an encoding.
std::size_t bareBytes(Rig rig);

}  // namespace sweepface
