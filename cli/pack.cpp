#include <fmt/format.h>
#include <numeric>
#include <optional>

#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/gltf.hpp"
#include "sweepface/strip.hpp"

#include "command.hpp"
#include "interrupts.hpp"
#include "output.hpp"
#include "verified.hpp"

namespace sweepface::cli {
namespace {

struct PackArguments {
  std::string face, output, strip;
  double tolerance = 0;
  std::optional<int> uvBits;
  int threads = 0;
  bool quiet = false;
};

void addOptions(CLI::App& app, PackArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output, "The .sweep file to write");
  app.add_option(
         "--tolerance", a.tolerance,
         "Largest distance by which a vertex may move, in the face's units; if not given the "
         "face's own tolerance, or where it is packed already what that was allowed")
      ->check(positiveNumber())
      ->type_name("T");
  addStrip(app, a.strip);
  addUvBits(app, a.uvBits,
            "Texture coordinates become multiples of 1/2^N of the texture, N from 8 to 16; as many "
            "as the face is packed with, or 14, if not given");
  addThreads(app, a.threads);
  addQuiet(app, a.quiet);
  app.footer(
      "\nFor faces that were edited or drawn. Meshes become smaller files by `sweepface convert "
      "--pack`.\n\nExample:\n"
      "  sweepface build face.wire.json -o face.sweep\n"
      "  sweepface pack face.sweep -o small.sweep --tolerance 0.02");
}

PackOptions optionsOf(const PackArguments& a, ProgressBar& bar) {
  return {.tolerance = a.tolerance,
          .textureBits = a.uvBits.value_or(0),
          .progress = [&](std::string_view what, double done) { bar.show(what, done); },
          .cancel = &interrupted};
}

/// How a face looks compared with its mesh.
struct Looks {
  double angleRms = 0;
  Index folds = 0;
};

Index sumOf(const std::vector<Index>& folds) { return std::reduce(folds.begin(), folds.end()); }

void printLooks(const Looks& now, const Looks& before) {
  fmt::print("normals {:.4g} degrees off those of its mesh, {:.4g} before, RMS\n", now.angleRms,
             before.angleRms);
  if (now.folds > 0) fmt::print("{} triangles fold over, {} before\n", now.folds, before.folds);
}

Result<int> packAndWrite(const PackArguments& a) {
  const Result<Strip> parts = stripGiven(a.strip, a.uvBits);
  if (!parts) return std::unexpected(parts.error());
  const Result<std::string> file = readFile(utf8Path(a.face));
  if (!file) return std::unexpected(file.error());
  const Result<Rig> before = opened(*file, a.face);
  if (!before) return std::unexpected(before.error());
  const auto refused = [&](const Error& error) {
    return fail(fmt::format("{}: {}.", a.face, error.message));
  };
  std::optional<ProgressBar> bar(std::in_place, a.quiet);
  bar->show("packing", 0);
  const MeshRig meshes = meshesOf(*before);
  const Looks looks{normalErrors(*before, meshes).rms, sumOf(countFolds(*before, meshes))};
  if (interrupted) return kInterrupted;
  Rig rig = *before;
  const Result<double> tolerance = pack(rig, optionsOf(a, *bar));
  if (!tolerance) return refused(tolerance.error());
  bar->show("verifying", 1);
  rig.scene = packedScene(std::move(rig.scene));
  Rig finished = rig;
  if (auto ok = strip(finished, *parts); !ok) return refused(ok.error());
  const std::string bytes = encode(finished);
  const Result<Verified> verified = verify(bytes, a.output, meshes, rig, *tolerance, &*before);
  if (!verified) return std::unexpected(verified.error());
  if (const auto written = writeAndReadBack(utf8Path(a.output), bytes); !written || *written != 0)
    return written;
  bar.reset();
  if (auto lost = lostMovement(meshes, verified->kept); !lost.empty()) printWarning(lost);
  if (parts->order && !parts->scene && !before->scene.empty()) printWarning(sceneIsLost(a.face));
  if (bytes.size() >= file->size())
    printWarning(fmt::format("{} is no smaller than {}; a larger --tolerance makes it so.",
                             a.output, a.face));
  if (a.quiet) return 0;
  fmt::print("{}: {} bytes, {:.1f} % of {}\n", a.output, bytes.size(),
             100.0 * static_cast<double>(bytes.size()) / static_cast<double>(file->size()), a.face);
  printDistance(*verified);
  printLooks({verified->angle.rms, sumOf(verified->folds)}, looks);
  return 0;
}

Result<int> runPack(const PackArguments& a) {
  if (auto ok = checkOutput(a.output, {a.face}, {".sweep"}, !a.quiet); !ok)
    return std::unexpected(ok.error());
  return doLongWork(a.threads, [&] { return packAndWrite(a); });
}

}  // namespace

Command addPack(CLI::App& tool) {
  return makeCommand(tool, "pack", "Make the file of a face that was edited or drawn small",
                     runPack);
}

}  // namespace sweepface::cli
