/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/failure.h: ends that are let go, and lines that part.
 *
 * A stage or a move lets an end go by a change of the kind CPS_END_KIND_RELEASED: from that step on
 * it is free, without a force, and no longer at its point, which keeps its other lines:
 *
 *     CpsChange change = {.line = 2, .end = CPS_END_B, .to = {.kind = CPS_END_KIND_RELEASED}};
 *
 * A line with a `break_at` parts where its tension exceeds it. A step is first solved as it is
 * asked for; where it is certified and a line is above its break_at, the next step is a break: the
 * line that is above by the largest factor, the first one of equals, is let go at the end nearest
 * to where that is, and nothing else changes. Then others may be above, or the same line at its
 * other end: these follow, one break at a time, and after them the history goes on. A break is a
 * step that cps_evolution_step takes; no move may be taken before it. A line above its break_at
 * with both ends free and without force stays as it is. Stages that change an end which has parted
 * leave it alone; a move may take hold of it. */
#ifndef CAPSTAN_FAILURE_H
#define CAPSTAN_FAILURE_H

#include "capstan/evolve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whether an end of a line was let go. */
typedef enum CpsRelease {
    CPS_RELEASE_NONE,     /* it was not: one at a point is there */
    CPS_RELEASE_BY_STAGE, /* by a stage or a move */
    CPS_RELEASE_BY_BREAK, /* the line parted there */
    CPS_RELEASE_TAKEN     /* it was, and a later change has held or loaded it; it is at no point */
} CpsRelease;

CPS_API const char *
cps_release_name(CpsRelease release); /* "none", "released", "parted", "taken" */

/* What is known of the failure of a line after the last step. */
typedef struct CpsLineFailure {
    CpsRelease release[2];  /* of ends A and B */
    bool has_break_at;      /* of a line of which a part has one; otherwise the next two are 0 */
    double share;           /* [-] largest tension over its break_at, of elements and ends */
    double arc_length;      /* [m] where that is; of equals to 1e-9 end B, then A */
    const double *break_at; /* (element_count) [N] INFINITY of elements without one; else NULL */
} CpsLineFailure;

/* The failure of a line; of what is no line one of zeros. The array belongs to the evolution. */
CPS_API CpsLineFailure cps_evolution_line_failure(const CpsEvolution *evolution, int line);

/* The break that the last step was. */
typedef struct CpsBreak {
    bool is_break;     /* it was one; otherwise all else is 0 */
    int line, end;     /* index in the scene; the end that was let go */
    double tension;    /* [N] that exceeded break_at, in the step before */
    double break_at;   /* [N] there */
    double arc_length; /* [m] natural, from end A, where it did */
} CpsBreak;

CPS_API CpsBreak cps_evolution_break(const CpsEvolution *evolution);

/* Whether the next step is a break: a line is above its break_at. */
CPS_API bool cps_evolution_breaks(const CpsEvolution *evolution);

#ifdef __cplusplus
}
#endif
#endif
