/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/constraint.h: ends of lines, and points where lines meet, held to convex sets (S90 remark
 * 2.3: x in C2, a perfect convex constraint). An end of the kind CPS_END_KIND_FREE, or a point of
 * the kind CPS_POINT_KIND_FREE (point.h), may be held to a closed convex set of places: a rail, a
 * half-space, a ball, a disc, a box, or any bounded set of set.h. It slides without friction where
 * the forces take it in the set; what the set does to it is a reaction r, opposite to the outward
 * normal cone at the place x: r.(y - x) >= 0 for all y in the set. Its support function is in the
 * certificate (docs/theory.md).
 *
 *     line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_FREE};              or a force on the end
 *     line.constraint[CPS_END_B] = (CpsConstraint){.kind = CPS_CONSTRAINT_KIND_RAIL,
 *                                                  .axis = {1, 0, 0}, .length = 10};
 *
 * These are plain structs like those of scene.h. The set stays where it is. */
#ifndef CAPSTAN_CONSTRAINT_H
#define CAPSTAN_CONSTRAINT_H

#include <stdbool.h>

#include "capstan/base.h"
#include "capstan/set.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum CpsConstraintKind {
    CPS_CONSTRAINT_KIND_NONE, /* it is free */
    /* a straight rail from `point` along `axis`, of `length`; INFINITY: without ends on both sides
     */
    CPS_CONSTRAINT_KIND_RAIL,
    CPS_CONSTRAINT_KIND_HALF_SPACE, /* the side of the plane through `point` to which `axis` points
                                     */
    CPS_CONSTRAINT_KIND_BALL,       /* of `radius` about `point` */
    CPS_CONSTRAINT_KIND_DISC,       /* flat, of `radius` about `point`, across `axis` */
    CPS_CONSTRAINT_KIND_BOX,        /* of `size`, with its centre at `point` and sharp edges */
    /* { point + y : y in `set` }: any bounded set of R^3, in metres, without user's sets */
    CPS_CONSTRAINT_KIND_SET
} CpsConstraintKind;

/* What the kind does not name is not read. */
typedef struct CpsConstraint {
    CpsConstraintKind kind; /* default none */
    double point[3];        /* [m] */
    double axis[3];         /* [-] of any non-zero length */
    double length, radius;  /* [m] > 0 */
    double size[3];         /* [m] > 0, along the box's own axes */
    const CpsSet *set;      /* retained by the evolution; the caller's otherwise */
    double rotation[4]; /* [-] quaternion (w, x, y, z) of the box's axes, of any non-zero length; 0
                           0 0 0: they are those of the scene */
} CpsConstraint;

/* A constraint after the last step. */
typedef struct CpsConstraintReport {
    double reaction[3]; /* [N] on the end or point */
    bool is_there;      /* otherwise all else is 0 */
    bool is_active;     /* the reaction is more than 1e-9 of the largest force in the line */
    double residual;    /* [m] from there to the set, 0 to rounding */
    double gap; /* [J] the part of the certificate's gap: support function at -r, plus r.x */
} CpsConstraintReport;

struct CpsEvolution;
/* The constraint of an end; of an end without one a report of zeros. */
CPS_API CpsConstraintReport cps_evolution_constraint_report(const struct CpsEvolution *evolution,
                                                            int line, int end);

/* ... and of a free point (point.h). */
CPS_API CpsConstraintReport
cps_evolution_point_constraint_report(const struct CpsEvolution *evolution, int point);

#ifdef __cplusplus
}
#endif
#endif
