#pragma once

#include <chrono>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace sweepface::cli {

/// "sweepface: sentence" on the error stream, with '?' for control characters.
void printError(std::string_view sentence);
void printWarning(std::string_view sentence);
/// JSON on the output stream; bytes in names that are no UTF-8 are replaced.
void printJson(const nlohmann::ordered_json& report);

/// A bar on the last line of a terminal, gone when the work is done. Silent where the error stream
/// is no terminal. Any thread may call it.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  /// Says what is going on and how far it is, 0 to 1.
  void show(std::string_view what, double done);

 private:
  bool visible_;
  std::mutex drawing_;
  std::chrono::steady_clock::time_point last_{};
  std::string text_;
};

}  // namespace sweepface::cli
