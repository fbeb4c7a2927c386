/* SPDX-License-Identifier: BSD-3-Clause */
/* Random resistance laws: what must hold of every one.
 *     usage: random_resistances [--cases N]
 *
 * A law is a sum of one to four terms in up to 6 components: dry, viscous, powers of degree 1.1 to
 * 6, tables and functions, on balls, ellipsoids, boxes, products, preimages and sums of such sets.
 * Potential and power are computed a second time here, from the sets' own formulas. With F a force
 * of the law at V, and U the velocity answered for F:
 *
 *   - phi and power of each term; power = degree x phi for powers; power >= phi >= 0
 *   - <V, F> = -power, at the middle of the set of forces
 *   - the forces at two velocities: <V1 - V2, F1 - F2> <= 0
 *   - phi(V) + phi*(-F) + <V, F> = 0, and the same with U: phi recomputed here, so that the answer
 *       is proved to be one
 *   - phi*(-F) >= -<W, F> - phi(W) for other velocities W, and F close to the forces at U where
 *       those are one point
 *   - the same for forces that are no law's force at a known velocity; "none" only where phi grows
 *       no faster than g
 *
 * A question may end without an answer, but not more often than MOST_OPEN. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/law.h"
#include "splitmix.h"

enum { MOST_SPACE = 6, MOST_TERMS = 4, MOST_POINTS = 5 };

/* phi and power of one term, relative: rounding of products of tens of numbers, and of powers up to
 * the sixth. */
static const double ROUNDING = 1e-12;

/* Powers relative to phi + phi*: what conjugates and faces promise is 1e-9, of which a check adds
 * two or three. */
static const double PROMISE = 4e-9;

/* [W] Rounding where a force is the middle of a set round 0: 1e-16 of the set's size, at speeds up
 * to 10. Below SMALL a velocity is told from rest by nothing. */
static const double TINY = 1e-14, SMALL = 1e-6;

/* Distance of F from the one force at U, relative. phi is quadratic near U on the sets used, and
 * their radii of curvature differ by up to 1e3: a gap of PROMISE moves U by its root. A wrong
 * velocity is off by order 1. */
static const double ROOT = 1e-2;

/* The share of questions that may stay open, in per cent (issue: at least 98 % answered). */
static const double MOST_OPEN = 2;

/* ---- random numbers: splitmix64 ---- */

static uint64_t state, seed;
static int failures, questions, open;

static double uniform(double low, double high) { return splitmix(&state, low, high); }

static int below(int bound) { return (int)uniform(0, bound); }

static void fill(int count, double low, double high, double *a) {
    for (int i = 0; i < count; i++) a[i] = uniform(low, high);
}

static void need(CpsStatus status, const CpsError *err, const char *call) {
    if (status == CPS_OK) return;
    fprintf(stderr, "seed %llu: %s: %s: %s\n", (unsigned long long)seed, call,
            cps_status_text(status), err->message);
    exit(1);
}

static double dot(int n, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* ---- sets and their support functions, a second time ---- */

typedef enum ShapeKind { BALL, ELLIPSOID, BOX, PRODUCT, PREIMAGE, SUM, SHAPES } ShapeKind;

typedef struct Shape {
    ShapeKind kind;
    int n;
    double centre[MOST_SPACE], low[MOST_SPACE], high[MOST_SPACE], radius;
    double matrix[MOST_SPACE * MOST_SPACE]; /* ellipsoid: shape; preimage: the inverse of the map */
    struct Shape *part[2];
} Shape;

static double support(const Shape *s, const double *w) {
    const int n = s->n;
    double sum = 0, turned[MOST_SPACE];
    switch (s->kind) {
    case BALL: return dot(n, s->centre, w) + s->radius * sqrt(dot(n, w, w));
    case ELLIPSOID:
        for (int i = 0; i < n; i++) sum += w[i] * dot(n, s->matrix + i * n, w);
        return sqrt(sum);
    case BOX:
        for (int i = 0; i < n; i++) sum += w[i] > 0 ? w[i] * s->high[i] : w[i] * s->low[i];
        return sum;
    case PRODUCT: return support(s->part[0], w) + support(s->part[1], w + s->part[0]->n);
    case PREIMAGE: /* h(w) = h_C(L^-1* w) */
        for (int j = 0; j < n; j++) {
            turned[j] = 0;
            for (int i = 0; i < n; i++) turned[j] += s->matrix[i * n + j] * w[i];
        }
        return support(s->part[0], turned);
    case SUM: return support(s->part[0], w) + support(s->part[1], w);
    default: return NAN;
    }
}

/* has every direction one point of support, with 0 inside? */
static bool is_round(const Shape *s) {
    if (s->kind == PREIMAGE) return is_round(s->part[0]);
    if (s->kind == SUM) return is_round(s->part[0]) || is_round(s->part[1]);
    return s->kind == ELLIPSOID || s->kind == BALL || (s->kind == PRODUCT && s->n == 1);
}

static void free_shape(Shape *s) {
    if (!s) return;
    for (int k = 0; k < 2; k++) free_shape(s->part[k]);
    free(s);
}

/* A = Q diag Q' + .. is not needed: I + a small matrix has a safe inverse, by Gauss and Jordan */
static void random_map(int n, double *map, double *inverse) {
    double work[MOST_SPACE][2 * MOST_SPACE];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            map[i * n + j] = uniform(-1, 1) * 0.7 / n;
            if (i == j) map[i * n + j] += uniform(0.8, 1.5);
            work[i][j] = map[i * n + j];
            work[i][n + j] = i == j;
        }
    for (int k = 0; k < n; k++) {
        const double pivot = work[k][k]; /* the diagonal dominates */
        for (int j = 0; j < 2 * n; j++) work[k][j] /= pivot;
        for (int i = 0; i < n; i++) {
            const double factor = i == k ? 0 : work[i][k];
            for (int j = 0; j < 2 * n; j++) work[i][j] -= factor * work[k][j];
        }
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) inverse[i * n + j] = work[i][n + j];
}

