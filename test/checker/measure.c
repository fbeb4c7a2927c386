/* SPDX-License-Identifier: BSD-3-Clause */
/* Arithmetic of the checker: long double, compensated sums, no quantity formed as a difference of
 * large ones.
 *
 * With e the stretch vector of an element (x_i - x_{i-1}) / l, d = (|e| - 1)^+ and W*(p) = |p| + c
 * |p|^2 / 2, the local gaps are sums of non-negative terms (docs/theory.md):
 *
 *     segment, c > 0   W(e) + W*(p) - p.e = (d - c|p|)^2 / (2 c) + |p| (1 - |e|)^+ + |p||e| - p.e
 *     segment, c = 0   |p| (1 - |e|) + |p||e| - p.e
 *     friction         phi(s) + F.s, s the slip on the obstacle (surface.c)
 *     contact          R (n.u + gap)
 *
 * where |a||b| - a.b = |a||b| |a/|a| - b/|b||^2 / 2. Normals, slips and the axes of friction are
 * recomputed from positions, at the configuration reached or at the reference. Absolute values are
 * added, so that a configuration or a force slightly outside its set makes the gap larger and never
 * smaller. */
#include "measure.h"

#include "carried.h"
#include "elongation.h"
#include "grasps.h"
#include "loads.h"
#include "missing.h"
#include "seen.h"
#include "sets.h"
#include "shape.h"

#include "fall.h"
#include "inertia.h"
#include "soft.h"

#include <math.h>

typedef Real Triple[3];

/* Neumaier's compensated sum */
typedef struct Sum {
    Real value, rest;
} Sum;

static void add(Sum *sum, Real term) {
    Real total = sum->value + term;
    sum->rest += fabsl(sum->value) >= fabsl(term) ? (sum->value - total) + term
                                                  : (term - total) + sum->value;
    sum->value = total;
}

static Real total(const Sum *sum) { return sum->value + sum->rest; }

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real size(const Real *a) { return sqrtl(dot(a, a)); }
static void widen(const double *a, Triple out) {
    for (int k = 0; k < 3; k++) out[k] = (Real)a[k];
}
static void subtract(const double *a, const double *b, Triple out) {
    for (int k = 0; k < 3; k++) out[k] = (Real)a[k] - (Real)b[k];
}

/* Obstacles are equally near to a node within this part of the line's length. */
static const Real PLACE_MARGIN = 1e-9L;

/* [rad] of a turn */
static const Real QUARTER = 1.57079632679489661923L;
/* [rad] So near to half a turn rounding of places takes more than the tolerance of a slip's
 * direction. */
static const Real HALF_ROUND = 1e-2L;
/* The same at this share of the radius from the middle. */
static const Real MIDDLE = 1e-2L;

/* maximum that keeps a NaN */
static void raise_to(double *worst, Real value) {
    if (!((double)value <= *worst)) *worst = (double)value;
}

/* |a||b| - a.b without cancellation */
static Real misalignment(const Real *a, const Real *b) {
    Real la = size(a), lb = size(b);
    if (la == 0 || lb == 0) return 0;
    Triple difference;
    for (int k = 0; k < 3; k++) difference[k] = a[k] / la - b[k] / lb;
    return la * lb * dot(difference, difference) / 2;
}

/* running sums of a record */
typedef struct Sums {
    Sum primal, dual, signed_gap, gap, scale, work, moment, loads, slid, law, contact,
        bound_residual, imbalance_work, magnitude, length, elastic, gravity, carried;
} Sums;

static bool held(const Record *r, size_t j) { return node_is_held(r, j); }

