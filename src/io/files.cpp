#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <sys/stat.h>
#include <system_error>
#include <tuple>
#include <unistd.h>

#include "sweepface/io.hpp"

#include "io/text.hpp"

namespace sweepface {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// Windows has these functions for paths as it stores them, and translates line ends unless told.
#ifdef _WIN32
int openedNumber(const fs::path& path, int flags) {
  return ::_wopen(path.c_str(), flags | O_BINARY, 0666);
}
bool allows(const fs::path& path, int what) { return ::_waccess(path.c_str(), what) == 0; }
constexpr const char* kInUse = "; close it in other programs, or choose another place";
#else
int openedNumber(const fs::path& path, int flags) { return ::open(path.c_str(), flags, 0666); }
bool allows(const fs::path& path, int what) { return ::access(path.c_str(), what) == 0; }
constexpr const char* kInUse = "; choose another place, or change its permissions";
#endif

File opened(const fs::path& path, int flags, const char* mode) {
  const int number = openedNumber(path, flags);
  return File(number < 0 ? nullptr : ::fdopen(number, mode));
}

std::string reason(int code) { return std::generic_category().message(code); }

bool isFull(int code) {
#ifdef EDQUOT
  if (code == EDQUOT) return true;
#endif
  return code == ENOSPC;
}

/// In bytes, or in the 16-bit units of Windows.
constexpr std::size_t kLongestName = 255;

std::unexpected<Error> cannotWrite(const fs::path& path, int code) {
  // Windows has several errors for that, Wine others.
  if (path.filename().native().size() > kLongestName) code = ENAMETOOLONG;
  const bool isForbidden = code == EACCES || code == EPERM || code == EROFS;
  const char* const advice = isFull(code)           ? "; make room there, or choose another place"
                             : isForbidden          ? kInUse
                             : code == ENAMETOOLONG ? "; choose a shorter name"
                                                    : "";
  return fail(fmt::format("Cannot write {}: {}{}.", path.string(), reason(code), advice));
}

/// Writes and closes a file; returns 0 or the errno of what went wrong.
int writeAll(File file, std::string_view bytes) {
  errno = 0;
  const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
  const int writeError = errno;
  // A full disk may show only when the last bytes leave the buffer.
  errno = 0;
  if (std::fclose(file.release()) == 0 && whole) return 0;
  const int code = whole ? errno : writeError;
  return code != 0 ? code : EIO;
}

/// The n-th name of a temporary file; short, because the final name may be as long as names can be.
fs::path temporaryName(const fs::path& folder, int number) {
  return folder / fmt::format(".sweepface-{}.tmp", number);
}
constexpr int kMostTemporaries = 10'000;

struct Temporary {
  fs::path path;
  File file;
  int code = EEXIST;  ///< why there is no file
};

/// Creates a new file in the folder.
Temporary createTemporary(const fs::path& folder) {
  for (int number = 0; number < kMostTemporaries; ++number) {
    fs::path path = temporaryName(folder, number);
    File file = opened(path, O_CREAT | O_EXCL | O_WRONLY, "wb");
    const int code = file ? 0 : errno;
    if (code != EEXIST) return {std::move(path), std::move(file), code};
  }
  return {};
}

/// Why no file can be created in a folder.
std::unexpected<Error> cannotCreate(const fs::path& path, const fs::path& folder, int code) {
  std::error_code ignored;
  if (!fs::exists(folder, ignored))
    return fail(fmt::format("Cannot write {}: the folder {} does not exist; create it first.",
                            path.string(), folder.string()));
  if (!fs::is_directory(folder, ignored))
    return fail(fmt::format("Cannot write {}: {} is not a folder; choose another place.",
                            path.string(), folder.string()));
  return fail(
      fmt::format("Cannot write {}: the folder {} takes no new file ({}); choose another "
                  "place or change its permissions.",
                  path.string(), folder.string(), reason(code)));
}

Result<void> writeDirectly(const fs::path& path, std::string_view bytes) {
  File file = opened(path, O_CREAT | O_TRUNC | O_WRONLY, "wb");
  if (!file) return cannotWrite(path, errno);
  if (const int code = writeAll(std::move(file), bytes)) return cannotWrite(path, code);
  return {};
}

#ifdef O_TMPFILE

int writeAll(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(std::max<decltype(written)>(written, 0)));
  }
  return 0;
}

