// A preloaded library for scripts/hardening/inject-faults. It counts the program's file operations, and makes
// one of them fail or kills the program before it. It can also make the clock jump.
//
//   FAULT_COUNT=FILE  write the number of operations to FILE when the program ends
//   FAULT_AT=N        inject the fault at the N-th operation
//   FAULT_ERRNO=E     the operation fails with error E; with 0 the program is killed before the operation
//   FAULT_LASTS=K     the next K operations fail, too
//   FAULT_OF=NAME     count and fail only operations of this name, such as rename
//   CLOCK_JUMPS=C     the wall clock (C = 1), or both clocks (C = 2), jump by up to ten years at each reading

#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <time.h>
#include <unistd.h>

static atomic_long operations;

static long setting(const char* name) {
  const char* text = getenv(name);
  return text == NULL ? -1 : atol(text);
}

// Whether the present operation fails. Removals never fail, because they need no disk space.
static int fails(const char* name, int is_removal) {
  const char* only = getenv("FAULT_OF");
  if (only != NULL && strcmp(only, name) != 0) return 0;
  const long now = atomic_fetch_add(&operations, 1) + 1, at = setting("FAULT_AT");
  if (at < 0 || now < at || now > at + (setting("FAULT_LASTS") > 0 ? setting("FAULT_LASTS") : 0)) return 0;
  const long error = setting("FAULT_ERRNO");
  if (error == 0) kill(getpid(), SIGKILL);
  if (is_removal) return 0;
  errno = (int)error;
  return 1;
}

__attribute__((destructor)) static void tell(void) {
  const char* path = getenv("FAULT_COUNT");
  if (path == NULL) return;
  char text[32];
  const int length = snprintf(text, sizeof text, "%ld", atomic_load(&operations));
  const long file = syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  syscall(SYS_write, file, text, length);
  syscall(SYS_close, file);
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

#define ON_FILE(type, name, parameters, arguments)     \
  type name parameters {                               \
    if (file > 2 && fails(#name, 0)) return -1;        \
    return ((type(*) parameters)dlsym(RTLD_NEXT, #name)) arguments; \
  }
ON_FILE(ssize_t, write, (int file, const void* data, size_t size), (file, data, size))
ON_FILE(ssize_t, writev, (int file, const struct iovec* parts, int count), (file, parts, count))
ON_FILE(ssize_t, pwrite, (int file, const void* data, size_t size, off_t at), (file, data, size, at))
ON_FILE(ssize_t, pwrite64, (int file, const void* data, size_t size, off_t at), (file, data, size, at))
ON_FILE(int, ftruncate, (int file, off_t size), (file, size))
ON_FILE(int, ftruncate64, (int file, off_t size), (file, size))
ON_FILE(int, fsync, (int file), (file))
ON_FILE(int, fdatasync, (int file), (file))

#define ON_NAME(name, parameters, arguments, is_removal) \
  int name parameters {                                  \
    if (fails(#name, is_removal)) return -1;             \
    return ((int(*) parameters)dlsym(RTLD_NEXT, #name)) arguments; \
  }
ON_NAME(rename, (const char* from, const char* to), (from, to), 0)
ON_NAME(link, (const char* from, const char* to), (from, to), 0)
ON_NAME(mkdir, (const char* path, mode_t mode), (path, mode), 0)
ON_NAME(mkostemp, (char* pattern, int flags), (pattern, flags), 0)
ON_NAME(mkostemp64, (char* pattern, int flags), (pattern, flags), 0)
ON_NAME(unlink, (const char* path), (path), 1)
ON_NAME(remove, (const char* path), (path), 1)

#define OPEN(name)                                                             \
  int name(const char* path, int flags, ...) {                                 \
    va_list more;                                                              \
    va_start(more, flags);                                                     \
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;     \
    va_end(more);                                                              \
    if ((flags & O_ACCMODE) != O_RDONLY && fails(#name, 0)) return -1;         \
    return ((int (*)(const char*, int, ...))dlsym(RTLD_NEXT, #name))(path, flags, mode); \
  }
OPEN(open)
OPEN(open64)

#define FOPEN(name)                                              \
  FILE* name(const char* path, const char* mode) {               \
    if (strpbrk(mode, "wa+") != NULL && fails(#name, 0)) return NULL; \
    return ((FILE * (*)(const char*, const char*)) dlsym(RTLD_NEXT, #name))(path, mode); \
  }
FOPEN(fopen)
FOPEN(fopen64)

static time_t jump(int is_steady) {
  static atomic_uint state = 1;
  if (setting("CLOCK_JUMPS") < (is_steady ? 2 : 1)) return 0;
  const unsigned next = atomic_fetch_add(&state, 1) * 2654435761u;
  return (time_t)(next % 630720000u) - 315360000;
}

int clock_gettime(clockid_t clock, struct timespec* now) {
  const int result = REAL(clock_gettime)(clock, now);
  const int is_of_day = clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE;
  if (is_of_day || clock == CLOCK_MONOTONIC) now->tv_sec += jump(!is_of_day);
  return result;
}

int gettimeofday(struct timeval* now, void* zone) {
  const int result = REAL(gettimeofday)(now, zone);
  now->tv_sec += jump(0);
  return result;
}

time_t time(time_t* to) {
  const time_t now = REAL(time)(NULL) + jump(0);
  if (to != NULL) *to = now;
  return now;
}
