/* SPDX-License-Identifier: BSD-3-Clause */
/* Sets whose parts have no common interior point: facial reduction (Borwein and Wolkowicz 1981).
 *
 * The form {v : A v + b in K} has an interior where some v has A v + b - t e in K with t > 0, e the
 * middle of the cones. The largest such t, at most 1, is a program with interior points of both the
 * primal and the dual:
 *
 *     max t,   A v + b - t e in K,   t <= 1           dual:  A'z = 0,  z in K,  <z, e> = 1,
 *         min b.z
 *
 * Where it is 0, every v of the form has <z, A v + b> = 0: the form lies in the face of K that z
 * selects, and is written over that face (restrict.c). Each round lowers the dimension, so there
 * are at most as many rounds as unknowns. Programs on the resulting form have multipliers again. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ipm/cones.h"
#include "linalg/dense.h"
#include "set/set.h"

/* Parts touch when they overlap, or are separated, by less than this share of their size, which is
 * the accuracy of the depth. The width of a lens of this thickness is its square root. */
static const double TOUCH = 1e-13;
/* A point this deep inside suffices. */
static const double CLEAR = 1e-6;

/* The program for the depth as a form, over (v, t). */
static CpsiConicForm *depth_form(const CpsiConicForm *form) {
    const size_t u = (size_t)form->unknowns, w = u + 1, m = (size_t)form->rows;
    CpsiConicForm *depth = cpsi_conic_form_new(form->unknowns + 1, form->unknowns + 1, 0,
                                               form->rows + 1, form->cones + 1);
    if (!depth) return NULL;
    for (size_t i = 0; i < w; i++) depth->p[i * w + i] = 1;
    for (size_t i = 0; i < m; i++) memcpy(&depth->a[i * w], &form->a[i * u], u * sizeof *depth->a);
    memcpy(depth->b, form->b, m * sizeof *depth->b);
    CPSI_FOR_CONES(k, i, form->cones, form->dim) {
        depth->a[(size_t)i * w + u] = -1;
        depth->dim[k] = form->dim[k];
    }
    depth->a[m * w + u] = -1;
    depth->b[m] = 1;
    depth->dim[form->cones] = 1;
    depth->rows = form->rows + 1;
    depth->cones = form->cones + 1;
    depth->largest_cone = form->largest_cone;
    return depth;
}

/* Whether s is at least this deep inside every cone. */
static bool all_inside(const CpsiConicForm *form, const double *s) {
    CPSI_FOR_CONES(k, i, form->cones, form->dim)
        if (!(s[i] - cpsi_norm(form->dim[k] - 1, &s[i + 1]) > CLEAR)) return false;
    return true;
}

/* Whether an interior point is found at once: at v = 0, or where the solver ends with a zero
 * objective. */
static CpsStatus is_clear(const CpsiConicForm *form, const double *nothing, bool *clear,
                          CpsError *err) {
    *clear = all_inside(form, form->b);
    if (*clear) return CPS_OK;
    CpsiSolution at = {.outcome = CPS_SET_OUTCOME_INACCURATE};
    const CpsStatus status = cpsi_conic_form_minimise(form, nothing, &at, err);
    *clear = status == CPS_OK && at.outcome == CPS_SET_OUTCOME_ANSWERED && at.s &&
             all_inside(form, at.s);
    cpsi_solution_free(&at);
    return status;
}

/* One round: *reduced, or NULL where the form has an interior, is empty, or its depth is not
 * known. */
static CpsStatus reduce_once(const CpsiConicForm *form, CpsiConicForm **reduced, CpsError *err) {
    const size_t u = (size_t)form->unknowns;
    CpsiSolution at = {.outcome = CPS_SET_OUTCOME_INACCURATE};
    bool clear = false;
    double *cost = calloc(u + 1 + (size_t)form->n, sizeof *cost);
    CpsiConicForm *depth = NULL;
    CpsStatus status = cost ? is_clear(form, cost, &clear, err) : CPS_OK;
    if (!status && !clear) depth = depth_form(form);
    if (!status && !clear && (!depth || !cost))
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a set's conic form");
    if (!status && !clear) {
        cost[u] = -1;
        status = cpsi_conic_form_minimise(depth, cost, &at, err);
    }
    if (!status && at.outcome == CPS_SET_OUTCOME_ANSWERED && fabs(at.value) <= TOUCH) {
        double *x = &cost[u + 1];
        for (int i = 0; i < form->n; i++)
            x[i] = form->origin[i] + cpsi_dot(form->unknowns, &form->p[(size_t)i * u], at.x);
        const CpsiSolution touching = {.s = at.s, .z = at.z, .x = x};
        status = cpsi_conic_form_restrict(form, &touching, CPSI_LEAST_ANGLE, reduced, err);
    }
    cpsi_solution_free(&at);
    cpsi_conic_form_free(depth);
    free(cost);
    return status;
}

CpsStatus cpsi_conic_form_reduce_to_face(CpsiConicForm **form, bool *touching, CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int round = (*form)->unknowns;
         !status && round > 0 && (*form)->unknowns > 0 && (*form)->rows > 0; round--) {
        CpsiConicForm *reduced = NULL;
        if ((*form)->empty) break;
        status = reduce_once(*form, &reduced, err);
        if (status || !reduced) break;
        *touching = true;
        cpsi_conic_form_free(*form);
        *form = reduced;
    }
    return status;
}
