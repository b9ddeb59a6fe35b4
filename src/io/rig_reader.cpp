#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <system_error>

#include "sweepface/gltf.hpp"
#include "sweepface/io.hpp"

#include "codec/utf8.hpp"
#include "io/target_shape.hpp"
#include "io/text.hpp"
#include "io/vertex_colors.hpp"
#include "mesh/quads.hpp"
#include "mesh/weld.hpp"
#include "parallel/parallel.hpp"

namespace sweepface {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

bool isMesh(const fs::path& path) {
  const std::string kind = extensionOf(path);
  return kind == ".obj" || kind == ".ply";
}

std::unexpected<Error> unknownKind(const fs::path& path) {
  if (path.empty())
    return fail("The name of a mesh is empty, as an unset variable leaves it; name the file.");
  std::error_code error;
  if (!fs::exists(path, error) && !error)
    return fail(fmt::format("There is no file or folder {}; check the name.", path.string()));
  if (isGltf(path))
    return fail(
        fmt::format("{} cannot be read as one mesh of several; it holds a face and its "
                    "expressions, so name it alone.",
                    path.string()));
  if (fs::is_directory(path, error))
    return fail(fmt::format("{} is a folder; name the mesh of the neutral first, then its targets.",
                            path.string()));
  if (extensionOf(path) == ".sweep")
    return fail(fmt::format(
        "{} is a face already, and holds no mesh; export it as an .obj or a .glb first.",
        path.string()));
  return fail(
      fmt::format("{} is neither an .obj nor a .ply file, nor a .glb, .gltf or .vrm; export the "
                  "mesh as one of them.",
                  path.string()));
}

Result<Paths> meshesIn(const fs::path& folder, const fs::path& neutral) {
  Paths found;
  std::error_code error, ignored;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    const fs::path& path = entry->path();
    const bool hidden = path.filename().string().starts_with('.');
    if (!hidden && isMesh(path) && !entry->is_directory(ignored) &&
        !fs::equivalent(path, neutral, ignored))
      found.push_back(path);
  }
  if (error)
    return fail(fmt::format("Cannot read the folder {}: {}.", folder.string(), error.message()));
  if (found.empty())
    return fail(
        fmt::format("The folder {} has no .obj or .ply files of targets; name the folder "
                    "that has.",
                    folder.string()));
  std::ranges::sort(found, {}, [](const fs::path& path) { return path.filename().string(); });
  return found;
}

/// The files of all targets, with folders replaced by their contents.
Result<Paths> targetFiles(std::span<const fs::path> targets, const fs::path& neutral) {
  Paths files;
  for (const fs::path& target : targets) {
    std::error_code ignored;
    if (!fs::is_directory(target, ignored)) {
      if (!target.has_filename()) return unknownKind(target);
      if (fs::equivalent(target, neutral, ignored))
        return fail(
            fmt::format("{} is the neutral; leave it out of the targets.", target.string()));
      files.push_back(target);
      continue;
    }
    const Result<Paths> found = meshesIn(target, neutral);
    if (!found) return std::unexpected(found.error());
    files.insert(files.end(), found->begin(), found->end());
  }
  return files;
}

Result<std::vector<std::string>> targetNames(const Paths& files) {
  std::vector<std::string> names;
  std::map<std::string, const fs::path*> owners;
  for (const fs::path& file : files) {
    std::string name = file.stem().string();
    // The stem of ".obj" is ".obj", although it is the name that is missing.
    if (io::trimmed(name).empty() || (!file.has_extension() && isMesh("x" + name)))
      return fail(fmt::format("The target {} has no name before its extension; rename the file.",
                              io::inQuotes(file.string())));
    if (!codec::isUtf8(name))
      return fail(
          fmt::format("The name of the target {} has control characters or is not UTF-8; "
                      "rename the file.",
                      io::inQuotes(file.filename().string())));
    const auto [owner, isNew] = owners.emplace(name, &file);
    std::error_code ignored;
    if (!isNew && fs::equivalent(*owner->second, file, ignored))
      return fail(fmt::format("The target {} is named twice; name it once.", file.string()));
    if (!isNew)
      return fail(fmt::format("The targets {} and {} are both named '{}'; rename one of the files.",
                              owner->second->string(), file.string(), name));
    names.push_back(std::move(name));
  }
  return names;
}

