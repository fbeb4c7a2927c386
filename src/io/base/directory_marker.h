/* SPDX-License-Identifier: BSD-3-Clause */
/* What makes a directory one of capstan's: the file .capstan in it, which lists the files that
 * capstan has written there. Only those are ever replaced or removed.
 *
 * While a run writes, .capstan.run lists what it has begun, so that the next run can clear what a
 * killed one left as .NAME.part. While finished files are renamed into place, .capstan names the
 * one that comes last, the summary of its set; where that one is missing then, the files of its set
 * are of two runs. Both files are text, a name in each line behind one letter. */
#ifndef CAPSTAN_SRC_IO_BASE_DIRECTORY_MARKER_H
#define CAPSTAN_SRC_IO_BASE_DIRECTORY_MARKER_H

#include <stdbool.h>
#include <stddef.h>

#include "capstan/base.h"

enum { CPSI_NAME_SIZE = 256 }; /* of a file with what is added to it while it is temporary */

typedef struct CpsiNames {
    size_t count, capacity;
    char **name; /* (count) in order */
} CpsiNames;

bool cpsi_names_have(const CpsiNames *names, const char *name);
CpsStatus cpsi_names_add(CpsiNames *names, const char *name, CpsError *err);
/* one of them, where it is there; the i-th */
void cpsi_names_drop(CpsiNames *names, const char *name);
void cpsi_names_drop_at(CpsiNames *names, size_t i);
void cpsi_names_free(CpsiNames *names);

typedef struct CpsiMarker {
    bool found;
    CpsiNames written; /* files in the directory */
    CpsiNames awaited; /* of sets whose files were being renamed: those that come last */
} CpsiMarker;

/* Names that results can have; a marker is believed about no others. */
bool cpsi_marker_knows(const char *name);

/* Read .capstan in the directory open as `folder`, called `path` in messages. Returns CPS_OK also
 * where there is none, CPS_ERR_IO where there is a file of that name that is none of capstan's,
 * CPS_ERR_MEMORY. */
CpsStatus cpsi_marker_read(int folder, const char *path, CpsiMarker *out, CpsError *err);
void cpsi_marker_free(CpsiMarker *marker);

/* Add all that are there in the directory under a name of results. */
CpsStatus cpsi_marker_adopt(CpsiMarker *marker, int folder, CpsError *err);

/* Write .capstan anew, whole or not at all; `sync`: onto the disk before it takes its name. */
CpsStatus cpsi_marker_write(const CpsiMarker *marker, int folder, const char *path, bool sync,
                            CpsError *err);

/* A file that is awaited and not there: the others of its set are of two runs. NULL where there is
 * none. */
const char *cpsi_marker_missing(const CpsiMarker *marker, int folder);

/* Clear what a killed run has begun; begin the list of this one. *notes is its descriptor. */
CpsStatus cpsi_marker_begin(int folder, const char *path, int *notes, CpsError *err);
/* Before .NAME.part is made. */
CpsStatus cpsi_marker_note(int notes, const char *path, const char *name, CpsError *err);
void cpsi_marker_end(int folder, int notes);

/* Of a directory in which nothing has come to stay. */
void cpsi_marker_remove(int folder);

/* Is there nothing in the directory but what this file writes? */
bool cpsi_marker_is_alone(int folder);

#endif
