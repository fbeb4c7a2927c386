/* SPDX-License-Identifier: BSD-3-Clause */
/* The calls that a directory of results is made of, which fail when a test says so (linked with
 * --wrap of each). For one file of a test program. */
#ifndef CAPSTAN_TEST_FAULT_REFUSE_FILES_H
#define CAPSTAN_TEST_FAULT_REFUSE_FILES_H

#include <dirent.h>
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* The call that fails, counted from 0, and how. */
static long calls, fails_at = -1;
static int why;
/* No error of the system: a write takes no bytes and gives no reason. */
enum { NOTHING_WRITTEN = 9999 };

static bool fails(void) {
    if (calls++ != fails_at) return false;
    errno = why;
    return true;
}

#define CALL(type, name, failure, parameters, arguments) \
    type __real_##name parameters;                       \
    type __wrap_##name parameters;                       \
    type __wrap_##name parameters { return fails() ? (failure) : __real_##name arguments; }
CALL(ssize_t, read, -1, (int file, void *to, size_t size), (file, to, size))
CALL(int, fstat, -1, (int file, struct stat *about), (file, about))
CALL(int, fstatat, -1, (int at, const char *path, struct stat *about, int how),
     (at, path, about, how))

/* The disk is not waited for: what is tried is what follows a refusal, thousands of times. */
int __wrap_fsync(int file);
int __wrap_fsync(int file) {
    (void)file;
    return fails() ? -1 : 0;
}
CALL(int, flock, -1, (int file, int how), (file, how))
CALL(int, fflush, EOF, (FILE * file), (file))
CALL(int, renameat, -1, (int at, const char *from, int to, const char *name), (at, from, to, name))
CALL(int, unlinkat, -1, (int at, const char *path, int how), (at, path, how))
CALL(int, mkdir, -1, (const char *path, mode_t mode), (path, mode))
CALL(FILE *, fdopen, NULL, (int file, const char *how), (file, how))
CALL(DIR *, fdopendir, NULL, (int file), (file))
CALL(struct dirent *, readdir, NULL, (DIR * listing), (listing))

int __real_openat(int at, const char *path, int how, ...);
int __wrap_openat(int at, const char *path, int how, ...);
int __wrap_openat(int at, const char *path, int how, ...) {
    return fails() ? -1 : __real_openat(at, path, how, 0666);
}

/* Half of what is to be written goes onto a full disk. */
ssize_t __real_write(int file, const void *from, size_t size);
ssize_t __wrap_write(int file, const void *from, size_t size);
ssize_t __wrap_write(int file, const void *from, size_t size) {
    if (!fails()) return __real_write(file, from, size);
    if (why == NOTHING_WRITTEN) {
        errno = 0;
        return 0;
    }
    if (why != ENOSPC) return -1;
    errno = 0; /* a part that is written is no error */
    return __real_write(file, from, size / 2);
}

#endif
