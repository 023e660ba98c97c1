// Preloaded into a program (LD_PRELOAD), makes its Nth call on a file of one folder fail: open, read, write, rename and
// so on. COTAN_FAIL_FOLDER: the folder; COTAN_FAIL_CALL: N, from 1 on, or 0 for none; COTAN_FAIL_LOG: a file to which
// each process appends a line with the names of its calls when it ends. Used by tests/failing_calls_test.py.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum { kMaxFiles = 4096, kMaxCalls = 4096 };
static atomic_long calls;
static const char* names[kMaxCalls];
static atomic_char ours[kMaxFiles]; // by descriptor: whether it is a file of the folder
static long failing;
static char folder[PATH_MAX];

__attribute__((constructor)) static void begin(void)
{
    const char* text = getenv("COTAN_FAIL_CALL");
    failing = text ? atol(text) : 0;
    text = getenv("COTAN_FAIL_FOLDER");
    strncpy(folder, text ? text : "", sizeof folder - 1);
}

__attribute__((destructor)) static void end(void)
{
    const char* log = getenv("COTAN_FAIL_LOG");
    FILE* (*real)(const char*, const char*) = (FILE * (*)(const char*, const char*)) dlsym(RTLD_NEXT, "fopen");
    FILE* file = log ? real(log, "a") : NULL;
    if (file) {
        for (long i = 0; i < calls && i < kMaxCalls; ++i)
            fprintf(file, "%s ", names[i] ? names[i] : "?");
        fputc('\n', file);
        fclose(file);
    }
}

static int isOurs(const char* path)
{
    return path && folder[0] && (path[0] != '/' || strncmp(path, folder, strlen(folder)) == 0);
}

static int fails(const char* name, int error)
{
    const long call = atomic_fetch_add(&calls, 1);
    if (call < kMaxCalls)
        names[call] = name;
    if (call + 1 != failing)
        return 0;
    errno = error;
    return 1;
}

static void mark(int file, int mine)
{
    if (file >= 0 && file < kMaxFiles)
        ours[file] = (char)mine;
}

static int marked(int file) { return file >= 0 && file < kMaxFiles && ours[file]; }

#define REAL(type, name, ...) type (*real)(__VA_ARGS__) = (type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, name)

static int opened(int file, const char* path)
{
    mark(file, isOurs(path));
    return file;
}

