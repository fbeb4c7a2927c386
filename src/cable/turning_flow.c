/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's method for water about elements that turn (turning_flow.h).
 *
 * A program sees the water at places y and leads to x = G(y), with the forces of the water and of
 * inertia r(y) - K (x - y), K their slope by the velocity. The step is solved where x = y. With the
 * stiffness S of the taut elements and J the derivative of r by the directions of the elements at
 * y,
 *
 *     (K + S) (G(y) - y) = R(y),    dR/dy = -(K + S - J),    (K + S - J) dy = (K + S) (x - y)
 *
 * is the step of Newton's method for R(y) = 0. Where the sum of the |K (x - y)| does not become
 * less, half of the way is gone, and so on. A force that obeys the direction t of an element of the
 * chord d changes with d by
 *
 *     dt = (I - t t') dd/|d|,
 *
 * which no slope by the velocity has in it, and which is large where a slack element is short:
 * there x = G(y), G(x), .. do not converge. Nodes that are held or bear go to where the program
 * puts them. J couples a node with its neighbours, and the matrix is block tridiagonal; the blocks
 * lie in the memory of the accelerated rounds, which are over.
 *
 * A start may lie beyond a fold, where the sum has a least value that is not 0. There is a solution
 * nevertheless (docs/theory.md 9). Other starts turn the shortest element e: its chord gets the
 * components 2 {k g_i} - 1 in the axes of the chord and of its neighbours, and a length of 0.01 to
 * 1 of its own, with the fractional parts {} of the multiples of g (Roberts' sequence), which are
 * spread evenly. */
#include "cable/turning_flow.h"

#include <math.h>
#include <string.h>

#include "base/math.h"
#include "cable/field.h"
#include "cable/flow.h"
#include "cable/held.h"
#include "cable/inertia_field.h"
#include "cable/moving_flow.h"
#include "linalg/dense.h"

/* [-] Of the forces of the water: an element with less tension is slack. */
static const double SLACK = 1e-8;
/* [-] The stiffness of an inextensible element, of that of the fields of its nodes. */
static const double RIGID = 1e6;
/* [-] Shares of the way: half of the one before each time, and the least one. */
static const double LEAST_SHARE = 1.0 / 1024;
/* [-] What a share of the way must at least take off the sum, of what it would if it were linear.
 */
static const double DESCENT = 1e-3;
/* [-] An element is short whose ends are nearer than this share of its length; and the shortest
 * chord that a start has, of the length. */
static const double SHORT = 0.5, SHORTEST = 0.01;
/* The powers of 1/x with x^4 = x + 1, whose multiples are spread evenly in three dimensions. */
static const double SPREAD[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};

/* m += by a b' */
static void add_product(double m[9], double by, Vec3 a, Vec3 b) {
    const double u[3] = {a.x, a.y, a.z}, v[3] = {b.x, b.y, b.z};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) m[3 * i + k] += by * u[i] * v[k];
}

static void add_identity(double m[9], double by) {
    for (int i = 0; i < 3; i++) m[4 * i] += by;
}

static Vec3 product(const double m[9], Vec3 v) {
    return vec3(m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
                m[6] * v.x + m[7] * v.y + m[8] * v.z);
}

/* The derivative of the force of element e on its node j by its chord, seen at y. */
static void turn_of(const CpsiLine *line, const double *y, int e, int j, double m[9]) {
    memset(m, 0, 9 * sizeof *m);
    const Vec3 from = vec3_at(y, e), to = vec3_at(y, e + 1), d = vec3_sub(to, from);
    const double size = vec3_norm(d), half = 0.5 * line->natural_length[e],
                 rate = 1 / line->inertia.span[j];
    if (!(size > 0)) return;
    const CpsiWaterShare share = cpsi_water_share(line->field.flow);
    const CpsiWaterMotion water =
        cpsi_flow_motion(line->field.flow, vec3_scale(0.5, vec3_add(from, to)));
    const Vec3 t = vec3_scale(1 / size, d),
               v = vec3_scale(rate, vec3_sub(vec3_at(y, j), vec3_at(line->reference, j))),
               w = vec3_sub(water.velocity, v);
    const double way = vec3_dot(w, t);
    const Vec3 across = vec3_axpy(-way, t, w);
    const double fast = vec3_norm(across), normal = half * share.across, along = half * share.along,
                 more = half * (share.moved_along - share.moved_across);
    /* what changes less slowly than the node does, by its acceleration and that of the water */
    Vec3 faster = vec3_sub(v, vec3_at(line->inertia.rest_velocity, j));
    faster = vec3_scale(-rate, faster);
    if (share.is_accelerated) faster = vec3_add(faster, water.acceleration);
    /* by dt: of n |n|, n = w - (w.t) t; of p |p|, p = (w.t) t; and of t (t.a) */
    double by[9] = {0};
    add_identity(by, -normal * fast * way + along * fabs(way) * way + more * vec3_dot(t, faster));
    add_product(by, -normal * fast + 2 * along * fabs(way), t, w);
    if (fast > 0) add_product(by, -normal * way / fast, across, across);
    add_product(by, more, t, faster);
    /* dt by the chord */
    const Vec3 turned = product(by, t);
    for (int i = 0; i < 9; i++) m[i] = by[i] / size;
    add_product(m, -1 / size, turned, t);
}

/* The stiffness of element e in the solution of the program; 0 where it is slack. */
static void stiffness_of(const CpsiLine *line, int e, double m[9]) {
    memset(m, 0, 9 * sizeof *m);
    const Vec3 d = vec3_sub(vec3_at(line->position, e + 1), vec3_at(line->position, e));
    const double size = vec3_norm(d), tension = line->tension[e],
                 compliance = cpsi_line_compliance(line, e);
    const double *k = &line->field.stiffness[6 * e];
    if (!(tension > SLACK * line->field.size) || !(size > 0)) return;
    const double stiff = compliance > 0 ? 1 / (compliance * line->natural_length[e])
                                        : RIGID * (k[0] + k[2] + k[5] + k[6] + k[8] + k[11]);
    add_identity(m, tension / size);
    add_product(m, (stiff - tension / size) / (size * size), d, d);
}

/* Does node j go to where the program puts it? */
static bool is_led(const CpsiLine *line, int j) {
    const double *on_elements = &line->reaction[cpsi_line_contacts(line)];
    if (cpsi_line_is_held(line, j)) return true;
    for (int i = 0; i < line->contacts; i++)
        if (line->reaction[i * line->n + j] > 0) return true;
    return line->element_contacts > 0 && (on_elements[j] > 0 || (j > 0 && on_elements[j - 1] > 0));
}

/* The row of node j: its blocks before, on and behind the diagonal, and the right-hand side. */
static Vec3 write_row(const CpsiLine *line, const double *y, int j, double before[9], double on[9],
                      double behind[9]) {
    const double *k = &line->field.stiffness[6 * j], *x = line->position;
    const double field[9] = {k[0], k[1], k[3], k[1], k[2], k[4], k[3], k[4], k[5]};
    const Vec3 moved = vec3_sub(vec3_at(x, j), vec3_at(y, j));
    memset(before, 0, 9 * sizeof *before);
    memset(on, 0, 9 * sizeof *on);
    memset(behind, 0, 9 * sizeof *behind);
    if (is_led(line, j)) {
        add_identity(on, 1);
        return moved;
    }
    memcpy(on, field, sizeof field);
    Vec3 right = product(field, moved);
    for (int e = j - 1; e <= j; e++) {
        if (e < 0 || e + 1 >= line->n) continue;
        const int other = e == j ? j + 1 : j - 1;
        double *beside = e == j ? behind : before, stiff[9], turn[9];
        const double sign = e == j ? 1 : -1;
        stiffness_of(line, e, stiff);
        turn_of(line, y, e, j, turn);
        for (int i = 0; i < 9; i++) {
            on[i] += stiff[i] + sign * turn[i];
            beside[i] -= stiff[i] + sign * turn[i];
        }
        const Vec3 beyond = vec3_sub(vec3_at(x, other), vec3_at(y, other));
        right = vec3_add(right, product(stiff, vec3_sub(moved, beyond)));
    }
    return right;
}

/* The step of Newton's method from y into `way` (n, 3). */
static bool find_way(CpsiLine *line, const double *y, double *way) {
    double *const *rows = line->field.rounds.d_to; /* of what lies behind the diagonal */
    for (int j = 0; j < line->n; j++) {
        double before[9], on[9], behind[9];
        int pivot[3];
        Vec3 right = write_row(line, y, j, before, on, behind);
        if (j > 0) {
            right = vec3_sub(right, product(before, vec3_at(way, j - 1)));
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 3; k++)
                    for (int m = 0; m < 3; m++)
                        on[3 * i + k] -= before[3 * i + m] * rows[m][3 * (j - 1) + k];
        }
        if (!cpsi_lu_factor(3, on, pivot)) return false;
        vec3_store(&way[3 * j], right);
        cpsi_lu_solve(3, on, pivot, &way[3 * j]);
        for (int k = 0; k < 3; k++) {
            double column[3] = {behind[k], behind[3 + k], behind[6 + k]};
            cpsi_lu_solve(3, on, pivot, column);
            for (int m = 0; m < 3; m++) rows[m][3 * j + k] = column[m];
        }
    }
    for (int j = line->n - 1; j-- > 0;)
        for (int m = 0; m < 3; m++)
            way[3 * j + m] -= cpsi_dot(3, &rows[m][3 * j], &way[3 * (j + 1)]);
    return true;
}

