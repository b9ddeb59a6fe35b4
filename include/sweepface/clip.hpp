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
  std::vector<std::string> warnings{};  ///< what was mended or may be wrong in the file, sentences
  std::string title{};                  ///< of the animation in its file, or empty

  double seconds() const { return times.empty() ? 0 : times.back() - times.front(); }
  /// The weights at `seconds` after the first frame, straight between frames and held at the ends:
  /// writes min(N, out.size()) values, 0 where there are no frames.
  void at(double seconds, std::span<double> out) const noexcept;

  /// Between which frames a time lies, and how far from the earlier to the later.
  struct Moment {
    std::size_t earlier = 0, later = 0;
    double share = 1;
  };
  Moment momentAt(double seconds) const noexcept;
  /// The weight of a name then.
  double weight(const Moment& moment, std::size_t name) const noexcept;
  /// Whether the weight of a name is ever anything but 0.
  bool moves(std::size_t name) const noexcept;
};

/// Whether a time can be that of a frame: within 300 years, so that seconds stay exact to
/// microseconds.
inline bool isPlausibleTime(double seconds) { return std::abs(seconds) <= 1e10; }

/// Hours of every shape of a face, and few enough for the memory of any machine. A few bytes can
/// ask for more: frames of a curve or of a timeline, or names that every frame has others of.
inline constexpr std::size_t kMostClipWeights = std::size_t{1} << 26;

/// Which target each name of a clip drives. Names match if they are equal but for case, '_', '-',
/// '.', ' ' and whether a side is spelt out (eyeBlinkLeft, EyeBlink_L). A name without a side
/// drives both sides where there is no target of its own (browInnerUp: browInnerUp_L and
/// browInnerUp_R), but for jaw and mouth, whose left and right are ways to go.
struct ClipMatch {
  std::vector<std::vector<Index>> targets;  ///< [N] the targets each name drives
  std::vector<std::string> unmatched;       ///< names of the clip that drive nothing
  std::vector<std::string> undriven;        ///< targets that nothing drives

  /// The clip's weights at `seconds` as weights of the targets; those that nothing drives stay 0.
  /// Where two names drive one target, the larger weight counts.
  void spread(const Clip& clip, double seconds, std::span<double> to) const noexcept;
};
ClipMatch matchClip(const Clip& clip, std::span<const std::string> targets);

// ---- Of the library that converts ----

/// Which targets the names of a clip drive where they are called otherwise, and how much.
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

/// A clip whose names are those of the targets that a map says, each with the sum of what drives
/// it; names that are not in the map stay. Refuses targets that there are not, and weights beyond
/// ±1,000,000.
Result<Clip> renamed(Clip clip, const NameMap& map, std::span<const std::string> targets);

/// Sentences about what may surprise where a clip, called `name`, drives `targets`: names that
/// drive one target together, and frames that miss more than a timeline promises (`missed`, as of
/// RegionalClips).
std::vector<std::string> notesOnClip(const Clip& clip, const ClipMatch& match, double missed,
                                     std::span<const std::string> targets, std::string_view name);

/// A capture of the Live Link Face app: a CSV with a timecode, a count and a column a shape, found
/// by their headings. `framesPerSecond` is what its timecodes count in, at 29.97 as at 30; 0: 60,
/// or 24, 25, 30, 48 or 50 where the frames of whole seconds say so. Of rows at the same time the
/// last one counts.
Result<Clip> parseLiveLinkCsv(std::string_view text, std::string_view name,
                              double framesPerSecond = 0);

/// The same from a clip: first the 52 shapes of ARKit and nine angles, as the app has them, then
/// whatever else the clip names. Shapes go by matchClip(), what drives none is 0. Refuses times
/// that are not from 0 up to a day, or nearer to each other than a timecode tells apart, and
/// weights beyond ±1,000,000.
Result<std::string> formatLiveLinkCsv(const Clip& clip, double framesPerSecond = 60);

/// A JSON of Audio2Face (`exportFps`, `facsNames`, `weightMat`) or of MediaPipe's face landmarker
/// (frames with a timestamp in milliseconds and `categories` of names and scores). Frames without
/// times are MediaPipe's own results; then `framesPerSecond` tells when they were. Where no face
/// was found weights go straight from the frame before to the one after.
Result<Clip> parseClipJson(std::string_view text, std::string_view name,
                           double framesPerSecond = 0);

}  // namespace sweepface
