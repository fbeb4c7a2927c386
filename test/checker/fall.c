/* SPDX-License-Identifier: BSD-3-Clause */
/* The path of a falling line, by a search. The distance of a straight element from a convex
 * obstacle is a convex function of the point on the element, and its minimum over the element is a
 * convex function of the distance fallen. Both minima are therefore found by sections, out to a
 * thousand times the extent of the scene. Where the distance still increases there, it increases
 * forever. */
#include "fall.h"

#include <math.h>

/* Part of the line's length within which a line touches. */
static const Real TOUCH = 1e-9L;
/* The way that is searched, in extents of the scene. */
static const Real FAR = 1000;
static const int SECTIONS = 200;

/* Element i, fallen by s along v, at the share t. */
static Real distance_at(const Surface *surface, const Record *r, size_t i, const Real *v, Real s,
                        Real t) {
    Real x[3];
    for (int k = 0; k < 3; k++)
        x[k] = (1 - t) * r->reference[i][k] + t * r->reference[i + 1][k] + s * v[k];
    return surface_distance(surface, x);
}

static Real element_distance(const Surface *surface, const Record *r, size_t i, const Real *v,
                             Real s) {
    Real low = 0, high = 1;
    for (int n = 0; n < SECTIONS; n++) {
        const Real a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (distance_at(surface, r, i, v, s, a) < distance_at(surface, r, i, v, s, b))
            high = b;
        else
            low = a;
    }
    const Real ends =
        fminl(distance_at(surface, r, i, v, s, 0), distance_at(surface, r, i, v, s, 1));
    return fminl(ends, distance_at(surface, r, i, v, s, low));
}

static bool is_met(const Surface *surface, const Record *r, size_t i, const Real *v, Real length,
                   Real far) {
    Real low = 0, high = far;
    for (int n = 0; n < SECTIONS; n++) {
        const Real a = low + (high - low) / 3, b = high - (high - low) / 3;
        if (element_distance(surface, r, i, v, a) < element_distance(surface, r, i, v, b))
            high = b;
        else
            low = a;
    }
    if (!(element_distance(surface, r, i, v, 0) > TOUCH * length &&
          element_distance(surface, r, i, v, low) > TOUCH * length))
        return true;
    // a wall or a drum along the way stays as far as it is, but for rounding
    const Real last = element_distance(surface, r, i, v, far),
               before = element_distance(surface, r, i, v, far / 2);
    return !(last >= before - 1e-15L * far);
}

bool falls_clear(const Source *source, const Record *r, const Real *v) {
    Real length = 0, extent = 0;
    for (size_t i = 0; i < r->elements; i++) length += r->element_length[i];
    for (size_t k = 0; k < source->surfaces; k++) {
        const Surface *surface = &source->surface[k];
        Real apart[3];
        for (int a = 0; a < 3; a++) apart[a] = surface->point[a] - (Real)r->reference[0][a];
        extent = fmaxl(extent, surface->radius + sqrtl(apart[0] * apart[0] + apart[1] * apart[1] +
                                                       apart[2] * apart[2]));
    }
    for (size_t k = 0; k < source->surfaces; k++)
        if (source->surface[k].ground || source->surface[k].mesh)
            return false; // what lies along the way is not looked at
    for (size_t k = 0; k < source->surfaces; k++)
        for (size_t i = 0; i < r->elements; i++)
            if (is_met(&source->surface[k], r, i, v, length, FAR * (extent + length))) return false;
    return true;
}

/* ---- planes that are left ---- */

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real size(const Real *a) { return sqrtl(dot(a, a)); }

/* By how much a disc that contains the forces of a box is larger than its longer half-axis. */
static Real disc_factor(const Surface *on) {
    const Real most = fmaxl(on->mu[0], on->mu[1]);
    return on->box && most > 0 ? hypotl(on->mu[0], on->mu[1]) / most : 1;
}

/* The part of v in the surface's tangent plane; returns its part along the normal. */
static Real split(const Surface *on, const Real *v, Real *across) {
    Real n[3];
    surface_normal(on, v, n);
    const Real rise = dot(n, v);
    for (int a = 0; a < 3; a++) across[a] = v[a] - rise * n[a];
    return rise;
}

bool falls_off_planes(const Source *source, const Record *r, const Real *v, Real *taken) {
    Real factor = r->factor ? 0 : 1;
    *taken = 0;
    if (r->factor)
        for (size_t j = 0; j < r->nodes; j++) factor = fmaxl(factor, r->factor[j]);
    for (size_t k = 0; k < source->surfaces; k++) {
        const Surface *on = &source->surface[k];
        Real across[3];
        if (on->kind != SURFACE_PLANE || on->set) return false;
        const Real rise = split(on, v, across),
                   mu = factor * disc_factor(on) * fmaxl(on->mu[0], on->mu[1]);
        if (!(rise >= (source->consistent ? mu * size(across) : 0))) return false;
    }
    if (source->consistent) return source->surfaces > 0;
    const size_t contacts = r->contacts * r->nodes + (r->has_elements ? r->elements : 0);
    for (size_t c = 0; c < contacts; c++) {
        if (r->obstacle[c] < 0) continue;
        const Surface *on = &source->surface[(size_t)r->obstacle[c]];
        Real across[3];
        (void)split(on, v, across);
        *taken += disc_factor(on) * r->friction_bound[c] * size(across);
    }
    return source->surfaces > 0;
}
