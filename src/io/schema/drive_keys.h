/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of keys of files of driven systems: one list of fields per kind of mapping. Reading, suggestions and the
 * JSON schema all come from it. To add a key: add a row to its mapping, and where that mapping is read a place for it
 * to go to, in the same order. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_DRIVE_KEYS_H
#define CAPSTAN_SRC_IO_SCHEMA_DRIVE_KEYS_H

#include <stdbool.h>

/* Limits, so that no small file asks for very much work. */
enum {
    CPSI_DRIVE_MOST_PARAMETERS = 10000,
    CPSI_DRIVE_MOST_STEPS = 1000000,
    CPSI_DRIVE_MOST_ELEMENTS = 100000,
    CPSI_DRIVE_ARC_SIDES = 1000 /* of an arc as a path, about */
};

/* What stands under a key, and what reading makes of it; from CPSI_FIELD_MAPPING on that is the node itself, const
 * CpsiYaml *, and the caller reads it. */
typedef enum CpsiFieldKind {
    CPSI_FIELD_TEXT,   /* const char * */
    CPSI_FIELD_COUNT,  /* int, 1 to `most` */
    CPSI_FIELD_NUMBER, /* double */
    CPSI_FIELD_POINT,  /* double[most]: exactly so many numbers */
    CPSI_FIELD_FLAG,   /* bool */

    CPSI_FIELD_MAPPING,  /* of the kind `inside` */
    CPSI_FIELD_LIST,     /* of such mappings, at least one */
    CPSI_FIELD_PATCHES,  /* list of {WORD: mapping}, one of the kinds of patch each */
    CPSI_FIELD_VECTOR,   /* as many numbers as the law has components */
    CPSI_FIELD_ROWS,     /* at least `low` rows of `most` numbers, of any one number where that is 0 */
    CPSI_FIELD_PATH,     /* rows of numbers, or a mapping */
    CPSI_FIELD_CURVE,    /* at least 3 rows of 2 numbers, or a mapping */
    CPSI_FIELD_NAMES,    /* names of parameters, at most `most` */
    CPSI_FIELD_MAP,      /* combinations of parameters */
    CPSI_FIELD_BY_NAME,  /* numbers by parameter */
    CPSI_FIELD_LAW,      /* a law, in the words of law files */
    CPSI_FIELD_TERMS,    /* the terms of a resistance law */
    CPSI_FIELD_BRAKE,    /* a torque of at least 0, or "locked" */
    CPSI_FIELD_END,      /* "free", "held" or a velocity of 2 numbers */
    CPSI_FIELD_FILE_NAME /* of a file */
} CpsiFieldKind;

typedef enum CpsiDriveMapping {
    CPSI_DRIVE_FILE,
    CPSI_DRIVE_SYSTEM,
    CPSI_DRIVE_LAW,
    CPSI_DRIVE_BODY,
    CPSI_DRIVE_VEHICLE,
    CPSI_DRIVE_PATCH, /* six of these, in the order of CpsPatchKind */
    CPSI_DRIVE_PUSH = CPSI_DRIVE_PATCH + 6,
    CPSI_DRIVE_TOW,
    CPSI_DRIVE_PLANIMETER,
    CPSI_DRIVE_CURVE,
    CPSI_DRIVE_CIRCLE,
    CPSI_DRIVE_ROPE,
    CPSI_DRIVE_SHAPE,
    CPSI_DRIVE_STRAIGHT,
    CPSI_DRIVE_ARC,
    CPSI_DRIVE_ENDS,
    CPSI_DRIVE_SWEEP,
    CPSI_DRIVE_PATH,
    CPSI_DRIVE_PATH_ARC,
    CPSI_DRIVE_MAPPINGS
} CpsiDriveMapping;

typedef struct CpsiField {
    const char *name;
    CpsiFieldKind kind;
    bool required;
    double low; /* range of numbers: least, itself excluded if `open` */
    bool open;
    int most;
    const char *help;
    CpsiDriveMapping inside; /* of mappings and lists of them */
} CpsiField;

enum { CPSI_DRIVE_MOST_FIELDS = 10 };

typedef struct CpsiDriveWord {
    const char *name;  /* in messages: "'arc'" */
    const char *alias; /* in the schema: "path_arc" */
    const char *also;  /* JSON schema of what keys go together; NULL: nothing more than their rows say */
    CpsiField field[CPSI_DRIVE_MOST_FIELDS]; /* up to the first one without a name */
} CpsiDriveWord;

const CpsiDriveWord *cpsi_drive_word(CpsiDriveMapping mapping);

/* How many fields it has. */
int cpsi_drive_word_count(const CpsiDriveWord *word);

#endif
