#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <set>

#include "sweepface/clip.hpp"
#include "sweepface/weights.hpp"

#include "io/text.hpp"

namespace sweepface {
namespace {

using io::inQuotes, io::sameLetters, io::toNumber, io::trimmed;

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> found;
  while (true) {
    const std::size_t comma = line.find(',');
    found.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return found;
    line.remove_prefix(comma + 1);
  }
}

class LiveLinkReader {
 public:
  LiveLinkReader(std::string_view text, std::string_view name, double framesPerSecond)
      : lines_(text), name_(name), framesPerSecond_(framesPerSecond) {}

  Result<Clip> read() {
    if (io::isUtf16(lines_.rest())) return failFile("is a text in UTF-16; save it in UTF-8");
    if (auto ok = readHeadings(); !ok) return std::unexpected(ok.error());
    while (lines_.next())
      if (!trimmed(lines_.line()).empty())
        if (auto ok = readRow(); !ok) return std::unexpected(ok.error());
    if (clip_.times.empty()) return failFile("has headings but no frames; record again");
    return std::move(clip_);
  }

 private:
  std::unexpected<Error> failFile(std::string_view what) const {
    return fail(fmt::format("{} {}.", name_, what));
  }
  std::unexpected<Error> failLine(std::string_view what) const {
    return fail(fmt::format("{}, line {}: {}.", name_, lines_.number(), what));
  }

  Result<void> readHeadings() {
    do
      if (!lines_.next()) return failFile("is empty; record again");
    while (trimmed(lines_.line()).empty());
    const auto headings = cells(io::withoutMark(lines_.line()));
    columns_ = headings.size();
    for (std::size_t c = 0; c < columns_; ++c)
      if (auto ok = readHeading(headings[c], c); !ok) return ok;
    if (timeColumn_ >= columns_)
      return failLine("there is no column 'Timecode'; this may be no recording of Live Link Face");
    if (clip_.names.empty()) return failLine("there is no column of a shape");
    return {};
  }
  Result<void> readHeading(std::string_view heading, std::size_t column) {
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

  Result<void> readRow() {
    const auto row = cells(lines_.line());
    if (row.size() != columns_)
      return failLine(
          fmt::format("there are {} values under {} headings; the file may be cut short",
                      row.size(), columns_));
    const Result<double> time = timecode(row[timeColumn_]);
    if (!time) return std::unexpected(time.error());
    if (!clip_.times.empty() && *time <= clip_.times.back())
      return failLine(
          fmt::format("the timecode {} is not after the one before; sort the rows by time",
                      inQuotes(row[timeColumn_])));
    clip_.times.push_back(*time);
    for (const std::size_t c : shapeColumns_) {
      const auto value = toNumber<double>(row[c]);
      if (!value || !isPlausibleWeight(*value))
        return failLine(fmt::format("{} in column {} is not a number within ±1,000,000",
                                    inQuotes(row[c]), c + 1));
      clip_.weights.push_back(*value);
    }
    return {};
  }

  // HH:MM:SS:FF.fff, the last in frames; or plain seconds. At midnight the clock begins anew.
  Result<double> timecode(std::string_view text) {
    if (const auto seconds = toNumber<double>(text); seconds && isPlausibleTime(*seconds)) {
      if (*seconds < 0) return failLine(fmt::format("the time {} is below 0", inQuotes(text)));
      return *seconds;
    }
    std::array<double, 4> parts{};
    std::string_view rest = text;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t colon = k < 3 ? rest.find(':') : rest.size();
      const auto part = colon == std::string_view::npos ? std::optional<double>{}
                                                        : toNumber<double>(rest.substr(0, colon));
      if (!part || !(*part >= 0) || *part > 1e6)
        return failLine(fmt::format("{} is not a timecode like 12:59:59:23.500", inQuotes(text)));
      parts[k] = *part;
      if (k < 3) rest.remove_prefix(colon + 1);
    }
    if (parts[1] >= 60 || parts[2] >= 60)
      return failLine(
          fmt::format("the timecode {} has more than 59 minutes or seconds", inQuotes(text)));
    if (parts[3] >= framesPerSecond_)
      return failLine(
          fmt::format("the timecode {} counts more than {} frames a second; give the "
                      "recording's own rate",
                      inQuotes(text), framesPerSecond_));
    constexpr double kDay = 86400;
    const double clock = (parts[0] * 60 + parts[1]) * 60 + parts[2] + parts[3] / framesPerSecond_;
    if (!clip_.times.empty() && clock + midnights_ < clip_.times.back() - kDay / 2)
      midnights_ += kDay;
    return clock + midnights_;
  }

  io::LineCursor lines_;
  std::string_view name_;
  double framesPerSecond_;
  double midnights_ = 0;  // seconds of the days gone by
  std::size_t columns_ = 0, timeColumn_ = static_cast<std::size_t>(-1);
  std::vector<std::size_t> shapeColumns_;
  std::set<std::string_view> known_;  // headings of shapes
  Clip clip_;
};

}  // namespace

Result<Clip> parseLiveLinkCsv(std::string_view text, std::string_view name,
                              double framesPerSecond) {
  if (auto ok = io::checkFrameRate(framesPerSecond); !ok) return std::unexpected(ok.error());
  return LiveLinkReader(text, name, framesPerSecond).read();
}

}  // namespace sweepface