Result<std::vector<Vec3>> readTarget(const fs::path& path, const fs::path& neutralPath,
                                     const PolygonMesh& neutral) {
  if (!isMesh(path)) return unknownKind(path);
  const Result<std::string> bytes = readFile(path);
  if (!bytes) return std::unexpected(bytes.error());
  const auto parse = extensionOf(path) == ".obj" ? io::parseObjTarget : io::parsePlyTarget;
  Result<io::TargetShape> shape = parse(*bytes, path.string());
  if (!shape) return std::unexpected(shape.error());

  const auto differs = [&](std::string_view one, std::string_view many, std::size_t count,
                           std::size_t expected) {
    return fail(
        fmt::format("{} has {} {} but the neutral {} has {}; export every target with the "
                    "neutral's vertices and faces in the same order.",
                    path.string(), count, count == 1 ? one : many, neutralPath.string(), expected));
  };
  if (shape->positions.size() != neutral.positions.size())
    return differs("vertex", "vertices", shape->positions.size(), neutral.positions.size());
  if (shape->faceCount != 0 && shape->faceCount != neutral.polygons.faceCount())
    return differs("face", "faces", shape->faceCount, neutral.polygons.faceCount());
  return std::move(shape->positions);
}

}  // namespace

Result<PolygonMesh> readMesh(const fs::path& path) {
  if (!isMesh(path)) return unknownKind(path);
  const Result<std::string> bytes = readFile(path);
  if (!bytes) return std::unexpected(bytes.error());
  const auto parse = extensionOf(path) == ".obj" ? parseObj : parsePly;
  return parse(*bytes, path.string());
}

Result<MeshRig> readRig(const fs::path& neutralPath, std::span<const fs::path> targets,
                        const ReadProgress& progress) {
  Result<PolygonMesh> neutral = readMesh(neutralPath);
  if (!neutral) return std::unexpected(neutral.error());
  const Result<Paths> files = targetFiles(targets, neutralPath);
  if (!files) return std::unexpected(files.error());
  Result<std::vector<std::string>> names = targetNames(*files);
  if (!names) return std::unexpected(names.error());

  std::vector<Result<std::vector<Vec3>>> read(files->size());
  std::mutex reporting;
  std::size_t done = 0;
  parallelFor(std::size_t{0}, files->size(), [&](std::size_t i) {
    read[i] = readTarget((*files)[i], neutralPath, *neutral);
    const std::scoped_lock lock(reporting);
    ++done;
    if (progress) progress(done, files->size());
  });

  MeshRig rig{std::move(*neutral), {}};
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (!read[i]) return std::unexpected(read[i].error());
    rig.targets.push_back({std::move((*names)[i]), std::move(*read[i])});
  }
  return rig;
}

namespace {

bool isCutToTriangles(const Polygons& polygons) {
  for (Index f = 0; f < polygons.faceCount(); ++f)
    if (polygons.faceSize(f) != 3) return false;
  return polygons.faceCount() > 0;
}

}  // namespace

Result<RigSource> readSource(const fs::path& neutral, std::span<const fs::path> targets,
                             const ReadProgress& progress, const SourceOptions& options) {
  if (!isGltf(neutral)) {
    if (!options.meshes.empty())
      return fail(
          fmt::format("{} has a single mesh, which is the face; choose meshes by their "
                      "names only from a .glb, .gltf or .vrm.",
                      neutral.string()));
    auto rig = readRig(neutral, targets, progress);
    if (!rig) return std::unexpected(rig.error());
    if (isCutToTriangles(rig->neutral.polygons))
      rig->neutral.polygons = recoverQuads(*rig, weld(*rig)).polygons;
    RigSource source{std::move(*rig), {}, {}};
    if (io::hasVertexColors(neutral))
      source.faceWarnings.push_back(
          fmt::format("The colours of vertices in {} are left out; in a .glb they would be kept.",
                      neutral.string()));
    return source;
  }
  if (!targets.empty())
    return fail(fmt::format("{} holds a face and its expressions; name it without {}{}.",
                            neutral.string(), targets[0].string(),
                            options.meshes.empty() ? "" : ", or with --mesh before each mesh"));
  const Result<std::string> bytes = readFile(neutral);
  if (!bytes) return std::unexpected(bytes.error());
  return parseGltf(*bytes, neutral.string(), folderOf(neutral), options);
}

}  // namespace sweepface
