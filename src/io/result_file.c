/* SPDX-License-Identifier: BSD-3-Clause */
/* Temporary name, write, sync, rename: a set of files that appears whole or not at all (see result_file.h).
 * The order is that of POSIX fsync(2) and rename(2): data first, then names, then the directory itself. */
#define _DEFAULT_SOURCE /* flock */

#include "io/result_file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/status.h"

struct CpsiDirectory {
    char *path;
    int fd;
    bool made; /* by us: removed again when nothing is committed */
    bool committed;
    bool late; /* files are synced at the commit, all of them, and not one by one */
    char **name; /* final names, in the order of creation */
    size_t count, capacity;
};

enum { TEMPORARY_SIZE = 256 };

static CpsStatus fail_path(const CpsiDirectory *directory, const char *name, int code, CpsError *err) {
    return cpsi_fail(err, CPS_ERR_IO, "cannot write %s/%s: %s; earlier results are kept", directory->path, name,
                     code ? strerror(code) : "the write failed");
}

static void temporary_name(char out[TEMPORARY_SIZE], const char *name) {
    snprintf(out, TEMPORARY_SIZE, ".%s.part", name);
}

CpsStatus cpsi_directory_open(const char *path, CpsiDirectory **out, CpsError *err) {
    *out = NULL;
    CpsiDirectory *directory = calloc(1, sizeof *directory);
    if (directory) directory->path = strdup(path), directory->fd = -1;
    if (!directory || !directory->path) {
        free(directory);
        return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while opening the results directory");
    }

    directory->made = mkdir(path, 0777) == 0;
    if (directory->made || errno == EEXIST) directory->fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (directory->fd < 0) {
        const CpsStatus status =
            cpsi_fail(err, CPS_ERR_IO, "cannot use %s as a directory for results: %s", path, strerror(errno));
        cpsi_directory_destroy(directory);
        return status;
    }

    /* a file system without locks is accepted, a lock held by another run is not */
    if (flock(directory->fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        directory->made = false;
        cpsi_directory_destroy(directory);
        return cpsi_fail(err, CPS_ERR_IO, "another run is writing to %s; choose another directory", path);
    }
    *out = directory;
    return CPS_OK;
}

void cpsi_directory_sync_late(CpsiDirectory *directory) { directory->late = true; }

bool cpsi_directory_has(const CpsiDirectory *directory, const char *name) {
    for (size_t i = 0; i < directory->count; ++i)
        if (strcmp(directory->name[i], name) == 0) return true;
    return false;
}

/* remember a name, so that its temporary file is removed or renamed later */
static CpsStatus remember(CpsiDirectory *directory, const char *name, CpsError *err) {
    if (strlen(name) + sizeof "..part" > TEMPORARY_SIZE) return fail_path(directory, name, ENAMETOOLONG, err);
    if (directory->count == directory->capacity) {
        const size_t capacity = directory->capacity ? 2 * directory->capacity : 64;
        char **grown = realloc(directory->name, capacity * sizeof *grown);
        if (!grown) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while writing %s", name);
        directory->name = grown;
        directory->capacity = capacity;
    }
    char *copy = strdup(name);
    if (!copy) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while writing %s", name);
    directory->name[directory->count++] = copy;

    /* what a killed run has left behind */
    char temporary[TEMPORARY_SIZE];
    temporary_name(temporary, name);
    unlinkat(directory->fd, temporary, 0);
    return CPS_OK;
}

CpsStatus cpsi_directory_create(CpsiDirectory *directory, const char *name, FILE **out, CpsError *err) {
    *out = NULL;
    const CpsStatus status = remember(directory, name, err);
    if (status) return status;

    char temporary[TEMPORARY_SIZE];
    temporary_name(temporary, name);
    const int fd = openat(directory->fd, temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd < 0) return fail_path(directory, name, errno, err);
    *out = fdopen(fd, "w");
    if (*out) return CPS_OK;
    close(fd);
    return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while writing %s", name);
}

CpsStatus cpsi_directory_close_file(CpsiDirectory *directory, FILE *stream, CpsError *err) {
    errno = 0;
    const bool failed =
        ferror(stream) || fflush(stream) != 0 || (!directory->late && fsync(fileno(stream)) != 0);
    const int flush_code = errno;
    if (fclose(stream) != 0 || failed)
        return fail_path(directory, directory->name[directory->count - 1], failed ? flush_code : errno, err);
    return CPS_OK;
}

CpsStatus cpsi_directory_reserve(CpsiDirectory *directory, const char *name, char **path, CpsError *err) {
    *path = NULL;
    const CpsStatus status = remember(directory, name, err);
    if (status) return status;
    const size_t size = strlen(directory->path) + 1 + TEMPORARY_SIZE;
    *path = malloc(size);
    if (!*path) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while writing %s", name);
    snprintf(*path, size, "%s/.%s.part", directory->path, name);
    return CPS_OK;
}

CpsStatus cpsi_directory_sync(CpsiDirectory *directory, const char *name, CpsError *err) {
    char temporary[TEMPORARY_SIZE];
    temporary_name(temporary, name);
    const int fd = openat(directory->fd, temporary, O_RDWR | O_NOFOLLOW | O_CLOEXEC);
    if (fd < 0) return fail_path(directory, name, errno, err);
    const int code = fsync(fd) != 0 ? errno : 0;
    close(fd);
    return code ? fail_path(directory, name, code, err) : CPS_OK;
}

static int compare_names(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/* is `name`, or the file of which it is the temporary form, stale and not one of ours? */
static bool is_leftover(const CpsiDirectory *directory, const char *name, bool (*stale)(const char *name)) {
    char plain[TEMPORARY_SIZE];
    const size_t length = strlen(name);
    if (length >= sizeof plain) return false;
    memcpy(plain, name, length + 1);
    if (name[0] == '.' && length > 6 && strcmp(name + length - 5, ".part") == 0) {
        memcpy(plain, name + 1, length - 6);
        plain[length - 6] = '\0';
    }
    const char *key = plain;
    return stale(plain) && !bsearch(&key, directory->name, directory->count, sizeof key, compare_names);
}

/* pictures and steps of an earlier, longer run would be taken for this run's; failing to remove one does no harm */
static void remove_leftovers(CpsiDirectory *directory, bool (*stale)(const char *name)) {
    qsort(directory->name, directory->count, sizeof *directory->name, compare_names);
    const int fd = openat(directory->fd, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *listing = fd >= 0 ? fdopendir(fd) : NULL;
    if (!listing) {
        if (fd >= 0) close(fd);
        return;
    }
    for (struct dirent *entry; (entry = readdir(listing)) != NULL;)
        if (is_leftover(directory, entry->d_name, stale)) unlinkat(directory->fd, entry->d_name, 0);
    closedir(listing);
}

CpsStatus cpsi_directory_commit(CpsiDirectory *directory, bool (*stale)(const char *name), CpsError *err) {
    char temporary[TEMPORARY_SIZE];
    struct stat found;

    /* look for what rename would refuse before the first earlier file is replaced */
    for (size_t i = 0; i < directory->count; ++i)
        if (fstatat(directory->fd, directory->name[i], &found, AT_SYMLINK_NOFOLLOW) == 0 && S_ISDIR(found.st_mode))
            return fail_path(directory, directory->name[i], EISDIR, err);

    for (size_t i = 0; i < directory->count && directory->late; ++i) {
        const CpsStatus status = cpsi_directory_sync(directory, directory->name[i], err);
        if (status) return status;
    }

    for (size_t i = 0; i < directory->count; ++i) {
        temporary_name(temporary, directory->name[i]);
        if (renameat(directory->fd, temporary, directory->fd, directory->name[i]) != 0)
            return fail_path(directory, directory->name[i], errno, err);
        directory->committed = true;
    }
    remove_leftovers(directory, stale);
    if (fsync(directory->fd) != 0 && errno != EINVAL) return fail_path(directory, ".", errno, err);
    return CPS_OK;
}

void cpsi_directory_destroy(CpsiDirectory *directory) {
    if (!directory) return;
    char temporary[TEMPORARY_SIZE];
    for (size_t i = 0; i < directory->count; ++i) {
        temporary_name(temporary, directory->name[i]);
        unlinkat(directory->fd, temporary, 0); /* gone already where it was renamed */
        free(directory->name[i]);
    }
    if (directory->fd >= 0) close(directory->fd);
    if (directory->made && !directory->committed) rmdir(directory->path);
    free(directory->name);
    free(directory->path);
    free(directory);
}
