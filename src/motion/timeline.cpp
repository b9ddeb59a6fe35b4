#include "sweepface/timeline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace sweepface {
namespace {

/// The positions of weights among the names of a clip.
using Places = std::map<std::string_view, std::size_t>;

Result<void> play(const TimelineEvent& event, const Places& places, const Matter& matter,
                  MotionState& state) {
  const Drive drive = inMatter(event.drive, matter);
  std::vector<bool> named(places.size(), false);
  for (const auto& [name, goal] : event.goals) {
    const std::size_t k = places.at(name);
    named[k] = true;
    if (auto ok = state.moveTo(k, goal, drive); !ok) return ok;
  }
  for (std::size_t k = 0; event.others && k < named.size(); ++k)
    if (!named[k])
      if (auto ok = state.moveTo(k, 0, drive); !ok) return ok;
  return {};
}

}  // namespace

Result<void> checkRegions(const Timeline& timeline, std::span<const std::string> regions) {
  for (const TimelineEvent& event : timeline.events) {
    if (event.region.empty() || std::ranges::find(regions, event.region) != regions.end()) continue;
    if (regions.empty() || (regions.size() == 1 && regions.front() == "rest"))
      return fail("an event is for a region '", event.region,
                  "', but the face is not divided into regions.");
    std::string known;
    for (const std::string& region : regions) known += (known.empty() ? "" : ", ") + region;
    return fail("an event is for a region '", event.region, "' that there is not; there is ", known,
                ".");
  }
  return {};
}

namespace {

bool isFor(const TimelineEvent& event, std::string_view region) {
  return event.region.empty() || event.region == region;
}

// When a drive arrives; those that swing or bounce have no such time.
double arrivalOf(const Drive& drive) {
  const bool isTimed = drive.kind == Drive::Kind::newton ||
                       drive.kind == Drive::Kind::linearForce ||
                       drive.kind == Drive::Kind::accelerateBrake;
  return drive.delay + (isTimed ? drive.seconds : 0);
}

}  // namespace

double endIn(const Timeline& timeline, std::string_view region, const Matter& matter) {
  const double whole = timeline.seconds * timeline.loops;
  double end = whole;
  for (const TimelineEvent& event : timeline.events) {
    const double meant = arrivalOf(event.drive), first = event.time + meant;
    if (!isFor(event, region) || first > whole * (1 + 1e-9)) continue;
    // The last time that it arrives.
    const double loop =
        std::min(std::floor((whole - first) / timeline.seconds * (1 + 1e-9)), timeline.loops - 1.0);
    const double at = std::min(first + std::max(loop, 0.0) * timeline.seconds, whole);
    end = std::max(end, at + arrivalOf(inMatter(event.drive, matter)) - meant);
  }
  return end + matter.delay;
}

namespace {

/// A timeline while it plays.
struct Playing {
  MotionState state;
  std::size_t next = 0;  // of its events
  int loop = 0;
};

class Baker {
 public:
  Baker(const Timeline& timeline, std::string_view region, const Matter& matter, double end = 0)
      : timeline_(timeline),
        region_(region),
        matter_(matter),
        end_(std::max(end, endIn(timeline, region, matter))) {
    for (const TimelineEvent& event : timeline.events)
      for (const auto& [name, goal] : event.goals)
        if (places_.try_emplace(name, clip_.names.size()).second) clip_.names.push_back(name);
    for (std::vector<double>& weights : looks_) weights.resize(clip_.names.size());
  }

