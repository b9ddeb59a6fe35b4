#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/result.hpp"

#include "gltf/json.hpp"

namespace sweepface::gltf {

/// The buffer and the range in it where a buffer view lies.
struct BufferView {
  std::size_t buffer = 0, offset = 0, length = 0;
  std::size_t stride = 0;  ///< 0: element after element
};

/// A glTF asset. Its JSON is an object whose lists (accessors, meshes, nodes ...) are lists of
/// objects, whose contents are not checked yet. Nothing is compressed any more.
struct Document {
  Json json;
  std::vector<std::string> buffers;
  /// As in the JSON, but buffers that name the same file are replaced by the first of them; each
  /// view lies within its buffer.
  std::vector<BufferView> views;
  std::size_t sourceBytes = 0;  ///< of the file and those that it names
  std::vector<std::string> warnings;

  std::string_view bytesOf(std::size_t view) const {
    const BufferView& v = views[view];
    return std::string_view(buffers[v.buffer]).substr(v.offset, v.length);
  }
  /// The most corners, or elements of attributes, that a file of this size can mean. A few bytes
  /// can claim more by using the same data again and again.
  std::uint64_t mostElements() const { return (1 << 16) + std::uint64_t{8} * sourceBytes; }
  /// The most vectors of all shapes together, or elements of an accessor without a buffer view: a
  /// few bytes can claim many that are zero. Honest files stay below this, however well they are
  /// compressed.
  std::uint64_t mostClaimed() const { return (1 << 16) + std::uint64_t{32} * sourceBytes; }
  const Json& list(std::string_view key) const { return listOf(json, key); }
  /// Adds bytes as a buffer with one view; returns the view.
  std::size_t addBuffer(std::string bytes);
};

/// Reads a .glb or .gltf with its buffers. Other files are read only from `folder`, and none if it
/// is empty. Messages do not name the file.
Result<Document> parseDocument(std::string_view bytes, const std::filesystem::path& folder);

inline constexpr std::string_view dracoRefusal =
    "it is compressed with Draco, which this program does not read; decode it with `npx "
    "@gltf-transform/cli copy IN.glb OUT.glb`.";

/// Whether an extension is known to change no vertex and to refer to buffer views only in members
/// named "bufferView".
bool isHarmlessExtension(std::string_view name);

/// Whether something in a glTF that is not known may refer to views or accessors by number.
bool usesUnknownExtensions(const Json& gltf);

/// A name for every material: its own, or material_N if it has none, with a number appended if
/// another one before it has that name.
std::vector<std::string> materialNames(const Document& document);

/// [nodes] whether each is a joint of a skin.
std::vector<bool> jointsOf(const Document& document);

/// A GLB of a JSON and the bytes of its first buffer.
std::string formatContainer(const Json& json, std::string_view binary);

}  // namespace sweepface::gltf
