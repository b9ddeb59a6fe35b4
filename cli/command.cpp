#include "command.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <ranges>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "sweepface/codec.hpp"
#include "sweepface/subdivision.hpp"

#include "file_names.hpp"
#include "near_name.hpp"

namespace sweepface::cli {
namespace {

namespace fs = std::filesystem;

/// Parses a text that must be a number from end to end; inf and nan do not count.
template <typename Number>
bool parse(std::string_view text, Number& number) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stop == end && std::isfinite(static_cast<double>(number));
}

/// Accepts the numbers that are allowed; the message for others says what they must be.
template <typename Allowed>
CLI::Validator number(Allowed isAllowed, const std::string& what) {
  const auto check = [=](const std::string& text) -> std::string {
    double value = 0;
    if (parse(text, value) && isAllowed(value)) return {};
    return fmt::format("This must be {}, not '{}'.", what, text);
  };
  return CLI::Validator(check, "", "");
}

/// Whether `path` is the pipe that the report goes to, where the two would mix.
bool isPipeOfReport(const fs::path& path) {
  struct stat there{}, report{};
  return stat(path.string().c_str(), &there) == 0 && fstat(STDOUT_FILENO, &report) == 0 &&
         S_ISFIFO(there.st_mode) && there.st_dev == report.st_dev && there.st_ino == report.st_ino;
}

/// Whether this is an alias of a stream, such as /dev/stdout, that is redirected to a file:
/// replacing the alias by a new file would not reach that one.
bool leadsToFile(const fs::path& path) {
  const fs::path way = fs::absolute(path).lexically_normal(), folder = way.parent_path();
  const bool isStream = folder == "/dev/fd" || way == "/dev/stdout" || way == "/dev/stderr" ||
                        (folder.filename() == "fd" && folder.string().starts_with("/proc/"));
  std::error_code ignored;
  return isStream && fs::is_regular_file(path, ignored);
}

}  // namespace

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  constexpr std::size_t width = 68;
  std::string text = CLI::Formatter::make_option_desc(option);
  std::size_t line = 0;
  while (text.size() - line > width) {
    const std::size_t space = text.rfind(' ', line + width);
    if (space == std::string::npos || space <= line) break;
    text[space] = '\n';
    line = space + 1;
  }
  return text;
}

void addQuiet(CLI::App& app, bool& quiet) {
  app.add_flag("-q,--quiet", quiet, "Print errors and warnings only");
}

void addJson(CLI::App& app, bool& json) {
  app.add_flag("--json", json, "Print the report as JSON, for programs");
}

void addFace(CLI::App& app, std::string& face) {
  app.add_option("FACE", face, "The face, a .sweep file")->required()->type_name("");
}

void addOutput(CLI::App& app, std::string& output, const std::string& description) {
  app.add_option("-o,--output", output, description)->required()->type_name("PATH");
}

CLI::Option* addWeights(CLI::App& app, std::string& weights) {
  return app
      .add_option("--weights", weights,
                  "The expression: targets and how much of each, e.g. jawOpen=1,eyeBlink_L=0.5; "
                  "targets that are not named are at 0")
      ->type_name("NAME=W,...");
}

CLI::Option* addLod(CLI::App& app, int& lod, const std::string& description) {
  return app.add_option("--lod", lod, description)->transform(wholeNumber(1, 64))->type_name("N");
}

std::vector<std::string> MeshArguments::files() const {
  std::vector<std::string> files = targets;
  if (!neutral.empty()) files.push_back(neutral);
  return files;
}

CLI::Option* addSubdivide(CLI::App& app, int& levels) {
  return app
      .add_option("--subdivide", levels,
                  fmt::format("The meshes are cages of subdivision surfaces (Catmull-Clark): use "
                              "their limit, with every edge cut into 2^N; N from 1 to {}",
                              kMostSubdivisions))
      ->transform(wholeNumber(1, kMostSubdivisions))
      ->type_name("N");
}

CLI::Option* addChosen(CLI::App& app, std::vector<std::string>& names) {
  const char* const help =
      "Of a .glb, .gltf or .vrm: the face is what the object of this name shows, or the mesh of "
      "this name; once for each. Without, all that the scene shows and that has morph targets";
  return oneEachTime(app.add_option("--mesh", names, help))->check(notEmpty())->type_name("NAME");
}

