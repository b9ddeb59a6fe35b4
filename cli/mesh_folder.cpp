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
  if (fs::is_directory(output, ignored)) return true;
  const fs::file_type type = fs::symlink_status(output, ignored).type();
  return !output.has_extension() &&
         (type == fs::file_type::not_found || type == fs::file_type::regular);
}

Result<void> makeFolder(const fs::path& folder) {
  if (folder.empty()) return fail("The name of the output is empty; name a folder or a file.");
  if (folder == "-")
    return fail("Standard output takes no meshes; name a folder, ./- if it is called so.");
  std::error_code error, ignored;
  fs::create_directories(folder, error);
  if (fs::is_directory(folder, ignored)) return {};
  const bool isFile = fs::exists(folder, ignored) || !error || error == std::errc::file_exists;
  return fail(fmt::format("Cannot make the folder {}: {}.", folder.string(),
                          isFile ? "a file is in its place; choose another name"
                                 : error.message() + "; choose another place"));
}

Result<void> writeMeshes(const MeshFiles& files, bool quiet) {
  std::error_code ignored;
  for (std::size_t k = 0; k < files.count; ++k)
    if (const fs::path path = files.path(k); fs::equivalent(path, files.input, ignored))
      return fail(fmt::format("Cannot write {}: it is what is read; choose another folder.",
                              path.string()));
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
