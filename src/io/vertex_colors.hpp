#pragma once

#include <filesystem>

namespace sweepface::io {

/// Whether an .obj or .ply file has colours at its vertices, which a PolygonMesh cannot hold. Says
/// no of what cannot be read.
bool hasVertexColors(const std::filesystem::path& path);

}  // namespace sweepface::io
