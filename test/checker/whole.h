/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether a result file belongs to the set of files around it. Two runs into one directory, the
 * second of which was interrupted while it renamed its files, leave files of both. */
#ifndef CAPSTAN_TEST_CHECKER_WHOLE_H
#define CAPSTAN_TEST_CHECKER_WHOLE_H

#include <stdio.h>

/* Findings about the file beside its .capstan and summary.json, told to `out`; 0 where neither is
 * there. */
int whole_file(const char *path, FILE *out);

/* Findings about all the files that the summary `path` lists. */
int whole_set(const char *path, FILE *out);

#endif
