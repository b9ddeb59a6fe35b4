#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "sweepface/result.hpp"

namespace sweepface::cli {

/// Whether an output is meant to be a folder: it is one, or its name has no ending and it is no
/// device.
bool meansFolder(const std::filesystem::path& output);

/// Makes a folder, and its parents, unless they exist.
Result<void> makeFolder(const std::filesystem::path& folder);

/// The OBJ files of a folder, and what to call them in messages.
struct MeshFiles {
  std::size_t count;
  std::string_view called;
  std::filesystem::path input;  ///< none of them may overwrite this file
  std::function<std::filesystem::path(std::size_t)> path;
  std::function<std::string(std::size_t)> text;
};

/// Writes the files in parallel until Ctrl-C, with a progress bar unless quiet. Returns the first
/// failure.
Result<void> writeMeshes(const MeshFiles& files, bool quiet);

}  // namespace sweepface::cli
