/* SPDX-License-Identifier: BSD-3-Clause */
/* Mappings of a file of driven systems: each is a list of fields, known where it is read, that names its keys, checks
 * their values and says where they go. */
#ifndef CAPSTAN_SRC_IO_DRIVE_FIELDS_H
#define CAPSTAN_SRC_IO_DRIVE_FIELDS_H

#include "io/law_build.h"

/* A file being read. */
typedef struct CpsiDriveRead {
    CpsiLawBuild build; /* laws inside; build.file has name, pool and err */
    const char *path;
    size_t max_bytes;
} CpsiDriveRead;

typedef enum CpsiFieldKind {
    CPSI_FIELD_NODE,   /* const CpsiYaml *: read by the caller */
    CPSI_FIELD_TEXT,   /* const char * */
    CPSI_FIELD_COUNT,  /* int, 1 to `most` */
    CPSI_FIELD_NUMBER, /* double */
    CPSI_FIELD_POINT,  /* double[most]: exactly so many numbers */
    CPSI_FIELD_FLAG    /* bool */
} CpsiFieldKind;

typedef struct CpsiField {
    const char *name;
    CpsiFieldKind kind;
    void *out; /* keeps what is there where the key is not given */
    bool required;
    double low; /* range of numbers: least, itself excluded if `open` */
    bool open;
    int most;
    const char *help;
} CpsiField;

#define CPSI_FIELDS(field) (int)(sizeof(field) / sizeof(field)[0]), (field)

/* Read a mapping: every key is a field, required ones are there, values are of their kind. */
CpsStatus cpsi_drive_fields(CpsiDriveRead *r, const CpsiYaml *node, const char *what, int count,
                            const CpsiField *field);

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