/* A A' + 0.1 I, times a size */
static void random_definite(int n, double size, double *matrix) {
    double a[MOST_SPACE * MOST_SPACE];
    fill(n * n, -1, 1, a);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            matrix[i * n + j] = i == j ? 0.1 * size : 0;
            for (int k = 0; k < n; k++) matrix[i * n + j] += size * a[i * n + k] * a[j * n + k];
        }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) matrix[i * n + j] = matrix[j * n + i];
}

static Shape *random_shape(int n, int depth, CpsSet **set) {
    Shape *s = calloc(1, sizeof *s);
    CpsSet *part[2] = {NULL};
    CpsError err;
    if (!s) exit(1);
    *s = (Shape){.kind = (ShapeKind)below(depth > 0 ? SHAPES : PRODUCT), .n = n};
    if (s->kind == PRODUCT && n == 1) s->kind = BOX;
    switch (s->kind) {
    case BALL:
        s->radius = uniform(0.2, 3);
        if (below(3) == 0) fill(n, -0.3 * s->radius, 0.3 * s->radius, s->centre);
        need(cps_set_ball(n, s->centre, s->radius, set, &err), &err, "ball");
        break;
    case ELLIPSOID:
        random_definite(n, uniform(0.2, 4), s->matrix);
        need(cps_set_ellipsoid(n, NULL, s->matrix, set, &err), &err, "ellipsoid");
        break;
    case BOX:
        fill(n, -3, -0.2, s->low);
        fill(n, 0.2, 3, s->high);
        need(cps_set_box(n, s->low, s->high, set, &err), &err, "box");
        break;
    case PRODUCT: {
        const int first = 1 + below(n - 1);
        s->part[0] = random_shape(first, depth - 1, &part[0]);
        s->part[1] = random_shape(n - first, depth - 1, &part[1]);
        need(cps_set_product(2, (const CpsSet *const *)part, set, &err), &err, "product");
        break;
    }
    case PREIMAGE: {
        double map[MOST_SPACE * MOST_SPACE];
        random_map(n, map, s->matrix);
        s->part[0] = random_shape(n, depth - 1, &part[0]);
        need(cps_set_preimage(n, map, NULL, part[0], set, &err), &err, "preimage");
        break;
    }
    default:
        for (int k = 0; k < 2; k++) s->part[k] = random_shape(n, depth - 1, &part[k]);
        need(cps_set_sum(2, (const CpsSet *const *)part, set, &err), &err, "sum");
    }
    for (int k = 0; k < 2; k++) cps_set_release(part[k]);
    return s;
}

/* ---- terms ---- */

typedef enum TermKind { DRY, VISCOUS, POWER, TABLE, STEEP, BENT, LOGARITHM, TERMS } TermKind;

typedef struct Term {
    TermKind kind;
    Shape *shape;
    double degree, factor, width;
    double matrix[MOST_SPACE * MOST_SPACE];
    int count;
    double speed[MOST_POINTS], slope[MOST_POINTS];
} Term;

