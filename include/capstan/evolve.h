/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/evolve.h: carry a scene through its history, one certified load step at a time.
 *
 *   CpsEvolution *evolution;
 *   cps_evolution_create(&scene, &evolution, &err);
 *   while (cps_evolution_remaining(evolution) > 0) {
 *       cps_evolution_step(evolution, &err);
 *       CpsStepReport report = cps_evolution_report(evolution);
 *       ...
 *   }
 *   cps_evolution_destroy(evolution);
 *
 * Each step solves P4.2 of S90 from the last configuration and certifies it by a duality gap that
 * is a sum of local non-negative terms (docs/theory.md). Stepping allocates nothing. */
#ifndef CAPSTAN_EVOLVE_H
#define CAPSTAN_EVOLVE_H

#include <stdbool.h>
#include <stddef.h>

#include "capstan/report.h"
#include "capstan/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CpsEvolution CpsEvolution;

/* Everything about one line after a step. Views into the evolution; n = elements + 1 nodes. Forces
 * act on the line; arrays (n, 3) are stored node after node. A node touches up to `contacts`
 * obstacles at once, and what belongs to a contact has all nodes' nearest obstacles first: entry j
 * is the first contact of node j, entry n + j its second. */
typedef struct CpsLineView {
    const char *name;
    int elements;
    int contacts;             /* of a node: 2 where the scene has more than one obstacle, else 1 */
    const double *arc_length; /* (n) [m] natural abscissa a of the nodes */
    const double *element_length; /* (elements) [m] */
    double compliance;            /* [1/N] 1/EA, 0: inextensible */
    CpsEnd end[2];                /* what was imposed in this step */
    const double *reference;      /* (n, 3) [m] x_R of this step */
    const double *position;       /* (n, 3) [m] */
    const double *load;           /* (n, 3) [N] weight and free-end forces */
    double weight_before[3]; /* [N/m] per natural length where the step, or its last part, began;
                                another one than now where gravity changes */
    const int *obstacle;  /* (contacts, n) which: the nearest and the next, -1 without; NULL on one
                             plane with isotropic  friction: the first */
    const double *normal; /* (contacts, n, 3) [-] that of the obstacle at the configuration reached;
                             0 0 0 without */
    const double *gap; /* (contacts, n) [m] n.u >= -gap, u from the reference; INFINITY: no contact
                          looked for */
    const double *friction_bound;  /* (contacts, n) [N] w = A h, of the larger coefficient (of a
                                      friction set: its multiple); 0 where friction does not act */
    const double *friction_factor; /* (n) [-] of the friction zones, the mean over the length that a
                                      node stands for; NULL: 1 */
    const double *friction;        /* (contacts, n, 3) [N] F, in the set of forces that w bounds */
    const double *reaction;        /* (contacts, n) [N] R >= 0, along the normal */
    /* (contacts, n, 3) [m] way on the obstacle in this step, tangential, on a curved one along the
     * surface; NULL on one plane with isotropic friction: the part of u in it */
    const double *slide;
    const double *segment_force; /* (elements, 3) [N] p: what the B side does to the A side */
    /* (elements) [N] T >= 0 from the elongation unknown, not from positions */
    const double *tension;
    /* (n, 3) [-] slides: velocities that prove it, the fastest of size 1; else 0 */
    const double *motion;
    const unsigned char *state; /* (contacts, n) CpsNodeState */
    /* [m] what reference, position and the places of held ends are measured from: 0 0 0, but a
     * place near the lines where these lie more than 512 lengths away; same for all lines */
    double origin[3];
    /* Contact of an element with a round obstacle, at the point (1 - beta) x_e + beta x_{e+1} that
     * was nearest to its axis or centre; its forces act on the element's nodes by these shares. As
     * above for that point, whose way is that of the point with this beta since the reference. All
     * NULL where no obstacle is round or contact is strict; obstacle -1 and numbers without meaning
     * where an element has none. */
    const int *element_obstacle;  /* (elements) */
    const double *element_share;  /* (elements) [-] beta */
    const double *element_normal; /* (elements, 3) [-] */
    const double *element_gap; /* (elements) [m] with what an element may lie deep, min(l^2/(4 R),
                                  R/4), added */
    const double *element_friction_bound; /* (elements) [N] */
    const double *element_friction;       /* (elements, 3) [N] */
    const double *element_reaction;       /* (elements) [N] */
    const double *element_slide;          /* (elements, 3) [m] */
    const unsigned char *element_state;   /* (elements) */
} CpsLineView;

