/* SPDX-License-Identifier: BSD-3-Clause */
/* A body as a law of wrenches and as a system: its contacts with their maps from the twist.
 *
 * The velocity at a contact at r with axes u, v has the components (u, r x u) . twist and (v, r x
 * v) . twist. Areas give the contacts of their cells (cells.c). A wheel is M77 section 9: W = V -
 * omega a j, the contact's law on V and the brake's on omega. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/status.h"
#include "planar/cells.h"

/* Row of the map for the component along u of the velocity at r. */
static void velocity_row(const double u[2], const double r[2], double row[3]) {
    row[0] = u[0];
    row[1] = u[1];
    row[2] = r[0] * u[1] - r[1] * u[0];
}

static void point_map(const double r[2], const double axis[2], double map[6]) {
    velocity_row(axis, r, map);
    velocity_row((double[2]){-axis[1], axis[0]}, r, map + 3);
}

/* rows along i (right of the rolling direction) and j (the rolling direction), M77 section 9: j =
 * up x i */
static void wheel_map(const CpsiPatch *patch, double map[6]) {
    velocity_row((double[2]){patch->axis[1], -patch->axis[0]}, patch->position, map);
    velocity_row(patch->axis, patch->position, map + 3);
}

static bool has_brake(const CpsiPatch *patch) {
    return patch->kind == CPS_PATCH_WHEEL && isfinite(patch->strip);
}

static CpsStatus brake_law(const CpsiPatch *patch, CpsLaw **out, CpsError *err) {
    CpsSet *interval = NULL;
    const double most = patch->strip * patch->size;
    CpsStatus status = cps_set_interval(-most, most, &interval, err);
    if (status == CPS_OK) status = cps_law_friction(interval, out, err);
    cps_set_release(interval);
    return status;
}

static CpsStatus ground_law(const CpsiPatch *patch, CpsLaw **out, CpsError *err) {
    return patch->set ? cps_law_friction(patch->set, out, err)
                      : cps_law_coulomb(1, patch->strength, out, err);
}

/* M77 (26): (h, F) = (-a j.G, G) */
static CpsStatus wheel_law(const CpsiPatch *patch, CpsLaw **out, CpsError *err) {
    const double eliminate[6] = {0, -patch->size, 1, 0, 0, 1};
    CpsLaw *part[2] = {NULL, NULL}, *both = NULL;
    CpsStatus status = brake_law(patch, &part[0], err);
    if (status == CPS_OK) status = ground_law(patch, &part[1], err);
    if (status == CPS_OK) status = cps_law_product(2, (const CpsLaw *const *)part, &both, err);
    if (status == CPS_OK) status = cps_law_preimage(2, eliminate, both, NULL, out, err);
    for (int i = 0; i < 2; i++) cps_law_release(part[i]);
    cps_law_release(both);
    return status;
}

/* What is done with each contact; the function takes ownership of the law. */
typedef struct Contacts Contacts;
typedef CpsStatus Take(Contacts *self, int patch, CpsLaw *law, const double map[6]);

struct Contacts {
    const CpsPlanar *body;
    Take *take;
    CpsError *err;
    CpsStatus status;
    int patch; /* patch of the cells being visited */
    /* for a law */
    int count;
    CpsLaw **law;
    double *map;
    /* for a system */
    CpsSystem *system;
    int spins;
};

static bool take_cell(void *user, double strength, const double r[2]) {
    Contacts *self = user;
    const CpsiPatch *patch = &self->body->patch[self->patch];
    const double at[2] = {patch->position[0] + r[0], patch->position[1] + r[1]};
    double map[6];
    CpsLaw *law = NULL;
    point_map(at, (double[2]){1, 0}, map);
    self->status = cps_law_coulomb(1, strength, &law, self->err);
    if (self->status == CPS_OK) self->status = self->take(self, self->patch, law, map);
    return self->status == CPS_OK;
}

/* All contacts in the order of the patches. */
static CpsStatus visit_contacts(Contacts *self, CpsPlanarSide side, int cells) {
    for (int k = 0; k < self->body->count && self->status == CPS_OK; k++) {
        const CpsiPatch *patch = &self->body->patch[k];
        self->patch = k;
        if (cpsi_patch_is_area(patch)) {
            cpsi_cells(patch, side, cpsi_cell_fineness(patch, cells), take_cell, self);
            continue;
        }
        double map[6];
        CpsLaw *law = NULL;
        if (has_brake(patch))
            wheel_map(patch, map);
        else
            point_map(patch->position, patch->axis, map);
        self->status = has_brake(patch) && !self->system ? wheel_law(patch, &law, self->err)
                                                         : ground_law(patch, &law, self->err);
        if (self->status == CPS_OK) self->status = self->take(self, k, law, map);
    }
    return self->status;
}

