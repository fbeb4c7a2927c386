/* SPDX-License-Identifier: BSD-3-Clause */
/* Random driven systems: what must hold of every one.
 *     usage: random_systems [--cases N] [--seed S]
 *
 * A system has up to 10 velocity parameters and 6 laws (disc, ellipse, box, interval, half-line,
 * polygon, segment, wheel, product) of sizes from 0.01 to 100 on sparse random maps, up to 2
 * constraints (some twice), up to 3 driven components, and in a third of the cases a load, which
 * may be too large. With arithmetic of its own (dense maps, closed forms of every law):
 *
 *   - V agrees with drive and constraints, F lies in the laws' sets and balances, the bounds are as
 *       near as 1e-8
 *   - NO_BALANCE and BLOCKED come with a proof that is one
 *   - the reduced law's value is gamma(W), also for 2 W                             Proposition 1
 *   - every extreme point of the sets of all V and all F is a solution, as far as one pushes along
 *       their rays
 *   - an admissible velocity that dissipates no more than V lies in the set of all V
 *   - a disc that touches the balancing forces with its boundary is found out
 *       Proposition 1's condition */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/drive.h"
#include "random_case.h"

enum {
    MOST_N = 10,
    MOST_LAWS = 6,
    MOST_DIM = 3,
    MOST_POINTS = 6,
    MOST_COMPONENTS = MOST_LAWS * MOST_DIM,
    MOST_ROWS = 4
};

/* Relative to the power scale: what is asked of the gap. */
static const double GAP = 1e-8;
/* Two ways to gamma: the gap and the set solver's promise of 1e-9, with a factor of 10 for the
 * reduced map's condition. */
static const double VALUE = 1e-7;
/* Residuals of linear relations: rounding of at most 30 terms, refined. */
static const double LINEAR = 1e-11;
/* Extreme points of the sets of all solutions: the tolerance 1e-6 within which faces and cones may
 * be moved, with a factor 10 for how steeply phi rises beside them. */
static const double PUSH = 1e-5;

static int failures;

/* written so that NaN is a fault */
static void check(const char *what, double got, double bound) {
    if (got <= bound) return;
    fprintf(stderr, "seed %llu: %s: %.3g, allowed %.3g\n", (unsigned long long)seed, what, got,
            bound);
    failures++;
}