static void measure_segment(const Record *r, size_t i, Measures *m, Sums *s) {
    Real l = r->element_length[i], c = r->element_compliance[i], T = r->tension[i];
    Triple p, e;
    widen(r->segment_force[i], p);
    subtract(r->position[i + 1], r->position[i], e);
    for (int k = 0; k < 3; k++) e[k] /= l;
    const Real rest = elongation_rest(r, i), limit = 1 + rest; /* taut above it */
    Real force = size(p), stretch = size(e), strain = stretch > limit ? stretch - 1 : rest;

    // energy, conjugate and local gap
    Real own = c > 0 ? elongation_strain(r, i, force) : 0, at_own = 0, energy = 0, mismatch = 0;
    if (c > 0) {
        energy = elongation_energy(r, i, strain);
        at_own = elongation_energy(r, i, own);
        mismatch = elongation_mismatch(r, i, strain, force);
    }
    Real slack = c > 0 && stretch > limit ? 0 : force * (limit - stretch),
         turn = misalignment(p, e);
    add(&s->length, l);
    Triple before;
    subtract(r->reference[i + 1], r->reference[i], before);
    Real strained = size(before) / l > limit ? size(before) / l - 1 : rest;
    add(&s->elastic, l * energy - (c > 0 ? l * elongation_energy(r, i, strained) : 0));
    add(&s->primal, l * energy);
    add(&s->dual, -l * (force + force * own - at_own));
    add(&s->signed_gap, l * (mismatch + slack + turn));
    add(&s->gap, l * (mismatch + fabsl(slack) + turn));
    add(&s->scale, l * (force + own * force));
    add(&s->magnitude, l * (energy + force + own * force));

    // residuals
    if (c == 0) raise_to(&m->stretch, stretch - 1);
    if (slack < 0) m->overlong -= (double)(l * slack);
    // coordinates are doubles: their last bits over l are no strain
    Triple here, there;
    widen(r->position[i], here);
    widen(r->position[i + 1], there);
    Real at_tension = c > 0 && T > 0 ? elongation_strain(r, i, T) : rest + c * T;
    const Real rounding = 2 * 0x1p-53L * (size(here) + size(there)) / l;
    raise_to(&m->strain_rounding, rounding);
    raise_to(&m->strain_error, stretch - 1 - at_tension - rounding);
    if (stretch > 0) raise_to(&m->push, -dot(p, e) / stretch);
    if (c > 0) raise_to(&m->elongation, (stretch - 1 - own) / limit); /* of its length at rest */
    raise_to(&m->tension_estimate, fabsl(T - force));
    raise_to(&m->largest_force, force);
    raise_to(&m->tension_least, -T);
}

/* What a contact sees of its obstacle. */
typedef struct Seat {
    const Surface *surface; /* NULL without any */
    Triple normal, plane;   /* of the contact, and of the plane in which friction acts */
    Triple slip, own;       /* own: the node's path, not less that of an obstacle that turns */
    Real gap;               /* what contact_gap must be */
    Real axes[2][3];
    bool has_axes;
} Seat;

/* Is one way along the surface from `a` to b shorter than all others? Half round none is, nor from
 * the middle of a round obstacle. Where no friction acts none is asked for. */
static bool has_way(const Surface *surface, const Real *a, const Real *b) {
    if (surface_is_round(surface) && surface_distance(surface, a) <= (MIDDLE - 1) * surface->radius)
        return false;
    return surface_angle(surface, a, b) <= 2 * QUARTER - HALF_ROUND;
}

/* [rad] By which the obstacle of contact c of node j turns about its own axis; it has one. */
static Real turn_of(const Where *where, const Record *r, size_t j, size_t c) {
    return (Real)r->turn[seen_surface(where, r, j, c) - where->source->surface];
}

/* What contact c of node j sees of its obstacle; *seen is that obstacle as it sees it. */
static Seat seat_of(const Where *where, const Record *r, size_t j, size_t c, Surface *seen) {
    const Surface *on = seen_surface(where, r, j, c);
    *seen = seen_by(where, r, j, c);
    Seat seat = {.surface = on ? seen : NULL, .gap = INFINITY};
    if (!seat.surface) return seat;
    Triple x, reference, place, carried, u, along;
    Vector *nodes =
        where->frozen ? r->reference : where->place; /* whose direction friction takes */
    widen(r->position[j], x);
    widen(r->reference[j], reference);
    seen_from(where, r, j, place);
    subtract(r->position[j], r->reference[j], u);
    surface_normal(seat.surface, place, seat.normal);
    surface_normal(seat.surface, where->frozen ? reference : place, seat.plane);
    const Real turn = turn_of(where, r, j, c);
    const bool moves = turn != 0 || surface_moves(seat.surface);
    carried_point(r, seat.surface, turn, true, j, 0, carried);
    const Surface at = soft_level(seat.surface, x);
    if (moves) surface_own(&at, x, reference, r->share, seat.own);
    if (where->reached && !where->frozen) {
        if (r->friction_bound[c] > 0 || has_way(seat.surface, carried, x))
            surface_slip(&at, carried, x, seat.slip);
    } else {
        Triple displacement = {x[0] - carried[0], x[1] - carried[1], x[2] - carried[2]};
        Real rise = dot(displacement, seat.plane);
        for (int k = 0; k < 3; k++) seat.slip[k] = displacement[k] - rise * seat.plane[k];
    }
    seat.gap = where->reached ? surface_distance(seat.surface, x) - dot(seat.normal, u)
                              : surface_distance(seat.surface, reference);
    /* the reference of a step in time may lie below, no other does but for rounding */
    if (!where->reached && !in_time(r) && !(seat.surface->gives > 0)) seat.gap = fmaxl(0, seat.gap);
    if (!moves)
        for (int k = 0; k < 3; k++) seat.own[k] = seat.slip[k];
    subtract(nodes[j < r->elements ? j + 1 : j], nodes[j > 0 ? j - 1 : j], along);
    seat.has_axes = surface_axes(seat.surface, seat.plane, along, seat.axes);
    return seat;
}

