/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/drive_io.h: driven systems read from YAML, and pictures of them.
 *                                                       (library capstan-io; docs/formats.md,
 *                                                           "Driven systems") */
#ifndef CAPSTAN_DRIVE_IO_H
#define CAPSTAN_DRIVE_IO_H

#include <stdio.h>

#include "capstan/drive.h"
#include "capstan/io.h"
#include "capstan/planar.h"
#include "capstan/rope.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- what a file holds: one of these ---- */

typedef enum CpsDriveKind {
    CPS_DRIVE_SYSTEM, /* laws on combinations of named parameters */
    CPS_DRIVE_BODY,   /* a body that slides on a plane, or a vehicle */
    CPS_DRIVE_PLANIMETER,
    CPS_DRIVE_ROPE,
    CPS_DRIVE_SWEEP
} CpsDriveKind;

typedef struct CpsDriveSystem {
    CpsSystem *system;
    int parameters;
    const char *const *parameter; /* (parameters) names */
    int driven;
    const char *const *drive; /* (driven) what is driven, "roll - 0.3 omega" */
    bool loaded;
    int velocity_count;
    const double *velocity; /* (velocity_count, driven) asked in the file */
    double map_radius;      /* pictures show |W_i| up to it */
} CpsDriveSystem;

/* A motion imposed on a body: map x twist = velocity. */
typedef struct CpsDrivePush {
    int rows;
    double map[9], velocity[3];
    bool at_point;
    double point[2], way[2]; /* where it is pushed, and how: for pictures */
} CpsDrivePush;

/* A path of the hitch or of the rope's far end. */
typedef struct CpsDriveTow {
    CpsTow start;
    int points;         /* 0: no path */
    const double *path; /* (points, 2) [m] the first is where the hitch or end is at the start */
    int steps;          /* equal ones along the path */
} CpsDriveTow;

typedef struct CpsDriveBody {
    CpsPlanar *planar;
    bool vehicle;
    int patches;
    const CpsPatch *patch;
    int pushes;
    const CpsDrivePush *push;
    CpsDriveTow tow;
} CpsDriveBody;

typedef struct CpsDrivePlanimeter {
    CpsPlanimeter planimeter;
    int points;
    const double *point; /* (points, 2) [m] closed curve */
    int steps;           /* on every side */
} CpsDrivePlanimeter;

typedef struct CpsDriveRope {
    CpsRope rope;
    double friction, weight; /* their product is rope.resistance */
    double driving[4];       /* [m/s] of the driven ends, first end first */
    int points;              /* of the path of the last end, 0: none */
    const double *path;      /* (points, 2) [m] */
    int steps, shots;        /* load steps; pictures in the strip */
} CpsDriveRope;

typedef struct CpsDriveSweep {
    const CpsLaw *law;
    int space; /* 1 or 2 */
    CpsSweep start;
    int points;
    const double *path; /* (points, space) [m] of the spring's far end */
    int steps;
} CpsDriveSweep;

/* Read-only; all owned by the file. Only the part of its kind is filled. */
typedef struct CpsDriveFile {
    const char *title; /* "" without */
    CpsDriveKind kind;
    CpsDriveSystem system;
    CpsDriveBody body;
    CpsDrivePlanimeter planimeter;
    CpsDriveRope rope;
    CpsDriveSweep sweep;
} CpsDriveFile;

/* Read a file. As cps_law_read: `path` is a regular file, or "-" for standard input; on bad input
 * `err` has file, line and column. A curve named in the file is looked for beside it. */
CPS_API CpsStatus cps_drive_read(const char *path, const CpsReadLimits *limits, CpsDriveFile **out,
                                 CpsError *err);
CPS_API void cps_drive_file_destroy(CpsDriveFile *file); /* NULL is accepted */

/* Write the JSON schema (draft 2020-12) of such files, from the same table of keys that the reader
 * uses. */
CPS_API CpsStatus cps_drive_write_schema(FILE *out, CpsError *err);

/* `count` points evenly spaced along a path, its ends included.
 *
 *   path   (points, space), points >= 2
 *   out    (count, space), written; nothing where a size is less than that, or a pointer NULL */
CPS_API void cps_drive_walk(int space, int points, const double *path, int count, double *out);

/* ---- pictures ---- */

/* Called between parts of long work. */
typedef void CpsDriveProgress(void *user, int done, int all);

/* Of a system with two driven components and W from -map_radius to map_radius: the resistance G and
 * gamma as one map, every parameter (the first six) as one more. Each is solved for on a grid. */
CPS_API CpsStatus cps_drive_draw_system(const CpsDriveFile *file, CpsDriveProgress *progress,
                                        void *user, FILE *out, CpsError *err);

/* Of a body: its limit surface seen along two components, with the ellipsoid of equal axes; its
 * outline with pushes, their motions and centres of rotation.
 *
 *   poses  (count, 3) poses along the tow; NULL: none
 *   ends   (count, 2) hitch or rope's end */
CPS_API CpsStatus cps_drive_draw_body(const CpsDriveFile *file, int count, const double *poses,
                                      const double *ends, FILE *out, CpsError *err);

CPS_API CpsStatus cps_drive_draw_planimeter(const CpsDriveFile *file,
                                            const CpsPlanimeterReading *reading, FILE *out,
                                            CpsError *err);

/* Of a rope: its shape with velocities, sliding and resting parts, tension along it; and shapes on
 * the way.
 *
 *   motion  of cps_rope_system
 *   shots   (count, nodes, 2) shapes, the first being the start; NULL: none
 */
CPS_API CpsStatus cps_drive_draw_rope(const CpsDriveFile *file, const CpsMotion *motion, int count,
                                      const double *shots, FILE *out, CpsError *err);

/* Of a block on a spring: its path, or in one component position and force over the moved end.
 *
 *   end, position, force  (count, space) */
CPS_API CpsStatus cps_drive_draw_sweep(const CpsDriveFile *file, int count, const double *end,
                                       const double *position, const double *force, FILE *out,
                                       CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
