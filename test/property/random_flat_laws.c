/* SPDX-License-Identifier: BSD-3-Clause */
/* Laws whose sets have no interior, tied to the parameters so that their forces do no work on what
 * is free.
 *                                                                             usage:
 *                                                                                 random_flat_laws
 *                                                                                 [--cases N]
 *                                                                                 [--seed S]
 *
 * All data are small integers, so that every rank and every value follows from exact arithmetic,
 * without the library:
 *
 *   segment   C = [a, b] with 0 in it, on U = B V. F = a + s (b - a) balances what is free, k.B*F =
 *             0 for every k of an integer
 *             basis of { D k = 0, K k = 0 }, for all s in [0, 1] or for one: gamma = largest -<B
 *                 V0, F> over these     M77 (34)
 *   disc      C = { M t : |t| <= r }, a flat disc in space or a segment in the plane: phi(U) = r
 *             |M*U|, so gamma = r times the distance of M*B V0 from the span of M*B k, by exact
 *             elimination of a Gram matrix
 *
 * The motion must be solved with bounds that hold gamma, and the reduced law must dissipate gamma
 * too. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/drive.h"
#include "random_case.h"

enum { MOST_N = 4, SPACE = 3, MOST_ROWS = 3 };

/* Of the size of W and the set: the library promises 1e-8 of it for motions, and 1e-9 with the
 * map's condition for sets. */
static const double VALUE = 1e-7;

static int failures;

/* ---- exact elimination in integers ---- */

typedef long long Integer;

