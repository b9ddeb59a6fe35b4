#include "output.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace sweepface::cli {

std::string printable(std::string_view given) {
  std::string text(given);
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto code = static_cast<unsigned char>(text[k]);
    const bool isWide = code == 0xC2 && k + 1 < text.size() && (text[k + 1] & 0xE0) == 0x80;
    if (code < ' ' || code == 0x7f || isWide) text.replace(k, isWide ? 2 : 1, "?");
  }
  return text;
}

std::string firstOf(std::span<const std::string> names) {
  constexpr std::size_t most = 6;
  if (names.size() <= most) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{} and {} more", fmt::join(names.first(most), ", "), names.size() - most);
}

namespace {

/// Ignores failure: there is nowhere else to report it.
void tell(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

void printError(std::string_view sentence) { tell("sweepface: " + printable(sentence) + "\n"); }

void printWarning(std::string_view sentence) {
  tell("sweepface: warning: " + printable(sentence) + "\n");
}

void printJson(const nlohmann::ordered_json& report) {
  using Handler = nlohmann::ordered_json::error_handler_t;
  fmt::print("{}\n", report.dump(2, ' ', false, Handler::replace));
}

ProgressBar::ProgressBar(bool quiet)
    : form_(quiet                               ? Form::none
            : isatty(STDERR_FILENO)             ? Form::bar
            : std::getenv("SWEEPFACE_PROGRESS") ? Form::lines
                                                : Form::none) {}

ProgressBar::~ProgressBar() {
  if (form_ == Form::bar && !text_.empty()) tell("\r\033[K");
}

void ProgressBar::show(std::string_view what, double done) {
  if (form_ == Form::none) return;
  constexpr int width = 30;
  const double share = std::isfinite(done) ? std::clamp(done, 0.0, 1.0) : 0.0;
  const std::scoped_lock lock(drawing_);
  const auto now = std::chrono::steady_clock::now();
  // Terminals are slow: draw only some frames a second.
  if (share < 1 && now - last_ < std::chrono::milliseconds(50)) return;
  last_ = now;
  if (form_ == Form::lines) {
    std::string line = fmt::format("sweepface: {:.0f} % {}\n", 100 * share, what);
    if (line != text_) tell(line);
    text_ = std::move(line);
    return;
  }
  const int full = static_cast<int>(share * width);
  text_ =
      fmt::format("[{:=<{}}{: <{}}] {:3.0f} % {}", "", full, "", width - full, 100 * share, what);
  tell("\r\033[K" + text_);
  std::fflush(stderr);
}

}  // namespace sweepface::cli
