/* SPDX-License-Identifier: BSD-3-Clause */
/* All resistances G for one W.
 *
 * With q = B*F + load in the span of the rows of [D; C], G_j = <e_j, q>, e_j the least velocity
 * with W_j = 1: an affine image of the set of all F. Where rows of the drive depend on each other
 * or on the constraints, sum of c_i row_i = 0, any multiple of c may be added to G and lambda
 * without any other change. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "drive/motion.h"
#include "drive/null_space.h"
#include "linalg/dense.h"

/* A combination of rows below this share is rounding. */
static const double ROUNDING = 1e-11;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the set of resistances");
}

/* Of the system's rows [D; C]: e_j as rows of `carried` (m, n), and the combinations c of dependent
 * rows, their part for D (count, m). */
static CpsStatus combine_rows(const CpsSystem *system, double *carried, double *dependent,
                              int *count, CpsError *err) {
    const size_t n = (size_t)system->n, m = (size_t)system->drive.rows,
                 rows = m + (size_t)system->constraint.rows;
    double *rhs = malloc((rows + 1) * sizeof *rhs);
    CpsStatus status = rhs ? CPS_OK : out_of_memory(err);
    *count = 0;
    for (size_t j = 0; status == CPS_OK && j < m; j++) {
        int rank;
        double *all = NULL;
        memset(rhs, 0, rows * sizeof *rhs);
        rhs[j] = 1;
        status = cpsi_system_kernel(system, rhs, &rank, &all, err);
        if (status == CPS_OK)
            for (int i = 0; i < rank; i++)
                for (size_t k = 0; k < n; k++)
                    carried[j * n + k] += rhs[i] * all[(size_t)i * n + k];
        *count = status == CPS_OK ? (int)rows - rank : 0;
        for (int i = 0; i < *count; i++)
            dependent[(size_t)i * m + j] = rhs[(size_t)rank + (size_t)i];
        free(all);
    }
    free(rhs);
    return status;
}

/* The set of all G: the image of the set of forces, plus the subspace that dependent rows leave
 * undetermined. */
static CpsStatus compose(const CpsMotion *motion, const CpsSolutionSet *forces, const double *map,
                         int lines, const double *line, CpsSet **out, CpsError *err) {
    const CpsSystem *system = motion->system;
    const size_t m = (size_t)system->drive.rows, c = (size_t)system->components;
    CpsSet *image = NULL, *moved = NULL, *open = NULL;
    double *shift = malloc(m * sizeof *shift);
    CpsStatus status = shift ? CPS_OK : out_of_memory(err);
    /* G of the motion corresponds to its F */
    if (status == CPS_OK)
        for (size_t j = 0; j < m; j++)
            shift[j] = motion->resistance[j] - cpsi_dot((int)c, &map[j * c], motion->law_force);
    if (status == CPS_OK) status = cps_set_image((int)m, map, forces->set, &image, err);
    if (status == CPS_OK) status = cps_set_translate(shift, image, &moved, err);
    if (status == CPS_OK && lines > 0) status = cps_set_subspace((int)m, lines, line, &open, err);
    if (status == CPS_OK && lines > 0)
        status = cps_set_sum(2, (const CpsSet *const[]){moved, open}, out, err);
    else if (status == CPS_OK)
        *out = cps_set_retain(moved);
    cps_set_release(image);
    cps_set_release(moved);
    cps_set_release(open);
    free(shift);
    return status;
}

CpsStatus cps_motion_resistances(const CpsMotion *motion, double tolerance, CpsSolutionSet *all,
                                 double *low, double *high, CpsError *err) {
    if (!motion || !all) return cpsi_fail(err, CPS_ERR_ARGUMENT, "motion or all is NULL");
    *all = (CpsSolutionSet){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
    const CpsSystem *system = motion->system;
    const size_t n = (size_t)system->n, m = (size_t)system->drive.rows,
                 c = (size_t)system->components, rows = m + (size_t)system->constraint.rows;
    if (m == 0 || c == 0) return CPS_OK;
    CpsSolutionSet forces;
    CpsSetFacts facts = {.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
    int lines = 0, kept = 0;
    CpsStatus status = cps_motion_forces(motion, tolerance, &forces, NULL, NULL, err);
    if (status != CPS_OK || forces.outcome != CPS_SET_OUTCOME_ANSWERED) return status;
    double *carried = calloc(m * n + m * c + rows * m + m, sizeof *carried), *map = carried + m * n,
           *line = map + m * c, *direction = line + rows * m;
    if (!carried) status = out_of_memory(err);
    if (status == CPS_OK) status = combine_rows(system, carried, line, &lines, err);
    if (status == CPS_OK)
        for (size_t j = 0; j < m; j++)
            for (size_t i = 0; i < c; i++)
                map[j * c + i] = cpsi_rows_times(&system->map, (int)i, &carried[j * n]);
    if (status == CPS_OK) cpsi_dense_round(m * c, cpsi_norm((int)(m * c), map), map);
    for (int i = 0; i < lines; i++)
        if (cpsi_norm((int)m, &line[(size_t)i * m]) > ROUNDING)
            memmove(&line[(size_t)kept++ * m], &line[(size_t)i * m], m * sizeof *line);
    if (status == CPS_OK) status = compose(motion, &forces, map, kept, line, &all->set, err);
    if (status == CPS_OK)
        status = cps_set_facts(all->set, forces.tolerance, &facts, NULL, NULL, err);
    if (facts.outcome == CPS_SET_OUTCOME_ANSWERED)
        for (size_t j = 0; status == CPS_OK && j < m; j++) {
            CpsSetExtent extent;
            memset(direction, 0, m * sizeof *direction);
            direction[j] = 1;
            status = cps_set_extent(all->set, direction, &extent, err);
            if (low) low[j] = extent.low;
            if (high) high[j] = extent.high;
        }
    all->outcome = facts.outcome;
    all->dimension = facts.dimension;
    all->bounded = facts.bounded;
    all->unique = facts.has_dimension && facts.dimension == 0;
    all->tolerance = forces.tolerance;
    all->moved = forces.moved;
    if (status != CPS_OK) cps_solution_set_clear(all);
    cps_solution_set_clear(&forces);
    free(carried);
    return status;
}
