/* SPDX-License-Identifier: BSD-3-Clause */
/* Minimise <c, x> over a reduced form with the interior-point loop, and check the result. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "conic/dense_program.h"
#include "linalg/dense.h"
#include "set/set.h"

/* A solution is accepted where residuals and gap, relative to data of order one, are below this;
 * the answers promise 1e-9. */
static const double ACCEPT = 1e-9;

/* Promised error of an answer, relative to its value and to the size of the data. */
static const double PROMISE = 1e-8;

/* A cost below this share of its possible size is rounding. */
static const double NOISE = 1e-12;

/* All arrays of a solution, in one block. */
typedef struct Layout {
    CpsiConicProgram *program;
    double *cost, *x;
} Layout;

static void layout_program(CpsiArena *arena, Layout *layout, const CpsiConicForm *form) {
    const int unknowns = form->unknowns > 0 ? form->unknowns : 1;
    layout->program =
        cpsi_conic_layout(arena, unknowns, form->rows, form->cones, form->largest_cone);
    CPSI_PLACE(arena, layout->cost, unknowns);
    CPSI_PLACE(arena, layout->x, form->n);
}

void cpsi_solution_free(CpsiSolution *solution) {
    free(solution->block);
    *solution = (CpsiSolution){.outcome = CPS_SET_OUTCOME_INACCURATE};
}

/* Returns whether <c, x> decreases along a line of the set; ray is then that direction. */
static bool along_lines(const CpsiConicForm *form, const double *c, double size, double *ray) {
    double most = 1e-10 * size;
    bool found = false;
    for (int l = 0; l < form->lines; l++) {
        const double *q = &form->q[(size_t)l * (size_t)form->n], slope = cpsi_dot(form->n, c, q);
        if (fabs(slope) <= most) continue;
        most = fabs(slope);
        found = true;
        for (int i = 0; i < form->n; i++) ray[i] = slope > 0 ? -q[i] : q[i];
    }
    return found;
}

/* x = origin + P v, or the ray P v. */
static void place(const CpsiConicForm *form, const double *v, bool ray, double *x) {
    for (int i = 0; i < form->n; i++)
        x[i] = (ray ? 0 : form->origin[i]) +
               cpsi_dot(form->unknowns, &form->p[(size_t)i * (size_t)form->unknowns], v);
}

/* Whether the set is empty; a ray has no meaning where it is. */
static bool is_empty(const CpsiConicForm *form, const Layout *layout) {
    memset(layout->cost, 0, (size_t)form->unknowns * sizeof *layout->cost);
    return form->unknowns > 0 && form->rows > 0 &&
           cpsi_conic_solve(layout->program, ACCEPT).outcome == CPSI_CONIC_INFEASIBLE;
}

static void run(const CpsiConicForm *form, const double *c, const Layout *layout,
                CpsiSolution *solution) {
    const int n = form->n, u = form->unknowns;
    for (int j = 0; j < u; j++) {
        double sum = 0;
        for (int i = 0; i < n; i++) sum += c[i] * form->p[(size_t)i * (size_t)u + (size_t)j];
        layout->cost[j] = sum;
    }
    const double size = cpsi_norm(u, layout->cost), floor = NOISE * form->size * cpsi_norm(n, c);
    solution->scale = size > floor ? size : 1;
    for (int j = 0; j < u; j++) layout->cost[j] = size > floor ? layout->cost[j] / size : 0;

    const CpsiConicResult result = cpsi_conic_solve(layout->program, ACCEPT);
    static const CpsSetOutcome OUTCOME[] = {CPS_SET_OUTCOME_ANSWERED, CPS_SET_OUTCOME_EMPTY,
                                            CPS_SET_OUTCOME_UNBOUNDED, CPS_SET_OUTCOME_INACCURATE};
    solution->outcome = OUTCOME[result.outcome];
    solution->v = result.x;
    solution->s = result.s;
    solution->z = result.z;
    place(form, solution->v, result.outcome == CPSI_CONIC_UNBOUNDED, solution->x);
    solution->value = cpsi_dot(n, c, solution->x);
    /* error from the complementarity and the residuals */
    const double far = 1 + cpsi_norm(u, solution->v) + cpsi_norm(form->rows, solution->z);
    solution->gap = solution->scale * (result.gap + result.residual * far);
    const double least = form->size + cpsi_norm(n, solution->x);
    if (!(solution->gap <= PROMISE * (fabs(solution->value) + cpsi_norm(n, c) * least)) &&
        result.outcome == CPSI_CONIC_SOLVED)
        solution->outcome = CPS_SET_OUTCOME_INACCURATE;
}

CpsStatus cpsi_conic_form_minimise(const CpsiConicForm *form, const double *c,
                                   CpsiSolution *solution, CpsError *err) {
    CpsiArena arena = {0};
    Layout layout;
    layout_program(&arena, &layout, form);
    if (!cpsi_arena_allocate(&arena))
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory to solve on a set");
    *solution =
        (CpsiSolution){.outcome = CPS_SET_OUTCOME_ANSWERED, .scale = 1, .block = arena.block};
    layout_program(&arena, &layout, form);
    layout.program->data =
        (CpsiConicData){.dim = form->dim, .a = form->a, .b = form->b, .c = layout.cost};
    solution->x = layout.x;
    solution->v = layout.cost;
    if (form->empty)
        solution->outcome = CPS_SET_OUTCOME_EMPTY;
    else if (form->rows > 0 && form->unknowns > 0)
        run(form, c, &layout, solution);
    else {
        memcpy(solution->x, form->origin, (size_t)form->n * sizeof *solution->x);
        solution->value = cpsi_dot(form->n, c, solution->x);
    }
    if (solution->outcome == CPS_SET_OUTCOME_ANSWERED &&
        along_lines(form, c, cpsi_norm(form->n, c), solution->x)) {
        solution->outcome = CPS_SET_OUTCOME_UNBOUNDED;
        solution->value = -INFINITY;
    }
    if (solution->outcome == CPS_SET_OUTCOME_UNBOUNDED && is_empty(form, &layout))
        solution->outcome = CPS_SET_OUTCOME_EMPTY;
    return CPS_OK;
}
