#include "performance.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "sweepface/io.hpp"
#include "sweepface/regional_motion.hpp"

#include "played_clip.hpp"

namespace sweepface::cli {
namespace {

// ---- From one expression to another ----

/// How long a bouncing motion lasts, in units of its fall: bounce n lasts 2 eⁿ falls.
double bounceLength(double restitution) { return (1 + restitution) / (1 - restitution); }

/// How long a drive is shown: a spring, which never ends, for as long as asked.
double lengthOf(const Drive& drive, double asked) {
  if (drive.kind == Drive::Kind::spring) return asked;
  return drive.seconds * (drive.kind == Drive::Kind::bounce ? bounceLength(drive.restitution) : 1);
}

Drive driveOf(const PerformanceArguments& a, Drive drive) {
  const bool bounces = drive.kind == Drive::Kind::bounce;
  drive.seconds = bounces ? a.seconds / bounceLength(a.restitution) : a.seconds;
  drive.spring = {a.frequency, a.damping};
  drive.restitution = a.restitution;
  return drive;
}

/// A performance by a law that two or three keys cannot hold exactly: a trajectory per weight.
Result<Performance> driven(const PerformanceArguments& a, const Drive& drive, double delay,
                           const Weights& from, const Weights& to) {
  const auto paths = std::make_shared<std::vector<Trajectory>>();
  for (std::size_t k = 0; k < from.size(); ++k) {
    const auto path = trajectoryOf(drive, {from[k], 0}, to[k]);
    if (!path) return std::unexpected(path.error());
    paths->push_back(*path);
  }
  Performance performance;
  performance.name = performance.called = a.law;
  performance.seconds = delay + lengthOf(drive, a.seconds);
  performance.at = [paths, delay](double time, std::span<double> weights) {
    for (std::size_t k = 0; k < weights.size(); ++k)
      weights[k] = (*paths)[k].at(time - delay).position;
  };
  performance.kinematicsAt = [paths, delay](double time, std::span<Kinematics> weights) {
    for (std::size_t k = 0; k < weights.size(); ++k) weights[k] = (*paths)[k].at(time - delay);
  };
  return performance;
}

Result<Performance> between(const PerformanceArguments& a, const Weights& from, const Weights& to,
                            const Matter& matter) {
  if (const auto drive = driveFromName(a.law);
      drive && drive->kind != Drive::Kind::cut && !timeLawFromName(a.law))
    return driven(a, inMatter(driveOf(a, *drive), matter), matter.delay, from, to);
  const Result<TimeLaw> law = timeLawFromName(a.law);
  if (!law)
    return fail(
        fmt::format("There is no law '{}'; there are linear, newton, brake, "
                    "accelerate-brake, linear-force, spring and bounce.",
                    a.law));
  const double seconds = inMatter({.seconds = a.seconds, .spring = {}}, matter).seconds;
  auto motion = Motion::make(from, to, *law, seconds);
  if (!motion)
    return fail(
        fmt::format("In {:.4g} s it moves too fast for its speed and force to be numbers; "
                    "give it more --seconds.",
                    seconds));
  Performance performance;
  performance.name = performance.called = a.law;
  performance.seconds = matter.delay + seconds;
  performance.at = [motion = *motion, delay = matter.delay](double time,
                                                            std::span<double> weights) {
    motion.at(time - delay, weights);
  };
  performance.kinematicsAt = [motion = *motion, delay = matter.delay](
                                 double time, std::span<Kinematics> weights) {
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const MotionSample sample = motion.sample(k, time - delay);
      weights[k] = {sample.position, sample.velocity, sample.force};
    }
  };
  if (matter.delay == 0) performance.motion = std::move(*motion);
  return performance;
}

Result<Performance> byLaw(const PerformanceArguments& a, const Rig& rig, const Matter& matter) {
  const Result<Weights> from = weightsGiven("--from", a.from, rig),
                        to = weightsGiven("--to", a.to.value_or(""), rig);
  if (!from) return std::unexpected(from.error());
  if (!to) return std::unexpected(to.error());
  return between(a, *from, *to, matter);
}

}  // namespace

