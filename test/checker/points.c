/* SPDX-License-Identifier: BSD-3-Clause */
/* Balance, contact and friction of points (points.h).
 *
 * On a point act the lines that end there, against the forces that act on their ends; the load of a
 * free point, or the support of a held one; and of an obstacle that it touches the reaction R along
 * the normal and friction F:
 *
 *     lines + load + support + R n + F + S + B m = residual,    R >= 0,  |F| <= mu R
 *
 * S is the reaction of a set that the point is held to (sets.h), B m the buoyancy (floats.h).
 * It sticks, or slides by s on the obstacle, which may turn meanwhile, and then mu R |s| + F.s
 * vanishes, and so does |s| F + mu R s. The second falls with the angle between friction and slip,
 * the first with its square. */
#include "points.h"

#include <float.h>
#include <math.h>
#include <netcdf.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include "anchors.h"
#include "floats.h"
#include "formula.h"
#include "groups.h"
#include "joint_motion.h"
#include "sets.h"
#include "water.h"

/* Sums of a few numbers of the file, per largest force; a balance, in tolerances of the step: what
 * the search for the places of points may leave; places and slips per length, as those of lines. */
static const double SUMS = 1e-12, BALANCED = 100, PLACES = 1e-9, COPIED = 1e-12;
/* Friction above its bound per largest force, and normals. */
static const double FORCES = 1e-9, NORMALS = 1e-9;
/* A strain is known to so many roundings of places: those of two nodes in three coordinates, of the
 * two elements beside a point, and as much again. */
static const double ROUNDINGS = 16;

typedef struct Points {
    const Source *source;
    Record *line;                   /* (lines) of the step */
    Junction *now, *before, *older; /* (points) */
    double *rate, *rate_before;     /* (points) [m/s] of what each touches, along the normal */
    PointMotion *motion, *motion_before, *motion_older; /* (points) */
    Water *water;                                       /* (points) of the step */
    Afloat *afloat, *afloat_before;                     /* (points) the surfaces about them */
    double *height;                                     /* (points) [m] of what floats */
    Sea sea;
    Anchor *anchor;  /* (points) */
    PointSets *sets; /* NULL: none */
    bool *gives;     /* (points) of the step: it floats, or is an anchor that drags */
    Bodies bodies;
    BodyState *body;         /* (bodies) of the step */
    BodyMotion *body_motion; /* (bodies) */
    double *dragged;         /* (points) [m] before the step */
    double surface;          /* [m] z of the water's surface */
    bool has_surface;
    double *length;  /* (points) [m] of the longest line that ends there */
    double *area;    /* (points) [m2] with which it bears itself on what gives */
    double largest;  /* [N] of the step */
    double acting;   /* [N] of it and of bodies what no tension without a bound may have made */
    double rounding; /* [N] of the tensions by that of places */
    bool certified, has_friction;
    size_t step, point;
    PointFinding *find;
    void *user;
} Points;

__attribute__((format(printf, 2, 3))) static void find(const Points *p, const char *format, ...) {
    char sentence[300];
    va_list list;
    va_start(list, format);
    vsnprintf(sentence, sizeof sentence, format, list);
    va_end(list);
    p->find(p->user, p->source->point_name[p->point], p->step, sentence);
}

/* value <= bound, with NaN a finding */
static void at_most(const Points *p, const char *what, double value, double bound) {
    if (!(value <= bound)) find(p, "%s is %.6g, allowed %.3g", what, value, bound);
}

static double size(const double *v) { return hypot(hypot(v[0], v[1]), v[2]); }
static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/* | |s| F + bound s | */
static double off_law(const double *force, const double *slip, double bound) {
    const double far = size(slip);
    double off[3];
    for (int a = 0; a < 3; a++) off[a] = far * force[a] + bound * slip[a];
    return size(off);
}
static double apart(const double *a, const Real *b) {
    return hypot(hypot(a[0] - (double)b[0], a[1] - (double)b[1]), a[2] - (double)b[2]);
}
static void widen(const double *a, Real *out) {
    for (int k = 0; k < 3; k++) out[k] = a[k];
}

/* Whether it is held, by itself or by the body that it is on. */
static bool is_held(const Junction *at) {
    return at->state == POINT_HELD || at->state == POINT_ON_BODY;
}

