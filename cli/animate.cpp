#include <atomic>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <tbb/parallel_for.h>

#include "sweepface/io.hpp"
#include "sweepface/motion.hpp"

#include "command.hpp"
#include "lod_mesh.hpp"
#include "output.hpp"

namespace sweepface::cli {
namespace {

namespace fs = std::filesystem;

struct AnimateArguments {
  std::string face, output, from, to, law = "newton";
  double seconds = 1;
  int frames = 31, lod = 0;
  bool quiet = false;
};

void addOptions(CLI::App& app, AnimateArguments& a) {
  addFace(app, a.face);
  addOutput(app, a.output,
            "The folder for frame_0000.obj, frame_0001.obj ...; made if it is not there");
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
                 "How many meshes, the first and the last expression included")
      ->check(wholeNumber(2, 100'000))
      ->capture_default_str()
      ->type_name("N");
  addLod(app, a.lod, "Write finer meshes: every edge of the source cut into N, 1 to 64");
  addQuiet(app, a.quiet);
  app.footer(
      "\nExample:\n"
      "  sweepface animate face.sweep --to jawOpen=1 --law accelerate-brake -o frames/");
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
  motion.at(motion.seconds() * (static_cast<double>(frame) / (a.frames - 1)), weights);
  return writeFile(fs::path(a.output) / fmt::format("frame_{:04}.obj", frame), meshes.obj(weights));
}

/// Writes the frames in parallel; the answer is that of the first one that failed.
Result<void> writeFrames(const AnimateArguments& a, const MeshMaker& meshes, const Motion& motion) {
  ProgressBar bar(a.quiet);
  std::atomic<int> done = 0;
  std::atomic<bool> failed = false;
  std::mutex reporting;
  Result<void> result;
  tbb::parallel_for(0, a.frames, [&](int frame) {
    if (failed) return;
    const Result<void> written = writeFrame(a, meshes, motion, frame);
    bar.show("writing", static_cast<double>(++done) / a.frames);
    if (written) return;
    const std::scoped_lock lock(reporting);
    if (!failed.exchange(true)) result = written;
  });
  return result;
}

Result<int> runAnimate(const AnimateArguments& a) {
  const Result<Rig> rig = readFace(a.face);
  if (!rig) return std::unexpected(rig.error());
  const Result<Motion> motion = makeMotion(a, *rig);
  if (!motion) return std::unexpected(motion.error());
  if (auto made = makeFolder(a.output); !made) return std::unexpected(made.error());
  if (auto written = writeFrames(a, MeshMaker(*rig, a.lod), *motion); !written)
    return std::unexpected(written.error());
  if (!a.quiet)
    fmt::print("{}: {} frames of {} s, {}\n", a.output, a.frames, a.seconds, nameOf(motion->law()));
  return 0;
}

}  // namespace

Command addAnimate(CLI::App& tool) {
  return makeCommand(tool, "animate", "Move from one expression to another and write every frame",
                     runAnimate);
}

}  // namespace sweepface::cli
