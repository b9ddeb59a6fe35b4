#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/result.hpp"

#include "gltf/json.hpp"

namespace sweepface::gltf {

/// Where in which buffer a buffer view lies.
struct BufferView {
  std::size_t buffer = 0, offset = 0, length = 0;
  std::size_t stride = 0;  ///< 0: element after element
};

/// A glTF asset. Its JSON is an object whose lists (accessors, meshes, nodes ...) are lists of
/// objects; what these hold is not checked yet. Nothing is compressed any longer.
struct Document {
  Json json;
  std::vector<std::string> buffers;
  /// As json tells, but in the first of the buffers that name one file; each lies within its
  /// buffer.
  std::vector<BufferView> views;
  std::size_t sourceBytes = 0;  ///< of the file and of those that it names
  std::vector<std::string> warnings;

  std::string_view bytesOf(std::size_t view) const {
    const BufferView& v = views[view];
    return std::string_view(buffers[v.buffer]).substr(v.offset, v.length);
  }
  /// Corners, or elements of attributes, that files of this size can mean. Few bytes can claim more
  /// by using the same data again and again.
  std::size_t mostElements() const { return (1 << 16) + 8 * sourceBytes; }
  /// Vectors of all shapes together, or elements of an accessor without a buffer view: few bytes
  /// can claim many that are zero. Files that mean what they say stay below this, however well they
  /// are compressed.
  std::size_t mostClaimed() const { return (1 << 16) + 32 * sourceBytes; }
  const Json& list(std::string_view key) const { return listOf(json, key); }
  /// Adds bytes as a buffer with one view; returns the view.
  std::size_t addBuffer(std::string bytes);
};

/// Reads a .glb or .gltf with its buffers. Other files are read from `folder` alone, and none if it
/// is empty. Messages do not name the file.
Result<Document> parseDocument(std::string_view bytes, const std::filesystem::path& folder);

inline constexpr std::string_view dracoRefusal =
    "it is compressed with Draco, which this program does not read; decode it with `npx "
    "@gltf-transform/cli copy IN.glb OUT.glb`.";

/// Whether it is known that an extension changes no vertex, and where it refers to buffer views: in
/// members of that name alone.
bool isHarmlessExtension(std::string_view name);

/// Which nodes are joints of skins [nodes].
std::vector<bool> jointsOf(const Document& document);

/// A GLB of a JSON and the bytes of its first buffer.
std::string formatContainer(const Json& json, std::string_view binary);

}  // namespace sweepface::gltf
