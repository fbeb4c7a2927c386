/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/rope.h: a heavy inextensible rope that lies on a rough table.
 *     (Moreau 1977, M77, remark of section 11)
 *
 * The rope is a chain of nodes joined by straight elements that keep their length. Each node
 * carries the friction of the half elements next to it, a disc; each element asks t . (v of its far
 * node - v of its near node) = 0 with its unit direction t, or <= 0 where it may go slack: M77's
 * rope keeps its length, so that it can push as well. With the ends driven, the velocity field has
 * the least dissipation among those that the rope admits: a system of drive.h, solved in time
 * linear in the nodes. Force of an element's law: minus its tension. */
#ifndef CAPSTAN_ROPE_H
#define CAPSTAN_ROPE_H

#include <stdbool.h>

#include "capstan/drive.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CpsRope {
    int nodes;          /* >= 2, at most CPS_ROPE_MAX_NODES */
    const double *node; /* [m] (nodes, 2); neighbours differ */
    double resistance;  /* [N/m] friction coefficient x weight per length, >= 0 */
    bool driven[2];     /* is the first, the last node's velocity imposed? */
    bool slack; /* may elements become shorter, without tension?  false: inextensible, as in M77 */
} CpsRope;

#define CPS_ROPE_MAX_NODES 1000000

/* Would this rope be accepted? */
CPS_API CpsStatus cps_rope_check(const CpsRope *rope, CpsError *err);

/* The rope as a system. Parameters are vx, vy of node 0, 1, ..; laws 0 .. nodes - 1 the friction of
 * the nodes ("node k"), laws nodes .. 2 nodes - 2 the elements ("element k"); the drive has vx, vy
 * of the driven ends, first end first.
 */
CPS_API CpsStatus cps_rope_system(const CpsRope *rope, CpsSystem **out, CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
