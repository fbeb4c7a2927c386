/* SPDX-License-Identifier: BSD-3-Clause */
/* The normal cone of a sum of many balls and images of balls, such as the law of a body on many
 * contacts, in two or three components. About its centre the sum has the support function
 *
 *     h(w) = sum r_k |L_k'w|,    grad h = sum r_k L_k y_k,    y_k = L_k'w/|L_k'w|,
 *     H = sum (r_k/|L_k'w|) (L_k L_k' - (L_k y_k)(L_k y_k)'),
 *
 * which is smooth where no L_k'w is 0. With q the point less the centre,
 *
 *     1/gauge(q) = min { h(w) : <w, q> = 1 },        -distance^2/2 = min h(w) - <w, q> + |w|^2/2,
 *
 * are two smooth convex problems in w alone, each solved by damped Newton steps. Their time is
 * proportional to the number of parts, that of the conic form to its cube. The minimiser of the
 * first is a normal of the sum at q/gauge. It is the only one where the rank of H is one less than
 * the dimension of the space: then grad h takes the value q/gauge on no other ray near by, and a
 * normal cone is convex. */
#include "base/status.h"
#include "linalg/dense.h"
#include "set/set.h"

#include <math.h>
#include <string.h>

enum { MOST = 3, STEPS = 60 };
/* With fewer parts the conic form takes only milliseconds. */
static const int MANY = 20;
/* h does not count as smooth where a part's |L_k'w| is below this share of |L_k||w|, nor its
 * Hessian as of full rank below this share of its trace, since normals would be less accurate than
 * promised. */
static const double SMOOTH = 1e-6;
/* Where Newton's decrement is this small relative to the value, rounding prevents a test of
 * descent. Each of the last steps squares the error of w. */
static const double NEAR = 1e-10;
static const int LAST = 2;
/* A point counts as inside where the ball round it has a radius of this many tolerances. */
static const double CLEARLY = 10;

/* The ball of a part, and the map L (n, ball->n) that is applied to it in the sum. */
static const CpsSet *ball_of(const CpsSet *part, double *map) {
    const CpsSet *ball = part->kind == CPSI_SET_IMAGE ? part->part[0] : part;
    for (int i = 0; i < part->n; i++)
        for (int j = 0; j < ball->n; j++)
            map[i * ball->n + j] = ball == part ? (double)(i == j) : part->a[i * ball->n + j];
    return ball;
}

/* h at w, its gradient and Hessian; false where h is not smooth there. */
static bool support(const CpsSet *set, const double *w, double *h, double *gradient,
                    double *hessian) {
    const int n = set->n;
    *h = 0;
    memset(gradient, 0, (size_t)n * sizeof *gradient);
    memset(hessian, 0, (size_t)(n * n) * sizeof *hessian);
    for (int k = 0; k < set->count; k++) {
        double back[MOST] = {0}, normal[MOST] = {0}, map[MOST * MOST] = {0}, all = 0;
        const CpsSet *ball = ball_of(set->part[k], map);
        const int m = ball->n;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < m; j++) {
                back[j] += map[i * m + j] * w[i];
                all += map[i * m + j] * map[i * m + j];
            }
        const double length = cpsi_norm(m, back);
        if (ball->scalar == 0 || all == 0) continue;
        if (!(length > SMOOTH * sqrt(all) * cpsi_norm(n, w))) return false;
        for (int i = 0; i < n; i++) normal[i] = cpsi_dot(m, &map[i * m], back) / length;
        *h += ball->scalar * length;
        for (int i = 0; i < n; i++) {
            gradient[i] += ball->scalar * normal[i];
            for (int j = 0; j < n; j++)
                hessian[i * n + j] +=
                    ball->scalar / length *
                    (cpsi_dot(m, &map[i * m], &map[j * m]) - normal[i] * normal[j]);
        }
    }
    return true;
}