/* The sum of the lines, and where their ends are. */
static void check_lines(const Points *p, const Junction *at) {
    Real sum[3] = {0};
    for (size_t i = 0; i < p->source->lines; i++)
        for (int e = 0; e < 2; e++) {
            const Record *r = &p->line[i];
            if (r->end_point[e] != (int)p->point) continue;
            Real place[3];
            widen(at->position, place);
            for (int k = 0; k < 3; k++) sum[k] -= r->end_force[e][k];
            /* where a part of a step has no solution, the file has the end on its way */
            const bool ended = r->outcome == OUTCOME_UNBOUNDED ||
                               r->outcome == OUTCOME_INFEASIBLE || r->outcome == OUTCOME_SLIDES;
            if (r->end_kind[e] != END_HELD)
                find(p, "the end of line %s is free", p->source->line_name[i]);
            else if (!ended || (r->substeps == 1 && r->share == 1))
                at_most(p, "distance of the end of a line", apart(r->held_position[e], place),
                        COPIED *
                            (size(at->position) + size(p->source->origin) + p->length[p->point]));
        }
    at_most(p, "sum of the lines against that of their ends", apart(at->lines, sum),
            SUMS * p->largest);
}

static void check_balance(const Points *p, const Junction *at) {
    Real sum[3];
    const Water *water = &p->water[p->point];
    Real up[3];
    for (int k = 0; k < 3; k++) up[k] = water->buoyancy * p->afloat[p->point].n[k];
    for (int k = 0; k < 3; k++)
        sum[k] = (Real)at->lines[k] + at->load[k] + at->support[k] + at->friction[k] +
                 (Real)at->reaction * at->normal[k] + up[k] + p->motion[p->point].inertia[k];
    point_sets_add(p->sets, p->point, sum);
    at_most(p, "residual against the sum of the forces", apart(at->residual, sum),
            SUMS * p->largest);
    at_most(p, is_held(at) ? "load of a held point" : "support of a free point",
            size(is_held(at) ? at->load : at->support), 0);
    const int kind = p->source->point_kind[p->point];
    if ((at->state == POINT_ON_BODY) != (kind == POINT_KIND_ON_BODY))
        find(p, "its state and its kind differ in whether it is on a body");
    const double left = size(at->residual);
    const bool is_balanced = left <= BALANCED * p->source->tolerance * p->acting + p->rounding;
    if (at->has_place && !is_balanced)
        find(p, "it is said to have a place, but %.6g N are left, of %.6g N", left, p->acting);
    if (!at->has_place && p->certified)
        find(p, "it has no place, but lines that end there are certified");
}

static void find_in_set(void *user, const char *what, double said, double expected) {
    find(user, "%s: %.9g, expected %.9g", what, said, expected);
}

/* A free point that a set holds touches no obstacle, and does not slide along a ray for ever by any
 * proof that knows no sets. */
static void check_set(const Points *p, const Junction *at) {
    if (!point_sets_has(p->sets, p->point)) return;
    if (at->has_place)
        point_sets_check(p->sets, p->point, at->position, p->length[p->point], find_in_set,
                         (void *)(uintptr_t)p);
    if (at->state != POINT_FREE) find(p, "it is held to a set, but said not to be free");
    for (size_t i = 0; i < p->source->lines; i++)
        for (int e = 0; e < 2; e++)
            if (p->line[i].end_point[e] == (int)p->point && p->line[i].outcome == OUTCOME_UNBOUNDED)
                find(p, "a line at a point in a set is said to fall for ever");
}

/* The plane in which an anchor bears: a plane on which it lies, or a level one. */
static void ground_of(const Points *p, const Junction *at, double normal[3]) {
    const Source *source = p->source;
    const double place = PLACES * (p->length[p->point] + size(at->position)),
                 down = size(source->gravity);
    Real x[3], n[3];
    widen(at->position, x);
    for (int a = 0; a < 3; a++) normal[a] = down > 0 ? -source->gravity[a] / down : a == 2 ? 1 : 0;
    for (size_t k = 0; k < source->surfaces; k++) {
        if (surface_is_round(&source->surface[k]) ||
            (double)surface_distance(&source->surface[k], x) > place)
            continue;
        surface_normal(&source->surface[k], x, n);
        for (int a = 0; a < 3; a++) normal[a] = (double)n[a];
        return;
    }
}

/* An anchor bears along the ground no more than its capacity if it drags, and all of that, against
 * its drag, where it has given way. What it uses of its limits follows from what holds it. */
