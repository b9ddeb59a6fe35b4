#pragma once

#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sweepface/result.hpp"
#include "sweepface/vec.hpp"

namespace sweepface {

/// Weights over time, as a tracker or an animator gives them.
struct Clip {
  std::vector<std::string> names;       ///< [N] as they stand in the source
  std::vector<double> times;            ///< [F] seconds, increasing
  std::vector<double> weights;          ///< [F × N]
  std::vector<std::string> warnings{};  ///< what was repaired or may be wrong in the file,
                                        ///< sentences
  std::string title{};                  ///< of the animation in its file, or empty

  double seconds() const { return times.empty() ? 0 : times.back() - times.front(); }
  /// The weights at `seconds` after the first frame, linear between frames and held at the ends.
  /// Writes min(N, out.size()) values, 0 if there are no frames.
  void at(double seconds, std::span<double> out) const noexcept;

  /// Between which frames a time lies, and how far from the earlier to the later.
  struct Moment {
    std::size_t earlier = 0, later = 0;
    double share = 1;
  };
  Moment momentAt(double seconds) const noexcept;
  /// The weight of a name at that moment.
  double weight(const Moment& moment, std::size_t name) const noexcept;
  /// Whether the weight of a name is ever anything but 0.
  bool moves(std::size_t name) const noexcept;
};

/// Whether a time can be that of a frame: within 300 years, so that seconds stay exact to
/// microseconds.
inline bool isPlausibleTime(double seconds) { return std::abs(seconds) <= 1e10; }

/// The most weights of a clip: hours of every shape of a face, and few enough for the memory of any
/// machine. A few bytes can ask for more: by the frames of a curve or a timeline, or by different
/// names in every frame.
inline constexpr std::size_t kMostClipWeights = std::size_t{1} << 26;

/// Which target each name of a clip drives. Names match if they are equal except for case, '_',
/// '-', '.', ' ' and whether a side is spelt out (eyeBlinkLeft, EyeBlink_L). A name without a side
/// drives both sides if it has no target of its own (browInnerUp: browInnerUp_L and browInnerUp_R),
/// except for jaw and mouth, whose left and right are directions.
struct ClipMatch {
  std::vector<std::vector<Index>> targets;  ///< [N] the targets each name drives
  std::vector<std::string> unmatched;       ///< names of the clip that drive nothing
  std::vector<std::string> undriven;        ///< targets that nothing drives

  /// The clip's weights at `seconds` as weights of the targets; those that nothing drives are 0. If
  /// two names drive one target, the larger weight counts.
  void spread(const Clip& clip, double seconds, std::span<double> to) const noexcept;
};
ClipMatch matchClip(const Clip& clip, std::span<const std::string> targets);

// ---- Of the library that converts ----

/// Which targets names of a clip drive if the targets are called otherwise, and how much.
struct NameMap {
  struct Drive {
    std::string target;
    double factor = 1;
  };
  std::string called;                                              ///< in messages
  std::vector<std::pair<std::string, std::vector<Drive>>> drives;  ///< by names of the clip
};
/// A JSON object (docs/clips.md): {"jawOpen": "mouth-open", "cheekPuff": {"puff": 0.8}}.
Result<NameMap> parseNameMap(std::string_view text, std::string_view name);

/// The clip with the names of the targets in a map, each with the sum of what drives it; names that
/// are not in the map stay. Refuses targets that do not exist, factors beyond ±1000 and weights
/// beyond ±1,000,000.
Result<Clip> renamed(Clip clip, const NameMap& map, std::span<const std::string> targets);

/// Names of a clip that are ever other than 0 and drive nothing, without the angles of Live Link
/// Face (head.hpp). Recordings have columns for all shapes of the app, whatever the face has.
std::vector<std::string> idleNames(const Clip& clip, const ClipMatch& match);

/// Sentences about what may surprise when a clip, called `name`, drives `targets`: names that drive
/// one target together, and frames that miss more than a timeline promises (`missed`, as in
/// RegionalClips).
std::vector<std::string> notesOnClip(const Clip& clip, const ClipMatch& match, double missed,
                                     std::span<const std::string> targets, std::string_view name);

/// Reads a capture of the Live Link Face app: a CSV with a timecode, a count and a column for each
/// shape, found by their headings. `framesPerSecond` is the rate of its timecodes, which at 29.97
/// count frames as at 30; 0: 24, 25, 30, 48 or 50 if the frames of whole seconds say so, otherwise
/// 60. Of rows at the same time the last one counts.
Result<Clip> parseLiveLinkCsv(std::string_view text, std::string_view name,
                              double framesPerSecond = 0);

/// Writes such a capture from a clip: first the 52 shapes of ARKit and nine angles, as the app has
/// them, then whatever else the clip names. Shapes are matched by matchClip(); those that nothing
/// drives are 0. Refuses times outside 0 to a day or closer together than timecodes can tell apart,
/// and weights beyond ±1,000,000.
Result<std::string> formatLiveLinkCsv(const Clip& clip, double framesPerSecond = 60);

/// Reads a JSON of Audio2Face (`exportFps`, `facsNames`, `weightMat`) or of MediaPipe's face
/// landmarker (frames with a timestamp in milliseconds and `categories` of names and scores).
/// Frames without times are MediaPipe's own results; `framesPerSecond` then gives their times.
/// Where no face was found, weights are linear from the frame before to the one after.
Result<Clip> parseClipJson(std::string_view text, std::string_view name,
                           double framesPerSecond = 0);

}  // namespace sweepface