std::vector<std::string> notesOnStill(const PerformanceArguments& a, const Rig& rig) {
  const Result<Weights> from = weightsGiven("--from", a.from, rig),
                        to = weightsGiven("--to", a.to.value_or(""), rig);
  const auto isStill = [](const std::vector<Vec3>& ways) {
    return std::ranges::all_of(ways, [](const Vec3& way) { return way == Vec3{}; });
  };
  std::vector<std::string> notes;
  if (from && to && *from == *to)
    notes.push_back("Nothing moves: --to is the expression that it starts from.");
  for (std::size_t k = 0; from && to && k < rig.targets.size(); ++k)
    if (const Target& target = rig.targets[k];
        (*from)[k] != (*to)[k] && isStill(target.difference) && isStill(target.looseDifference))
      notes.push_back(
          target.name +
          " moves nothing in this face: in its meshes it was the neutral, or within the "
          "tolerance of that.");
  return notes;
}

std::function<void(double, std::span<Kinematics>)> byDifferences(
    const std::function<void(double, std::span<double>)>& at, double seconds) {
  return [at, seconds](double time, std::span<Kinematics> weights) {
    constexpr double h = 1 / 60.0;
    // Differences stay within the motion, as it stands still before and after.
    const double middle = seconds > 2 * h ? std::clamp(time, h, seconds - h) : time;
    std::vector<double> before(weights.size()), now(before), after(before), here(before);
    at(middle - h, before);
    at(middle, now);
    at(middle + h, after);
    at(time, here);
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const double acceleration = (after[k] - 2 * now[k] + before[k]) / (h * h);
      weights[k] = {here[k], (after[k] - before[k]) / (2 * h) + acceleration * (time - middle),
                    acceleration};
    }
  };
}

namespace {

/// Refuses options that would change nothing.
void checkUse(const CLI::App& app, const PerformanceArguments& a) {
  const auto refuse = [&](const std::string& option, bool used, const std::string& why) {
    if (app.count(option) > 0 && !used) throw CLI::ValidationError(option, why);
  };
  const CLI::Option* laws = app.get_option_no_throw("--laws");
  const auto plays = [&](const std::string& law) {
    if (!laws || laws->count() == 0) return a.law == law;
    const std::vector<std::string> several = laws->results();
    return std::ranges::find(several, law) != several.end();
  };
  // In a clip, heavy regions hang on springs; a clip may bring regions of its own.
  const bool hangs =
      !a.clip.empty() && (app.get_option_no_throw("--regions") || isOfKind(a.clip, ".json"));
  for (const char* option : {"--frequency", "--damping"})
    refuse(option, plays("spring") || hangs, "Only spring swings; leave this out.");
  refuse("--restitution", plays("bounce"), "Only bounce comes back; leave this out.");
  refuse("--clip-fps",
         isOfKind(a.clip, ".csv") || isOfKind(a.clip, ".json") ||
             isOfKind(app["--output"]->as<std::string>(), ".csv"),
         "Only a .csv has timecodes, and a .json may lack times; leave this out.");
}

}  // namespace

