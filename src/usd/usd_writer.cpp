#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

#include "sweepface/usd.hpp"

#include "io/rig_output.hpp"
#include "io/single.hpp"
#include "usd/archive.hpp"
#include "usd/mesh.hpp"
#include "usd/skeleton.hpp"
#include "usd/values.hpp"

namespace sweepface {
namespace usd {
namespace {

bool increase(const std::vector<double>& times) {
  return std::ranges::adjacent_find(times, std::greater_equal()) == times.end();
}

/// Several frames of one time code would be one time sample.
Result<void> checkTimeCodes(const std::vector<double>& times, const UsdOptions& options) {
  if (increase(timeCodes(times, options))) return {};
  return fail(
      "Frames are less than a millionth of a time code apart; make the motion longer, or ask for "
      "more time codes a second.");
}

Result<void> check(const Clip& clip, const UsdOptions& options) {
  if (clip.names.empty())
    return fail(
        "The face has no targets to animate; convert it with the meshes of its expressions.");
  if (!std::ranges::all_of(clip.times, isPlausibleTime) || !increase(clip.times))
    return fail("The times of the clip do not increase, or are beyond 300 years.");
  if (!io::areSingle(clip.weights))
    return fail("A weight of the clip is too large for the single precision of USD.");
  return checkTimeCodes(clip.times, options);
}

Result<void> check(const HeadTrack& head, const UsdOptions& options) {
  if (head.rotations.empty() || head.rotations.size() != head.times.size() ||
      !std::ranges::all_of(head.times, isPlausibleTime) || !increase(head.times) ||
      !io::areSingle(std::array{head.pivot}) ||
      !std::ranges::all_of(head.rotations, [](auto& q) { return io::areSingle(q); }))
    return fail("The head's rotation needs one for each of its increasing times.");
  return checkTimeCodes(head.times, options);
}

Result<void> check(const Rig& rig, const UsdOptions& options) {
  const io::RigOutput output{options.lod, options.grid, options.weights, options.clip,
                             options.metersPerUnit};
  if (auto ok = io::checkOutput(rig, output); !ok) return ok;
  constexpr double kMostFaces = 1e8;
  const double lod = options.lod;
  if (static_cast<double>(rig.surface.wireframe().quadCount()) * lod * lod > kMostFaces)
    return fail("So fine a mesh has more than 100,000,000 faces; choose a lower level of detail.");
  if (!io::areSingle(options.weights))
    return fail("A weight is too large for the single precision of USD.");
  if (!(options.timeCodesPerSecond > 0 && options.timeCodesPerSecond < 1e9))
    return fail("Time codes a second are a number above 0 and below 1,000,000,000.");
  if (options.clip)
    if (auto ok = check(*options.clip, options); !ok) return ok;
  return options.head ? check(*options.head, options) : Result<void>{};
}

double metersPerUnit(const Rig& rig, const UsdOptions& options) {
  if (options.metersPerUnit > 0) return options.metersPerUnit;
  if (!rig.scene.empty()) return 1;
  constexpr std::array<std::pair<std::string_view, double>, 7> known{{{"mm", 0.001},
                                                                      {"cm", 0.01},
                                                                      {"dm", 0.1},
                                                                      {"m", 1},
                                                                      {"km", 1000},
                                                                      {"in", 0.0254},
                                                                      {"ft", 0.3048}}};
  const auto* const unit =
      std::ranges::find(known, rig.names.units, &std::pair<std::string_view, double>::first);
  return unit != known.end() ? unit->second : 0.01;
}

std::string header(const Rig& rig, const UsdOptions& options) {
  std::string text =
      "#usda 1.0\n(\n    defaultPrim = \"face\"\n    doc = \"sweepface " SWEEPFACE_VERSION "\"\n";
  const auto codes = options.clip   ? timeCodes(options.clip->times, options)
                     : options.head ? timeCodes(options.head->times, options)
                                    : std::vector<double>{};
  const bool isAnimated = !codes.empty();
  // A viewer that is not told steps through 24 frames a second, so between the samples.
  if (isAnimated)
    text += fmt::format("    endTimeCode = {}\n    framesPerSecond = {}\n", codes.back(),
                        options.timeCodesPerSecond);
  text += fmt::format("    metersPerUnit = {}\n", metersPerUnit(rig, options));
  if (isAnimated) text += fmt::format("    startTimeCode = {}\n", codes.front());
  return text + fmt::format("    timeCodesPerSecond = {}\n    upAxis = \"{}\"\n)\n\n",
                            options.timeCodesPerSecond, options.zUp ? 'Z' : 'Y');
}

Result<std::string> writeLayer(const Rig& rig, const UsdOptions& options, const Tessellation& grid,
                               const Looks& looks) {
  const std::string root = "/face", skeleton = "skeleton";
  const bool isMoved = moves(rig, options);
  const MeshWriter mesh(rig, options, grid);
  Text text;
  text.open(isMoved ? "SkelRoot" : "Xform", "face");
  if (isMoved) addSkeleton(text, root, skeleton, rig, options);
  if (auto ok = mesh.add(text, root, "mesh", isMoved ? root + "/" + skeleton : ""); !ok)
    return std::unexpected(ok.error());
  mesh.materials().addScope(text, root, looks);
  text.close();
  return header(rig, options) + text.take();
}

Result<std::string> layerOf(const Rig& rig, const UsdOptions& options, const Looks& looks) {
  if (auto ok = check(rig, options); !ok) return std::unexpected(ok.error());
  const io::OutputGrid grid(rig, options.lod, options.grid);
  const std::optional<Rig> other = io::withOtherMesh(rig, options.lod, options.grid);
  return writeLayer(other ? *other : rig, options, grid.get(), looks);
}

}  // namespace
}  // namespace usd

Result<std::string> formatUsd(const Rig& rig, const UsdOptions& options) {
  const auto looks = usd::looksOf(rig, false);
  if (!looks) return std::unexpected(looks.error());
  return usd::layerOf(rig, options, *looks);
}

Result<std::string> formatUsdz(const Rig& rig, const UsdOptions& options) {
  const auto looks = usd::looksOf(rig, true);
  if (!looks) return std::unexpected(looks.error());
  const auto layer = usd::layerOf(rig, options, *looks);
  if (!layer) return layer;
  std::vector<usd::ArchiveFile> files{{"face.usda", *layer}};
  for (const usd::Image& image : looks->images) files.push_back({image.file, image.bytes});
  return usd::archive(files);
}

}  // namespace sweepface