/* [N] What the program about y lacks. */
static double lack(const CpsiLine *line, const double *y) {
    double sum = 0;
    for (int j = 0; j < line->n; j++) {
        const Vec3 moved = vec3_sub(vec3_at(line->position, j), vec3_at(y, j));
        sum += vec3_norm(cpsi_line_field_pull(line, j, moved));
    }
    return sum;
}

/* The element whose ends are nearest to each other at the position, by its length; that share. */
static int shortest(const CpsiLine *line, double *share) {
    int found = 0;
    *share = INFINITY;
    for (int e = 0; e + 1 < line->n; e++) {
        const Vec3 d = vec3_sub(vec3_at(line->position, e + 1), vec3_at(line->position, e));
        const double here = vec3_norm(d) / line->natural_length[e];
        if (here < *share) {
            *share = here;
            found = e;
        }
    }
    return found;
}

bool cpsi_line_has_short_element(const CpsiLine *line) {
    double share;
    (void)shortest(line, &share);
    return share < SHORT;
}

/* Axes that turn with the line: of element e, and of the loads across it. */
static void axes_at(const CpsiLine *line, const double *y, int e, Vec3 axis[3]) {
    const Vec3 d = vec3_sub(vec3_at(y, e + 1), vec3_at(y, e));
    const double size = vec3_norm(d);
    axis[0] = size > 0 ? vec3_scale(1 / size, d) : vec3(1, 0, 0);
    Vec3 across = vec3_reject(vec3_load(line->weight), axis[0]);
    if (!(vec3_norm(across) > 0)) across = vec3_reject(vec3(1, 0, 0), axis[0]);
    if (!(vec3_norm(across) > 0)) across = vec3_reject(vec3(0, 1, 0), axis[0]);
    axis[1] = vec3_scale(1 / vec3_norm(across), across);
    axis[2] = vec3_cross(axis[0], axis[1]);
}