static void check_anchor(const Points *p, const Junction *at) {
    const Anchor *anchor = &p->anchor[p->point];
    const double far = size(anchor->drag), way = PLACES * p->length[p->point];
    double normal[3], support[3], along[3], up;
    at_most(p, "dragged length against the sum of the drags",
            fabs(anchor->dragged - p->dragged[p->point] - far), way);
    p->dragged[p->point] = anchor->dragged;
    if (!(anchor->drags && at->state == POINT_HELD)) at_most(p, "drag of what does not", far, 0);
    if (at->state != POINT_HELD) {
        at_most(p, "capacity or limit used by a free point",
                fabs(anchor->capacity_used) + fabs(anchor->uplift_used), 0);
        return;
    }
    ground_of(p, at, normal);
    for (int a = 0; a < 3; a++) support[a] = at->support[a] + at->reaction * at->normal[a];
    up = -dot(support, normal);
    for (int a = 0; a < 3; a++) along[a] = support[a] + up * normal[a];
    const double noise = FORCES * p->largest;
    at_most(p, "used capacity against the force along the ground",
            anchor->capacity > 0
                ? fabs(anchor->capacity_used * anchor->capacity - size(along)) - noise
                : fabs(anchor->capacity_used),
            0);
    at_most(p, "used limit against the force up from the ground",
            anchor->limit > 0 ? fabs(anchor->uplift_used * anchor->limit - fmax(0, up)) - noise
                              : fabs(anchor->uplift_used),
            0);
    if (!anchor->drags || !at->has_place) return;
    at_most(p, "force along the ground above the capacity", size(along) - anchor->capacity, noise);
    at_most(p, "drag out of the ground", fabs(dot(anchor->drag, normal)), way);
    at_most(p, "what a drag lacks of the capacity",
            anchor->capacity * far + dot(along, anchor->drag),
            (BALANCED * p->source->tolerance * p->largest + noise) * (far + way));
    at_most(p, "what the hold of a drag is off its direction",
            off_law(along, anchor->drag, anchor->capacity) - anchor->capacity * way,
            (BALANCED * p->source->tolerance * p->largest + noise) * (far + way));
    at_most(p, "dissipated energy against the work of the drag",
            fabs(at->dissipated - fmax(0, -dot(along, anchor->drag))), noise * (far + way));
}

/* The surface about it is that of the waves, or at rest. */
static void check_surface(const Points *p, const Junction *at) {
    const Water *water = &p->water[p->point];
    const Afloat *surface = &p->afloat[p->point];
    const double reach = size(at->position) + p->length[p->point], place = PLACES * reach;
    at_most(p, "direction of the water's force, off", apart(water->direction, surface->n), NORMALS);
    at_most(p, "level of the water, off",
            fabs(water->level - (double)floats_level(surface, at->position)), place);
}

/* A free point with a displaced weight has all of it as buoyancy below the surface, none above it,
 * and any part of it at the surface; with a height what of that is in the water. */
static void check_water(const Points *p, const Junction *at) {
    const Water *water = &p->water[p->point];
    const double place = PLACES * (p->length[p->point] + size(at->position)),
                 height = (double)floats_height(&p->afloat[p->point], at->position),
                 extent = p->height[p->point];
    const bool is_in = p->has_surface && at->state != POINT_HELD && water->displaced > 0;
    at_most(p, "weight of displaced water below 0", -water->displaced, 0);
    if (is_in != (water->state != WATER_NONE))
        find(p, "where it is in the water is not said, or is said of one that cannot float");
    if (!is_in) {
        at_most(p, "buoyancy of a point that does not float", fabs(water->buoyancy), 0);
        return;
    }
    Real share[2];
    floats_wet(extent, height, place, share);
    const double noise = SUMS * p->largest + (extent > 0 ? water->displaced * place / extent : 0);
    check_surface(p, at);
    at_most(p, "buoyancy above what its place allows",
            water->buoyancy - (double)share[1] * water->displaced, noise);
    at_most(p, "buoyancy below what its place demands",
            (double)share[0] * water->displaced - water->buoyancy, noise);
    if (water->state == WATER_FLOATING)
        at_most(p, "distance from the surface", fabs(height), 0.5 * extent + place);
    if (water->state == WATER_SUBMERGED && height > place - 0.5 * extent)
        find(p, "it is said to be submerged %.6g m above the surface", height);
    if (water->state == WATER_ABOVE && height < 0.5 * extent - place)
        find(p, "it is said to be above the water %.6g m below the surface", -height);
}

/* What the water has done to it in a step in time: the surface has risen from where it was to where
 * it is, both above the place where the point was. */
static void add_water(const Points *p, PointSteps *steps) {
    const Water *water = &p->water[p->point];
    if (p->step == 0 || !(water->displaced > 0) || !steps->is_free || !(steps->motion->span > 0))
        return;
    const Real extent = p->height[p->point],
               before = floats_height(&p->afloat_before[p->point], steps->before->position),
               sunk = floats_height(&p->afloat[p->point], steps->before->position),
               now = floats_height(&p->afloat[p->point], steps->now->position);
    steps->afloat = floats_energy(water->displaced, extent, now) -
                    floats_energy(water->displaced, extent, before);
    steps->waves = water->buoyancy * (before - sunk);
    steps->buoyancy = water->displaced;
}

/* The share of the step for which an obstacle carries the reference along. */
static double share_of(const Points *p) {
    const double span = p->motion[p->point].span, h = step_length_of(p->source, p->step);
    return span > 0 ? span / h : 1;
}