void addPerformance(CLI::App& app, PerformanceArguments& a) {
  app.add_option("--from", a.from, "The expression to start from; the neutral if not given")
      ->type_name("NAME=W,...");
  app.add_option("--to", a.to, "The expression to end with, e.g. jawOpen=1,mouthSmile=0.5")
      ->type_name("NAME=W,...");
  app.add_option("--law", a.law,
                 "How it moves: newton (a constant force from rest), brake (a constant force to "
                 "rest), accelerate-brake or linear-force (from rest to rest), spring, bounce, or "
                 "linear (constant speed)")
      ->capture_default_str()
      ->type_name("LAW");
  app.add_option("--seconds", a.seconds,
                 "How long it takes; for a spring, how long it is shown; for a "
                 "bounce, until it rests")
      ->check(positiveNumber())
      ->capture_default_str()
      ->type_name("S");
  app.add_option("--frequency", a.frequency,
                 "For a spring: oscillations a second without damping; with --clip, for the "
                 "springs on which heavy regions hang")
      ->check(positiveNumber())
      ->capture_default_str()
      ->type_name("HZ");
  app.add_option("--damping", a.damping, "For a spring: below 1 it overshoots, above 1 it creeps")
      ->check(numberFromZero())
      ->capture_default_str()
      ->type_name("Z");
  app.add_option("--restitution", a.restitution,
                 "For a bounce: the share of the speed that is left")
      ->check(partOfOne())
      ->capture_default_str()
      ->type_name("E");
  app.add_option("--clip", a.clip,
                 "Play this instead: a .csv of Live Link Face, a .json of Audio2Face or MediaPipe, "
                 "a timeline (.json), or the weights of an animation in a .glb")
      ->excludes("--to")
      ->excludes("--from")
      ->excludes("--law")
      ->excludes("--seconds")
      ->excludes("--restitution")
      ->type_name("FILE");
  app.add_option("--animation", a.animation,
                 "Which animation of a .glb; the first with weights if not given")
      ->check(notEmpty())
      ->needs("--clip")
      ->type_name("NAME");
  app.add_option(
         "--clip-fps", a.clipRate,
         "Frames a second, of a .csv's timecodes (default: as these tell, or else 60) or of "
         "a MediaPipe .json without times")
      ->check(positiveNumber(1000))
      ->type_name("N");
  app.add_option("--clip-names", a.clipNames,
                 "A .json that says which targets the clip's names drive where they are called "
                 "otherwise: {\"jawOpen\": \"mouth-open\"}")
      ->check(notEmpty())
      ->needs("--clip")
      ->type_name("FILE");
  app.add_option("--clip-from", a.clipFrom, "Start S seconds into the clip")
      ->check(numberFromZero())
      ->needs("--clip")
      ->type_name("S");
  app.add_option("--clip-to", a.clipTo, "End S seconds into the clip")
      ->check(positiveNumber())
      ->needs("--clip")
      ->type_name("S");
  app.add_flag("--smooth", a.smooth, "Remove a tracker's noise from the clip")->needs("--clip");
  app.parse_complete_callback([&app, &a] {
    checkUse(app, a);
    a.tellsSpring = app.count("--frequency") + app.count("--damping") > 0;
    a.tellsRate =
        app.count("--clip-fps") > 0 && !isOfKind(app["--output"]->as<std::string>(), ".csv");
  });
}

Result<std::vector<Performance>> makePerformances(const PerformanceArguments& a,
                                                  const std::string& clip, const Rig& rig,
                                                  std::span<const Region> regions) {
  if (!a.clip.empty()) return byClip(a, clip, rig, regions);
  std::vector<Performance> performances;
  for (const Region& region : regions) {
    auto performance = byLaw(a, rig, region.matter);
    if (!performance) return std::unexpected(performance.error());
    performances.push_back(std::move(*performance));
  }
  return performances;
}

Clip sample(const Performance& performance, const Rig& rig, std::vector<double> times) {
  Clip clip;
  clip.names = rig.targetNames();
  clip.times = std::move(times);
  clip.weights.resize(clip.times.size() * clip.names.size());
  for (std::size_t f = 0; f < clip.times.size(); ++f)
    performance.at(clip.times[f],
                   std::span(clip.weights).subspan(f * clip.names.size(), clip.names.size()));
  return clip;
}

void addAngles(Clip& clip, const std::function<HeadPose(double time)>& pose) {
  const std::size_t before = clip.names.size();
  for (const char* part : {"Head", "LeftEye", "RightEye"})
    for (const char* angle : {"Yaw", "Pitch", "Roll"})
      clip.names.push_back(std::string(part) + angle);
  std::vector<double> weights;
  for (std::size_t f = 0; f < clip.times.size(); ++f) {
    const auto row = clip.weights.begin() + static_cast<std::ptrdiff_t>(f * before);
    weights.insert(weights.end(), row, row + static_cast<std::ptrdiff_t>(before));
    const HeadPose stands = pose(clip.times[f]);
    for (const Angles& angles : {stands.head, stands.leftEye, stands.rightEye}) {
      const Angles a = betweenHands(angles);
      weights.insert(weights.end(), {a.yaw, a.pitch, a.roll});
    }
  }
  clip.weights = std::move(weights);
}

}  // namespace sweepface::cli
