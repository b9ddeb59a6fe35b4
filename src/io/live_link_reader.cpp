#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <utility>
#include <vector>

#include "sweepface/clip.hpp"
#include "sweepface/weights.hpp"

#include "io/frame_clock.hpp"
#include "io/text.hpp"

namespace sweepface {
namespace {

using io::inQuotes, io::sameLetters, io::toNumber, io::trimmed;

/// Where the quote that a cell begins with is closed; a doubled quote is part of the text.
std::size_t closingQuote(std::string_view cell) {
  std::size_t at = cell.find('"', 1);
  while (at != std::string_view::npos && cell.substr(at + 1).starts_with('"'))
    at = cell.find('"', at + 2);
  return at;
}

/// Cells between commas, without blanks and quotes around them.
std::vector<std::string_view> cells(std::string_view line) {
  constexpr auto none = std::string_view::npos;
  std::vector<std::string_view> found;
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const std::size_t close = line.starts_with('"') ? closingQuote(line) : none;
    const std::size_t comma = line.find(',', close == none ? 0 : close);
    std::string_view cell = trimmed(line.substr(0, comma));
    if (close != none && cell.size() == close + 1) cell = trimmed(cell.substr(1, close - 1));
    found.push_back(cell);
    if (comma == none) return found;
    line.remove_prefix(comma + 1);
  }
}

/// The text of a cell, in which doubled quotes stand for one.
std::string textOf(std::string_view cell) {
  std::string text;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    text += cell[k];
    if (cell.substr(k).starts_with("\"\"")) ++k;
  }
  return text;
}

/// When a row was recorded: seconds and frames of a clock, or seconds alone.
struct RowTime {
  std::string_view text;
  std::size_t line = 0;
  double seconds = 0, frames = 0;
  bool isClock = false, dropsFrames = false;
};

constexpr double kUsualRate = 60;

/// The frame rate that a take's timecodes count in: the app's usual rate, unless frame numbers stay
/// below another rate and a complete second has about as many rows.
double rateOf(const std::vector<RowTime>& timecodes) {
  double most = 0;                      // frames
  std::size_t rows = 0, inASecond = 0;  // of the densest complete second
  bool isWhole = timecodes.front().frames < 1;
  for (std::size_t k = 0; k < timecodes.size(); ++k) {
    most = std::max(most, std::floor(timecodes[k].frames));
    ++rows;
    if (k + 1 == timecodes.size() || timecodes[k + 1].seconds == timecodes[k].seconds) continue;
    if (isWhole) inASecond = std::max(inASecond, rows);
    isWhole = true;
    rows = 0;
  }
  constexpr double kDense = 0.8;
  for (const double rate : {24.0, 25.0, 30.0, 48.0, 50.0})
    if (most < rate && static_cast<double>(inASecond) >= kDense * rate) return rate;
  return kUsualRate;
}

class LiveLinkReader {
 public:
  LiveLinkReader(std::string_view text, std::string_view name, double framesPerSecond)
      : lines_(text), name_(name), framesPerSecond_(framesPerSecond) {}

  Result<Clip> read() {
    if (io::isUtf16(lines_.rest())) return failFile("is a text in UTF-16; save it in UTF-8");
    if (auto ok = readHeadings(); !ok) return std::unexpected(ok.error());
    while (lines_.next()) {
      if (trimmed(lines_.line()).empty()) continue;
      if (isHalfARow())
        clip_.warnings.push_back(fmt::format(
            "{}: the last row, line {}, is cut short and left out.", name_, lines_.number()));
      else if (auto ok = readRow(); !ok)
        return std::unexpected(ok.error());
    }
    if (timecodes_.empty()) return failFile("has headings but no frames; record again");
    const double rate = rateOf(timecodes_);
    if (framesPerSecond_ == 0)
      framesPerSecond_ = rate;
    else if (timecodes_.front().isClock && rate < kUsualRate &&
             rate < io::FrameClock(framesPerSecond_, false).counted())
      clip_.warnings.push_back(
          fmt::format("{}: {} frames a second were asked for, but its timecodes seem to count {}.",
                      name_, framesPerSecond_, rate));
    if (auto ok = setTimes(); !ok) return std::unexpected(ok.error());
    return std::move(clip_);
  }

