#pragma once

#include <string>
#include <string_view>

#include "gltf/json.hpp"

namespace sweepface::gltf {

/// The extension of a buffer view that says how it is compressed, or null.
const Json* meshoptOf(const Json& view);

/// What a compressed view holds, as its extension says.
struct MeshoptStream {
  std::size_t buffer = 0, offset = 0, length = 0;  ///< where the compressed bytes are
  std::size_t count = 0, stride = 0;
  std::string_view mode, filter;
};
/// Reads the extension through `in`. Refuses counts beyond what `length` bytes can stand for.
MeshoptStream readMeshopt(Members& in, std::size_t buffers);

/// Decodes the `count` elements of `stride` bytes; empty, and refused through `in`, if the bytes
/// are damaged or of a newer version.
std::string decodeMeshopt(Members& in, const MeshoptStream& stream, std::string_view bytes);

}  // namespace sweepface::gltf
