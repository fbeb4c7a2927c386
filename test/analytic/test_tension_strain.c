/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines whose tension is a table of the strain (docs/theory.md 1).
 *
 * The answers are read from the table by interpolation, its last slope beyond it, and its inverse.
 * A hanging line has the horizontal force H along it and the vertical force V - w s at the length s
 * below its upper end, so with T = sqrt(H^2 + (V - w s)^2) and the strain f(T) of the table
 *
 *     x = int H/T (1 + f) ds,    z = int (V - w s)/T (1 + f) ds
 *
 * by Gauss's rule on short pieces between the tensions of the rows; H and V by Newton's method. */
#include <stdio.h>
#include <stdlib.h>

#include "cases.h"

enum { MOST_ROWS = 12 };

typedef struct Table {
    int rows;
    CpsStiffnessRow row[MOST_ROWS];
} Table;

static double interpolate(int rows, const double *x, const double *y, double at) {
    int i = 1;
    while (i + 1 < rows && at > x[i]) i++;
    return y[i - 1] + (at - x[i - 1]) * ((y[i] - y[i - 1]) / (x[i] - x[i - 1]));
}

static double strain_of(const Table *t, double tension) {
    double x[MOST_ROWS], y[MOST_ROWS];
    for (int i = 0; i < t->rows; i++) {
        x[i] = t->row[i].tension;
        y[i] = t->row[i].strain;
    }
    return interpolate(t->rows, x, y, tension);
}

static double tension_of(const Table *t, double strain) {
    double x[MOST_ROWS], y[MOST_ROWS];
    for (int i = 0; i < t->rows; i++) {
        x[i] = t->row[i].strain;
        y[i] = t->row[i].tension;
    }
    return interpolate(t->rows, x, y, strain);
}

static void use(Case *c, const Table *t) {
    c->line.stiffness = -7; /* is not read */
    c->line.stiffness_row_count = t->rows;
    c->line.stiffness_row = t->row;
}

/* Of nylon: soft, then five and then twenty times as stiff; two rows on one slope. */
static const Table NYLON = {5, {{0, 0}, {0.02, 2e4}, {0.05, 5e4}, {0.1, 3e5}, {0.15, 1.3e6}}};

/* A line without weight, pulled to tensions in each piece, at the corners, beyond the last row,
 * down again and slack; then moved to the same lengths. In one step and in warm ones. */
static void pulled_straight(void **state) {
    (void)state;
    static const double PULL[] = {1e4, 2e4, 5e4, 5.0001e4, 2e5, 1.2e6, 4e6, 1e5, 1, 3e4};
    enum { PULLS = sizeof PULL / sizeof *PULL, N = 8 };
    static Case c;
    double worst = 0;
    case_begin(&c, 200, N, 0, 1);
    case_straight(&c, 0, 200);
    use(&c, &NYLON);
    for (int k = 0; k < PULLS; k++) case_force(&c, k % 2 ? 3 : 1, PULL[k], 0, 0);
    Run run = case_open(&c);
    for (int k = 0; k < PULLS; k++) {
        CpsLineView view = {0};
        for (int i = 0; i < (k % 2 ? 3 : 1); i++) view = case_step(&run);
        const double length = 200 * (1 + strain_of(&NYLON, PULL[k]));
        worst = fmax(worst, fabs(view.position[3 * N] - length));
        CHECK_NEAR(view.position[3 * N], length, 200 * 1e-10);
        for (int e = 0; e < N; e++) CHECK_RELATIVE(view.tension[e], PULL[k], 1e-9);
        for (int e = 0; e < N; e++) CHECK_RELATIVE(view.segment_force[3 * e], PULL[k], 1e-12);
    }
    case_close(&run);
    case_begin(&c, 200, N, 0, 1);
    case_straight(&c, 0, 200);
    use(&c, &NYLON);
    for (int k = 0; k < PULLS; k++) case_move(&c, 2, 200 * (1 + strain_of(&NYLON, PULL[k])), 0, 0);
    run = case_open(&c);
    double force = 0, energy = 0;
    for (int k = 0; k < PULLS; k++) {
        for (int i = 0; i < 2; i++) {
            (void)case_step(&run);
            energy += cps_evolution_line_report(run.evolution, 0).ledger.elastic;
        }
        const double found = cps_evolution_line_report(run.evolution, 0).end[CPS_END_B].force[0];
        /* a position is known to its last bits, which are strain: 1e-15 times the slope 2e7 N */
        CHECK_NEAR(found, PULL[k], 1e-9 * PULL[k] + 1e-6);
        force = fmax(force, fabs(found / PULL[k] - 1));
        /* the area under the table up to this strain */
        double area = 0, from = 0, last = 0;
        const double to = strain_of(&NYLON, PULL[k]);
        for (int i = 1; i <= NYLON.rows && from < to; i++) {
            const double next = i < NYLON.rows ? fmin(NYLON.row[i].strain, to) : to,
                         above = tension_of(&NYLON, next);
            area += 0.5 * (last + above) * (next - from);
            from = next;
            last = above;
        }
        CHECK_NEAR(energy, 200 * area, 1e-9 * 200 * area + 1e-6);
    }
    case_close(&run);
    show("table, pulled straight", "length at B, worst error [m]", 0, worst);
    show("table, moved straight", "force at B, worst relative error", 0, force);
}