/* Where ground has taken what friction is measured from. In the matter of the ground a place is
 * where that has come to at the end of the step, and the slip is (y - y*) there, by the scheme: of
 * the place when the step began, y_n, and by a parabola of the one before as well. The ground moves
 * steadily in both steps. Where it goes straight this is x* = x_n + b (x_n - x_{n-1}) carried
 * along, from which x_{n-1} follows that may have forgotten its motion along the normal. */
static void carry_reference(const Points *p, const Surface *on, Real out[3]) {
    const PointMotion *motion = &p->motion[p->point];
    const Junction *before = &p->before[p->point];
    const double h = step_length_of(p->source, p->step),
                 turn = p->line[0].turn[on - p->source->surface];
    const double h_before = p->step > 0 ? step_length_of(p->source, p->step - 1) : 0;
    const Real back = motion->span > 0 ? formula_of(motion->span, h, h_before).back : 0;
    const bool turns = turn != 0 || on->spin[0] != 0 || on->spin[1] != 0 || on->spin[2] != 0;
    /* the first step of the file began at its reference */
    const double *past =
        p->step > 1 ? p->older[p->point].position : p->motion_before[p->point].reference;
    Real last[3], first[3], y[2][3];
    widen(before->position, last);
    surface_carry(on, last, 1, turn, y[0]);
    for (int a = 0; a < 3; a++) out[a] = y[0][a];
    if (!(back > 0)) return;
    for (int a = 0; a < 3; a++)
        first[a] = turns ? past[a] : last[a] - (motion->reference[a] - last[a]) / back;
    surface_carry(on, first, 1 + (Real)h_before / h, turn, y[1]);
    for (int a = 0; a < 3; a++) out[a] += back * (y[0][a] - y[1][a]);
}

/* What a surface that gives opposes to a free point. Where the first step of the file began is not
 * in it; it is an Euler step, from its reference. */
static SoftPush push_of(const Points *p, const Surface *surface, const Junction *at) {
    const PointMotion *motion = &p->motion[p->point];
    Real x[3], from[3], carried[3];
    widen(at->position, x);
    widen(motion->reference, from);
    if (p->step == 0)
        surface_carry(surface, from, 1, p->line[0].turn[surface - p->source->surface], carried);
    else
        carry_reference(p, surface, carried);
    return soft_point_push(surface,
                           soft_point_area(p->source, p->line, p->point, p->area[p->point]), x,
                           carried, motion->span);
}

/* In what gives a held point bears on what holds it, and one in a set has no place. Another free
 * point has the reaction of spring and damping of the one in which it lies deepest. */
static void check_soft(const Points *p, const Junction *at) {
    const Source *source = p->source;
    const double place = PLACES * (p->length[p->point] + size(at->position)),
                 copied =
                     COPIED * (size(at->position) + size(source->origin) + p->length[p->point]);
    const bool in_set = point_sets_has(p->sets, p->point);
    Real x[3];
    widen(at->position, x);
    for (size_t k = 0; k < source->surfaces; k++) {
        const Surface *surface = &source->surface[k];
        const double depth = -(double)surface_distance(surface, x);
        const bool touched = at->obstacle == (int)k;
        if (!(surface->gives > 0)) {
            if (at->obstacle >= 0 && source->surface[at->obstacle].gives > 0 && at->has_place)
                at_most(p, "depth in another obstacle than the one that gives", depth, place);
            continue;
        }
        if (touched && (is_held(at) || in_set))
            find(p, "what gives is said to bear a point that is held");
        if (is_held(at) || (in_set && !at->has_place)) continue;
        const SoftPush push = push_of(p, surface, at);
        const double force = (double)push.force, stiff = (double)push.steep;
        if (!touched && at->obstacle < 0)
            at_most(p, "depth in what gives but does not press",
                    in_set      ? depth
                    : stiff > 0 ? force / stiff
                                : 0,
                    place);
        else if (!touched)
            at_most(p, "depth in another obstacle, beside that in which it lies",
                    depth + (double)surface_distance(&source->surface[at->obstacle], x), place);
        else
            at_most(p, "reaction against that of the depth", fabs(at->reaction - force),
                    SUMS * p->largest + stiff * copied);
    }
}