 private:
  std::unexpected<Error> failFile(std::string_view what) const {
    return fail(fmt::format("{} {}.", name_, what));
  }
  std::unexpected<Error> failAt(std::size_t line, std::string_view what) const {
    return fail(fmt::format("{}, line {}: {}.", name_, line, what));
  }
  std::unexpected<Error> failLine(std::string_view what) const {
    return failAt(lines_.number(), what);
  }

  Result<void> readHeadings() {
    std::string_view line;
    do {
      if (!lines_.next()) return failFile("is empty; record again");
      line = trimmed(io::withoutMark(lines_.line()));
    } while (line.empty() || sameLetters(line, "sep=,"));
    auto headings = cells(line);
    // Spreadsheets end every line with a comma.
    endsEmpty_ = headings.size() > 1 && headings.back().empty();
    if (endsEmpty_) headings.pop_back();
    columns_ = headings.size();
    for (std::size_t c = 0; c < columns_; ++c)
      if (auto ok = readHeading(textOf(headings[c]), c); !ok) return ok;
    if (timeColumn_ >= columns_) return failLine(lackOfTimes(line));
    if (clip_.names.empty()) return failLine("there is no column of a shape");
    return {};
  }
  static std::string lackOfTimes(std::string_view headings) {
    for (const auto& [separator, called] : {std::pair(';', "semicolons"), std::pair('\t', "tabs")})
      if (headings.contains(separator))
        return fmt::format("the columns are separated by {}; save them with commas", called);
    return "there is no column 'Timecode'; this may be no recording of Live Link Face";
  }
  Result<void> readHeading(const std::string& heading, std::size_t column) {
    if (sameLetters(heading, "Timecode")) {
      if (timeColumn_ < columns_) return failLine("there are two columns 'Timecode'");
      timeColumn_ = column;
    } else if (heading.empty())
      return failLine(fmt::format("column {} has no heading", column + 1));
    else if (!sameLetters(heading, "BlendShapeCount")) {
      if (!known_.insert(heading).second)
        return failLine(fmt::format("there are two columns {}", inQuotes(heading)));
      clip_.names.emplace_back(heading);
      shapeColumns_.push_back(column);
    }
    return {};
  }

  /// Whether a recorder stopped while writing this row: values are missing, or the last one is
  /// incomplete.
  bool isHalfARow() const {
    if (!lines_.cutShort() || timecodes_.empty()) return false;
    const auto row = cells(lines_.line());
    if (row.size() != columns_) return row.size() < columns_;
    return !toNumber<double>(row.back()) &&
           row.back().find_first_not_of("+-.eE\"0123456789") == std::string_view::npos;
  }

  Result<void> readRow() {
    auto row = cells(lines_.line());
    if (endsEmpty_ && row.size() == columns_ + 1 && row.back().empty()) row.pop_back();
    if (row.size() != columns_)
      return failLine(
          fmt::format("there are {} values under {} headings; the file may be cut short",
                      row.size(), columns_));
    const Result<RowTime> time = timecode(row[timeColumn_]);
    if (!time) return std::unexpected(time.error());
    if (!timecodes_.empty() && time->isClock != timecodes_.front().isClock)
      return failLine(fmt::format("the time {} is of another kind than the ones above",
                                  inQuotes(row[timeColumn_])));
    timecodes_.push_back(*time);
    for (std::size_t k = 0; k < shapeColumns_.size(); ++k) {
      const std::string_view cell = row[shapeColumns_[k]];
      const auto value = toNumber<double>(cell);
      if (!value || !isPlausibleWeight(*value))
        return failLine(
            fmt::format("{} in column {}, {}, is not a number within ±1,000,000; take "
                        "the column out if it is no shape",
                        inQuotes(cell), shapeColumns_[k] + 1, inQuotes(clip_.names[k])));
      clip_.weights.push_back(*value);
    }
    return {};
  }

