/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's method for the forces of each line, and for the poses with a stiffness by differences of
 * the closed forms: they are exact to rounding, so differences cost nothing but a few more steps.
 */
#include "mooring_newton.h"

#include <math.h>
#include <string.h>

enum { MOST = 6 * NEWTON_BODIES };

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static void cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* rotations ------------------------------------------------------------------------------------ */

void newton_matrix(const double q[4], double m[9]) {
    for (int k = 0; k < 3; k++) { /* column k: the unit vector turned */
        double e[3] = {0}, u[3], uu[3];
        e[k] = 1;
        cross(&q[1], e, u);
        cross(&q[1], u, uu);
        for (int i = 0; i < 3; i++) m[3 * i + k] = e[i] + 2 * q[0] * u[i] + 2 * uu[i];
    }
}

static void product(const double p[4], const double q[4], double out[4]) {
    double v[3];
    cross(&p[1], &q[1], v);
    const double w = p[0] * q[0] - dot(&p[1], &q[1]);
    for (int i = 0; i < 3; i++) v[i] += p[0] * q[1 + i] + q[0] * p[1 + i];
    const double size = sqrt(w * w + dot(v, v));
    out[0] = w / size;
    for (int i = 0; i < 3; i++) out[1 + i] = v[i] / size;
}

void newton_turn(const double rotation[4], const double vector[3], double out[4]) {
    const double angle = sqrt(dot(vector, vector)), s = angle > 0 ? sin(angle / 2) / angle : 0.5;
    const double by[4] = {cos(angle / 2), s * vector[0], s * vector[1], s * vector[2]};
    product(by, rotation, out);
}

void newton_vector(const double to[4], const double from[4], double out[3]) {
    const double back[4] = {from[0], -from[1], -from[2], -from[3]};
    double q[4];
    product(to, back, q);
    const double sign = q[0] < 0 ? -1 : 1, size = sqrt(dot(&q[1], &q[1]));
    const double by = size > 0 ? 2 * atan2(size, fabs(q[0])) / size : 2;
    for (int i = 0; i < 3; i++) out[i] = sign * by * q[1 + i];
}

static void to_scene(const double rotation[4], const double v[3], double out[3]) {
    double m[9];
    newton_matrix(rotation, m);
    for (int i = 0; i < 3; i++) out[i] = dot(&m[3 * i], v);
}

/* lines ---------------------------------------------------------------------------------------- */

/* What a line spans with the forces h, v at end B, and its derivatives; bottom: V at end A. */
typedef struct Reach {
    double x, z, x_h, x_v, z_v, bottom, grounded; /* z_h = x_v */
} Reach;

static void add_hanging(Reach *r, const NewtonPiece *p, double h, double high, double low,
                        bool low_moves) {
    const double w = p->weight, ea = p->stiffness, top = hypot(h, high), foot = hypot(h, low);
    const double turn = asinh(high / h) - asinh(low / h), length = (high - low) / w;
    r->x += h / w * turn + h * length / ea;
    r->z += (top - foot) / w + (high - low) * (high + low) / (2 * w * ea);
    r->x_h += (turn - high / top + low / foot) / w + length / ea;
    r->x_v += h / w * (1 / top - (low_moves ? 1 / foot : 0)) + (low_moves ? 0 : h / (w * ea));
    r->z_v +=
        (high / top - (low_moves ? low / foot : 0)) / w + (high - (low_moves ? low : 0)) / (w * ea);
}

static Reach reach_of(const NewtonLine *line, double h, double v) {
    Reach r = {0};
    bool lies = false;
    for (int i = 0; i < line->count; i++) {
        const NewtonPiece *p = &line->piece[i];
        double rest = p->length;
        lies = lies || (line->rests && v <= 0);
        if (!lies) {
            const double low = v - p->weight * p->length;
            lies = line->rests && low < 0;
            rest = lies ? p->length - v / p->weight : 0;
            add_hanging(&r, p, h, v, lies ? 0 : low, !lies);
            if (lies) r.x_v -= (1 + h / p->stiffness) / p->weight;
            v = low - p->drop;
        }
        r.x += rest * (1 + h / p->stiffness);
        r.x_h += rest / p->stiffness;
        r.grounded += rest;
    }
    r.bottom = lies ? 0 : v;
    return r;
}

