/* SPDX-License-Identifier: BSD-3-Clause */
/* Damped Newton steps with a line search on the slope (see newton.h). */
#include "regularized/newton.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "linalg/band.h"

/* a line search ends where the slope is at most this share of the initial one: a larger share is
 * cheaper, a smaller one searches longer */
static const double SLOPE_LEFT = 0.1;
enum { MAX_SEARCH = 40 };

/* the iteration ends after this many successive steps that change x by no more than rounding */
enum { PATIENCE = 8 };

/* damping: initial value, growth when steps are shortened, and the value below which it counts as
 * zero [damping_unit] */
static const double DAMPING_FIRST = 1e-8, DAMPING_GROWTH = 10, DAMPING_LEAST = 1e-13,
                    DAMPING_MOST = 1e4;

typedef struct Space {
    double *gradient, *direction, *trial, *trial_gradient, *matrix;
} Space;

static double dot(int n, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += a[i] * b[i];
    return sum;
}

/* NaN and infinity give infinity */
static double largest(int n, const double *g) {
    double most = 0;
    for (int i = 0; i < n; ++i) {
        if (!isfinite(g[i])) return INFINITY;
        most = fmax(most, fabs(g[i]));
    }
    return most;
}

/* Slope of f at x + t direction along the direction. The point and its gradient are left in
 * trial. */
static double slope_at(const CpsiSmooth *f, const double *x, double t, Space *s,
                       CpsiDampedNewton *newton) {
    for (int i = 0; i < f->unknowns; ++i) s->trial[i] = x[i] + t * s->direction[i];
    f->gradient(f->user, s->trial, s->trial_gradient);
    ++newton->evaluations;
    return dot(f->unknowns, s->trial_gradient, s->direction);
}

/* A step length with a slope near 0, by false position between a point of negative and one of
 * positive slope (the Illinois variant: an end that is kept twice counts half). trial and its
 * gradient belong to it. Returns 0 where no decrease is possible. */
static double search(const CpsiSmooth *f, const double *x, double first, Space *s,
                     CpsiDampedNewton *newton) {
    const double small = SLOPE_LEFT * fabs(first);
    double low = 0, low_slope = first, high = 0, high_slope = 0, t = 1;
    int side = 0;
    for (int i = 0; i < MAX_SEARCH; ++i) {
        const double slope = slope_at(f, x, t, s, newton);
        if (fabs(slope) <= small || (slope < 0 && t == 1)) return t;
        if (slope < 0) {
            low = t;
            low_slope = slope;
            if (side < 0) high_slope /= 2;
            side = -1;
        } else { /* also for NaN: the step is too long */
            high = t;
            high_slope = isfinite(slope) ? slope : INFINITY;
            if (side > 0) low_slope /= 2;
            side = 1;
        }
        const double cut =
            isfinite(high_slope) ? low + (high - low) * low_slope / (low_slope - high_slope) : 0;
        const double width = high - low;
        t = cut > low + 1e-3 * width && cut < high - 1e-3 * width
                ? cut
                : low + (isfinite(high_slope) ? 0.5 : 0.1) * width;
        if (!(width > 1e-15 * high)) break;
    }
    /* the end with negative slope has certainly a lower value */
    if (low > 0) slope_at(f, x, low, s, newton);
    return low;
}

/* the Newton direction, with increasing damping until the matrix is positive definite; false where
 * no damping suffices */
static bool find_direction(const CpsiSmooth *f, const double *x, double *damping, Space *s) {
    const int n = f->unknowns;
    for (; *damping <= DAMPING_MOST; *damping = fmax(DAMPING_FIRST, DAMPING_GROWTH * *damping)) {
        memset(s->matrix, 0, (size_t)n * ((size_t)f->band + 1) * sizeof *s->matrix);
        f->hessian(f->user, x, *damping * f->damping_unit, s->matrix);
        if (!cpsi_band_factor(n, f->band, s->matrix)) continue;
        for (int i = 0; i < n; ++i) s->direction[i] = -s->gradient[i];
        cpsi_band_solve(n, f->band, s->matrix, s->direction);
        if (isfinite(largest(n, s->direction)) && dot(n, s->gradient, s->direction) < 0)
            return true;
    }
    return false;
}

void cpsi_newton_minimise(const CpsiSmooth *f, double *x, CpsiDampedNewton *newton, double *work) {
    const int n = f->unknowns;
    Space s = {work, work + n, work + 2 * (size_t)n, work + 3 * (size_t)n, work + 4 * (size_t)n};
    double damping = 0;
    int patience = PATIENCE;
    bool beyond = false; /* the last step began below the tolerance */
    newton->iterations = 0;
    newton->evaluations = 1;
    f->gradient(f->user, x, s.gradient);
    for (;;) {
        newton->residual = largest(n, s.gradient);
        newton->converged = newton->residual <= newton->tolerance;
        if (newton->iterations == newton->max_iterations || (newton->converged && beyond)) return;
        beyond = newton->converged;
        ++newton->iterations;

        /* compute a direction and a step along it */
        if (!find_direction(f, x, &damping, &s)) return;
        const double slope = dot(n, s.gradient, s.direction), t = search(f, x, slope, &s, newton);
        if (t > 0) {
            memcpy(x, s.trial, (size_t)n * sizeof *x);
            memcpy(s.gradient, s.trial_gradient, (size_t)n * sizeof *x);
        }

        /* increase the damping after shortened steps, decrease it after full ones */
        if (t < 0.2)
            damping = fmax(DAMPING_FIRST, DAMPING_GROWTH * damping);
        else if (t > 0.6)
            damping = damping > DAMPING_LEAST ? damping / DAMPING_GROWTH : 0;
        const double move = t * largest(n, s.direction);
        patience = move > 4 * DBL_EPSILON * largest(n, x) ? PATIENCE : patience - 1;
        if (damping > DAMPING_MOST || patience == 0) return;
    }
}
