/* SPDX-License-Identifier: BSD-3-Clause */
/* The claim "slides without end", by virtual power.
 *
 * Suppose the line at rest at some place: tensions T_i >= 0 along the elements, pressures N_j >= 0
 * and friction N_j f_j, f_j in the set M_j, at the nodes that touch. By the principle of virtual
 * power, for every velocity field v,
 *
 *     loads.v + sum_j N_j (n_j + f_j).v_j = sum_i T_i (rate at which element i lengthens along its
 *         direction).
 *
 * If v lengthens no element and has n_j.v_j >= phi_j(v_j) = max of -f.v_j over M_j, so that (n_j +
 * f).v_j >= 0 for every f in M_j, the left side is at least loads.v and the right side at most 0:
 * at rest loads.v <= 0. The claim is loads.v > 0 there, and the same at every later place of the
 * line on its own way: its first k elements have run over the end that leads and go straight on,
 * where no obstacle may be. The nodes that remain are places that were judged already; each of the
 * loads on them is counted anew here, place by place. */
#include "motion.h"

#include "grasps.h"

#include <math.h>

typedef Real Triple[3];

/* Rates and normal velocities may be off by rounding of places and of v, whose largest is 1; */
static const Real RATE = 1e-12L;
/* a node touches within this part of the line's length, and the straight way on keeps clear by as
 * much; */
static const Real TOUCH = 1e-9L;
/* a power is one when it exceeds this part of its terms' sizes: rounding of their sum is far
 * below. */
static const Real POWER = 1e-10L;

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real size(const Real *a) { return sqrtl(dot(a, a)); }

static void between(const Record *r, size_t from, size_t to, Real *out) {
    for (int k = 0; k < 3; k++) out[k] = (Real)r->reference[to][k] - (Real)r->reference[from][k];
}

/* max -f.v over the forces per unit pressure, the zones' largest factor everywhere: zones move with
 * the line */
static Real resistance(const Surface *surface, Real factor, const Real *n, const Real *along,
                       const Real *v) {
    Real axes[2][3], slip[2], phi, most = factor * surface_friction(surface);
    if (!surface_axes(surface, n, along, axes)) {
        Real rise = dot(n, v);
        return sqrtl(fmaxl(0, dot(v, v) - rise * rise)) * most *
               (surface->set ? surface->set->reach : 1);
    }
    for (int a = 0; a < 2; a++) slip[a] = dot(axes[a], v);
    surface_gap(surface, most, (Real[2]){0, 0}, slip, &phi);
    return phi;
}

/* Is node j where a line cannot be? */
static bool is_inside(const Source *source, const Record *r, size_t j, Real length) {
    Triple x;
    for (int k = 0; k < 3; k++) x[k] = r->reference[j][k];
    for (size_t k = 0; k < source->surfaces; k++)
        if (surface_distance(&source->surface[k], x) < -TOUCH * length) return true;
    return false;
}

/* Does element i lie on an obstacle between its nodes, or nearly so?  The principle above counts
 * forces at nodes only, which are all there are with contact of the reference. */
static bool rests_between(const Source *source, const Record *r, size_t i) {
    Triple a, b;
    for (int k = 0; k < 3; k++) {
        a[k] = r->reference[i][k];
        b[k] = r->reference[i + 1][k];
    }
    for (size_t k = 0; k < source->surfaces; k++) {
        const Surface *surface = &source->surface[k];
        const Real l = r->element_length[i];
        if (surface_pierced(surface, a, b, l) > -0.05L * surface_allowance(surface, l)) return true;
    }
    return false;
}

/* Does node j press on something that its velocity does not leave fast enough? */
static bool is_hindered(const Source *source, const Record *r, size_t j, Real length, Real factor) {
    Triple x, v, n, along;
    for (int k = 0; k < 3; k++) {
        x[k] = r->reference[j][k];
        v[k] = r->motion[j][k];
    }
    between(r, j > 0 ? j - 1 : j, j < r->elements ? j + 1 : j, along);
    for (size_t k = 0; k < source->surfaces; k++) {
        const Surface *surface = &source->surface[k];
        if (surface_distance(surface, x) > TOUCH * length) continue;
        surface_normal(surface, x, n);
        if (!(dot(n, v) >= resistance(surface, factor, n, along, v) - RATE)) return true;
    }
    return false;
}

/* The way on from x along the unit vector t, for the length of the line, by a search for the least
 * distance: distances are convex along a straight way, from these obstacles and from their
 * inside. */