/* [m] Of a node at x that hangs inside of a sphere, cylinder, capsule or cone: how far from its
 * middle, where no wall is nearest. Infinite of others. */
static Real off_middle(const Surface *on, const Real *x) {
    if (!on || !on->inside || on->kind == SURFACE_TORUS || on->kind == SURFACE_BOX) return INFINITY;
    Triple arm;
    for (int k = 0; k < 3; k++) arm[k] = x[k] - on->point[k];
    const Real along = on->kind == SURFACE_SPHERE ? 0 : dot(arm, on->axis);
    for (int k = 0; k < 3; k++) arm[k] -= along * on->axis[k];
    return size(arm);
}

/* By how much more than places normals are off by rounding: on ground slopes may change within a
 * cell. */
static Real turning(const Where *where, const Surface *on, const Real *x) {
    if (!on || on->kind == SURFACE_PLANE) return 0;
    return where->reach /
           (on->ground ? ground_spacing(on->ground) : fminl(on->radius, off_middle(on, x)));
}

/* normal, slip and gap on file against those recomputed, and depth below whatever obstacle */
static void measure_seat(const Where *where, const Record *r, size_t j, size_t c, const Seat *seat,
                         Real margin, Measures *m) {
    Triple n, slip, x;
    widen(r->normal[c], n);
    widen(r->slip[c], slip);
    widen(r->position[j], x);
    r->mu[c] = seat->surface
                   ? (r->factor ? r->factor[j] : 1) * (double)surface_friction(seat->surface) *
                         (double)surface_factor(seat->surface, x)
                   : 0;
    for (int k = 0; k < 3; k++) {
        n[k] -= seat->normal[k];
        slip[k] -= seat->slip[k];
    }
    bool round = seat->surface && surface_is_round(seat->surface);
    raise_to(&m->normal_error, size(n) / (1 + turning(where, seat->surface, x)));
    // the slip of what hangs is that of its foot
    const Real hangs =
        seat->surface && seat->surface->inside
            ? fmaxl(0, surface_distance(seat->surface, x)) / off_middle(seat->surface, x)
            : 0;
    raise_to(&m->slip_error, size(slip) / (1 + hangs));
    if (c == j)
        for (size_t k = 0; k < where->source->surfaces; k++) {
            Real depth = -surface_distance(&where->source->surface[k], x);
            if (where->source->surface[k].gives > 0) {
                if (depth > margin && !soft_bears(r, j, k)) m->misplaced++;
                continue;
            }
            raise_to(&m->depth, depth);
            if (surface_ends(&where->source->surface[k], x, PLACE_MARGIN * where->reach))
                m->misplaced++;
            if (!held(r, j)) raise_to(&m->sunk, depth);
        }
    if (held(r, j) || !seat->surface) return;
    // frozen friction acts on what has left the surface as well, in the plane of the reference
    const bool acts = r->friction_bound[c] > 0 && !(where->frozen && r->reaction[c] == 0);
    Triple shifted;
    carried_point(r, seat->surface, turn_of(where, r, j, c), false, j, 0, shifted);
    if (acts) raise_to(&m->gone_quarters, surface_angle(seat->surface, shifted, x) / QUARTER);
    if (r->contacts > 1 && !seen_in_place(where, r, j, c, margin)) m->misplaced++;
    // a second obstacle that is round is looked for up to half its radius away
    Triple place, reference;
    widen(where->place[j], place);
    widen(r->reference[j], reference);
    bool far = c != j && round &&
               surface_distance(seat->surface, place) > (0.5L - 1e-9L) * seat->surface->radius;
    if (isfinite(r->gap[c])) raise_to(&m->gap_error, fabsl((Real)r->gap[c] - seat->gap));
    if (!where->source->touching_only) {
        m->unwatched += !isfinite(r->gap[c]) && !far;
        return;
    }
    // contact of the reference: what it touches, neither more nor less, but for rounding
    Real apart = fabsl(surface_distance(seat->surface, reference)),
         rounding = 4 * 0x1p-53L * where->reach;
    if (isfinite(r->gap[c]) ? apart > margin + rounding : apart < margin - rounding) m->unwatched++;
}

