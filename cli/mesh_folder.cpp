#include "mesh_folder.hpp"

#include <atomic>
#include <fmt/format.h>
#include <mutex>

#include "sweepface/io.hpp"

#include "interrupts.hpp"
#include "output.hpp"
#include "parallel.hpp"

namespace sweepface::cli {

namespace fs = std::filesystem;

bool meansFolder(const fs::path& output) {
  std::error_code ignored;
  return fs::is_directory(output, ignored) ||
         (!output.has_extension() && !fs::exists(output, ignored));
}

Result<void> makeFolder(const fs::path& folder) {
  if (folder.empty()) return fail("The name of the output is empty; name a folder or a file.");
  if (folder == "-")
    return fail("Standard output takes no meshes; name a folder, ./- if it is called so.");
  std::error_code error, ignored;
  fs::create_directories(folder, error);
  if (fs::is_directory(folder, ignored)) return {};
  const bool isFile = fs::exists(folder, ignored) || !error;
  return fail(fmt::format("Cannot make the folder {}: {}.", folder.string(),
                          isFile ? "a file is in its place; choose another name"
                                 : error.message() + "; choose another place"));
}

Result<void> writeMeshes(const MeshFiles& files, bool quiet) {
  catchInterrupts();
  ProgressBar bar(quiet);
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> failed = false;
  std::mutex reporting;
  Result<void> result;
  parallelFor(std::size_t{0}, files.count, [&](std::size_t k) {
    if (failed || interrupted) return;
    const Result<void> written = writeFile(files.path(k), files.text(k));
    bar.show("writing", static_cast<double>(++done) / static_cast<double>(files.count));
    if (written) return;
    const std::scoped_lock lock(reporting);
    if (!failed.exchange(true)) result = written;
  });
  if (interrupted && result)
    return fail(
        fmt::format("Interrupted after {} of {} {}.", done.load(), files.count, files.called));
  return result;
}

}  // namespace sweepface::cli