/* h(w) - curvature (<w, q> - |w|^2/2), for given h = h(w). */
static double objective(int n, double h, double curvature, const double *w, const double *q) {
    return h - curvature * (cpsi_dot(n, w, q) - 0.5 * cpsi_dot(n, w, w));
}

/* The minimum of h(w) - curvature (<w, q> - |w|^2/2), curvature 0 or 1, over w = start + basis't,
 * basis (free, n). w holds the start and then the minimiser. Returns false where h is not smooth at
 * an iterate, or the iteration does not converge. */
static bool minimise(const CpsSet *set, const double *q, double curvature, int unknowns,
                     const double *basis, double *w, double *value, double *hessian) {
    const int n = set->n;
    double gradient[MOST], h;
    int last = 0;
    if (!support(set, w, &h, gradient, hessian)) return false;
    for (int step = 0; step < STEPS; step++) {
        double slope[MOST] = {0}, matrix[MOST * MOST] = {0}, newton[MOST];
        int pivot[MOST];
        for (int i = 0; i < n; i++) gradient[i] += curvature * (w[i] - q[i]);
        *value = objective(n, h, curvature, w, q);
        for (int a = 0; a < unknowns; a++) {
            slope[a] = newton[a] = cpsi_dot(n, &basis[a * n], gradient);
            for (int b = 0; b < unknowns; b++) {
                double sum = a == b ? curvature : 0;
                for (int i = 0; i < n; i++)
                    sum += basis[a * n + i] * cpsi_dot(n, &hessian[i * n], &basis[b * n]);
                matrix[a * unknowns + b] = sum;
            }
        }
        if (!cpsi_lu_factor(unknowns, matrix, pivot)) return false;
        cpsi_lu_solve(unknowns, matrix, pivot, newton);
        const double decrement = cpsi_dot(unknowns, slope, newton);
        if (!(decrement >= 0)) return false;
        const bool near = decrement <= NEAR * fabs(*value);
        if (near && ++last > LAST) return true;

        /* halve the Newton step until the value decreases by at least a tenth of the predicted
         * decrease */
        double to[MOST];
        bool taken = false;
        for (double share = 1; !taken && share > 1e-12; share *= 0.5) {
            for (int i = 0; i < n; i++) {
                to[i] = w[i];
                for (int a = 0; a < unknowns; a++) to[i] -= share * newton[a] * basis[a * n + i];
            }
            if (!support(set, to, &h, gradient, hessian)) continue;
            const double next = objective(n, h, curvature, to, q);
            taken = near || next <= *value - 0.1 * share * decrement;
        }
        if (!taken) return false;
        memcpy(w, to, (size_t)n * sizeof *w);
    }
    return false;
}

/* Whether the set is a sum of the kind treated here; q is then p less its centre. */
static bool is_meant(const CpsSet *set, const double *p, double *q) {
    const int n = set->n;
    if (set->kind != CPSI_SET_SUM || set->count < MANY || n < 2 || n > MOST) return false;
    memcpy(q, p, (size_t)n * sizeof *q);
    for (int k = 0; k < set->count; k++) {
        const CpsSet *part = set->part[k],
                     *ball = part->kind == CPSI_SET_IMAGE ? part->part[0] : part;
        if (ball->kind != CPSI_SET_BALL || ball->n > MOST) return false;
        double map[MOST * MOST];
        ball_of(part, map);
        for (int i = 0; i < n; i++) q[i] -= cpsi_dot(ball->n, &map[i * ball->n], ball->a);
    }
    return true;
}

/* The radius of a ball that lies in the sum: h(w)^2 >= w'M w with M = sum r_k^2 L_k L_k', whose
 * smallest eigenvalue is at least det M/(trace M/(n - 1))^(n - 1). */
