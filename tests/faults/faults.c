// Preloaded into the program, this makes the system fail.
//
// FAULT_COUNTS=FILE counts the calls of each kind into FILE: one 64-bit number a kind, in the order
// of kinds[] below. Programs of other names that it starts are left alone: gnuplot does not notice a
// write that fails, so that carom looks whether a plot has its end.
// FAULT=KIND:N fails the N-th call of that kind, once: `write` with "No space left on device",
// `open` with "Too many open files", `thread` with EAGAIN, `alloc`, `memory` and `map` with ENOMEM,
// `library` as a library that is not there, the others with an input/output error.
//
// FAIL_THREAD=3 fails the third thread that is made, 3+ that and all after it;
// FAIL_LIBRARY=avcodec,EGL fails to load the libraries whose names hold one of these words.
//
// What C's own library does for itself (stdio's writes below fwrite, malloc's maps, the loader's
// opens) goes not through here; its callers do.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum kind { WRITE, SYNC, RENAME, OPEN, MAP, ALLOC, MEMORY, THREAD, LIBRARY, FOLDER, KINDS };
static const char *const kinds[KINDS] = {"write", "sync",   "rename", "open",    "map",
                                         "alloc", "memory", "thread", "library", "folder"};
static const int errors[KINDS] = {ENOSPC, EIO, EIO, EMFILE, ENOMEM, ENOMEM, ENOMEM, EAGAIN, 0, EIO};

static const size_t large = 1 << 16;  // bytes, of an allocation that counts

static int64_t own_counts[KINDS];
static int64_t *counts = own_counts;
static int failing_kind = -1;
static int64_t failing_number;

