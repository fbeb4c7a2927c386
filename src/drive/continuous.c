/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether phi is finite and continuous at a velocity that agrees with W (M77, Proposition 2, second
 * half).
 *
 * phi(V) = sum of phi_k(B_k V) is finite in the interior of its domain and continuous there. With Q
 * the closed cone of all B*R, R_k in the recession cones of the C_k, V is in that interior when <Q,
 * V> > 0 except for 0. So E = V0 + {D V = 0, C V = 0} contains such a V exactly when Q contains no
 * line and, by separation, no element of Q other than 0 is a combination of rows of D and C with
 * <., V0> <= 0. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/larger.h"
#include "base/status.h"
#include "drive/kinematics.h"
#include "drive/motion.h"
#include "set/set.h"

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for Proposition 2");
}

/* The recession cone of one piece, {0} for a viscous term; *bounded is set to false where it is
 * larger. */
static CpsStatus of_piece(const CpsiPiece *piece, CpsSet **out, bool *bounded, CpsError *err) {
    CpsSetFacts facts = {.bounded = true};
    CpsStatus status = piece->set ? cps_set_facts(piece->set, 0, &facts, NULL, NULL, err) : CPS_OK;
    if (status != CPS_OK) return status;
    if (facts.bounded) return cps_set_subspace(piece->space, 0, NULL, out, err);
    *bounded = false;
    return cpsi_set_recession(piece->set, out, err);
}

/* Q, the sum of B_k* R over all pieces. NULL where all sets are bounded. */
static CpsStatus gather(const CpsSystem *system, CpsSet **out, CpsError *err) {
    const size_t n = (size_t)system->n;
    CpsSet **part = calloc((size_t)system->pieces + 1, sizeof *part);
    double *row = malloc(n * sizeof *row), *map = NULL;
    bool bounded = true;
    CpsStatus status = part && row ? CPS_OK : out_of_memory(err);
    for (int k = 0; status == CPS_OK && k < system->pieces; k++) {
        const CpsiPiece *piece = &system->piece[k];
        const size_t m = (size_t)piece->space;
        CpsSet *cone = NULL;
        status = of_piece(piece, &cone, &bounded, err);
        map = calloc(n * m, sizeof *map);
        if (status == CPS_OK && !map) status = out_of_memory(err);
        if (status == CPS_OK)
            for (size_t i = 0; i < m; i++) {
                memset(row, 0, n * sizeof *row);
                cpsi_rows_add(&system->map, system->law[piece->law].first + piece->offset + (int)i,
                              1, row);
                for (size_t j = 0; j < n; j++) map[j * m + i] = row[j];
            }
        if (status == CPS_OK) status = cps_set_image(system->n, map, cone, &part[k], err);
        free(map);
        cps_set_release(cone);
    }
    if (status == CPS_OK && !bounded)
        status = cps_set_sum(system->pieces, (const CpsSet *const *)part, out, err);
    if (part)
        for (int k = 0; k < system->pieces; k++) cps_set_release(part[k]);
    free(part);
    free(row);
    return status;
}

/* Whether 0 is the only common element of two cones. *known is false where there is no answer. */
static CpsStatus only_zero(const CpsSet *one, const CpsSet *other, bool *known, bool *only,
                           CpsError *err) {
    CpsSet *both = NULL;
    CpsSetFacts facts = {.outcome = CPS_SET_OUTCOME_INACCURATE};
    CpsStatus status = cps_set_intersection(2, (const CpsSet *const[]){one, other}, &both, err);
    if (status == CPS_OK) status = cps_set_facts(both, 0, &facts, NULL, NULL, err);
    *known = facts.outcome == CPS_SET_OUTCOME_ANSWERED;
    *only = facts.dimension == 0;
    cps_set_release(both);
    return status;
}

/* {combinations of rows of D and C with <., V0> <= 0} */
static CpsStatus against(const CpsMotion *motion, const double *v0, CpsSet **out, CpsError *err) {
    const CpsSystem *system = motion->system;
    const size_t n = (size_t)system->n;
    int rank = 0;
    double *all = NULL, size = 0;
    CpsSet *span = NULL, *half = NULL;
    CpsStatus status = cpsi_system_kernel(system, NULL, &rank, &all, err);
    if (status == CPS_OK) status = cps_set_subspace(system->n, rank, all, &span, err);
    for (size_t i = 0; i < n; i++) size = cpsi_max_nan(size, fabs(v0[i]));
    if (status == CPS_OK && size > 0) status = cps_set_half_space(system->n, v0, 0, &half, err);
    if (status == CPS_OK && half)
        status = cps_set_intersection(2, (const CpsSet *const[]){span, half}, out, err);
    else if (status == CPS_OK)
        *out = cps_set_retain(span);
    cps_set_release(span);
    cps_set_release(half);
    free(all);
    return status;
}

CpsStatus cps_motion_continuous(const CpsMotion *motion, bool *known, bool *holds, CpsError *err) {
    if (!motion || !known || !holds)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "motion, known or holds is NULL");
    CpsSet *q = NULL, *turned = NULL, *other = NULL;
    CpsiKinematics *kinematics = NULL;
    double *v0 = calloc((size_t)motion->system->n, sizeof *v0);
    *known = *holds = true;
    CpsStatus status = v0 ? gather(motion->system, &q, err) : out_of_memory(err);
    if (status == CPS_OK && q) status = cps_set_scale(-1, q, &turned, err);
    if (status == CPS_OK && q) status = only_zero(q, turned, known, holds, err);
    if (status == CPS_OK && q && *known && *holds) {
        status = cpsi_kinematics_new(motion->system, &kinematics, err);
        if (status == CPS_OK) cpsi_kinematics_project(kinematics, motion->driving, v0);
        if (status == CPS_OK) status = against(motion, v0, &other, err);
        if (status == CPS_OK) status = only_zero(q, other, known, holds, err);
    }
    cpsi_kinematics_free(kinematics);
    cps_set_release(q);
    cps_set_release(turned);
    cps_set_release(other);
    free(v0);
    return status;
}
