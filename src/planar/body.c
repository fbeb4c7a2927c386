/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies: checking and copying patches, and the sum of their dissipation. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/math.h"
#include "base/status.h"
#include "planar/planar.h"

enum { PATCH_COOKIE = 0x1a7c4a11 };

static const double TWO_PI = 2 * CPSI_PI;

/* Three corners of a convex polygon count as collinear up to this share of the product of two
 * sides. */
static const double STRAIGHT = 1e-12;

CpsPatch cps_patch_default(void) { return (CpsPatch){.cookie = PATCH_COOKIE}; }

/* ---- checks of one patch, under its name: "patch 2" ---- */

/* The tilt of a polygon is checked later, at its corners. */
static CpsStatus check_tilt(const char *name, const CpsPatch *patch, CpsError *err) {
    const bool area = patch->kind != CPS_PATCH_POINT && patch->kind != CPS_PATCH_WHEEL;
    const double tilt = hypot(patch->tilt[0], patch->tilt[1]);
    if (tilt != 0 && !area)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: the pressure of a point or wheel cannot be tilted", name);
    if (patch->tilt[1] != 0 && patch->kind == CPS_PATCH_ROD)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: the pressure of a rod cannot be tilted across it", name);
    if (area && patch->kind != CPS_PATCH_POLYGON && !(tilt * patch->size <= 1))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: with tilt %g 1/m the pressure is negative at an end", name, tilt);
    return CPS_OK;
}

static CpsStatus check_numbers(const char *name, const CpsPatch *patch, CpsError *err) {
    if (patch->cookie != PATCH_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s was not made by cps_patch_default()", name);
    if ((unsigned)patch->kind > CPS_PATCH_POLYGON)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s has kind %d, which is none of CpsPatchKind",
                         name, (int)patch->kind);
    const double number[5] = {patch->position[0], patch->position[1], patch->angle, patch->tilt[0],
                              patch->tilt[1]};
    for (int i = 0; i < 5; i++)
        if (!isfinite(number[i]))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%s: position, angle or tilt is %g, expected a finite number", name,
                             number[i]);
    if (!(patch->friction >= 0) || !isfinite(patch->friction))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: the friction coefficient is %g, expected at least 0", name,
                         patch->friction);
    if (!(patch->load >= 0) || !isfinite(patch->load))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: the load is %g N, expected at least 0 (pressing)", name, patch->load);
    const bool sized = patch->kind != CPS_PATCH_POINT && patch->kind != CPS_PATCH_POLYGON;
    if (sized && (!(patch->size > 0) || !isfinite(patch->size)))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: the size is %g m, expected more than 0", name,
                         patch->size);
    if (patch->kind == CPS_PATCH_WHEEL && !(patch->brake >= 0))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: the brake holds %g N m, expected at least 0",
                         name, patch->brake);
    return check_tilt(name, patch, err);
}

static CpsStatus check_law(const char *name, const CpsPatch *patch, CpsError *err) {
    if (!patch->law) return CPS_OK;
    if (patch->kind != CPS_PATCH_POINT)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s has a law of its own, which only a point may have", name);
    if (patch->friction != 0 || patch->load != 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s has a law, and friction and load too: give one or the other", name);
    if (cps_law_space(patch->law) != 2)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s has a law in %d components, expected 2", name,
                         cps_law_space(patch->law));
    CpsSetFacts facts;
    const CpsStatus status = cps_set_facts(cps_law_set(patch->law), 0, &facts, NULL, NULL, err);
    if (status == CPS_OK && facts.outcome == CPS_SET_OUTCOME_ANSWERED && !facts.bounded)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s has a law with forces without bound", name);
    return status;
}

static double cross(const double a[2], const double b[2]) { return a[0] * b[1] - a[1] * b[0]; }

/* Check that the polygon is convex and counterclockwise: every turn is to the left, and together
 * they make one full turn. */
static CpsStatus check_convex(const char *name, const CpsPatch *patch, CpsError *err) {
    const int n = patch->corner_count;
    if (n < 3 || n > CPS_PLANAR_MAX_CELLS || !patch->corner)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: a polygon of %d corners, expected from 3 to %d", name, n,
                         CPS_PLANAR_MAX_CELLS);
    double turned = 0;
    for (int i = 0; i < n; i++) {
        const double *p = patch->corner + 2 * i, *q = patch->corner + 2 * ((i + 1) % n),
                     *r = patch->corner + 2 * ((i + 2) % n);
        const double a[2] = {q[0] - p[0], q[1] - p[1]}, b[2] = {r[0] - q[0], r[1] - q[1]};
        const double left = cross(a, b), sides = hypot(a[0], a[1]) * hypot(b[0], b[1]);
        if (!isfinite(sides) || !(sides > 0))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%s: corner %d is not finite, or equal to its neighbour", name, i);
        if (!(left >= -STRAIGHT * sides))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%s: the polygon turns right at corner %d, expected a convex one, "
                             "counterclockwise; cut others into convex patches",
                             name, (i + 1) % n);
        turned += atan2(left, a[0] * b[0] + a[1] * b[1]);
    }
    if (!(fabs(turned - TWO_PI) < 1))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: the polygon goes round more than once", name);
    return CPS_OK;
}