/* friction of a contact, in the axes of its obstacle */
static void measure_friction(const Record *r, size_t c, const Seat *seat, Measures *m, Sums *s) {
    static const Surface none = {.mu = {1, 1}};
    Triple F;
    widen(r->friction[c], F);
    Real w = r->friction_bound[c], force[2] = {0, 0}, displacement[2] = {0, 0}, phi;
    const Surface *surface = seat->surface ? seat->surface : &none;
    if (seat->has_axes)
        for (int a = 0; a < 2; a++) {
            force[a] = dot(F, seat->axes[a]);
            displacement[a] = dot(seat->slip, seat->axes[a]);
        }
    else { /* no direction: nothing but the size can be judged */
        if (surface->set) w *= surface->set->reach;
        surface = &none;
        force[0] = size(F);
        displacement[0] = force[0] > 0 ? dot(seat->slip, F) / force[0] : 0;
    }
    Real gap = surface_gap(surface, w, force, displacement, &phi);
    add(&s->primal, phi);
    add(&s->scale, phi);
    add(&s->slid, phi);
    add(&s->signed_gap, phi);
    add(&s->signed_gap, dot(F, seat->slip));
    add(&s->gap, gap);
    add(&s->law, gap);
    if (surface->set)
        m->beyond +=
            fmax(0, -(double)(phi + force[0] * displacement[0] + force[1] * displacement[1]));
    add(&s->bound_residual, fabsl(r->friction_bound[c] - (Real)r->mu[c] * r->reaction[c]));
    add(&s->magnitude, phi + size(F) * size(seat->slip));
    add(&s->carried, dot(F, seat->own) - dot(F, seat->slip));
    raise_to(&m->friction_excess, surface_excess(surface, w, force));
    raise_to(&m->friction_normal, fabsl(dot(F, seat->plane)));
    raise_to(&m->largest_force, size(F));
}

/* contact c of node j and its friction; `pull` gathers the forces on the node */
static void measure_contact(const Where *where, const Record *r, size_t j, size_t c, Triple pull,
                            Measures *m, Sums *s) {
    Triple n, F, u, x, reference;
    widen(r->normal[c], n);
    widen(r->friction[c], F);
    widen(r->reference[j], reference);
    widen(r->position[j], x);
    subtract(r->position[j], r->reference[j], u);
    Real R = r->reaction[c], gap = r->gap[c], force = size(F), has_normal = size(n);
    bool active = !held(r, j);
    Surface seen;
    const Seat seat = seat_of(where, r, j, c, &seen);
    measure_seat(where, r, j, c, &seat, PLACE_MARGIN * total(&s->length), m);
    if (R < m->reaction_least) m->reaction_least = (double)R;
    // at a held end the obstacle may share the load with the support, which needs no friction
    if (has_normal == 0) raise_to(&m->stray_force, fabsl(R));
    if (has_normal == 0 || !active) raise_to(&m->stray_force, force);
    if (!active) return;

    for (int k = 0; k < 3; k++) pull[k] += F[k] + R * n[k];
    measure_friction(r, c, &seat, m, s);
    Triple start = {x[0] - seat.slip[0], x[1] - seat.slip[1], x[2] - seat.slip[2]};
    add(&s->dual, dot(F, start) + R * dot(n, reference));
    add(&s->magnitude, force * size(x) + R * size(reference));
    raise_to(&m->largest_force, R);

    // contact
    if (isinf(gap)) {
        raise_to(&m->stray_force, fabsl(R));
        return;
    }
    Real distance = dot(n, u) + gap;
    add(&s->dual, -R * gap);
    add(&s->magnitude, fabsl(R * gap));
    if (seat.surface && seat.surface->gives > 0) {
        const Soft soft = soft_spring(r, seat.surface, j, n, gap, distance, R);
        add(&s->dual, -R * soft.begins);
        add(&s->primal, soft.energy);
        add(&s->scale, soft.energy);
        add(&s->dual, -soft.conjugate);
        add(&s->signed_gap, soft.gap);
        add(&s->gap, soft.gap);
        add(&s->contact, soft.gap);
        add(&s->magnitude, soft.energy + soft.conjugate);
        return;
    }
    raise_to(&m->penetration, -distance);
    add(&s->signed_gap, R * distance);
    add(&s->gap, fabsl(R * distance));
    add(&s->contact, fabsl(R * distance));
}

/* the point of element i at the share t of its way */
static void point_of(Vector *place, size_t i, Real t, Triple out) {
    for (int k = 0; k < 3; k++) out[k] = (1 - t) * place[i][k] + t * place[i + 1][k];
}

void measure_element_plane(const Record *r, const Surface *on, size_t i, bool frozen, Real t,
                           const Real *x, Real *plane, Real *along) {
    Vector *nodes = frozen ? r->reference : r->position;
    Triple a, b, from;
    subtract(nodes[i + 1], nodes[i], along);
    widen(nodes[i], a);
    widen(nodes[i + 1], b);
    const Real facing = surface_may_be_third(on) ? t : surface_facing(on, a, b);
    point_of(nodes, i, facing > 0 && facing < 1 ? facing : t, from);
    surface_normal(on, frozen ? from : x, plane);
}

