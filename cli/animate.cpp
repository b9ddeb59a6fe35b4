#include <atomic>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <tbb/parallel_for.h>

#include "sweepface/gltf.hpp"
#include "sweepface/io.hpp"
#include "sweepface/motion.hpp"

#include "command.hpp"
#include "lod_mesh.hpp"
#include "output.hpp"

namespace sweepface::cli {
namespace {

namespace fs = std::filesystem;

struct AnimateArguments {
  std::string face, output, from, to, law = "newton", keys;
  double seconds = 1;
  int frames = 0, lod = 0;
  bool quiet = false;
  GlbArguments glb;

  int frameCount() const { return frames > 0 ? frames : 31; }
};

void addOptions(CLI::App& app, AnimateArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output,
            "A folder for frame_0000.obj, frame_0001.obj ..., made if it is not there; or a .glb "
            "file for the face with an animation of its targets");
  app.add_option("--from", a.from, "The expression to start from; the neutral if not given")
      ->type_name("NAME=W,...");
  app.add_option("--to", a.to, "The expression to end with, e.g. jawOpen=1,mouthSmile=0.5")
      ->required()
      ->type_name("NAME=W,...");
  app.add_option("--law", a.law,
                 "How it moves: newton (a constant force from rest), brake (a constant force to "
                 "rest), accelerate-brake (from rest to rest) or linear (constant speed)")
      ->capture_default_str()
      ->type_name("LAW");
  app.add_option("--seconds", a.seconds, "How long it takes")
      ->check(positiveNumber())
      ->capture_default_str()
      ->type_name("S");
  app.add_option("--frames", a.frames,
                 "How many meshes or sampled keys, the first and the last expression included; 31 "
                 "if not given")
      ->check(wholeNumber(2, 100'000))
      ->type_name("N");
  app.add_option("--keys", a.keys,
                 "For .glb: exact (the default: two or three keys with tangents hold the law "
                 "exactly) or sampled (--frames keys without, for programs that ignore tangents)")
      ->type_name("KIND");
  addLod(app, a.lod, "Write finer meshes: every edge of the source cut into N, 1 to 64");
  addGlb(app, a.glb);
  addQuiet(app, a.quiet);
  app.footer(
      "\nExamples:\n"
      "  sweepface animate face.sweep --to jawOpen=1 --law accelerate-brake -o frames/\n"
      "  sweepface animate face.sweep --to jawOpen=1 --law newton -o jaw.glb");
}

Result<Motion> makeMotion(const AnimateArguments& a, const Rig& rig) {
  const Result<Weights> from = parseWeights(rig, a.from), to = parseWeights(rig, a.to);
  if (!from) return std::unexpected(from.error());
  if (!to) return std::unexpected(to.error());
  const Result<TimeLaw> law = timeLawFromName(a.law);
  if (!law) return std::unexpected(law.error());
  return Motion::make(*from, *to, *law, a.seconds);
}

Result<void> makeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (fs::is_directory(folder)) return {};
  return fail(fmt::format("Cannot make the folder {}: {}.", folder.string(),
                          error ? error.message() : "a file is in its place"));
}

Result<void> writeFrame(const AnimateArguments& a, const MeshMaker& meshes, const Motion& motion,
                        int frame) {
  Weights weights(motion.size());
  motion.at(motion.seconds() * (static_cast<double>(frame) / (a.frameCount() - 1)), weights);
  return writeFile(fs::path(a.output) / fmt::format("frame_{:04}.obj", frame), meshes.obj(weights));
}

/// Writes the frames in parallel; the answer is that of the first one that failed.
Result<void> writeFrames(const AnimateArguments& a, const MeshMaker& meshes, const Motion& motion) {
  ProgressBar bar(a.quiet);
  std::atomic<int> done = 0;
  std::atomic<bool> failed = false;
  std::mutex reporting;
  Result<void> result;
  tbb::parallel_for(0, a.frameCount(), [&](int frame) {
    if (failed) return;
    const Result<void> written = writeFrame(a, meshes, motion, frame);
    bar.show("writing", static_cast<double>(++done) / a.frameCount());
    if (written) return;
    const std::scoped_lock lock(reporting);
    if (!failed.exchange(true)) result = written;
  });
  return result;
}

Result<void> animateMeshes(const AnimateArguments& a, const Rig& rig, const Motion& motion) {
  if (auto ok = checkLod(rig, a.lod); !ok) return ok;
  if (auto made = makeFolder(a.output); !made) return made;
  if (auto written = writeFrames(a, MeshMaker(rig, a.lod), motion); !written) return written;
  if (!a.quiet)
    fmt::print("{}: {} frames of {} s, {}\n", a.output, a.frameCount(), a.seconds,
               nameOf(motion.law()));
  return {};
}

Result<void> animateGlb(const AnimateArguments& a, const Rig& rig, const Motion& motion) {
  if (auto ok = checkOutput(a.output, {a.face}, {}); !ok) return ok;
  GlbOptions options;
  options.lod = a.lod;
  options.morphNormals = a.glb.morphNormals;
  options.quantize = a.glb.quantize;
  options.motion = &motion;
  options.sampledKeys = a.keys == "sampled" ? a.frameCount() : 0;
  const Result<std::string> bytes = formatGlb(rig, options);
  if (!bytes) return std::unexpected(bytes.error());
  if (auto written = writeFile(a.output, *bytes); !written) return written;
  if (!a.quiet)
    fmt::print("{}: {} s, {}, {} bytes\n", a.output, a.seconds, nameOf(motion.law()),
               bytes->size());
  return {};
}

/// Options that do not go with each other.
Result<void> checkArguments(const AnimateArguments& a, bool glb) {
  if (!glb && (a.glb.any() || !a.keys.empty()))
    return fail(
        "--keys, --morph-normals and --quantize are for .glb files; name the output so or leave "
        "them out.");
  if (!a.keys.empty() && a.keys != "exact" && a.keys != "sampled")
    return fail(fmt::format("--keys is exact or sampled, not '{}'.", a.keys));
  if (glb && a.frames > 0 && a.keys != "sampled")
    return fail("A .glb file has no frames; leave --frames out or add --keys sampled.");
  return {};
}

Result<int> runAnimate(const AnimateArguments& a) {
  const bool glb = isOfKind(a.output, ".glb");
  if (isOfKind(a.output, ".gltf"))
    return fail(
        fmt::format("Cannot write {}: its name promises another kind of file (.gltf).", a.output));
  if (auto ok = checkArguments(a, glb); !ok) return std::unexpected(ok.error());
  const Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  const Result<Motion> motion = makeMotion(a, *rig);
  if (!motion) return std::unexpected(motion.error());
  const Result<void> written = (glb ? animateGlb : animateMeshes)(a, *rig, *motion);
  if (!written) return std::unexpected(written.error());
  return 0;
}

}  // namespace

Command addAnimate(CLI::App& tool) {
  return makeCommand(
      tool, "animate",
      "Move from one expression to another and write every frame, or an animation (.glb)",
      runAnimate);
}

}  // namespace sweepface::cli
