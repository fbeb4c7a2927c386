/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/io.h: read scenes, laws and driven systems from YAML (library capstan-io).
 *
 * The formats are described in docs/formats.md, docs/laws.md and docs/drive.md. What is read from a
 * file belongs to the handle and is valid until that is destroyed. */
#ifndef CAPSTAN_IO_H
#define CAPSTAN_IO_H

#include <stdio.h>

#include "capstan/planar.h"
#include "capstan/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- scenes ---- */

/* A scene that was read from a file, with its memory. */
typedef struct CpsSceneFile CpsSceneFile;

/* Limits on what is read. */
typedef struct CpsReadLimits {
    uint32_t cookie;      /* of cps_read_limits_default(): limits made otherwise are refused */
    size_t max_bytes;     /* file size, default 64 MiB */
    int max_depth;        /* nesting of mappings and sequences, default 64 */
    int64_t max_elements; /* of all lines together, default 10 000 000 */
    int64_t max_pairs;    /* elements of all lines, times obstacles, default 100 000 000 */
    int64_t max_steps;    /* load steps of the history, default 1 000 000 */
} CpsReadLimits;
CPS_API CpsReadLimits cps_read_limits_default(void);

/* Read a scene and check it by cps_scene_check.
 *
 *   path    of a regular file, or "-" for standard input
 *   limits  NULL: the defaults
 *   out     a handle, which the caller destroys; NULL on failure
 *   err     on bad input: file, line and column (from 1), what was found and what was expected
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_INPUT, CPS_ERR_IO, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_scene_read(const char *path, const CpsReadLimits *limits, CpsSceneFile **out,
                                 CpsError *err);
/* Read a scene from a text that ends with a zero byte, as a program has it that writes scenes.
 *
 *   name   the file's name in messages; files that the scene names lie beside it. It need not exist
 *
 * All else as above. */
CPS_API CpsStatus cps_scene_read_text(const char *text, const char *name,
                                      const CpsReadLimits *limits, CpsSceneFile **out,
                                      CpsError *err);
CPS_API void cps_scene_file_destroy(CpsSceneFile *file);
CPS_API const CpsScene *cps_scene_file_scene(const CpsSceneFile *file);

/* Write the JSON schema (draft 2020-12) of scenes, from the table of keys of the reader. */
CPS_API CpsStatus cps_scene_write_schema(FILE *out, CpsError *err);

/* Write a text and a number as JSON. The text is quoted and escaped as in summary.json. The number
 * has as many digits as are needed to read it back unchanged; it is null where it is not finite.
 * The locale of the calling thread must have a decimal point. */
CPS_API void cps_json_text(FILE *out, const char *text);
CPS_API void cps_json_number(FILE *out, double x);

/* Read up to `most` >= 1 numbers of at most 1e100 from a row of text.
 *
 *   separators  one of these characters stands between two numbers, and blanks may stand beside it;
 *               where a blank is among them, blanks alone separate as well
 *   value       (most) out
 *   rest        out: the text behind the last number read, without leading blanks
 *
 * Returns how many numbers were read. The locale of the calling thread must have a decimal point.
 */
CPS_API int cps_row_read(const char *text, const char *separators, int most, double *value,
                         const char **rest);

/* The most similar of several candidates, for messages "did you mean ..?". Begin with {.word = the
 * word found}, and call cps_suggest for each candidate. At most a third of the letters of a
 * candidate may differ; one that begins with the word, of two letters or more, counts as one letter
 * that differs. */
typedef struct CpsSuggestion {
    const char *word, *best; /* best is NULL while no candidate is similar enough */
    int distance;            /* number of letters by which best differs */
} CpsSuggestion;
CPS_API void cps_suggest(CpsSuggestion *suggestion, const char *candidate);

/* Write one file completely or not at all: it is written under another name beside `path`, synced
 * and renamed, so that an old file remains after a failure. A program that is killed meanwhile
 * leaves the other file, .NAME.PID.part. A device or pipe is written directly, as is standard
 * output by a link to it (/dev/stdout).
 *
 *   write   writes to the open file; after a status other than CPS_OK nothing remains
 *   user    argument of `write`
 *
 * Returns CPS_OK, CPS_ERR_IO, CPS_ERR_MEMORY, CPS_ERR_ARGUMENT or the status of `write`. */
typedef CpsStatus CpsFileWriter(void *user, FILE *out, CpsError *err);
CPS_API CpsStatus cps_write_file(const char *path, CpsFileWriter *write, void *user, CpsError *err);

/* ---- laws ---- */

/* A law read from a file. */
typedef struct CpsLawFile CpsLawFile;

/* Read a law. Arguments and statuses are those of cps_scene_read; of the limits only bytes and
 * depth apply.
 *
 * A set may have 32 components. Sets whose queries have no closed form (intersections, preimages,
 * sums, ..) may have k components, points and rows in all, k^3 times the components of the largest
 * at most 20e6: 215 with 2 components, 149 with 6, 85 with 32. More is CPS_ERR_LIMIT, so that a
 * file is read in about two seconds; larger ones are made with law.h. */
CPS_API CpsStatus cps_law_read(const char *path, const CpsReadLimits *limits, CpsLawFile **out,
                               CpsError *err);
/* The same from a text, as cps_scene_read_text. */
CPS_API CpsStatus cps_law_read_text(const char *text, const char *name, const CpsReadLimits *limits,
                                    CpsLawFile **out, CpsError *err);