double newton_lowest(const NewtonLine *line) {
    double z = 0, lowest = INFINITY, v = line->v;
    for (int i = 0; i < line->count; i++) {
        const NewtonPiece *p = &line->piece[i];
        const double low = v - p->weight * p->length;
        Reach part = {0};
        if (v > 0 && low < 0) {
            add_hanging(&part, p, line->h, v, 0, false);
            lowest = fmin(lowest, z - part.z);
            part = (Reach){0};
        }
        add_hanging(&part, p, line->h, v, low, true);
        z -= part.z;
        lowest = fmin(lowest, z);
        v = low - p->drop;
    }
    return lowest - fmin(z, 0);
}

/* Does a line that may rest reach its end A without a horizontal force? Then it hangs straight down
 * and lies loosely, and V carries what hangs. */
static bool is_loose(NewtonLine *line, double weight, double x, double z) {
    const double h = 1e-9 * weight;
    double low = 0, high = weight;
    if (!line->rests || z <= 0) return false;
    for (int k = 0; k < 200; k++) {
        const double v = (low + high) / 2;
        if (reach_of(line, h, v).z < z)
            low = v;
        else
            high = v;
    }
    const Reach r = reach_of(line, h, high);
    line->loose = r.z > z * (1 - 1e-9) && r.x >= x;
    if (line->loose) line->h = h;
    if (line->loose) line->v = high;
    return line->loose;
}

static bool solve_line(NewtonLine *line, double x, double z) {
    double length = 0, weight = 0;
    for (int i = 0; i < line->count; i++) {
        length += line->piece[i].length;
        weight += line->piece[i].weight * line->piece[i].length + line->piece[i].drop;
    }
    if (is_loose(line, weight, x, z)) return true;
    if (!(line->h > 0)) {
        const double loose = (length * length - z * z) / (x * x) - 1;
        const double bend = loose > 0.01 ? sqrt(3 * loose) : 0.2, w = fabs(weight) / length;
        line->h = w * x / (2 * bend);
        line->v = weight / 2 + w / 2 * z / tanh(bend);
    }
    const double close = 1e-14 * (x + fabs(z) + length);
    for (int k = 0; k < 300; k++) {
        const Reach r = reach_of(line, line->h, line->v);
        const double a = x - r.x, b = z - r.z, size = hypot(a, b);
        const double det = r.x_h * r.z_v - r.x_v * r.x_v;
        if (!(det > 0)) return false;
        const double dh = (r.z_v * a - r.x_v * b) / det, dv = (r.x_h * b - r.x_v * a) / det;
        if (size <= close || fabs(dh) + fabs(dv) <= 1e-15 * (line->h + fabs(line->v))) {
            line->grounded = r.grounded;
            return true;
        }
        /* both stay positive, V of a line that rests: with V <= 0 all of it lies, at any H */
        double keep = line->h + dh < 0.2 * line->h ? -0.8 * line->h / dh : 1;
        if (line->rests && line->v + keep * dv < 0.2 * line->v) keep = -0.8 * line->v / dv;
        for (int half = 0; half < 20; half++, keep /= 2) {
            const Reach at = reach_of(line, line->h + keep * dh, line->v + keep * dv);
            if (hypot(x - at.x, z - at.z) < size) break;
        }
        line->h += keep * dh;
        line->v += keep * dv;
        if (keep < 2e-6 && size < 100 * close) {
            line->grounded = r.grounded;
            return true; /* rounding */
        }
    }
    return false;
}

/* bodies --------------------------------------------------------------------------------------- */