typedef struct Case {
    int n, count;
    Term term[MOST_TERMS];
    CpsResistance *law;
    bool bounded; /* phi grows no faster than its sets' g: some forces go with no velocity */
    bool one;     /* at V other than 0 there is one force */
} Case;

/* steep: c (cosh(g/w) - 1); bent: c (sqrt(w^2 + g^2) - w), whose slope stays below c; logarithm: c
 * g log(1 + g/w) */
static bool steep(void *user, double g, double *value, double *slope) {
    const Term *t = user;
    const double half = sinh(0.5 * g / t->width);
    *value = 2 * t->factor * half * half;
    *slope = t->factor / t->width * sinh(g / t->width);
    return true;
}

static bool steep_conjugate(void *user, double s, double *value, double *g) {
    const Term *t = user;
    const double sine = s * t->width / t->factor;
    *g = t->width * asinh(sine);
    *value = s * *g - t->factor * sine * sine / (1 + sqrt(1 + sine * sine));
    return true;
}

static bool bent(void *user, double g, double *value, double *slope) {
    const Term *t = user;
    const double root = hypot(t->width, g);
    *value = t->factor * g * (g / (root + t->width));
    *slope = t->factor * g / root;
    return true;
}

static bool logarithm(void *user, double g, double *value, double *slope) {
    const Term *t = user;
    const double log_of = log1p(g / t->width);
    *value = t->factor * g * log_of;
    *slope = t->factor * (log_of + g / (t->width + g));
    return true;
}

/* phi and power of a term at V, by this file's formulas */
static void evaluate(int n, const Term *t, const double *velocity, double *phi, double *power) {
    double opposite[MOST_SPACE], slope = 0;
    for (int i = 0; i < n; i++) opposite[i] = -velocity[i];
    const double g = t->shape ? fmax(support(t->shape, opposite), 0) : 0;
    *phi = g;
    *power = 0;
    switch (t->kind) {
    case DRY: *power = g; return;
    case VISCOUS:
        for (int i = 0; i < n; i++) *power += velocity[i] * dot(n, t->matrix + i * n, velocity);
        *phi = *power / 2;
        return;
    case POWER:
        *power = t->factor * pow(g, t->degree);
        *phi = *power / t->degree;
        return;
    case TABLE: {
        int k = 0;
        for (*phi = 0; k + 1 < t->count && t->speed[k + 1] < g; k++)
            *phi += (t->speed[k + 1] - t->speed[k]) * (t->slope[k + 1] + t->slope[k]) / 2;
        slope = t->slope[k];
        if (k + 1 < t->count)
            slope += (g - t->speed[k]) * (t->slope[k + 1] - t->slope[k]) /
                     (t->speed[k + 1] - t->speed[k]);
        *phi += (g - t->speed[k]) * (slope + t->slope[k]) / 2;
        break;
    }
    case STEEP: (void)steep((void *)t, g, phi, &slope); break;
    case BENT: (void)bent((void *)t, g, phi, &slope); break;
    default: (void)logarithm((void *)t, g, phi, &slope);
    }
    *power = g * slope;
}

static double potential(const Case *c, const double *velocity) {
    double sum = 0, phi, power;
    for (int i = 0; i < c->count; i++) {
        evaluate(c->n, &c->term[i], velocity, &phi, &power);
        sum += phi;
    }
    return sum;
}

static CpsResistance *random_term(int n, Term *t) {
    CpsError err;
    CpsResistance *out = NULL;
    CpsLaw *law = NULL;
    CpsSet *set = NULL;
    *t = (Term){.kind = (TermKind)below(TERMS)};
    t->degree = uniform(1.1, 6);
    t->factor = exp(uniform(-3, 3));
    t->width = uniform(0.5, 5);
    if (t->kind == VISCOUS) {
        random_definite(n, t->factor, t->matrix);
        need(cps_resistance_viscous(n, t->matrix, &out, &err), &err, "viscous");
        return out;
    }
    t->shape = random_shape(n, below(3), &set);
    need(cps_law_friction(set, &law, &err), &err, "friction");
    switch (t->kind) {
    case DRY: need(cps_resistance_dry(law, &out, &err), &err, "dry"); break;
    case POWER:
        need(cps_resistance_power(law, t->degree, t->factor, &out, &err), &err, "power");
        break;
    case TABLE: /* with level pieces, and rest that bears no force */
        t->count = 1 + below(MOST_POINTS);
        t->slope[0] = below(2) ? uniform(0.1, 1) : 0;
        for (int i = 1; i < t->count; i++) {
            t->speed[i] = t->speed[i - 1] + uniform(0.1, 2);
            t->slope[i] = t->slope[i - 1] + (below(4) ? uniform(0.1, 2) : 0);
        }
        need(cps_resistance_table(law, t->count, t->speed, t->slope, &out, &err), &err, "table");
        break;
    case STEEP:
        need(cps_resistance_function(law, steep, below(2) ? steep_conjugate : NULL, t, &out, &err),
             &err, "steep");
        break;
    case BENT: need(cps_resistance_function(law, bent, NULL, t, &out, &err), &err, "bent"); break;
    default: need(cps_resistance_function(law, logarithm, NULL, t, &out, &err), &err, "logarithm");
    }
    cps_law_release(law);
    cps_set_release(set);
    return out;
}

