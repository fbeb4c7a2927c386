/* SPDX-License-Identifier: BSD-3-Clause */
/* The marker of a directory of results (see directory_marker.h). */
#define _POSIX_C_SOURCE 200809L
#include "io/base/directory/directory_marker.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/status.h"
#include "io/base/file/write_file.h"

static const char MARKER[] = ".capstan", MARKER_PART[] = ".capstan.part", NOTES[] = ".capstan.run";
static const char FIRST_LINE[] = "capstan directory 1\n";

/* far more than the list of the longest history */
enum { MARKER_MOST = 256 << 20 };

static CpsStatus no_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while listing results");
}

static CpsStatus fail_name(const char *path, const char *name, CpsError *err) {
    return cpsi_fail(err, CPS_ERR_IO, "cannot write %s/%s: %s; earlier results are kept", path,
                     name, strerror(errno));
}

/* names ---------------------------------------------------------------------------------------- */

/* `end` begins with its only dot. */
static bool ends_with(const char *name, const char *end) {
    const char *dot = strrchr(name, '.');
    return dot && strcmp(dot, end) == 0;
}

bool cpsi_marker_knows(const char *name) {
    static const char *const PLAIN[] = {"summary.json", "history.csv",        "result.nc",
                                        "result.pvd",   "obstacles.vtp",      "sets.vtp",
                                        "plan.svg",     "elevation.svg",      "tension.svg",
                                        "history.svg",  "stiffness.csv",      "points.csv",
                                        "bodies.csv",   "body-stiffness.csv", "point-stiffness.csv",
                                        "planes.svg",   "study.csv",          "study.svg",
                                        "study.json",   "first-order.csv",    "first-order.svg",
                                        "relaxed.svg",  "methods.csv",        "methods.svg",
                                        "methods.json", "completed.csv",      "completed.svg",
                                        "history.out",  "completed.json",     "offset.csv",
                                        "offset.svg",   "broken.csv",         "offset.json"};
    for (size_t i = 0; i < sizeof PLAIN / sizeof *PLAIN; ++i)
        if (strcmp(name, PLAIN[i]) == 0) return true;
    if (strlen(name) + sizeof "..part" > CPSI_NAME_SIZE || strchr(name, '/')) return false;
    if (strncmp(name, "loop-", 5) == 0) return ends_with(name, ".svg");
    if (strncmp(name, "line-", 5) == 0)
        return strspn(name + 5, "0123456789") + 9 == strlen(name) && ends_with(name, ".svg");
    if (strncmp(name, "step-", 5) != 0 || strspn(name + 5, "0123456789") < 5) return false;
    return ends_with(name, ".svg") || ends_with(name, ".vtp");
}

