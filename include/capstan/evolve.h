/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/evolve.h: carry a scene through its history, one certified load step at a time.
 *
 *   CpsEvolution *evolution;
 *   cps_evolution_create(&scene, &evolution, &err);
 *   while (cps_evolution_remaining_count(evolution) > 0) {
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

#include "capstan/scene.h"
#include "capstan/step.h"
#include "capstan/stiffness.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CpsEvolution CpsEvolution;

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

/* Number of load steps in all (a start computed by statics is the first; with the moves and breaks
 * taken), and of those still to do: of the history, and a break that is due (failure.h). 0 remain
 * after an infeasible or unbounded step: nothing can follow it. */
CPS_API int cps_evolution_step_count(const CpsEvolution *evolution);
CPS_API int cps_evolution_remaining_count(const CpsEvolution *evolution);

/* Take the next load step. The outcome is in the report; the status is CPS_OK even when it is not
 * solved. After an infeasible or unbounded step the lines stay where they were. Returns
 * CPS_ERR_ARGUMENT when no step remains, and where a free end that the next stage grabs would go
 * through an obstacle on its straight path from where it is: nothing has changed then.
 * CPS_ERR_INTERRUPTED: see below. */
CPS_API CpsStatus cps_evolution_step(CpsEvolution *evolution, CpsError *err);

/* Let a step be interrupted while it is under way: it asks `asked` in each of its iterations, and
 * once that is true it is given up. cps_evolution_step then returns CPS_ERR_INTERRUPTED and the
 * evolution is as it was before the step. What is not interrupted has the same bits as without.
 * `asked` calls nothing of this evolution; with several threads (scene.h, thread_count) each of
 * them calls it, also at the same time. NULL: no more. */
CPS_API CpsStatus cps_evolution_interrupt(CpsEvolution *evolution, bool (*asked)(void *user),
                                          void *user, CpsError *err);

/* ---- extremes over a history ---- */

/* The least and the greatest value of a quantity over the steps that were added, and the first step
 * that has each, as it was named by the caller. Without a step all are 0. */
typedef struct CpsExtreme {
    bool has_values;
    double least, greatest;
    int least_step, greatest_step;
} CpsExtreme;

/* What a designer reads of one line, in the units of the reports. Of zeros: no step was added. */
typedef struct CpsExtremes {
    CpsExtreme tension[2], uplift[2], angle[2], suspended[2]; /* of ends A and B */
    CpsExtreme touchdown[2][3]; /* x, y and z of the steps in which the line touches */
    CpsExtreme grounded, slipping, slack, sweep;
    CpsExtreme utilisation; /* of the steps in which the line has one */
} CpsExtremes;

/* Add a step of the caller's number, if it is certified. Does nothing where an argument is NULL. */
CPS_API void cps_extremes_add(CpsExtremes *extremes, const CpsLineReport *report, int step);

/* ---- moves that are decided as one goes ----
 *
 * A program that is coupled to another one, a robot or a planner knows its next target only when it
 * gets there. A move is a load step that the history of the scene does not hold: it changes ends,
 * obstacles and gravity as a stage of one step does, and it is certified alike. Moves may follow
 * each other, and stages of the history; a scene needs no history.
 *
 *     CpsChange change = {.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {x, y, z}}};
 *     CpsStage move = cps_stage_default();
 *     move.change_count = 1;
 *     move.change = &change;
 *     cps_evolution_move(evolution, &move, &err);
 *     CpsLineReport report = cps_evolution_line_report(evolution, 0);
 *     if (report.end[CPS_END_B].tension > limit) cps_evolution_take_back(evolution, &err); */

/* Take a load step to the targets of `move`, which is checked as a stage is and may lack a name;
 * its step_count is 1. The outcome is in the report. After an infeasible or unbounded move the
 * report and the views show it, and whatever comes next begins where the lines were before it.
 *
 * Returns CPS_ERR_ARGUMENT or CPS_ERR_LIMIT for a move that the check refuses, where a held end
 * would go through an obstacle on its straight path, before a static start has been taken, within
 * a stage of several steps, and after a history that ended early; CPS_ERR_MEMORY when there is no
 * memory for the state before the first move; later moves allocate nothing. Nothing has changed
 * then, but that an infeasible or unbounded move is taken back. CPS_ERR_INTERRUPTED: see above. */
CPS_API CpsStatus cps_evolution_move(CpsEvolution *evolution, const CpsStage *move, CpsError *err);

/* Take the last move back: the evolution is, bit for bit, what it was before it. Returns
 * CPS_ERR_ARGUMENT where the last step was no move, or has been taken back. */
CPS_API CpsStatus cps_evolution_take_back(CpsEvolution *evolution, CpsError *err);

/* The state between two steps as bytes, for going on later: the steps that follow a load give the
 * same bits as if they had followed the save. The bytes are the same in every run: no address, no
 * padding, but the time that the last step took.
 *
 *   state  (cps_evolution_state_size) bytes, written; of the same program and the same kind of
 *          machine
 *
 * cps_evolution_load takes a state saved from an evolution of the same scene, or of one that
 * differs only in stages which had not begun; what it says is checked against its ranges, as a
 * scene is. After an infeasible or unbounded move the state before it is saved. Returns CPS_OK,
 * CPS_ERR_MEMORY, or CPS_ERR_ARGUMENT when the state is of another scene, of other settings, not
 * whole or none that steps can leave; the evolution is untouched then. */
CPS_API size_t cps_evolution_state_size(const CpsEvolution *evolution);
CPS_API void cps_evolution_save(const CpsEvolution *evolution, void *state);
CPS_API CpsStatus cps_evolution_load(CpsEvolution *evolution, const void *state, size_t size,
                                     CpsError *err);

/* Report on the last step taken; before the first one: step_count is 0, and the views show the
 * start configuration. */
CPS_API CpsStepReport cps_evolution_report(const CpsEvolution *evolution);
CPS_API int cps_evolution_line_count(const CpsEvolution *evolution);
CPS_API CpsLineReport cps_evolution_line_report(const CpsEvolution *evolution, int line);
CPS_API CpsLineView cps_evolution_line_view(const CpsEvolution *evolution, int line);

/* The points (point.h): their number, and the report on one, of what is no point one of zeros. */
CPS_API int cps_evolution_point_count(const CpsEvolution *evolution);
CPS_API CpsPointReport cps_evolution_point_report(const CpsEvolution *evolution, int point);

/* The same of the bodies (body.h), and of the obstacles (shift.h). */
CPS_API int cps_evolution_body_count(const CpsEvolution *evolution);
CPS_API CpsBodyReport cps_evolution_body_report(const CpsEvolution *evolution, int body);
CPS_API int cps_evolution_obstacle_count(const CpsEvolution *evolution);
CPS_API CpsObstacleReport cps_evolution_obstacle_report(const CpsEvolution *evolution, int k);

/* The stiffness of an end of a line after the last step, all else as in that step: the other end
 * stays, or keeps its force, and free points follow (stiffness.h). An end with a given force is
 * taken as held where it is. A step of several substeps (CpsLineReport) is that of its last one.
 * Sliding forces on a sphere are those at the arc slid in the step. Allocates nothing, changes
 * nothing that can be seen. Returns CPS_OK, also where nothing is found, or CPS_ERR_ARGUMENT. */
CPS_API CpsStatus cps_evolution_stiffness(const CpsEvolution *evolution, int line, int end,
                                          CpsStiffnessKind kind, CpsStiffness *out, CpsError *err);
/* The same of a point, of all lines that end there. */
CPS_API CpsStatus cps_evolution_point_stiffness(const CpsEvolution *evolution, int point,
                                                CpsStiffnessKind kind, CpsStiffness *out,
                                                CpsError *err);
/* The same of a body in its pose, of all lines at its points. */
CPS_API CpsStatus cps_evolution_body_stiffness(const CpsEvolution *evolution, int body,
                                               CpsStiffnessKind kind, CpsBodyStiffness *out,
                                               CpsError *err);

/* ---- all solutions of a step (S90 results 4.3, 4.4, theorem 6.3, formula (55)) ----
 *
 * A step's tensions are unique, its configuration only where nothing is slack. From one solution
 * and its forces:
 *   - is a given configuration another solution, and if not, why;
 *   - which slack parts are held in place by friction or contact, and which are free;
 *   - a solution in Kin, with |x'| >= 1 everywhere, by laying the free slack out at its full
 *       length.
 *
 * The step is a view of one line after cps_evolution_step, on plane obstacles with isotropic
 * friction. */

/* ---- is it a solution? ---- */

/* The energy of a configuration above the minimum is the sum of three gaps against the step's own
 * forces, none negative: a configuration in C is a solution of P4.2 exactly where all three vanish,
 * and of P3.1 if it also shortens nothing (result 4.3). What fails first, in this order, is the
 * judgement. */
#define CPS_JUDGEMENT_LIST(X)                                                \
    X(CPS_JUDGEMENT_SOLUTION, 0, "solution",                                 \
      "a solution of P3.1: same tensions, contact and friction, |x'| >= 1")  \
    X(CPS_JUDGEMENT_RELAXED, 1, "relaxed",                                   \
      "a solution of P4.2 but not of P3.1: somewhere |x'| < 1, outside Kin") \
    X(CPS_JUDGEMENT_ENDS, 2, "ends", "no solution: a held end is elsewhere") \
    X(CPS_JUDGEMENT_PENETRATES, 3, "penetrates",                             \
      "no solution: a node is inside the obstacle, outside C")               \
    X(CPS_JUDGEMENT_TENSION, 4, "tension",                                   \
      "no solution: other tensions, or tensions in another direction")       \
    X(CPS_JUDGEMENT_CONTACT, 5, "contact",                                   \
      "no solution: contact is lost where the obstacle pushes, R > 0")       \
    X(CPS_JUDGEMENT_SLIDING, 6, "sliding",                                   \
      "no solution: sliding outside the normal cone of the friction force")

typedef enum CpsJudgement {
#define CPS_JUDGEMENT_ENUM(name, number, key, sentence) name = number,
    CPS_JUDGEMENT_LIST(CPS_JUDGEMENT_ENUM)
#undef CPS_JUDGEMENT_ENUM
} CpsJudgement;

CPS_API const char *cps_judgement_name(CpsJudgement judgement);
CPS_API const char *cps_judgement_text(CpsJudgement judgement);

typedef struct CpsJudgementReport {
    CpsJudgement judgement;
    double scale;   /* [J] S of docs/theory.md (5): a gap up to tolerance times S is none */
    double energy;  /* [J] above the step's minimum: the sum of the next three, and exact up to the
                       step's own gap */
    double tension; /* [J] sum of l (W(x') + W*(p) - p.x') */
    double contact; /* [J] sum of R (n.u + gap) */
    double sliding; /* [J] sum of A |u_T| + F.u_T */
    double penetration; /* [m] deepest node inside what contact allows */
    double end_error;   /* [m] largest distance of a held end from its place */
    double shortening;  /* [-] largest 1 - |x'| */
    double arc_length;  /* [m] where what fails is largest; of a solution 0 */
} CpsJudgementReport;

/* Judge a configuration.
 *
 *   step       a solved step; elastic or inextensible
 *   position   (element_count + 1, 3) [m], finite
 *   tolerance  [-] 0 < tolerance < 1: gaps up to tolerance times the scale S of docs/theory.md,
 *              lengths up to tolerance times the line's length, and strains, which cost their
 *              square, up to sqrt(tolerance) are none
 *
 * Returns CPS_OK or CPS_ERR_ARGUMENT. */
CPS_API CpsStatus cps_solution_judge(const CpsLineView *step, const double *position,
                                     double tolerance, CpsJudgementReport *report, CpsError *err);

/* ---- slack ---- */

/* A stretch of line without tension, all of it loose or all of it not. */
typedef struct CpsSlackPart {
    double from, to; /* [m] natural abscissas */
    bool loose; /* its nodes may move and stay a solution; else friction or an end holds each, or it
                   is straight between two */
    bool has_friction; /* friction acts on one of its nodes at least */
    bool at_bound;     /* friction is at its bound on one of them */
    /* one of those, with what its elements carry along, may slide on against its friction force, or
     * back, and leave a solution; elsewhere friction at its bound holds slack as well, as where a
     * part begins beside one that is taut */
    bool sliding;
    bool grounded; /* the obstacle pushes on one of its nodes at least: contact keeps those down */
} CpsSlackPart;

/* List the slack of a step from end A to end B; returns how many parts there are, of which the
 * first `capacity` are filled. None of a step that is NULL or has no elements, nor into NULL. 0:
 * the configuration is unique (result 4.4 (ii)); with held parts only, none of them sliding, it
 * still is. */
CPS_API int cps_solution_slack(const CpsLineView *step, int capacity, CpsSlackPart *part);

/* How slack is laid out between two nodes that stay. All have |x'| = 1 and keep to the plane. */
#define CPS_COMPLETION_LIST(X)                                                                    \
    X(CPS_COMPLETION_SHORTEST, 0, "shortest", "to and fro along the shortest path")               \
    X(CPS_COMPLETION_STRAIGHT, 1, "straight", "in two straight pieces, or in one to a loose end") \
    X(CPS_COMPLETION_MEANDER, 2, "meander", "in a meander, to one side and the other")

typedef enum CpsCompletion {
#define CPS_COMPLETION_ENUM(name, number, key, sentence) name = number,
    CPS_COMPLETION_LIST(CPS_COMPLETION_ENUM)
#undef CPS_COMPLETION_ENUM
        CPS_COMPLETION_COUNT
} CpsCompletion;

CPS_API const char *cps_completion_name(CpsCompletion completion);
CPS_API const char *cps_completion_text(CpsCompletion completion); /* "laid out ..." */

/* The slack of a step. Lengths are natural lengths of elements without tension. */
typedef struct CpsSlackReport {
    double slack;    /* [m] in all; 0: the configuration is unique (result 4.4 (ii)) */
    double held;     /* [m] of it between nodes both held in place: by friction, or ends */
    double loose;    /* [m] of it with a node that may move and stay a solution */
    double straight; /* [m] of the slack with |x'| >= 1 already, as found */
    double left;     /* [m] with |x'| < 1 also after completion: between two nodes held closer than
                        their length */
    int part_count;  /* pieces of line completed */
} CpsSlackReport;

/* Complete the slack so that |x'| = 1 there: nodes without friction between two that stay are laid
 * out, within the plane they rest on, at the full length of their elements; the first and the last
 * element come down from a node that stays above it. (55) with a tangent of one's own choice. What
 * no directions of the elements close, one of them being longer than all others and the chord,
 * stays as found, or up to a free end goes straight on.
 *
 *   step       a solved step
 *   position   (element_count + 1, 3) [m] out: the step's configuration with the slack laid out
 *   report     may be NULL
 *
 * Returns CPS_OK or CPS_ERR_ARGUMENT. */
CPS_API CpsStatus cps_solution_complete(const CpsLineView *step, CpsCompletion how,
                                        double *position, CpsSlackReport *report, CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
