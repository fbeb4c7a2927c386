/* SPDX-License-Identifier: BSD-3-Clause */
/* A set of files that is written completely or not at all: temporary name, write, sync, rename (see
 * write_directory.h). The order is that of POSIX fsync(2) and rename(2): first the data, then the
 * names, then the directory itself. Where files are replaced, the last one is removed first, so
 * that its absence shows a set that was replaced only in part. */
#define _DEFAULT_SOURCE /* flock */

#include "io/base/directory/write_directory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/status.h"
#include "io/base/file/write_file.h"

struct CpsiDirectory {
    char *path;
    int fd;
    bool made;         /* made by this run: removed again when nothing is committed */
    bool marked;       /* marked by this run: likewise */
    bool committed;    /* renaming has begun */
    CpsiMarker marker; /* capstan's files that are already there */
    int notes;
    bool late;   /* files are synced together at the commit instead of one by one */
    char **name; /* final names, in the order of creation */
    size_t count, capacity;
};

enum { TEMPORARY_SIZE = CPSI_NAME_SIZE };

static CpsStatus fail_path(const CpsiDirectory *directory, const char *name, int code,
                           CpsError *err) {
    return cpsi_fail(err, CPS_ERR_IO, "cannot write %s/%s: %s; earlier results are kept",
                     directory->path, name, strerror(code));
}

/* What lies under a name that is to be written; *there: a file that may be replaced. */
static CpsStatus look_at(const CpsiDirectory *directory, const char *name, bool *there,
                         CpsError *err) {
    struct stat found;
    *there = fstatat(directory->fd, name, &found, AT_SYMLINK_NOFOLLOW) == 0;
    if (!*there) return CPS_OK;
    if (S_ISDIR(found.st_mode)) return fail_path(directory, name, EISDIR, err);
    if (cpsi_names_have(&directory->marker.written, name)) return CPS_OK;
    return cpsi_fail(
        err, CPS_ERR_IO,
        "%s/%s was not written by capstan: move it away, or add --force to replace it (and "
        "--resume to go on from the journal); earlier results are kept",
        directory->path, name);
}

static void temporary_name(char out[TEMPORARY_SIZE], const char *name) {
    snprintf(out, TEMPORARY_SIZE, ".%s.part", name);
}

/* `make`: create a directory that is missing. Where it is missing and not created, *out is NULL and
 * the status CPS_OK. */
