#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sweepface/io.hpp"
#include "sweepface/measure.hpp"
#include "sweepface/result.hpp"
#include "sweepface/rig.hpp"
#include "sweepface/strip.hpp"

#include "output.hpp"

namespace sweepface::cli {

/// A command of the tool. `run` is called once its options are parsed and returns the exit code, or
/// why it failed.
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

/// Help with long descriptions wrapped.
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

// ---- Options shared by several commands ----

void addQuiet(CLI::App& app, bool& quiet);
void addJson(CLI::App& app, bool& json);
void addFace(CLI::App& app, std::string& face);
void addOutput(CLI::App& app, std::string& output, const std::string& description);
CLI::Option* addWeights(CLI::App& app, std::string& weights);
CLI::Option* addLod(CLI::App& app, int& lod, const std::string& description);
/// The meshes that a command reads: a neutral, and its targets or folders of them.
struct MeshArguments {
  std::string neutral;
  std::vector<std::string> targets;
  std::vector<std::string> chosen;  ///< names of the meshes that are the face
  int subdivisions = 0;             ///< levels of subdivide() before they are used

  std::vector<std::string> files() const;
};
void addMeshes(CLI::App& app, MeshArguments& meshes);
CLI::Option* addChosen(CLI::App& app, std::vector<std::string>& names);
CLI::Option* addSubdivide(CLI::App& app, int& levels);
void addThreads(CLI::App& app, int& threads);
void addStrip(CLI::App& app, std::string& strip);
void addUvBits(CLI::App& app, std::optional<int>& bits, const std::string& description);
/// "Did you mean 'jawOpen'? " for the first name in a list NAME=...,... that is no target; or
/// nothing.
std::string hintAtName(std::string_view items, const Rig& rig);

/// What --strip leaves out. Fails if --uv-bits is given for texture coordinates that are.
Result<Strip> stripGiven(const std::string& strip, const std::optional<int>& uvBits);

/// Whether a target of this name can appear in a list of weights, NAME=W,...; and the message if it
/// cannot.
bool canBeListed(const std::string& name);
std::string cannotBeListed(const std::string& name);

/// Warns if meshes are beyond the face's tolerance, so that it was hardly made from them.
void warnOfOtherMeshes(const Rig& rig, const Measurement& measured);
/// The same, if the two can be compared at all.
void warnOfOtherMeshes(const Rig& rig, const MeshRig& source);

/// The message that everything `file` holds besides the face is lost.
std::string sceneIsLost(const std::string& file);

CLI::Validator wholeNumber(std::int64_t low, std::int64_t high);
/// A finite number > 0, and at most `high` if that is given.
CLI::Validator positiveNumber(double high = 0);
CLI::Validator numberFromZero();
CLI::Validator finiteNumber();
/// Refuses what an empty variable of a script leaves.
CLI::Validator notEmpty();
/// A number from 0 to below 1.
CLI::Validator partOfOne();
CLI::Validator onOrOff();

/// Makes an option take one value, or one comma-separated list, each time it is given, so that it
/// does not swallow the arguments that follow.
CLI::Option* oneEachTime(CLI::Option* option);

/// "X,Y,Z": three finite numbers and nothing else.
std::optional<Vec3> parsePoint(std::string_view text);

/// The point that an option gives; its coordinates must fit in a float.
Result<Vec3> pointGiven(std::string_view option, std::string_view text);

/// The weights that an option gives; an error begins with the option's name.
Result<Weights> weightsGiven(std::string_view option, std::string_view text, const Rig& rig);

// ---- Files ----

/// A path as it is given in a shell.
std::string quoted(const std::string& path);

Result<Rig> readFace(const std::string& path);
/// Decodes a face. Messages name `path` as the origin of the bytes.
Result<Rig> opened(std::string_view bytes, const std::string& path);
/// The most quads that a face may have, at any level of detail: each takes about a kilobyte while
/// it is made and written.
inline constexpr double kMostQuads = 8e6;

/// Decodes the bytes of a file before they are written.
Result<Rig> readBack(std::string_view bytes, const std::string& path);
/// Encodes a face and makes sure that it can be decoded.
Result<std::string> encodeReadable(const Rig& rig, const std::string& path);

/// Whether a file's name has an ending like ".glb", in lower or upper case.
bool isOfKind(std::string_view path, std::string_view kind);
bool isGltf(std::string_view path);

/// Reads the meshes that the options of addMeshes() name, as they are in their files.
Result<RigSource> readCages(const MeshArguments& meshes, ProgressBar& bar, bool withScene);
/// Subdivides them as the options ask.
Result<RigSource> subdivided(RigSource source, const MeshArguments& meshes);
/// Does both, without a scene.
Result<RigSource> readMeshes(const MeshArguments& meshes, ProgressBar& bar);

/// Checks, before the long work, that a file can be made at `output` without overwriting an input.
/// Its name must end in one of `kinds`, so that nobody takes it for another kind of file. If
/// `reports`, a report goes to the standard output, so the file cannot.
Result<void> checkOutput(const std::string& output, const std::vector<std::string>& inputs,
                         std::initializer_list<std::string_view> kinds, bool reports = true);

}  // namespace sweepface::cli
