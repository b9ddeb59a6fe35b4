#include <algorithm>
#include <fmt/format.h>
#include <iterator>

#include "sweepface/drawing.hpp"
#include "sweepface/eval.hpp"
#include "sweepface/io.hpp"

#include "command.hpp"

namespace sweepface::cli {
namespace {

struct WireframeArguments {
  std::string face, output, weights;
  int lod = 0;  // 0: not given
  bool quiet = false;
};

void addOptions(CLI::App& app, WireframeArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output,
            "The file to write: lines (.obj), or the wireframe as a text that `sweepface build` "
            "reads (.json)");
  addWeights(app, a.weights);
  addLod(app, a.lod, "Points on a curve for every edge of the source, 1 to 64; 8 if not given");
  addQuiet(app, a.quiet);
  app.footer(
      "\nThe file has the groups nodes, boundary_curves and control_curves: beside every "
      "boundary curve,\nin each patch, two curves at 1/10 and 1/4 of the way across.\n\n"
      "Examples:\n  sweepface wireframe face.sweep -o wire.obj --weights jawOpen=1\n"
      "  sweepface wireframe face.sweep -o face.wire.json");
}

/// A network as points and lines of an OBJ text.
std::string objLines(const CurveNetwork& net) {
  std::string text;
  const auto appendLines = [&](const std::vector<Curve>& curves) {
    for (const Curve& curve : curves) {
      text += 'l';
      for (Index point : curve.points) fmt::format_to(std::back_inserter(text), " {}", point + 1);
      text += '\n';
    }
  };
  for (const Vec3& p : net.points)
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p.x, p.y, p.z);
  text += "g nodes\n";
  for (Index point : net.nodes) fmt::format_to(std::back_inserter(text), "p {}\n", point + 1);
  text += "g boundary_curves\n";
  appendLines(net.boundary);
  text += "g control_curves\n";
  appendLines(net.control);
  return text;
}

/// Whether the face holds what came from a mesh, which no drawing has.
bool isOfMesh(const Rig& rig) {
  const SourceMesh& source = rig.source;
  return !std::ranges::is_sorted(source.gridVertex) || !source.polygons.texcoords.empty() ||
         !source.polygons.groups.empty() || !rig.scene.empty();
}

/// Writes all of a face as text: the neutral, its expressions, names and shape parameters.
Result<int> writeDrawing(const WireframeArguments& a, const Rig& rig) {
  if (!a.weights.empty() || a.lod > 0)
    return fail(
        "A .json file holds the curves of the neutral and all expressions as they are; --weights "
        "and --lod are for .obj.");
  const Drawing drawing = draw(rig);
  if (auto written = writeFile(utf8Path(a.output), formatDrawing(drawing)); !written)
    return std::unexpected(written.error());
  if (!a.quiet)
    fmt::print("{}: {} nodes, {} curves, {} patches, {} expressions\n", a.output,
               drawing.nodes.size(), drawing.curves.size(), drawing.patches.size(),
               drawing.expressions.size());
  if (!a.quiet && isOfMesh(rig))
    fmt::print("without what the mesh had besides; sweepface build --source {} adds that again\n",
               a.face);
  return 0;
}

Result<int> runWireframe(const WireframeArguments& a) {
  const Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  const Result<Weights> weights = weightsGiven("--weights", a.weights, *rig);
  if (!weights) return std::unexpected(weights.error());
  if (auto ok = checkOutput(a.output, {a.face}, {".obj", ".json"}, !a.quiet); !ok)
    return std::unexpected(ok.error());
  if (isOfKind(a.output, ".json")) return writeDrawing(a, *rig);
  const CurveNetwork net = curveNetwork(rig->surface, blend(*rig, *weights), a.lod > 0 ? a.lod : 8);
  if (auto written = writeFile(utf8Path(a.output), objLines(net)); !written)
    return std::unexpected(written.error());
  if (!a.quiet)
    fmt::print("{}: {} nodes, {} curves\n", a.output, net.nodes.size(),
               net.boundary.size() + net.control.size());
  return 0;
}

}  // namespace

Command addWireframe(CLI::App& tool) {
  return makeCommand(tool, "wireframe",
                     "Write the network of curves as lines (.obj) or as a text to edit (.json)",
                     runWireframe);
}

}  // namespace sweepface::cli