/* One piece is a stiffness. */
static void two_rows_are_a_stiffness(void **state) {
    (void)state;
    static const Table LINEAR[2] = {{2, {{0, 0}, {0.01, 1e4}}},
                                    {4, {{0, 0}, {0.01, 1e4}, {0.02, 2e4}, {0.3, 3e5}}}};
    enum { N = 40 };
    double place[3][3 * (N + 1)];
    for (int k = 0; k < 3; k++) {
        static Case c;
        case_begin(&c, 60, N, 50, 1e4 / 0.01);
        case_bed(&c, 0.6);
        case_straight(&c, 0, 60);
        if (k > 0) use(&c, &LINEAR[k - 1]);
        case_force(&c, 3, 2000, 0, 500);
        case_force(&c, 3, 1000, 900, 300);
        Run run = case_open(&c);
        CpsLineView view = {0};
        while (cps_evolution_remaining_count(run.evolution) > 0) view = case_step(&run);
        for (int i = 0; i < 3 * (N + 1); i++) place[k][i] = view.position[i];
        CHECK_INT(view.spring_count, 0);
        case_close(&run);
    }
    for (int i = 0; i < 3 * (N + 1); i++) {
        CHECK_NEAR(place[1][i], place[0][i], 0);
        CHECK_NEAR(place[2][i], place[0][i], 0);
    }
}

/* ---- hanging ---- */

static void add_piece(const Table *t, double h, double w, double v, double l, double out[2]) {
    static const double AT[3] = {-0.774596669241483377, 0, 0.774596669241483377},
                        BY[3] = {5 / 9.0, 8 / 9.0, 5 / 9.0};
    enum { PARTS = 400 };
    for (int i = 0; i < PARTS; i++)
        for (int k = 0; k < 3; k++) {
            const double s = l * (i + 0.5 + 0.5 * AT[k]) / PARTS, up = v - w * s,
                         tension = hypot(h, up),
                         by = 0.5 * BY[k] * l / PARTS * (1 + strain_of(t, tension)) / tension;
            out[0] += by * h;
            out[1] += by * up;
        }
}

