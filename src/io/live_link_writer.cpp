#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <set>

#include "sweepface/clip.hpp"
#include "sweepface/weights.hpp"

#include "io/frame_clock.hpp"
#include "io/text.hpp"

namespace sweepface {
namespace {

/// The columns of the Live Link Face app in their order: ARKit's shapes, then angles in radians.
constexpr std::array<std::string_view, 61> kColumns{"EyeBlinkLeft",
                                                    "EyeLookDownLeft",
                                                    "EyeLookInLeft",
                                                    "EyeLookOutLeft",
                                                    "EyeLookUpLeft",
                                                    "EyeSquintLeft",
                                                    "EyeWideLeft",
                                                    "EyeBlinkRight",
                                                    "EyeLookDownRight",
                                                    "EyeLookInRight",
                                                    "EyeLookOutRight",
                                                    "EyeLookUpRight",
                                                    "EyeSquintRight",
                                                    "EyeWideRight",
                                                    "JawForward",
                                                    "JawRight",
                                                    "JawLeft",
                                                    "JawOpen",
                                                    "MouthClose",
                                                    "MouthFunnel",
                                                    "MouthPucker",
                                                    "MouthRight",
                                                    "MouthLeft",
                                                    "MouthSmileLeft",
                                                    "MouthSmileRight",
                                                    "MouthFrownLeft",
                                                    "MouthFrownRight",
                                                    "MouthDimpleLeft",
                                                    "MouthDimpleRight",
                                                    "MouthStretchLeft",
                                                    "MouthStretchRight",
                                                    "MouthRollLower",
                                                    "MouthRollUpper",
                                                    "MouthShrugLower",
                                                    "MouthShrugUpper",
                                                    "MouthPressLeft",
                                                    "MouthPressRight",
                                                    "MouthLowerDownLeft",
                                                    "MouthLowerDownRight",
                                                    "MouthUpperUpLeft",
                                                    "MouthUpperUpRight",
                                                    "BrowDownLeft",
                                                    "BrowDownRight",
                                                    "BrowInnerUp",
                                                    "BrowOuterUpLeft",
                                                    "BrowOuterUpRight",
                                                    "CheekPuff",
                                                    "CheekSquintLeft",
                                                    "CheekSquintRight",
                                                    "NoseSneerLeft",
                                                    "NoseSneerRight",
                                                    "TongueOut",
                                                    "HeadYaw",
                                                    "HeadPitch",
                                                    "HeadRoll",
                                                    "LeftEyeYaw",
                                                    "LeftEyePitch",
                                                    "LeftEyeRoll",
                                                    "RightEyeYaw",
                                                    "RightEyePitch",
                                                    "RightEyeRoll"};

/// A column and the weights of the clip of which it shows the largest. Weights that are not always
/// equal have columns of their own as well, which take precedence when read. So do names without a
/// side, which columns of both sides show: for faces whose targets have none either.
struct Column {
  std::string heading;
  std::vector<std::size_t> sources;
};

std::vector<Column> columnsOf(const Clip& clip) {
  Clip app;
  for (const std::string_view name : kColumns) app.names.emplace_back(name);
  const ClipMatch match = matchClip(app, clip.names), back = matchClip(clip, app.names);
  const std::size_t n = clip.names.size();
  const auto alike = [&](std::size_t a, std::size_t b) {
    for (std::size_t f = 0; f < clip.times.size(); ++f)
      if (clip.weights[f * n + a] != clip.weights[f * n + b]) return false;
    return true;
  };
  std::vector<Column> columns;
  std::vector<bool> shown(n, false);
  for (std::size_t k = 0; k < kColumns.size(); ++k) {
    Column& column = columns.emplace_back(app.names[k]);
    column.sources.assign(match.targets[k].begin(), match.targets[k].end());
    const bool isAll = std::ranges::all_of(
        column.sources, [&](std::size_t source) { return alike(source, column.sources[0]); });
    for (const std::size_t source : column.sources) shown[source] = isAll;
    if (!column.sources.empty()) continue;
    for (std::size_t source = 0; source < n; ++source)
      if (std::ranges::find(back.targets[source], static_cast<Index>(k)) !=
          back.targets[source].end())
        column.sources.push_back(source);
  }
  for (std::size_t k = 0; k < n; ++k)
    if (!shown[k]) columns.push_back({clip.names[k], {k}});
  return columns;
}

constexpr double kDay = 86400;  // seconds

/// HH:MM:SS:FF.fff, rounded to a thousandth of a frame. Midnight is passed as on a clock.
struct Timecode {
  double seconds, frames;

