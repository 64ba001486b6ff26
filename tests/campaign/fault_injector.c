/* Makes one allocation or one write of a program fail: loaded before it with LD_PRELOAD.

   DASHPOT_FAULT        "allocation" or "write": what fails
   DASHPOT_FAULT_AT     which one fails, counted from 1 and from the start of main(); 0: none
   DASHPOT_FAULT_ON     "1": all after it fail, too, as when memory or disk stay full
   DASHPOT_FAULT_COUNT  a file that gets how many allocations and how many writes could have failed
   DASHPOT_FAULT_IN     the name of a program that is started from within, which it happens in

   A write is a call of write, pwrite, ftruncate, fsync, fdatasync, close or rename on anything but
   the standard streams. Other programs that are started from within are left alone. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/types.h>

void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

static atomic_int active;      /* between the start and the end of main() */
static atomic_long points[2];  /* of allocations and of writes that have been passed */
static int of_writes, goes_on; /* what fails, and whether all after it do */
static long fails_at;
static char count_file[4096];
static int (*program_main)(int, char**, char**);

static int fails(int is_write) {
  if (!active) return 0;
  const long point = atomic_fetch_add(&points[is_write], 1) + 1;
  return is_write == of_writes && fails_at > 0 &&
         (point == fails_at || (goes_on && point > fails_at));
}

/* ---- Allocations */

static int no_memory(void) {
  if (!fails(0)) return 0;
  errno = ENOMEM;
  return 1;
}

void* malloc(size_t size) { return no_memory() ? NULL : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return no_memory() ? NULL : __libc_calloc(count, size); }
void* realloc(void* old, size_t size) { return no_memory() ? NULL : __libc_realloc(old, size); }
void* memalign(size_t alignment, size_t size) {
  return no_memory() ? NULL : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** to, size_t alignment, size_t size) {
  if (no_memory()) return ENOMEM;
  *to = __libc_memalign(alignment, size);
  return *to ? 0 : ENOMEM;
}

/* ---- Writes: each fails with `reason`, or goes on to the library's function of that name. */

static int no_room(int descriptor, int reason) {
  if (descriptor >= 0 && descriptor <= STDERR_FILENO) return 0;
  if (!fails(1)) return 0;
  errno = reason;
  return 1;
}

#define NEXT(type, name) ((type)dlsym(RTLD_NEXT, name))

ssize_t write(int to, const void* bytes, size_t count) {
  static ssize_t (*next)(int, const void*, size_t);
  if (!next) next = NEXT(ssize_t (*)(int, const void*, size_t), "write");
  return no_room(to, ENOSPC) ? -1 : next(to, bytes, count);
}

ssize_t pwrite(int to, const void* bytes, size_t count, off_t at) {
  static ssize_t (*next)(int, const void*, size_t, off_t);
  if (!next) next = NEXT(ssize_t (*)(int, const void*, size_t, off_t), "pwrite");
  return no_room(to, ENOSPC) ? -1 : next(to, bytes, count, at);
}
ssize_t pwrite64(int to, const void* bytes, size_t count, off_t at) {
  return pwrite(to, bytes, count, at);
}

int ftruncate(int file, off_t size) {
  static int (*next)(int, off_t);
  if (!next) next = NEXT(int (*)(int, off_t), "ftruncate");
  return no_room(file, ENOSPC) ? -1 : next(file, size);
}
int ftruncate64(int file, off_t size) { return ftruncate(file, size); }

int fsync(int file) {
  static int (*next)(int);
  if (!next) next = NEXT(int (*)(int), "fsync");
  return no_room(file, EIO) ? -1 : next(file);
}

int fdatasync(int file) {
  static int (*next)(int);
  if (!next) next = NEXT(int (*)(int), "fdatasync");
  return no_room(file, EIO) ? -1 : next(file);
}

/* The descriptor is gone, whatever close() says. */
int close(int file) {
  static int (*next)(int);
  if (!next) next = NEXT(int (*)(int), "close");
  const int result = next(file);
  return no_room(file, EIO) ? -1 : result;
}

int rename(const char* from, const char* to) {
  static int (*next)(const char*, const char*);
  if (!next) next = NEXT(int (*)(const char*, const char*), "rename");
  return no_room(-1, EIO) ? -1 : next(from, to);
}

/* ---- From the start of main() to its end */

static long number_of(const char* name) {
  const char* text = getenv(name);
  return text ? atol(text) : 0;
}

/* Whether the numbers of points are told, where they are asked for. */
static int tells_points(void) {
  active = 0;
  if (!count_file[0]) return 1;
  struct rlimit size; /* a program may have forbidden itself to write files */
  if (getrlimit(RLIMIT_FSIZE, &size) == 0)
    size.rlim_cur = size.rlim_max, setrlimit(RLIMIT_FSIZE, &size);
  const int to = open(count_file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  char text[64];
  const int length = snprintf(text, sizeof text, "%ld %ld\n", (long)points[0], (long)points[1]);
  return to >= 0 && write(to, text, (size_t)length) == length;
}

/* A program may leave without coming back from main(). */
void _exit(int code) {
  syscall(SYS_exit_group, tells_points() ? code : 125);
  __builtin_unreachable();
}

static int watched_main(int count, char** words, char** environment) {
  const char* what = getenv("DASHPOT_FAULT");
  const char* file = getenv("DASHPOT_FAULT_COUNT");
  const char* in = getenv("DASHPOT_FAULT_IN");
  if (in && in[0] && strcmp(in, program_invocation_short_name) != 0)
    return program_main(count, words, environment);

  of_writes = what && strcmp(what, "write") == 0;
  fails_at = number_of("DASHPOT_FAULT_AT");
  goes_on = number_of("DASHPOT_FAULT_ON") == 1;
  if (file) snprintf(count_file, sizeof count_file, "%s", file);
  unsetenv("LD_PRELOAD");

  active = 1;
  const int result = program_main(count, words, environment);
  return tells_points() ? result : 125;
}

int __libc_start_main(int (*main)(int, char**, char**), int count, char** words,
                      void (*first)(void), void (*last)(void), void (*linker)(void), void* stack) {
  typedef int (*Start)(int (*)(int, char**, char**), int, char**, void (*)(void), void (*)(void),
                       void (*)(void), void*);
  program_main = main;
  return NEXT(Start, "__libc_start_main")(watched_main, count, words, first, last, linker, stack);
}