static double least_radius(const CpsSet *set) {
    const int n = set->n;
    double m[MOST * MOST] = {0}, trace = 0;
    int pivot[MOST];
    for (int k = 0; k < set->count; k++) {
        double map[MOST * MOST];
        const CpsSet *ball = ball_of(set->part[k], map);
        const double square = ball->scalar * ball->scalar;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                m[i * n + j] += square * cpsi_dot(ball->n, &map[i * ball->n], &map[j * ball->n]);
    }
    for (int i = 0; i < n; i++) trace += m[i * n + i];
    if (!(trace > 0) || !cpsi_lu_factor(n, m, pivot)) return 0;
    double determinant = 1;
    for (int i = 0; i < n; i++) determinant *= fabs(m[i * n + i]);
    return sqrt(determinant / pow(trace / (n - 1), n - 1));
}

/* Whether the Hessian, whose null space contains w, has the rank n - 1, from its smallest
 * eigenvalue normal to w. */
static bool is_round(int n, const double *hessian) {
    double trace = 0, minors = 0;
    for (int i = 0; i < n; i++) trace += hessian[i * n + i];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            minors +=
                hessian[i * n + i] * hessian[j * n + j] - hessian[i * n + j] * hessian[j * n + i];
    return n == 2 ? trace > 0 : minors > SMOOTH * trace * trace;
}

/* The directions normal to q, (n - 1, n) orthonormal, and the multiple of q with <w, q> = 1. */
static void across(int n, const double *q, double *basis, double *w) {
    double rows[MOST * MOST] = {0};
    const double size = cpsi_norm(n, q);
    for (int i = 0; i < n; i++) {
        w[i] = q[i] / (size * size);
        rows[i] = q[i] / size;
    }
    cpsi_complete_rows(1, n, rows);
    memcpy(basis, rows + n, (size_t)(n * (n - 1)) * sizeof *basis);
}

CpsStatus cpsi_smooth_sum_cone(const CpsSet *set, const double *p, double share, bool *known,
                               CpsSet **cone, CpsSetAnswer *answer, CpsError *err) {
    static const double ALL[MOST * MOST] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, TWO[4] = {1, 0, 0, 1};
    const int n = set->n;
    double q[MOST], w[MOST], basis[MOST * MOST], hessian[MOST * MOST], least;
    *known = false;
    if (!is_meant(set, p, q)) return CPS_OK;
    const double size = cpsi_set_size(set), far = cpsi_norm(n, q), radius = least_radius(set);
    *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED, .tolerance = share};
    if (far < radius - CLEARLY * share * size) {
        *known = true;
        return cps_set_cone_of_rays(n, 0, NULL, cone, err);
    }
    if (!(far > 0)) return CPS_OK;
    across(n, q, basis, w);
    if (!minimise(set, q, 0, n - 1, basis, w, &least, hessian)) return CPS_OK;
    /* relative distance from the boundary towards the centre */
    const double inside = 1 - 1 / least;
    if (inside * radius > CLEARLY * share * size) {
        *known = true;
        return cps_set_cone_of_rays(n, 0, NULL, cone, err);
    }
    if (fabs(inside) * far <= share * size) {
        *known = is_round(n, hessian);
        const double length = cpsi_norm(n, w);
        for (int i = 0; i < n; i++) w[i] /= length;
        return *known ? cps_set_cone_of_rays(n, 1, w, cone, err) : CPS_OK;
    }
    if (inside > 0) return CPS_OK;
    /* for a point outside: its distance */
    const double guess = (1 - least) / cpsi_norm(n, w), length = cpsi_norm(n, w);
    double value;
    for (int i = 0; i < n; i++) w[i] *= guess / length;
    if (!minimise(set, q, 1, n, n == 2 ? TWO : ALL, w, &value, hessian)) return CPS_OK;
    answer->value = sqrt(fmax(0, -2 * value));
    *known = answer->value > fmax(share, 1e-9) * size;
    if (*known) answer->outcome = CPS_SET_OUTCOME_OUTSIDE;
    return CPS_OK;
}
