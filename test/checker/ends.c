/* SPDX-License-Identifier: BSD-3-Clause */
/* The line's force at an end (ends.h).
 *
 * The element beside an end pulls with p, the force in its middle. Between there and the end lies
 * half an element of length h/2, which has its weight and, where a held end lies on an obstacle, a
 * reaction R n and friction F. All of it is in balance with the support's force f:
 *
 *     f + (pull) + weight + R n + F = 0,        R = what presses on the obstacle
 *
 * F is not an unknown of the step. Friction per length is that of the node beside the end, whose
 * own share of the line is half of both its elements; it goes with the tangent plane and with the
 * zones of friction. It is no larger part of mu R than the neighbour's friction is of its bound,
 * and where the end is drawn along it does not push. */
#include "ends.h"

#include <math.h>

#include "carried.h"
#include "failure.h"
#include "inertia.h"
#include "loads.h"
#include "sets.h"

typedef Real Triple[3];

/* An end lies on an obstacle when it is as near as this per length; within a factor of two nobody
 * is held to it. */
static const Real TOUCH = 1e-9L;

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real size(const Real *a) { return sqrtl(dot(a, a)); }
static void widen(const double *a, Real *out) {
    for (int k = 0; k < 3; k++) out[k] = a[k];
}

/* v turned about the axis that takes the unit vector a to b (Rodrigues) */
static void turn_with(const Real *a, const Real *b, Real *v) {
    const Triple axis = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    const Real cosine = dot(a, b), along = dot(axis, v) / (1 + cosine);
    const Triple across = {axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2],
                           axis[0] * v[1] - axis[1] * v[0]};
    for (int k = 0; k < 3; k++) v[k] = cosine * v[k] + across[k] + along * axis[k];
}

/* [m] natural length of the line that a node stands for */
static Real share(const Record *r, size_t j) {
    Real both = j > 0 ? r->element_length[j - 1] : 0;
    return (both + (j < r->elements ? r->element_length[j] : 0)) / 2;
}

/* friction of the half element on obstacle k, with its normal n and the end's reaction */
static void set_friction(const Source *source, const Record *r, size_t j, size_t next, size_t k,
                         const Real *n, Real reaction, const Real *slip, Real *out) {
    Real length = 0;
    Triple here;
    widen(r->position[j], here);
    const Real end_factor = surface_factor(&source->surface[k], here);
    for (size_t i = 0; i < r->elements; i++) length += r->element_length[i];
    for (size_t c = next; c < r->contacts * r->nodes; c += r->nodes) {
        if ((size_t)r->obstacle[c] != k || !(r->friction_bound[c] > 0)) continue;
        const Real zone = r->factor ? r->factor[j] : 1, other = r->factor ? r->factor[next] : 1;
        Triple from, reference;
        widen(r->normal[c], from);
        widen(r->friction[c], out);
        widen(r->reference[next], reference);
        // frozen friction lies in the tangent plane of the reference
        if (!source->consistent) surface_normal(&source->surface[k], reference, from);
        turn_with(from, n, out);
        const Real per_length = share(r, j) / share(r, next) * zone / other;
        const Real of_bound = zone * surface_friction(&source->surface[k]) * end_factor * reaction /
                              r->friction_bound[c];
        const bool pushes = dot(out, slip) > 0 && size(slip) > TOUCH * length;
        for (int i = 0; i < 3; i++) out[i] *= pushes ? 0 : fminl(per_length, of_bound);
        return;
    }
}

