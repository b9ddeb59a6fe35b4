#include <fmt/format.h>

#include "sweepface/io.hpp"

#include "command.hpp"
#include "lod_mesh.hpp"

namespace sweepface::cli {
namespace {

struct ExportArguments {
  std::string face, output, weights;
  int lod = 0;
  bool sourceOrder = false, quiet = false;
};

void addOptions(CLI::App& app, ExportArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output, "The .obj file to write");
  addWeights(app, a.weights);
  CLI::Option* lod =
      addLod(app, a.lod, "Write a finer mesh: every edge of the source cut into N, 1 to 64");
  app.add_flag("--source-order", a.sourceOrder,
               "Write the source's own vertices and polygons in their order (this is the default)")
      ->excludes(lod);
  addQuiet(app, a.quiet);
  app.footer(
      "\nExamples:\n  sweepface export face.sweep -o smile.obj --weights smile=0.8,jawOpen=0.2\n"
      "  sweepface export face.sweep -o smooth.obj --lod 4");
}

Result<int> runExport(const ExportArguments& a) {
  const Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  const Result<Weights> weights = parseWeights(*rig, a.weights);
  if (!weights) return std::unexpected(weights.error());
  if (auto ok = checkOutput(a.output, {a.face}, {".ply", ".sweep"}); !ok)
    return std::unexpected(ok.error());
  const MeshMaker meshes(*rig, a.lod);
  if (auto written = writeFile(a.output, meshes.obj(*weights)); !written)
    return std::unexpected(written.error());
  if (!a.quiet) fmt::print("{}: {} faces\n", a.output, meshes.polygons().faceCount());
  return 0;
}

}  // namespace

Command addExport(CLI::App& tool) {
  return makeCommand(tool, "export", "Write an expression as a mesh (.obj)", runExport);
}

}  // namespace sweepface::cli
