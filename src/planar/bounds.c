/* SPDX-License-Identifier: BSD-3-Clause */
/* Bounds of the dissipation from cells (cells.c), refined until they are near enough.
 *
 * The gap of a cell of width h is of the order of its load x |w| h^2/rho, rho its distance from the
 * centre of rotation, which is integrable: the total gap decreases as 1/n^2, and two or three
 * rounds find n. */
#include <float.h>
#include <math.h>

#include "base/status.h"
#include "planar/cells.h"

static const double TOLERANCE = 1e-6;

/* Positions, loads and speeds of cells take a dozen operations each, and their sum is compensated.
 * The rounding error is at most this share of the power that the load would have at the speed of
 * the fastest corner. */
static const double ROUNDING = 64 * DBL_EPSILON;

/* sum of strength |v + w x r|; high + low is the sum, compensated (Neumaier) */
typedef struct Sum {
    double velocity[2], w;
    double high, low;
} Sum;

static bool add_cell(void *user, double strength, const double r[2]) {
    Sum *sum = user;
    const double vx = sum->velocity[0] - sum->w * r[1], vy = sum->velocity[1] + sum->w * r[0];
    const double term = strength * sqrt(vx * vx + vy * vy), next = sum->high + term;
    sum->low += (sum->high >= term) ? (sum->high - next) + term : (term - next) + sum->high;
    sum->high = next;
    return true;
}

static double add_cells(const CpsiPatch *patch, CpsPlanarSide side, int n, const double velocity[2],
                        double w) {
    Sum sum = {.velocity = {velocity[0], velocity[1]}, .w = w};
    cpsi_cells(patch, side, n, add_cell, &sum);
    return sum.high + sum.low;
}

/* Lower and upper bound of an area's power, with upper - lower <= tolerance x upper if there are
 * enough cells. */
static bool bound_area(const CpsiPatch *patch, const double velocity[2], double w, double tolerance,
                       CpsPlanarBounds *bounds) {
    /* speeds are scaled to order one, so that no square overflows; corners lie within twice the
     * size */
    const double fastest = hypot(velocity[0], velocity[1]) + 2 * fabs(w) * patch->size;
    if (!(fastest > 0)) return true;
    if (!isfinite(fastest)) {
        bounds->upper = INFINITY;
        return false;
    }
    const double v[2] = {velocity[0] / fastest, velocity[1] / fastest}, turn = w / fastest;
    const int most = cpsi_cell_fineness(patch, CPS_PLANAR_MAX_CELLS);
    for (int n = 8 < most ? 8 : most;;) {
        const double slack = ROUNDING * patch->strength;
        const double lower = fmax(add_cells(patch, CPS_PLANAR_INNER, n, v, turn) - slack, 0);
        const double upper = add_cells(patch, CPS_PLANAR_OUTER, n, v, turn) + slack,
                     gap = upper - lower;
        const bool near = gap <= tolerance * upper;
        if (near || n >= most) {
            bounds->lower += lower * fastest;
            bounds->upper += upper * fastest;
            bounds->cell_count += cpsi_cell_count(patch, n);
            return near;
        }
        const double wanted = n * sqrt(gap / (0.8 * tolerance * upper));
        n = wanted < most ? (int)fmax(wanted, n + 1) : most;
    }
}

CpsStatus cps_planar_bounds(const CpsPlanar *body, const double twist[3], double tolerance,
                            CpsPlanarBounds *bounds, CpsError *err) {
    if (!body || !bounds) return cpsi_fail(err, CPS_ERR_ARGUMENT, "body or bounds is NULL");
    if (!(tolerance >= 0) || !isfinite(tolerance))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the tolerance is %g, expected a number >= 0",
                         tolerance);
    CpsStatus status = cpsi_law_check_vector("twist", 3, twist, err);
    CpsPlanarBounds found = {.outcome = CPS_SET_OUTCOME_ANSWERED};
    for (int k = 0; k < body->count && status == CPS_OK; k++) {
        const CpsiPatch *patch = &body->patch[k];
        double velocity[2];
        cpsi_patch_velocity(patch, twist, velocity);
        if (cpsi_patch_is_area(patch)) {
            if (!bound_area(patch, velocity, twist[2], tolerance > 0 ? tolerance : TOLERANCE,
                            &found))
                found.outcome = CPS_SET_OUTCOME_INACCURATE;
            continue;
        }
        CpsiPatchDissipation part;
        status = cpsi_patch_dissipation_rate(patch, velocity, twist[2], &part, err);
        if (status != CPS_OK) break;
        if (part.outcome != CPS_SET_OUTCOME_ANSWERED) found.outcome = part.outcome;
        const double slack = part.gap + ROUNDING * part.power;
        found.lower += fmax(part.power - slack, 0);
        found.upper += part.power + slack;
        found.cell_count++;
    }
    if (status == CPS_OK) *bounds = found;
    return status;
}