static bool is_clear(const Surface *surface, const Real *x, const Real *t, Real length) {
    Real low = 0, high = length, n[3];
    if (surface_distance(surface, x) <= TOUCH * length) {
        surface_normal(surface, x, n);
        return dot(n, t) > TOUCH; // it touches and leaves at once, for good
    }
    for (int i = 0; i < 300; i++) {
        Real a = low + (high - low) / 3, b = high - (high - low) / 3, at_a[3], at_b[3];
        for (int k = 0; k < 3; k++) {
            at_a[k] = x[k] + a * t[k];
            at_b[k] = x[k] + b * t[k];
        }
        if (surface_distance(surface, at_a) < surface_distance(surface, at_b))
            high = b;
        else
            low = a;
    }
    Real at[3];
    for (int k = 0; k < 3; k++) at[k] = x[k] + low * t[k];
    return surface_distance(surface, at) > TOUCH * length;
}

/* The power of all loads once the elements behind node `tail` have run over the end that leads. */
static bool has_power(const Record *r, size_t tail, size_t head, const Real *weight, const Real *t,
                      Real gone, double *power) {
    Real sum = 0, sizes = 0, lead[3];
    for (int k = 0; k < 3; k++) lead[k] = r->motion[head][k];
    const int step = head > tail ? 1 : -1;
    for (size_t j = tail; j != head; j = (size_t)((long)j + step)) {
        const size_t next = (size_t)((long)j + step), element = step > 0 ? j : next;
        for (int k = 0; k < 3; k++) {
            Real term = r->element_length[element] * weight[k] *
                        ((Real)r->motion[j][k] + r->motion[next][k]) / 2;
            sum += term;
            sizes += fabsl(term);
        }
    }
    const int trailing = head == r->elements ? 0 : 1;
    for (int k = 0; k < 3; k++) {
        Real back = (Real)r->applied_force[trailing][k] * r->motion[tail][k],
             front = r->applied_force[!trailing][k] * lead[k];
        sum += back + front;
        sizes += fabsl(back) + fabsl(front);
    }
    Real on = gone * dot(weight, t) *
              dot(t, lead); // what has run over moves straight on, as fast as the end does
    sum += on;
    sizes += fabsl(on);
    *power = fmin(*power, (double)sum);
    return sum > POWER * sizes;
}

const char *motion_contradiction(const Source *source, const Record *r, double *power) {
    *power = INFINITY;
    for (size_t j = 0; j < r->nodes; j++)
        if (node_is_held(r, j)) return "a node is held";
    if (r->weight_length) return "its weights move along with it";
    if (!source->consistent) return "friction is frozen, which holds whatever the tension";
    Real length = 0, fastest = 0, factor = r->factor ? 0 : 1;
    Triple weight = {0, 0, 0}, e, v, t;
    for (size_t i = 0; i < r->elements; i++) length += r->element_length[i];
    for (size_t j = 0; j < r->nodes; j++) {
        for (int k = 0; k < 3; k++) {
            weight[k] += r->load[j][k] / length;
            v[k] = r->motion[j][k];
        }
        fastest = fmaxl(fastest, size(v));
        if (r->factor) factor = fmaxl(factor, r->factor[j]);
    }
    for (int k = 0; k < 3; k++)
        weight[k] -= ((Real)r->applied_force[0][k] + r->applied_force[1][k]) / length;
    if (!(fabsl(fastest - 1) <= 1e-9L)) return "the fastest node does not move at the speed 1";
    for (size_t i = 0; i < r->elements; i++) {
        between(r, i, i + 1, e);
        for (int k = 0; k < 3; k++) v[k] = (Real)r->motion[i + 1][k] - r->motion[i][k];
        if (!(size(e) > 0) || !(dot(e, v) / size(e) <= RATE)) return "an element would lengthen";
    }
    for (size_t j = 0; j < r->nodes; j++)
        if (is_inside(source, r, j, length)) return "a node lies inside an obstacle";
    for (size_t i = 0; i < r->elements; i++)
        if (r->has_elements && rests_between(source, r, i))
            return "an element rests on an obstacle between its nodes";
    for (size_t j = 0; j < r->nodes; j++)
        if (is_hindered(source, r, j, length, factor)) return "a node would press on an obstacle";
    // the end that its element pulls after itself leads
    between(r, r->elements - 1, r->elements, e);
    for (int k = 0; k < 3; k++) v[k] = r->motion[r->elements][k];
    const bool to_b = dot(e, v) > 0;
    const size_t head = to_b ? r->elements : 0, tail = to_b ? 0 : r->elements;
    between(r, to_b ? head - 1 : 1, head, t);
    Triple x;
    const Real stride = size(t);
    for (int k = 0; k < 3; k++) {
        t[k] /= stride;
        x[k] = r->reference[head][k];
    }
    for (size_t k = 0; k < source->surfaces; k++)
        if (!is_clear(&source->surface[k], x, t, length)) return "its way on leads to an obstacle";
    Real gone = 0;
    for (size_t j = tail;; j = to_b ? j + 1 : j - 1) {
        if (!has_power(r, j, head, weight, t, gone, power))
            return "its loads have no power that nothing can take";
        if (j == head) return NULL;
        gone += r->element_length[to_b ? j : j - 1];
    }
}