  Timecode(double time, const io::FrameClock& clock)
      : seconds(std::floor(clock.secondsAt(time))),
        frames(std::round((clock.secondsAt(time) - seconds) * clock.counted() * 1000) / 1000) {
    if (frames >= clock.counted()) ++seconds, frames = 0;
  }
  double clock() const { return std::fmod(seconds, kDay); }
  bool isAfter(const Timecode& other) const {
    return seconds != other.seconds ? seconds > other.seconds : frames > other.frames;
  }
  std::string text() const {
    const auto count = static_cast<int>(clock());
    return fmt::format("{:02}:{:02}:{:02}:{:06.3f}", count / 3600, count / 60 % 60, count % 60,
                       frames);
  }
};

/// A heading as a cell: in quotes if it has commas or quotes, and with quotes doubled.
std::string cellOf(const std::string& heading) {
  if (heading.find_first_of(",\"") == std::string::npos) return heading;
  std::string cell = "\"";
  for (const char c : heading) cell.append(c == '"' ? 2 : 1, c);
  return cell + '"';
}

Result<void> check(const Clip& clip, const std::vector<Column>& columns, double framesPerSecond) {
  if (auto ok = io::checkFrameRate(framesPerSecond); !ok) return ok;
  if (clip.times.empty()) return fail("The clip has no frames.");
  const auto secondsAt = [&](double time) {
    return Timecode(time, io::FrameClock(framesPerSecond)).seconds;
  };
  if (!(clip.times.front() >= 0 && secondsAt(clip.times.front()) < kDay))
    return fail("The times of a recording begin from 0 to below a day; shift those of the clip.");
  if (!(secondsAt(clip.times.back()) - secondsAt(clip.times.front()) < kDay))
    return fail("A recording lasts less than a day; cut the clip.");
  std::set<std::string> headings;
  for (const Column& column : columns) {
    const std::string read(io::trimmed(column.heading));
    if (io::sameLetters(read, "Timecode") || io::sameLetters(read, "BlendShapeCount"))
      return fail(
          fmt::format("'{}' cannot be a shape of a recording; rename the target.", column.heading));
    if (read.empty() || column.heading.find_first_of("\r\n") != std::string::npos)
      return fail(fmt::format("'{}' cannot be the heading of a column; rename the target.",
                              column.heading));
    if (!headings.insert(read).second)
      return fail(fmt::format("There would be two columns '{}'; rename the target, or one of them.",
                              column.heading));
  }
  return {};
}

}  // namespace

Result<std::string> formatLiveLinkCsv(const Clip& clip, double framesPerSecond) {
  const std::vector<Column> columns = columnsOf(clip);
  if (auto ok = check(clip, columns, framesPerSecond); !ok) return std::unexpected(ok.error());
  const io::FrameClock clock(framesPerSecond);
  std::string text = "Timecode,BlendShapeCount";
  for (const Column& column : columns) text += "," + cellOf(column.heading);
  for (std::size_t f = 0; f < clip.times.size(); ++f) {
    const Timecode time(clip.times[f], clock);
    if (f > 0 && !time.isAfter({clip.times[f - 1], clock}))
      return fail(
          fmt::format("Frames {} and {} of the clip are too near to each other for a "
                      "timecode at {:.6g} frames a second; ask for fewer, or for another rate.",
                      f - 1, f, framesPerSecond));
    // Readers see midnight where the clock goes back by more than half a day.
    const double back = f > 0 ? Timecode(clip.times[f - 1], clock).clock() - time.clock() : 0;
    if (back > 0 && back <= kDay / 2)
      return fail(
          fmt::format("Between frames {} and {} the clip passes midnight and lasts half a day or "
                      "more, which timecodes cannot tell; cut it there.",
                      f - 1, f));
    text += fmt::format("\n{},{}", time.text(), columns.size());
    for (const Column& column : columns) {
      double value = column.sources.empty() ? 0 : -HUGE_VAL;
      for (const std::size_t k : column.sources) {
        const double weight = clip.weights[f * clip.names.size() + k];
        if (!isPlausibleWeight(weight))
          return fail(
              fmt::format("Frame {} of the clip gives '{}' the weight {:.6g}, which is no "
                          "number within ±1,000,000.",
                          f, column.heading, weight));
        value = std::max(value, weight);
      }
      text += fmt::format(",{}", value == 0 ? 0.0 : value);
    }
  }
  return text += "\n";
}

}  // namespace sweepface