void addMeshes(CLI::App& app, MeshArguments& meshes) {
  app.add_option("NEUTRAL", meshes.neutral,
                 "The face at rest, an .obj or .ply file; or a face with its expressions, a .glb, "
                 ".gltf or .vrm")
      ->required()
      ->type_name("");
  app.add_option("TARGETS", meshes.targets,
                 "Its expressions: .obj or .ply files with the same vertices in the same order, or "
                 "folders of them; each is named after its file")
      ->type_name("");
  addChosen(app, meshes.chosen);
  addSubdivide(app, meshes.subdivisions);
}

void addThreads(CLI::App& app, int& threads) {
  app.add_option("--threads", threads, "How many threads may work; all cores if not given")
      ->transform(wholeNumber(1, 1024))
      ->type_name("N");
}

std::string sceneIsLost(const std::string& file) {
  return "What " + file + " holds besides the face is left out with the order, which it counts on.";
}

void addStrip(CLI::App& app, std::string& strip) {
  app.add_option("--strip", strip,
                 "Leave parts out of the file, with commas between: order (of the source's "
                 "vertices and faces), uv, groups, scene")
      ->check(notEmpty())
      ->type_name("PARTS");
}

void addUvBits(CLI::App& app, std::optional<int>& bits, const std::string& description) {
  app.add_option("--uv-bits", bits, description)->transform(wholeNumber(8, 16))->type_name("N");
}

Result<Strip> stripGiven(const std::string& strip, const std::optional<int>& uvBits) {
  const Result<Strip> parts = strip.empty() ? Strip{} : parseStrip(strip);
  if (parts && parts->uv && uvBits)
    return fail(
        "--uv-bits says how texture coordinates are stored, and --strip uv leaves them out; give "
        "one of the two.");
  return parts;
}

bool canBeListed(const std::string& name) {
  return !name.contains(',') && !name.starts_with(' ') && !name.ends_with(' ');
}

std::string cannotBeListed(const std::string& name) {
  return fmt::format(
      "'{}' is no name for a list of weights; rename the target to set it with --weights and the "
      "like.",
      name);
}

void warnOfOtherMeshes(const Rig& rig, const Measurement& measured) {
  constexpr double kRounding = 1.001;
  const auto furthest = std::ranges::max_element(
      measured.shapes, {}, [](const PoseErrors& e) { return e.distance.max; });
  if (furthest == measured.shapes.end() || !(furthest->distance.max > kRounding * rig.tolerance))
    return;
  printWarning(
      fmt::format("{} is up to {:.3g} away, beyond the tolerance of the face, {:.3g}: the face was "
                  "edited or drawn, or these are not the meshes that it was made from.",
                  furthest->name, furthest->distance.max, rig.tolerance));
}

void warnOfOtherMeshes(const Rig& rig, const MeshRig& source) {
  if (const auto measured = measure(rig, source, {.mixtures = 0, .facets = false}))
    warnOfOtherMeshes(rig, *measured);
}

CLI::Validator wholeNumber(std::int64_t low, std::int64_t high) {
  const auto check = [=](std::string& text) -> std::string {
    std::int64_t number = 0;
    if (!parse(text, number) || number < low || number > high)
      return fmt::format("This must be a whole number from {} to {}, not '{}'.", low, high, text);
    text = std::to_string(number);  // CLI11 reads a leading zero as octal
    return {};
  };
  return CLI::Validator(check, "", "");
}

CLI::Validator positiveNumber(double high) {
  const std::string limit = high > 0 ? fmt::format(" and at most {}", high) : "";
  return number([=](double x) { return x > 0 && (high == 0 || x <= high); },
                "a finite number greater than 0" + limit);
}

CLI::Validator numberFromZero() {
  return number([](double x) { return x >= 0; }, "a finite number of at least 0");
}

CLI::Validator finiteNumber() {
  return number([](double) { return true; }, "a number");
}

CLI::Validator partOfOne() {
  return number([](double x) { return x >= 0 && x < 1; }, "a number from 0 to below 1");
}

