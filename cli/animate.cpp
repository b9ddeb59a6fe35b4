#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <tbb/parallel_for.h>

#include "sweepface/gltf.hpp"
#include "sweepface/io.hpp"

#include "command.hpp"
#include "lod_mesh.hpp"
#include "output.hpp"
#include "regions.hpp"

namespace sweepface::cli {
namespace {

namespace fs = std::filesystem;

struct AnimateArguments {
  std::string face, output, keys;
  PerformanceArguments what;
  RegionArguments regions;
  FollowingArguments following;
  double framesPerSecond = 0;
  int frames = 0, lod = 0;
  bool quiet = false;
  GlbArguments glb;
};

void addOptions(CLI::App& app, AnimateArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output,
            "A folder for frame_0000.obj, frame_0001.obj ..., made if it is not there; or a .glb "
            "file for the face with an animation of its targets");
  addPerformance(app, a.what);
  addRegions(app, a.regions);
  addFollowing(app, a.following);
  app.add_option("--frames", a.frames,
                 "How many meshes or sampled keys, the first and the last included; 31 if neither "
                 "this nor --fps is given")
      ->check(wholeNumber(2, 100'000))
      ->type_name("N");
  app.add_option("--fps", a.framesPerSecond, "Meshes or sampled keys a second, instead of --frames")
      ->check(positiveNumber(1000))
      ->excludes("--frames")
      ->type_name("N");
  app.add_option("--keys", a.keys,
                 "For .glb: exact (two or three keys with tangents hold the law exactly; the "
                 "default where the law can be held so) or sampled (keys without, for programs "
                 "that ignore tangents)")
      ->type_name("KIND");
  addLod(app, a.lod, "Write finer meshes: every edge of the source cut into N, 1 to 64");
  addGlb(app, a.glb);
  addQuiet(app, a.quiet);
  app.footer(
      "\nExamples:\n"
      "  sweepface animate face.sweep --to jawOpen=1 --law accelerate-brake -o frames/\n"
      "  sweepface animate face.sweep --to jawOpen=1 --law newton -o jaw.glb\n"
      "  sweepface animate face.sweep --clip take.csv --smooth -o take.glb");
}

/// When there is a mesh or a key.
std::vector<double> sampleTimes(const AnimateArguments& a, const Performance& performance) {
  double rate = a.framesPerSecond;
  if (rate == 0 && a.frames == 0 && !a.what.clip.empty()) rate = 30;
  const int last = rate > 0 ? std::max(1, static_cast<int>(std::floor(
                                              std::min(performance.seconds * rate, 1e6) + 1e-6)))
                            : (a.frames > 0 ? a.frames : 31) - 1;
  std::vector<double> times;
  for (int k = 0; k <= last; ++k)
    times.push_back(rate > 0 ? k / rate : performance.seconds * (static_cast<double>(k) / last));
  return times;
}

// ---- Meshes ----

Result<void> makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (fs::is_directory(folder)) return {};
  return fail(fmt::format("Cannot make the folder {}: {}.", folder.string(),
                          error ? error.message() : "a file is in its place"));
}

/// Writes the frames in parallel; the answer is that of the first one that failed.
Result<void> writeFrames(const AnimateArguments& a, const Rig& rig, const Performance& performance,
                         const std::vector<double>& times) {
  const MeshMaker meshes(rig, a.lod);
  ProgressBar bar(a.quiet);
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> failed = false;
  std::mutex reporting;
  Result<void> result;
  tbb::parallel_for(std::size_t{0}, times.size(), [&](std::size_t frame) {
    if (failed) return;
    Weights weights(rig.targets.size());
    performance.at(times[frame], weights);
    const Result<void> written =
        writeFile(fs::path(a.output) / fmt::format("frame_{:04}.obj", frame), meshes.obj(weights));
    bar.show("writing", static_cast<double>(++done) / static_cast<double>(times.size()));
    if (written) return;
    const std::scoped_lock lock(reporting);
    if (!failed.exchange(true)) result = written;
  });
  return result;
}

Result<void> animateMeshes(const AnimateArguments& a, const Rig& rig,
                           const Performance& performance) {
  if (auto ok = checkLod(rig, a.lod); !ok) return ok;
  const std::vector<double> times = sampleTimes(a, performance);
  if (auto made = makeFolder(a.output); !made) return made;
  if (auto written = writeFrames(a, rig, performance, times); !written) return written;
  if (!a.quiet)
    fmt::print("{}: {} frames of {:.6g} s, {}\n", a.output, times.size(), performance.seconds,
               performance.name);
  return {};
}

// ---- GLB ----

Result<void> animateGlb(const AnimateArguments& a, const Rig& rig, const Performance& performance) {
  if (auto ok = checkOutput(a.output, {a.face}, {}); !ok) return ok;
  GlbOptions options;
  options.lod = a.lod;
  options.morphNormals = a.glb.morphNormals;
  options.quantize = a.glb.quantize;
  options.animationName = performance.name;
  Clip clip;
  if (performance.motion && a.keys != "sampled") {
    options.motion = &*performance.motion;
  } else {
    const bool asRecorded =
        !performance.frameTimes.empty() && a.frames == 0 && a.framesPerSecond == 0;
    clip =
        sample(performance, rig, asRecorded ? performance.frameTimes : sampleTimes(a, performance));
    options.clip = &clip;
  }
  const Result<std::string> bytes = formatGlb(rig, options);
  if (!bytes) return std::unexpected(bytes.error());
  if (auto written = writeFile(a.output, *bytes); !written) return written;
  if (!a.quiet)
    fmt::print("{}: {:.6g} s, {}, {} bytes\n", a.output, performance.seconds, performance.name,
               bytes->size());
  return {};
}

// ---- The command ----

/// Options that do not go with each other.
Result<void> checkArguments(const AnimateArguments& a, bool glb) {
  if (!a.what.to && a.what.clip.empty())
    return fail("Say where to go with --to, or what to play with --clip.");
  if (!glb && (a.glb.any() || !a.keys.empty()))
    return fail(
        "--keys, --morph-normals and --quantize are for .glb files; name the output so or leave "
        "them out.");
  if (!a.keys.empty() && a.keys != "exact" && a.keys != "sampled")
    return fail(fmt::format("--keys is exact or sampled, not '{}'.", a.keys));
  return {};
}

/// What only a performance can tell of its options.
Result<void> checkKeys(const AnimateArguments& a, const Performance& performance) {
  if (a.keys == "exact" && !performance.motion)
    return fail(fmt::format("Keys cannot hold {} exactly; leave --keys out.", performance.name));
  if (performance.motion && a.keys != "sampled" && (a.frames > 0 || a.framesPerSecond > 0))
    return fail("A .glb file has no frames; leave --frames and --fps out or add --keys sampled.");
  return {};
}

Result<int> runAnimate(const AnimateArguments& a) {
  const bool glb = isOfKind(a.output, ".glb");
  if (isOfKind(a.output, ".gltf"))
    return fail(
        fmt::format("Cannot write {}: its name promises another kind of file (.gltf).", a.output));
  if (auto ok = checkArguments(a, glb); !ok) return std::unexpected(ok.error());
  Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  const Result<Performance> performance = perform(a.what, a.regions, a.following, *rig);
  if (!performance) return std::unexpected(performance.error());
  if (glb)
    if (auto ok = checkKeys(a, *performance); !ok) return std::unexpected(ok.error());
  const Result<void> written = (glb ? animateGlb : animateMeshes)(a, *rig, *performance);
  if (!written) return std::unexpected(written.error());
  if (!a.quiet)
    for (const std::string& note : performance->notes) printWarning(note);
  return 0;
}

}  // namespace

Command addAnimate(CLI::App& tool) {
  return makeCommand(tool, "animate",
                     "Move between expressions, or play a clip: every frame as a mesh, or an "
                     "animation (.glb)",
                     runAnimate);
}

}  // namespace sweepface::cli
