#include "sweepface/report.hpp"

#include <fmt/format.h>
#include <optional>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/io.hpp"

#include "command.hpp"
#include "interrupts.hpp"
#include "output.hpp"

namespace sweepface::cli {
namespace {

struct ReportArguments {
  std::string face, output, gltfpack;
  std::optional<std::string> weights;
  MeshArguments meshes;
  std::vector<std::string> regions;
  std::vector<double> tolerances;
  bool noTolerances = false, quiet = false;
};

void addOptions(CLI::App& app, ReportArguments& a) {
  addFace(app, a.face);
  addMeshes(app, a.meshes);
  CLI::Option* meshes = app.get_option("NEUTRAL")->required(false);
  for (const char* of : {"--mesh", "--subdivide"}) app.get_option(of)->needs(meshes);
  addOutput(app, a.output, "The .html file to write");
  app.add_option("--weights", a.weights,
                 "The expression shown beside the neutral; the target that moves furthest if not "
                 "given")
      ->type_name("NAME=W,...");
  CLI::Option* tolerances =
      oneEachTime(app.add_option(
                      "--tolerances", a.tolerances,
                      "Convert again with these, for the plots of error against points and bytes; "
                      "2, 4 and 8 times the face's own if not given"))
          ->delimiter(',')
          ->check(positiveNumber())
          ->needs(meshes)
          ->type_name("T,...");
  CLI::Option* none =
      app.add_flag("--no-tolerances", a.noTolerances, "Do not convert again: much quicker")
          ->excludes(tolerances)
          ->needs(meshes);
  app.add_option("--gltfpack", a.gltfpack,
                 "The program that packs GLBs for the plot of error against bytes; the one on the "
                 "PATH if not given")
      ->check(notEmpty())
      ->needs(meshes)
      ->excludes(none)
      ->type_name("PATH");
  oneEachTime(app.add_option("--box", a.regions,
                             "Draw a box round what the targets move whose names contain NAME; "
                             "mouth and eye if not given"))
      ->check(notEmpty())
      ->type_name("NAME");
  addQuiet(app, a.quiet);
  app.footer(
      "\nWrites a page with pictures, tables and plots that needs nothing else to be read. Without "
      "meshes to compare\nwith it shows how the face moves.\n\n"
      "Examples:\n  sweepface report face.sweep neutral.obj expressions/ -o report.html\n"
      "  sweepface report face.sweep --weights jawOpen=0.6,mouthSmileLeft=1,mouthSmileRight=1 -o "
      "laugh.html");
}

Result<ReportOptions> optionsOf(const ReportArguments& a, const Rig& rig, std::size_t bytes) {
  ReportOptions options;
  options.name = utf8Path(a.face).filename().string();
  options.bytes = bytes;
  if (a.weights) {
    const Result<Weights> weights = weightsGiven("--weights", *a.weights, rig);
    if (!weights) return std::unexpected(weights.error());
    options.expression = *weights;
  }
  if (!a.regions.empty()) options.regions = a.regions;
  if (!a.gltfpack.empty()) {
    // A name without a folder is searched for only when it is run.
    std::error_code ignored;
    if (a.gltfpack.contains('/') &&
        !std::filesystem::is_regular_file(utf8Path(a.gltfpack), ignored))
      return fail(fmt::format("There is no program {}; --gltfpack says where it is.", a.gltfpack));
    options.gltfpack = a.gltfpack;
  }
  options.tolerances = a.tolerances;
  return options;
}

Result<std::string> reportOf(const ReportArguments& a) {
  const Result<std::string> bytes = readFile(utf8Path(a.face));
  if (!bytes) return std::unexpected(bytes.error());
  const Result<Rig> rig = opened(*bytes, a.face);  // a pipe is read once
  if (!rig) return std::unexpected(rig.error());
  Result<ReportOptions> options = optionsOf(a, *rig, bytes->size());
  if (!options) return std::unexpected(options.error());
  options->cancel = &interrupted;
  std::optional<ProgressBar> bar(a.quiet);
  options->progress = [&](std::string_view what, double done) { bar->show(what, done); };
  if (a.meshes.neutral.empty()) return makeMotionReport(*rig, *options);
  const Result<RigSource> source = readMeshes(a.meshes, *bar);
  bar.emplace(a.quiet);  // erases the old bar, so that a warning begins a line
  if (!source) return std::unexpected(source.error());
  warnOfOtherMeshes(*rig, source->rig);
  const double size = diagonal(source->rig.neutral);
  if (a.tolerances.empty() && !a.noTolerances && rig->tolerance > 0)
    for (const double times : {2, 4, 8})
      if (times * rig->tolerance <= size) options->tolerances.push_back(times * rig->tolerance);
  return makeReport(*rig, source->rig, *options);
}

Result<int> runReport(const ReportArguments& a) {
  std::vector<std::string> inputs = a.meshes.files();
  inputs.push_back(a.face);
  if (auto ok = checkOutput(a.output, inputs, {".html", ".htm"}, !a.quiet); !ok)
    return std::unexpected(ok.error());
  catchInterrupts();
  const Result<std::string> page = reportOf(a);
  if (interrupted) return endInterrupted();
  if (!page) return std::unexpected(page.error());
  if (auto written = writeFile(utf8Path(a.output), *page); !written)
    return std::unexpected(written.error());
  if (!a.quiet) fmt::print("{}: {} bytes\n", a.output, page->size());
  return 0;
}

}  // namespace

Command addReport(CLI::App& tool) {
  return makeCommand(tool, "report", "Write a page of pictures, tables and plots (.html)",
                     runReport);
}

}  // namespace sweepface::cli