/* Number of contacts; each area needs at least one cell. */
static CpsStatus count_contacts(const CpsPlanar *body, CpsPlanarSide side, int cells, int *count,
                                CpsError *err) {
    if (side != CPS_PLANAR_INNER && side != CPS_PLANAR_OUTER)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "side is %d, expected CPS_PLANAR_INNER or CPS_PLANAR_OUTER", (int)side);
    if (cells > CPS_PLANAR_MAX_CELLS)
        return cpsi_fail(err, CPS_ERR_LIMIT, "%d cells are given for each patch, at most %d", cells,
                         CPS_PLANAR_MAX_CELLS);
    double total = 0;
    for (int k = 0; k < body->count; k++) {
        const CpsiPatch *patch = &body->patch[k];
        const int n = cpsi_cell_fineness(patch, cells);
        if (cpsi_patch_is_area(patch) && n < 1)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%d cells are given for patch %d, which needs %g at least", cells, k,
                             cpsi_cell_count(patch, 1));
        total += cpsi_patch_is_area(patch) ? cpsi_cell_contacts(patch, side, n) : 1;
    }
    if (!(total <= CPS_SET_MAX_ITEMS))
        return cpsi_fail(err, CPS_ERR_LIMIT,
                         "%.0f contacts in all, at most %d: ask for fewer cells", total,
                         CPS_SET_MAX_ITEMS);
    *count = (int)total;
    return CPS_OK;
}

/* ---- as a law ---- */

static CpsStatus keep_contact(Contacts *self, int patch, CpsLaw *law, const double map[6]) {
    (void)patch;
    for (int i = 0; i < 6; i++) self->map[6 * self->count + i] = map[i];
    self->law[self->count++] = law;
    return CPS_OK;
}

CpsStatus cps_planar_law(const CpsPlanar *body, CpsPlanarSide side, int cells, CpsLaw **out,
                         CpsError *err) {
    if (!body || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "body or out is NULL");
    int capacity = 0;
    CpsStatus status = count_contacts(body, side, cells, &capacity, err);
    if (status != CPS_OK) return status;
    Contacts self = {.body = body, .take = keep_contact, .err = err};
    self.law = calloc((size_t)capacity, sizeof *self.law);
    self.map = malloc((size_t)capacity * 6 * sizeof *self.map);
    const double **rows = malloc((size_t)capacity * sizeof *rows);
    if (self.law && self.map && rows) {
        for (int i = 0; i < capacity; i++) rows[i] = self.map + 6 * i;
        status = visit_contacts(&self, side, cells);
        if (status == CPS_OK)
            status =
                cps_law_contacts(3, self.count, (const CpsLaw *const *)self.law, rows, out, err);
    } else {
        status = cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    }
    for (int i = 0; i < self.count; i++) cps_law_release(self.law[i]);
    free(self.law);
    free(self.map);
    free(rows);
    return status;
}

/* ---- as a system ---- */

/* a system retains the law itself */
static CpsStatus add_contact(Contacts *self, int patch, CpsLaw *law, const double map[6]) {
    const CpsiPatch *at = &self->body->patch[patch];
    CpsEntry entry[7];
    char name[32];
    int count = 0;
    for (int i = 0; i < 6; i++) entry[count++] = (CpsEntry){i / 3, i % 3, map[i]};
    if (has_brake(at)) entry[count++] = (CpsEntry){1, 3 + self->spins, at->size};
    snprintf(name, sizeof name, "patch %d", patch);
    CpsStatus status = cps_system_add_friction(self->system, name, law, count, entry, self->err);
    cps_law_release(law);
    if (status != CPS_OK || !has_brake(at)) return status;

    CpsLaw *brake = NULL;
    const CpsEntry spin = {0, 3 + self->spins++, 1};
    snprintf(name, sizeof name, "patch %d brake", patch);
    status = brake_law(at, &brake, self->err);
    if (status == CPS_OK)
        status = cps_system_add_friction(self->system, name, brake, 1, &spin, self->err);
    cps_law_release(brake);
    return status;
}

CpsStatus cps_planar_system(const CpsPlanar *body, CpsPlanarSide side, int cells, CpsSystem **out,
                            CpsError *err) {
    if (!body || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "body or out is NULL");
    int contacts = 0, parameters = 3;
    CpsStatus status = count_contacts(body, side, cells, &contacts, err);
    if (status != CPS_OK) return status;
    for (int k = 0; k < body->count; k++) parameters += has_brake(&body->patch[k]);
    Contacts self = {.body = body, .take = add_contact, .err = err};
    status = cps_system_create(parameters, &self.system, err);
    if (status != CPS_OK) return status;
    status = visit_contacts(&self, side, cells);
    if (status == CPS_OK)
        *out = self.system;
    else
        cps_system_destroy(self.system);
    return status;
}
