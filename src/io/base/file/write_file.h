/* SPDX-License-Identifier: BSD-3-Clause */
/* The end of every file that is written (cps_write_file of capstan/io.h, write_directory.h). */
#ifndef CAPSTAN_SRC_IO_BASE_FILE_WRITE_FILE_H
#define CAPSTAN_SRC_IO_BASE_FILE_WRITE_FILE_H

#include <stdbool.h>
#include <stdio.h>

/* Flush, sync if `sync`, and close. Returns 0, or the errno of the first failure, also of a write
 * before. */
int cpsi_close_stream(FILE *stream, bool sync);

#endif
