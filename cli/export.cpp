#include <algorithm>
#include <fmt/format.h>
#include <optional>

#include "sweepface/eval.hpp"
#include "sweepface/io.hpp"
#include "sweepface/lod_polygons.hpp"

#include "budget_grid.hpp"
#include "command.hpp"
#include "file_names.hpp"
#include "following.hpp"
#include "interrupts.hpp"
#include "lod_mesh.hpp"
#include "mesh_folder.hpp"
#include "output.hpp"
#include "rig_file.hpp"

namespace sweepface::cli {
namespace {

struct ExportArguments {
  std::string face, output, weights;
  bool hasWeights = false;  // an empty list is the neutral
  int lod = 0;
  BudgetArguments budget;
  bool sourceOrder = false, quiet = false;
  FollowingArguments following;
  RigFileArguments rigFile;
};

void addOptions(CLI::App& app, ExportArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output,
            "The file to write: .obj for one expression, .glb or .usda for the face with all its "
            "targets; or a folder, without an ending, for all of them as .obj files");
  addWeights(app, a.weights)->each([&a](const std::string&) { a.hasWeights = true; });
  CLI::Option* lod =
      addLod(app, a.lod, "Write a finer mesh: every edge of the source cut into N, 1 to 64");
  CLI::Option* order = app.add_flag(
      "--source-order", a.sourceOrder,
      "Write the source's own vertices and polygons in their order (this is the default)");
  order->excludes(lod);
  addBudget(app, a.budget, {lod, order});
  addFollowing(app, a.following);
  addRigFile(app, a.rigFile);
  addQuiet(app, a.quiet);
  app.footer(
      "\nExamples:\n  sweepface export face.sweep -o smile.obj --weights smile=0.8,jawOpen=0.2\n"
      "  sweepface export face.sweep -o smooth.obj --lod 4\n"
      "  sweepface export face.sweep -o far.glb --vertices 5000\n"
      "  sweepface export face.sweep -o face.glb --quantize\n"
      "  sweepface export face.sweep -o face.usda\n"
      "  sweepface export face.sweep -o meshes/");
}

bool isOfRig(const ExportArguments& a) { return isOfKind(a.output, ".glb") || isUsd(a.output); }

bool isOfFolder(const ExportArguments& a) {
  return !isOfKind(a.output, ".obj") && !isOfRig(a) && meansFolder(utf8Path(a.output));
}

/// The mesh that a budget asks for, as an .obj.
Result<void> writeWithin(const ExportArguments& a, const Rig& rig, const Weights& weights) {
  const Result<Tessellation> grid = gridWithin(a.budget, rig, a.output);
  if (!grid) return std::unexpected(grid.error());
  const Polygons polygons = densityPolygons(rig, *grid);
  const std::vector<Vec3> vectors = blend(rig, weights);
  const std::string obj = formatObj({grid->positions(vectors), grid->normals(vectors), polygons});
  if (auto written = writeFile(utf8Path(a.output), obj); !written) return written;
  if (!a.quiet)
    fmt::print("{}: {} vertices, {} triangles\n", a.output, grid->vertexCount(),
               polygons.faceCount());
  return {};
}

Result<void> writeObj(const ExportArguments& a, const Rig& rig, const Weights& weights) {
  if (a.budget.isGiven()) return writeWithin(a, rig, weights);
  if (auto ok = checkLod(rig, a.lod); !ok) return ok;
  const MeshMaker meshes(rig, a.lod);
  if (auto written = writeFile(utf8Path(a.output), meshes.obj(weights)); !written) return written;
  if (!a.quiet) fmt::print("{}: {} faces\n", a.output, meshes.polygons().faceCount());
  return {};
}

Result<std::string> formatRig(const ExportArguments& a, const Rig& rig, const Weights& weights,
                              const Tessellation* grid) {
  if (isUsd(a.output)) {
    UsdOptions options = a.rigFile.usd(a.lod);
    options.grid = grid;
    if (a.hasWeights) options.weights = weights;
    return formatUsdFor(a.output, rig, options);
  }
  GlbOptions options = a.rigFile.glb(a.lod);
  options.grid = grid;
  if (a.hasWeights) options.weights = weights;
  return formatGlb(rig, options);
}

Result<void> writeRig(const ExportArguments& a, const Rig& rig, const Weights& weights) {
  if (auto ok = checkFineness(rig.surface, a.lod); !ok) return ok;
  std::optional<Tessellation> grid;
  if (a.budget.isGiven()) {
    Result<Tessellation> within = gridWithin(a.budget, rig, a.output);
    if (!within) return std::unexpected(within.error());
    grid = std::move(*within);
  }
  const Result<std::string> bytes = formatRig(a, rig, weights, grid ? &*grid : nullptr);
  if (!bytes) return std::unexpected(bytes.error());
  if (auto written = writeFile(utf8Path(a.output), *bytes); !written) return written;
  if (!a.quiet)
    fmt::print("{}: {} targets, {}{} bytes\n", a.output, rig.targets.size(),
               grid ? fmt::format("{} vertices, ", grid->vertexCount()) : "", bytes->size());
  return {};
}

/// The file name of a target: its own name, altered where file systems would refuse the file or
/// `convert` would skip it in a folder.
std::string fileNameOf(const std::string& target) {
  constexpr std::string_view ending = ".obj";
  constexpr std::size_t longest = 255 - ending.size();  // bytes
  std::string name = target;
  std::ranges::replace_if(name, isForbiddenInFileNames, '_');
  if (name.starts_with('.')) name[0] = '_';
  if (isDeviceName(name)) name.insert(0, "_");
  if (name.size() > longest) {
    std::size_t end = longest;
    while ((name[end] & 0xC0) == 0x80) --end;  // inside of a character
    name.resize(end);
  }
  return name.append(ending);
}

/// The file names of the first targets.
Result<std::vector<std::string>> fileNames(const Rig& rig, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < count; ++k) {
    const std::string& target = rig.targets[k].name;
    std::string name = fileNameOf(target);
    if (const auto twin = std::ranges::find(names, asCompared(name), asCompared);
        twin != names.end())
      return fail(fmt::format("The targets '{}' and '{}' would both be in {}; write a .glb.",
                              rig.targets[twin - names.begin()].name, target, name));
    names.push_back(std::move(name));
  }
  for (std::size_t k = 0; k < count; ++k)
    if (names[k] != rig.targets[k].name + ".obj")
      printWarning(fmt::format("The target '{}' is in {}.", rig.targets[k].name, names[k]));
  return names;
}