/* No point is below a rigid obstacle, and what touches one is on it. */
static void check_contact(const Points *p, const Junction *at) {
    const Source *source = p->source;
    const double place = PLACES * (p->length[p->point] + size(at->position));
    Real x[3], n[3];
    widen(at->position, x);
    for (size_t k = 0; k < source->surfaces; k++)
        if (!(source->surface[k].gives > 0))
            at_most(p, "depth below an obstacle", -(double)surface_distance(&source->surface[k], x),
                    place);
    if (at->obstacle < 0) {
        /* frozen friction acts off the obstacle as well */
        double mu = 0;
        for (size_t k = 0; k < source->surfaces && !source->consistent; k++)
            mu = fmax(mu, (double)(surface_friction(&source->surface[k]) *
                                   surface_factor(&source->surface[k], x)));
        const double frozen = p->step > 0 ? mu * p->before[p->point].reaction : INFINITY;
        at_most(p, "force of an obstacle that it does not touch",
                fabs(at->reaction) + size(at->normal) + size(at->slip), 0);
        at_most(p, "friction of an obstacle that it does not touch", size(at->friction),
                mu > 0 && !is_held(at) ? frozen * (1 + SUMS) : 0);
        if (at->state == POINT_STICK || at->state == POINT_SLIP)
            find(p, "it is said to rest or slide on an obstacle, but touches none");
        return;
    }
    const Surface *surface = &source->surface[at->obstacle];
    surface_normal(surface, x, n);
    if (!(surface->gives > 0))
        at_most(p, "distance from the obstacle that it touches",
                fabs((double)surface_distance(surface, x)), place);
    at_most(p, "error of the normal", apart(at->normal, n), NORMALS);
    at_most(p, "reaction that pulls", -at->reaction, 0);
    if (at->state == POINT_FREE) find(p, "it is said to be off all obstacles, but touches one");
}

/* The bound of friction: with the reaction of the step itself, or of the one before. */
static double bound_of(const Points *p, const Junction *at) {
    const Surface *on = &p->source->surface[at->obstacle];
    Real x[3];
    widen(at->position, x);
    const double mu = (double)(surface_friction(on) * surface_factor(on, x));
    if (!p->has_friction) return 0;
    return mu * (p->source->consistent ? at->reaction : p->before[p->point].reaction);
}

/* [m] The way of what a point touches, there, in a step in time: from where its matter was. */
static void ground_way(const Points *p, const Junction *at, double way[3]) {
    for (int a = 0; a < 3; a++) way[a] = 0;
    if (at->obstacle < 0 || !(p->motion[p->point].span > 0)) return;
    const Surface *on = &p->source->surface[at->obstacle];
    const double turn = p->line[0].turn[at->obstacle];
    Real x[3], was[3];
    if (turn == 0 && !surface_moves(on)) return;
    widen(at->position, x);
    surface_uncarry(on, x, 1, turn, was);
    for (int a = 0; a < 3; a++) way[a] = (double)(x[a] - was[a]);
}

/* [m/s] How fast the surface itself moves there along its normal: a turn about its own axis moves
 * it into itself. */
static double ground_rate(const Points *p, const Junction *at) {
    Real x[3], was[3], rate = 0;
    if (at->obstacle < 0 || !(p->motion[p->point].span > 0)) return 0;
    widen(at->position, x);
    surface_unshift(&p->source->surface[at->obstacle], x, share_of(p), was);
    for (int a = 0; a < 3; a++) rate += (x[a] - was[a]) * at->normal[a];
    return (double)(rate / p->motion[p->point].span);
}

/* In time friction works on the whole way, less that of the ground. */
static void check_work(const Points *p, const Junction *at) {
    const double lost = at->dissipated, reach = size(at->position) + p->length[p->point];
    double way[3], off[3], sizes = 0;
    ground_way(p, at, way);
    for (int a = 0; a < 3; a++) {
        off[a] = at->position[a] - p->before[p->point].position[a] - way[a];
        sizes = fmax(sizes, fmax(fabs(off[a]), fabs(way[a])));
    }
    /* where matter was that has turned is known to some roundings, over the share of the step */
    const double rounding = size(way) > 0 ? 4 * ROUNDINGS * DBL_EPSILON * reach : 0;
    at_most(p, "dissipated energy against the work of friction in time",
            fabs(lost + dot(at->friction, off)), p->largest * (2 * SUMS * sizes + rounding));
}

static void check_friction(const Points *p, const Junction *at) {
    if (at->obstacle < 0) return;
    const Surface *surface = &p->source->surface[at->obstacle];
    const double force = FORCES * p->largest, way = PLACES * p->length[p->point];
    at_most(p, "friction along the normal", fabs(dot(at->friction, at->normal)), force);
    if (is_held(at)) {
        at_most(p, "friction or slip of a held point", size(at->friction) + size(at->slip), 0);
        return;
    }
    /* of a first step with frozen friction the reaction before it is not in the file */
    const bool is_known = p->source->consistent || p->step > 0 || !p->has_friction;
    const double bound = is_known ? bound_of(p, at) : INFINITY;
    at_most(p, "friction above its bound", size(at->friction) - bound, force);
    const double slid = -dot(at->friction, at->slip);
    const PointMotion *motion = &p->motion[p->point];
    if (motion->span > 0 && p->step > 0) check_work(p, at);
    if (!(motion->span > 0))
        at_most(p, "dissipated energy against the work of friction",
                fabs(at->dissipated - fmax(0, slid)), SUMS * p->largest * size(at->slip));
    if (at->state == POINT_STICK) at_most(p, "slip of a point at rest", size(at->slip), 2 * way);
    /* a slip no longer than places are known to has no direction */
    if (isfinite(bound) && at->has_place && size(at->slip) > 2 * way) {
        const double allowed = (BALANCED * p->source->tolerance * p->acting + p->rounding + force) *
                               (size(at->slip) + way);
        at_most(p, "what the law of friction lacks", bound * size(at->slip) - slid, allowed);
        at_most(p, "what friction is off the direction of the slip",
                off_law(at->friction, at->slip, bound) - bound * way, allowed);
    }
    if (p->step == 0) return; /* where it began is not in the file */
    Real to[3], carried[3], slip[3];
    widen(at->position, to);
    carry_reference(p, surface, carried);
    const Surface level = soft_level(surface, to);
    surface_slip(&level, carried, to, slip);
    at_most(p, "error of the slip", apart(at->slip, slip), 2 * way);
}

