/* SPDX-License-Identifier: BSD-3-Clause */
/* All bytes of a regular file or of standard input (see read_file.h). */
#include "io/base/file/read_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/base/yaml/yaml.h"

static CpsStatus io_error(const char *file, const char *what, CpsError *err) {
    return cpsi_fail_at(err, CPS_ERR_IO, file, 0, 0, "%s", what);
}

/* Open a regular file. A FIFO must not block the program, a device must not be read. `how`: 0 or
 * O_NOFOLLOW. */
static CpsStatus open_regular(const char *path, int how, int *fd, CpsError *err) {
    *fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY | how);
    if (*fd < 0 && errno == ELOOP && how == O_NOFOLLOW)
        return io_error(path, "is a symbolic link, expected a file of this name itself", err);
    if (*fd < 0)
        return cpsi_fail_at(err, CPS_ERR_IO, path, 0, 0, "cannot open: %s", strerror(errno));
    struct stat about = {0};
    if (fstat(*fd, &about) == 0 && S_ISREG(about.st_mode)) return CPS_OK;
    const bool directory = S_ISDIR(about.st_mode);
    close(*fd);
    return io_error(path,
                    directory ? "is a directory, expected a file"
                              : "is not a regular file; '-' reads standard input",
                    err);
}

/* All bytes of fd and a zero byte after them. The buffer is doubled as needed, so that no given
 * size is trusted. */
static CpsStatus read_bytes(int fd, const char *file, size_t max_bytes, char **bytes, size_t *size,
                            CpsError *err) {
    size_t capacity = 4096, used = 0;
    char *buffer = malloc(capacity);
    while (buffer) {
        const ssize_t n = read(fd, buffer + used, capacity - used - 1);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) {
            free(buffer);
            return cpsi_fail_at(err, CPS_ERR_IO, file, 0, 0, "cannot read: %s", strerror(errno));
        }
        if (n == 0) {
            buffer[used] = '\0';
            *bytes = buffer;
            *size = used;
            return CPS_OK;
        }
        used += (size_t)n;
        if (used > max_bytes) {
            free(buffer);
            return cpsi_fail_at(err, CPS_ERR_LIMIT, file, 0, 0,
                                "is larger than %zu bytes, the limit", max_bytes);
        }
        if (used + 1 == capacity) {
            char *larger = capacity <= SIZE_MAX / 2 ? realloc(buffer, 2 * capacity) : NULL;
            if (!larger) free(buffer);
            buffer = larger;
            capacity *= 2;
        }
    }
    return cpsi_fail_at(err, CPS_ERR_MEMORY, file, 0, 0, "out of memory while reading the file");
}

CpsStatus cpsi_read_file(const char *path, const char *file, size_t max_bytes, char **bytes,
                         size_t *size, CpsError *err) {
    int fd = STDIN_FILENO;
    const bool input = strcmp(path, "-") == 0;
    CpsStatus status = input ? CPS_OK : open_regular(path, 0, &fd, err);
    if (status != CPS_OK) return status;
    status = read_bytes(fd, file, max_bytes, bytes, size, err);
    if (!input) close(fd);
    return status;
}

CpsStatus cpsi_read_file_itself(const char *path, size_t max_bytes, char **bytes, size_t *size,
                                CpsError *err) {
    int fd;
    CpsStatus status = open_regular(path, O_NOFOLLOW, &fd, err);
    if (status != CPS_OK) return status;
    status = read_bytes(fd, path, max_bytes, bytes, size, err);
    close(fd);
    return status;
}

bool cpsi_is_beside(const char *name) {
    return *name && !strchr(name, '/') && strcmp(name, "-") != 0 && strcmp(name, ".") != 0 &&
           strcmp(name, "..") != 0;
}

char *cpsi_path_beside(CpsiPool *pool, const char *file, const char *name) {
    const char *slash = strrchr(file, '/');
    const size_t folder = slash ? (size_t)(slash + 1 - file) : 0, length = strlen(name);
    char *path = CPSI_POOL_TAKE(pool, folder + length + 1, char);
    if (!path) return NULL;
    memcpy(path, file, folder);
    memcpy(path + folder, name, length + 1);
    return path;
}
