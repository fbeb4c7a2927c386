/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/stiffness.h: how the force at an end of a line changes with the place of that end, after
 * a load step (theory 6c); cps_evolution_stiffness of evolve.h finds it, and of a point where lines
 * meet cps_evolution_point_stiffness. Summed over the lines of a mooring it is the stiffness that
 * holds what they are tied to.
 *
 *     CpsStiffness found;
 *     cps_evolution_stiffness(evolution, 0, CPS_END_B, CPS_STIFFNESS_STEP, &found, &err);
 *     if (found.outcome == CPS_STIFFNESS_OUTCOME_FOUND) surge = found.matrix[0];
 *
 * With dry friction a force has no one derivative: a node that slides goes on or sticks, depending
 * on where the end moves. Two stiffnesses are defined. Both are exact derivatives of the discrete
 * line; where the line lifts off the ground node by node they change by jumps with the mesh, and
 * `smooth` is what they are to the line itself.
 *
 * Where lines lead to free points these follow to where all balances, and what is tied to them by
 * further lines as well; so do anchors that drag, in a step. Held points stay, and so do bodies
 * other than the one that is asked for. An end at a point moves with it, and with the other lines
 * there. */
#ifndef CAPSTAN_STIFFNESS_H
#define CAPSTAN_STIFFNESS_H

#include "capstan/step.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Of the step: the derivative of the force that the step finds by the place to which it moves the
 * end, from the same reference (of a step in several substeps: by the last one). Sliding nodes go
 * on, and those at rest stay. Of a small cycle: every node that friction can hold stays where it
 * is, as when the load turns round; one that touches without friction slides in both. */
#define CPS_STIFFNESS_LIST(X)                                                     \
    X(CPS_STIFFNESS_STEP, 0, "step", "of the step: what slides goes on to slide") \
    X(CPS_STIFFNESS_STICK, 1, "stick", "of a small cycle: what friction can hold stays put")

typedef enum CpsStiffnessKind {
#define CPS_STIFFNESS_ENUM(name, number, key, sentence) name = number,
    CPS_STIFFNESS_LIST(CPS_STIFFNESS_ENUM)
#undef CPS_STIFFNESS_ENUM
} CpsStiffnessKind;

CPS_API const char *cps_stiffness_name(CpsStiffnessKind kind); /* "step"; never NULL */
CPS_API const char *cps_stiffness_text(CpsStiffnessKind kind); /* its sentence; never NULL */

/* Whether there is such a matrix. There is none either where a node rests by a set of friction
 * forces that has 0 on its boundary, or a boundary not made of edges, corners and arcs. */
#define CPS_STIFFNESS_OUTCOME_LIST(X)                                                      \
    X(CPS_STIFFNESS_OUTCOME_FOUND, 0, "found", "found")                                    \
    X(CPS_STIFFNESS_OUTCOME_NO_STEP, 1, "no_step",                                         \
      "no certified load step, or a taut line that cannot stretch")                        \
    X(CPS_STIFFNESS_OUTCOME_TOUCHES, 2, "touches",                                         \
      "the end touches an obstacle, whose force on it may be any within a bound")          \
    X(CPS_STIFFNESS_OUTCOME_LOOSE, 3, "loose",                                             \
      "a loose part of a line, or a free point, has no one place, and no stiffness")       \
    X(CPS_STIFFNESS_OUTCOME_NOT_GIVEN, 4, "not_given",                                     \
      "an obstacle gives, an element touches, a node slides in a corner, with a box or a " \
      "set of friction forces, or by axes that change, or states are not resolved: not "   \
      "looked into")

typedef enum CpsStiffnessOutcome {
#define CPS_STIFFNESS_OUTCOME_ENUM(name, number, key, sentence) name = number,
    CPS_STIFFNESS_OUTCOME_LIST(CPS_STIFFNESS_OUTCOME_ENUM)
#undef CPS_STIFFNESS_OUTCOME_ENUM
} CpsStiffnessOutcome;

CPS_API const char *cps_stiffness_outcome_name(CpsStiffnessOutcome outcome);
CPS_API const char *cps_stiffness_outcome_text(CpsStiffnessOutcome outcome);

typedef struct CpsStiffness {
    CpsStiffnessOutcome outcome;
    /* [N/m] d(force[i])/d(position[j]) at 3 i + j, force and position as in CpsEndReport: what it
     * takes to move the end, positive where the line pulls it back; of a point against all its
     * lines; all 0 unless found */
    double matrix[9];
    /* the same with touchdown points on planes that move along the elements (theory 6c): of second
     * order in the mesh, where `matrix` changes by jumps. Not given where the line turns up from
     * the ground within an element, with frozen friction that acts off the ground, or where
     * friction has a box, a set or turning directions at the next node; then 0 */
    bool has_smooth;
    double smooth[9];
} CpsStiffness;

/* The stiffness of a body (body.h) in its pose: of all lines at its points, of its weight and
 * buoyancy and of its hydrostatics. */
typedef struct CpsBodyStiffness {
    CpsStiffnessOutcome outcome; /* found where it is of all these lines */
    /* [N/m, N, N m] d(force, moment about the reference point)/d(position, rotation vector) at 6 i
     * + j, with the sign of a stiffness; all 0 unless found */
    double matrix[36];
    bool has_smooth; /* of all these lines */
    double smooth[36];
} CpsBodyStiffness;

#ifdef __cplusplus
}
#endif
#endif
