#include <fmt/format.h>

#include "sweepface/arcs.hpp"
#include "sweepface/codec.hpp"
#include "sweepface/drawing.hpp"
#include "sweepface/io.hpp"

#include "command.hpp"
#include "following.hpp"

namespace sweepface::cli {
namespace {

struct BuildArguments {
  std::string drawing, output, source;
  bool arcs = false, quiet = false;
};

void addOptions(CLI::App& app, BuildArguments& a) {
  app.add_option("DRAWING", a.drawing, "The wireframe, a .wire.json file (docs/wire-format.md)")
      ->required()
      ->type_name("");
  addOutput(app, a.output, "The .sweep file to write");
  app.add_option("--source", a.source,
                 "Keep the source mesh of this .sweep file, whose wireframe `sweepface wireframe` "
                 "wrote; else the source is the surface's own grid")
      ->check(notEmpty())
      ->type_name("FACE");
  app.add_flag(
      "--arcs", a.arcs,
      "Note in the file what expressions turn about, for programs that play it; done anyway "
      "where the file of --source notes it");
  addQuiet(app, a.quiet);
  app.footer(
      "\nExamples:\n  sweepface build vase.wire.json -o vase.sweep\n"
      "  sweepface wireframe face.sweep -o face.wire.json   # the way back");
}

std::string inExpression(const Built& built) {
  return built.missedIn.empty() ? "" : fmt::format(" in '{}'", built.missedIn);
}

void printSummary(const BuildArguments& a, const Built& built, std::size_t bytes) {
  const Rig& rig = built.rig;
  fmt::print("{}: {} patches, {} points, {} targets, {} bytes\n", a.output,
             rig.surface.patchCount(), rig.surface.storedCount(), rig.targets.size(), bytes);
  if (!built.missed.empty())
    fmt::print("curves pass within {:.4g} of their points; the furthest is {}{}\n",
               built.largestMiss, built.missed, inExpression(built));
}

// A point this far off is usually out of order, or a control of another patch.
void warnOfMisses(const BuildArguments& a, const Built& built) {
  constexpr double kFar = 0.01;
  if (built.largestMiss <= kFar * built.diagonal) return;
  printWarning(
      fmt::format("{}: {} misses one of its points by {:.3g}{}. {}", a.drawing, built.missed,
                  built.largestMiss, inExpression(built),
                  built.missedIn.empty()
                      ? "Are its points in the order of the curve, with enough nodes between?"
                      : "Does all that meets there move with it?"));
}

Result<int> runBuild(const BuildArguments& a) {
  std::vector<std::string> inputs{a.drawing};
  if (!a.source.empty()) inputs.push_back(a.source);
  if (auto ok = checkOutput(a.output, inputs, {".sweep"}, !a.quiet); !ok)
    return std::unexpected(ok.error());
  const Result<std::string> text = readFile(utf8Path(a.drawing));
  if (!text) return std::unexpected(text.error());
  const Result<Drawing> drawing = parseDrawing(*text, a.drawing);
  if (!drawing && isOfKind(a.drawing, ".sweep"))
    return fail(
        fmt::format("{} is a face already; write its wireframe as a text first: `sweepface "
                    "wireframe {} -o face.wire.json`.",
                    a.drawing, quoted(a.drawing)));
  if (!drawing) return std::unexpected(drawing.error());
  Result<Built> built = build(*drawing);
  if (!built) return std::unexpected(built.error());
  bool hasArcs = a.arcs;
  if (!a.source.empty()) {
    const Result<Rig> like = readFace(a.source);
    if (!like) return std::unexpected(like.error());
    if (auto ok = adoptSource(built->rig, *like); !ok)
      return fail(a.drawing + ": " + ok.error().message);
    hasArcs |= !like->turns.empty();
  }
  if (hasArcs) built->rig.turns = findTurns(built->rig);
  const Result<std::string> bytes = encodeReadable(built->rig, a.output);
  if (!bytes) return std::unexpected(bytes.error());
  if (auto written = writeFile(utf8Path(a.output), *bytes); !written)
    return std::unexpected(written.error());
  if (a.arcs && built->rig.turns.empty()) printWarning(kNoTurns);
  for (const Target& target : built->rig.targets)
    if (!canBeListed(target.name)) printWarning(cannotBeListed(target.name));
  if (drawing->tolerance == 0) warnOfMisses(a, *built);
  if (!a.quiet) printSummary(a, *built, bytes->size());
  return 0;
}

}  // namespace

Command addBuild(CLI::App& tool) {
  return makeCommand(tool, "build", "Turn a wireframe drawn as text (.wire.json) into a face",
                     runBuild);
}

}  // namespace sweepface::cli