/// Writes what `convert` reads: neutral.obj, and every target by its name in expressions/.
Result<void> writeFolder(const ExportArguments& a, const Rig& rig, const Following& following) {
  const std::filesystem::path folder = utf8Path(a.output), expressions = folder / "expressions";
  if (auto ok = checkLod(rig, a.lod); !ok) return ok;
  const auto names = fileNames(rig, following.count);
  if (!names) return std::unexpected(names.error());
  if (auto made = makeFolder(folder); !made) return made;
  if (following.count > 0)
    if (auto made = makeFolder(expressions); !made) return made;
  const MeshMaker meshes(rig, a.lod);
  const auto path = [&](std::size_t k) {
    return k == 0 ? folder / "neutral.obj" : expressions / utf8Path((*names)[k - 1]);
  };
  const auto text = [&](std::size_t k) {
    Weights weights(rig.targets.size());
    if (k > 0) weights[k - 1] = 1;
    following.apply(weights);
    return meshes.obj(weights);
  };
  if (auto ok = writeMeshes({following.count + 1, "meshes", utf8Path(a.face), path, text}, a.quiet);
      !ok)
    return ok;
  if (!a.quiet)
    fmt::print("{}: {} targets, {} faces each\n", a.output, following.count,
               meshes.polygons().faceCount());
  return {};
}

/// Refuses options that this kind of output does not have.
Result<void> checkKind(const ExportArguments& a) {
  const bool isRig = isOfRig(a), isFolder = isOfFolder(a);
  if (auto ok = checkRigFile(a.rigFile, a.output); !ok) return ok;
  if (isFolder && a.budget.isGiven())
    return fail(
        "A budget of vertices, error or edge length is for one file; name an .obj, .glb or .usda.");
  if (isFolder && a.hasWeights)
    return fail("A folder gets every target by itself; leave --weights out, or name an .obj file.");
  if ((isRig || isFolder) && !a.hasWeights && (a.following.combine || !a.following.limits.empty()))
    return fail(fmt::format(
        "A {} holds all targets, and --combine and --limits change the "
        "expression of --weights alone; {}leave them out.",
        isRig ? extensionOf(utf8Path(a.output)) : "folder", isRig ? "name one, or " : ""));
  return {};
}

Result<int> runExport(const ExportArguments& a) {
  const bool isFolder = isOfFolder(a);
  if (auto ok = checkKind(a); !ok) return std::unexpected(ok.error());
  Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  if (a.sourceOrder && !rig->source.ownOrder)
    return fail(a.face +
                " has no source order, it was left out; leave --source-order out, or make the "
                "file again without --strip order.");
  Result<Weights> weights = weightsGiven("--weights", a.weights, *rig);
  if (!weights) return std::unexpected(weights.error());
  if (!isFolder)
    if (auto ok =
            checkOutput(a.output, {a.face}, {".obj", ".glb", ".usda", ".usd", ".usdz"}, !a.quiet);
        !ok)
      return std::unexpected(ok.error());
  const Result<Following> following = follow(a.following, *rig, {*weights});
  if (!following) return std::unexpected(following.error());
  weights->resize(rig->targets.size());
  following->apply(*weights);
  const Result<void> written = isFolder ? writeFolder(a, *rig, *following)
                                        : (isOfRig(a) ? writeRig : writeObj)(a, *rig, *weights);
  if (!written) return endWith(written.error());
  return 0;
}

}  // namespace

Command addExport(CLI::App& tool) {
  return makeCommand(
      tool, "export",
      "Write an expression as a mesh (.obj), or the face with its targets (.glb, .usda)",
      runExport);
}

}  // namespace sweepface::cli