  // HH:MM:SS:FF.fff, the last in frames, after ';' in drop-frame timecode; or plain seconds.
  Result<RowTime> timecode(std::string_view text) const {
    if (const auto seconds = toNumber<double>(text); seconds && isPlausibleTime(*seconds)) {
      if (*seconds < 0) return failLine(fmt::format("the time {} is below 0", inQuotes(text)));
      return RowTime{text, lines_.number(), *seconds};
    }
    std::array<double, 4> parts{};
    std::string_view rest = text;
    bool dropsFrames = false;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t end = k < 2    ? rest.find(':')
                              : k == 2 ? rest.find_first_of(":;")
                                       : rest.size();
      const auto part = end == std::string_view::npos ? std::optional<double>{}
                                                      : toNumber<double>(rest.substr(0, end));
      if (!part || !(*part >= 0) || std::signbit(*part) || *part > 1e6)
        return failLine(fmt::format("{} is not a timecode like 12:59:59:23.500", inQuotes(text)));
      parts[k] = *part;
      if (k == 2) dropsFrames = rest[end] == ';';
      if (k < 3) rest.remove_prefix(end + 1);
    }
    if (parts[1] >= 60 || parts[2] >= 60)
      return failLine(
          fmt::format("the timecode {} has more than 59 minutes or seconds", inQuotes(text)));
    return RowTime{text, lines_.number(), (parts[0] * 60 + parts[1]) * 60 + parts[2], parts[3],
                   true, dropsFrames};
  }

  /// Of several rows at the same time, keeps the last.
  Result<void> setTimes() {
    const std::size_t n = clip_.names.size();
    std::size_t again = 0, firstLine = 0;
    for (std::size_t row = 0; row < timecodes_.size(); ++row) {
      const Result<double> time = timeOf(timecodes_[row]);
      if (!time) return std::unexpected(time.error());
      if (!clip_.times.empty() && *time == clip_.times.back()) {
        if (again++ == 0) firstLine = timecodes_[row].line;
      } else {
        clip_.times.push_back(*time);
      }
      if (const std::size_t place = clip_.times.size() - 1; place < row)
        std::copy_n(&clip_.weights[row * n], n, &clip_.weights[place * n]);
    }
    clip_.weights.resize(clip_.times.size() * n);
    if (again > 0)
      clip_.warnings.push_back(fmt::format(
          "{}: {} of {} rows, the first in line {}, have the timecode of the one before; of each "
          "time the last row counts.",
          name_, again, timecodes_.size(), firstLine));
    return {};
  }
  /// The time of a row; the clock starts again at midnight.
  Result<double> timeOf(const RowTime& at) {
    const io::FrameClock clock(framesPerSecond_, at.dropsFrames);
    if (at.frames >= clock.counted())
      return failAt(at.line, fmt::format("the timecode {} counts more than {} frames a second; "
                                         "give the recording's own rate",
                                         inQuotes(at.text), clock.counted()));
    double time = at.isClock ? clock.timeOf(at.seconds, at.frames) : at.seconds;
    const bool isFirst = clip_.times.empty();
    const double day = clock.timeOf(86400, 0);
    if (at.isClock && !isFirst && time + midnights_ < clip_.times.back() - day / 2)
      midnights_ += day;
    if (at.isClock) time += midnights_;
    if (!isFirst && time < clip_.times.back())
      return failAt(at.line,
                    fmt::format("the timecode {} is before the one above; sort the rows by time",
                                inQuotes(at.text)));
    return time;
  }

  io::LineCursor lines_;
  std::string_view name_;
  double framesPerSecond_;
  double midnights_ = 0;  // seconds of the days passed
  std::size_t columns_ = 0, timeColumn_ = static_cast<std::size_t>(-1);
  bool endsEmpty_ = false;  // every line may end in a comma
  std::vector<std::size_t> shapeColumns_;
  std::set<std::string> known_;     // headings of shapes
  std::vector<RowTime> timecodes_;  // [rows]
  Clip clip_;
};

}  // namespace

Result<Clip> parseLiveLinkCsv(std::string_view text, std::string_view name,
                              double framesPerSecond) {
  if (auto ok = io::checkFrameRateIfGiven(framesPerSecond); !ok) return std::unexpected(ok.error());
  return LiveLinkReader(text, name, framesPerSecond).read();
}

}  // namespace sweepface
