/* SPDX-License-Identifier: BSD-3-Clause */
/* The list of a run's files in its summary: a file with another size or checksum does not belong to
 * this run. */
#ifndef CAPSTAN_SRC_IO_BASE_DIRECTORY_FILE_LIST_H
#define CAPSTAN_SRC_IO_BASE_DIRECTORY_FILE_LIST_H

#include "io/base/directory/write_directory.h"

/* Write "files": [..], all files begun in the directory except the last, which is the summary
 * itself. They have been closed by now. Returns CPS_OK, CPS_ERR_IO or CPS_ERR_MEMORY. */
CpsStatus cpsi_result_list_add(const CpsiDirectory *directory, FILE *out, CpsError *err);

#endif