/* Is the straight way from a to b nearest to a shape at the share t? Beside a face or an edge it is
 * so at more than one place. */
static bool is_nearest(const Surface *on, const Real *a, const Real *b, Real t, Real reach) {
    Triple x, y;
    if (!shape_is(on)) return false;
    const Real facing = surface_facing(on, a, b);
    for (int k = 0; k < 3; k++) {
        x[k] = (1 - t) * a[k] + t * b[k];
        y[k] = (1 - facing) * a[k] + facing * b[k];
    }
    const Real ends = fminl(surface_distance(on, a), surface_distance(on, b)),
               least = facing > 0 && facing < 1 ? surface_distance(on, y) : ends;
    return t > 0 && t < 1 && surface_distance(on, x) <= least + 1e-15L * reach;
}

/* What the point x of element i at the share t, with its reference, sees of surface `on`, in which
 * it may lie by `depth`, and which turns about its axis. */
static Seat element_seat(const Where *where, const Record *r, const Surface *on, Real turn,
                         size_t i, Real t, const Real *x, const Real *reference, Real depth) {
    const bool acts = r->friction_bound[r->contacts * r->nodes + i] > 0;
    Seat seat = {.surface = on};
    Triple carried, u, along;
    for (int k = 0; k < 3; k++) u[k] = x[k] - reference[k];
    surface_normal(on, x, seat.normal);
    measure_element_plane(r, on, i, where->frozen, t, x, seat.plane, along);
    carried_point(r, on, turn, true, i, t, carried);
    // the point goes round at its own depth: what friction works on is shorter than the path of its
    // foot
    const Surface within = surface_within(on, depth);
    if (where->frozen || acts || has_way(on, carried, x))
        surface_slip(&within, carried, x, seat.slip);
    if (where->frozen) { // straight, in the plane of the reference
        for (int k = 0; k < 3; k++) seat.slip[k] = x[k] - carried[k];
        const Real rise = dot(seat.slip, seat.plane);
        for (int k = 0; k < 3; k++) seat.slip[k] -= rise * seat.plane[k];
    }
    surface_own(&within, x, reference, r->share, seat.own);
    if (turn == 0 && !surface_moves(on))
        for (int k = 0; k < 3; k++) seat.own[k] = seat.slip[k];
    seat.gap = surface_distance(on, x) + depth - dot(seat.normal, u);
    seat.has_axes = surface_axes(on, seat.plane, along, seat.axes);
    return seat;
}

/* Are two contacts with one obstacle and, of a mesh, on one face of it? */
static bool is_same_contact(const Record *r, bool on_mesh, size_t a, size_t b) {
    Real off = 0;
    if (r->obstacle[a] != r->obstacle[b]) return false;
    if (!on_mesh) return true;
    for (int k = 0; k < 3; k++) off += fabsl((Real)r->normal[a][k] - r->normal[b][k]);
    return off < 1e-8L;
}