static void add(double sum[6], const double force[3], const double arm[3]) {
    double moment[3];
    cross(arm, force, moment);
    for (int i = 0; i < 3; i++) {
        sum[i] += force[i];
        sum[3 + i] += moment[i];
    }
}

void newton_place(const NewtonMooring *m, const NewtonLine *line, int e, double at[3],
                  double arm[3]) {
    memcpy(at, line->place[e], 3 * sizeof *at);
    memset(arm, 0, 3 * sizeof *arm);
    if (line->body[e] < 0) return;
    const NewtonBody *b = &m->body[line->body[e]];
    to_scene(b->rotation, line->place[e], arm);
    for (int a = 0; a < 3; a++) at[a] = b->position[a] + arm[a];
}

static bool add_line(NewtonMooring *m, NewtonLine *line, double *sum) {
    double at[2][3], arm[2][3];
    for (int e = 0; e < 2; e++) newton_place(m, line, e, at[e], arm[e]);
    const double dx = at[1][0] - at[0][0], dy = at[1][1] - at[0][1], x = hypot(dx, dy);
    if (!(x > 0) || !solve_line(line, x, at[1][2] - at[0][2])) return false;
    const double bottom = reach_of(line, line->h, line->v).bottom;
    for (int e = 0; e < 2; e++) {
        const double sign = e ? -1 : 1;
        line->force[e][0] = sign * line->h * dx / x;
        line->force[e][1] = sign * line->h * dy / x;
        line->force[e][2] = e ? -line->v : bottom;
        if (line->body[e] >= 0) add(&sum[6 * line->body[e]], line->force[e], arm[e]);
    }
    return true;
}

static void add_water(const NewtonBody *b, double sum[6]) {
    double q[6], c[6] = {0}, u[3], uu[3];
    for (int a = 0; a < 3; a++) q[a] = b->position[a] - b->first_position[a];
    newton_vector(b->rotation, b->first_rotation, &q[3]);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 6; k++) c[i] += b->hydrostatics[6 * i + k] * q[k];
    /* J = 1 - [phi]/2 + a [phi]^2 and so J' c = c + phi x c/2 + a phi x (phi x c) */
    const double angle = sqrt(dot(&q[3], &q[3]));
    const double a = angle > 1e-3 ? (1 - angle / 2 / tan(angle / 2)) / (angle * angle)
                                  : 1.0 / 12 + angle * angle / 720;
    cross(&q[3], &c[3], u);
    cross(&q[3], u, uu);
    for (int i = 0; i < 3; i++) {
        sum[i] -= c[i];
        sum[3 + i] -= c[3 + i] + u[i] / 2 + a * uu[i];
    }
}

/* What is left of forces and moments; false: a line has no forces by the closed form. */
static bool left_of(NewtonMooring *m, double sum[MOST]) {
    memset(sum, 0, MOST * sizeof *sum);
    for (int i = 0; i < m->lines; i++)
        if (!add_line(m, &m->line[i], sum)) return false;
    for (int k = 0; k < m->bodies; k++) {
        const NewtonBody *b = &m->body[k];
        double arm[3];
        to_scene(b->rotation, b->gravity_centre, arm);
        add(&sum[6 * k], (const double[3]){0, 0, -b->weight}, arm);
        to_scene(b->rotation, b->buoyancy_centre, arm);
        add(&sum[6 * k], (const double[3]){0, 0, b->buoyancy}, arm);
        add_water(b, &sum[6 * k]);
        for (int a = 0; a < 6; a++) sum[6 * k + a] += b->load[a];
    }
    return true;
}

/* Move by dq, in sizes and radians. */
static void move(NewtonMooring *m, const double dq[MOST], double share) {
    for (int k = 0; k < m->bodies; k++) {
        double turn[3];
        for (int a = 0; a < 3; a++) {
            m->body[k].position[a] += share * m->size * dq[6 * k + a];
            turn[a] = share * dq[6 * k + 3 + a];
        }
        newton_turn(m->body[k].rotation, turn, m->body[k].rotation);
    }
}

