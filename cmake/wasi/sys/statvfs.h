/* wasi-libc lacks this header, which libc++'s std::filesystem::space() includes. */
#pragma once

#include <errno.h>

struct statvfs {
  unsigned long f_frsize;
  unsigned long long f_blocks, f_bfree, f_bavail;
};

static inline int statvfs(const char *path, struct statvfs *space) {
  (void)path, (void)space;
  errno = ENOSYS;
  return -1;
}
