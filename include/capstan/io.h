/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/io.h: read scenes from YAML, write results and pictures.       (library capstan-io; docs/formats.md) */
#ifndef CAPSTAN_IO_H
#define CAPSTAN_IO_H

#include <stdio.h>

#include "capstan/evolve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A scene read from a file, with the memory it lives in. */
typedef struct CpsSceneFile CpsSceneFile;

/* Limits on what is read; all have generous defaults. */
typedef struct CpsReadLimits {
    size_t max_bytes;   /* file size, default 64 MiB */
    int max_depth;      /* nesting of mappings and sequences, default 64 */
    int64_t max_elements; /* of all lines together, default 10 000 000 */
    int64_t max_steps;    /* load steps of the history, default 1 000 000 */
} CpsReadLimits;
CPS_API CpsReadLimits cps_read_limits_default(void);

/* Read a scene.
 *
 *   path    a regular file; "-" reads standard input
 *   limits  NULL: defaults
 *   err     on bad input: file, line and column (from 1), what was found, what was expected
 *
 * Returns CPS_OK, CPS_ERR_INPUT, CPS_ERR_IO, CPS_ERR_LIMIT or CPS_ERR_MEMORY. The scene has also passed
 * cps_scene_check. */
CPS_API CpsStatus cps_scene_read(const char *path, const CpsReadLimits *limits, CpsSceneFile **out, CpsError *err);
CPS_API void cps_scene_file_destroy(CpsSceneFile *file);
CPS_API const CpsScene *cps_scene_file_scene(const CpsSceneFile *file);

/* Write the JSON schema (draft 2020-12) of scenes, from the same table of keys that the reader uses. */
CPS_API CpsStatus cps_scene_write_schema(FILE *out, CpsError *err);

/* A directory of results: summary.json, history.csv, result.nc, one .vtp per step with a .pvd, SVG pictures. */
typedef struct CpsResults CpsResults;

/* Open `directory` (made if missing; one level) for the results of `evolution`. Nothing that was there is touched until
 * cps_results_finish, which renames each finished file into place.
 *
 * Returns CPS_OK, CPS_ERR_IO or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_results_open(const char *directory, const CpsScene *scene, const CpsEvolution *evolution,
                                   CpsResults **out, CpsError *err);

/* Append the step just taken (all lines). result.nc is synced. */
CPS_API CpsStatus cps_results_append(CpsResults *results, const CpsEvolution *evolution, CpsError *err);

/* Write what needs the whole history (summary, pictures), close and rename everything into place.
 *   wall   [s] time of the whole run, for the summary
 * On failure the temporary files are removed and what was there before stays. */
CPS_API CpsStatus cps_results_finish(CpsResults *results, double wall, CpsError *err);

/* Close without keeping unfinished files; accepts NULL; needed after cps_results_finish too. */
CPS_API void cps_results_destroy(CpsResults *results);

/* A running JSON summary, the object that `capstan run --json` prints. */
CPS_API CpsStatus cps_results_write_summary(const CpsResults *results, double wall, FILE *out, CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
