/* SPDX-License-Identifier: BSD-3-Clause */
/* Closed convex sets of places (place_set.h). */
#include "geometry/place_set.h"

#include <math.h>

#include "base/rotation.h"

/* Axes with a given third (or, turned, first) direction. */
static void axes_about(Vec3 axis, bool first, double axes[9]) {
    const Vec3 n = vec3_scale(1 / vec3_norm(axis), axis);
    const double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    const Vec3 other = x <= y && x <= z ? vec3(1, 0, 0) : y <= z ? vec3(0, 1, 0) : vec3(0, 0, 1);
    const Vec3 across = vec3_reject(other, n), one = vec3_scale(1 / vec3_norm(across), across),
               two = vec3_cross(n, one);
    vec3_store(&axes[0], first ? n : one);
    vec3_store(&axes[3], first ? one : two);
    vec3_store(&axes[6], first ? two : n);
}

static void box_axes(const double rotation[4], double axes[9]) {
    static const double none[4] = {1, 0, 0, 0};
    bool given = false;
    for (int a = 0; a < 4; a++) given = given || rotation[a] != 0;
    const Rotation q = rotation_load(given ? rotation : none);
    vec3_store(&axes[0], rotation_apply(q, vec3(1, 0, 0)));
    vec3_store(&axes[3], rotation_apply(q, vec3(0, 1, 0)));
    vec3_store(&axes[6], rotation_apply(q, vec3(0, 0, 1)));
}

CpsiPlaceSet cpsi_place_set(const CpsConstraint *given) {
    CpsiPlaceSet set = {.centre = vec3_load(given->point)};
    const Vec3 axis = vec3_load(given->axis);
    for (int a = 0; a < 3; a++) {
        set.low[a] = -INFINITY;
        set.high[a] = INFINITY;
    }
    switch (given->kind) {
    case CPS_CONSTRAINT_KIND_RAIL:
        axes_about(axis, true, set.axes);
        for (int a = 1; a < 3; a++) set.low[a] = set.high[a] = 0;
        if (isinf(given->length)) break;
        set.low[0] = 0;
        set.high[0] = given->length;
        break;
    case CPS_CONSTRAINT_KIND_HALF_SPACE:
        axes_about(axis, false, set.axes);
        set.low[2] = 0;
        break;
    case CPS_CONSTRAINT_KIND_DISC:
        axes_about(axis, false, set.axes);
        set.low[2] = set.high[2] = 0;
        set.round = 2;
        set.radius = given->radius;
        break;
    case CPS_CONSTRAINT_KIND_BOX:
        box_axes(given->rotation, set.axes);
        for (int a = 0; a < 3; a++) {
            set.high[a] = 0.5 * given->size[a];
            set.low[a] = -set.high[a];
        }
        break;
    case CPS_CONSTRAINT_KIND_NONE:
    case CPS_CONSTRAINT_KIND_SET:
    case CPS_CONSTRAINT_KIND_BALL:
        axes_about(vec3(0, 0, 1), false, set.axes);
        set.round = 3;
        set.radius = given->radius;
        break;
    }
    return set;
}

Vec3 cpsi_place_set_from(const CpsiPlaceSet *set, const double own[3]) {
    Vec3 v = vec3(0, 0, 0);
    for (int a = 0; a < 3; a++) v = vec3_axpy(own[a], vec3_at(set->axes, a), v);
    return v;
}

void cpsi_place_set_to(const CpsiPlaceSet *set, Vec3 v, double own[3]) {
    for (int a = 0; a < 3; a++) own[a] = vec3_dot(vec3_at(set->axes, a), v);
}

/* The size of the round components. */
static double round_size(const CpsiPlaceSet *set, const double y[3]) {
    double sum = 0;
    for (int a = 0; a < set->round; a++) sum += y[a] * y[a];
    return sqrt(sum);
}

Vec3 cpsi_place_set_project(const CpsiPlaceSet *set, Vec3 x) {
    double y[3];
    bool inside = true;
    cpsi_place_set_to(set, vec3_sub(x, set->centre), y);
    for (int a = 0; a < 3; a++) {
        const double to = fmin(fmax(y[a], set->low[a]), set->high[a]);
        inside = inside && to == y[a];
        y[a] = to;
    }
    const double size = round_size(set, y);
    if (set->round > 0 && size > set->radius) {
        inside = false;
        for (int a = 0; a < set->round; a++) y[a] *= set->radius / size;
    }
    return inside ? x : vec3_add(set->centre, cpsi_place_set_from(set, y));
}

void cpsi_place_set_back(const CpsiPlaceSet *set, Vec3 x, double own[3]) {
    double y[3];
    cpsi_place_set_to(set, vec3_sub(x, set->centre), y);
    for (int a = 0; a < 3; a++) own[a] = fmin(fmax(y[a], set->low[a]), set->high[a]) - y[a];
    const double size = round_size(set, y);
    for (int a = 0; a < set->round; a++)
        own[a] = size > set->radius ? (set->radius / size - 1) * y[a] : 0;
}

void cpsi_place_set_slopes(const CpsiPlaceSet *set, Vec3 x, double out[3][3]) {
    double y[3], own[3][3] = {{0}};
    cpsi_place_set_to(set, vec3_sub(x, set->centre), y);
    const double size = round_size(set, y), share = size > set->radius ? set->radius / size : 1;
    for (int a = 0; a < 3; a++)
        own[a][a] = set->low[a] < set->high[a] && y[a] >= set->low[a] && y[a] <= set->high[a];
    for (int a = 0; a < set->round; a++)
        for (int b = 0; b < set->round; b++)
            own[a][b] = share * (a == b) - (share < 1 ? share * y[a] * y[b] / (size * size) : 0);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            out[i][j] = 0;
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++)
                    out[i][j] += set->axes[3 * a + i] * own[a][b] * set->axes[3 * b + j];
        }
}

double cpsi_place_set_gap(const CpsiPlaceSet *set, const double v[3], Vec3 x) {
    double y[3], gap = 0, along = 0;
    cpsi_place_set_to(set, vec3_sub(x, set->centre), y);
    for (int a = set->round; a < 3; a++)
        if (v[a] != 0) gap += v[a] > 0 ? v[a] * (set->high[a] - y[a]) : v[a] * (set->low[a] - y[a]);
    /* |v| r - v.y = |v| (r - |y|) + (|v||y| - v.y) */
    for (int a = 0; a < set->round; a++) along += v[a] * y[a];
    const double size = round_size(set, v), from = round_size(set, y);
    double defect = size * from - along;
    if (set->round > 0 && along > 0) {
        const Vec3 vv = vec3(v[0], v[1], set->round > 2 ? v[2] : 0),
                   yy = vec3(y[0], y[1], set->round > 2 ? y[2] : 0);
        defect = vec3_angle_defect(vv, yy, size, from);
    }
    return gap + (set->round > 0 ? size * (set->radius - from) + defect : 0);
}

Vec3 cpsi_place_set_recedes(const CpsiPlaceSet *set, Vec3 v) {
    double own[3];
    cpsi_place_set_to(set, v, own);
    for (int a = 0; a < 3; a++)
        if (a < set->round || (own[a] > 0 && isfinite(set->high[a])) ||
            (own[a] < 0 && isfinite(set->low[a])))
            own[a] = 0;
    return cpsi_place_set_from(set, own);
}
