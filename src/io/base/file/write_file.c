/* SPDX-License-Identifier: BSD-3-Clause */
/* One file that is written completely or not at all: under another name, synced, renamed. */
#include "io/base/file/write_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/status.h"
#include "capstan/io.h"
#include "io/base/yaml/yaml.h"

static CpsStatus fail(const char *path, int code, CpsError *err) {
    return cpsi_fail_at(err, CPS_ERR_IO, path, 0, 0, "cannot write: %s", strerror(code));
}

int cpsi_close_stream(FILE *stream, bool sync) {
    const bool before = ferror(stream) != 0; /* then errno is that of the write that failed */
    if (!before) errno = 0;
    const bool failed = before || fflush(stream) != 0 || (sync && fsync(fileno(stream)) != 0);
    int code = failed ? (errno ? errno : EIO) : 0;
    errno = 0;
    if (fclose(stream) != 0 && code == 0) code = errno ? errno : EIO;
    return code;
}

/* Write into an open file and close it; *code: errno of a failure, 0 after success. */
static CpsStatus write_and_close(CpsFileWriter *write, void *user, int fd, bool sync, int *code,
                                 CpsError *err) {
    FILE *out = fdopen(fd, "w");
    *code = errno;
    if (!out) {
        close(fd);
        return CPS_OK;
    }
    errno = 0;
    const CpsStatus status = write(user, out, err);
    *code = cpsi_close_stream(out, sync);
    return status;
}

/* "folder/.name.PID.part" for "folder/name"; NULL when memory does not suffice */
static char *name_beside(const char *path) {
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const size_t size = strlen(path) + 40;
    char *beside = malloc(size);
    if (beside)
        snprintf(beside, size, "%.*s.%s.%ld.part", (int)(name - path), path, name, (long)getpid());
    return beside;
}

static CpsStatus write_beside(const char *path, CpsFileWriter *write, void *user, CpsError *err) {
    char *beside = name_beside(path);
    if (!beside) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    int code = 0;
    CpsStatus status = CPS_OK;
    const int fd = open(beside, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd < 0) {
        code = errno;
    } else {
        status = write_and_close(write, user, fd, true, &code, err);
        if (status == CPS_OK && code == 0 && rename(beside, path) != 0) code = errno;
        if (status != CPS_OK || code != 0) unlink(beside);
    }
    free(beside);
    return status == CPS_OK && code != 0 ? fail(path, code, err) : status;
}

/* Whether `path` is a link to the file that is open as standard output, as /dev/stdout is. The link
 * must not be replaced. */
static bool leads_to_output(const char *path, const struct stat *found) {
    struct stat link, output;
    return lstat(path, &link) == 0 && S_ISLNK(link.st_mode) && fstat(STDOUT_FILENO, &output) == 0 &&
           output.st_dev == found->st_dev && output.st_ino == found->st_ino;
}

CpsStatus cps_write_file(const char *path, CpsFileWriter *write, void *user, CpsError *err) {
    if (!path || !write) return cpsi_fail(err, CPS_ERR_ARGUMENT, "path or write is NULL");
    struct stat found;
    const bool there = stat(path, &found) == 0;
    if (there && S_ISDIR(found.st_mode)) return fail(path, EISDIR, err);
    const bool output = there && S_ISREG(found.st_mode) && leads_to_output(path, &found);
    if (!there || (S_ISREG(found.st_mode) && !output)) return write_beside(path, write, user, err);

    /* a device or pipe, or standard output itself, which goes on behind what has been printed */
    const int fd = output ? fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)
                          : open(path, O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (fd < 0) return fail(path, errno, err);
    int code = 0;
    const CpsStatus status = write_and_close(write, user, fd, false, &code, err);
    return status == CPS_OK && code != 0 ? fail(path, code, err) : status;
}
