/* SPDX-License-Identifier: BSD-3-Clause */
/* The file .capstan in a directory of results, which lists the files that capstan has written
 * there. Only these are ever replaced or removed.
 *
 * While a run writes, .capstan.run lists the files that it has begun, so that the next run can
 * remove the .NAME.part files of a killed one, and no others. While finished files are renamed into
 * place, .capstan names the one that is renamed last, the summary of the set. If that one is
 * missing afterwards, the files of the set belong to two runs. Both files are text, with a letter
 * and a name in each line. */
#ifndef CAPSTAN_SRC_IO_BASE_DIRECTORY_DIRECTORY_MARKER_H
#define CAPSTAN_SRC_IO_BASE_DIRECTORY_DIRECTORY_MARKER_H

#include <stdbool.h>
#include <stddef.h>

#include "capstan/base.h"

/* length of a file name, including what is added to it while it is temporary */
enum { CPSI_NAME_SIZE = 256 };

typedef struct CpsiNames {
    size_t count, capacity;
    char **name; /* (count) in order */
} CpsiNames;

bool cpsi_names_have(const CpsiNames *names, const char *name);
CpsStatus cpsi_names_add(CpsiNames *names, const char *name, CpsError *err);
/* Remove one of them, if it is there; the i-th. */
void cpsi_names_drop(CpsiNames *names, const char *name);
void cpsi_names_drop_at(CpsiNames *names, size_t i);
void cpsi_names_free(CpsiNames *names);

typedef struct CpsiMarker {
    bool found;
    CpsiNames written; /* files in the directory */
    CpsiNames awaited; /* the last files of sets that were being renamed */
} CpsiMarker;

/* Whether results can have this name; other names in a marker are ignored. */
bool cpsi_marker_knows(const char *name);

/* Read .capstan in the directory open as `folder`, called `path` in messages. Returns CPS_OK also
 * where there is none, CPS_ERR_IO where a file of that name was not written by capstan,
 * CPS_ERR_MEMORY. */
CpsStatus cpsi_marker_read(int folder, const char *path, CpsiMarker *out, CpsError *err);
void cpsi_marker_free(CpsiMarker *marker);

/* Call a function with each name in the directory, until it fails. */
typedef CpsStatus CpsiNameCall(void *user, const char *name, CpsError *err);
CpsStatus cpsi_marker_each(int folder, const char *path, CpsiNameCall *call, void *user,
                           CpsError *err);

/* Add all files of the directory whose names are names of results. A directory of such a name is
 * refused: CPS_ERR_IO. */
CpsStatus cpsi_marker_adopt(CpsiMarker *marker, int folder, const char *path, CpsError *err);

/* Find the .NAME.part files, NAME being a name of results, that .capstan.run does not list. Without
 * `force` the first one is refused; with it they are added to `parts`, and only one that is a
 * directory is refused. Returns CPS_OK, CPS_ERR_IO, also where .capstan.run was not written by
 * capstan, or CPS_ERR_MEMORY. */
CpsStatus cpsi_marker_parts(int folder, const char *path, bool force, CpsiNames *parts,
                            CpsError *err);
/* Remove these. */
CpsStatus cpsi_marker_remove_parts(int folder, const char *path, const CpsiNames *parts,
                                   CpsError *err);

/* Replace .capstan completely or not at all; `sync`: written to the disk before it gets its
 * name. */
CpsStatus cpsi_marker_write(const CpsiMarker *marker, int folder, const char *path, bool sync,
                            CpsError *err);

/* The name of a last file that is missing, so that the others of its set belong to two runs. NULL
 * where none is missing. */
const char *cpsi_marker_missing(const CpsiMarker *marker, int folder);

/* Remove the unfinished files that a killed run has listed, and begin the list of this one. *notes
 * is its descriptor. Where one cannot be removed the list remains: CPS_ERR_IO. */
CpsStatus cpsi_marker_begin(int folder, const char *path, int *notes, CpsError *err);
/* To be called before .NAME.part is created. */
CpsStatus cpsi_marker_note(int notes, const char *path, const char *name, CpsError *err);
/* End the list; `keep` it where a file that it lists could not be removed. */
void cpsi_marker_end(int folder, int notes, bool keep);

/* Remove the marker of a directory in which no results remain. */
void cpsi_marker_remove(int folder);

/* Whether the directory contains nothing but the files of this module. After a failure, which errno
 * then says, false; otherwise errno is 0. */
bool cpsi_marker_is_alone(int folder);

#endif