static double dot(int n, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static double norm(int n, const double *a) { return sqrt(dot(n, a, a)); }

/* ---- laws, twice: as the library's and as numbers ---- */

typedef enum Kind {
    DISC,
    ELLIPSE,
    BOX,
    INTERVAL,
    HALF_LINE,
    POLYGON,
    SEGMENT,
    WHEEL,
    PRODUCT,
    BINGHAM,
    BESIDE
} Kind;

typedef struct Law {
    Kind kind;
    int dim, points;
    double size;                 /* radius; wheel and product: of the disc */
    double shape[4], inverse[4]; /* ellipse */
    double low[MOST_DIM],
        high[MOST_DIM]; /* box, interval; wheel and product: of the strip or interval */
    double point[2 * MOST_POINTS];
    double map[MOST_DIM][MOST_N];
    CpsLaw *law;
    CpsResistance *resistance; /* of a disc with viscosity high[0] */
} Law;

static CpsLaw *friction(CpsSet *set) {
    CpsLaw *law = NULL;
    need(cps_law_friction(set, &law, &err), "friction");
    cps_set_release(set);
    return law;
}

static void make_polygon(Law *law) {
    CpsSet *set = NULL;
    law->points = law->kind == SEGMENT ? 2 : 4 + below(3);
    const double turn = uniform(0, 6), step = 6.283185307179586 / law->points;
    for (int i = 0; i < law->points; i++) { /* less than half a turn apart, so 0 is inside */
        const double r = law->size * uniform(0.5, 1),
                     angle = turn + i * step + (law->kind == SEGMENT ? 0 : uniform(0, 0.2));
        law->point[2 * i] = r * cos(angle);
        law->point[2 * i + 1] = r * sin(angle);
    }
    need(cps_set_hull_of_points(2, law->points, law->point, &set, &err), "hull");
    law->law = friction(set);
}

/* the wheel of M77 section 9 as a law of its own: a preimage of a product */
static void make_wheel(Law *law, bool product) {
    CpsSet *ends = NULL;
    CpsLaw *part[2] = {NULL, NULL}, *both = NULL;
    const double b = law->high[0];
    need(cps_set_interval(-b, b, &ends, &err), "interval");
    part[0] = friction(ends);
    need(cps_law_coulomb(1, law->size, &part[1], &err), "coulomb");
    need(cps_law_product(2, (const CpsLaw *const *)part, &both, &err), "product");
    if (product)
        law->law = both;
    else {
        need(cps_law_preimage(2, (const double[]){0, -1, 1, 0, 0, 1}, both, NULL, &law->law, &err),
             "preimage");
        cps_law_release(both);
    }
    cps_law_release(part[0]);
    cps_law_release(part[1]);
}

static void make_bingham(Law *law) {
    CpsResistance *part[2] = {NULL, NULL};
    need(cps_law_coulomb(1, law->size, &law->law, &err), "coulomb");
    need(cps_resistance_dry(law->law, &part[0], &err), "dry");
    need(cps_resistance_viscous(2, (const double[]){law->high[0], 0, 0, law->high[0]}, &part[1],
                                &err),
         "viscous");
    need(cps_resistance_sum(2, (const CpsResistance *const *)part, &law->resistance, &err), "sum");
    cps_resistance_release(part[0]);
    cps_resistance_release(part[1]);
}

static void make_law(Law *law, Kind kind) {
    static const int DIM[] = {2, 2, 0, 1, 1, 2, 2, 2, 3, 2, 2};
    *law = (Law){.kind = kind, .dim = DIM[kind], .size = pow(10, uniform(-2, 2))};
    if (kind == BOX) law->dim = 1 + below(3);
    for (int i = 0; i < MOST_DIM; i++) {
        law->low[i] = -law->size * uniform(0.1, 1);
        law->high[i] = law->size * uniform(0.1, 1);
    }
    CpsSet *set = NULL;
    switch (kind) {
    case DISC: need(cps_law_coulomb(0.5, 2 * law->size, &law->law, &err), "coulomb"); return;
    case ELLIPSE: {
        const double a = uniform(0.2, 1), b = uniform(0.2, 1), c = uniform(-0.9, 0.9) * sqrt(a * b),
                     s = law->size * law->size;
        const double shape[] = {s * a, s * c, s * c, s * b}, det = s * s * (a * b - c * c);
        const double inverse[] = {s * b / det, -s * c / det, -s * c / det, s * a / det};
        memcpy(law->shape, shape, sizeof shape);
        memcpy(law->inverse, inverse, sizeof inverse);
        need(cps_set_ellipsoid(2, NULL, shape, &set, &err), "ellipsoid");
        break;
    }
    case BOX:
    case INTERVAL: need(cps_set_box(law->dim, law->low, law->high, &set, &err), "box"); break;
    case HALF_LINE:
        law->low[0] = -INFINITY;
        law->high[0] = 0;
        need(cps_set_interval(-INFINITY, 0, &set, &err), "half-line");
        break;
    case POLYGON:
    case SEGMENT: make_polygon(law); return;
    case BINGHAM: make_bingham(law); return;
    case BESIDE:
        need(cps_set_ball(2, (const double[]){law->size, 0}, law->size, &set, &err),
             "ball beside 0");
        break;
    default: make_wheel(law, kind == PRODUCT); return;
    }
    law->law = friction(set);
}

/* phi(U) = sup of -<U, F>, closed forms; half-lines: 0 on what is allowed, `forbidden` takes the
 * rest */
static double dissipation(const Law *law, const double *u, double *forbidden) {
    double sum = 0;
    switch (law->kind) {
    case DISC: return law->size * norm(2, u);
    case BINGHAM: return law->size * norm(2, u) + law->high[0] * dot(2, u, u) / 2;
    case BESIDE: return law->size * (norm(2, u) - u[0]);
    case ELLIPSE:
        return sqrt(law->shape[0] * u[0] * u[0] + 2 * law->shape[1] * u[0] * u[1] +
                    law->shape[3] * u[1] * u[1]);
    case BOX:
    case INTERVAL:
        for (int i = 0; i < law->dim; i++) sum += fmax(-u[i] * law->low[i], -u[i] * law->high[i]);
        return sum;
    case HALF_LINE: *forbidden = fmax(*forbidden, u[0]); return 0;
    case POLYGON:
    case SEGMENT:
        sum = -INFINITY;
        for (int i = 0; i < law->points; i++) sum = fmax(sum, -dot(2, u, &law->point[2 * i]));
        return sum;
    case PRODUCT: return law->high[0] * fabs(u[0]) + law->size * norm(2, u + 1);
    default: {
        /* wheel: disc of radius r cut by |F_1| <= s */
        const double r = law->size, s = law->high[0], n = norm(2, u);
        if (s >= r || n == 0 || r * fabs(u[1]) <= s * n) return r * n;
        return s * fabs(u[1]) + sqrt(r * r - s * s) * fabs(u[0]);
    }
    }
}

static double past(double x, double low, double high) { return fmax(0, fmax(low - x, x - high)); }

/* how far F is outside, in about the units of F */
static double outside(const Law *law, const double *f) {
    double most = 0;
    switch (law->kind) {
    case DISC: return fmax(0, norm(2, f) - law->size);
    case BINGHAM: return 0; /* any force has its velocity */
    case BESIDE: return fmax(0, hypot(f[0] - law->size, f[1]) - law->size);
    case ELLIPSE: {
        const double q = law->inverse[0] * f[0] * f[0] + 2 * law->inverse[1] * f[0] * f[1] +
                         law->inverse[3] * f[1] * f[1];
        return law->size * fmax(0, sqrt(q) - 1);
    }
    case BOX:
    case INTERVAL:
    case HALF_LINE:
        for (int i = 0; i < law->dim; i++) most = fmax(most, past(f[i], law->low[i], law->high[i]));
        return most;
    case PRODUCT: return fmax(past(f[0], -law->high[0], law->high[0]), norm(2, f + 1) - law->size);
    case WHEEL: return fmax(past(f[1], -law->high[0], law->high[0]), norm(2, f) - law->size);
    default: break;
    }
    /* every side of a polygon passes through two of its points; a segment also has ends */
    for (int i = 0; i < law->points; i++)
        for (int j = 0; j < law->points; j++) {
            if (i == j) continue;
            const double *p = &law->point[2 * i], *q = &law->point[2 * j],
                         d[] = {q[0] - p[0], q[1] - p[1]};
            const double normals[][2] = {{d[1], -d[0]}, {-d[1], d[0]}, {d[0], d[1]}};
            for (int k = 0; k < 3; k++) {
                double top = -INFINITY;
                for (int l = 0; l < law->points; l++)
                    top = fmax(top, dot(2, normals[k], &law->point[2 * l]));
                most = fmax(most, (dot(2, normals[k], f) - top) / norm(2, d));
            }
        }
    return most;
}

/* ---- systems ---- */

typedef struct System {
    int n, laws, constraints, drives, components;
    bool loaded, one_sided, resistance;
    Law law[MOST_LAWS];
    double constraint[MOST_ROWS][MOST_N], drive[MOST_ROWS][MOST_N], load[MOST_N], w[MOST_ROWS];
    CpsSystem *system;
} System;

static void random_row(int n, double *row) {
    memset(row, 0, MOST_N * sizeof *row);
    for (int k = 1 + below(3); k > 0; k--) {
        const int column = below(n);
        row[column] = uniform(-1, 1);
    }
}

static int entries_of(int rows, int n, double (*row)[MOST_N], CpsEntry *entry) {
    int count = 0;
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < n; j++)
            if (row[i][j] != 0) entry[count++] = (CpsEntry){i, j, row[i][j]};
    return count;
}