  /// Adds frames, up to `most` weights in all, where straight lines between frames at this rate are
  /// not good enough; 0: neither adds frames nor measures what the lines miss.
  Result<Baked> bake(double framesPerSecond, std::size_t most) {
    // The last frame is at the end, even if that is not a whole number of frames.
    const double frames = std::ceil(end_ * framesPerSecond - 1e-6);
    if (auto ok = check(framesPerSecond, frames); !ok) return std::unexpected(ok.error());
    auto state = MotionState::make(std::vector<double>(clip_.names.size(), 0.0));
    if (!state) return std::unexpected(state.error());
    const auto even = static_cast<std::size_t>(frames + 1) * clip_.names.size();
    isExamined_ = most > 0;
    room_ = std::min(kMostMore, most - std::min(most, even));
    // Each look ahead plays the events of its stretch again.
    if (static_cast<double>(timeline_.events.size()) * timeline_.loops > 1e6) room_ = 0;
    Playing playing{std::move(*state)};
    if (auto ok = goTo(playing, 0); !ok) return std::unexpected(ok.error());
    append(playing, 0);
    for (double frame = 1; frame <= frames; ++frame)
      if (auto ok =
              add(playing, clip_.times.back(), frame < frames ? frame / framesPerSecond : end_);
          !ok)
        return std::unexpected(ok.error());
    return Baked{std::move(clip_), missed_};
  }

 private:
  static constexpr std::size_t kMostMore = std::size_t{1} << 22;
  static constexpr double kMiss = 6.9e-5;  // where it looks; at a kink in between 1e-4

  Result<void> checkTimes() const {
    if (!(timeline_.seconds > 0) || timeline_.loops < 1)
      return failCall("A timeline lasts longer than 0 seconds and is played once at least.");
    double last = 0;
    for (const TimelineEvent& event : timeline_.events) {
      if (!(event.time >= last && event.time <= timeline_.seconds))
        return failCall("Event ", &event - timeline_.events.data(),
                        " of the timeline is before another or beyond the end; the events stand in "
                        "the order of their times.");
      last = event.time;
    }
    return sweepface::check(matter_);
  }

  Result<void> check(double framesPerSecond, double frames) const {
    if (auto ok = checkTimes(); !ok) return ok;
    if (framesPerSecond > 0 && frames < 1)
      return failCall("A timeline must last longer than a millionth of a frame; make it longer.");
    if (!(framesPerSecond > 0) || !(frames <= 1e6) || end_ > kMostSeconds)
      return failCall(
          "A timeline has 1 to 1,000,000 frames, which at 240 a second are 4,166 s with its loops; "
          "make it shorter, or bake it at another rate.");
    const auto names = static_cast<double>(clip_.names.size());
    if ((frames + 1) * names > kMostClipWeights)
      return failCall(
          "The timeline bakes into more weights than a clip can hold; shorten it, or name fewer.");
    if (static_cast<double>(timeline_.events.size()) * timeline_.loops * names > kMostClipWeights)
      return failCall(
          "The timeline sends weights off more often than a clip can tell; repeat it less, or name "
          "fewer.");
    return {};
  }

  // Advances to `time`. Every event until then sets out at its own instant; at the end, all that
  // are left do.
  Result<void> goTo(Playing& playing, double time) const {
    while (playing.loop < timeline_.loops) {
      if (playing.next == timeline_.events.size()) {
        playing.next = 0, ++playing.loop;
        continue;
      }
      const TimelineEvent& event = timeline_.events[playing.next];
      const double start = event.time + playing.loop * timeline_.seconds + matter_.delay;
      if (start > time && time < end_) break;
      playing.state.advance(start - playing.state.now());
      if (isFor(event, region_))
        if (auto ok = play(event, places_, matter_, playing.state); !ok) return ok;
      ++playing.next;
    }
    playing.state.advance(time - playing.state.now());
    return {};
  }

  void append(const Playing& playing, double time) {
    playing.state.positions(looks_[0]);
    clip_.times.push_back(time);
    clip_.weights.insert(clip_.weights.end(), looks_[0].begin(), looks_[0].end());
  }

