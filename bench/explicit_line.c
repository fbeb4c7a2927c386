/* SPDX-License-Identifier: BSD-3-Clause */
/* A mooring line by explicit integration: which law makes which difference.
 *
 *     explicit_line STEP BA PUSHES SUCKS NODAL BED FAR [NODES.txt]
 *
 * Equations of a lumped-mass code (Hall and Goupee 2015, MoorDyn), written down here anew: masses
 * at nodes, elastic elements with an internal damper, the drag and added mass of Morison, a bed
 * with springs and dampers, the method of Runge and Kutta of second order. What differs between
 * programs is given:
 *
 *     PUSHES  1: T = EA max(e, 0) + BA e', also slack; 0: T = max(EA d + BA d', 0) with an
 * elongation d >= e that goes back by EA d + BA d' = 0, so that the element never pushes SUCKS   1:
 * the bed's R = b (k d - c v_z) as long as the node is below it; 0: max(R, 0) NODAL   1: drag and
 * added mass by the direction between the neighbours of a node; 0: by halves of its elements
 *
 * The line is that of compare_motion.py, the end goes to and fro by FAR over a bed at the height
 * BED. Prints time and force in x of the line on what holds the end, without the inertia of the
 * end's half element. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N = 101 };
static const double LENGTH = 902.2 / (N - 1), D = 0.09, EA = 384.243e6, MASS = 77.7066, RHO = 1025,
                    G = 9.80665, DRAG = 1.6, ADDED = 1.0, BED_STIFFNESS = 3e6, BED_DAMPING = 3e5,
                    PERIOD = 12, LASTS = 24, ROUNDING = 1e-13, PI = 3.14159265358979323846;

typedef struct Line {
    double step, damping, bed, far;
    int pushes, sucks, nodal;
    double x[N][3], v[N][3], a[N][3], force; /* force: in x at the end */
    double elongation[N - 1];
} Line;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Unit vector from a to b; returns their distance. */
static double unit(const double a[3], const double b[3], double q[3]) {
    for (int i = 0; i < 3; i++) q[i] = b[i] - a[i];
    const double size = sqrt(dot(q, q));
    for (int i = 0; i < 3; i++) q[i] /= size;
    return size;
}

/* What is left of an elongation after a time without tension. */
static double left(const Line *line, double time) {
    return line->damping > 0 ? exp(-time * EA / line->damping) : 0;
}

/* Tension of an element by its strain and rate, a time after its elongation was that stored. */
static double tension(const Line *line, int e, double strain, double rate, double later) {
    if (line->pushes) return EA * fmax(strain, 0) + line->damping * rate;
    if (strain < line->elongation[e] * left(line, later) - ROUNDING) return 0;
    return fmax(EA * strain + line->damping * rate, 0);
}

/* Drag on a length of the line of direction q with the velocity v, and its added mass. */
static void water(const double q[3], const double v[3], double length, double f[3],
                  double m[3][3]) {
    double across[3];
    const double along = dot(v, q), moved = RHO * 0.25 * PI * D * D * length * ADDED;
    for (int i = 0; i < 3; i++) across[i] = v[i] - along * q[i];
    const double by = 0.5 * RHO * D * length * DRAG * sqrt(dot(across, across));
    for (int i = 0; i < 3; i++) {
        f[i] -= by * across[i];
        m[i][i] += moved;
        for (int j = 0; j < 3; j++) m[i][j] -= moved * q[i] * q[j];
    }
}

/* a = M^-1 f of a symmetric matrix, by cofactors. */
static void divide(double m[3][3], const double f[3], double a[3]) {
    double c[3][3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            c[i][j] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
        }
    const double all = m[0][0] * c[0][0] + m[0][1] * c[0][1] + m[0][2] * c[0][2];
    for (int i = 0; i < 3; i++) a[i] = dot(c[i], f) / all;
}

