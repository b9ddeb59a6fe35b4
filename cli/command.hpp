#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sweepface/gltf.hpp"
#include "sweepface/io.hpp"
#include "sweepface/measure.hpp"
#include "sweepface/result.hpp"
#include "sweepface/rig.hpp"
#include "sweepface/strip.hpp"

#include "output.hpp"

namespace sweepface::cli {

/// A command of the tool and what it does once its options are parsed: the exit code, or why it
/// failed.
struct Command {
  CLI::App* app = nullptr;
  std::function<Result<int>()> run;
};

Command addConvert(CLI::App& tool);
Command addInfo(CLI::App& tool);
Command addCheck(CLI::App& tool);
Command addMeasure(CLI::App& tool);
Command addExport(CLI::App& tool);
Command addAnimate(CLI::App& tool);
Command addWireframe(CLI::App& tool);
Command addRender(CLI::App& tool);
Command addReport(CLI::App& tool);
Command addPlot(CLI::App& tool);
Command addLaws(CLI::App& tool);
Command addBuild(CLI::App& tool);
Command addEdit(CLI::App& tool);
Command addPack(CLI::App& tool);

/// Help that breaks long descriptions into lines.
class HelpFormatter : public CLI::Formatter {
  std::string make_option_desc(const CLI::Option* option) const override;
};

/// A command whose options are declared by addOptions(CLI::App&, Options&).
template <typename Options>
Command makeCommand(CLI::App& tool, const std::string& name, const std::string& description,
                    Result<int> (*run)(const Options&)) {
  CLI::App* app = tool.add_subcommand(name, description);
  auto options = std::make_shared<Options>();
  addOptions(*app, *options);
  return {app, [options, run] { return run(*options); }};
}

// ---- Options that several commands have ----

void addQuiet(CLI::App& app, bool& quiet);
void addJson(CLI::App& app, bool& json);
void addFace(CLI::App& app, std::string& face);
void addOutput(CLI::App& app, std::string& output, const std::string& description);
void addWeights(CLI::App& app, std::string& weights);
CLI::Option* addLod(CLI::App& app, int& lod, const std::string& description);
void addMeshes(CLI::App& app, std::string& neutral, std::vector<std::string>& targets);
void addThreads(CLI::App& app, int& threads);
void addStrip(CLI::App& app, std::string& strip);
void addUvBits(CLI::App& app, std::optional<int>& bits, const std::string& description);
/// Fails where nothing has those bits.
Result<void> checkUvBits(const std::optional<int>& bits, const Strip& parts);

/// What only .glb files can have.
struct GlbArguments {
  bool morphNormals = false, quantize = false;
  bool any() const { return morphNormals || quantize; }
  GlbOptions options(Index lod) const {
    return {.lod = lod, .morphNormals = morphNormals, .quantize = quantize};
  }
};
void addGlb(CLI::App& app, GlbArguments& glb);

/// Whether a list of weights, NAME=W,..., can hold the name of a target, and what is said if not.
bool canBeListed(const std::string& name);
std::string cannotBeListed(const std::string& name);

/// Warns of meshes that a face was hardly made from: those are within its tolerance.
void warnOfOtherMeshes(const Rig& rig, const Measurement& measured);
/// The same where they can be compared at all.
void warnOfOtherMeshes(const Rig& rig, const MeshRig& source);

/// What is said where a face loses what its file held besides it, of the file it comes from.
std::string sceneIsLost(const std::string& file);

CLI::Validator wholeNumber(std::int64_t low, std::int64_t high);
/// A finite number > 0, and at most `high` if that is given.
CLI::Validator positiveNumber(double high = 0);
CLI::Validator numberFromZero();
CLI::Validator finiteNumber();
/// Anything but what an empty variable of a script leaves.
CLI::Validator notEmpty();
/// From 0 to below 1.
CLI::Validator partOfOne();
CLI::Validator onOrOff();

/// An option that takes one value, or list of values with commas between, each time it is given, so
/// that what follows is no more of it.
CLI::Option* oneEachTime(CLI::Option* option);

/// "X,Y,Z": three finite numbers and nothing else.
std::optional<Vec3> parsePoint(std::string_view text);

/// The point that an option tells, whose coordinates a float holds.
Result<Vec3> pointGiven(std::string_view option, std::string_view text);

std::vector<std::string> targetNames(const Rig& rig);

/// The weights that an option tells; the error begins with its name.
Result<Weights> weightsGiven(std::string_view option, std::string_view text, const Rig& rig);

// ---- Files ----

Result<Rig> readFace(const std::string& path);
/// The face that bytes are, of which messages say where they come from.
Result<Rig> opened(std::string_view bytes, const std::string& path);
/// Quads that a face may have, at whatever level: each takes about a kilobyte while it is made and
/// written.
inline constexpr double kMostQuads = 8e6;

/// What a file would hold, read again before it is written.
Result<Rig> readBack(std::string_view bytes, const std::string& path);
/// The bytes of a face that can be read again.
Result<std::string> encodeReadable(const Rig& rig, const std::string& path);

/// Whether a file's name ends like ".glb", in small or large letters.
bool isOfKind(const std::filesystem::path& path, std::string_view kind);
/// A .glb or .gltf.
bool isGltf(const std::filesystem::path& path);

/// The face that addMeshes() named.
Result<RigSource> readMeshes(const std::string& neutral, const std::vector<std::string>& targets,
                             ProgressBar& bar);

/// Whether a file can be made at `output` without loss of an input, asked before the long work. Its
/// name ends in one of `kinds`, so that nobody takes it for another kind of file. `reports`:
/// whether a report goes to the standard output, so that the file cannot.
Result<void> checkOutput(const std::filesystem::path& output,
                         const std::vector<std::string>& inputs,
                         std::initializer_list<std::string_view> kinds, bool reports = true);

}  // namespace sweepface::cli
