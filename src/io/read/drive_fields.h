/* SPDX-License-Identifier: BSD-3-Clause */
/* Reading the mappings of a file of driven systems: their keys and values are checked by the table of drive_keys.h. */
#ifndef CAPSTAN_SRC_IO_READ_DRIVE_FIELDS_H
#define CAPSTAN_SRC_IO_READ_DRIVE_FIELDS_H

#include "io/schema/drive_keys.h"
#include "io/read/set_build.h"

/* A file being read. */
typedef struct CpsiDriveRead {
    CpsiLawBuild build; /* laws inside; build.file has name, pool and err */
    const char *path;
    size_t max_bytes;
} CpsiDriveRead;

/* Read a mapping: every key has a row, required ones are there, values are of their type.
 *
 *   out   the struct of this kind of mapping (drive_keys.h); what is there stays where the key is not given */
CpsStatus cpsi_drive_fields(CpsiDriveRead *r, const CpsiYaml *node, CpsiDriveMapping mapping, void *out);

/* [[x, ..], ..]: `least` rows or more of `columns` numbers; *out is the pool's. */
CpsStatus cpsi_drive_rows(CpsiDriveRead *r, const CpsiYaml *node, const char *what, int columns, int least, int *rows,
                          const double **out);

/* A law, or the terms of a resistance law, in the words of law files; the caller destroys it. */
CpsStatus cpsi_drive_law(CpsiDriveRead *r, const CpsiYaml *node, CpsLaw **out);
CpsStatus cpsi_drive_resistance(CpsiDriveRead *r, const CpsiYaml *node, CpsResistance **out);

/* A number of a scalar node; exactly `count` numbers of a list. */
CpsStatus cpsi_drive_number(CpsiDriveRead *r, const CpsiYaml *node, const char *what, double *out);
CpsStatus cpsi_drive_point(CpsiDriveRead *r, const CpsiYaml *node, const char *what, int count, double *out);

/* "WHAT: found .., expected .." at the node; INPUT. */
CpsStatus cpsi_drive_wrong(CpsiDriveRead *r, const CpsiYaml *node, const char *what, const char *expected);
/* A library call's error at the node. */
CpsStatus cpsi_drive_place(CpsiDriveRead *r, const CpsiYaml *node, const CpsError *found);
CpsStatus cpsi_drive_no_memory(CpsiDriveRead *r);

#endif