/* Contact of element i: the laws of a node's contact, for its point. */
static void measure_element_contact(const Where *where, const Record *r, size_t i, Measures *m,
                                    Sums *s) {
    const size_t c = r->contacts * r->nodes + i;
    if (!r->has_elements) return;
    r->mu[c] = 0;
    if (r->obstacle[c] < 0) {
        Triple none;
        widen(r->friction[c], none);
        raise_to(&m->stray_force, fabsl(r->reaction[c]) + size(none) + fabsl(r->friction_bound[c]));
        return;
    }
    const size_t on_file = (size_t)r->obstacle[c];
    const Surface seen = surface_seen(&where->source->surface[on_file], r->normal[c]), *on = &seen;
    const Real t = r->share_of[i], R = r->reaction[c], gap = r->gap[c];
    Triple x, reference, along, a, b, n, F, slip, start;
    point_of(r->position, i, t, x);
    point_of(r->reference, i, t, reference);
    widen(r->position[i], a);
    widen(r->position[i + 1], b);
    subtract(r->position[i + 1], r->position[i], along);
    widen(r->normal[c], n);
    widen(r->friction[c], F);
    widen(r->slip[c], slip);
    // a plane, or a face of a mesh, is touched by the node at the end of the element, beside two
    // other obstacles or faces
    const bool third = surface_may_be_third(on);
    const Seat seat = element_seat(where, r, on, (Real)r->turn[on_file], i, t, x, reference,
                                   third ? 0 : surface_allowance(on, r->element_length[i]));
    const Real factor = r->factor ? (1 - t) * r->factor[i] + t * r->factor[i + 1] : 1;
    r->mu[c] = (double)(factor * surface_friction(on));
    // where it is, against what it says
    if (third && (r->contacts < 2 || held(r, i + 1) || is_same_contact(r, on->mesh, i + 1, c) ||
                  is_same_contact(r, on->mesh, r->nodes + i + 1, c)))
        m->misplaced++;
    // frozen friction acts on what has left the surface as well, where it last was
    const Real facing = third ? 1 : surface_facing(on, a, b);
    const bool left = where->frozen && R == 0;
    if (third || !left || (facing > 0 && facing < 1))
        raise_to(&m->share_error,
                 is_nearest(on, a, b, t, where->reach) ? 0 : fabsl(facing - t) * size(along));
    for (int k = 0; k < 3; k++) {
        n[k] -= seat.normal[k];
        slip[k] -= seat.slip[k];
        start[k] = x[k] - seat.slip[k];
    }
    raise_to(&m->normal_error,
             size(n) / (1 + (on->kind == SURFACE_PLANE ? 0 : where->reach / on->radius)));
    raise_to(&m->slip_error, size(slip));
    Triple shifted;
    carried_point(r, on, (Real)r->turn[on_file], false, i, t, shifted);
    if (r->friction_bound[c] > 0 && !left)
        raise_to(&m->gone_quarters, surface_angle(on, shifted, x) / QUARTER);
    if (isfinite(r->gap[c])) raise_to(&m->gap_error, fabsl(gap - seat.gap));
    // what it does
    widen(r->normal[c], n);
    if (R < m->reaction_least) m->reaction_least = (double)R;
    measure_friction(r, c, &seat, m, s);
    add(&s->dual, dot(F, start) + R * dot(n, reference));
    add(&s->magnitude, size(F) * size(x) + R * size(reference));
    raise_to(&m->largest_force, R);
    if (isinf(gap)) {
        raise_to(&m->stray_force, fabsl(R));
        return;
    }
    Real distance = gap + dot(n, x) - dot(n, reference);
    raise_to(&m->penetration, -distance);
    add(&s->signed_gap, R * distance);
    add(&s->gap, fabsl(R * distance));
    add(&s->contact, fabsl(R * distance));
    add(&s->dual, -R * gap);
    add(&s->magnitude, fabsl(R * gap));
}

/* the weight of a node, its load less the force on a free end, times its displacement */
static void measure_weight(const Record *r, size_t j, Sums *s) {
    Triple weight, u;
    widen(r->load[j], weight);
    subtract(r->position[j], r->reference[j], u);
    for (int e = 0; e < 2; e++)
        if (j == (e ? r->elements : 0) && r->end_kind[e] == END_FREE)
            for (int k = 0; k < 3; k++) weight[k] -= r->applied_force[e][k];
    node_load(r, j, weight);
    // where gravity changes the weight works with the mean of what it was and what it is, but
    // where all works are those of forces after the step
    const Real half = ((j > 0 ? (Real)r->element_length[j - 1] : 0) +
                       (j < r->elements ? (Real)r->element_length[j] : 0)) /
                      2,
               share = r->weight_length ? r->weight_length[j] : half;
    if (r->has_weight_before && !r->settles)
        for (int k = 0; k < 3; k++) weight[k] = (weight[k] + share * r->weight_before[k]) / 2;
    add(&s->gravity, -dot(weight, u));
}

static void measure_inertia(const Record *r, size_t j, Real *pull, Measures *m, Sums *s) {
    Triple x, u, arm;
    Inertia own;
    if (!inertia_terms(r, j, held(r, j), pull, &own)) return;
    widen(r->position[j], x);
    subtract(r->position[j], r->reference[j], u);
    subtract(r->position[j], r->position[0], arm);
    add(&s->primal, own.energy);
    add(&s->dual, own.energy - own.gap + dot(own.taken, x));
    add(&s->gap, own.gap);
    add(&s->signed_gap, own.gap);
    add(&s->work, fabsl(dot(own.force, u)));
    add(&s->moment, size(own.force) * size(arm));
    add(&s->loads, size(own.force));
    add(&s->magnitude, own.energy + size(own.force) * size(x));
    raise_to(&m->largest_force, size(own.taken));
}

/* The springs of a node: their energy, the dual's, and the gap between. */
static void measure_spring(const Spring *spring, const Real *arm, const Real *u, Sums *s) {
    add(&s->primal, spring->energy);
    add(&s->dual, spring->dual);
    add(&s->signed_gap, spring->gap);
    add(&s->gap, spring->gap);
    add(&s->work, fabsl(dot(spring->force, u)));
    add(&s->moment, size(spring->force) * size(arm));
    add(&s->loads, size(spring->force));
    add(&s->magnitude, spring->energy + fabsl(spring->dual));
}