static void add_laws(System *s) {
    CpsEntry entry[MOST_DIM * MOST_N];
    s->laws = 1 + below(MOST_LAWS);
    for (int k = 0; k < s->laws; k++) {
        Law *law = &s->law[k];
        const int kind = below(BESIDE);
        make_law(law, (kind == HALF_LINE || kind == BINGHAM) && below(2) ? DISC : (Kind)kind);
        s->one_sided = s->one_sided || law->kind == HALF_LINE;
        s->resistance = s->resistance || law->kind == BINGHAM;
        const bool plain = below(3) == 0 && law->dim <= s->n;
        const int first = plain ? below(s->n - law->dim + 1) : 0;
        for (int i = 0; i < law->dim; i++) {
            if (plain)
                law->map[i][first + i] = 1;
            else
                random_row(s->n, law->map[i]);
        }
        const int count = entries_of(law->dim, s->n, law->map, entry);
        if (law->resistance)
            need(cps_system_add_resistance(s->system, NULL, law->resistance, count, entry, &err),
                 "add resistance");
        else
            need(cps_system_add_friction(s->system, NULL, law->law, count, entry, &err),
                 "add friction");
        s->components += law->dim;
    }
}

/* A random V with C V = 0, and D V = 0 too where `undriven`, by removing the rows; Gram-Schmidt in
 * place */