#define OPEN(name)                                                                                                     \
    int name(const char* path, int flags, ...)                                                                         \
    {                                                                                                                  \
        va_list rest;                                                                                                  \
        va_start(rest, flags);                                                                                         \
        const mode_t mode = va_arg(rest, mode_t);                                                                      \
        va_end(rest);                                                                                                  \
        REAL(int, #name, const char*, int, ...);                                                                       \
        if (isOurs(path) && fails(#name, flags & (O_WRONLY | O_RDWR) ? ENOSPC : EACCES))                               \
            return -1;                                                                                                 \
        return opened(real(path, flags, mode), path);                                                                  \
    }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                                                                                   \
    int name(int at, const char* path, int flags, ...)                                                                 \
    {                                                                                                                  \
        va_list rest;                                                                                                  \
        va_start(rest, flags);                                                                                         \
        const mode_t mode = va_arg(rest, mode_t);                                                                      \
        va_end(rest);                                                                                                  \
        REAL(int, #name, int, const char*, int, ...);                                                                  \
        if (isOurs(path) && fails(#name, flags & (O_WRONLY | O_RDWR) ? ENOSPC : EACCES))                               \
            return -1;                                                                                                 \
        return opened(real(at, path, flags, mode), path);                                                              \
    }
OPENAT(openat)
OPENAT(openat64)

#define FOPEN(name)                                                                                                    \
    FILE* name(const char* path, const char* mode)                                                                     \
    {                                                                                                                  \
        REAL(FILE*, #name, const char*, const char*);                                                                  \
        if (isOurs(path) && fails(#name, mode[0] == 'r' ? EACCES : ENOSPC))                                            \
            return NULL;                                                                                               \
        FILE* file = real(path, mode);                                                                                 \
        if (file)                                                                                                      \
            opened(fileno(file), path);                                                                                \
        return file;                                                                                                   \
    }
FOPEN(fopen)
FOPEN(fopen64)

// Forwards to the real function unless this call must fail. mine: whether the call concerns a file of the folder.
#define FAILING(type, name, mine, error, parameters, arguments, ...)                                                   \
    type name parameters                                                                                               \
    {                                                                                                                  \
        REAL(type, #name, __VA_ARGS__);                                                                                \
        if (mine && fails(#name, error))                                                                               \
            return -1;                                                                                                 \
        return real arguments;                                                                                         \
    }
#define ON_FILE(type, name, ...) FAILING(type, name, marked(file), __VA_ARGS__)
#define ON_PATH(name, ...) FAILING(int, name, isOurs(to), EACCES, __VA_ARGS__)
ON_FILE(ssize_t, read, EIO, (int file, void* to, size_t size), (file, to, size), int, void*, size_t)
ON_FILE(ssize_t, pread, EIO, (int file, void* to, size_t size, off_t at), (file, to, size, at), int, void*, size_t,
        off_t)
ON_FILE(ssize_t, pread64, EIO, (int file, void* to, size_t size, off64_t at), (file, to, size, at), int, void*, size_t,
        off64_t)
ON_FILE(ssize_t, write, ENOSPC, (int file, const void* from, size_t size), (file, from, size), int, const void*, size_t)
ON_FILE(ssize_t, writev, ENOSPC, (int file, const struct iovec* from, int count), (file, from, count), int,
        const struct iovec*, int)
ON_FILE(ssize_t, pwrite, ENOSPC, (int file, const void* from, size_t size, off_t at), (file, from, size, at), int,
        const void*, size_t, off_t)
ON_FILE(ssize_t, pwrite64, ENOSPC, (int file, const void* from, size_t size, off64_t at), (file, from, size, at), int,
        const void*, size_t, off64_t)
ON_FILE(int, ftruncate, ENOSPC, (int file, off_t size), (file, size), int, off_t)
ON_FILE(int, ftruncate64, ENOSPC, (int file, off64_t size), (file, size), int, off64_t)
ON_FILE(int, fsync, EIO, (int file), (file), int)
ON_FILE(int, fdatasync, EIO, (int file), (file), int)

int close(int file)
{
    REAL(int, "close", int);
    mark(file, 0);
    return real(file);
}

size_t fread(void* to, size_t size, size_t count, FILE* file)
{
    REAL(size_t, "fread", void*, size_t, size_t, FILE*);
    if (marked(fileno(file)) && fails("fread", EIO))
        return 0;
    return real(to, size, count, file);
}

size_t fwrite(const void* from, size_t size, size_t count, FILE* file)
{
    REAL(size_t, "fwrite", const void*, size_t, size_t, FILE*);
    if (marked(fileno(file)) && fails("fwrite", ENOSPC))
        return 0;
    return real(from, size, count, file);
}

int fclose(FILE* file)
{
    REAL(int, "fclose", FILE*);
    const int mine = marked(fileno(file));
    mark(fileno(file), 0);
    const int result = real(file);
    return mine && fails("fclose", ENOSPC) ? EOF : result;
}

ON_PATH(rename, (const char* from, const char* to), (from, to), const char*, const char*)
ON_PATH(renameat, (int a, const char* from, int b, const char* to), (a, from, b, to), int, const char*, int,
        const char*)
ON_PATH(link, (const char* from, const char* to), (from, to), const char*, const char*)
ON_PATH(linkat, (int a, const char* from, int b, const char* to, int flags), (a, from, b, to, flags), int, const char*,
        int, const char*, int)
ON_PATH(mkdir, (const char* to, mode_t mode), (to, mode), const char*, mode_t)