__attribute__((constructor)) static void begin(void) {
    if (strcmp(program_invocation_short_name, "carom") != 0) return;
    const char *file = getenv("FAULT_COUNTS"), *fault = getenv("FAULT");
    if (file) {
        int (*real_open)(const char *, int, ...) = dlsym(RTLD_NEXT, "open");
        void *(*real_mmap)(void *, size_t, int, int, int, off_t) = dlsym(RTLD_NEXT, "mmap");
        const int descriptor = real_open(file, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        if (descriptor >= 0 && ftruncate(descriptor, sizeof own_counts) == 0) {
            void *shared = real_mmap(NULL, sizeof own_counts, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
            if (shared != MAP_FAILED) counts = shared;
        }
        if (descriptor >= 0) close(descriptor);
    }
    const char *number = fault ? strchr(fault, ':') : NULL;
    for (int kind = 0; number && kind < KINDS; ++kind)
        if (strlen(kinds[kind]) == (size_t)(number - fault) && strncmp(kinds[kind], fault, number - fault) == 0) {
            failing_number = atoll(number + 1);
            failing_kind = kind;
        }
}

// True for the call that is to fail, with errno set.
static int fails(enum kind kind) {
    const int64_t number = __atomic_add_fetch(&counts[kind], 1, __ATOMIC_SEQ_CST);
    if ((int)kind != failing_kind || number != failing_number) return 0;
    errno = errors[kind];
    return 1;
}

#define REAL(type, name, ...)                                  \
    static type (*real)(__VA_ARGS__);                          \
    if (!real) real = (type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, name)

// ---- Writing ------------------------------------------------------------------------------------
ssize_t write(int file, const void *bytes, size_t count) {
    REAL(ssize_t, "write", int, const void *, size_t);
    return fails(WRITE) ? -1 : real(file, bytes, count);
}
ssize_t pwrite(int file, const void *bytes, size_t count, off_t at) {
    REAL(ssize_t, "pwrite", int, const void *, size_t, off_t);
    return fails(WRITE) ? -1 : real(file, bytes, count, at);
}
ssize_t pwrite64(int file, const void *bytes, size_t count, off64_t at) {
    REAL(ssize_t, "pwrite64", int, const void *, size_t, off64_t);
    return fails(WRITE) ? -1 : real(file, bytes, count, at);
}
ssize_t writev(int file, const struct iovec *parts, int count) {
    REAL(ssize_t, "writev", int, const struct iovec *, int);
    return fails(WRITE) ? -1 : real(file, parts, count);
}
size_t fwrite(const void *bytes, size_t size, size_t count, FILE *file) {
    REAL(size_t, "fwrite", const void *, size_t, size_t, FILE *);
    return fails(WRITE) ? 0 : real(bytes, size, count, file);
}
int fflush(FILE *file) {
    REAL(int, "fflush", FILE *);
    return file && fails(WRITE) ? EOF : real(file);
}
int ftruncate(int file, off_t length) {
    REAL(int, "ftruncate", int, off_t);
    return fails(WRITE) ? -1 : real(file, length);
}

// ---- To the disk, and under its name ------------------------------------------------------------
int fsync(int file) {
    REAL(int, "fsync", int);
    return fails(SYNC) ? -1 : real(file);
}
int fdatasync(int file) {
    REAL(int, "fdatasync", int);
    return fails(SYNC) ? -1 : real(file);
}
int rename(const char *from, const char *to) {
    REAL(int, "rename", const char *, const char *);
    return fails(RENAME) ? -1 : real(from, to);
}
int renameat2(int a, const char *from, int b, const char *to, unsigned flags) {
    REAL(int, "renameat2", int, const char *, int, const char *, unsigned);
    return fails(RENAME) ? -1 : real(a, from, b, to, flags);
}
int link(const char *from, const char *to) {
    REAL(int, "link", const char *, const char *);
    return fails(RENAME) ? -1 : real(from, to);
}
int mkdir(const char *path, mode_t mode) {
    REAL(int, "mkdir", const char *, mode_t);
    return fails(FOLDER) ? -1 : real(path, mode);
}
char *mkdtemp(char *path) {
    REAL(char *, "mkdtemp", char *);
    return fails(FOLDER) ? NULL : real(path);
}

// ---- Opening ------------------------------------------------------------------------------------
// libgcrypt, which FFmpeg's libraries bring, ends the process from its constructor where it cannot
// read whether the system is in FIPS mode.
static int is_fips(const char *path) { return strncmp(path, "/proc/sys/crypto/", 17) == 0; }

static mode_t mode_of(int flags, va_list list) {
    return flags & (O_CREAT | O_TMPFILE) ? va_arg(list, mode_t) : 0;
}
#define OPENS(name)                                \
    int name(const char *path, int flags, ...) {   \
        REAL(int, #name, const char *, int, ...);  \
        va_list list;                              \
        va_start(list, flags);                     \
        const mode_t mode = mode_of(flags, list);  \
        va_end(list);                              \
        return !is_fips(path) && fails(OPEN) ? -1 : real(path, flags, mode); \
    }
OPENS(open)
OPENS(open64)
#define OPENS_AT(name)                                    \
    int name(int folder, const char *path, int flags, ...) { \
        REAL(int, #name, int, const char *, int, ...);    \
        va_list list;                                     \
        va_start(list, flags);                            \
        const mode_t mode = mode_of(flags, list);         \
        va_end(list);                                     \
        return !is_fips(path) && fails(OPEN) ? -1 : real(folder, path, flags, mode); \
    }
OPENS_AT(openat)
OPENS_AT(openat64)
FILE *fopen(const char *path, const char *mode) {
    REAL(FILE *, "fopen", const char *, const char *);
    return !is_fips(path) && fails(OPEN) ? NULL : real(path, mode);
}
FILE *fopen64(const char *path, const char *mode) {
    REAL(FILE *, "fopen64", const char *, const char *);
    return !is_fips(path) && fails(OPEN) ? NULL : real(path, mode);
}

// ---- Memory -------------------------------------------------------------------------------------
void *mmap(void *at, size_t length, int protection, int flags, int file, off_t offset) {
    REAL(void *, "mmap", void *, size_t, int, int, int, off_t);
    return fails(MAP) ? MAP_FAILED : real(at, length, protection, flags, file, offset);
}
void *mmap64(void *at, size_t length, int protection, int flags, int file, off64_t offset) {
    REAL(void *, "mmap64", void *, size_t, int, int, int, off64_t);
    return fails(MAP) ? MAP_FAILED : real(at, length, protection, flags, file, offset);
}

// `memory`: large allocations of anybody, of drivers and libraries too.
extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
void *malloc(size_t size) { return size >= large && fails(MEMORY) ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) {
    return size && count >= large / size && fails(MEMORY) ? NULL : __libc_calloc(count, size);
}
void *realloc(void *old, size_t size) {
    return size >= large && fails(MEMORY) ? NULL : __libc_realloc(old, size);
}

// `alloc`: those of the program itself, by operator new.
void *_Znwm(size_t size) {
    REAL(void *, "_Znwm", size_t);
    static void (*bad_alloc)(void);
    if (size >= large) {
        Dl_info caller;
        const int ours = dladdr(__builtin_return_address(0), &caller) && caller.dli_fname &&
                         !strstr(caller.dli_fname, ".so");
        if (ours && fails(ALLOC)) {
            if (!bad_alloc) bad_alloc = (void (*)(void))dlsym(RTLD_DEFAULT, "_ZSt17__throw_bad_allocv");
            bad_alloc();
        }
    }
    return real(size);
}

// ---- Threads and libraries ----------------------------------------------------------------------
static int made;

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument) {
    REAL(int, "pthread_create", pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
    const char *wanted = getenv("FAIL_THREAD");
    if (wanted) {
        const int number = __atomic_add_fetch(&made, 1, __ATOMIC_SEQ_CST), first = atoi(wanted);
        if (number == first || (number > first && strchr(wanted, '+'))) return EAGAIN;
    }
    return fails(THREAD) ? EAGAIN : real(thread, attributes, start, argument);
}

void *dlopen(const char *name, int flags) {
    REAL(void *, "dlopen", const char *, int);
    const char *words = getenv("FAIL_LIBRARY");
    while (words && *words && name) {
        char word[64] = "";
        const size_t length = strcspn(words, ",");
        strncpy(word, words, length < sizeof word ? length : sizeof word - 1);
        if (strstr(name, word)) return real("/nowhere/lost.so", flags);
        words += length + (words[length] == ',');
    }
    return name && fails(LIBRARY) ? real("/nowhere/lost.so", flags) : real(name, flags);
}