/// Replaces a file by one that has no name until it is complete, so that nothing is left of it if
/// the program ends before. Returns 0, the errno of what went wrong, or nothing where there are no
/// such files.
std::optional<int> replaceByNameless(const fs::path& path, const fs::path& folder,
                                     std::string_view bytes) {
  const int file = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (file < 0) return std::nullopt;
  struct stat old{};
  if (::stat(path.c_str(), &old) == 0) std::ignore = ::fchmod(file, old.st_mode & 0777);
  const std::string self = fmt::format("/proc/self/fd/{}", file);
  std::optional<int> code = writeAll(file, bytes);
  fs::path name;
  for (int number = 0; code == 0 && number < kMostTemporaries; ++number) {
    name = temporaryName(folder, number);
    if (::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) break;
    if (errno != EEXIST) code = std::nullopt;
    name.clear();
  }
  if (::close(file) != 0 && code == 0) code = errno;
  if (name.empty()) return code == 0 ? EEXIST : code;
  if (code == 0 && ::rename(name.c_str(), path.c_str()) != 0) code = errno;
  if (code != 0) ::unlink(name.c_str());
  return code;
}

#else

std::optional<int> replaceByNameless(const fs::path&, const fs::path&, std::string_view) {
  return std::nullopt;
}

#endif

Result<void> replaceFile(const fs::path& path, std::string_view bytes) {
  const fs::path folder = folderOf(path);
  // A folder's permissions alone would let a write-protected file be replaced.
  if (allows(path, F_OK) && !allows(path, W_OK)) return cannotWrite(path, errno);
  if (const auto code = replaceByNameless(path, folder, bytes)) {
    if (*code == 0) return {};
    return cannotWrite(path, *code);
  }
  Temporary temporary = createTemporary(folder);
  if (!temporary.file) return cannotCreate(path, folder, temporary.code);
  std::error_code error, ignored;
  // Set before it holds anything that others may not be allowed to read.
  if (const fs::file_status old = fs::status(path, ignored); fs::exists(old))
    fs::permissions(temporary.path, old.permissions() & fs::perms::all, ignored);
  if (const int code = writeAll(std::move(temporary.file), bytes)) {
    fs::remove(temporary.path, ignored);
    return cannotWrite(path, code);
  }
  fs::rename(temporary.path, path, error);
  if (!error) return {};
  fs::remove(temporary.path, ignored);
  return cannotWrite(path, error.default_error_condition().value());
}

/// What a link finally points to, which need not exist; an empty path if links form a cycle.
fs::path pointedTo(fs::path path) {
  constexpr int kMostLinks = 40;  // as many as Linux follows
  std::error_code error;
  for (int links = 0; links <= kMostLinks; ++links) {
    if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
    const fs::path next = fs::read_symlink(path, error);
    if (error) return path;
    path = path.parent_path() / next;
  }
  return {};
}

}  // namespace

fs::path utf8Path(std::string_view text) { return std::u8string(text.begin(), text.end()); }

Result<std::string> readFile(const fs::path& path) {
  const auto cannotRead = [&](std::string_view why) {
    return fail(fmt::format("Cannot read {}: {}.", path.string(), why));
  };
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    return cannotRead("there is no such file; check the name");
  if (fs::is_directory(status)) return cannotRead("it is a folder; name a file in it");
  const File file = opened(path, O_RDONLY, "rb");
  if (!file) return cannotRead(reason(errno) + (errno == EACCES ? "; change its permissions" : ""));

  std::string bytes;
  constexpr const char* isTooLarge = "it is larger than 2 GiB";
  const auto size = fs::file_size(path, error);
  if (!error && size > io::maxFileBytes) return cannotRead(isTooLarge);
  if (!error) bytes.reserve(static_cast<std::size_t>(size));
  std::array<char, 1 << 16> chunk;
  while (const std::size_t count = std::fread(chunk.data(), 1, chunk.size(), file.get())) {
    bytes.append(chunk.data(), count);
    if (bytes.size() > io::maxFileBytes) return cannotRead(isTooLarge);
  }
  if (std::ferror(file.get())) return cannotRead(reason(errno));
  return bytes;
}

bool isGltf(const fs::path& path) {
  const std::string kind = extensionOf(path);
  return kind == ".glb" || kind == ".gltf" || kind == ".vrm";
}

std::string extensionOf(const fs::path& path) {
  std::string text = path.extension().string();
  if (const std::string name = path.filename().string(); text.empty() && name.starts_with('.'))
    text = name;
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

Result<void> writeFile(const fs::path& path, std::string_view bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status))
    return fail(fmt::format("Cannot write {}: it is a folder; name a file.", path.string()));
  if (!path.has_filename()) return fail("Cannot write a file without a name.");
  // Devices and pipes are written to directly, not replaced; for a link, its target is replaced.
  if (fs::exists(status) && !fs::is_regular_file(status)) return writeDirectly(path, bytes);
  const fs::path pointed = pointedTo(path);
  if (pointed.empty())
    return fail(
        fmt::format("Cannot write {}: it is a link that leads round in a circle; remove it "
                    "or choose another name.",
                    path.string()));
  return replaceFile(pointed, bytes);
}

}  // namespace sweepface
