#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "sweepface/arcs.hpp"
#include "sweepface/codec.hpp"
#include "sweepface/fit.hpp"
#include "sweepface/gltf.hpp"
#include "sweepface/io.hpp"
#include "sweepface/measure.hpp"
#include "sweepface/strip.hpp"

#include "command.hpp"
#include "following.hpp"
#include "interrupts.hpp"
#include "output.hpp"
#include "parallel.hpp"
#include "verified.hpp"

namespace sweepface::cli {
namespace {

struct ConvertArguments {
  MeshArguments meshes;
  std::string output, strip;
  double tolerance = 0, normalLimit = 0, normalTolerance = 0;
  std::uint64_t maxBytes = 0;
  std::optional<int> uvBits;
  int threads = 0;
  bool pack = false, arcs = false, noShapes = false, bare = false, quiet = false, json = false;
  bool packs() const { return pack || maxBytes > 0; }
  std::size_t mostBytes() const {
    return static_cast<std::size_t>(
        std::min<std::uint64_t>(maxBytes, std::numeric_limits<std::size_t>::max()));
  }
};

void addOptions(CLI::App& app, ConvertArguments& a) {
  addMeshes(app, a.meshes);
  addOutput(app, a.output, "The .sweep file to write");
  app.add_option("--tolerance", a.tolerance,
                 "Largest allowed distance between a vertex and the surface, in the mesh's units; "
                 "default: 0.02 % of the diagonal of the bounding box of the neutral's faces")
      ->check(positiveNumber())
      ->type_name("T");
  app.add_option("--normal-limit", a.normalLimit,
                 "Aim at normals within this angle of the mesh's, in degrees; 180 ignores normals; "
                 "default: in proportion to the tolerance")
      ->check(positiveNumber(180))
      ->type_name("DEG");
  app.add_flag("--pack", a.pack,
               "Spend the tolerance on file size: about a hundredth of the bytes, but more time, "
               "and normals further from the mesh's");
  addStrip(app, a.strip);
  app.add_option("--normal-tolerance", a.normalTolerance,
                 "With --pack or --max-bytes: largest allowed angle between the surface's normals "
                 "and the mesh's, in degrees, as the root mean square over all vertices of all "
                 "expressions")
      ->check(positiveNumber(90))
      ->type_name("DEGREES");
  addUvBits(app, a.uvBits,
            "With --pack or --max-bytes: texture coordinates become multiples of 1/2^N of the "
            "texture, N from 8 to 16; default: 14");
  app.add_option("--max-bytes", a.maxBytes,
                 "Pack, and search for the smallest tolerance (not below --tolerance, if given) "
                 "whose file takes at most N bytes; converts several times")
      ->transform(wholeNumber(1, std::int64_t{1} << 53))  // up to here doubles hold every integer
      ->type_name("N");
  app.add_flag("--arcs", a.arcs,
               "Store in the file what expressions turn about (the jaw about its hinge, lids about "
               "the eyeball), for programs that play it; some 25 bytes each");
  addThreads(app, a.threads);
  app.add_flag(
      "--no-shapes", a.noShapes,
      "Do not search for shape parameters: faster; normals are slightly further from the mesh's");
  app.add_flag(
      "--bare", a.bare,
      "Leave out what a .glb, .gltf or .vrm has besides the face: materials, textures, skins, "
      "other meshes ...");
  addQuiet(app, a.quiet);
  addJson(app, a.json);
  app.footer(
      "\nThe file is written only if every vertex of the neutral and of every expression is "
      "within the tolerance.\n\nExample:\n"
      "  sweepface convert head.obj expressions/ -o head.sweep --tolerance 0.05\n"
      "  sweepface convert head.glb -o head.sweep");
}

// ---- The summary ----

struct Summary {
  const ConvertArguments& arguments;
  const Conversion& conversion;
  const Verified& verified;
  std::size_t vertices, bytes, sceneBytes;
  double seconds;
};

nlohmann::ordered_json toJson(const Summary& s) {
  const Rig& rig = s.conversion.rig;
  const auto& [tolerance, worst, worstShape, angle, folds, kept] = s.verified;
  return {{"file", s.arguments.output},
          {"patches", rig.surface.patchCount()},
          {"vectors", rig.surface.storedCount()},
          {"vertices", s.vertices},
          {"targets", rig.targets.size()},
          {"tolerance", tolerance},
          {"worstDistance", worst.distance},
          {"worstVertex", worst.vertex},
          {"worstShape", worstShape},
          {"angleRms", angle.rms},
          {"angleMax", angle.max},
          {"folds", folds},
          {"kept", kept},
          {"bytes", s.bytes},
          {"sceneBytes", s.sceneBytes},
          {"seconds", s.seconds},
          {"warnings", s.conversion.warnings}};
}

void printText(const Summary& s) {
  const Rig& rig = s.conversion.rig;
  const Index points = rig.surface.storedCount();
  fmt::print("{}: {} patches, {} points ({:.1f} % of the source's {} vertices), {} targets\n",
             s.arguments.output, rig.surface.patchCount(), points,
             100.0 * points / static_cast<double>(s.vertices), s.vertices, rig.targets.size());
  printDistance(s.verified);
  const ConvertArguments& a = s.arguments;
  fmt::print(
      "normals {:.4g} {}, RMS over all expressions; at most {:.4g}{}\n", s.verified.angle.rms,
      a.normalTolerance > 0 ? fmt::format("of {:.4g} degrees allowed", a.normalTolerance)
                            : "degrees off",
      s.verified.angle.max, a.normalLimit > 0 ? fmt::format(" (aim: {:.4g})", a.normalLimit) : "");
  const std::vector<Index>& folds = s.verified.folds;
  if (const auto most = std::ranges::max_element(folds); *most > 0)
    fmt::print("{} triangles fold over, most in {} ({}); sweepface measure tells more\n",
               std::reduce(folds.begin(), folds.end()),
               nameOfShape(rig, static_cast<Index>(most - folds.begin()) - 1), *most);
  fmt::print("{} bytes in {:.1f} s\n", s.bytes, s.seconds);
  if (s.sceneBytes > 0)
    fmt::print("{} of them are what {} holds besides the face; --bare leaves it out\n",
               s.sceneBytes, s.arguments.meshes.neutral);
}

/// The size of the scene, as `info` reports it.
std::size_t sceneBytesOf(std::string_view bytes) {
  const Result<std::vector<FilePart>> parts = fileParts(bytes, "");
  if (!parts) return 0;
  const auto scene = std::ranges::find(*parts, "scene", &FilePart::name);
  return scene == parts->end() ? 0 : scene->bytes;
}

// ---- The command ----

ConvertOptions optionsOf(const ConvertArguments& a, ProgressBar& bar) {
  ConvertOptions options;
  options.tolerance = a.tolerance;
  options.normalLimit = a.normalLimit;
  options.pack = a.pack;
  options.normalTolerance = a.normalTolerance;
  options.textureBits = a.uvBits.value_or(options.textureBits);
  options.chooseShapes = !a.noShapes;
  options.progress = [&](std::string_view what, double done) { bar.show(what, done); };
  options.cancel = &interrupted;
  return options;
}

/// Reads the meshes, and the scene as the file is to hold it.
Result<RigSource> readSource(const ConvertArguments& a, const Strip& parts, ProgressBar& bar) {
  Result<RigSource> cages = readCages(a.meshes, bar, !a.bare && !parts.scene);
  if (!cages) return cages;
  const bool keepsScene = !cages->scene.empty() && !parts.order;
  if (a.meshes.subdivisions > 0 && keepsScene)
    return fail(
        fmt::format("What {} holds besides the face belongs to its mesh as it is, without "
                    "--subdivide; leave it out with --bare.",
                    a.meshes.neutral));
  Result<RigSource> source = subdivided(std::move(*cages), a.meshes);
  if (!source) return source;
  if (a.packs()) source->scene = packedScene(std::move(source->scene));
  if (a.maxBytes > 0 && keepsScene && source->scene.size() >= a.maxBytes)
    return fail(
        fmt::format("What {} holds besides the face takes {} bytes; leave it out with "
                    "--bare, or allow more.",
                    a.meshes.neutral, source->scene.size()));
  return source;
}

/// Warnings about the source, and about its scene if that is lost.
std::vector<std::string> warningsOf(const ConvertArguments& a, const Strip& parts,
                                    const RigSource& source) {
  const bool losesScene = parts.order && !source.scene.empty();
  std::vector<std::string> warnings = source.faceWarnings;
  if (!losesScene) std::ranges::copy(source.warnings, std::back_inserter(warnings));
  if (losesScene) warnings.push_back(sceneIsLost(a.meshes.neutral));
  if (isGltf(a.meshes.neutral) && source.rig.targets.empty())
    warnings.push_back(fmt::format(
        "{} no morph targets, so the face has no expressions.",
        a.meshes.chosen.empty() ? a.meshes.neutral + " has" : "The meshes that were chosen have"));
  for (const MeshTarget& target : source.rig.targets)
    if (!canBeListed(target.name)) warnings.push_back(cannotBeListed(target.name));
  return warnings;
}

Result<int> convertAndWrite(const ConvertArguments& a) {
  const auto start = std::chrono::steady_clock::now();
  const Result<Strip> parts = stripGiven(a.strip, a.uvBits);
  if (!parts) return std::unexpected(parts.error());
  std::optional<ProgressBar> bar(std::in_place, a.quiet);
  Result<RigSource> source = readSource(a, *parts, *bar);
  if (!source) return std::unexpected(source.error());
  if (interrupted) return kInterrupted;
  const auto refused = [&](const Error& error) {
    return fail(fmt::format("{}: {}.", a.meshes.neutral, error.message));
  };
  const auto finish = [&](Rig& rig) {
    std::vector<Turn> turns;
    if (a.arcs) turns = findTurns(rig);
    rig.scene = source->scene;
    auto ok = strip(rig, *parts);
    rig.turns = std::move(turns);
    return ok;
  };
  Result<Conversion> conversion =
      a.maxBytes > 0 ? convertToBytes(source->rig, optionsOf(a, *bar), a.mostBytes(), finish)
                     : convert(source->rig, optionsOf(a, *bar));
  if (!conversion) return refused(conversion.error());
  bar->show("verifying", 1);
  Rig finished = conversion->rig;
  if (auto ok = finish(finished); !ok) return refused(ok.error());
  const std::string bytes = encode(finished);
  const Result<Verified> verified =
      verify(bytes, a.output, source->rig, conversion->rig, conversion->rig.tolerance);
  if (!verified) return std::unexpected(verified.error());
  if (const auto written = writeAndReadBack(utf8Path(a.output), bytes); !written || *written != 0)
    return written;
  bar.reset();

  std::vector<std::string>& warnings = conversion->warnings;
  if (a.meshes.subdivisions > 0)
    for (std::string& warning : warnings) warning = "Of the subdivided mesh: " + warning;
  std::ranges::move(warningsOf(a, *parts, *source), std::back_inserter(warnings));
  if (auto lost = lostMovement(source->rig, verified->kept); !lost.empty())
    warnings.push_back(std::move(lost));
  if (a.arcs && finished.turns.empty()) warnings.push_back(kNoTurns);
  for (const std::string& warning : warnings) printWarning(warning);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const Summary summary{a,
                        *conversion,
                        *verified,
                        source->rig.neutral.positions.size(),
                        bytes.size(),
                        sceneBytesOf(bytes),
                        seconds.count()};
  if (a.json)
    printJson(toJson(summary));
  else if (!a.quiet)
    printText(summary);
  return 0;
}

Result<int> runConvert(const ConvertArguments& a) {
  if (auto ok = checkOutput(a.output, a.meshes.files(), {".sweep"}, a.json || !a.quiet); !ok)
    return std::unexpected(ok.error());
  std::error_code ignored;
  for (const std::string& word : a.meshes.files())
    if (a.arcs && (word == "on" || word == "off") && !std::filesystem::exists(word, ignored))
      return fail(fmt::format("Here --arcs stands alone; leave '{}' out.", word));
  if (!a.packs() && (a.uvBits || a.normalTolerance > 0))
    return fail(fmt::format("{} is for packed files; give --pack or --max-bytes as well.",
                            a.uvBits ? "--uv-bits" : "--normal-tolerance"));
  return doLongWork(a.threads, [&] { return convertAndWrite(a); });
}

}  // namespace

Command addConvert(CLI::App& tool) {
  return makeCommand(tool, "convert", "Turn a face mesh and its expressions into a .sweep file",
                     runConvert);
}

}  // namespace sweepface::cli