static void admissible(const System *s, bool undriven, double *v) {
    double q[2 * MOST_ROWS][MOST_N];
    int rank = 0;
    for (int i = 0; i < s->constraints + (undriven ? s->drives : 0); i++) {
        memcpy(q[rank], i < s->constraints ? s->constraint[i] : s->drive[i - s->constraints],
               sizeof q[0]);
        const double before = norm(s->n, q[rank]);
        for (int twice = 0; twice < 2; twice++)
            for (int k = 0; k < rank; k++) {
                const double along = dot(s->n, q[rank], q[k]);
                for (int j = 0; j < s->n; j++) q[rank][j] -= along * q[k][j];
            }
        const double left = norm(s->n, q[rank]);
        if (!(left > 1e-9 * before)) continue;
        for (int j = 0; j < s->n; j++) q[rank][j] /= left;
        rank++;
    }
    for (int j = 0; j < s->n; j++) v[j] = uniform(-1, 1);
    for (int twice = 0; twice < 2; twice++)
        for (int k = 0; k < rank; k++) {
            const double along = dot(s->n, v, q[k]);
            for (int j = 0; j < s->n; j++) v[j] -= along * q[k][j];
        }
}

/* what some forces inside the sets would balance, times a factor that may be too large */
static void add_load(System *s) {
    s->loaded = true;
    const double factor = below(3) == 0 ? uniform(0.5, 5) : uniform(0.05, 0.5);
    for (int k = 0; k < s->laws; k++) {
        const Law *law = &s->law[k];
        double direction[MOST_DIM], force[MOST_DIM];
        CpsSetAnswer answer;
        for (int i = 0; i < law->dim; i++) direction[i] = uniform(-1, 1);
        if (law->kind == HALF_LINE)
            force[0] = -uniform(0, 1);
        else
            need(cps_set_support(cps_law_set(law->law), direction, force, &answer, &err),
                 "support");
        for (int i = 0; i < law->dim; i++)
            for (int j = 0; j < s->n; j++) s->load[j] -= factor * force[i] * law->map[i][j];
    }
    need(cps_system_set_load(s->system, s->load, &err), "load");
}

static void make_system(System *s) {
    CpsEntry entry[MOST_ROWS * MOST_N];
    *s = (System){.n = 1 + below(MOST_N)};
    need(cps_system_create(s->n, &s->system, &err), "create");
    add_laws(s);
    s->constraints = s->n > 2 ? below(3) : 0;
    for (int i = 0; i < s->constraints; i++) random_row(s->n, s->constraint[i]);
    if (s->constraints > 0 && below(4) == 0) { /* one of them twice */
        for (int j = 0; j < s->n; j++) s->constraint[s->constraints][j] = 2 * s->constraint[0][j];
        s->constraints++;
    }
    int count = entries_of(s->constraints, s->n, s->constraint, entry);
    need(cps_system_add_constraints(s->system, s->constraints, count, entry, &err), "constraints");
    s->drives = 1 + below(s->n < 3 ? s->n : 3);
    double v[MOST_N];
    admissible(s, false, v);
    for (int i = 0; i < s->drives; i++) {
        random_row(s->n, s->drive[i]);
        s->w[i] = dot(s->n, s->drive[i], v);
        if (fabs(s->w[i]) < 1e-12) s->w[i] = 0; /* what the constraints hold */
    }
    count = entries_of(s->drives, s->n, s->drive, entry);
    need(cps_system_set_drive(s->system, s->drives, count, entry, &err), "drive");
    if (below(3) == 0) add_load(s);
}