static CpsStatus check_patch(const char *name, const CpsPatch *patch, CpsError *err) {
    CpsStatus status = check_numbers(name, patch, err);
    if (status == CPS_OK) status = check_law(name, patch, err);
    if (status == CPS_OK && patch->kind == CPS_PATCH_POLYGON)
        status = check_convex(name, patch, err);
    return status;
}

/* ---- copies ---- */

static void turn(const double axis[2], const double v[2], double out[2]) {
    const double x = axis[0] * v[0] - axis[1] * v[1], y = axis[1] * v[0] + axis[0] * v[1];
    out[0] = x;
    out[1] = y;
}

/* Corners in body axes about the centroid, which becomes the patch's position. */
static CpsStatus place_polygon(const char *name, const CpsPatch *patch, double *corner,
                               CpsiPatch *out, CpsError *err) {
    const int n = patch->corner_count;
    double twice = 0, moment[2] = {0, 0};
    for (int i = 0; i < n; i++) turn(out->axis, patch->corner + 2 * i, corner + 2 * i);
    for (int i = 1; i + 1 < n; i++) {
        const double a[2] = {corner[2 * i] - corner[0], corner[2 * i + 1] - corner[1]};
        const double b[2] = {corner[2 * i + 2] - corner[0], corner[2 * i + 3] - corner[1]};
        const double part = cross(a, b);
        twice += part;
        for (int x = 0; x < 2; x++) moment[x] += part * (a[x] + b[x]) / 3;
    }
    if (!(twice > 0)) return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: the polygon has no area", name);
    const double centroid[2] = {corner[0] + moment[0] / twice, corner[1] + moment[1] / twice};
    out->size = 0;
    turn(out->axis, patch->tilt, out->tilt);
    for (int i = 0; i < n; i++) {
        for (int x = 0; x < 2; x++) corner[2 * i + x] -= centroid[x];
        out->size = fmax(out->size, hypot(corner[2 * i], corner[2 * i + 1]));
        const double pressure = 1 + out->tilt[0] * corner[2 * i] + out->tilt[1] * corner[2 * i + 1];
        if (!(pressure >= -STRAIGHT))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%s: the tilt makes the pressure negative at corner %d", name, i);
    }
    for (int x = 0; x < 2; x++) out->position[x] += centroid[x];
    out->area = twice / 2;
    out->corner_count = n;
    out->corner = corner;
    return CPS_OK;
}

static CpsStatus place_patch(const char *name, const CpsPatch *patch, double *corner,
                             CpsiPatch *out, CpsError *err) {
    *out = (CpsiPatch){.kind = patch->kind,
                       .position = {patch->position[0], patch->position[1]},
                       .axis = {cos(patch->angle), sin(patch->angle)},
                       .strength = patch->friction * patch->load,
                       .tilt = {patch->tilt[0], patch->tilt[1]}};
    if (patch->kind == CPS_PATCH_POLYGON) return place_polygon(name, patch, corner, out, err);
    if (patch->kind != CPS_PATCH_POINT) out->size = patch->size;
    if (patch->kind == CPS_PATCH_WHEEL) out->strip = patch->brake / patch->size;
    if (patch->kind == CPS_PATCH_RING || patch->kind == CPS_PATCH_DISC)
        turn(out->axis, patch->tilt, out->tilt);
    if (patch->law) out->set = cps_set_retain(cps_law_set(patch->law));
    return CPS_OK;
}

/* The name of patch k in messages. */
static const char *patch_name(int k, char name[32]) {
    snprintf(name, 32, "patch %d", k);
    return name;
}