CLI::Validator notEmpty() {
  const auto check = [](const std::string& text) -> std::string {
    return text.find_first_not_of(" ,") == std::string::npos
               ? "This is empty; give it something, or leave it out."
               : "";
  };
  return CLI::Validator(check, "", "");
}

CLI::Option* oneEachTime(CLI::Option* option) {
  return option->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

CLI::Validator onOrOff() {
  const auto check = [](const std::string& text) -> std::string {
    const bool known = text == "on" || text == "off";
    return known ? "" : fmt::format("This must be on or off, not '{}'.", text);
  };
  return CLI::Validator(check, "", "");
}

Result<Rig> readFace(const std::string& path) {
  const Result<std::string> bytes = readFile(utf8Path(path));
  if (!bytes) return std::unexpected(bytes.error());
  return opened(*bytes, path);
}

std::string quoted(const std::string& path) {
  const auto isPlain = [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) || std::string_view("_-+=.,:@%/").contains(c);
  };
  if (std::ranges::all_of(path, isPlain)) return path;
#ifdef _WIN32
  return '"' + path + '"';
#else
  std::string text = "'";
  for (const char c : path) c == '\'' ? text += "'\\''" : text += c;
  return text + "'";
#endif
}

Result<Rig> opened(std::string_view bytes, const std::string& path) {
  Result<Rig> rig = decode(bytes, path);
  if (!rig && (isGltf(path) || isOfKind(path, ".obj") || isOfKind(path, ".ply")))
    return fail(
        fmt::format("{} is a file of meshes, not a face; make one of it first: `sweepface convert "
                    "{} -o face.sweep`.",
                    path, quoted(path)));
  if (!rig && isOfKind(path, ".json"))
    return fail(
        fmt::format("{} is a text, not a face; if it is a wireframe, make a face of it first: "
                    "`sweepface build {} -o face.sweep`.",
                    path, quoted(path)));
  if (!rig) return rig;
  // A file of a few bytes can declare patches with any number of quads.
  const double quads = static_cast<double>(rig->surface.wireframe().quadCount());
  if (quads <= kMostQuads) return rig;
  return fail(
      fmt::format("{}: its patches have {:.1f} million quads, of which this program opens at most "
                  "{:.0f} million; the file may be damaged.",
                  path, quads / 1e6, kMostQuads / 1e6));
}

Result<Rig> readBack(std::string_view bytes, const std::string& path) {
  Result<Rig> rig = decode(bytes, "it");
  if (rig) return rig;
  const std::string why = rig.error().message;
  return fail(
      fmt::format("Cannot write {}: it could not be opened again, as the model is too large for "
                  "the format, or has too little in it for its size ({}); scale it down, or leave "
                  "it unpacked.",
                  path, why.substr(0, why.find(';'))));
}

Result<std::string> encodeReadable(const Rig& rig, const std::string& path) {
  std::string bytes = encode(rig);
  if (const auto back = readBack(bytes, path); !back) return std::unexpected(back.error());
  return bytes;
}

std::optional<Vec3> parsePoint(std::string_view text) {
  std::array<double, 3> p{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t end = k < 2 ? text.find(',') : text.size();
    if (end == text.npos || !parse(text.substr(0, end), p[k])) return {};
    text.remove_prefix(k < 2 ? end + 1 : end);
  }
  return Vec3{p[0], p[1], p[2]};
}

Result<Vec3> pointGiven(std::string_view option, std::string_view text) {
  const auto isSound = [](double x) { return std::abs(x) <= std::numeric_limits<float>::max(); };
  if (const auto p = parsePoint(text); p && isSound(p->x) && isSound(p->y) && isSound(p->z))
    return *p;
  return fail(fmt::format("{} is a point like 0,1.5,-2, not '{}'.", option, text));
}

namespace {

/// Whether a part between commas consists only of digits: the 5 of "jawOpen=0,5".
bool hasDecimalComma(std::string_view text) {
  return std::ranges::any_of(text | std::views::split(',') | std::views::drop(1), [](auto part) {
    return !part.empty() && std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; });
  });
}

}  // namespace