/* Prepare a scene.
 *
 *   scene   checked (cps_scene_check) and copied
 *   out     NULL on failure
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_evolution_create(const CpsScene *scene, CpsEvolution **out, CpsError *err);
CPS_API void cps_evolution_destroy(CpsEvolution *evolution);

/* Calls without a status: a NULL evolution has no lines, no steps and a state of no bytes, and
 * saving it, or to NULL, does nothing. Where there is no such line, or no evolution, the outcome of
 * the report is CPS_OUTCOME_STALLED and the view has no elements and no arrays. */

/* Number of load steps in all (a start laid by statics is the first), and still to do.
 * 0 remain after an infeasible or unbounded step: nothing can follow it. */
CPS_API int cps_evolution_step_count(const CpsEvolution *evolution);
CPS_API int cps_evolution_remaining(const CpsEvolution *evolution);

/* Take the next load step. The outcome is in the report; the status is CPS_OK even when it is not
 * solved. After an infeasible or unbounded step the lines stay where they were. Returns
 * CPS_ERR_ARGUMENT when no step remains, and where a free end that the next stage grabs would go
 * through an obstacle on its straight way from where it is: nothing has changed then.
 * CPS_ERR_INTERRUPTED: see below. */
CPS_API CpsStatus cps_evolution_step(CpsEvolution *evolution, CpsError *err);

/* Let a step be interrupted while it is under way: it asks `asked` in each of its iterations, and
 * once that is true it is given up. cps_evolution_step then returns CPS_ERR_INTERRUPTED and the
 * evolution is as it was before the step. What is not interrupted has the same bits as without.
 * `asked` is called from the thread that steps, and calls nothing of this evolution; NULL: no more.
 */
CPS_API CpsStatus cps_evolution_interrupt(CpsEvolution *evolution, bool (*asked)(void *user),
                                          void *user, CpsError *err);

/* The state between two steps as bytes, for going on later: the steps that follow a load give the
 * same bits as if they had followed the save. The bytes are the same in every run: no address, no
 * padding, but the time that the last step took.
 *
 *   state  (cps_evolution_state_size) bytes, written; of the same program and the same kind of
 *          machine
 *
 * cps_evolution_load takes a state saved from an evolution of the same scene; what it says is
 * checked against its ranges, as a scene is. Returns CPS_OK, CPS_ERR_MEMORY, or CPS_ERR_ARGUMENT
 * when the state is of another scene, of other settings, not whole or none that steps can leave;
 * the evolution is untouched then. */
CPS_API size_t cps_evolution_state_size(const CpsEvolution *evolution);
CPS_API void cps_evolution_save(const CpsEvolution *evolution, void *state);
CPS_API CpsStatus cps_evolution_load(CpsEvolution *evolution, const void *state, size_t size,
                                     CpsError *err);

/* Report on the last step taken; before the first one: index -1 and the start configuration in the
 * views. */
CPS_API CpsStepReport cps_evolution_report(const CpsEvolution *evolution);
CPS_API int cps_evolution_line_count(const CpsEvolution *evolution);
CPS_API CpsLineReport cps_evolution_line_report(const CpsEvolution *evolution, int line);
CPS_API CpsLineView cps_evolution_line_view(const CpsEvolution *evolution, int line);

#ifdef __cplusplus
}
#endif
#endif
