/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of the shapes of obstacles (shape_check.h). */
#include "evolve/shape_check.h"

#include <math.h>
#include <stdio.h>

#include "base/math.h"
#include "base/status.h"
#include "evolve/ranges.h"
#include "geometry/obstacle.h"

/* What a kind is called in a file, and its point. */
typedef struct Name {
    const char *kind, *point;
} Name;

static Name name_of(CpsObstacleKind kind) {
    switch (kind) {
    case CPS_OBSTACLE_CYLINDER: return (Name){"cylinder", "point"};
    case CPS_OBSTACLE_SPHERE: return (Name){"sphere", "centre"};
    case CPS_OBSTACLE_CAPSULE: return (Name){"capsule", "centre"};
    case CPS_OBSTACLE_TORUS: return (Name){"torus", "centre"};
    case CPS_OBSTACLE_CONE: return (Name){"cone", "tip"};
    default: return (Name){"box", "centre"};
    }
}

/* Refuse the key of a shape. */
#define REFUSE(key, ...)                                                    \
    do {                                                                    \
        char place[48];                                                     \
        snprintf(place, sizeof place, "%s.%s", name_of(o->kind).kind, key); \
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT, __VA_ARGS__);     \
    } while (0)

static CpsStatus check_box(const CpsObstacle *o, CpsError *err) {
    double largest = 0;
    bool finite = true;
    for (int i = 0; i < 3; i++)
        if (!(cpsi_is_positive(o->shape.size[i]) && o->shape.size[i] > 2 * o->radius))
            REFUSE("size",
                   "obstacle '%s': size is (%g, %g, %g) m, expected finite numbers above twice the "
                   "radius of the edges, %g m",
                   o->name, o->shape.size[0], o->shape.size[1], o->shape.size[2], 2 * o->radius);
    for (int i = 0; i < 4; i++) {
        finite = finite && isfinite(o->shape.rotation[i]);
        largest = fmax(largest, fabs(o->shape.rotation[i]));
    }
    if (!(finite && largest > 0))
        REFUSE(
            "rotation",
            "obstacle '%s': rotation is (%g, %g, %g, %g), expected a quaternion: finite numbers, "
            "not all 0",
            o->name, o->shape.rotation[0], o->shape.rotation[1], o->shape.rotation[2],
            o->shape.rotation[3]);
    return CPS_OK;
}

static CpsStatus check_sizes(const CpsObstacle *o, CpsError *err) {
    const CpsShape *shape = &o->shape;
    if (o->kind == CPS_OBSTACLE_CAPSULE && !cpsi_is_not_negative(shape->length))
        REFUSE("length", "obstacle '%s': length is %g m, expected a finite number >= 0", o->name,
               shape->length);
    if (o->kind == CPS_OBSTACLE_TORUS &&
        !(cpsi_is_positive(shape->main_radius) && shape->main_radius > o->radius))
        REFUSE("main_radius",
               "obstacle '%s': main_radius is %g m, expected a finite number above the radius of "
               "the tube, %g m",
               o->name, shape->main_radius, o->radius);
    if (o->kind == CPS_OBSTACLE_CONE && !(shape->angle > 0 && shape->angle < 90 * CPSI_DEGREE))
        REFUSE("angle",
               "obstacle '%s': the angle between axis and side is %g degrees, expected more than 0 "
               "and less than 90",
               o->name, shape->angle / CPSI_DEGREE);
    return o->kind == CPS_OBSTACLE_BOX ? check_box(o, err) : CPS_OK;
}

CpsStatus cpsi_shape_check(const CpsObstacle *o, CpsError *err) {
    const Name name = name_of(o->kind);
    const double *p = o->point, *d = o->axis;
    if (!cpsi_are_usable(p))
        REFUSE(name.point, "obstacle '%s': %s %s is (%g, %g, %g) m, expected finite numbers",
               o->name, name.kind, name.point, p[0], p[1], p[2]);
    if (cpsi_obstacle_kind_has_axis(o->kind) && !cpsi_is_direction(d))
        REFUSE("axis",
               "obstacle '%s': axis is (%g, %g, %g), expected a direction: finite numbers, not all "
               "0",
               o->name, d[0], d[1], d[2]);
    if (!cpsi_is_positive(o->radius))
        REFUSE("radius", "obstacle '%s': radius is %g m, expected a positive finite number",
               o->name, o->radius);
    return check_sizes(o, err);
}
