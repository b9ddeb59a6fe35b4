#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "sweepface/result.hpp"

namespace sweepface::cli {

/// Whether an output is meant to be a folder: it is one, or has no ending as files have and is no
/// device.
bool meansFolder(const std::filesystem::path& output);

/// Makes a folder, and those it is in, where they are not there yet.
Result<void> makeFolder(const std::filesystem::path& folder);

/// The OBJ files of a folder, and how they are called together.
struct MeshFiles {
  std::size_t count;
  std::string_view called;
  std::filesystem::path input;  ///< which none of them may be
  std::function<std::filesystem::path(std::size_t)> path;
  std::function<std::string(std::size_t)> text;
};

/// Writes the files in parallel, behind a bar unless quiet, until Ctrl-C; the answer is that of the
/// first one that failed.
Result<void> writeMeshes(const MeshFiles& files, bool quiet);

}  // namespace sweepface::cli