double acts_in_line(const Record *line) {
    if (line->compliance > 0) return line->claim[CLAIM_LARGEST_FORCE];
    double sum = 0;
    for (size_t j = 0; j < line->nodes; j++) sum += size(line->load[j]);
    return sum;
}

double rounding_in_line(const Record *line) {
    if (!(line->compliance > 0)) return 0;
    double shortest = INFINITY, far = 0;
    for (size_t i = 0; i < line->elements; i++) shortest = fmin(shortest, line->element_length[i]);
    for (size_t j = 0; j < line->nodes; j++) far = fmax(far, size(line->position[j]));
    return ROUNDINGS * DBL_EPSILON * (1 + far / shortest) / line->least_compliance;
}

/* What is left is compared with loads, and with tensions that strains have: an inextensible line
 * that is pulled straight may claim any. */
static void find_acting(Points *p) {
    for (size_t i = 0; i < p->source->points; i++) {
        const Anchor *anchor = &p->anchor[i];
        const PointMotion *motion = &p->motion[i];
        /* m ((x - x*)/k - v*)/k rounds as x does, which short steps magnify */
        if (motion->span > 0)
            p->rounding = fmax(p->rounding, ROUNDINGS * DBL_EPSILON * size(p->now[i].position) *
                                                motion->mass / (motion->span * motion->span));
        p->acting = fmax(p->acting, fmax(size(p->now[i].load), p->water[i].displaced));
        if (anchor->drags) p->acting = fmax(p->acting, anchor->capacity);
    }
    for (size_t i = 0; i < p->source->lines; i++) {
        p->acting = fmax(p->acting, acts_in_line(&p->line[i]));
        p->rounding = fmax(p->rounding, rounding_in_line(&p->line[i]));
    }
    /* beside bodies inextensible lines are never pulled straight, and what acts on the bodies acts
     * on the points as well; their moments are left to bodies.c */
    p->acting = p->bodies.count > 0 ? p->largest : fmin(p->acting, p->largest);
    for (size_t k = 0; k < p->bodies.count; k++)
        p->acting = fmax(p->acting, body_acting(p->source, &p->bodies.data[k], &p->body[k],
                                                &p->body_motion[k], INFINITY));
}

static void find_in_time(void *user, const char *what, double said, double expected) {
    find(user, "%s: %.9g, expected %.9g", what, said, expected);
}

/* Does a free point bear on something rigid? What gives stops none. */
static bool is_stopped(const Points *p, const Junction *at) {
    return !is_held(at) && at->reaction > 0 && at->obstacle >= 0 &&
           !(p->source->surface[at->obstacle].gives > 0);
}

/* What gives below a point, in a step that is not the first of the file. */
static SoftWork soft_work_of(const Points *p, const Junction *at) {
    if (p->step == 0 || is_held(at) || point_sets_has(p->sets, p->point))
        return (SoftWork){0, 0, 0, 0};
    const Real area = soft_point_area(p->source, p->line, p->point, p->area[p->point]);
    return soft_point_work(p->source, area, p->before[p->point].position, at->position,
                           at->reaction);
}