static CpsStatus open_folder(const char *path, bool make, CpsiDirectory **out, CpsError *err) {
    *out = NULL;
    CpsiDirectory *directory = calloc(1, sizeof *directory);
    if (directory) {
        directory->path = strdup(path);
        directory->fd = directory->notes = -1;
    }
    if (!directory || !directory->path) {
        free(directory);
        return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while opening the results directory");
    }

    directory->made = make && mkdir(path, 0777) == 0;
    if (directory->made || !make || errno == EEXIST)
        directory->fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (directory->fd < 0) {
        const CpsStatus status =
            !make && errno == ENOENT
                ? CPS_OK
                : cpsi_fail(err, CPS_ERR_IO, "cannot use %s as a directory for results: %s", path,
                            strerror(errno));
        cpsi_directory_destroy(directory);
        return status;
    }

    /* a file system without locks is accepted, a lock of another run is not */
    if (flock(directory->fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        directory->made = false;
        cpsi_directory_destroy(directory);
        return cpsi_fail(err, CPS_ERR_IO, "another run is writing to %s; choose another directory",
                         path);
    }
    *out = directory;
    return CPS_OK;
}

/* Check that capstan has written to the directory before, or that it is empty, and that unfinished
 * files in it are capstan's. */
static CpsStatus look_round(CpsiDirectory *directory, CpsError *err) {
    const CpsStatus status =
        cpsi_marker_read(directory->fd, directory->path, &directory->marker, err);
    if (status != CPS_OK) return status;
    if (directory->marker.found || cpsi_marker_is_alone(directory->fd))
        return cpsi_marker_parts(directory->fd, directory->path, false, NULL, err);
    if (errno != 0)
        return cpsi_fail(err, CPS_ERR_IO, "cannot list the files of %s: %s", directory->path,
                         strerror(errno));
    return cpsi_fail(err, CPS_ERR_IO,
                     "%s is not empty and was not written by capstan: choose another directory, or "
                     "add --force to replace the files in it that have names of results",
                     directory->path);
}

CpsStatus cpsi_directory_open(const char *path, CpsiDirectory **out, CpsError *err) {
    CpsStatus status = open_folder(path, true, out, err);
    if (status != CPS_OK) return status;
    CpsiDirectory *directory = *out;
    status = look_round(directory, err);
    if (status == CPS_OK && !directory->marker.found) {
        status = cpsi_marker_write(&directory->marker, directory->fd, path, false, err);
        directory->marked = status == CPS_OK;
    }
    if (status == CPS_OK) status = cpsi_marker_begin(directory->fd, path, &directory->notes, err);
    if (status == CPS_OK) return CPS_OK;
    cpsi_directory_destroy(directory);
    *out = NULL;
    return status;
}

typedef struct Check {
    const CpsiDirectory *directory;
    CpsiIsWritten *is_written;
    const void *user;
} Check;

static CpsStatus check_name(void *user, const char *name, CpsError *err) {
    const Check *check = user;
    bool there;
    if (!cpsi_marker_knows(name) || !check->is_written(check->user, name)) return CPS_OK;
    return look_at(check->directory, name, &there, err);
}

CpsStatus cpsi_directory_check(const CpsiDirectory *directory, CpsiIsWritten *is_written,
                               const void *user, CpsError *err) {
    Check check = {directory, is_written, user};
    return cpsi_marker_each(directory->fd, directory->path, check_name, &check, err);
}

/* All that may be refused comes before the marker is written. */
static CpsStatus take_over(CpsiDirectory *directory, CpsError *err) {
    CpsiMarker *marker = &directory->marker;
    CpsiNames parts = {0};
    CpsStatus status = cpsi_marker_read(directory->fd, directory->path, marker, err);
    if (status == CPS_OK) status = cpsi_marker_adopt(marker, directory->fd, directory->path, err);
    if (status == CPS_OK)
        status = cpsi_marker_parts(directory->fd, directory->path, true, &parts, err);
    if (status == CPS_OK)
        status = cpsi_marker_write(marker, directory->fd, directory->path, true, err);
    if (status == CPS_OK)
        status = cpsi_marker_remove_parts(directory->fd, directory->path, &parts, err);
    cpsi_names_free(&parts);
    return status;
}

CpsStatus cpsi_directory_prepare(const char *path, bool force, CpsiIsWritten *is_written,
                                 const void *user, CpsError *err) {
    CpsiDirectory *directory;
    CpsStatus status = open_folder(path, false, &directory, err);
    if (status != CPS_OK || !directory) return status;
    status = force ? take_over(directory, err) : look_round(directory, err);
    if (status == CPS_OK) status = cpsi_directory_check(directory, is_written, user, err);
    cpsi_directory_destroy(directory);
    return status;
}

CpsStatus cpsi_directory_missing(const char *path, char missing[CPSI_NAME_SIZE], CpsError *err) {
    missing[0] = '\0';
    const int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0 && (errno == ENOENT || errno == ENOTDIR)) return CPS_OK;
    if (folder < 0) return cpsi_fail(err, CPS_ERR_IO, "cannot open %s: %s", path, strerror(errno));
    CpsiMarker marker;
    const CpsStatus status = cpsi_marker_read(folder, path, &marker, err);
    const char *name = status == CPS_OK ? cpsi_marker_missing(&marker, folder) : NULL;
    if (name) snprintf(missing, CPSI_NAME_SIZE, "%s", name);
    cpsi_marker_free(&marker);
    close(folder);
    return status;
}

void cpsi_directory_sync_late(CpsiDirectory *directory) { directory->late = true; }

bool cpsi_directory_has(const CpsiDirectory *directory, const char *name) {
    for (size_t i = 0; i < directory->count; ++i)
        if (strcmp(directory->name[i], name) == 0) return true;
    return false;
}

/* record a name, so that its temporary file is removed or renamed later */
static CpsStatus remember(CpsiDirectory *directory, const char *name, CpsError *err) {
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
    return CPS_OK;
}

static CpsStatus fail_part(const CpsiDirectory *directory, const char *temporary, CpsError *err) {
    return cpsi_fail(err, CPS_ERR_IO,
                     "%s/%s is there and was not begun by this run: move it away; earlier results "
                     "are kept",
                     directory->path, temporary);
}

/* Begin a file: its temporary name, which must be free, is listed before it is remembered, so that
 * only files of this run are removed at its end. */
