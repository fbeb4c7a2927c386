/* SPDX-License-Identifier: BSD-3-Clause */
/* Queries of a friction law or a loaded law: dissipation, forces, velocities, and the residual of a
 * pair in the five forms of M77 sections 3-7. */
#include <stdlib.h>

#include "base/status.h"
#include "law/law.h"

/* A force outside by less than this share of the forces' size is on the boundary: rounding of its
 * components. */
static const double ON_BOUNDARY = 1e-12;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
}

/* -V, after the checks common to all queries about a velocity; the caller frees *opposite */
static CpsStatus turn(const CpsSet *set, const double *velocity, double **opposite, CpsError *err) {
    if (!set) return cpsi_fail(err, CPS_ERR_ARGUMENT, "the law's set is NULL");
    const int n = cps_set_space(set);
    const CpsStatus status = cpsi_law_check_vector("velocity", n, velocity, err);
    if (status != CPS_OK) return status;
    *opposite = malloc((size_t)n * sizeof **opposite);
    if (!*opposite) return out_of_memory(err);
    for (int i = 0; i < n; i++) (*opposite)[i] = velocity[i] == 0 ? 0 : -velocity[i];
    return CPS_OK;
}

CpsStatus cps_set_dissipation(const CpsSet *set, const double *velocity, double *force,
                              CpsSetAnswer *answer, CpsError *err) {
    double *opposite = NULL;
    CpsStatus status = turn(set, velocity, &opposite, err);
    if (status == CPS_OK) status = cps_set_support(set, opposite, force, answer, err);
    free(opposite);
    return status;
}

CpsStatus cps_set_forces(const CpsSet *set, const double *velocity, double tolerance,
                         CpsSet **forces, CpsSetAnswer *answer, CpsError *err) {
    double *opposite = NULL;
    CpsStatus status = turn(set, velocity, &opposite, err);
    if (status == CPS_OK) status = cps_set_face(set, opposite, tolerance, forces, answer, err);
    free(opposite);
    return status;
}

CpsStatus cps_set_velocities(const CpsSet *set, const double *force, double tolerance,
                             CpsSet **velocities, CpsSetAnswer *answer, CpsError *err) {
    if (!set || !velocities)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the law's set or velocities is NULL");
    CpsSet *cone = NULL;
    CpsStatus status = cpsi_law_check_vector("force", cps_set_space(set), force, err);
    if (status == CPS_OK) status = cps_set_normal_cone(set, force, tolerance, &cone, answer, err);
    CpsSet *turned = NULL;
    if (status == CPS_OK && cone) status = cps_set_scale(-1, cone, &turned, err);
    cps_set_release(cone);
    if (status == CPS_OK) *velocities = turned;
    return status;
}

/* ---- the five forms ---- */

/* The normal cone form: |F - P_C(F - step V)|, in work (2n). */
static CpsStatus normal_cone_form(const CpsSet *set, const double *force, const double *velocity,
                                  double *work, CpsSetResidual *r, CpsError *err) {
    const int n = cps_set_space(set);
    double *trial = work, *nearest = work + n;
    CpsSetAnswer answer;
    for (int i = 0; i < n; i++) trial[i] = force[i] - r->step * velocity[i];
    const CpsStatus status = cps_set_project(set, trial, NULL, nearest, &answer, err);
    if (status != CPS_OK) return status;
    if (answer.outcome != CPS_SET_OUTCOME_ANSWERED) {
        r->normal_cone = NAN;
        return CPS_OK;
    }
    for (int i = 0; i < n; i++) nearest[i] = force[i] - nearest[i];
    r->normal_cone = cpsi_norm(n, nearest);
    r->gap = fmax(r->gap, answer.gap);
    return CPS_OK;
}

/* The power forms, from a force P of the law at V. */
static void power_forms(int n, const double *force, const double *velocity, const double *maximal,
                        double phi, CpsSetResidual *r) {
    double difference = 0;
    for (int i = 0; i < n; i++) difference += velocity[i] * (force[i] - maximal[i]);
    const double power = cpsi_dot(n, velocity, force);
    r->power = power == 0 ? 0 : -power;
    r->variational = difference;
    r->maximum_dissipation = power - cpsi_dot(n, velocity, maximal);
    r->dissipation = phi + power;
    const double size = cpsi_norm(n, force) + cpsi_norm(n, maximal);
    r->scale = cpsi_norm(n, velocity) * size;
    r->inverse = isnan(r->outside)                  ? NAN
                 : r->outside <= ON_BOUNDARY * size ? r->dissipation
                                                    : INFINITY;
}

CpsStatus cps_set_residual(const CpsSet *set, const double *force, const double *velocity,
                           double step, CpsSetResidual *residual, CpsError *err) {
    if (!set || !residual)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the law's set or residual is NULL");
    if (!(step >= 0) || !isfinite(step))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the step is %g, expected a finite number of at least 0", step);
    const int n = cps_set_space(set);
    CpsStatus status = cpsi_law_check_vector("force", n, force, err);
    if (status == CPS_OK) status = cpsi_law_check_vector("velocity", n, velocity, err);
    if (status != CPS_OK) return status;
    double *maximal = malloc(3 * (size_t)n * sizeof *maximal);
    if (!maximal) return out_of_memory(err);
    double *work = maximal + n;

    /* distance from C; then phi(V) with a force that attains it */
    CpsSetAnswer nearest, phi;
    CpsSetResidual r = {.step = step};
    status = cps_set_project(set, force, NULL, work, &nearest, err);
    if (status == CPS_OK) status = cps_set_dissipation(set, velocity, maximal, &phi, err);
    if (status == CPS_OK) {
        r.outside = nearest.outcome == CPS_SET_OUTCOME_ANSWERED ? nearest.value : NAN;
        r.outcome = phi.outcome;
        r.gap = fmax(phi.gap, nearest.outcome == CPS_SET_OUTCOME_ANSWERED ? nearest.gap : 0);
        if (phi.outcome == CPS_SET_OUTCOME_ANSWERED ||
            phi.outcome == CPS_SET_OUTCOME_NOT_ATTAINED) {
            power_forms(n, force, velocity, maximal, phi.value, &r);
        } else {
            r.variational = r.maximum_dissipation = r.dissipation = r.inverse = INFINITY;
            r.power = -cpsi_dot(n, velocity, force);
        }

        /* the step for which step V is as large as the forces */
        const double speed = cpsi_norm(n, velocity);
        const double largest =
            fmax(cpsi_norm(n, force), isfinite(phi.value) ? cpsi_norm(n, maximal) : 0);
        if (step == 0) r.step = speed > 0 && largest > 0 ? largest / speed : 1;
        if (!isfinite(r.step)) r.step = 1;
        status = normal_cone_form(set, force, velocity, work, &r, err);
    }
    free(maximal);
    if (status == CPS_OK) *residual = r;
    return status;
}