/* The motion of a point, and that the ends of lines there move with it. */
static void check_motion(Points *p) {
    const PointMotion *motion = &p->motion[p->point];
    const Junction *at = &p->now[p->point];
    const double reach = size(at->position) + p->length[p->point];
    const double h = step_length_of(p->source, p->step);
    p->rate[p->point] = ground_rate(p, at);
    PointSteps steps = {.now = at,
                        .before = p->step > 0 ? &p->before[p->point] : NULL,
                        .older = p->step > 1 ? &p->older[p->point] : NULL,
                        .motion = motion,
                        .motion_before = &p->motion_before[p->point],
                        .motion_older = &p->motion_older[p->point],
                        .h = h,
                        .h_before = p->step > 0 ? step_length_of(p->source, p->step - 1) : 0,
                        .reach = reach,
                        .largest = p->largest,
                        .rate = p->rate[p->point],
                        .rate_before = p->rate_before[p->point],
                        .is_free = !is_held(at),
                        .is_stopped = is_stopped(p, at),
                        .was_stopped = p->step > 0 && is_stopped(p, &p->before[p->point]),
                        .soft = soft_work_of(p, at)};
    ground_way(p, at, steps.ground);
    add_water(p, &steps);
    if (p->step > 0)
        at_most(p, "work of the waves, off", fabs(p->water[p->point].waves - (double)steps.waves),
                1e-9 * (double)fabsl(steps.waves) + 1e-12 * reach * steps.buoyancy);
    point_motion_check(&steps, find_in_time, p);
    for (size_t i = 0; i < 2 * p->source->lines; i++) {
        const Record *r = &p->line[i / 2];
        const size_t j = i % 2 ? r->elements : 0;
        if (r->end_point[i % 2] != (int)p->point || !r->mass || !(motion->span > 0)) continue;
        /* beside what is held a line may take a step of its own */
        if (is_held(at) && r->span[j] != motion->span) continue;
        Real velocity[3], reference[3];
        widen(r->velocity[j], velocity);
        widen(r->reference[j], reference);
        at_most(p, "velocity of the end of a line off that of the point, times k",
                apart(motion->velocity, velocity) * motion->span, 1e-13 * reach);
        at_most(p, "reference of the end of a line off that of the point",
                apart(motion->reference, reference), 1e-13 * reach);
        at_most(p, "span of the end of a line off that of the point",
                fabs(r->span[j] - motion->span), 0);
    }
}

/* The surfaces about the points in the step. */
static void find_surfaces(Points *p) {
    const Source *source = p->source;
    double time = 0;
    int id;
    const bool waves = p->sea.waves > 0 && nc_inq_varid(source->nc, "time", &id) == NC_NOERR &&
                       nc_get_var1_double(source->nc, id, &p->step, &time) == NC_NOERR;
    for (size_t k = 0; k < source->points; k++)
        p->afloat[k] =
            waves && p->motion[k].span > 0
                ? floats_in_waves(&p->sea, -(Real)source->gravity[2], time, &p->motion[k])
                : floats_at_rest(p->surface);
}

static void check_step(Points *p) {
    const Source *source = p->source;
    find_surfaces(p);
    p->largest = p->acting = p->rounding = 0;
    p->certified = false;
    for (size_t i = 0; i < source->points; i++)
        p->largest = fmax(p->largest, fmax(size(p->now[i].load), p->water[i].buoyancy));
    for (size_t i = 0; i < source->lines; i++)
        p->largest = fmax(p->largest, p->line[i].claim[CLAIM_LARGEST_FORCE]);
    find_acting(p);
    for (p->point = 0; p->point < source->points; p->point++) {
        const Junction *at = &p->now[p->point];
        check_lines(p, at);
        check_water(p, at);
        check_contact(p, at);
        check_soft(p, at);
        check_set(p, at);
        check_friction(p, at);
        check_anchor(p, at);
        check_motion(p);
    }
}

/* Whether a line that ends at the point claims to be certified, other than by a proof that there
 * is nothing to find. */
static bool is_claimed(const Points *p, bool (*certified)(int outcome)) {
    for (size_t i = 0; i < p->source->lines; i++)
        for (int e = 0; e < 2; e++) {
            const int k = p->line[i].end_point[e];
            if (k == (int)p->point && !is_held(&p->now[k]) && certified(p->line[i].outcome) &&
                !groups_claim(&p->line[i]))
                return true;
        }
    return false;
}

static int check_steps(Points *p, bool (*certified)(int outcome), FILE *log) {
    const Source *source = p->source;
    for (p->step = 0; p->step < source->steps; p->step++) {
        int bad = junctions_read(source, p->step, p->now, log) ||
                  point_motions_read(source, p->step, p->motion, log) ||
                  water_read(source, p->step, p->water, log) ||
                  anchors_read(source, p->step, p->anchor, log) ||
                  point_sets_read(source, p->step, p->sets, log);
        for (size_t i = 0; i < source->lines && !bad; i++)
            bad = record_read(source, source->line_name[i], p->step, &p->line[i], log);
        if (!bad && p->bodies.count > 0)
            bad = bodies_read(source, &p->bodies, p->step, p->body, log) ||
                  body_motions_read(source, p->bodies.count, p->step, p->body_motion, log);
        if (bad) return -1;
        p->has_friction = !(source->has_static && p->step == 0);
        check_step(p);
        for (p->point = 0; p->point < source->points; p->point++) {
            p->certified = is_claimed(p, certified);
            check_balance(p, &p->now[p->point]);
        }
        for (size_t k = 0; k < source->points; k++)
            p->gives[k] = p->anchor[k].drags || (p->has_surface && p->water[k].displaced > 0);
        const GroupStep at = {source,   p->line,    p->now,  p->step > 0 ? p->before : NULL,
                              p->gives, &p->bodies, p->body, p->step,
                              p->find,  p->user};
        if (groups_check(&at, log)) return -1;
        Junction *swap = p->older;
        PointMotion *swap_motion = p->motion_older;
        Afloat *swap_afloat = p->afloat_before;
        p->afloat_before = p->afloat;
        p->afloat = swap_afloat;
        p->older = p->before;
        p->before = p->now;
        p->now = swap;
        p->motion_older = p->motion_before;
        p->motion_before = p->motion;
        p->motion = swap_motion;
        double *swap_rate = p->rate_before;
        p->rate_before = p->rate;
        p->rate = swap_rate;
    }
    return 0;
}

