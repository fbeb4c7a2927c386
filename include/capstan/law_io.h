/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/law_io.h: laws read from YAML, and pictures of them.
 *     (library capstan-io; docs/formats.md, "Laws") */
#ifndef CAPSTAN_LAW_IO_H
#define CAPSTAN_LAW_IO_H

#include <stdio.h>

#include "capstan/io.h"
#include "capstan/law.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A law read from a file. */
typedef struct CpsLawFile CpsLawFile;

/* Read a law. As cps_scene_read: `path` is a regular file, or "-" for standard input; of `limits`
 * (NULL: defaults) bytes and depth count; on bad input `err` has file, line and column.
 *
 * A set may have 32 components; sets that are not answered in closed form (intersections,
 * preimages, sums, ..) may have 300 components, points and rows all together: more is
 * CPS_ERR_LIMIT, so that no file takes longer than about a minute. Larger ones are made with
 * law.h. */
CPS_API CpsStatus cps_law_read(const char *path, const CpsReadLimits *limits, CpsLawFile **out,
                               CpsError *err);
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
/* Has the law a preimage? Then *composition is the weakest condition among them, found in *line of
 * the file. */
CPS_API bool cps_law_file_composition(const CpsLawFile *file, CpsComposition *composition,
                                      int *line);

/* Write the JSON schema (draft 2020-12) of law files, from the same table of words that the reader
 * uses. */
CPS_API CpsStatus cps_law_write_schema(FILE *out, CpsError *err);

/* What a picture shows. */
typedef struct CpsLawPicture {
    const char *title;
    int axis[2]; /* components drawn to the right and up, from 0 */
    int velocity_count;
    const double *velocity; /* (velocity_count x n) drawn with their force sets */
    int force_count;
    const double *force; /* (force_count x n) drawn with their velocities */
} CpsLawPicture;

/* Draw a set of forces as SVG: a planar one with the normal cones at its corners; of more
 * dimensions the section through 0 along two axes and, dashed, the shadow on them (alone where the
 * plane misses a set that a load has moved); with each velocity and its set of forces. A set
 * without bounds goes on beyond the frame; of one component it is drawn as the graph of forces over
 * velocity.
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT (also where the set is empty) or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_law_draw(const CpsSet *set, const CpsLawPicture *picture, FILE *out,
                               CpsError *err);

/* Draw a resistance law as SVG: of one component the graph of forces over velocity, of more the
 * forces at five speeds, up to the largest of the velocities asked for, in all directions of the
 * plane of two components. */
CPS_API CpsStatus cps_resistance_draw(const CpsResistance *law, const CpsLawPicture *picture,
                                      FILE *out, CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
