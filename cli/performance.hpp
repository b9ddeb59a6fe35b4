#pragma once

#include <functional>
#include <optional>

#include "sweepface/clip.hpp"
#include "sweepface/head.hpp"
#include "sweepface/motion.hpp"
#include "sweepface/regions.hpp"
#include "sweepface/trajectory.hpp"

#include "command.hpp"

namespace sweepface::cli {

/// What the options ask to play.
struct PerformanceArguments {
  std::string from, law = "newton", clip, animation;
  std::optional<std::string> to;
  double seconds = 1, frequency = 2, damping = 1, restitution = 0.4;
  std::string clipNames;         ///< a file that says which targets the clip's names drive
  double clipRate = 0;           ///< frames a second of the clip's timecodes; 0: as they say
  double clipFrom = 0;           ///< where in the clip to start, in seconds
  std::optional<double> clipTo;  ///< where in the clip to end, in seconds
  bool smooth = false;
  bool tellsSpring = false;  ///< whether its frequency or damping is given
  bool tellsRate = false;    ///< whether a rate is given for the clip to read

  /// The rate of the timecodes to write.
  double writtenRate() const { return clipRate > 0 ? clipRate : 60; }
};
void addPerformance(CLI::App& app, PerformanceArguments& a);

/// Weights of a rig's targets over time.
struct Performance {
  std::string name;
  std::string called;  ///< in messages: the law, or the clip's file
  double seconds = 0;
  std::function<void(double time, std::span<double> weights)> at;
  /// The same with velocities and accelerations, per second: exact for laws, by differences for
  /// clips.
  std::function<void(double time, std::span<Kinematics> weights)> kinematicsAt;
  std::optional<Motion> motion;    ///< set if keys can hold it exactly
  std::vector<double> frameTimes;  ///< a clip's own frames, from 0
  double frameMiss = 0;            ///< how far straight lines between them are off what is meant
  /// Null unless a clip has angles of the head or eyes.
  std::function<HeadPose(double time)> pose;
  bool hasHead = false, turnsHead = false, hasEyes = false;  ///< as ClipAngles has them
  bool isDivided = false;          ///< into regions; some targets are then parts of others
  std::vector<Index> wholes;       ///< the target each is then a part of, as in RegionalTargets
  std::vector<std::string> notes;  ///< what the user should know, in sentences
};
/// One for every region [R], according to its matter and to what a timeline says for it; `clip` is
/// the content of the --clip file. Fails if a timeline names regions that do not exist.
Result<std::vector<Performance>> makePerformances(const PerformanceArguments& a,
                                                  const std::string& clip, const Rig& rig,
                                                  std::span<const Region> regions);

/// Notes on what does not move: all of it if both expressions are the same, or targets whose weight
/// changes without moving anything.
std::vector<std::string> notesOnStill(const PerformanceArguments& a, const Rig& rig);

/// Velocities and accelerations, by differences over a frame at 60 frames a second, of a motion
/// that lasts `seconds`.
std::function<void(double, std::span<Kinematics>)> byDifferences(
    const std::function<void(double, std::span<double>)>& at, double seconds);

/// The performance at these times, with a weight for every target.
Clip sample(const Performance& performance, const Rig& rig, std::vector<double> times);

/// Adds columns for the angles, as captures have them.
void addAngles(Clip& clip, const std::function<HeadPose(double time)>& pose);

}  // namespace sweepface::cli
