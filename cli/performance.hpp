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

/// What `animate` is told to play.
struct PerformanceArguments {
  std::string from, law = "newton", clip, animation;
  std::optional<std::string> to;
  double seconds = 1, frequency = 2, damping = 1, restitution = 0.4;
  std::string clipNames;         ///< a file that says which targets its names drive
  double clipRate = 0;           ///< frames a second of the clip's timecodes; 0: as they tell
  double clipFrom = 0;           ///< seconds of the clip that are left out before
  std::optional<double> clipTo;  ///< seconds of the clip after which it ends
  bool smooth = false;
  bool tellsSpring = false;  ///< its frequency or damping
  bool tellsRate = false;    ///< of the clip, not of a recording that is written

  /// Of the timecodes that are written.
  double writtenRate() const { return clipRate > 0 ? clipRate : 60; }
};
void addPerformance(CLI::App& app, PerformanceArguments& a);

/// Weights of a rig's targets over time.
struct Performance {
  std::string name;
  std::string called;  ///< in messages: the law, or the clip's file
  double seconds = 0;
  std::function<void(double time, std::span<double> weights)> at;
  /// The same with velocities and accelerations, per second: exact for laws, of a clip by
  /// differences.
  std::function<void(double time, std::span<Kinematics> weights)> kinematicsAt;
  std::optional<Motion> motion;    ///< where keys can hold it exactly
  std::vector<double> frameTimes;  ///< a clip's own frames, from 0
  double frameMiss = 0;            ///< what straight lines between them miss of what is meant
  /// Null unless a clip tells how head or eyes stand.
  std::function<HeadPose(double time)> pose;
  bool hasHead = false, turnsHead = false, hasEyes = false;  ///< as ClipAngles has them
  bool isDivided = false;          ///< into regions, some of whose targets are parts
  std::vector<Index> wholes;       ///< of what each is a part then, as RegionalTargets has it
  std::vector<std::string> notes;  ///< what the user should know, in sentences
};
/// One for every region [R], by its matter and by what a timeline means for it; `clip` is what the
/// file of --clip holds. Fails where a timeline speaks of regions that there are not.
Result<std::vector<Performance>> makePerformances(const PerformanceArguments& a,
                                                  const std::string& clip, const Rig& rig,
                                                  std::span<const Region> regions);

/// Sentences on what does not move: all of it where both expressions are the same, and targets that
/// change their weight and yet move nothing.
std::vector<std::string> notesOnStill(const PerformanceArguments& a, const Rig& rig);

/// Velocities and accelerations by differences over a frame at 60 frames a second, of what plays
/// for so many seconds.
std::function<void(double, std::span<Kinematics>)> byDifferences(
    const std::function<void(double, std::span<double>)>& at, double seconds);

/// The performance at these times, with a weight for every target.
Clip sample(const Performance& performance, const Rig& rig, std::vector<double> times);

/// Columns of the angles, as captures have them.
void addAngles(Clip& clip, const std::function<HeadPose(double time)>& pose);

}  // namespace sweepface::cli
