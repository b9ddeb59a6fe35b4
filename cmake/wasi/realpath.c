// The path without links, `.` and `..`, as POSIX defines it; wasi-libc lacks this function.
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { kMostLinks = 40 };

/// Puts `rest` behind the text in `first`, in `left`, which has PATH_MAX bytes.
static int joined(char* left, const char* first, size_t length, const char* rest) {
  const size_t more = strlen(rest);
  if (length + 1 + more >= PATH_MAX) {
    errno = ENAMETOOLONG;
    return 0;
  }
  memmove(left + length + 1, rest, more + 1);
  memmove(left, first, length);
  left[length] = '/';
  return 1;
}

char* realpath(const char* path, char* resolved) {
  char left[PATH_MAX], done[PATH_MAX] = "", link[PATH_MAX];
  if (!*path) {
    errno = ENOENT;
    return NULL;
  }
  if (*path == '/') {
    if (!joined(left, "", 0, path)) return NULL;
  } else if (!getcwd(left, sizeof left) || !joined(left, left, strlen(left), path)) {
    return NULL;
  }
  size_t length = 0;  // of what is done
  int links = 0;
  for (const char* next = left; *next;) {
    next += strspn(next, "/");
    const size_t word = strcspn(next, "/");
    if (word == 0) break;
    const char* const after = next + word;
    if (word == 1 && *next == '.') {
      next = after;
      continue;
    }
    if (word == 2 && next[0] == '.' && next[1] == '.') {
      while (length > 0 && done[--length] != '/') continue;
      done[length] = 0;
      next = after;
      continue;
    }
    if (length + 1 + word >= PATH_MAX) {
      errno = ENAMETOOLONG;
      return NULL;
    }
    const size_t before = length;
    done[length] = '/';
    memcpy(done + length + 1, next, word);
    length += 1 + word;
    done[length] = 0;
    struct stat what;
    if (lstat(done, &what) != 0) return NULL;
    if (!S_ISLNK(what.st_mode)) {
      next = after;
      continue;
    }
    const ssize_t size = readlink(done, link, sizeof link - 1);
    if (size < 0) return NULL;
    if (++links > kMostLinks) {
      errno = ELOOP;
      return NULL;
    }
    link[size] = 0;
    length = *link == '/' ? 0 : before;
    done[length] = 0;
    if (!joined(left, link, (size_t)size, after)) return NULL;
    next = left;
  }
  if (length == 0) strcpy(done, "/");
  if (!resolved) return strdup(done);
  return strcpy(resolved, done);
}