static void free_system(System *s) {
    for (int k = 0; k < s->laws; k++) {
        cps_law_release(s->law[k].law);
        cps_resistance_release(s->law[k].resistance);
    }
    cps_system_destroy(s->system);
}

/* ---- own arithmetic on a solution ---- */

/* sum of phi_k(B_k V) - <load, V> */
static double objective(const System *s, const double *v, double *forbidden) {
    double sum = -dot(s->n, s->load, v);
    for (int k = 0; k < s->laws; k++) {
        double u[MOST_DIM];
        for (int i = 0; i < s->law[k].dim; i++) u[i] = dot(s->n, s->law[k].map[i], v);
        sum += dissipation(&s->law[k], u, forbidden);
    }
    return sum;
}

/* largest |D V - factor W|, |C V| */
static double kinematics(const System *s, const double *v, double factor) {
    double most = 0;
    for (int i = 0; i < s->drives; i++)
        most = fmax(most, fabs(dot(s->n, s->drive[i], v) - factor * s->w[i]));
    for (int i = 0; i < s->constraints; i++)
        most = fmax(most, fabs(dot(s->n, s->constraint[i], v)));
    return most;
}

/* sum of B_k*F_k + load into r (n); F stacked */
static void gather(const System *s, const double *forces, double load, double *r) {
    for (int j = 0; j < s->n; j++) r[j] = load * s->load[j];
    for (int k = 0; k < s->laws; k++)
        for (int i = 0; i < s->law[k].dim; i++, forces++)
            for (int j = 0; j < s->n; j++) r[j] += *forces * s->law[k].map[i][j];
}

static void stack_forces(const System *s, const CpsMotion *motion, double *forces) {
    for (int k = 0; k < s->laws; k++)
        for (int i = 0; i < s->law[k].dim; i++) *forces++ = cps_motion_law_force(motion, k)[i];
}

static double largest(int n, const double *a) {
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(a[i]));
    return most;
}

static void check_solution(const System *s, const CpsMotion *motion) {
    const CpsMotionReport report = cps_motion_report(motion);
    const double *v = cps_motion_velocity(motion), *g = cps_motion_resistance(motion);
    const double *lambda = cps_motion_constraint_forces(motion);
    double forces[MOST_COMPONENTS], r[MOST_N], forbidden = 0, power = 0;
    stack_forces(s, motion, forces);
    gather(s, forces, 1, r);
    double force = fmax(largest(s->components, forces), largest(s->n, s->load));
    const double speed = largest(s->n, v);
    for (int k = 0; k < s->laws; k++)
        force = fmax(force, s->law[k].kind == HALF_LINE
                                ? 1e-6
                                : s->law[k].size); /* half-lines alone: about no force */
    for (int i = 0; i < s->drives; i++)
        for (int j = 0; j < s->n; j++) r[j] -= s->drive[i][j] * g[i];
    for (int i = 0; i < s->constraints; i++)
        for (int j = 0; j < s->n; j++) r[j] -= s->constraint[i][j] * lambda[i];
    for (int i = 0; i < s->drives; i++) power -= s->w[i] * g[i];
    const double scale = fmax(fmax(fabs(report.value), report.scale), 1e-12 * force),
                 own = objective(s, v, &forbidden);
    check("kinematics", kinematics(s, v, 1), LINEAR * speed);
    check("velocity that a half-line forbids", forbidden, GAP * speed);
    check("equilibrium", largest(s->n, r), GAP * force);
    check("upper bound below the value at V", own - report.upper, GAP * scale);
    check("upper bound above the value at V", report.upper - own, GAP * scale);
    if (!s->resistance)
        check("lower bound is not the power of G", fabs(report.lower - power), GAP * scale);
    check("bounds cross", report.lower - report.upper,
          0); /* what rounding leaves is in the bounds */
    check("gap", report.upper - report.lower, GAP * scale);
    for (int k = 0; k < s->laws; k++)
        check("outside", outside(&s->law[k], cps_motion_law_force(motion, k)),
              GAP * fmax(s->law[k].size, force));
}