/* the position of `name`, or where it would be inserted */
static size_t place_of(const CpsiNames *names, const char *name) {
    size_t low = 0, high = names->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (strcmp(names->name[middle], name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

bool cpsi_names_have(const CpsiNames *names, const char *name) {
    const size_t at = place_of(names, name);
    return at < names->count && strcmp(names->name[at], name) == 0;
}

CpsStatus cpsi_names_add(CpsiNames *names, const char *name, CpsError *err) {
    const size_t at = place_of(names, name);
    if (at < names->count && strcmp(names->name[at], name) == 0) return CPS_OK;
    if (names->count == names->capacity) {
        const size_t capacity = names->capacity ? 2 * names->capacity : 64;
        char **grown = realloc(names->name, capacity * sizeof *grown);
        if (!grown) return no_memory(err);
        names->name = grown;
        names->capacity = capacity;
    }
    char *copy = strdup(name);
    if (!copy) return no_memory(err);
    memmove(names->name + at + 1, names->name + at, (names->count - at) * sizeof *names->name);
    names->name[at] = copy;
    names->count++;
    return CPS_OK;
}

void cpsi_names_drop_at(CpsiNames *names, size_t i) {
    free(names->name[i]);
    memmove(names->name + i, names->name + i + 1, (--names->count - i) * sizeof *names->name);
}

void cpsi_names_drop(CpsiNames *names, const char *name) {
    if (cpsi_names_have(names, name)) cpsi_names_drop_at(names, place_of(names, name));
}

void cpsi_names_free(CpsiNames *names) {
    for (size_t i = 0; i < names->count; ++i) free(names->name[i]);
    free(names->name);
    *names = (CpsiNames){0};
}

void cpsi_marker_free(CpsiMarker *marker) {
    cpsi_names_free(&marker->written);
    cpsi_names_free(&marker->awaited);
}

/* reading -------------------------------------------------------------------------------------- */

/* A listing of the directory by a descriptor of its own; NULL after a failure. */
static DIR *list_folder(int folder) {
    const int fd = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *listing = fd >= 0 ? fdopendir(fd) : NULL;
    if (!listing && fd >= 0) close(fd);
    return listing;
}

/* The next name; NULL at the end, where errno is 0, and after a failure. */
static const char *next_name(DIR *listing) {
    errno = 0;
    const struct dirent *entry = readdir(listing);
    return entry ? entry->d_name : NULL;
}

static bool is_own(const char *name) {
    static const char *const OWN[] = {".", "..", MARKER, MARKER_PART, NOTES};
    for (size_t i = 0; i < sizeof OWN / sizeof *OWN; ++i)
        if (strcmp(name, OWN[i]) == 0) return true;
    return false;
}

bool cpsi_marker_is_alone(int folder) {
    DIR *listing = list_folder(folder);
    if (!listing) return false;
    const char *name;
    do name = next_name(listing);
    while (name && is_own(name));
    const int code = name ? 0 : errno; /* what could not be listed may be anybody's */
    const bool alone = !name && code == 0;
    closedir(listing);
    errno = code;
    return alone;
}

CpsStatus cpsi_marker_each(int folder, const char *path, CpsiNameCall *call, void *user,
                           CpsError *err) {
    CpsStatus status = CPS_OK;
    DIR *listing = list_folder(folder);
    const char *name;
    if (listing)
        while (status == CPS_OK && (name = next_name(listing)) != NULL)
            status = call(user, name, err);
    if (status == CPS_OK && errno != 0)
        status =
            cpsi_fail(err, CPS_ERR_IO, "cannot list the files of %s: %s", path, strerror(errno));
    if (listing) closedir(listing);
    return status;
}

static bool is_folder(int folder, const char *name) {
    struct stat found;
    return fstatat(folder, name, &found, AT_SYMLINK_NOFOLLOW) == 0 && S_ISDIR(found.st_mode);
}

static CpsStatus refuse_folder(const char *path, const char *name, CpsError *err) {
    return cpsi_fail(err, CPS_ERR_IO,
                     "%s/%s is a directory where a file of results may go: move it away, or choose "
                     "another directory for results",
                     path, name);
}

typedef struct Adoption {
    CpsiMarker *marker;
    int folder;
    const char *path;
} Adoption;

static CpsStatus adopt(void *user, const char *name, CpsError *err) {
    const Adoption *adoption = user;
    if (!cpsi_marker_knows(name)) return CPS_OK;
    if (is_folder(adoption->folder, name)) return refuse_folder(adoption->path, name, err);
    return cpsi_names_add(&adoption->marker->written, name, err);
}

CpsStatus cpsi_marker_adopt(CpsiMarker *marker, int folder, const char *path, CpsError *err) {
    Adoption adoption = {marker, folder, path};
    return cpsi_marker_each(folder, path, adopt, &adoption, err);
}

const char *cpsi_marker_missing(const CpsiMarker *marker, int folder) {
    struct stat found;
    for (size_t i = 0; i < marker->awaited.count; ++i)
        if (fstatat(folder, marker->awaited.name[i], &found, AT_SYMLINK_NOFOLLOW) != 0)
            return marker->awaited.name[i];
    return NULL;
}

/* A regular file of the directory itself that begins with the first line. NULL where there is none;
 * after a failure *status gives the reason. */
static FILE *open_list(int folder, const char *path, const char *name, CpsStatus *status,
                       CpsError *err) {
    char line[sizeof FIRST_LINE];
    struct stat about;
    *status = CPS_OK;
    const int fd = openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (fd < 0 && errno == ENOENT) return NULL;
    if (fd < 0 && errno != ELOOP && errno != ENXIO) {
        *status = cpsi_fail(err, CPS_ERR_IO, "cannot open %s/%s: %s", path, name, strerror(errno));
        return NULL;
    }
    const bool regular =
        fd >= 0 && fstat(fd, &about) == 0 && S_ISREG(about.st_mode) && about.st_size <= MARKER_MOST;
    FILE *list = regular ? fdopen(fd, "r") : NULL;
    if (!list && fd >= 0) close(fd);
    if (regular && !list) *status = no_memory(err);
    errno = 0;
    if (list && fgets(line, sizeof line, list) && strcmp(line, FIRST_LINE) == 0) return list;
    if (list && ferror(list))
        *status = cpsi_fail(err, CPS_ERR_IO, "cannot read %s/%s: %s", path, name, strerror(errno));
    if (list) fclose(list);
    if (*status == CPS_OK)
        *status =
            cpsi_fail(err, CPS_ERR_IO,
                      "%s/%s is no list of capstan's: move it away, or choose another directory",
                      path, name);
    return NULL;
}

/* The next letter and name; false at the end. A line without meaning gives the letter 0. */
static bool next_line(FILE *list, char *letter, char name[CPSI_NAME_SIZE]) {
    char line[CPSI_NAME_SIZE + 8];
    if (!fgets(line, sizeof line, list)) return false;
    const size_t length = strcspn(line, "\n");
    const bool whole =
        line[length] == '\n' && length > 2 && length < CPSI_NAME_SIZE + 2 && line[1] == ' ';
    line[length] = '\0';
    *letter = 0;
    if (!whole || !cpsi_marker_knows(line + 2)) return true;
    *letter = line[0];
    memcpy(name, line + 2, length - 1);
    return true;
}

CpsStatus cpsi_marker_read(int folder, const char *path, CpsiMarker *out, CpsError *err) {
    *out = (CpsiMarker){0};
    CpsStatus status;
    FILE *list = open_list(folder, path, MARKER, &status, err);
    if (!list) return status;
    out->found = true;
    char letter, name[CPSI_NAME_SIZE];
    while (status == CPS_OK && next_line(list, &letter, name)) {
        if (letter == 'w') status = cpsi_names_add(&out->written, name, err);
        if (letter == 'x') status = cpsi_names_add(&out->awaited, name, err);
    }
    fclose(list);
    if (status != CPS_OK) cpsi_marker_free(out);
    return status;
}

/* writing -------------------------------------------------------------------------------------- */

CpsStatus cpsi_marker_write(const CpsiMarker *marker, int folder, const char *path, bool sync,
                            CpsError *err) {
    unlinkat(folder, MARKER_PART, 0); /* left by a killed run */
    const int fd =
        openat(folder, MARKER_PART, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    FILE *list = fd >= 0 ? fdopen(fd, "w") : NULL;
    if (!list) {
        const CpsStatus status = fail_name(path, MARKER, err);
        if (fd >= 0) close(fd);
        return status;
    }
    fputs(FIRST_LINE, list);
    for (size_t i = 0; i < marker->awaited.count; ++i)
        fprintf(list, "x %s\n", marker->awaited.name[i]);
    for (size_t i = 0; i < marker->written.count; ++i)
        fprintf(list, "w %s\n", marker->written.name[i]);
    const int code = cpsi_close_stream(list, sync);
    if (code == 0 && renameat(folder, MARKER_PART, folder, MARKER) == 0) return CPS_OK;
    if (code != 0) errno = code;
    const CpsStatus status = fail_name(path, MARKER, err);
    unlinkat(folder, MARKER_PART, 0);
    return status;
}

/* unfinished files ----------------------------------------------------------------------------- */

/* The files that .capstan.run lists, under their temporary names. It is empty where a run was
 * killed just after it had begun the list. */
static CpsStatus read_notes(int folder, const char *path, CpsiNames *parts, CpsError *err) {
    struct stat about;
    if (fstatat(folder, NOTES, &about, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(about.st_mode) &&
        about.st_size == 0)
        return CPS_OK;
    CpsStatus status;
    FILE *list = open_list(folder, path, NOTES, &status, err);
    if (!list) return status;
    char letter, name[CPSI_NAME_SIZE], part[CPSI_NAME_SIZE + 8];
    while (status == CPS_OK && next_line(list, &letter, name)) {
        if (letter != 'p') continue;
        snprintf(part, sizeof part, ".%s.part", name);
        status = cpsi_names_add(parts, part, err);
    }
    fclose(list);
    return status;
}

/* Whether the name is .NAME.part, NAME being a name of results. */
static bool is_part(const char *name) {
    char inner[CPSI_NAME_SIZE];
    const size_t length = strlen(name), around = sizeof "..part" - 1;
    if (name[0] != '.' || length <= around || length >= CPSI_NAME_SIZE || !ends_with(name, ".part"))
        return false;
    memcpy(inner, name + 1, length - around);
    inner[length - around] = '\0';
    return cpsi_marker_knows(inner);
}

typedef struct PartSearch {
    int folder;
    const char *path;
    bool force;
    CpsiNames listed, *parts;
} PartSearch;

static CpsStatus search(void *user, const char *name, CpsError *err) {
    const PartSearch *in = user;
    if (!is_part(name) || cpsi_names_have(&in->listed, name)) return CPS_OK;
    if (is_folder(in->folder, name)) return refuse_folder(in->path, name, err);
    if (in->force) return cpsi_names_add(in->parts, name, err);
    return cpsi_fail(err, CPS_ERR_IO,
                     "%s/%s has the name of an unfinished file, and no run has listed it there: "
                     "move it away, or add --force to remove it",
                     in->path, name);
}

CpsStatus cpsi_marker_parts(int folder, const char *path, bool force, CpsiNames *parts,
                            CpsError *err) {
    PartSearch in = {.folder = folder, .path = path, .force = force, .parts = parts};
    CpsStatus status = read_notes(folder, path, &in.listed, err);
    if (status == CPS_OK) status = cpsi_marker_each(folder, path, search, &in, err);
    cpsi_names_free(&in.listed);
    return status;
}

CpsStatus cpsi_marker_remove_parts(int folder, const char *path, const CpsiNames *parts,
                                   CpsError *err) {
    for (size_t i = 0; i < parts->count; ++i)
        if (unlinkat(folder, parts->name[i], 0) != 0 && errno != ENOENT)
            return cpsi_fail(err, CPS_ERR_IO, "cannot remove the unfinished file %s/%s: %s", path,
                             parts->name[i], strerror(errno));
    return CPS_OK;
}

/* Write all bytes; a call that was interrupted or that wrote only a part is continued. */
static bool write_whole(int file, const char *bytes, size_t size) {
    for (size_t done = 0; done < size;) {
        const ssize_t n = write(file, bytes + done, size - done);
        if (n < 0 && errno == EINTR) continue;
        if (n == 0) errno = ENOSPC;
        if (n <= 0) return false;
        done += (size_t)n;
    }
    return true;
}

CpsStatus cpsi_marker_begin(int folder, const char *path, int *notes, CpsError *err) {
    *notes = -1;
    CpsiNames left = {0};
    CpsStatus status = read_notes(folder, path, &left, err);
    if (status == CPS_OK) status = cpsi_marker_remove_parts(folder, path, &left, err);
    cpsi_names_free(&left);
    if (status != CPS_OK) return status;
    unlinkat(folder, NOTES, 0);
    *notes = openat(folder, NOTES, O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_NOFOLLOW | O_CLOEXEC,
                    0666);
    if (*notes < 0) return fail_name(path, NOTES, err);
    return write_whole(*notes, FIRST_LINE, sizeof FIRST_LINE - 1) ? CPS_OK
                                                                  : fail_name(path, NOTES, err);
}

CpsStatus cpsi_marker_note(int notes, const char *path, const char *name, CpsError *err) {
    char line[CPSI_NAME_SIZE + 8];
    const int length = snprintf(line, sizeof line, "p %s\n", name);
    return write_whole(notes, line, (size_t)length) ? CPS_OK : fail_name(path, name, err);
}

void cpsi_marker_end(int folder, int notes, bool keep) {
    if (notes < 0) return;
    close(notes);
    if (!keep) unlinkat(folder, NOTES, 0);
}

void cpsi_marker_remove(int folder) { unlinkat(folder, MARKER, 0); }