  // Adds the frame at `to` and, before it, as many as straight lines need. `playing` stands at
  // `from`.
  Result<void> add(Playing& playing, double from, double to, int halvings = 0) {
    constexpr int kMostHalvings = 10;
    const double middle = std::midpoint(from, to);
    if (isExamined_ && from < middle && middle < to) {
      const Result<Miss> miss = missedBy(playing, from, to);
      if (!miss) return std::unexpected(miss.error());
      const bool isShortest = halvings == kMostHalvings;
      if (miss->all > kMiss && !isShortest && clip_.names.size() <= room_) {
        room_ -= clip_.names.size();
        if (auto ok = add(playing, from, middle, halvings + 1); !ok) return ok;
        return add(playing, middle, to, halvings + 1);
      }
      const Result<bool> isJump = isShortest ? jumps(playing, from, to, miss->all) : false;
      if (!isJump) return std::unexpected(isJump.error());
      missed_ = std::max(missed_, *isJump ? miss->butJumps : miss->all);
    }
    if (auto ok = goTo(playing, to); !ok) return ok;
    append(playing, to);
    return {};
  }

  /// The most that a straight line over a stretch of time misses, and the most by which a weight
  /// leaves the range of its two ends, which a jump does not.
  struct Miss {
    double all = 0, butJumps = 0;
  };

  Result<Miss> missedBy(const Playing& playing, double from, double to) {
    // Unevenly spaced, unlike the zeros of a swing.
    constexpr std::array kLooks{0.0, 0.191, 0.5, 0.691, 1.0};
    ahead_ = playing;
    for (std::size_t k = 0; k < kLooks.size(); ++k) {
      const double time = k + 1 < kLooks.size() ? std::lerp(from, to, kLooks[k]) : to;
      if (auto ok = goTo(*ahead_, time); !ok) return std::unexpected(ok.error());
      ahead_->state.positions(looks_[k]);
    }
    const std::vector<double>&start = looks_.front(), &end = looks_.back();
    Miss most;
    for (std::size_t k = 1; k + 1 < kLooks.size(); ++k)
      for (std::size_t n = 0; n < clip_.names.size(); ++n) {
        const double look = looks_[k][n];
        most.all = std::max(most.all, std::abs(look - std::lerp(start[n], end[n], kLooks[k])));
        const auto [low, high] = std::minmax(start[n], end[n]);
        most.butJumps = std::max({most.butJumps, low - look, look - high});
      }
    return most;
  }

  // Whether a stretch is a jump: two straight lines hardly miss less than one. On a curve they
  // would miss four times less.
  Result<bool> jumps(const Playing& playing, double from, double to, double missed) {
    const double middle = std::midpoint(from, to);
    const Result<Miss> first = missedBy(playing, from, middle);
    if (!first) return std::unexpected(first.error());
    Playing later = *ahead_;
    const Result<Miss> second = missedBy(later, middle, to);
    if (!second) return std::unexpected(second.error());
    return std::max(first->all, second->all) > missed / 2;
  }

  const Timeline& timeline_;
  std::string_view region_;
  const Matter& matter_;
  double end_;  // seconds
  Places places_;
  Clip clip_;
  std::array<std::vector<double>, 5> looks_;  // [names] each
  std::optional<Playing> ahead_;              // while looking ahead
  bool isExamined_ = false;
  std::size_t room_ = 0;  // for weights of added frames
  double missed_ = 0;
};

}  // namespace

Result<Clip> bake(const Timeline& timeline, double framesPerSecond) {
  return bake(timeline, framesPerSecond, {}, {});
}

Result<Clip> bake(const Timeline& timeline, double framesPerSecond, std::string_view region,
                  const Matter& matter) {
  auto baked = Baker(timeline, region, matter).bake(framesPerSecond, 0);
  if (!baked) return std::unexpected(baked.error());
  return std::move(baked->clip);
}

Result<Baked> bakeToPlay(const Timeline& timeline, std::string_view region, const Matter& matter,
                         std::size_t regions, double end) {
  constexpr double kRate = 240;
  return Baker(timeline, region, matter, end)
      .bake(kRate, kMostClipWeights / std::max<std::size_t>(1, regions));
}

}  // namespace sweepface