/* V drives nothing and the load's power exceeds all dissipation */
static void check_no_balance(const System *s, const CpsMotion *motion) {
    const double *v = cps_motion_velocity(motion), speed = largest(s->n, v);
    double forbidden = 0;
    check("no balance: V drives", kinematics(s, v, 0), LINEAR * speed);
    check("no balance: phi(V) - <load, V> is not below 0", objective(s, v, &forbidden), 0);
    check("no balance: V is forbidden", forbidden, GAP * speed);
}

/* forces of the half-lines alone balance, and take power from W */
static void check_blocked(const System *s, const CpsMotion *motion) {
    double forces[MOST_COMPONENTS], r[MOST_N], power = 0;
    const double *g = cps_motion_resistance(motion), *lambda = cps_motion_constraint_forces(motion);
    stack_forces(s, motion, forces);
    gather(s, forces, 0, r);
    double size = largest(s->components, forces);
    for (int i = 0; i < s->drives; i++) {
        for (int j = 0; j < s->n; j++) r[j] -= s->drive[i][j] * g[i];
        power += s->w[i] * g[i];
        size = fmax(size, fabs(g[i]));
    }
    for (int i = 0; i < s->constraints; i++)
        for (int j = 0; j < s->n; j++) r[j] -= s->constraint[i][j] * lambda[i];
    check("blocked: equilibrium", largest(s->n, r), 1e-6 * size);
    check("blocked: power", power, -1e-6 * size * largest(s->drives, s->w));
    for (int k = 0, at = 0; k < s->laws; at += s->law[k++].dim)
        for (int i = 0; i < s->law[k].dim; i++) {
            const double f = forces[at + i];
            check("blocked: force", s->law[k].kind == HALF_LINE ? f : fabs(f), 1e-6 * size);
        }
}

/* Ever faster along the direction, which drives nothing, less and less is dissipated, and at every
 * speed more than gamma. */
static void check_not_attained(const System *s, const CpsMotion *motion) {
    const CpsMotionReport report = cps_motion_report(motion);
    const double *d = cps_motion_direction(motion), size = fmax(largest(s->drives, s->w), 1e-300);
    double force = 0, last = INFINITY, v[MOST_N], forbidden = 0;
    for (int k = 0; k < s->laws; k++) force = fmax(force, s->law[k].size);
    check("not attained: Proposition 1 holds", report.composition != CPS_COMPOSITION_NOT_SATISFIED,
          0);
    check("not attained: the direction drives", kinematics(s, d, 0), LINEAR);
    for (double t = 1; t <= 1e4; t *= 10) {
        for (int j = 0; j < s->n; j++)
            v[j] = cps_motion_velocity(motion)[j] +
                   t * largest(s->n, cps_motion_velocity(motion)) * d[j];
        const double now = objective(s, v, &forbidden);
        /* rounding of velocities t times as large */
        check("not attained: the value rises", now - last, 1e-12 * force * largest(s->n, v));
        check("not attained: the value falls below the bound", report.lower - now,
              GAP * force * size + 1e-12 * force * largest(s->n, v));
        last = now;
    }
}

/* ---- both propositions ---- */

static void check_reduced(const System *s, const CpsMotion *motion) {
    const CpsMotionReport report = cps_motion_report(motion);
    CpsLaw *law = NULL;
    CpsComposition composition;
    if (s->loaded || s->resistance) return; /* no law */
    /* drive rows that depend on each other are refused */
    if (cps_system_eliminate(s->system, &law, NULL, &composition, &err) != CPS_OK) return;
    const double scale = fmax(report.value, report.scale);
    CpsSetAnswer phi;
    for (int factor = 1; factor <= 2; factor++) {
        double w[MOST_ROWS];
        for (int i = 0; i < s->drives; i++) w[i] = factor * s->w[i];
        need(cps_set_dissipation(cps_law_set(law), w, NULL, &phi, &err), "dissipation");
        if (phi.outcome == CPS_SET_OUTCOME_ANSWERED)
            check("reduced law", fabs(phi.value - factor * report.value), VALUE * factor * scale);
    }
    CpsSetAnswer inside;
    need(cps_set_contains(cps_law_set(law), cps_motion_resistance(motion), NULL, &inside, &err),
         "contains");
    if (inside.outcome == CPS_SET_OUTCOME_ANSWERED)
        check("G outside the reduced law", -inside.value, VALUE * report.scale);
    cps_law_release(law);
}

