/* SPDX-License-Identifier: BSD-3-Clause */
/* The structs into which a file of driven systems is read (drive_keys.c has the table of its
 * keys). */
#ifndef CAPSTAN_SRC_IO_SCHEMA_TABLES_DRIVE_KEYS_H
#define CAPSTAN_SRC_IO_SCHEMA_TABLES_DRIVE_KEYS_H

#include "capstan/planar.h"
#include "io/schema/keys.h"

/* Limits that prevent a small file from requiring very much work. */
enum {
    CPSI_DRIVE_MOST_PARAMETERS = 10000,
    CPSI_DRIVE_MOST_STEPS = 1000000,
    CPSI_DRIVE_MOST_ELEMENTS = 100000,
    CPSI_DRIVE_ARC_SIDES = 1000, /* sides of an arc as a path, approximately */
    CPSI_DRIVE_LONGEST_TEXT = 255
};

/* A path: rows of numbers, or an arc. */
typedef struct CpsiPathArcValues {
    const CpsiYaml *node;
    double centre[2], angle; /* angle [degrees] */
} CpsiPathArcValues;

typedef struct CpsiPathValues {
    const CpsiYaml *node; /* NULL: rows, or no path */
    CpsiNumberRows points;
    CpsiPathArcValues arc;
} CpsiPathValues;

/* ---- systems ---- */

typedef struct CpsiSystemLawValues {
    const CpsiYaml *node;
    const char *name; /* NULL: its number */
    const CpsiYaml *on, *law, *resistance;
} CpsiSystemLawValues;

typedef struct CpsiSystemValues {
    const CpsiYaml *node;
    const CpsiYaml *parameters, *constraints, *drive, *load;
    CpsiList laws; /* CpsiSystemLawValues */
    CpsiNumberRows velocity;
    double map_radius;
} CpsiSystemValues;

/* ---- bodies ---- */

typedef struct CpsiPatchValues {
    const CpsiYaml *node;
    CpsPatch patch;     /* its numbers; friction and load are NaN where not given */
    double orientation; /* [degrees] */
    int locked;         /* brake: 0: the word `locked` is given */
    const CpsiYaml *law;
    CpsiNumberRows corners;
} CpsiPatchValues;

typedef struct CpsiPushValues { /* NaN: not given */
    const CpsiYaml *node;
    double at[2], velocity[2], normal[2], speed, twist[3];
} CpsiPushValues;

typedef struct CpsiTowValues {
    const CpsiYaml *node;
    CpsTow start;                    /* without its pose and end */
    double position[2], orientation; /* orientation [degrees] */
    double end[2];                   /* NaN: not given */
    CpsiPathValues path;
    int steps;
} CpsiTowValues;

typedef struct CpsiBodyValues {
    const CpsiYaml *node;
    CpsiList patches; /* CpsiPatchValues; of a vehicle: its wheels */
    CpsiList pushes;  /* CpsiPushValues */
    CpsiTowValues tow;
} CpsiBodyValues;

/* ---- planimeters, ropes, sweeps ---- */

typedef struct CpsiCircleValues {
    const CpsiYaml *node;
    double centre[2], radius;
    int points;
} CpsiCircleValues;

typedef struct CpsiCurveValues {
    const CpsiYaml *node; /* NULL: rows */
    CpsiNumberRows points;
    CpsiCircleValues circle;
    const char *file;
} CpsiCurveValues;

typedef struct CpsiPlanimeterValues {
    const CpsiYaml *node;
    CpsPlanimeter planimeter;
    CpsiCurveValues curve;
    int steps;
} CpsiPlanimeterValues;

typedef struct CpsiRopeStraightValues {
    const CpsiYaml *node;
    double from[2], to[2];
} CpsiRopeStraightValues;

typedef struct CpsiRopeArcValues {
    const CpsiYaml *node;
    double from[2], centre[2], angle; /* angle [degrees] */
} CpsiRopeArcValues;

typedef struct CpsiRopeShapeValues {
    const CpsiYaml *node;
    CpsiRopeStraightValues straight;
    CpsiRopeArcValues arc;
    CpsiNumberRows polyline;
} CpsiRopeShapeValues;

/* The kinds of end of a rope. */
typedef enum CpsiRopeEnd { CPSI_ROPE_END_FREE, CPSI_ROPE_END_HELD } CpsiRopeEnd;

typedef struct CpsiRopeValues {
    const CpsiYaml *node;
    CpsiRopeShapeValues shape;
    int end[2];            /* CpsiRopeEnd, free unless given; or .. */
    double velocity[2][2]; /* .. a velocity, NaN: not given */
    CpsiPathValues path;
    int elements, steps, shots;
    double friction, weight;
    bool slack;
} CpsiRopeValues;

typedef struct CpsiSweepValues {
    const CpsiYaml *node;
    const CpsiYaml *law;
    double stiffness;
    CpsiNumberRows position, end;
    CpsiPathValues path;
    int steps;
} CpsiSweepValues;

/* ---- the file ---- */

/* The kind of system, in the order of the table. */
typedef enum CpsiDriveKind {
    CPSI_DRIVE_SYSTEM,
    CPSI_DRIVE_BODY,
    CPSI_DRIVE_VEHICLE,
    CPSI_DRIVE_PLANIMETER,
    CPSI_DRIVE_ROPE,
    CPSI_DRIVE_SWEEP
} CpsiDriveKind;

typedef struct CpsiDriveValues {
    const CpsiYaml *node;
    int version;
    const char *title;
    int kind; /* CpsiDriveKind */
    CpsiSystemValues system;
    CpsiBodyValues body, vehicle;
    CpsiPlanimeterValues planimeter;
    CpsiRopeValues rope;
    CpsiSweepValues sweep;
} CpsiDriveValues;

extern const CpsiMapping cpsi_drive_file;

#endif