static int upwards(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The span from A to B with the forces h, v at end B: between the lengths at which T is that of a
 * row. */
static void span(const Table *t, double length, double w, double h, double v, double out[2]) {
    double cut[2 * MOST_ROWS + 2] = {0, length};
    int cuts = 2;
    for (int i = 1; i < t->rows; i++) {
        const double rise = t->row[i].tension * t->row[i].tension - h * h;
        if (!(rise > 0)) continue;
        for (int sign = -1; sign <= 1; sign += 2) {
            const double s = (v + sign * sqrt(rise)) / w;
            if (s > 0 && s < length) cut[cuts++] = s;
        }
    }
    qsort(cut, (size_t)cuts, sizeof *cut, upwards);
    out[0] = out[1] = 0;
    for (int i = 0; i + 1 < cuts; i++) add_piece(t, h, w, v - w * cut[i], cut[i + 1] - cut[i], out);
}

static void hang(const Table *t, double length, double w, double x, double z, double *h,
                 double *v) {
    double error = INFINITY;
    for (int i = 0; i < 200 && error > 1e-11 * length; i++) {
        double at[2], by_h[2], by_v[2];
        const double d = 1e-6 * (*h + fabs(*v));
        span(t, length, w, *h, *v, at);
        span(t, length, w, *h + d, *v, by_h);
        span(t, length, w, *h, *v + d, by_v);
        const double a = (by_h[0] - at[0]) / d, b = (by_v[0] - at[0]) / d,
                     c = (by_h[1] - at[1]) / d, e = (by_v[1] - at[1]) / d, det = a * e - b * c;
        const double rx = x - at[0], rz = z - at[1];
        const double step = (e * rx - b * rz) / det, rise = (a * rz - c * rx) / det;
        *h = step < -0.5 * *h ? 0.5 * *h : *h + step;
        *v += rise;
        error = hypot(rx, rz);
    }
    CHECK_LESS(error, 1e-11 * length);
}

/* Error of the force at B; of a line from A to B, or from B to A. */
static double hanging_error(const Table *t, int n, double x, double z, double h, double v,
                            bool turned) {
    static Case c;
    case_begin(&c, 120, n, 600, 1);
    use(&c, t);
    case_laid(&c, turned ? -x : x, turned ? -z : z);
    Run run = case_open(&c);
    (void)case_step(&run);
    const CpsEndReport end =
        cps_evolution_line_report(run.evolution, 0).end[turned ? CPS_END_A : CPS_END_B];
    const double error = hypot(end.force[0] - h, end.force[2] - v);
    case_close(&run);
    return error;
}

/* The tension is in three pieces of the table along the line. */
static void hanging(void **state) {
    (void)state;
    static const double X = 85, Z = 80;
    double h = 1e4, v = 2e4, error[4];
    hang(&NYLON, 120, 600, X, Z, &h, &v);
    printf("hanging line by a table: H %.6f N, V %.6f N at end B, at end A %.3f N\n", h, v,
           hypot(h, fmax(0, v - 120 * 600)));
    for (int k = 0; k < 4; k++) {
        char figure[60];
        error[k] = hanging_error(&NYLON, 16 << k, X, Z, h, v, false);
        snprintf(figure, sizeof figure, "force at B, %d elements, error [N]", 16 << k);
        show("hanging line by a table", figure, 0, error[k]);
    }
    CHECK_LESS(error[3], 1e-4 * h);
    /* corners fall anywhere in the elements, so the order is 2 on the average */
    CHECK_NEAR(0.5 * order(error[1], error[3]), 2, 0.3);
    CHECK_NEAR(hanging_error(&NYLON, 128, X, Z, h, v, true), 0, 2 * error[3]);
}

/* The stiffness of end B of the hanging line, whose tensions are on both sides of a corner, against
 * the difference of the forces at places beside it. */
static void stiffness_is_the_slope(void **state) {
    (void)state;
    enum { N = 40 };
    static const double AT[3] = {85, 0, 80}, BESIDE = 1e-3;
    double worst = 0;
    for (int a = 0; a < 3; a++) {
        static Case c;
        CpsError err;
        CpsStiffness found;
        double to[3], force[2][3];
        case_begin(&c, 120, N, 600, 1);
        use(&c, &NYLON);
        case_laid(&c, AT[0], AT[2]);
        for (int side = 0; side < 2; side++) {
            for (int b = 0; b < 3; b++) to[b] = AT[b] + (a == b ? BESIDE * (2 * side - 1) : 0);
            case_move(&c, 1, to[0], to[1], to[2]);
        }
        Run run = case_open(&c);
        (void)case_step(&run);
        CHECK_INT(cps_evolution_stiffness(run.evolution, 0, CPS_END_B, CPS_STIFFNESS_STEP, &found,
                                          &err),
                  CPS_OK);
        CHECK_INT(found.outcome, CPS_STIFFNESS_OUTCOME_FOUND);
        for (int side = 0; side < 2; side++) {
            (void)case_step(&run);
            for (int b = 0; b < 3; b++)
                force[side][b] =
                    cps_evolution_line_report(run.evolution, 0).end[CPS_END_B].force[b];
        }
        for (int b = 0; b < 3; b++) {
            const double slope = (force[1][b] - force[0][b]) / (2 * BESIDE),
                         off = fabs(found.matrix[3 * b + a] - slope) / fabs(found.matrix[0]);
            worst = fmax(worst, off);
            CHECK_LESS(off, 1e-5); /* 2e-9 of the forces, 7e4 N, over 2e-3 m and 4e4 N/m */
        }
        case_close(&run);
    }
    show("hanging line by a table", "stiffness of B, worst off its xx", 0, worst);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pulled_straight),
        cmocka_unit_test(two_rows_are_a_stiffness),
        cmocka_unit_test(hanging),
        cmocka_unit_test(stiffness_is_the_slope),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