/* a random point where <direction, .> is largest over the set, or one far along a ray of it */
static bool extreme(const CpsSet *set, const double *at, int n, double far, double *point) {
    double direction[MOST_COMPONENTS] = {0};
    CpsSetAnswer answer;
    for (int i = 0; i < n; i++) direction[i] = uniform(-1, 1);
    need(cps_set_support(set, direction, point, &answer, &err), "support of all solutions");
    if (answer.outcome == CPS_SET_OUTCOME_UNBOUNDED) {
        const double length = norm(n, point);
        for (int i = 0; i < n; i++) point[i] = at[i] + far * point[i] / length;
        return true;
    }
    return answer.outcome == CPS_SET_OUTCOME_ANSWERED;
}

static int asked, open, pushed;

static void check_velocities(const System *s, const CpsMotion *motion) {
    const CpsMotionReport report = cps_motion_report(motion);
    const double *v = cps_motion_velocity(motion), scale = fmax(fabs(report.value), report.scale);
    const double speed = largest(s->n, v) > 0 ? largest(s->n, v) : 1; /* at rest any size will do */
    CpsSolutionSet all;
    need(cps_motion_velocities(motion, 0, &all, NULL, NULL, &err), "all velocities");
    asked++;
    open += all.outcome != CPS_SET_OUTCOME_ANSWERED;
    if (all.set) {
        for (int t = 0; t < 3; t++) {
            double point[MOST_N], forbidden = 0;
            if (!extreme(all.set, v, s->n, speed, point)) continue;
            const double size = fmax(1, largest(s->n, point) / speed);
            check("extreme V: kinematics", kinematics(s, point, 1), PUSH * size * speed);
            check("extreme V: value", objective(s, point, &forbidden) - report.value,
                  PUSH * size * fmax(scale, 1e-9));
            check("extreme V: forbidden", forbidden, PUSH * size * speed);
        }
        for (int t = 0; t < 3; t++) {
            double other[MOST_N], forbidden = 0;
            CpsSetAnswer inside;
            admissible(s, true, other);
            /* also along one parameter alone, which often nothing resists */
            if (t > 0)
                for (int j = 0, only = below(s->n); j < s->n; j++)
                    other[j] = j == only ? other[j] : 0;
            for (int j = 0; j < s->n; j++) other[j] = v[j] + 0.1 * speed * other[j];
            if (kinematics(s, other, 1) > LINEAR * speed ||
                objective(s, other, &forbidden) > report.value)
                continue;
            if (forbidden > 0) continue;
            need(cps_set_contains(all.set, other, NULL, &inside, &err), "contains");
            if (inside.outcome == CPS_SET_OUTCOME_ANSWERED) {
                check("a V left out", -inside.value, PUSH * speed);
                pushed++;
            }
        }
    }
    cps_solution_set_clear(&all);
}

static void check_forces(const System *s, const CpsMotion *motion) {
    const CpsMotionReport report = cps_motion_report(motion);
    const double scale = fmax(fabs(report.value), report.scale), *v = cps_motion_velocity(motion);
    double at[MOST_COMPONENTS], point[MOST_COMPONENTS], r[MOST_N];
    CpsSolutionSet all;
    stack_forces(s, motion, at);
    need(cps_motion_forces(motion, 0, &all, NULL, NULL, &err), "all forces");
    asked++;
    open += all.outcome != CPS_SET_OUTCOME_ANSWERED;
    const double force = fmax(largest(s->components, at), largest(s->n, s->load));
    if (all.set)
        for (int t = 0; t < 3; t++) {
            if (!extreme(all.set, at, s->components, force, point)) continue;
            const double own = largest(s->components, point);
            for (int k = 0, i = 0; k < s->laws; i += s->law[k++].dim)
                check("extreme F: outside", outside(&s->law[k], &point[i]),
                      PUSH * fmax(own, s->law[k].size));
            /* its power is that of the motion, M77 (8) */
            gather(s, point, 1, r);
            if (!s->resistance)
                check("extreme F: power", fabs(dot(s->n, r, v) + report.value),
                      PUSH * scale * fmax(1, own / fmax(force, 1e-300)));
        }
    cps_solution_set_clear(&all);
}