CpsStatus cps_planar_create(int count, const CpsPatch *patch, CpsPlanar **out, CpsError *err) {
    if (!patch || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "patch or out is NULL");
    if (count < 1 || count > CPS_PLANAR_MAX_PATCHES)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%d patches given, expected from 1 to %d", count,
                         CPS_PLANAR_MAX_PATCHES);
    CpsStatus status = CPS_OK;
    size_t corners = 0;
    char name[32];
    for (int k = 0; k < count && status == CPS_OK; k++) {
        status = check_patch(patch_name(k, name), &patch[k], err);
        if (status != CPS_OK) cpsi_fail_inside(err, status, "patch[%d]", k + 1);
        if (status == CPS_OK && patch[k].kind == CPS_PATCH_POLYGON)
            corners += (size_t)patch[k].corner_count;
    }
    if (status != CPS_OK) return status;

    CpsPlanar *body = calloc(1, sizeof *body + (size_t)count * sizeof body->patch[0]);
    double *corner = malloc((2 * corners + 1) * sizeof *corner);
    if (!body || !corner) {
        free(body);
        free(corner);
        return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    }
    body->count = count;
    body->corner = corner;
    for (int k = 0; k < count && status == CPS_OK; k++) {
        CpsiPatch *to = &body->patch[k];
        status = place_patch(patch_name(k, name), &patch[k], corner, to, err);
        if (status != CPS_OK) cpsi_fail_inside(err, status, "patch[%d]", k + 1);
        corner += 2 * to->corner_count;
        const double extent = patch[k].kind == CPS_PATCH_WHEEL ? 0 : to->size;
        body->reach = fmax(body->reach, hypot(to->position[0], to->position[1]) + extent);
    }
    if (!(body->reach > 0)) body->reach = 1;
    if (status == CPS_OK)
        *out = body;
    else
        cps_planar_destroy(body);
    return status;
}

CpsStatus cps_patch_check(const CpsPatch *patch, CpsError *err) {
    const char *name = "this patch";
    if (!patch) return cpsi_fail(err, CPS_ERR_ARGUMENT, "patch is NULL");
    const CpsStatus status = check_patch(name, patch, err);
    if (status != CPS_OK || patch->kind != CPS_PATCH_POLYGON) return status;
    double *corner = malloc(2 * (size_t)patch->corner_count * sizeof *corner);
    if (!corner) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    CpsiPatch placed;
    const CpsStatus fits = place_patch(name, patch, corner, &placed, err);
    free(corner);
    return fits;
}

void cps_planar_destroy(CpsPlanar *body) {
    if (!body) return;
    for (int k = 0; k < body->count; k++) cps_set_release(body->patch[k].set);
    free(body->corner);
    free(body);
}

int cps_planar_patch_count(const CpsPlanar *body) { return body ? body->count : 0; }

/* ---- the law ---- */

CpsStatus cpsi_planar_dissipation_rate(const CpsPlanar *body, const double twist[3],
                                       double wrench[3], double *by_patch, CpsSetAnswer *answer,
                                       CpsError *err) {
    double total[3] = {0, 0, 0};
    *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED, .exact = true};
    for (int k = 0; k < body->count; k++) {
        const CpsiPatch *patch = &body->patch[k];
        CpsiPatchDissipation part;
        double velocity[2];
        cpsi_patch_velocity(patch, twist, velocity);
        const CpsStatus status = cpsi_patch_dissipation_rate(patch, velocity, twist[2], &part, err);
        if (status != CPS_OK) return status;
        if (part.outcome != CPS_SET_OUTCOME_ANSWERED) answer->outcome = part.outcome;
        answer->exact &= part.exact;
        answer->value += part.power;
        answer->gap += part.gap;
        total[0] += part.force[0];
        total[1] += part.force[1];
        total[2] +=
            part.torque + patch->position[0] * part.force[1] - patch->position[1] * part.force[0];
        if (by_patch) by_patch[k] = part.power;
    }
    if (answer->outcome == CPS_SET_OUTCOME_ANSWERED && !isfinite(answer->value))
        answer->outcome = CPS_SET_OUTCOME_INACCURATE;
    if (wrench)
        for (int i = 0; i < 3; i++) wrench[i] = total[i];
    return CPS_OK;
}

CpsStatus cps_planar_dissipation(const CpsPlanar *body, const double twist[3], double wrench[3],
                                 double *by_patch, CpsSetAnswer *answer, CpsError *err) {
    if (!body || !answer) return cpsi_fail(err, CPS_ERR_ARGUMENT, "body or answer is NULL");
    const CpsStatus status = cpsi_law_check_vector("twist", 3, twist, err);
    return status == CPS_OK
               ? cpsi_planar_dissipation_rate(body, twist, wrench, by_patch, answer, err)
               : status;
}

CpsStatus cps_planar_wheel(const CpsPlanar *body, int patch, const double twist[3],
                           CpsWheelMotion *motion, CpsError *err) {
    if (!body || !motion) return cpsi_fail(err, CPS_ERR_ARGUMENT, "body or motion is NULL");
    if (patch < 0 || patch >= body->count || body->patch[patch].kind != CPS_PATCH_WHEEL)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "patch %d of %d is not a wheel", patch,
                         body->count);
    const CpsStatus status = cpsi_law_check_vector("twist", 3, twist, err);
    if (status != CPS_OK) return status;
    double velocity[2];
    cpsi_patch_velocity(&body->patch[patch], twist, velocity);
    *motion = cpsi_wheel_motion(&body->patch[patch], velocity);
    return CPS_OK;
}
