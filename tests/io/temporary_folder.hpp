#pragma once

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <random>
#include <string>
#include <string_view>

namespace sweepface::testing {

/// A separate folder for each test, deleted with it.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("sweepface-io-" + std::to_string(std::random_device{}()) +
               std::to_string(std::random_device{}()))) {
    std::filesystem::create_directory(path_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

  /// Creates a file and its parent folders.
  std::filesystem::path file(std::string_view name, std::string_view bytes) const {
    const std::filesystem::path path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  std::size_t fileCount() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_),
                                                  std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

/// Whether a call failed with a message of one sentence that contains all of `parts`.
::testing::AssertionResult failsWith(const auto& result,
                                     std::initializer_list<std::string_view> parts) {
  if (result) return ::testing::AssertionFailure() << "it succeeded";
  const std::string& message = result.error().message;
  for (const std::string_view part : parts)
    if (message.find(part) == std::string::npos)
      return ::testing::AssertionFailure() << "'" << message << "' does not say '" << part << "'";
  if (!message.ends_with('.') || message.find('\n') != std::string::npos)
    return ::testing::AssertionFailure() << "'" << message << "' is not one sentence";
  return ::testing::AssertionSuccess();
}

}  // namespace sweepface::testing