/* a disc with 0 on its boundary, free to move along its normal: nothing but F = 0 balances, gamma =
 * 0 is not attained */
static void check_missed_interior(void) {
    Law law;
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    make_law(&law, BESIDE);
    need(cps_system_create(2, &system, &err), "create");
    need(cps_system_add_friction(system, "beside", law.law, 2,
                                 (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}}, &err),
         "add");
    need(cps_system_set_drive(system, 1, 1, (const CpsEntry[]){{0, 1, 1}}, &err), "drive");
    need(cps_system_solve(system, (const double[]){uniform(0.5, 2)}, NULL, &motion, &err), "solve");
    const CpsMotionReport report = cps_motion_report(motion);
    check("missed interior: composition", report.composition != CPS_COMPOSITION_NOT_SATISFIED, 0);
    check("missed interior: lower bound", report.lower, 1e-6 * law.size);
    check("missed interior: upper bound", -report.upper, 0);
    check("missed interior: attained", report.outcome != CPS_MOTION_OUTCOME_NOT_ATTAINED, 0);
    check("missed interior: no direction", largest(2, cps_motion_direction(motion)) == 0, 0);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_law_release(law.law);
}

static int count_outcome[6];

static void one_case(uint64_t number) {
    System s;
    seed = number;
    state = number * 0x2545f4914f6cdd1du + 1;
    if (below(50) == 0) {
        check_missed_interior();
        return;
    }
    make_system(&s);
    CpsMotion *motion = NULL;
    need(cps_system_solve(s.system, s.w, NULL, &motion, &err), "solve");
    const CpsMotionReport report = cps_motion_report(motion);
    count_outcome[report.outcome]++;
    switch (report.outcome) {
    case CPS_MOTION_OUTCOME_SOLVED:
    case CPS_MOTION_OUTCOME_LIMIT_LOAD:
        check_solution(&s, motion);
        check_reduced(&s, motion);
        check_velocities(&s, motion);
        check_forces(&s, motion);
        break;
    case CPS_MOTION_OUTCOME_NO_BALANCE:
        check("no balance without a load", s.loaded ? 0 : 1, 0);
        check_no_balance(&s, motion);
        break;
    case CPS_MOTION_OUTCOME_BLOCKED:
        check("blocked without a half-line", s.one_sided ? 0 : 1, 0);
        check_blocked(&s, motion);
        break;
    case CPS_MOTION_OUTCOME_NOT_ATTAINED: check_not_attained(&s, motion); break;
    case CPS_MOTION_OUTCOME_INACCURATE:
        fprintf(stderr, "seed %llu: inaccurate: gap %.3g of %.3g, composition %s\n",
                (unsigned long long)seed, report.minimum, fmax(fabs(report.value), report.scale),
                cps_composition_name(report.composition));
        failures += report.composition != CPS_COMPOSITION_NOT_SATISFIED;
        break;
    }
    cps_motion_destroy(motion);
    free_system(&s);
}

int main(int count, char **argument) {
    long cases = 500, first = 1;
    for (int i = 1; i + 1 < count; i += 2) {
        if (!strcmp(argument[i], "--cases")) cases = atol(argument[i + 1]);
        if (!strcmp(argument[i], "--seed")) first = atol(argument[i + 1]);
    }
    for (long i = 0; i < cases; i++) one_case((uint64_t)(first + i));
    printf("%ld systems: %d solved, %d at the limit, %d without balance, %d blocked, %d "
           "inaccurate, %d not attained; %d of %d sets of solutions open; %d motions found beside "
           "them; %d failures\n",
           cases, count_outcome[0], count_outcome[1], count_outcome[2], count_outcome[3],
           count_outcome[4], count_outcome[5], open, asked, pushed, failures);
    return failures > 0;
}