/* The set that holds an end: its gap, and the dual's part, minus the support at minus its force. */
static void measure_set(const Record *r, size_t j, const Real *x, Real *p, Measures *m, Sums *s) {
    Triple f = {0, 0, 0};
    const Real force = sets_add(r, j, f), gap = sets_gap(r, j);
    sets_add(r, j, p);
    add(&s->gap, fabsl(gap)); // below 0 by rounding: sets_check
    add(&s->signed_gap, gap);
    add(&s->dual, dot(f, x) - gap);
    add(&s->magnitude, force * size(x));
    raise_to(&m->largest_force, force);
}

/* What the loads b of a node add to sizes. In motion its weight and the water's forces, which may
 * be equal and opposite, count by themselves. */
static void measure_load(const Record *r, size_t j, const Real *b, const Real *u, const Real *arm,
                         Measures *m, Sums *s) {
    Triple part[2] = {{b[0], b[1], b[2]}, {0, 0, 0}};
    const bool swims = in_time(r) && r->loads && r->loads->has_drag;
    if (swims) widen(r->loads->given[j], part[1]);
    for (int k = 0; k < 3; k++) part[0][k] -= part[1][k];
    for (int i = 0; i < 2; i++) {
        add(&s->work, fabsl(dot(part[i], u)));
        add(&s->moment, size(part[i]) * size(arm));
        add(&s->loads, size(part[i]));
    }
    raise_to(&m->largest_force, size(b));
    raise_to(&m->largest_force, size(part[1]));
}

static void measure_node(const Where *where, const Record *r, size_t j, Measures *m, Sums *s) {
    Triple b, x, arm, pull, u;
    measure_weight(r, j, s);
    if (!held(r, j)) add(&s->elastic, soft_growth(where->source, r, j, r->reference[j], r->share));
    widen(r->load[j], b);
    widen(r->load[j], pull);
    widen(r->position[j], x);
    subtract(r->position[j], r->position[0], arm);
    subtract(r->position[j], r->reference[j], u);
    for (int k = 0; k < 3; k++) {
        if (j < r->elements) pull[k] += r->segment_force[j][k];
        if (j > 0) pull[k] -= r->segment_force[j - 1][k];
        raise_to(&m->extent, fabsl(x[k]));
    }
    add(&s->primal, -dot(b, x));
    measure_load(r, j, b, u, arm, m, s);
    add(&s->magnitude, size(b) * size(x) + size(pull) * size(x));
    for (size_t c = j; c < r->contacts * r->nodes; c += r->nodes)
        measure_contact(where, r, j, c, pull, m, s);
    loads_add_others(r, j, pull);
    const Spring spring = loads_spring(r, j);
    measure_spring(&spring, arm, u, s);
    raise_to(&m->largest_force, size(spring.force));
    measure_inertia(r, j, pull, m, s);
    measure_set(r, j, x, pull, m, s);

    // a held node: the dual pairs the force of the support with the imposed position; a free one
    // must balance
    if (held(r, j)) {
        Triple imposed, off;
        widen(node_place(r, j), imposed);
        subtract(r->position[j], node_place(r, j), off);
        raise_to(&m->held_error, size(off));
        add(&s->dual, -dot(pull, imposed));
        add(&s->imbalance_work, dot(pull, off));
    } else {
        raise_to(&m->force, size(pull));
        add(&s->imbalance_work, dot(pull, x));
    }
}

/* What proves that nothing can balance: the fall of the energy along a rigid motion v, sum b.v -
 * sum w |v_T|, which must not lead into the obstacle. Where bounds follow the reactions, these
 * carry the normal part of the loads and sum w is at most the largest mu times it. */
static void measure_proof(const Source *source, const Record *r, Measures *m) {
    m->rigid_fall = NAN;
    m->rigid_rise_least = INFINITY;
    Triple v, b;
    widen(r->proof, v);
    if (size(v) == 0) return;
    Sum fall = {0, 0}, press = {0, 0};
    Real across = 0, steepest = 0;
    for (size_t j = 0; j < r->nodes; j++) {
        Triple n, tangential;
        widen(r->load[j], b);
        add(&fall, dot(b, v));
        for (size_t c = j; c < r->contacts * r->nodes; c += r->nodes) {
            widen(r->normal[c], n);
            Real rise = dot(n, v);
            for (int k = 0; k < 3; k++) tangential[k] = v[k] - rise * n[k];
            if (!source->consistent) add(&fall, -(Real)r->friction_bound[c] * size(tangential));
            if (c == j)
                add(&press,
                    -dot(b, n)); // reactions beside each other may exceed the load: no proof then
            steepest = fmaxl(steepest, c == j ? r->mu[c] : INFINITY);
            across = size(tangential);
            if (isfinite(r->gap[c]) && (double)rise < m->rigid_rise_least)
                m->rigid_rise_least = (double)rise;
        }
    }
    if (source->consistent) add(&fall, -steepest * fmaxl(0, total(&press)) * across);
    if (source->follows) { // nothing may be touched for ever, or nothing can hold the line
        Real taken;
        const bool leaves = falls_off_planes(source, r, v, &taken);
        m->meets = !leaves && !falls_clear(source, r, v);
        m->rigid_rise_least = INFINITY;
        fall = (Sum){0, 0};
        for (size_t j = 0; j < r->nodes; j++) {
            widen(r->load[j], b);
            add(&fall, dot(b, v));
        }
        if (leaves) add(&fall, -taken);
    }
    m->rigid_fall = (double)total(&fall);
}