/* a held end that lies on obstacle k; none: on nothing */
static End on_obstacle(const Source *source, const Record *r, int e, size_t k, bool none) {
    const size_t j = e ? r->elements : 0, next = e ? j - 1 : 1, element = e ? j - 1 : 0;
    End end = {.reaction = 0};
    for (int i = 0; i < 3; i++)
        end.force[i] = (e ? 1 : -1) * (Real)r->segment_force[element][i] - r->load[j][i];
    Triple others = {0, 0, 0};
    loads_add_others(r, j, others);
    inertia_add(r, j, others);
    for (int i = 0; i < 3; i++) end.force[i] -= others[i];
    if (none) return end;
    const Surface *surface = &source->surface[k];
    Triple x, reference, carried, n, slip, own;
    widen(r->position[j], x);
    widen(r->reference[j], reference);
    surface_normal(surface, x, n);
    carried_point(r, surface, r->turn[k], true, j, 0, carried);
    surface_slip(surface, carried, x, slip);
    surface_own(surface, x, reference, r->share, own);
    end.reaction = fmaxl(0, dot(n, end.force));
    const bool neighbour_held = (next == 0 && r->end_kind[0] == END_HELD) ||
                                (next == r->elements && r->end_kind[1] == END_HELD);
    if (end.reaction > 0 && !neighbour_held)
        set_friction(source, r, j, next, k, n, end.reaction, slip, end.friction);
    for (int i = 0; i < 3; i++) end.force[i] -= end.reaction * n[i] + end.friction[i];
    end.slid = -dot(end.friction, slip);
    const bool moves = r->turn[k] != 0 || surface_moves(surface);
    end.carried = moves ? dot(end.friction, own) - dot(end.friction, slip) : 0;
    return end;
}

/* how far an answer is from the file's [N] */
static Real apart(const Record *r, int e, const End *end) {
    Real sum = fabsl(end->reaction - r->reaction[e ? r->elements : 0]);
    for (int i = 0; i < 3; i++)
        sum += fabsl(end->force[i] - r->end_force[e][i]) +
               fabsl(end->friction[i] - r->end_friction_force[e][i]);
    return sum;
}

End end_measure(const Source *source, const Record *r, int e) {
    const size_t j = e ? r->elements : 0;
    if (r->end_kind[e] == END_FREE) {
        End end = {.reaction = r->reaction[j]};
        widen(r->applied_force[e], end.force);
        sets_add(r, j, end.force);
        return end;
    }
    if (r->end_point[e] >= 0) /* the point bears what obstacles do to the half element */
        return on_obstacle(source, r, e, 0, true);
    Real length = 0, nearest = INFINITY;
    Triple x;
    widen(r->position[j], x);
    for (size_t i = 0; i < r->elements; i++) length += r->element_length[i];
    // what gives bears nothing at a held end: the support has all of it
    for (size_t k = 0; k < source->surfaces; k++)
        if (!(source->surface[k].gives > 0))
            nearest = fminl(nearest, surface_distance(&source->surface[k], x));
    End best = on_obstacle(source, r, e, 0, true);
    bool found = !(nearest <= TOUCH / 2 * length);
    for (size_t k = 0; k < source->surfaces; k++) {
        if (source->surface[k].gives > 0 ||
            !(surface_distance(&source->surface[k], x) <= 2 * TOUCH * length))
            continue;
        const End end = on_obstacle(source, r, e, k, false);
        if (!found || apart(r, e, &end) < apart(r, e, &best)) best = end;
        found = true;
    }
    return best;
}

Real ends_work(const Record *r, const Record *before) {
    Real work = 0;
    for (int e = 0; e < 2; e++) {
        const size_t j = e ? r->elements : 0;
        // the node at which a drum is may be another than before
        const double *from =
            r->drums ? before->position[e ? before->elements : 0] : r->reference[j];
        const bool free =
            r->end_kind[e] == END_FREE; // let go from the force it carried, all of it the end's
        for (int i = 0; i < 3; i++) {
            // the reaction of a set does no work
            Triple now = {0, 0, 0}, then = {0, 0, 0};
            sets_add(r, j, now);
            sets_add(before, e ? before->elements : 0, then);
            const Real after = (Real)r->end_force[e][i] + r->end_friction_force[e][i] - now[i],
                       stored = r->end_friction_force[e][i];
            const Real first = is_let_go(r, before, e)
                                   ? 0
                                   : (Real)before->end_force[e][i] - then[i] +
                                         (free ? 0 : before->end_friction_force[e][i]);
            work += ((first + after) / 2 - stored) * ((Real)r->position[j][i] - from[i]);
        }
    }
    return work;
}