static CpsStatus begin_file(CpsiDirectory *directory, const char *name,
                            char temporary[TEMPORARY_SIZE], CpsError *err) {
    struct stat found;
    if (!cpsi_marker_knows(name))
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "'%s' is no name of a file of results: add it to those in directory_marker.c", name);
    temporary_name(temporary, name);
    if (fstatat(directory->fd, temporary, &found, AT_SYMLINK_NOFOLLOW) == 0)
        return fail_part(directory, temporary, err);
    const CpsStatus status = cpsi_marker_note(directory->notes, directory->path, name, err);
    return status == CPS_OK ? remember(directory, name, err) : status;
}

CpsStatus cpsi_directory_create(CpsiDirectory *directory, const char *name, FILE **out,
                                CpsError *err) {
    *out = NULL;
    char temporary[TEMPORARY_SIZE];
    const CpsStatus status = begin_file(directory, name, temporary, err);
    if (status) return status;
    const int fd = openat(directory->fd, temporary,
                          O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd < 0) {
        const int code = errno;
        free(directory->name[--directory->count]); /* there is no such file of this run */
        return fail_path(directory, name, code, err);
    }
    *out = fdopen(fd, "w");
    if (*out) return CPS_OK;
    close(fd);
    return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while writing %s", name);
}

CpsStatus cpsi_directory_close_file(CpsiDirectory *directory, FILE *stream, CpsError *err) {
    const int code = cpsi_close_stream(stream, !directory->late);
    return code ? fail_path(directory, directory->name[directory->count - 1], code, err) : CPS_OK;
}