static void make_case(Case *c) {
    CpsResistance *part[MOST_TERMS] = {NULL};
    CpsError err;
    *c = (Case){.n = 1 + below(MOST_SPACE), .bounded = true, .one = true};
    c->count = 1 + below(1 + below(MOST_TERMS));
    for (int i = 0; i < c->count; i++) {
        Term *t = &c->term[i];
        part[i] = random_term(c->n, t);
        c->bounded = c->bounded && (t->kind == DRY || t->kind == TABLE || t->kind == BENT);
        c->one = c->one && (t->kind == VISCOUS || is_round(t->shape));
    }
    need(cps_resistance_sum(c->count, (const CpsResistance *const *)part, &c->law, &err), &err,
         "sum of terms");
    for (int i = 0; i < c->count; i++) cps_resistance_release(part[i]);
}

static void free_case(Case *c) {
    for (int i = 0; i < c->count; i++) free_shape(c->term[i].shape);
    cps_resistance_release(c->law);
}

/* ---- what must hold ---- */

static void fault(const Case *c, const char *what, double got, double bound) {
    static const char *const NAME[] = {"dry",   "viscous", "power",    "table",
                                       "steep", "bent",    "logarithm"};
    fprintf(stderr, "seed %llu: %s: %.3g, allowed %.3g; n = %d:", (unsigned long long)seed, what,
            got, bound, c->n);
    for (int i = 0; i < c->count; i++) fprintf(stderr, " %s", NAME[c->term[i].kind]);
    fprintf(stderr, "\n");
    failures++;
}

/* written so that NaN is a fault */
static void check(const Case *c, const char *what, double got, double bound) {
    if (!(got <= bound)) fault(c, what, got, bound);
}

static bool is_answered(CpsSetOutcome outcome) {
    questions++;
    open += outcome != CPS_SET_OUTCOME_ANSWERED;
    return outcome == CPS_SET_OUTCOME_ANSWERED;
}

static void random_velocity(int n, double *velocity) {
    const double size = exp(uniform(-3, 2));
    fill(n, -size, size, velocity);
    if (below(3) == 0) /* edges and corners of boxes */
        for (int i = 0; i < n; i++) velocity[i] *= below(2);
}

/* term by term; writes phi(V) and the power */
static bool check_value(const Case *c, const double *velocity, double *phi, double *power) {
    CpsResistanceValue whole, by_term[MOST_TERMS];
    CpsError err;
    need(cps_resistance_value(c->law, velocity, &whole, by_term, &err), &err, "value");
    *phi = *power = 0;
    if (!is_answered(whole.outcome)) return false;
    for (int i = 0; i < c->count; i++) {
        double own_phi, own_power;
        evaluate(c->n, &c->term[i], velocity, &own_phi, &own_power);
        const double closed = ROUNDING * own_power + whole.gap + 1e-300;
        /* conic supports are right to 1e-9; a power's degree multiplies that */
        const double slack = whole.gap > 0 ? 6 * PROMISE * own_power + closed : closed;
        check(c, "phi of a term", fabs(by_term[i].potential - own_phi), slack);
        check(c, "power of a term", fabs(by_term[i].power - own_power), slack);
        check(c, "phi below 0", -by_term[i].potential, 0);
        check(c, "phi above power", by_term[i].potential - by_term[i].power, slack);
        if (c->term[i].kind == POWER)
            check(c, "power less degree x phi",
                  fabs(by_term[i].power - c->term[i].degree * by_term[i].potential), slack);
        *phi += own_phi;
        *power += own_power;
    }
    return true;
}