static Integer divisor(Integer a, Integer b) {
    a = a < 0 ? -a : a;
    b = b < 0 ? -b : b;
    while (b) {
        const Integer rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

static void shorten(int n, Integer *row) {
    Integer common = 0;
    for (int j = 0; j < n; j++) common = divisor(common, row[j]);
    if (common > 1)
        for (int j = 0; j < n; j++) row[j] /= common;
}

/* Reduced row echelon form over the integers, each row divided by its divisor; returns the rank,
 * pivot columns in `pivot`. */
static int echelon(int rows, int n, int usable, Integer a[][MOST_N + 1], int *pivot) {
    int rank = 0;
    for (int column = 0; column < usable && rank < rows; column++) {
        int best = rank;
        while (best < rows && a[best][column] == 0) best++;
        if (best == rows) continue;
        if (best != rank)
            for (int j = 0; j < n; j++) {
                const Integer keep = a[rank][j];
                a[rank][j] = a[best][j];
                a[best][j] = keep;
            }
        for (int i = 0; i < rows; i++) {
            const Integer p = a[rank][column], q = a[i][column];
            if (i == rank || q == 0) continue;
            for (int j = 0; j < n; j++) a[i][j] = a[i][j] * p - a[rank][j] * q;
            shorten(n, a[i]);
        }
        pivot[rank++] = column;
    }
    return rank;
}

/* A system: parameters, drive and constraint rows, the map of its one law, and W. */
typedef struct Case {
    int n, drive, rows, space;
    Integer row[MOST_ROWS][MOST_N]; /* drive rows, then constraints */
    Integer map[SPACE][MOST_N];
    Integer w[MOST_ROWS]; /* W, 0 for constraints */
    int kernel;
    Integer k[MOST_N][MOST_N]; /* basis of what is free */
    double v0[MOST_N];         /* a velocity that agrees with W */
} Case;

/* The kernel and one solution; false where drive rows depend on others (no law then) or W
 * contradicts. */
static bool solve_rows(Case *c) {
    Integer a[MOST_ROWS][MOST_N + 1] = {{0}};
    int pivot[MOST_ROWS];
    for (int i = 0; i < c->rows; i++) {
        memcpy(a[i], c->row[i], sizeof c->row[i]);
        for (int j = c->n; j < MOST_N; j++) a[i][j] = 0;
        a[i][MOST_N] = c->w[i];
    }
    const int rank = echelon(c->rows, MOST_N + 1, c->n, a, pivot);
    if (rank < c->rows) return false;
    memset(c->v0, 0, sizeof c->v0);
    for (int i = 0; i < rank; i++) c->v0[pivot[i]] = (double)a[i][MOST_N] / (double)a[i][pivot[i]];
    c->kernel = 0;
    for (int f = 0; f < c->n; f++) {
        bool is_pivot = false;
        Integer *k = c->k[c->kernel], common = 1;
        for (int i = 0; i < rank; i++) {
            is_pivot = is_pivot || pivot[i] == f;
            common = common / divisor(common, a[i][pivot[i]]) * a[i][pivot[i]];
        }
        if (is_pivot) continue;
        memset(k, 0, MOST_N * sizeof *k);
        k[f] = common;
        for (int i = 0; i < rank; i++) k[pivot[i]] = -common / a[i][pivot[i]] * a[i][f];
        shorten(MOST_N, k);
        c->kernel++;
    }
    return true;
}

/* B k, exact; B V0 */
static void carry(const Case *c, const Integer *v, Integer *u) {
    for (int i = 0; i < c->space; i++) {
        u[i] = 0;
        for (int j = 0; j < c->n; j++) u[i] += c->map[i][j] * v[j];
    }
}

static void make_case(Case *c) {
    *c = (Case){.n = 1 + below(MOST_N)};
    c->drive = 1 + below(2);
    c->space = 2 + below(2);
    c->rows = c->drive + below(2);
    for (int i = 0; i < c->rows; i++)
        for (int j = 0; j < c->n; j++) c->row[i][j] = below(3) ? digit(2) : 0;
    for (int i = 0; i < c->space; i++)
        for (int j = 0; j < c->n; j++) c->map[i][j] = below(3) ? digit(2) : 0;
    for (int i = 0; i < c->drive; i++) c->w[i] = digit(3);
}

/* gamma of the segment from -low e to high e, low, high >= 0 */
static double segment_gamma(const Case *c, const Integer *e, int low, int high, double size) {
    Integer u[SPACE];
    double power = 0;
    for (int i = 0; i < c->space; i++)
        for (int j = 0; j < c->n; j++)
            power -= size * (double)e[i] * (double)c->map[i][j] * c->v0[j];
    for (int k = 0; k < c->kernel; k++) {
        Integer work = 0;
        carry(c, c->k[k], u);
        for (int i = 0; i < c->space; i++) work += e[i] * u[i];
        if (work != 0) return 0; /* only F = 0 balances what is free */
    }
    return fmax(-low * power, high * power);
}

/* gamma of { M t : |t| <= r }, M (space, columns): r times a distance, by Gram-Schmidt in long
 * double on vectors of small integers, their dependence decided by exact elimination. */
static double disc_gamma(const Case *c, int columns, Integer m[SPACE][2], double r) {
    Integer span[MOST_N][MOST_N + 1] = {{0}}, u[SPACE];
    int pivot[MOST_N];
    for (int k = 0; k < c->kernel; k++) {
        carry(c, c->k[k], u);
        for (int t = 0; t < columns; t++)
            for (int i = 0; i < c->space; i++) span[k][t] += m[i][t] * u[i];
    }
    const int rank = echelon(c->kernel, MOST_N + 1, columns, span, pivot);
    double start[2] = {0};
    for (int t = 0; t < columns; t++)
        for (int i = 0; i < c->space; i++)
            for (int j = 0; j < c->n; j++)
                start[t] += (double)m[i][t] * (double)c->map[i][j] * c->v0[j];
    if (rank >= columns) return 0;
    if (rank == 0) return r * hypot(start[0], columns > 1 ? start[1] : 0);
    /* the one direction left is across the span */
    const double x = (double)span[0][0], y = (double)span[0][1];
    return r * fabs(start[0] * y - start[1] * x) / hypot(x, y);
}

static CpsSystem *make_system(const Case *c, const CpsLaw *law) {
    CpsSystem *system = NULL;
    CpsEntry entry[SPACE * MOST_N];
    int count = 0;
    need(cps_system_create(c->n, &system, &err), "system");
    for (int i = 0; i < c->space; i++)
        for (int j = 0; j < c->n; j++)
            if (c->map[i][j]) entry[count++] = (CpsEntry){i, j, (double)c->map[i][j]};
    need(cps_system_add_friction(system, "flat", law, count, entry, &err), "friction");
    for (int part = 0; part < 2; part++) {
        const int from = part ? c->drive : 0, to = part ? c->rows : c->drive;
        count = 0;
        for (int i = from; i < to; i++)
            for (int j = 0; j < c->n; j++)
                if (c->row[i][j]) entry[count++] = (CpsEntry){i - from, j, (double)c->row[i][j]};
        if (part && to > from)
            need(cps_system_add_constraints(system, to - from, count, entry, &err), "constraints");
        if (!part) need(cps_system_set_drive(system, to - from, count, entry, &err), "drive");
    }
    return system;
}

static void fail(const char *what, double got, double expected) {
    fprintf(stderr, "seed %llu: %s: %.15g, expected %.15g\n", (unsigned long long)seed, what, got,
            expected);
    failures++;
}

static void compare(const Case *c, const CpsLaw *law, double gamma, double size) {
    double w[MOST_ROWS], most = 1;
    for (int i = 0; i < c->drive; i++) {
        w[i] = (double)c->w[i];
        most = fmax(most, fabs(w[i]));
    }
    for (int j = 0; j < c->n; j++) most = fmax(most, fabs(c->v0[j]));
    const double allowed = VALUE * size * most;
    CpsSystem *system = make_system(c, law);
    CpsMotion *motion = NULL;
    need(cps_system_solve(system, w, NULL, &motion, &err), "solve");
    const CpsMotionReport report = cps_motion_report(motion);
    if (report.outcome != CPS_MOTION_OUTCOME_SOLVED)
        fail("outcome", report.outcome, CPS_MOTION_OUTCOME_SOLVED);
    else if (!(fabs(report.value - gamma) <= allowed))
        fail("gamma of the motion", report.value, gamma);
    if (!(report.lower <= gamma + allowed && report.upper >= gamma - allowed))
        fail("bounds, lower", report.lower, gamma);
    CpsSet *forces = NULL;
    need(cps_system_eliminate(system, NULL, &forces, NULL, &err), "eliminate");
    CpsSetAnswer phi;
    for (int i = 0; i < c->drive; i++) w[i] = -w[i];
    need(cps_set_support(forces, w, NULL, &phi, &err), "support");
    if (phi.outcome != CPS_SET_OUTCOME_ANSWERED)
        fail("outcome of the reduced law", phi.outcome, CPS_SET_OUTCOME_ANSWERED);
    else if (!(fabs(phi.value - gamma) <= allowed))
        fail("gamma of the reduced law", phi.value, gamma);
    cps_set_release(forces);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
}

static CpsLaw *friction(CpsSet *set) {
    CpsLaw *law = NULL;
    need(cps_law_friction(set, &law, &err), "law");
    cps_set_release(set);
    return law;
}

static void try_segment(const Case *c) {
    static const double SIZE[] = {1e-3, 1, 500};
    Integer e[SPACE];
    CpsSet *set = NULL;
    double ends[2 * SPACE];
    const double size = SIZE[below(3)];
    const int low = below(3), high = below(3);
    for (int i = 0; i < c->space; i++) {
        e[i] = digit(3);
        ends[i] = -size * low * (double)e[i];
        ends[c->space + i] = size * high * (double)e[i];
    }
    need(cps_set_hull_of_points(c->space, 2, ends, &set, &err), "segment");
    CpsLaw *law = friction(set);
    compare(c, law, segment_gamma(c, e, low, high, size), 10 * size);
    cps_law_release(law);
}

static void try_disc(const Case *c) {
    static const double SIZE[] = {1e-3, 1, 500};
    const int columns = c->space - 1;
    const double r = SIZE[below(3)], centre[2] = {0, 0};
    Integer m[SPACE][2] = {{0}};
    double map[SPACE * 2];
    for (int i = 0; i < c->space; i++)
        for (int t = 0; t < columns; t++) map[i * columns + t] = (double)(m[i][t] = digit(2));
    CpsSet *ball = NULL, *flat = NULL;
    need(cps_set_ball(columns, centre, r, &ball, &err), "ball");
    need(cps_set_image(c->space, map, ball, &flat, &err), "image");
    cps_set_release(ball);
    CpsLaw *law = friction(flat);
    compare(c, law, disc_gamma(c, columns, m, r), 10 * r);
    cps_law_release(law);
}

int main(int argc, char **argv) {
    int cases = 1000;
    uint64_t first = 1;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--cases")) cases = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--seed")) first = strtoull(argv[i + 1], NULL, 10);
    }
    int tried = 0;
    for (seed = first; tried < cases; seed++) {
        Case c;
        state = seed * 0x9e3779b97f4a7c15u;
        make_case(&c);
        if (!solve_rows(&c)) continue;
        tried++;
        if (below(2))
            try_segment(&c);
        else
            try_disc(&c);
    }
    printf("%d flat laws, %d wrong\n", tried, failures);
    return failures > 0;
}