CpsStatus cpsi_directory_reserve(CpsiDirectory *directory, const char *name, char **path,
                                 CpsError *err) {
    *path = NULL;
    char temporary[TEMPORARY_SIZE];
    const CpsStatus status = begin_file(directory, name, temporary, err);
    if (status) return status;
    const size_t size = strlen(directory->path) + 1 + TEMPORARY_SIZE;
    *path = malloc(size);
    if (!*path) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while writing %s", name);
    snprintf(*path, size, "%s/%s", directory->path, temporary);
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

const char *cpsi_directory_path(const CpsiDirectory *directory) { return directory->path; }

size_t cpsi_directory_count(const CpsiDirectory *directory) { return directory->count; }

const char *cpsi_directory_name(const CpsiDirectory *directory, size_t i) {
    return directory->name[i];
}

int cpsi_directory_reopen(const CpsiDirectory *directory, const char *name) {
    char temporary[TEMPORARY_SIZE];
    temporary_name(temporary, name);
    return openat(directory->fd, temporary, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
}

/* commit --------------------------------------------------------------------------------------- */

static CpsStatus fail_mixed(const CpsiDirectory *directory, const char *name, CpsError *err) {
    return cpsi_fail(
        err, CPS_ERR_IO,
        "cannot put %s/%s in its place: %s; the files there are now of two runs, or not "
        "all of one, and %s is missing: the same command again replaces them all "
        "(--resume of run goes on from the journal)",
        directory->path, name, strerror(errno), directory->name[directory->count - 1]);
}

static CpsStatus fail_late(const CpsiDirectory *directory, CpsError *err) {
    return cpsi_fail(err, CPS_ERR_IO,
                     "all files of %s are in place, but the disk has not confirmed it: %s",
                     directory->path, strerror(errno));
}

/* a file system that cannot sync a directory is accepted */
static bool sync_folder(const CpsiDirectory *directory) {
    return fsync(directory->fd) == 0 || errno == EINVAL;
}

/* Find the files that would be refused or lost, before the first earlier file is replaced.
 * *replaces: whether there are earlier files. */
static CpsStatus look_ahead(const CpsiDirectory *directory, bool *replaces, CpsError *err) {
    *replaces = false;
    for (size_t i = 0; i < directory->count; ++i) {
        bool there;
        const CpsStatus status = look_at(directory, directory->name[i], &there, err);
        if (status != CPS_OK) return status;
        *replaces = *replaces || there;
    }
    return CPS_OK;
}

/* The names of this run in order, and those of the marker together with them. All memory of a
 * commit is allocated here. */
static CpsStatus list_names(CpsiDirectory *directory, CpsiNames *own, CpsError *err) {
    CpsStatus status = CPS_OK;
    for (size_t i = 0; i < directory->count && status == CPS_OK; ++i) {
        status = cpsi_names_add(own, directory->name[i], err);
        if (status == CPS_OK)
            status = cpsi_names_add(&directory->marker.written, directory->name[i], err);
    }
    return status == CPS_OK ? cpsi_names_add(&directory->marker.awaited,
                                             directory->name[directory->count - 1], err)
                            : status;
}

/* Rename all files but the last, and remove the files of earlier runs that this one does not
 * have. */
static CpsStatus put_in_place(CpsiDirectory *directory, const CpsiNames *own,
                              bool (*stale)(const char *name), CpsError *err) {
    char temporary[TEMPORARY_SIZE];
    for (size_t i = 0; i + 1 < directory->count; ++i) {
        temporary_name(temporary, directory->name[i]);
        if (renameat(directory->fd, temporary, directory->fd, directory->name[i]) != 0)
            return fail_mixed(directory, directory->name[i], err);
    }
    /* Pictures and steps of an earlier, longer run would appear to belong to this run. A file that
     * cannot be removed remains in the list, for the next run. */
    CpsiNames *written = &directory->marker.written;
    for (size_t i = written->count; i-- > 0;) {
        const char *name = written->name[i];
        if (!stale(name) || cpsi_names_have(own, name)) continue;
        if (unlinkat(directory->fd, name, 0) == 0 || errno == ENOENT)
            cpsi_names_drop_at(written, i);
    }
    return CPS_OK;
}

/* From here on the list contains old and new files, and the name whose absence shows an incomplete
 * replacement. */
static CpsStatus replace(CpsiDirectory *directory, const CpsiNames *own,
                         bool (*stale)(const char *name), bool replaces, CpsError *err) {
    CpsiMarker *marker = &directory->marker;
    const char *last = directory->name[directory->count - 1];
    CpsStatus status = cpsi_marker_write(marker, directory->fd, directory->path, replaces, err);
    if (status != CPS_OK) return status;
    directory->committed = true;
    if (replaces && !sync_folder(directory)) return fail_path(directory, ".", errno, err);
    if (unlinkat(directory->fd, last, 0) != 0 && errno != ENOENT)
        return fail_path(directory, last, errno, err);
    if (replaces && !sync_folder(directory)) return fail_mixed(directory, last, err);

    status = put_in_place(directory, own, stale, err);
    if (status != CPS_OK) return status;
    char temporary[TEMPORARY_SIZE];
    temporary_name(temporary, last);
    if (!sync_folder(directory) || renameat(directory->fd, temporary, directory->fd, last) != 0)
        return fail_mixed(directory, last, err);
    cpsi_names_drop(&marker->awaited, last);
    if (cpsi_marker_write(marker, directory->fd, directory->path, replaces, NULL) != CPS_OK ||
        !sync_folder(directory))
        return fail_late(directory, err);
    return CPS_OK;
}

CpsStatus cpsi_directory_commit(CpsiDirectory *directory, bool (*stale)(const char *name),
                                CpsError *err) {
    if (directory->count == 0) return CPS_OK;
    bool replaces;
    CpsiNames own = {0};
    CpsStatus status = look_ahead(directory, &replaces, err);
    if (directory->late)
        for (size_t i = 0; i < directory->count && status == CPS_OK; ++i)
            status = cpsi_directory_sync(directory, directory->name[i], err);
    if (status == CPS_OK) status = list_names(directory, &own, err);
    if (status == CPS_OK) status = replace(directory, &own, stale, replaces, err);
    cpsi_names_free(&own);
    return status;
}

void cpsi_directory_destroy(CpsiDirectory *directory) {
    if (!directory) return;
    char temporary[TEMPORARY_SIZE];
    bool left = false;
    for (size_t i = 0; i < directory->count; ++i) {
        temporary_name(temporary, directory->name[i]);
        /* does nothing where it has been renamed */
        if (unlinkat(directory->fd, temporary, 0) != 0 && errno != ENOENT) left = true;
        free(directory->name[i]);
    }
    cpsi_marker_end(directory->fd, directory->notes, left);
    if (directory->marked && !directory->committed && cpsi_marker_is_alone(directory->fd))
        cpsi_marker_remove(directory->fd);
    cpsi_marker_free(&directory->marker);
    if (directory->fd >= 0) close(directory->fd);
    if (directory->made && !directory->committed) rmdir(directory->path);
    free(directory->name);
    free(directory->path);
    free(directory);
}
