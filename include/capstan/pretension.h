/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/pretension.h: the length at which a line has a wanted tension where it starts.
 *
 *     double length;
 *     status = cps_scene_length_for(&scene, 0, CPS_WHOLE_LINE, CPS_END_B, CPS_PULL_TENSION, 1e6,
 *                                   &length, &err);
 *     if (!status) cps_line_resize(&line, CPS_WHOLE_LINE, length, &arrays);
 *
 * Moorings are set up by their tension; their lengths follow. */
#ifndef CAPSTAN_PRETENSION_H
#define CAPSTAN_PRETENSION_H

#include "capstan/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The section whose length is meant: none, all elements of the line change in proportion. */
enum { CPS_WHOLE_LINE = -1 };

typedef enum CpsPull {
    CPS_PULL_TENSION,   /* the size of the force at the end */
    CPS_PULL_HORIZONTAL /* the size of its part across gravity */
} CpsPull;

/* Find the natural length of line `line`, or of its section `section` (from 0 at A), at which the
 * static start without friction has the pull `wanted` at `end`. The line starts statically between
 * ends that are held, or at points, which stay where they begin with all bodies; the other lines do
 * not matter. Its present length says nothing but how many elements it has.
 *
 * A line that hangs has a least tension: of two lengths with the same tension the shorter one is
 * found, at which the line is the tauter.
 *
 * length   [m] written where it is found
 *
 * Returns CPS_OK, an error of cps_scene_check or cps_evolution_create, or CPS_ERR_ARGUMENT where
 * the line is not as said, or has that tension at no length; then the message has the nearest
 * one. */
CPS_API CpsStatus cps_scene_length_for(const CpsScene *scene, int line, int section, int end,
                                       CpsPull pull, double wanted, double *length, CpsError *err);

/* Arrays of as many entries as the line has; those that it has not may be NULL. */
typedef struct CpsLineArrays {
    double *element_length; /* (element_count) */
    CpsSection *section;
    CpsPointWeight *point_weight;
    CpsFrictionZone *zone;
} CpsLineArrays;

/* Give a line, or one of its sections, another length: its elements, and clumps, buoys and friction
 * zones in it, move in proportion, and what lies behind them moves along. They are written to
 * `arrays`, to which the line refers from then on, and which may be those to which it refers.
 * section   CPS_WHOLE_LINE, or 0..section_count - 1
 * length    [m] > 0 */
CPS_API void cps_line_resize(CpsLine *line, int section, double length,
                             const CpsLineArrays *arrays);

#ifdef __cplusplus
}
#endif
#endif
