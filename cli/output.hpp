#pragma once

#include <chrono>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

namespace sweepface::cli {

/// Replaces control characters by '?', so that those in names do not reach the terminal.
std::string printable(std::string_view text);

/// Names with commas between, of many only the first, and how many there are more.
std::string firstOf(std::span<const std::string> names);

/// Prints "sweepface: sentence" to the error stream, made printable.
void printError(std::string_view sentence);
void printWarning(std::string_view sentence);
/// Prints JSON to the output stream; bytes in names that are not UTF-8 are replaced.
void printJson(const nlohmann::ordered_json& report);

/// A progress bar on the last line of a terminal, erased when the work is done. If the error stream
/// is no terminal it is silent, or prints lines like "sweepface: 42 % fitting" where the variable
/// SWEEPFACE_PROGRESS is set, for programs that run the tool. Any thread may call it.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  /// Shows what is being done and how far it has got, 0 to 1.
  void show(std::string_view what, double done);

 private:
  enum class Form { none, bar, lines };

  Form form_;
  std::mutex drawing_;
  std::chrono::steady_clock::time_point last_{};
  std::string text_;
};

}  // namespace sweepface::cli
