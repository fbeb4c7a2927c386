/* SPDX-License-Identifier: BSD-3-Clause */
/* What makes a directory one of capstan's: the file .capstan in it, which lists the files that capstan has written there. Only those are
 * ever replaced or removed.
 *
 * While a run writes, .capstan.run lists what it has begun, so that the next run can clear what a killed one left as .NAME.part. While
 * finished files are renamed into place, .capstan names the one that comes last; where that one is missing then, the files in the
 * directory are of two runs. Both files are text, a name in each line behind one letter. */
#ifndef CAPSTAN_SRC_IO_BASE_DIRECTORY_MARKER_H
#define CAPSTAN_SRC_IO_BASE_DIRECTORY_MARKER_H

#include <stdbool.h>
#include <stddef.h>

#include "capstan/base.h"

enum { CPSI_NAME_SIZE = 256 }; /* of a file with what is added to it while it is temporary */

typedef struct CpsiMarker {
    bool found;
    bool replacing; /* the renaming of files had begun and not ended */
    char last[CPSI_NAME_SIZE]; /* of them; "" where none is replaced */
    size_t count, capacity;
    char **name; /* (count) in order */
} CpsiMarker;

/* Names that results can have; a marker is believed about no others. */
bool cpsi_marker_knows(const char *name);

/* Read .capstan in the directory open as `folder`, called `path` in messages. Returns CPS_OK also where there is none,
 * CPS_ERR_IO where there is a file of that name that is none of capstan's, CPS_ERR_MEMORY. */
CpsStatus cpsi_marker_read(int folder, const char *path, CpsiMarker *out, CpsError *err);
void cpsi_marker_free(CpsiMarker *marker);

/* Is the file listed? Add it, drop the i-th, add all that are there in the directory under a name of results. */
bool cpsi_marker_lists(const CpsiMarker *marker, const char *name);
CpsStatus cpsi_marker_add(CpsiMarker *marker, const char *name, CpsError *err);
void cpsi_marker_drop(CpsiMarker *marker, size_t i);
CpsStatus cpsi_marker_adopt(CpsiMarker *marker, int folder, CpsError *err);

/* Write .capstan anew, whole or not at all; `sync`: onto the disk before it takes its name. */
CpsStatus cpsi_marker_write(const CpsiMarker *marker, int folder, const char *path, bool sync, CpsError *err);

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
