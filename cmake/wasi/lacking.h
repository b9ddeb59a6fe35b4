/* Included in front of everything: what wasi-libc lacks. WebAssembly's files have no permissions. */
#pragma once

#include <dirent.h>
#include <errno.h>
#include <sys/stat.h>

#ifndef DT_SOCK
#define DT_SOCK 20
#endif

#ifdef __cplusplus
extern "C" {
#endif

static inline int fchmod(int file, mode_t mode) {
  (void)file, (void)mode;
  errno = ENOSYS;
  return -1;
}

static inline int fchmodat(int folder, const char *path, mode_t mode, int flags) {
  (void)folder, (void)path, (void)mode, (void)flags;
  errno = ENOSYS;
  return -1;
}

/* POSIX's, in cmake/wasi/realpath.c. */
char *realpath(const char *path, char *resolved);

#ifdef __cplusplus
}
#endif
