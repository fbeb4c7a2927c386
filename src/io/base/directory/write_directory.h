/* SPDX-License-Identifier: BSD-3-Clause */
/* A set of files that appears in a directory completely or not at all.
 *
 * Every file NAME is listed in .capstan.run, written as .NAME.part, synced, and renamed at the
 * commit, after all of them are complete. A commit that is interrupted leaves files of two runs,
 * which the marker detects (directory_marker.h). Closing without a commit removes the temporary
 * files, and the directory too if it was made for them. There is one writer at a time: the open
 * directory has an advisory lock, which also ends when the process is killed. */
#ifndef CAPSTAN_SRC_IO_BASE_DIRECTORY_WRITE_DIRECTORY_H
#define CAPSTAN_SRC_IO_BASE_DIRECTORY_WRITE_DIRECTORY_H

#include <stdbool.h>
#include <stdio.h>

#include "io/base/directory/directory_marker.h"

typedef struct CpsiDirectory CpsiDirectory;

/* Open `path`, which is made if it is missing. A directory that is not empty and has no marker
 * (directory_marker.h) is refused. Returns CPS_OK, CPS_ERR_IO or CPS_ERR_MEMORY. */
CpsStatus cpsi_directory_open(const char *path, CpsiDirectory **out, CpsError *err);

/* Whether a file of this name is to be written. */
typedef bool CpsiIsWritten(const void *user, const char *name);

/* Check whether the directory would be accepted, and the names that are to be written are free
 * (cpsi_directory_check). With `force`, its files with names of results count as capstan's from
 * then on, and may be replaced, and its .NAME.part files are removed. After a failure it is as it
 * was. A missing directory is not made. */
CpsStatus cpsi_directory_prepare(const char *path, bool force, CpsiIsWritten *is_written,
                                 const void *user, CpsError *err);

/* Find a name that is to be written but belongs to a directory, or to a file that the marker does
 * not list: CPS_ERR_IO. A commit finds the same, but after the computation. */
CpsStatus cpsi_directory_check(const CpsiDirectory *directory, CpsiIsWritten *is_written,
                               const void *user, CpsError *err);

/* The last file of a set whose replacement was interrupted, so that the others belong to two runs;
 * "" where none is missing, or where the directory is missing. Returns CPS_OK, CPS_ERR_IO or
 * CPS_ERR_MEMORY. */
CpsStatus cpsi_directory_missing(const char *path, char missing[CPSI_NAME_SIZE], CpsError *err);

/* From now on files are synced one after the other at the commit, and not when they are closed. */
void cpsi_directory_sync_late(CpsiDirectory *directory);

/* Begin the file `name`; cpsi_directory_close_file closes the stream. */
CpsStatus cpsi_directory_create(CpsiDirectory *directory, const char *name, FILE **out,
                                CpsError *err);

/* Whether a file of this name has been begun. */
bool cpsi_directory_has(const CpsiDirectory *directory, const char *name);

/* The directory as it was named when it was opened. */
const char *cpsi_directory_path(const CpsiDirectory *directory);

/* The files begun, in that order. cpsi_directory_reopen opens one for reading while it has its
 * temporary name; -1 after an error. */
size_t cpsi_directory_count(const CpsiDirectory *directory);
const char *cpsi_directory_name(const CpsiDirectory *directory, size_t i);
int cpsi_directory_reopen(const CpsiDirectory *directory, const char *name);

/* Flush, sync and close the stream of the last file; reports any earlier write to it that
 * failed. */
CpsStatus cpsi_directory_close_file(CpsiDirectory *directory, FILE *stream, CpsError *err);

/* Begin a file that another library opens: its temporary path, owned by the caller. */
CpsStatus cpsi_directory_reserve(CpsiDirectory *directory, const char *name, char **path,
                                 CpsError *err);

/* Sync a reserved file after the library has closed it. */
CpsStatus cpsi_directory_sync(CpsiDirectory *directory, const char *name, CpsError *err);

/* Rename all files into place in the order of their creation, and remove listed files of earlier
 * runs for which `stale` is true and that this run has not written. The last file is removed first
 * and renamed last. A file that the marker does not list is not replaced: CPS_ERR_IO before
 * anything has changed. */
CpsStatus cpsi_directory_commit(CpsiDirectory *directory, bool (*stale)(const char *name),
                                CpsError *err);

/* Close. Files that were not committed are removed. Accepts NULL. */
void cpsi_directory_destroy(CpsiDirectory *directory);

#endif
