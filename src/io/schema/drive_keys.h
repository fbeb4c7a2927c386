/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of keys of files of driven systems: one list of rows per kind of mapping, and one struct that the rows put their values into.
 * Reading, suggestions and the JSON schema all come from it. To add a key: add its row, and the field of its struct. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_DRIVE_KEYS_H
#define CAPSTAN_SRC_IO_SCHEMA_DRIVE_KEYS_H

#include "capstan/planar.h"
#include "io/schema/keys.h"

/* Limits, so that no small file asks for very much work. */
enum {
    CPSI_DRIVE_MOST_PARAMETERS = 10000,
    CPSI_DRIVE_MOST_STEPS = 1000000,
    CPSI_DRIVE_MOST_ELEMENTS = 100000,
    CPSI_DRIVE_ARC_SIDES = 1000, /* of an arc as a path, about */
    CPSI_DRIVE_LONGEST_TEXT = 255
};

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

/* What each mapping is read into; keys that are not given leave their fields as they are. */
typedef struct CpsiFileKeys {
    int capstan;
    const char *title;
    const CpsiYaml *system, *body, *vehicle, *planimeter, *rope, *sweep;
} CpsiFileKeys;

typedef struct CpsiSystemKeys {
    const CpsiYaml *parameters, *laws, *constraints, *drive, *load, *velocity;
    double map_radius;
} CpsiSystemKeys;

typedef struct CpsiLawKeys {
    const char *name;
    const CpsiYaml *on, *law, *resistance;
} CpsiLawKeys;

typedef struct CpsiBodyKeys {
    const CpsiYaml *patches, *push, *tow; /* the patches of a vehicle are its wheels */
} CpsiBodyKeys;

typedef struct CpsiPatchKeys {
    CpsPatch patch; /* its numbers */
    const CpsiYaml *law, *brake, *corners;
} CpsiPatchKeys;

typedef struct CpsiPushKeys {
    double at[2], velocity[2], normal[2], speed, twist[3];
} CpsiPushKeys;

typedef struct CpsiTowKeys {
    CpsTow start; /* without its end */
    double end[2];
    const CpsiYaml *path;
    int steps;
} CpsiTowKeys;

typedef struct CpsiPlanimeterKeys {
    CpsPlanimeter planimeter;
    const CpsiYaml *curve;
    int steps;
} CpsiPlanimeterKeys;

typedef struct CpsiCurveKeys {
    const CpsiYaml *circle, *file;
} CpsiCurveKeys;

typedef struct CpsiCircleKeys {
    double center[2], radius;
    int points;
} CpsiCircleKeys;

typedef struct CpsiRopeKeys {
    const CpsiYaml *shape, *ends, *path;
    int elements, steps, shots;
    double friction, weight;
    bool slack;
} CpsiRopeKeys;

typedef struct CpsiShapeKeys {
    const CpsiYaml *straight, *arc, *points;
} CpsiShapeKeys;

typedef struct CpsiStraightKeys {
    double from[2], to[2];
} CpsiStraightKeys;

typedef struct CpsiArcKeys {
    double center[2], radius, from, turn;
} CpsiArcKeys;

typedef struct CpsiEndsKeys {
    const CpsiYaml *A, *B;
} CpsiEndsKeys;

typedef struct CpsiSweepKeys {
    const CpsiYaml *law, *position, *end, *path;
    double stiffness;
    int steps;
} CpsiSweepKeys;

typedef struct CpsiPathKeys {
    const CpsiYaml *arc;
} CpsiPathKeys;

typedef struct CpsiPathArcKeys {
    double center[2], turn;
} CpsiPathArcKeys;

enum { CPSI_DRIVE_MOST_KEYS = 10 };

typedef struct CpsiDriveWord {
    const char *name;  /* in messages: "'arc'" */
    const char *alias; /* in the schema: "path_arc" */
    const char *also;  /* JSON schema of what keys go together; NULL: nothing more than their rows say */
    CpsiKey key[CPSI_DRIVE_MOST_KEYS]; /* up to the first one without a name */
} CpsiDriveWord;

const CpsiDriveWord *cpsi_drive_word(CpsiDriveMapping mapping);

/* How many keys it has. */
int cpsi_drive_word_count(const CpsiDriveWord *word);

#endif