/* The lines of the file, and the longest one at each point. */
static int open_lines(Points *p, FILE *log) {
    for (size_t i = 0; i < p->source->lines; i++) {
        Record *r = &p->line[i];
        double length = 0;
        if (record_create(p->source, p->source->line_name[i], r, log)) return -1;
        for (size_t k = 0; k < r->elements; k++) length += r->element_length[k];
        for (int e = 0; e < 2; e++)
            if (r->end_point[e] >= 0)
                p->length[r->end_point[e]] = fmax(p->length[r->end_point[e]], length);
    }
    return 0;
}

/* The bodies, or none where they cannot be read: bodies_check says why. */
static int open_bodies(const Source *source, Bodies *bodies) {
    if (bodies_open(source, bodies, NULL)) {
        bodies_close(bodies);
        *bodies = (Bodies){0};
    }
    return 0;
}

int points_check(const Source *source, bool (*certified)(int outcome), PointFinding *finding,
                 void *user, FILE *log) {
    if (source->points == 0) return 0;
    Points p = {.source = source, .find = finding, .user = user};
    p.line = calloc(source->lines, sizeof *p.line);
    p.now = calloc(source->points, sizeof *p.now);
    p.before = calloc(source->points, sizeof *p.before);
    p.older = calloc(source->points, sizeof *p.older);
    p.rate = calloc(source->points, sizeof *p.rate);
    p.rate_before = calloc(source->points, sizeof *p.rate_before);
    p.motion = calloc(source->points, sizeof *p.motion);
    p.motion_before = calloc(source->points, sizeof *p.motion_before);
    p.motion_older = calloc(source->points, sizeof *p.motion_older);
    p.length = calloc(source->points, sizeof *p.length);
    p.water = calloc(source->points, sizeof *p.water);
    p.anchor = calloc(source->points, sizeof *p.anchor);
    p.dragged = calloc(source->points, sizeof *p.dragged);
    p.area = calloc(source->points, sizeof *p.area);
    p.has_surface = water_surface(source, &p.surface);
    p.afloat = calloc(source->points, sizeof *p.afloat);
    p.afloat_before = calloc(source->points, sizeof *p.afloat_before);
    p.height = calloc(source->points, sizeof *p.height);
    int bad = !p.line || !p.water || !p.rate || !p.rate_before || !p.now || !p.before || !p.older ||
                      !p.motion || !p.motion_before || !p.motion_older || !p.length
                  ? -1
                  : open_lines(&p, log);
    if (!bad) bad = !p.anchor || !p.dragged ? -1 : anchors_open(source, p.anchor, log);
    if (!bad) bad = !p.area ? -1 : soft_areas_read(source, p.area, log);
    if (!bad) bad = !p.afloat || !p.afloat_before || !p.height ? -1 : 0;
    if (!bad) bad = water_heights(source, p.height, log) || sea_read(source, &p.sea, log) ? -1 : 0;
    p.gives = calloc(source->points, sizeof *p.gives);
    if (!bad) bad = p.gives ? open_bodies(source, &p.bodies) : -1;
    int unread;
    p.sets = point_sets_open(source, &unread, log);
    if (unread) bad = -1;
    p.body = calloc(p.bodies.count + 1, sizeof *p.body);
    p.body_motion = calloc(p.bodies.count + 1, sizeof *p.body_motion);
    if (!bad) bad = p.body && p.body_motion ? check_steps(&p, certified, log) : -1;
    bodies_close(&p.bodies);
    free(p.body);
    free(p.body_motion);
    free(p.gives);
    for (size_t i = 0; i < source->lines && p.line; i++) record_destroy(&p.line[i]);
    free(p.line);
    free(p.now);
    free(p.before);
    free(p.older);
    free(p.rate);
    free(p.rate_before);
    free(p.motion);
    free(p.motion_before);
    free(p.motion_older);
    free(p.length);
    free(p.water);
    free(p.anchor);
    free(p.dragged);
    free(p.area);
    free(p.afloat);
    free(p.afloat_before);
    free(p.height);
    sea_free(&p.sea);
    point_sets_free(p.sets);
    return bad;
}