std::string hintAtName(std::string_view text, const Rig& rig) {
  const std::vector<std::string> names = rig.targetNames();
  for (const auto part : text | std::views::split(',')) {
    std::string_view name(part.begin(), part.end());
    name = name.substr(0, name.rfind('='));
    name.remove_prefix(std::min(name.find_first_not_of(' '), name.size()));
    name = name.substr(0, name.find_last_not_of(' ') + 1);
    if (name.empty() || std::ranges::find(names, name) != names.end()) continue;
    const std::string near = nearName(name, names);
    return near.empty() ? "" : fmt::format("Did you mean '{}'? ", near);
  }
  return "";
}

Result<Weights> weightsGiven(std::string_view option, std::string_view text, const Rig& rig) {
  Result<Weights> weights = parseWeights(rig, text);
  if (weights) return weights;
  const std::string hint =
      hasDecimalComma(text) ? "Numbers have a point, as in 0.5. " : hintAtName(text, rig);
  return fail(fmt::format("{}: {}{}", option, hint, weights.error().message));
}

bool isOfKind(std::string_view path, std::string_view kind) {
  return extensionOf(utf8Path(path)) == kind;
}

bool isGltf(std::string_view path) { return sweepface::isGltf(utf8Path(path)); }

Result<RigSource> readCages(const MeshArguments& meshes, ProgressBar& bar, bool withScene) {
  std::vector<fs::path> paths;
  for (const std::string& target : meshes.targets) paths.push_back(utf8Path(target));
  const auto show = [&](std::size_t done, std::size_t total) {
    bar.show("reading", static_cast<double>(done) / static_cast<double>(total));
  };
  return readSource(utf8Path(meshes.neutral), paths, show, {withScene, meshes.chosen});
}

Result<RigSource> subdivided(RigSource source, const MeshArguments& meshes) {
  if (meshes.subdivisions == 0) return source;
  Result<Subdivision> limit = subdivide(source.rig, meshes.subdivisions);
  if (!limit) return fail(fmt::format("{}: {}.", meshes.neutral, limit.error().message));
  source.rig = std::move(limit->rig);
  std::ranges::move(limit->warnings, std::back_inserter(source.faceWarnings));
  return source;
}

Result<RigSource> readMeshes(const MeshArguments& meshes, ProgressBar& bar) {
  Result<RigSource> source = readCages(meshes, bar, false);
  return source ? subdivided(std::move(*source), meshes) : std::move(source);
}

Result<void> checkOutput(const std::string& name, const std::vector<std::string>& inputs,
                         std::initializer_list<std::string_view> kinds, bool reports) {
  const auto cannot = [&](std::string_view why) {
    return fail(fmt::format("Cannot write {}: {}.", name, why));
  };
  const fs::path output = utf8Path(name);
  if (output.empty()) return fail("The name of the output is empty; name a file.");
  std::error_code ignored;
  for (const std::string& input : inputs)
    if (fs::equivalent(output, utf8Path(input), ignored))
      return cannot("it is what is read; choose another name");
  if (!output.has_filename() || fs::is_directory(output, ignored))
    return cannot("it is a folder; name a file");
  if (reports && isPipeOfReport(output)) return cannot("the report goes there; name a file");
  if (leadsToFile(output)) return cannot("it leads into a file; name that file");
  // A device is written to directly; any other file is replaced within its folder.
  const bool device = fs::exists(output, ignored) && !fs::is_regular_file(output, ignored);
  if (!device && !mayBeFileName(output.filename().string()))
    return cannot("no file can be called so; choose another name");
  if (!device && std::ranges::none_of(kinds, [&](auto kind) { return isOfKind(name, kind); }))
    return cannot(fmt::format("its name must end in {}", fmt::join(kinds, " or ")));
  if (!device && fs::exists(output, ignored) && access(output.string().c_str(), W_OK) != 0)
    return cannot("it is write-protected; make it writable, or choose another name");
  const fs::path folder = folderOf(output);
  if (!device && !fs::is_directory(folder, ignored))
    return cannot(fmt::format("there is no folder {}; create it first", folder.string()));
  if (access((device ? output : folder).string().c_str(), W_OK) != 0)
    return cannot(fmt::format("{}; choose another place, or change the permissions of this one",
                              std::generic_category().message(errno)));
  return {};
}

}  // namespace sweepface::cli
