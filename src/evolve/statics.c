/* SPDX-License-Identifier: BSD-3-Clause */
/* The start by statics (statics.h): the first equilibrium of a line, without friction.
 *
 * The line starts straight, with its nodes moved out of the obstacles that they are in. From there
 * rounds, or overdamped motion, may lead to where it is caught: between an obstacle and the bed
 * below it, or on a side of an obstacle round which it is too short. Then it is raised and let down
 * again. A line that is raised between held ends is longer than its natural length; therefore it is
 * soft at first, and becomes stiffer each time it has come to rest. While it is soft it can stretch
 * over an obstacle. */
#include "evolve/statics.h"

#include <math.h>

#include "evolve/relaxation.h"

/* A soft line that hangs stretches at its upper end by this share; it comes to rest STAGES times,
 * each time STIFFER times as stiff, and then with its own stiffness. */
static const double SOFT = 0.125, STIFFER = 8;
enum { STAGES = 4 };
/* [-] Heights to which the line is raised, per length, one after the other. */
static const double HEIGHT[] = {0.25, 0.0625};
/* A node that is raised into an obstacle is pushed out of it, and of the one that it then is in, so
 * many times at most. */
enum { PUSHES = 30 };

/* [m] Length of line from node j to the nearest held end. */
static double from_held(const CpsiLine *line, int j) {
    const double a = line->end[CPS_END_A].kind == CPS_END_KIND_HELD ? line->arc_length[j]
                                                                    : INFINITY,
                 b = line->end[CPS_END_B].kind == CPS_END_KIND_HELD
                         ? line->length - line->arc_length[j]
                         : INFINITY;
    return fmin(a, b);
}

/* x moved out of the obstacles that it is in. */
static Vec3 pushed_out(const CpsiLine *line, Vec3 x) {
    for (int k = 0; k < PUSHES; k++) {
        double gap;
        const int on = cpsi_line_nearest(line, x, &gap);
        if (!(gap < 0)) break;
        x = vec3_axpy(-gap, cpsi_obstacle_normal(&line->obstacle[on], x), x);
    }
    return x;
}

/* Raise the line by a height, near held ends by no more than the length of line from there, and
 * move it out of the obstacles. */
static void raise(CpsiLine *line, Vec3 up, double height) {
    for (int j = 0; j < line->n; j++) {
        const double rise = fmin(height, from_held(line, j));
        const Vec3 x = vec3_at(line->position, j);
        if (rise > 0) vec3_store(&line->position[3 * j], pushed_out(line, vec3_axpy(rise, up, x)));
    }
}

/* Move the line to rest with a given compliance. The choice among tensions, which an inextensible
 * line has (`forces`), is left out while it is elastic, where they are unique. */
static void relax(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                  double compliance, int *iterations) {
    const double own = line->compliance;
    struct CpsiForceSet *forces = line->forces;
    CpsiRelaxation done;
    line->compliance = compliance;
    if (compliance > 0) line->forces = NULL;
    (void)cpsi_line_relax(line, program, options, line->end, false, &done);
    line->compliance = own;
    line->forces = forces;
    *iterations += done.iterations;
}

/* Raise the line and let it down. */
static void let_down(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                     double height, int *iterations) {
    const double weight = vec3_norm(vec3_load(line->weight));
    raise(line, vec3_scale(-1 / weight, vec3_load(line->weight)), height * line->length);
    double soft = SOFT / (weight * line->length);
    for (int k = 0; k < STAGES && soft > line->compliance; k++, soft /= STIFFER)
        relax(line, program, options, soft, iterations);
    relax(line, program, options, line->compliance, iterations);
}

void cpsi_line_place_statically(CpsiLine *line, CpsiChainProgram *program,
                                const CpsiStepOptions *options, CpsiSubsteps *scratch) {
    CpsiRelaxation done;
    cpsi_substeps_save(line, scratch);
    for (int k = 0; k < line->obstacle_count; k++) {
        line->turn[k] = 0;
        line->shift[k] = (CpsiShift){0};
    }
    const bool short_of = cpsi_line_step_falls_short(line, options);
    if (!short_of) cpsi_line_step(line, program, options);
    int iterations = line->report.iteration_count;
    if (line->report.outcome == CPS_OUTCOME_STALLED) {
        cpsi_substeps_restore(line, scratch);
        if (!cpsi_line_relax(line, program, options, line->end, false, &done))
            cpsi_substeps_restore(line, scratch);
        cpsi_line_step(line, program, options);
        iterations += done.iterations + line->report.iteration_count;
    }
    const size_t heights =
        vec3_norm(vec3_load(line->weight)) > 0 ? sizeof HEIGHT / sizeof *HEIGHT : 0;
    for (size_t i = 0; i < heights && line->report.outcome == CPS_OUTCOME_STALLED; i++) {
        cpsi_substeps_restore(line, scratch);
        let_down(line, program, options, HEIGHT[i], &iterations);
        cpsi_line_step(line, program, options);
        iterations += line->report.iteration_count;
    }
    line->report.iteration_count = iterations;
    line->report.substep_count = 1;
    line->report.share = 1;
}
