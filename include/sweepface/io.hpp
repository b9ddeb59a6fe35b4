#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sweepface/mesh.hpp"
#include "sweepface/result.hpp"

namespace sweepface {

/// The mesh in an .obj or .ply file, told apart by extension.
Result<PolygonMesh> readMesh(const std::filesystem::path& path);

/// The mesh in a Wavefront OBJ text; messages call it `name`.
Result<PolygonMesh> parseObj(std::string_view text, std::string_view name);

/// The mesh in a PLY file (ASCII, binary of either endianness); messages call it `name`.
Result<PolygonMesh> parsePly(std::string_view bytes, std::string_view name);

/// Called with the number of target files read so far and in total; one call at a time, from any
/// thread.
using ReadProgress = std::function<void(std::size_t done, std::size_t total)>;

/// A neutral mesh and its targets, each named after its file. A target that is a folder stands for
/// all .obj and .ply files in it, in the order of their names, without the neutral and hidden
/// files.
Result<MeshRig> readRig(const std::filesystem::path& neutral,
                        std::span<const std::filesystem::path> targets,
                        const ReadProgress& progress = {});

/// What is read of a file.
struct SourceOptions {
  /// Whether what a file holds besides the rig is checked and returned.
  bool withScene = true;
  /// Of a .glb or .gltf: the face is what nodes of these names show, or else meshes of these names,
  /// or else what nodes below show. Empty: what the scene shows and what morphs (docs/glb.md).
  std::vector<std::string> meshes{};
};

/// A rig as files hold it, and what else they hold.
struct RigSource {
  MeshRig rig;
  /// What the file holds besides the rig, for Rig::scene (docs/glb.md); empty for files without
  /// one.
  std::string scene;
  std::vector<std::string> warnings;  ///< what of that could not be carried over, in sentences
  /// Warnings about the face itself, with or without a scene.
  std::vector<std::string> faceWarnings{};
};

/// The same from any files: a single .glb or .gltf, which holds its targets, or files as in
/// readRig. Where all faces are triangles, pairs of them become quads (docs/quads.md).
Result<RigSource> readSource(const std::filesystem::path& neutral,
                             std::span<const std::filesystem::path> targets,
                             const ReadProgress& progress = {}, const SourceOptions& options = {});

/// What formatObj writes.
struct ObjOutput {
  std::span<const Vec3> positions;
  std::span<const Vec3> normals;  ///< one a vertex, or empty
  const Polygons& polygons;
};

/// A Wavefront OBJ text. Its numbers read back as exactly the same doubles.
std::string formatObj(const ObjOutput& output);

/// The path that a text names, which must be in UTF-8. On Windows a path made of `char` is in
/// another encoding.
std::filesystem::path utf8Path(std::string_view text);

/// All bytes of a file.
Result<std::string> readFile(const std::filesystem::path& path);

/// The extension of a path with its dot, in lower case; a file named ".glb" has one, too.
std::string extensionOf(const std::filesystem::path& path);
/// Whether a name is that of a .glb, a .gltf or a .vrm, which is a .glb by another name.
bool isGltf(const std::filesystem::path& path);

/// The folder that a file is in, "." if its path names none.
std::filesystem::path folderOf(const std::filesystem::path& path);

/// Writes a file beside `path` and renames it, so that the file at `path` is either complete or
/// unchanged. Other names of the old file (hard links) keep the old contents.
Result<void> writeFile(const std::filesystem::path& path, std::string_view bytes);

}  // namespace sweepface
