#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sweepface {

enum class Ran { well, badly, missing };

/// On Windows and in WebAssembly every program is missing.
#if defined(_WIN32) || defined(__wasi__)
inline constexpr bool runsPrograms = false;
#else
inline constexpr bool runsPrograms = true;
#endif

/// Runs a program with its arguments, without a shell, and hides its output. It is searched for on
/// the PATH unless its name has a slash.
Ran run(const std::vector<std::string>& words);

/// A temporary folder, removed with the object; its path is empty if none can be made.
class ScratchFolder {
 public:
  ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace sweepface
