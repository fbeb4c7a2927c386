/* SPDX-License-Identifier: BSD-3-Clause */
/* A rope on a table as a driven system (see planar.h). V are the nodes' velocities. The law of a
 * node is -V_k in N(F_k) for a disc of radius resistance x half the length of the neighbouring
 * elements. The law of an element is -U_i in N(F_i): for the line of all F_i, which means U_i = 0;
 * or, where the rope may become slack, for the half-line F_i <= 0, which means U_i <= 0, F_i U_i =
 * 0, that is tension only where an element keeps its length. */
#include "capstan/planar.h"

#include <math.h>
#include <stdio.h>

#include "base/status.h"

enum { ROPE_COOKIE = 0x40be1a5e };

CpsRope cps_rope_default(void) { return (CpsRope){.cookie = ROPE_COOKIE}; }

CpsStatus cps_rope_check(const CpsRope *rope, CpsError *err) {
    if (rope && rope->cookie != ROPE_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the rope was not made by cps_rope_default()");
    if (!rope || !rope->node) return cpsi_fail(err, CPS_ERR_ARGUMENT, "rope or its nodes are NULL");
    if (rope->node_count < 2)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "found %d nodes, expected at least 2",
                         rope->node_count);
    if (rope->node_count > CPS_ROPE_MAX_NODES)
        return cpsi_fail(err, CPS_ERR_LIMIT, "found %d nodes, at most %d", rope->node_count,
                         CPS_ROPE_MAX_NODES);
    if (!(rope->resistance >= 0) || !isfinite(rope->resistance))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "found resistance %g N/m, expected at least 0",
                         rope->resistance);
    for (int i = 0; i + 1 < rope->node_count; i++) {
        const double *x = rope->node + 2 * (size_t)i, length = hypot(x[2] - x[0], x[3] - x[1]);
        if (!(length > 0) || !isfinite(length))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "nodes %d and %d are %g m apart, expected a finite length above 0", i,
                             i + 1, length);
        if (!isfinite(rope->resistance * length))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%g N/m on the %g m between nodes %d and %d are no finite force",
                             rope->resistance, length, i, i + 1);
    }
    return CPS_OK;
}

static double element_length(const CpsRope *rope, int i) {
    const double *x = rope->node + 2 * (size_t)i;
    return hypot(x[2] - x[0], x[3] - x[1]);
}

/* nodes of equal friction share one law, and therefore its conic form */
static CpsStatus add_nodes(CpsSystem *system, const CpsRope *rope, CpsError *err) {
    CpsLaw *law = NULL;
    double last = -1;
    char name[32];
    CpsStatus status = CPS_OK;
    for (int i = 0; i < rope->node_count && status == CPS_OK; i++) {
        const double before = i > 0 ? element_length(rope, i - 1) : 0;
        const double after = i + 1 < rope->node_count ? element_length(rope, i) : 0;
        const double radius = 0.5 * rope->resistance * (before + after);
        const CpsEntry map[] = {{0, 2 * i, 1}, {1, 2 * i + 1, 1}};
        /* lengths that differ only by rounding are equal */
        if (!(fabs(radius - last) <= 1e-14 * last)) {
            cps_law_release(law);
            law = NULL;
            status = cps_law_coulomb(1, radius, &law, err);
            last = radius;
        }
        snprintf(name, sizeof name, "node %d", i);
        if (status == CPS_OK) status = cps_system_add_friction(system, name, law, 2, map, err);
    }
    cps_law_release(law);
    return status;
}

static CpsStatus add_elements(CpsSystem *system, const CpsRope *rope, CpsError *err) {
    CpsSet *pull = NULL;
    CpsLaw *law = NULL;
    char name[32];
    CpsStatus status = cps_set_interval(-INFINITY, rope->slack ? 0 : INFINITY, &pull, err);
    if (status == CPS_OK) status = cps_law_friction(pull, &law, err);
    for (int i = 0; i + 1 < rope->node_count && status == CPS_OK; i++) {
        const double *x = rope->node + 2 * (size_t)i, length = element_length(rope, i);
        const double tx = (x[2] - x[0]) / length, ty = (x[3] - x[1]) / length;
        const CpsEntry map[] = {{0, 2 * i, -tx},
                                {0, 2 * i + 1, -ty},
                                {0, 2 * i + 2, tx},
                                {0, 2 * i + 3, ty}};
        snprintf(name, sizeof name, "element %d", i);
        status = cps_system_add_friction(system, name, law, 4, map, err);
    }
    cps_law_release(law);
    cps_set_release(pull);
    return status;
}

static CpsStatus set_drive(CpsSystem *system, const CpsRope *rope, CpsError *err) {
    CpsEntry map[4];
    int rows = 0;
    for (int end = 0; end < 2; end++)
        if (rope->driven[end])
            for (int k = 0; k < 2; k++, rows++)
                map[rows] = (CpsEntry){rows, (end ? 2 * (rope->node_count - 1) : 0) + k, 1};
    return rows ? cps_system_set_drive(system, rows, rows, map, err) : CPS_OK;
}

CpsStatus cps_rope_system(const CpsRope *rope, CpsSystem **out, CpsError *err) {
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL");
    *out = NULL;
    CpsSystem *system = NULL;
    CpsStatus status = cps_rope_check(rope, err);
    if (status == CPS_OK) status = cps_system_create(2 * rope->node_count, &system, err);
    if (status == CPS_OK) status = add_nodes(system, rope, err);
    if (status == CPS_OK) status = add_elements(system, rope, err);
    if (status == CPS_OK) status = set_drive(system, rope, err);
    if (status == CPS_OK)
        *out = system;
    else
        cps_system_destroy(system);
    return status;
}