/* Give element e another chord about its middle, or from its end that is held. */
static void put_chord(const CpsiLine *line, double *y, int e, int start) {
    const double parts[3] = {start * SPREAD[0], start * SPREAD[1], start * SPREAD[2]};
    const double up = 2 * (parts[0] - floor(parts[0])) - 1,
                 round = 2 * CPSI_PI * (parts[1] - floor(parts[1])), flat = sqrt(1 - up * up),
                 size = line->natural_length[e] * pow(SHORTEST, parts[2] - floor(parts[2])),
                 by[3] = {up, flat * cos(round), flat * sin(round)};
    const bool held[2] = {cpsi_line_is_held(line, e), cpsi_line_is_held(line, e + 1)};
    const Vec3 a = vec3_at(y, e), b = vec3_at(y, e + 1);
    const Vec3 from = held[0] ? a : held[1] ? b : vec3_scale(0.5, vec3_add(a, b));
    Vec3 axis[3], way = vec3(0, 0, 0);
    axes_at(line, y, e, axis);
    for (int i = 0; i < 3; i++) way = vec3_axpy(size * by[i], axis[i], way);
    if (!held[0]) vec3_store(&y[3 * e], vec3_axpy(held[1] ? -1 : -0.5, way, from));
    if (!held[1]) vec3_store(&y[3 * (e + 1)], vec3_axpy(held[0] ? 1 : 0.5, way, from));
}

void cpsi_line_begin_turn(CpsiLine *line, int start) {
    double share;
    const int e = shortest(line, &share);
    cpsi_line_begin_swim(line);
    if (start == 0) return;
    double *y = line->field.rounds.from;
    if (start == 1) {
        for (int j = 0; j < line->n; j++)
            vec3_store(&y[3 * j], cpsi_line_free_place(line, j, vec3_at(line->reference, j)));
        cpsi_line_put_held(line, y);
    } else {
        put_chord(line, y, e, start);
    }
    cpsi_line_see_swim(line, y);
}

bool cpsi_line_turn_on(CpsiLine *line, CpsiTurn *turn) {
    CpsiAnderson *rounds = &line->field.rounds;
    double *y = rounds->from, *start = rounds->to, *way = rounds->displacement;
    const size_t numbers = 3 * (size_t)line->n;
    const double found = lack(line, y);
    if (found < (1 - DESCENT * turn->share) * turn->lack) {
        *turn = (CpsiTurn){.lack = found, .share = 1};
        memcpy(start, y, numbers * sizeof *y);
        if (!find_way(line, y, way)) return false;
    } else {
        turn->share *= 0.5;
        if (turn->share < LEAST_SHARE) return false;
    }
    for (size_t i = 0; i < numbers; i++) y[i] = start[i] + turn->share * way[i];
    cpsi_line_see_swim(line, y);
    return true;
}
