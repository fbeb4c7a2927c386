/* SPDX-License-Identifier: BSD-3-Clause */
/* The functional of S90 section 5: gradient and Hessian (see regularized.h). */
#include "regularized/regularized.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "regularized/band_blocks.h"

void cpsi_regularized_store(CpsiRegularized *f, const double *x) {
    const size_t last = 3 * (size_t)f->cells->cells;
    memcpy(f->place, f->cells->position, 3 * sizeof(double));
    memcpy(f->place + last, f->cells->position + last, 3 * sizeof(double));
    memcpy(f->place + 3, x, (size_t)f->unknowns * sizeof(double));
}

static Vec3 slope(const CpsiRegularized *f, int cell) {
    return vec3_scale(1 / f->cells->width[cell],
                      vec3_sub(vec3_at(f->place, cell + 1), vec3_at(f->place, cell)));
}

double cpsi_regularized_tension(const CpsiRegularized *f, int cell) {
    return fmax(0, (vec3_norm(slope(f, cell)) - 1) / f->step->compliance);
}

/* u_i - u_(i-1) = sum over the last three places of coefficient times position; *first is the first
 * of the three */
static int bend_stencil(const CpsiCells *c, int cell, double coefficient[3]) {
    const double now = 1 / c->width[cell], before = cell > 0 ? 1 / c->width[cell - 1] : 0;
    coefficient[0] = before;
    coefficient[1] = -now - before;
    coefficient[2] = now;
    return cell - 1;
}

/* tangential displacement from the reference, and *distance from the obstacle, negative inside
 * it */
static Vec3 find_slip(const CpsiRegularized *f, int j, double *distance) {
    const CpsiCells *c = f->cells;
    const Vec3 u = vec3_sub(vec3_at(f->place, j), vec3_at(c->reference, j)),
               n = vec3_at(c->normal, j);
    *distance = vec3_dot(u, n) + c->gap[j];
    return vec3_reject(u, n);
}

static double smoothed(const CpsiRegularized *f, Vec3 slip) {
    return sqrt(f->parameters.delta * f->parameters.delta + vec3_dot(slip, slip));
}

/* ---- gradient ---- */

static void place_gradient(CpsiRegularized *f, int j) {
    const CpsiCells *c = f->cells;
    double distance;
    const Vec3 slip = find_slip(f, j, &distance);
    cpsi_add(f->gradient, j, -1, vec3_at(c->load, j));
    if (c->bound[j] > 0) cpsi_add(f->gradient, j, c->bound[j] / smoothed(f, slip), slip);
    if (distance < 0)
        cpsi_add(f->gradient, j, f->parameters.penalty * c->share[j] * distance,
                 vec3_at(c->normal, j));
}

static void gradient(void *user, const double *x, double *g) {
    CpsiRegularized *f = user;
    const CpsiCells *c = f->cells;
    cpsi_regularized_store(f, x);
    memset(f->gradient, 0, 3 * ((size_t)c->cells + 1) * sizeof(double));
    Vec3 before = vec3(0, 0, 0);
    for (int i = 0; i < c->cells; ++i) {
        const Vec3 u = slope(f, i);
        const double stretched = vec3_norm(u);
        if (stretched > 1) {
            const double pull = (stretched - 1) / f->step->compliance / stretched;
            cpsi_add(f->gradient, i, -pull, u);
            cpsi_add(f->gradient, i + 1, pull, u);
        }
        double coefficient[3];
        const int first = bend_stencil(c, i, coefficient);
        const Vec3 turn = vec3_scale(f->parameters.stiffness * c->bend[i], vec3_sub(u, before));
        for (int k = first < 0; k < 3; ++k) cpsi_add(f->gradient, first + k, coefficient[k], turn);
        before = u;
    }
    for (int j = 0; j <= c->cells; ++j) place_gradient(f, j);
    memcpy(g, f->gradient + 3, (size_t)f->unknowns * sizeof(double));
}

/* ---- Hessian ---- */

static void add_block(const CpsiRegularized *f, double *a, int i, int j, double k, double l,
                      Vec3 d) {
    cpsi_add_block(a, CPSI_REGULARIZED_BAND, f->unknowns, i, j, k, l, d);
}

/* stretching: (K t t^T + (T/|u|) (I - t t^T))/w where |u| > 1, and the damping */
static void segment_blocks(const CpsiRegularized *f, int cell, double damping, double *a) {
    const Vec3 u = slope(f, cell);
    const double stretched = vec3_norm(u), width = f->cells->width[cell];
    double across = 0, along = 0;
    if (stretched > 1) {
        across = (stretched - 1) / f->step->compliance / stretched;
        along = (1 / f->step->compliance - across) / (stretched * stretched);
    }
    across = (across + damping) / width;
    along /= width;
    add_block(f, a, cell, cell, across, along, u);
    add_block(f, a, cell + 1, cell + 1, across, along, u);
    add_block(f, a, cell + 1, cell, -across, -along, u);
}

static void bend_blocks(const CpsiRegularized *f, int cell, double *a) {
    double coefficient[3];
    const int first = bend_stencil(f->cells, cell, coefficient);
    const double k = f->parameters.stiffness * f->cells->bend[cell];
    for (int p = first < 0; p < 3; ++p)
        for (int q = first < 0; q <= p; ++q)
            add_block(f, a, first + p, first + q, k * coefficient[p] * coefficient[q], 0,
                      vec3(0, 0, 0));
}

static void place_blocks(const CpsiRegularized *f, int j, double *a) {
    const CpsiCells *c = f->cells;
    double distance;
    const Vec3 slip = find_slip(f, j, &distance), n = vec3_at(c->normal, j);
    if (c->bound[j] > 0) {
        const double r = smoothed(f, slip), k = c->bound[j] / r;
        add_block(f, a, j, j, k, -k / (r * r), slip);
        add_block(f, a, j, j, 0, -k, n);
    }
    if (distance <= 0) add_block(f, a, j, j, 0, f->parameters.penalty * c->share[j], n);
}

static void hessian(void *user, const double *x, double damping, double *a) {
    CpsiRegularized *f = user;
    cpsi_regularized_store(f, x);
    for (int i = 0; i < f->cells->cells; ++i) {
        segment_blocks(f, i, damping, a);
        bend_blocks(f, i, a);
    }
    for (int j = 1; j <= f->cells->cells; ++j) place_blocks(f, j, a);
}

CpsiSmooth cpsi_regularized_smooth(CpsiRegularized *f) {
    return (CpsiSmooth){.unknowns = f->unknowns,
                        .band = CPSI_REGULARIZED_BAND,
                        .user = f,
                        .gradient = gradient,
                        .hessian = hessian,
                        .damping_unit = 1 / f->step->compliance};
}

double cpsi_regularized_limit(const CpsiRegularized *f) {
    const CpsiCells *c = f->cells;
    double far = 0, stiffest = 0;
    for (int j = 0; j <= c->cells; ++j) far = fmax(far, vec3_norm(vec3_at(c->position, j)));
    for (int i = 0; i < c->cells; ++i) {
        const double bend = 4 * f->parameters.stiffness * c->bend[i] / (c->width[i] * c->width[i]);
        stiffest = fmax(stiffest, 1 / f->step->compliance / c->width[i] + bend);
    }
    for (int j = 0; j <= c->cells; ++j)
        stiffest =
            fmax(stiffest, f->parameters.penalty * c->share[j] + c->bound[j] / f->parameters.delta);
    /* rounding of a place's coordinates, times the stiffness that holds it */
    return fmax(1e-10 * f->step->force, 8 * DBL_EPSILON * far * stiffest);
}
