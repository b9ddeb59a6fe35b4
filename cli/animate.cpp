#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "sweepface/io.hpp"

#include "command.hpp"
#include "head.hpp"
#include "interrupts.hpp"
#include "key_frames.hpp"
#include "lod_mesh.hpp"
#include "mesh_folder.hpp"
#include "output.hpp"
#include "regions.hpp"
#include "rig_file.hpp"

namespace sweepface::cli {
namespace {

namespace fs = std::filesystem;

struct AnimateArguments {
  std::string face, output, keys, regions;
  PerformanceArguments what;
  FollowingArguments following;
  HeadArguments head;
  double framesPerSecond = 0, keyTolerance = 0;  // 0: not given
  int frames = 0, lod = 0;
  bool quiet = false;
  RigFileArguments rigFile;

  bool namesFrames() const { return frames > 0 || framesPerSecond > 0; }
  /// Of meshes and of sampled keys in a .glb.
  double usualRate() const { return what.clip.empty() ? 0 : 30; }
};

void addOptions(CLI::App& app, AnimateArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output,
            "A folder for frame_0000.obj, frame_0001.obj ..., made if it is not there; or a .glb "
            "or .usda file for the face with an animation of its targets; or a .csv of the "
            "weights, as Live Link Face records them");
  addPerformance(app, a.what);
  addRegions(app, a.regions);
  addFollowing(app, a.following);
  app.add_option(
         "--frames", a.frames,
         "How many meshes or sampled keys, the first and the last included; if neither this "
         "nor --fps is given 31, of a clip and in a .usda 30 a second, in a .csv 60 a second")
      ->transform(wholeNumber(2, 100'000))
      ->type_name("N");
  app.add_option("--fps", a.framesPerSecond, "Meshes or sampled keys a second, instead of --frames")
      ->check(positiveNumber(1000))
      ->excludes("--frames")
      ->type_name("N");
  app.add_option("--keys", a.keys,
                 "For .glb: exact (two or three keys with tangents hold the law exactly; the "
                 "default where the law can be held so), few (as few keys with tangents as keep "
                 "--key-tolerance; the default otherwise) or sampled (a key a frame without, for "
                 "programs that ignore tangents; the default with --frames or --fps)")
      ->check(notEmpty())
      ->type_name("KIND");
  app.add_option("--key-tolerance", a.keyTolerance,
                 "How far few keys may take a weight from what is played; 0.002 if not given")
      ->check(positiveNumber(1))
      ->type_name("W");
  addHead(app, a.head);
  addLod(app, a.lod, "Write finer meshes: every edge of the source cut into N, 1 to 64");
  addRigFile(app, a.rigFile);
  addQuiet(app, a.quiet);
  app.footer(
      "\nExamples:\n"
      "  sweepface animate face.sweep --to jawOpen=1 --law accelerate-brake -o frames/\n"
      "  sweepface animate face.sweep --to jawOpen=1 --law newton -o jaw.glb\n"
      "  sweepface animate face.sweep --clip take.csv --smooth -o take.glb");
}

/// The times of the meshes or keys, at `usualRate` frames a second if neither a rate nor a number
/// of frames is given; 0: 31 frames.
Result<std::vector<double>> sampleTimes(const AnimateArguments& a, const Performance& performance,
                                        double usualRate) {
  constexpr double kMostFrames = 1e6;
  const double rate = a.namesFrames() ? a.framesPerSecond : usualRate;
  if (performance.seconds * rate > kMostFrames)
    return fail(
        fmt::format("{:.6g} s at {:.6g} frames a second are more than {:.0f} frames; play "
                    "less of it, or ask for fewer a second.",
                    performance.seconds, rate, kMostFrames));
  const int last = rate > 0 ? static_cast<int>(std::floor(performance.seconds * rate + 1e-6))
                            : (a.frames > 0 ? a.frames : 31) - 1;
  const bool isCsv = isOfKind(a.output, ".csv");
  const bool hasKeys = isCsv || isOfKind(a.output, ".glb") || isUsd(a.output);
  if (hasKeys && last > 0 && performance.seconds == 0)
    return fail(
        fmt::format("{} has one frame, which is one key; leave --frames out.", performance.called));
  std::vector<double> times;
  for (int k = 0; k <= last; ++k)
    times.push_back(rate > 0 ? k / rate : performance.seconds * (static_cast<double>(k) / last));
  // The last key holds for ever, so the end is a key even between two frames; a mesh stands for one
  // frame. A timecode resolves thousandths of a frame.
  const double same =
      std::max(std::min(1e-4, 0.5 * performance.seconds), isCsv ? 1e-3 / a.what.writtenRate() : 0);
  if (!hasKeys) return times;
  // Key times have single precision.
  const bool isLater =
      isCsv || static_cast<float>(performance.seconds) > static_cast<float>(times.back());
  if (performance.seconds > times.back() + same && isLater) times.push_back(performance.seconds);
  times.back() = std::max(times.back(), performance.seconds);
  return times;
}

// ---- Meshes ----

Result<void> writeFrames(const AnimateArguments& a, const Rig& rig, const Performance& performance,
                         const std::vector<double>& times, const std::optional<HeadTrack>& head) {
  const MeshMaker meshes(rig, a.lod);
  const auto text = [&](std::size_t frame) {
    Weights weights(rig.targets.size());
    performance.at(times[frame], weights);
    return head ? meshes.obj(weights, head->rotations[frame], head->pivot) : meshes.obj(weights);
  };
  const auto path = [&](std::size_t frame) {
    return utf8Path(a.output) / fmt::format("frame_{:04}.obj", frame);
  };
  return writeMeshes({times.size(), "frames", utf8Path(a.face), path, text}, a.quiet);
}

void printFrames(const AnimateArguments& a, std::size_t count, const Performance& performance) {
  fmt::print("{}: {} frame{} of {:.6g} s, {}\n", a.output, count, count == 1 ? "" : "s",
             performance.seconds, performance.name);
}

Result<void> animateMeshes(const AnimateArguments& a, const Rig& rig,
                           const Performance& performance) {
  if (auto ok = checkLod(rig, a.lod); !ok) return ok;
  const Result<std::vector<double>> times = sampleTimes(a, performance, a.usualRate());
  if (!times) return std::unexpected(times.error());
  const auto head = headTrack(a.head, rig, performance, *times);
  if (!head) return std::unexpected(head.error());
  if (auto made = makeFolder(utf8Path(a.output)); !made) return made;
  if (auto written = writeFrames(a, rig, performance, *times, *head); !written) return written;
  if (!a.quiet) printFrames(a, times->size(), performance);
  return {};
}

// ---- GLB ----

/// The kind of keys that --keys names, or the default.
std::string keysOf(const AnimateArguments& a, const Performance& performance) {
  if (!a.keys.empty()) return a.keys;
  return a.namesFrames() ? "sampled" : performance.motion ? "exact" : "few";
}

Result<void> animateGlb(const AnimateArguments& a, const Rig& rig, const Performance& performance) {
  if (auto ok = checkFineness(rig.surface, a.lod); !ok) return ok;
  GlbOptions options = a.rigFile.glb(a.lod);
  options.animationName = performance.name;
  const std::string keys = keysOf(a, performance);
  Clip clip;
  if (keys == "exact") {
    options.motion = &*performance.motion;
  } else if (keys == "few") {
    constexpr double kLongest = 86400;
    if (performance.seconds > kLongest)
      return fail(
          fmt::format("{:.6g} s are too long to look for few keys in; give it a day at most, or "
                      "say --keys sampled and --frames.",
                      performance.seconds));
    const double tolerance = a.keyTolerance > 0 ? a.keyTolerance : 0.002;
    KeyFrames frames = keyFrames(performance, rig, tolerance);
    if (frames.missed > tolerance)
      printWarning(
          fmt::format("{} swings more quickly than keys can tell: between them weights are off by "
                      "{:.2g}, more than the tolerance of {:.6g}.",
                      performance.called, frames.missed, tolerance));
    clip = std::move(frames.clip);
    options.keyTolerance = frames.tolerance;
  } else {
    const bool own = !performance.frameTimes.empty() && !a.namesFrames();
    const Result<std::vector<double>> times =
        own ? ownKeyTimes(performance) : sampleTimes(a, performance, a.usualRate());
    if (!times) return std::unexpected(times.error());
    clip = sample(performance, rig, *times);
  }
  if (keys != "exact") options.clip = &clip;
  const bool isCut = keys == "few" && a.head.on() && performance.hasHead;
  const auto head =
      headTrack(a.head, rig, performance, isCut ? turningTimes(performance) : clip.times);
  if (!head) return std::unexpected(head.error());
  if (*head) options.head = &**head;
  const Result<std::string> bytes = formatGlb(rig, options);
  if (!bytes) return std::unexpected(bytes.error());
  if (auto written = writeFile(utf8Path(a.output), *bytes); !written) return written;
  if (!a.quiet)
    fmt::print("{}: {:.6g} s, {}, {} bytes\n", a.output, performance.seconds, performance.name,
               bytes->size());
  return {};
}

// ---- USD ----

/// How many frames a second a .usda has, which are its time codes.
double frameRate(const AnimateArguments& a, const Performance& performance) {
  if (a.frames > 0 && performance.seconds > 0) return (a.frames - 1) / performance.seconds;
  return a.framesPerSecond > 0 ? a.framesPerSecond : 30;
}

Result<void> animateUsd(const AnimateArguments& a, const Rig& rig, const Performance& performance) {
  if (auto ok = checkFineness(rig.surface, a.lod); !ok) return ok;
  UsdOptions options = a.rigFile.usd(a.lod);
  options.timeCodesPerSecond = frameRate(a, performance);
  const auto times = sampleTimes(a, performance, options.timeCodesPerSecond);
  if (!times) return std::unexpected(times.error());
  const Clip clip = sample(performance, rig, *times);
  options.clip = &clip;
  const auto head = headTrack(a.head, rig, performance, *times);
  if (!head) return std::unexpected(head.error());
  if (*head) options.head = &**head;
  const Result<std::string> text = formatUsdFor(a.output, rig, options);
  if (!text) return std::unexpected(text.error());
  if (auto written = writeFile(utf8Path(a.output), *text); !written) return written;
  if (!a.quiet) printFrames(a, clip.times.size(), performance);
  return {};
}

// ---- A recording ----

Result<void> animateCsv(const AnimateArguments& a, const Rig& rig, const Performance& performance) {
  const bool own =
      !performance.frameTimes.empty() && !a.namesFrames() && isOfKind(a.what.clip, ".csv");
  const Result<std::vector<double>> times =
      own ? performance.frameTimes : sampleTimes(a, performance, a.what.writtenRate());
  if (!times) return std::unexpected(times.error());
  Clip clip = sample(performance, rig, *times);
  if (performance.pose) addAngles(clip, performance.pose);
  const Result<std::string> text = formatLiveLinkCsv(clip, a.what.writtenRate());
  if (!text) return std::unexpected(text.error());
  if (auto written = writeFile(utf8Path(a.output), *text); !written) return written;
  if (!a.quiet) printFrames(a, clip.times.size(), performance);
  return {};
}

// ---- The command ----

/// Refuses options that do not go together.
Result<void> checkArguments(const AnimateArguments& a, bool glb) {
  if (!a.what.to && a.what.clip.empty())
    return fail("Say where to go with --to, or what to play with --clip.");
  if (!glb && (!a.keys.empty() || a.keyTolerance > 0))
    return fail(
        "--keys and --key-tolerance are for .glb files; name the output so or leave them out.");
  if (auto ok = checkRigFile(a.rigFile, a.output); !ok) return ok;
  if (!a.keys.empty() && a.keys != "exact" && a.keys != "few" && a.keys != "sampled")
    return fail(fmt::format("--keys is exact, few or sampled, not '{}'.", a.keys));
  const bool turns = a.head.on();
  if (!a.head.pivot.empty() && !turns)
    return fail("The model turns about --pivot with --head on only; leave --pivot out.");
  if (isOfKind(a.output, ".csv") && (!a.regions.empty() || a.following.any() || turns || a.lod > 0))
    return fail(
        "A .csv holds weights and angles as they were set; leave --regions, --arcs, --eyes, "
        "--combine, --head and --lod out.");
  return {};
}

/// Checks the options that depend on the performance.
Result<void> checkKeys(const AnimateArguments& a, const Performance& performance) {
  if (a.keys == "exact" && !performance.motion)
    return fail(fmt::format("Keys cannot hold {} exactly{}; leave --keys out.", performance.called,
                            timeLawFromName(a.what.law) && a.what.clip.empty()
                                ? " where other options change it"
                                : ""));
  if (a.namesFrames() && (a.keys == "exact" || a.keys == "few"))
    return fail(
        fmt::format("Keys that are {} have no frames; leave --frames and --fps out.", a.keys));
  const std::string keys = keysOf(a, performance);
  if (a.keyTolerance > 0 && keys != "few")
    return fail(fmt::format("Keys that are {} have no tolerance; leave --key-tolerance out, or {}.",
                            keys, a.namesFrames() ? "--frames and --fps" : "give --keys few"));
  return {};
}

Result<int> runAnimate(const AnimateArguments& a) {
  const bool glb = isOfKind(a.output, ".glb"), csv = isOfKind(a.output, ".csv");
  const bool isFile = glb || csv || isUsd(a.output);
  if (!isFile && !meansFolder(utf8Path(a.output)))
    return fail(
        fmt::format("Cannot write {}: its name must end in .glb, .usda, .usdz or .csv, or be a "
                    "folder's, without an ending or with a / behind it.",
                    a.output));
  if (auto ok = checkArguments(a, glb); !ok) return std::unexpected(ok.error());
  Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  const Result<Performance> performance = perform(a.what, a.regions, a.following, *rig);
  if (!performance) return std::unexpected(performance.error());
  if (glb)
    if (auto ok = checkKeys(a, *performance); !ok) return std::unexpected(ok.error());
  if (csv && performance->isDivided)  // by a timeline's own regions
    return fail(fmt::format("{} has regions, which a .csv cannot tell apart; leave them out there.",
                            a.what.clip));
  if (isFile)
    if (auto ok = checkOutput(a.output, {a.face, a.what.clip, a.what.clipNames, a.regions},
                              {".glb", ".usda", ".usd", ".usdz", ".csv"}, !a.quiet);
        !ok)
      return std::unexpected(ok.error());
  const Result<void> written = (glb      ? animateGlb
                                : csv    ? animateCsv
                                : isFile ? animateUsd
                                         : animateMeshes)(a, *rig, *performance);
  if (!written) return endWith(written.error());
  for (const std::string& note : performance->notes) printWarning(note);
  if (performance->turnsHead && !a.head.on() && !csv)
    printWarning(
        fmt::format("{}: its angles of the head are left out; --head on turns the model "
                    "by them.",
                    a.what.clip));
  return 0;
}

}  // namespace

Command addAnimate(CLI::App& tool) {
  return makeCommand(tool, "animate",
                     "Move between expressions, or play a clip: every frame as a mesh, an "
                     "animation (.glb, .usda) or a recording (.csv)",
                     runAnimate);
}

}  // namespace sweepface::cli