CPS_API void cps_law_file_destroy(CpsLawFile *file); /* NULL is accepted */

/* All owned by the file. */
CPS_API const char *cps_law_file_title(const CpsLawFile *file); /* "" without */
CPS_API int cps_law_file_space(const CpsLawFile *file);
/* The set of forces: of the friction law, or of the loaded law where the file has a load; NULL for
 * a resistance law. */
CPS_API const CpsSet *cps_law_file_set(const CpsLawFile *file);
CPS_API const CpsLoadedLaw *cps_law_file_loaded(const CpsLawFile *file); /* NULL without a load */
CPS_API const CpsResistance *
cps_law_file_resistance(const CpsLawFile *file); /* NULL for a friction law */
/* Whether the law contains preimages. Then *composition is the weakest of their conditions, and
 * *line is its line in the file. */
CPS_API bool cps_law_file_composition(const CpsLawFile *file, CpsComposition *composition,
                                      int *line);

/* Write the JSON schema (draft 2020-12) of law files, from the table of keys of the reader. */
CPS_API CpsStatus cps_law_write_schema(FILE *out, CpsError *err);

/* ---- driven systems: a file contains one of these ---- */

typedef enum CpsDriveKind {
    CPS_DRIVE_SYSTEM, /* laws on combinations of named parameters */
    CPS_DRIVE_BODY,   /* a body that slides on a plane, or a vehicle */
    CPS_DRIVE_PLANIMETER,
    CPS_DRIVE_ROPE,
    CPS_DRIVE_SWEEP
} CpsDriveKind;

typedef struct CpsDriveSystem {
    CpsSystem *system;
    int parameter_count;
    const char *const *parameter; /* (parameter_count) names */
    int driven_count;
    const char *const *drive; /* (driven_count) the driven components as text, "roll - 0.3 omega" */
    bool loaded;              /* a constant load acts */
    int velocity_count;
    const double *velocity; /* (velocity_count, driven_count) driving velocities of the file */
    double map_radius;      /* largest |W_i| in pictures */
} CpsDriveSystem;

/* A motion imposed on a body: map x twist = velocity. */
typedef struct CpsDrivePush {
    int row_count;
    double map[9], velocity[3];
    bool at_point;                      /* it is pushed at a point: */
    double point[2], point_velocity[2]; /* [m], [m/s] the point and its velocity, for pictures */
} CpsDrivePush;

/* A path of the hitch or of the rope's far end. */
typedef struct CpsDriveTow {
    CpsTow start;
    int point_count; /* 0: no path */
    const double
        *path;      /* (point_count, 2) [m] the first is where the hitch or end is at the start */
    int step_count; /* equal steps along the path */
} CpsDriveTow;

typedef struct CpsDriveBody {
    CpsPlanar *planar;
    bool vehicle;
    int patch_count;
    const CpsPatch *patch;
    int push_count;
    const CpsDrivePush *push;
    CpsDriveTow tow;
} CpsDriveBody;

typedef struct CpsDrivePlanimeter {
    CpsPlanimeter planimeter;
    int point_count;
    const double *point; /* (point_count, 2) [m] closed curve */
    int step_count;      /* on every side */
} CpsDrivePlanimeter;

typedef struct CpsDriveRope {
    CpsRope rope;
    double friction, weight;    /* their product is rope.resistance */
    double driving[4];          /* [m/s] of the driven ends, first end first */
    int point_count;            /* of the path of the last end, 0: none */
    const double *path;         /* (point_count, 2) [m] */
    int step_count, shot_count; /* load steps; pictures in the strip */
} CpsDriveRope;

typedef struct CpsDriveSweep {
    const CpsLaw *law;
    int space; /* 1 or 2 */
    CpsSweep start;
    int point_count;
    const double *path; /* (point_count, space) [m] of the spring's far end */
    int step_count;
} CpsDriveSweep;

/* The contents of a file, owned by it. Only the member of its kind is filled. */
typedef struct CpsDriveFile {
    const char *title; /* "" without */
    CpsDriveKind kind;
    CpsDriveSystem system;
    CpsDriveBody body;
    CpsDrivePlanimeter planimeter;
    CpsDriveRope rope;
    CpsDriveSweep sweep;
} CpsDriveFile;

/* Read a driven system, as cps_law_read reads a law. A curve that the file names must lie beside
 * it. */
CPS_API CpsStatus cps_drive_read(const char *path, const CpsReadLimits *limits, CpsDriveFile **out,
                                 CpsError *err);
/* The same from a text, as cps_scene_read_text. */
CPS_API CpsStatus cps_drive_read_text(const char *text, const char *name,
                                      const CpsReadLimits *limits, CpsDriveFile **out,
                                      CpsError *err);
CPS_API void cps_drive_file_destroy(CpsDriveFile *file); /* NULL is accepted */

/* Write the JSON schema (draft 2020-12) of driven systems, from the table of keys of the reader. */
CPS_API CpsStatus cps_drive_write_schema(FILE *out, CpsError *err);

/* Place `count` >= 2 points at equal distances along a path, its ends included.
 *
 *   path   (points, space), points >= 2
 *   out    (count, space); not changed where a size is too small or a pointer is NULL */
CPS_API void cps_drive_walk(int space, int points, const double *path, int count, double *out);

#ifdef __cplusplus
}
#endif
#endif