/* largest coordinate of anything: what rounding of places goes with */
static Real reach_of(const Source *source, const Record *r) {
    Real reach = 0;
    for (size_t j = 0; j < r->nodes; j++)
        for (int k = 0; k < 3; k++)
            reach = fmaxl(reach,
                          fmaxl(fabsl((Real)r->position[j][k]), fabsl((Real)r->reference[j][k])));
    for (size_t k = 0; k < source->surfaces; k++)
        reach = fmaxl(reach, size(source->surface[k].point) + source->surface[k].radius);
    return reach;
}

/* elements that go through obstacles */
static void measure_pierced(const Source *source, const Record *r, Measures *m) {
    for (size_t i = 0; i < r->elements; i++) {
        Triple a, b;
        widen(r->position[i], a);
        widen(r->position[i + 1], b);
        for (size_t k = 0; k < source->surfaces; k++)
            if (!(source->surface[k].gives > 0))
                raise_to(&m->pierced,
                         surface_pierced(&source->surface[k], a, b, (Real)r->element_length[i]));
    }
}

Measures measure(const Source *source, const Record *r, Sight sight) {
    Measures m = {.missing = missing_variable(r), .stretch = -INFINITY, .strain_error = -INFINITY};
    m.friction_excess = m.tension_least = -INFINITY;
    Sums s = {0};
    const bool reached = sight != SIGHT_REFERENCE;
    const Where where = {source, reached ? r->position : r->reference, reached,
                         sight == SIGHT_FROZEN, reach_of(source, r)};
    for (size_t i = 0; i < r->elements; i++) measure_segment(r, i, &m, &s);
    for (size_t j = 0; j < r->nodes; j++) measure_node(&where, r, j, &m, &s);
    for (size_t k = 0; k < source->surfaces; k++)
        raise_to(&m.quarters, (Real)r->share *
                                  (fabsl((Real)r->turn[k]) + size(source->surface[k].spin)) /
                                  QUARTER);
    for (size_t i = 0; i < r->elements; i++) measure_element_contact(&where, r, i, &m, &s);
    measure_proof(source, r, &m);
    measure_pierced(source, r, &m);

    m.reach = (double)where.reach;
    m.length = (double)total(&s.length);
    m.primal = (double)total(&s.primal);
    m.dual = (double)total(&s.dual);
    m.gap = (double)total(&s.gap);
    // the loads' part of S: what they work in the step and a floor, but no more than their moments
    // about end A
    Real force = fmaxl((Real)m.largest_force, total(&s.loads));
    Real work = total(&s.work) + 1e-12L * force * total(&s.length) / (Real)source->tolerance;
    m.scale = (double)(total(&s.scale) + fminl(work, total(&s.moment)));
    m.slid = (double)total(&s.slid);
    m.law = (double)total(&s.law);
    m.contact = (double)total(&s.contact);
    m.elastic = (double)total(&s.elastic);
    m.gravity = (double)total(&s.gravity);
    m.loads = (double)loads_work(r);
    m.carried = (double)total(&s.carried);
    m.bound_residual = (double)total(&s.bound_residual);
    m.tension_least = -m.tension_least;

    /* primal - dual = sum of local gaps - sum over nodes of imbalance.x, an identity of the exact
     * record; what is left is rounding of 64-bit mantissas */
    Sum identity = s.primal;
    add(&identity, -s.dual.value);
    add(&identity, -s.dual.rest);
    add(&identity, -s.signed_gap.value);
    add(&identity, -s.signed_gap.rest);
    add(&identity, s.imbalance_work.value);
    add(&identity, s.imbalance_work.rest);
    m.identity = (double)total(&identity);
    m.identity_noise = (double)(1024 * 0x1p-63L * total(&s.magnitude));
    m.bend = bend_of_record(source, r, sight == SIGHT_REACHED, m.largest_force);
    m.tension_bound = r->compliance > 0 ? sqrt(2 * m.gap / (r->least_compliance * m.length)) : NAN;
    return m;
}