/* Accelerations of the state (x, v) a time after the step began, and the force at the end. */
static void accelerate(Line *line, double (*x)[3], double (*v)[3], double later) {
    double q[N - 1][3], pull[N - 1];
    for (int e = 0; e + 1 < N; e++) {
        const double size = unit(x[e], x[e + 1], q[e]);
        const double rate = (dot(v[e + 1], q[e]) - dot(v[e], q[e])) / LENGTH;
        pull[e] = tension(line, e, size / LENGTH - 1, rate, later);
    }
    for (int j = 0; j < N; j++) {
        const int before = j > 0, after = j + 1 < N;
        const double own = 0.5 * LENGTH * (before + after), depth = line->bed - x[j][2];
        double f[3] = {0}, m[3][3] = {{0}}, way[3];
        for (int i = 0; i < 3; i++) {
            f[i] = (after ? pull[j] * q[j][i] : 0) - (before ? pull[j - 1] * q[j - 1][i] : 0);
            m[i][i] = MASS * own;
        }
        f[2] -= own * G * (MASS - RHO * 0.25 * PI * D * D);
        if (depth > 0) {
            const double up = (BED_STIFFNESS * depth - BED_DAMPING * v[j][2]) * D * own;
            f[2] += line->sucks ? up : fmax(up, 0);
        }
        if (line->nodal) {
            (void)unit(x[before ? j - 1 : j], x[after ? j + 1 : j], way);
            water(way, v[j], own, f, m);
        } else {
            if (before) water(q[j - 1], v[j], 0.5 * LENGTH, f, m);
            if (after) water(q[j], v[j], 0.5 * LENGTH, f, m);
        }
        divide(m, f, line->a[j]);
        if (!after) line->force = f[0];
    }
}

/* The elongations of the dampers follow. */
static void follow(Line *line) {
    const double kept = left(line, line->step);
    for (int e = 0; e + 1 < N; e++) {
        double q[3];
        const double strain = unit(line->x[e], line->x[e + 1], q) / LENGTH - 1;
        line->elongation[e] = fmax(fmax(strain, 0), line->elongation[e] * kept);
    }
}

static void lead(const Line *line, double time, const double from[3], double x[3], double v[3]) {
    const double w = 2 * PI / PERIOD;
    memcpy(x, from, 3 * sizeof *x);
    memset(v, 0, 3 * sizeof *v);
    x[0] += line->far * sin(w * time);
    v[0] = line->far * w * cos(w * time);
}

int main(int argc, char **argv) {
    static Line line;
    static double x[N][3], v[N][3];
    double from[3];
    if (argc != 9) {
        fprintf(stderr, "usage: explicit_line STEP BA PUSHES SUCKS NODAL BED FAR NODES.txt\n");
        return 2;
    }
    line.step = atof(argv[1]);
    line.damping = atof(argv[2]);
    line.pushes = atoi(argv[3]);
    line.sucks = atoi(argv[4]);
    line.nodal = atoi(argv[5]);
    line.bed = atof(argv[6]);
    line.far = atof(argv[7]);
    FILE *file = fopen(argv[8], "r");
    if (!file) return 1;
    for (int j = 0; j < N; j++)
        if (fscanf(file, "%lf %lf %lf", &line.x[j][0], &line.x[j][1], &line.x[j][2]) != 3) return 1;
    fclose(file);
    memcpy(from, line.x[N - 1], sizeof from);
    const long steps = lround(LASTS / line.step), every = lround(0.002 / line.step);
    follow(&line);
    for (long s = 0; s <= steps; s++) {
        const double time = (double)s * line.step;
        lead(&line, time, from, line.x[N - 1], line.v[N - 1]);
        accelerate(&line, line.x, line.v, 0);
        if (s % every == 0) printf("%.9g,%.9g\n", time, line.force);
        for (int j = 1; j + 1 < N; j++)
            for (int i = 0; i < 3; i++) {
                x[j][i] = line.x[j][i] + 0.5 * line.step * line.v[j][i];
                v[j][i] = line.v[j][i] + 0.5 * line.step * line.a[j][i];
            }
        memcpy(x[0], line.x[0], sizeof x[0]);
        lead(&line, time + 0.5 * line.step, from, x[N - 1], v[N - 1]);
        accelerate(&line, x, v, 0.5 * line.step);
        for (int j = 1; j + 1 < N; j++)
            for (int i = 0; i < 3; i++) {
                line.x[j][i] += line.step * v[j][i];
                line.v[j][i] += line.step * line.a[j][i];
            }
        lead(&line, time + line.step, from, line.x[N - 1], line.v[N - 1]);
        if (!line.pushes) follow(&line);
    }
    return 0;
}
