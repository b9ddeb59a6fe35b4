#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sweepface/clip.hpp"
#include "sweepface/regional_motion.hpp"

namespace sweepface {

/// Some weights set out for new goals at a given time.
struct TimelineEvent {
  double time = 0;                                    ///< seconds
  std::vector<std::pair<std::string, double>> goals;  ///< weights by name
  bool others = false;                                ///< all other weights go to 0
  std::string region;                                 ///< only there; empty: everywhere
  Drive drive;
};

/// What an animator writes down: events in the order of their times, from 0 to `seconds`.
struct Timeline {
  double seconds = 0;  ///< how long it lasts
  int loops = 1;       ///< how often it is played, each time from where the last one left off
  std::vector<TimelineEvent> events;
};

/// Whether a JSON text is a timeline rather than a capture: an object that has "events". Part of
/// the library that converts.
bool isTimeline(std::string_view text);

/// A timeline from its JSON form (docs/clips.md). Part of the same library.
Result<Timeline> parseTimeline(std::string_view text, std::string_view name);

/// Fails if an event is for a region that is not among these.
Result<void> checkRegions(const Timeline& timeline, std::span<const std::string> regions);

/// The timeline as a clip of `framesPerSecond`, from rest at 0: both ends included. Refuses events
/// out of order, matters that check() refuses and more than kMostClipWeights weights, in its frames
/// or sent off by all its events.
Result<Clip> bake(const Timeline& timeline, double framesPerSecond);
/// The same in one region: without events for other regions, and by its own matter.
Result<Clip> bake(const Timeline& timeline, double framesPerSecond, std::string_view region,
                  const Matter& matter);

/// The time at which a region is done: the end plus its delay, or later, when its drives have
/// arrived that elsewhere arrive by the end. What swings or bounces ends with the timeline.
double endIn(const Timeline& timeline, std::string_view region, const Matter& matter);

struct Baked {
  Clip clip;
  double missed = 0;  ///< the most that straight lines between frames miss a weight by, except at
                      ///< jumps
};
/// The same for playing: 240 frames a second, and more where something swings or bounces quickly,
/// so that straight lines between them are within 1e-4 of what is meant. Added frames hold four
/// million weights at most and keep `regions` such clips within kMostClipWeights; none are added if
/// more than a million events set out. A jump takes a 1024th of a frame. The clip goes on until
/// `end`, if that is later than its own: regions that are played together end together.
Result<Baked> bakeToPlay(const Timeline& timeline, std::string_view region, const Matter& matter,
                         std::size_t regions = 1, double end = 0);

}  // namespace sweepface