/* a force of the law at V */
static bool force_at(const Case *c, const double *velocity, double power, double *force) {
    CpsError err;
    CpsSetAnswer answer;
    CpsSetFacts facts = {.outcome = CPS_SET_OUTCOME_INACCURATE};
    CpsSet *forces = NULL;
    need(cps_resistance_forces(c->law, velocity, 0, &forces, &answer, &err), &err, "forces");
    if (forces) need(cps_set_facts(forces, 0, &facts, force, NULL, &err), &err, "facts");
    cps_set_release(forces);
    if (!is_answered(facts.outcome)) return false;
    const double slack =
        PROMISE * (power + sqrt(dot(c->n, velocity, velocity) * dot(c->n, force, force)));
    check(c, "<V, F> + power", fabs(dot(c->n, velocity, force) + power), slack);
    return true;
}

/* the conjugate at F, proved by its velocity; scale of the powers to *scale */
static bool check_conjugate(const Case *c, const double *force, double *value, double *scale) {
    const int n = c->n;
    double velocity[MOST_SPACE], other[MOST_SPACE], gap, distance;
    CpsSetAnswer answer;
    CpsError err;
    need(cps_resistance_conjugate(c->law, force, velocity, &answer, &err), &err, "conjugate");
    if (answer.outcome == CPS_SET_OUTCOME_OUTSIDE && c->bounded) { /* a good answer */
        questions++;
        check(c, "a value outside", -answer.value, -1e300);
        return false;
    }
    if (!is_answered(answer.outcome)) return false;
    const double phi = potential(c, velocity), along = dot(n, velocity, force);
    *value = answer.value;
    *scale = phi + answer.value;
    check(c, "phi*(-F) below 0", -answer.value, 0);
    const double slack = PROMISE * *scale + TINY;
    check(c, "gap of the velocity answered", fabs(phi + answer.value + along), slack);
    check(c, "gap reported", answer.gap, slack);
    for (int k = 0; k < 3; k++) {
        random_velocity(n, other);
        if (k == 2)
            for (int i = 0; i < n; i++) other[i] = velocity[i] * (1 + 0.1 * other[i]);
        const double bound = -dot(n, other, force) - potential(c, other);
        check(c, "phi*(-F) below its bound", bound - answer.value, slack);
    }
    if (!c->one || !(*scale > SMALL)) return true;
    need(cps_resistance_residual(c->law, force, velocity, &gap, &distance, &err), &err, "residual");
    if (!is_answered(isnan(gap) || isnan(distance) ? CPS_SET_OUTCOME_INACCURATE
                                                   : CPS_SET_OUTCOME_ANSWERED))
        return true;
    check(c, "residual gap", fabs(gap), slack);
    check(c, "F from the forces at its velocity", distance, ROOT * sqrt(dot(n, force, force)));
    return true;
}

static void check_case(uint64_t number) {
    seed = number;
    state = number * 0x2545f4914f6cdd1du + 1;
    Case c;
    make_case(&c);
    double velocity[2][MOST_SPACE], force[2][MOST_SPACE], phi[2], power[2], value, scale;
    bool known = true;
    for (int k = 0; k < 2; k++) {
        random_velocity(c.n, velocity[k]);
        known = check_value(&c, velocity[k], &phi[k], &power[k]) &&
                force_at(&c, velocity[k], power[k], force[k]) && known;
    }
    if (known) {
        double sum = 0, size = 0;
        for (int i = 0; i < c.n; i++) {
            sum += (velocity[0][i] - velocity[1][i]) * (force[0][i] - force[1][i]);
            size += fabs(velocity[0][i] - velocity[1][i]) * (fabs(force[0][i]) + fabs(force[1][i]));
        }
        check(&c, "forces that grow with the velocity", sum, PROMISE * size);
        if (check_conjugate(&c, force[0], &value, &scale))
            check(&c, "Fenchel gap of V and its force",
                  fabs(phi[0] + value + dot(c.n, velocity[0], force[0])),
                  PROMISE * (phi[0] + value) + TINY);
    }
    /* a force of no known velocity */
    const double size = exp(uniform(-2, 2));
    fill(c.n, -size, size, force[0]);
    (void)check_conjugate(&c, force[0], &value, &scale);
    free_case(&c);
}

int main(int argc, char **argv) {
    int cases = 500, first = 1;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--cases") == 0) cases = atoi(argv[i + 1]);
        if (strcmp(argv[i], "--first") == 0) first = atoi(argv[i + 1]);
    }
    for (int i = 0; i < cases; i++) check_case((uint64_t)(first + i));
    const double share = 100.0 * open / (questions > 0 ? questions : 1);
    printf("%d laws, %d questions, %d (%.2f %%) without an answer, %d faults\n", cases, questions,
           open, share, failures);
    return cases < 1 || failures > 0 || !(share <= MOST_OPEN);
}
