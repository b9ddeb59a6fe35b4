#include "report/program.hpp"

#if defined(_WIN32) || defined(__wasi__)
#include <fmt/format.h>
#include <random>
#else
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace sweepface {

#if defined(_WIN32) || defined(__wasi__)

Ran run(const std::vector<std::string>&) { return Ran::missing; }

ScratchFolder::ScratchFolder() {
  std::error_code error;
  const auto path = std::filesystem::temp_directory_path(error) /
                    fmt::format("sweepface-{:08x}", std::random_device()());
  if (!error && std::filesystem::create_directory(path, error)) path_ = path;
}

#else

Ran run(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t silence;
  posix_spawn_file_actions_init(&silence);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&silence, stream, "/dev/null", O_RDWR, 0);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, arguments[0], &silence, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&silence);
  if (error != 0) return Ran::missing;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return Ran::badly;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? Ran::well : Ran::badly;
}

ScratchFolder::ScratchFolder() {
  std::error_code none;
  const auto parent = std::filesystem::temp_directory_path(none);
  std::string path = (parent / "sweepface-XXXXXX").string();
  if (!none && mkdtemp(path.data())) path_ = path;
}

#endif

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace sweepface