/* What is left in units of energy. */
static bool scaled_left(const NewtonMooring *m, double g[MOST]) {
    NewtonMooring at = *m;
    const bool known = left_of(&at, g);
    for (int i = 0; i < 6 * m->bodies; i++)
        if (i % 6 < 3) g[i] *= m->size;
    return known;
}

static bool stiffness_of(const NewtonMooring *m, double k[MOST][MOST]) {
    const int n = 6 * m->bodies;
    for (int j = 0; j < n; j++) {
        double g[2][MOST], dq[MOST] = {0};
        for (int side = 0; side < 2; side++) {
            NewtonMooring beside = *m;
            dq[j] = side ? 2e-6 : -2e-6;
            move(&beside, dq, 1);
            if (!scaled_left(&beside, g[side])) return false;
        }
        for (int i = 0; i < n; i++) k[i][j] = (g[0][i] - g[1][i]) / 4e-6;
    }
    return true;
}

static bool is_positive(int n, double k[MOST][MOST], double shift) {
    double l[MOST][MOST];
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double sum = (k[i][j] + k[j][i]) / 2 + (i == j ? shift : 0);
            for (int s = 0; s < j; s++) sum -= l[i][s] * l[j][s];
            if (i == j && !(sum > 0)) return false;
            l[i][j] = i == j ? sqrt(sum) : sum / l[j][j];
        }
    return true;
}

/* (k + shift) x = g, with pivots. */
static void solve(int n, double k[MOST][MOST], double shift, const double g[MOST], double x[MOST]) {
    double a[MOST][MOST + 1];
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) a[i][j] = k[i][j] + (i == j ? shift : 0);
        a[i][n] = g[i];
    }
    for (int c = 0; c < n; c++) {
        int best = c;
        for (int i = c; i < n; i++)
            if (fabs(a[i][c]) > fabs(a[best][c])) best = i;
        for (int j = c; j <= n; j++) {
            const double swap = a[c][j];
            a[c][j] = a[best][j];
            a[best][j] = swap;
        }
        for (int i = c + 1; i < n; i++)
            for (int j = n; j >= c; j--) a[i][j] -= a[i][c] / a[c][c] * a[c][j];
    }
    for (int i = n - 1; i >= 0; i--) {
        x[i] = a[i][n];
        for (int j = i + 1; j < n; j++) x[i] -= a[i][j] * x[j];
        x[i] /= a[i][i];
    }
}

/* The largest share of the step that moves no body by more than a twentieth of the size and a fifth
 * of a radian. */
static double share_of(int n, const double dq[MOST]) {
    double most = 1;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(dq[i]) / (i % 6 < 3 ? 0.05 : 0.2));
    return 1 / most;
}

bool newton_solve(NewtonMooring *m) {
    const int n = 6 * m->bodies;
    for (int iteration = 0; iteration < 500; iteration++) {
        double g[MOST], k[MOST][MOST], dq[MOST], trace = 0, shift = 0;
        if (!left_of(m, g) || !scaled_left(m, g) || !stiffness_of(m, k)) return false;
        for (int i = 0; i < n; i++) trace += fabs(k[i][i]) / n;
        for (double by = 1e-4; !is_positive(n, k, shift); by *= 4) shift = by * trace;
        solve(n, k, shift, g, dq);
        double most = 0, share = share_of(n, dq);
        for (int i = 0; i < n; i++) most = fmax(most, fabs(dq[i]));
        if (most <= 1e-11) {
            m->is_stable = shift == 0;
            return true;
        }
        for (int half = 0; half < 30; half++, share /= 2) { /* to where all lines have forces */
            NewtonMooring next = *m;
            double unused[MOST];
            move(&next, dq, share);
            if (!left_of(&next, unused)) continue;
            *m = next;
            break;
        }
    }
    return false;
}
