/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of a free body (body_stiffness.h).
 *
 * The body moves by d and turns by t, its points by u = d + t x a. In a line that ends there the
 * force of an element, T along e = dx/|dx|, changes by
 *
 *     p = T/|dx| (1 - e e') (v_2 - v_1) + e dT,      e.(v_2 - v_1) = l/T' dT,
 *
 * T' the slope of its law, infinite where it cannot be stretched. What the two elements of a node
 * bring to it, g, vanishes where it is free. A node that rests stays. On a plane of normal n one
 * that slides by s has n.v = 0, the reaction changes by -n.g, and the friction -mu R s/|s| with it
 * and with the direction of s:
 *
 *     (1 - n n') g + mu (n.g) s/|s| - mu R/|s| (1 - n n' - s s'/|s|^2) v = 0.
 *
 * In a small cycle a node rests where friction can hold it; where friction resists one direction of
 * the plane alone, it moves along the other one, f, by which f.g vanishes.
 *
 * That is a system of blocks of four rows for each line, for dT of an element and v of the node
 * behind it, solved once for each of the six moves of both ends. Free points at which the lines end
 * follow (body_points.c). The pulls turn about the reference point, and what weight, buoyancy and
 * water lose is taken from differences of themselves. */
#include "body_stiffness.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "body_points.h"
#include "elongation.h"
#include "points.h"
#include "sets.h"

typedef Real Matrix[3][3];
typedef Real Triple[3];
/* dT and v; the six motions, and the rows of the next block. */
enum { ROWS = 4, COLUMNS = SIX + ROWS };

/* A state is known where a reaction is more than CLOSED of the node's weight or less than NOTHING
 * of it, a tension more than NOTHING of the largest force and KNOWN times what rounding leaves of
 * it, and a slip more than MOVED of the line's length, at the bound, or less, clearly below it.
 * What has not moved at all, RESTS, counts as at rest also at its bound. */
static const Real KNOWN = 100, CLOSED = 1e-3L, NOTHING = 1e-7L, MOVED = 1e-9L, RESTS = 1e-13L;
/* The slope of a law by differences of the strain; both sides agree but in a corner. */
static const Real STRAIN = 1e-7L, SAME_SLOPE = 1e-6L;
/* Between nodes at rest an element that cannot be stretched may have any tension: there it is so
 * much of what the largest tension stretches it by its length. */
static const Real LEAST = 1e-15L;
/* Differences of loads: in lengths of the body's arm, and radians; those of fourth order leave the
 * fourth power. */
static const Real STEP = 1e-3L;

/* ---- small matrices ---- */

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const Real *a, const Real *b, Real *out) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void exchange(Real *a, Real *b, int count) {
    for (int k = 0; k < count; k++) {
        const Real swap = a[k];
        a[k] = b[k];
        b[k] = swap;
    }
}

/* Solve m x = right, rows exchanged for the largest pivot; both are overwritten. False: singular.
 */
static bool solve_block(Real m[ROWS][ROWS], Real right[ROWS][COLUMNS]) {
    for (int p = 0; p < ROWS; p++) {
        int best = p;
        for (int i = p + 1; i < ROWS; i++)
            if (fabsl(m[i][p]) > fabsl(m[best][p])) best = i;
        if (!(fabsl(m[best][p]) > 0)) return false;
        exchange(m[p], m[best], ROWS);
        exchange(right[p], right[best], COLUMNS);
        for (int i = 0; i < ROWS; i++) {
            const Real by = i == p ? 0 : m[i][p] / m[p][p];
            for (int k = 0; k < ROWS; k++) m[i][k] -= by * m[p][k];
            for (int k = 0; k < COLUMNS; k++) right[i][k] -= by * right[p][k];
        }
    }
    for (int i = 0; i < ROWS; i++)
        for (int k = 0; k < COLUMNS; k++) right[i][k] /= m[i][i];
    return true;
}

/* ---- a line ---- */

/* T/|dx|, l/T' and e of an element. */
typedef struct Element {
    Real across, compliance;
    Triple e;
} Element;

/* Of a line: its elements, of each node m g + q v = 0, and of node j, with the element before it,
 * dT and v: of end A v alone. */
typedef struct Chain {
    Element *element;
    Matrix *m, *q;
    Real (*x)[ROWS][COLUMNS]; /* (nodes) eliminated: x_j = x[.][motion] - x[.][SIX + .] x_(j+1) */
} Chain;

static void chain_free(Chain *chain) {
    free(chain->element);
    free(chain->m);
    free(chain->q);
    free(chain->x);
}

static bool chain_create(Chain *chain, const Record *r) {
    *chain = (Chain){calloc(r->elements, sizeof *chain->element), calloc(r->nodes, sizeof(Matrix)),
                     calloc(r->nodes, sizeof(Matrix)), calloc(r->nodes, sizeof *chain->x)};
    return chain->element && chain->m && chain->q && chain->x;
}

/* What tensions compare with: a slack line that cannot be stretched has some by rounding. */
static Real largest_force(const Record *r) {
    Real most = acts_in_line(r);
    for (size_t i = 0; i < r->elements; i++) most = fmaxl(most, r->tension[i]);
    return most;
}

/* [m/N] l/T' of an element. False: in a corner of its law. */
static bool compliance_of(const Record *r, size_t i, Real strain, Real most, Real *compliance) {
    const Real l = r->element_length[i];
    if (!(r->compliance > 0) || (r->element_compliance && !(r->element_compliance[i] > 0))) {
        *compliance = LEAST * l / most;
        return true;
    }
    const Real here = elongation_tension(r, i, strain),
               up = (elongation_tension(r, i, strain + STRAIN) - here) / STRAIN,
               down = (here - elongation_tension(r, i, strain - STRAIN)) / STRAIN;
    *compliance = 2 * l / (up + down);
    return fabsl(up - down) <= SAME_SLOPE * up;
}

static bool set_element(const Record *r, size_t i, Real most, Element *out) {
    for (int k = 0; k < 3; k++) out->e[k] = (Real)r->position[i + 1][k] - r->position[i][k];
    const Real length = sqrtl(dot(out->e, out->e)), strain = length / r->element_length[i] - 1;
    if (!(r->tension[i] > NOTHING * most + KNOWN * rounding_in_line(r)) ||
        !compliance_of(r, i, strain, most, &out->compliance))
        return false;
    for (int k = 0; k < 3; k++) out->e[k] /= length;
    out->across = r->tension[i] / length;
    return true;
}

/* The contact that bears, -1: none. False where that is not known, or there are two. */
static bool bearing_contact(const Record *r, size_t j, long *contact) {
    const double *g = r->load[j];
    const Real length = r->weight_length ? r->weight_length[j]
                                         : 0.5L * ((j > 0 ? r->element_length[j - 1] : 0) +
                                                   (j < r->elements ? r->element_length[j] : 0));
    const Real weight = length * hypotl(hypotl(g[0], g[1]), g[2]);
    *contact = -1;
    for (size_t c = j; c < r->contacts * r->nodes; c += r->nodes) {
        if (r->reaction[c] <= NOTHING * weight) continue;
        if (r->reaction[c] <= CLOSED * weight || *contact >= 0) return false;
        *contact = (long)c;
    }
    return true;
}

static void set_free(Matrix m) {
    for (int a = 0; a < 3; a++) m[a][a] = 1;
}

/* A node that slides by s over a plane. */
static void set_sliding(const Record *r, size_t c, Real mu, const Triple s, Real stiff, Matrix m,
                        Matrix q) {
    const double *n = r->normal[c];
    const Real size = sqrtl(dot(s, s)), bound = mu * r->reaction[c];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            const Real plane = (a == b) - (Real)n[a] * n[b];
            m[a][b] = plane + (mu > 0 ? mu * s[a] / size * n[b] : 0);
            q[a][b] = stiff * n[a] * n[b] -
                      (mu > 0 ? bound / size * (plane - s[a] * s[b] / (size * size)) : 0);
        }
}

/* A node that friction holds across the direction f of the plane, and nothing holds along it. */
static void set_guided(const Real *f, Real stiff, Matrix m, Matrix q) {
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            m[a][b] = f[a] * f[b];
            q[a][b] = stiff * ((a == b) - f[a] * f[b]);
        }
}

/* A node that friction keeps from sliding, along the grain and across it or one of both. False
 * where the one way that it has is not known. */
static bool set_stuck(const Surface *surface, const double normal[3], Real stiff, Matrix m,
                      Matrix q) {
    const bool along = surface->mu[0] > 0, across = surface->mu[1] > 0;
    Triple n;
    Real axes[2][3];
    if (along && across) {
        for (int a = 0; a < 3; a++) q[a][a] = stiff;
        return true;
    }
    for (int a = 0; a < 3; a++) n[a] = normal[a];
    if (!surface->grained || !surface_axes(surface, n, surface->grain, axes)) return false;
    set_guided(axes[along], stiff, m, q);
    return true;
}

static bool set_contact(const StiffnessStep *step, const Record *r, size_t j, size_t c, Real length,
                        Real stiff, Matrix m, Matrix q) {
    const Source *source = step->source;
    const size_t on = source->surfaces > 1 ? (size_t)r->obstacle[c] : 0;
    if (on >= source->surfaces) return false;
    const Surface *surface = &source->surface[on];
    if (surface->kind != SURFACE_PLANE || surface->gives > 0) return false;
    const Real factor = r->factor ? r->factor[j] : 1, mu = factor * surface->mu[0];
    const bool rubs =
        step->sticks ? factor * surface_friction(surface) > 0 : r->friction_bound[c] > 0;
    if (rubs && (!source->consistent || surface->set)) return false;
    if (rubs && step->sticks) return set_stuck(surface, r->normal[c], stiff, m, q);
    if (rubs && (surface->box || surface->mu[0] != surface->mu[1])) return false;
    Triple s;
    for (int a = 0; a < 3; a++) s[a] = r->slip[c][a];
    const Real slid = sqrtl(dot(s, s));
    const double *f = r->friction[c];
    const Real used = rubs ? hypotl(hypotl(f[0], f[1]), f[2]) / r->friction_bound[c] : 0;
    if (rubs && (slid <= RESTS * length || (slid <= MOVED * length && used < 1 - CLOSED))) {
        for (int a = 0; a < 3; a++) q[a][a] = stiff;
        return true;
    }
    set_sliding(r, c, rubs ? mu : 0, s, stiff, m, q);
    return !rubs || (slid > MOVED * length && used > 1 - CLOSED);
}

/* Are the forces of the line those of elements, weight and contacts of its nodes alone? */
static bool is_plain(const StiffnessStep *step, const Record *r) {
    if (r->outcome != OUTCOME_SOLVED || r->loads || r->sets || r->drums || r->grasps > 0 || r->mass)
        return false;
    const size_t nodes = r->contacts * r->nodes, all = nodes + (r->has_elements ? r->elements : 0),
                 first = step->source->consistent ? nodes : 0;
    for (size_t c = first; c < all; c++)
        if (r->reaction[c] != 0) return false;
    return r->end_kind[0] == END_HELD && r->end_kind[1] == END_HELD;
}

static bool set_line(const StiffnessStep *step, const Record *r, const bool is_on[2],
                     Chain *chain) {
    const Real most = largest_force(r);
    Real length = 0;
    for (size_t i = 0; i < r->elements; i++) {
        if (!set_element(r, i, most, &chain->element[i])) return false;
        length += r->element_length[i];
    }
    for (size_t j = 0; j < r->nodes; j++) {
        long c;
        if (!bearing_contact(r, j, &c)) return false;
        if (j == 0 || j == r->elements) {
            if (c >= 0 && is_on[j > 0]) return false; /* the obstacle takes part of its force */
        } else if (c < 0)
            set_free(chain->m[j]);
        else if (!set_contact(step, r, j, (size_t)c, length, most / r->element_length[0],
                              chain->m[j], chain->q[j]))
            return false;
    }
    return true;
}

/* Add m across (1 - e e') to the columns of v. */
static void add_across(const Element *of, Matrix m, Real sign, Real block[ROWS][ROWS]) {
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            block[1 + a][1 + b] += sign * of->across * (m[a][b] - dot(m[a], of->e) * of->e[b]);
}

/* The rows of node j and of the element before it: before x_(j-1) + own x_j + after x_(j+1). */
static void set_rows(const Record *r, Chain *chain, size_t j, Real before[ROWS][ROWS],
                     Real own[ROWS][ROWS], Real after[ROWS][ROWS]) {
    const Element *back = &chain->element[j - 1];
    memset(before, 0, ROWS * sizeof *before);
    memset(own, 0, ROWS * sizeof *own);
    memset(after, 0, ROWS * sizeof *after);
    own[0][0] = -back->compliance;
    for (int a = 0; a < 3; a++) {
        before[0][1 + a] = -back->e[a];
        own[0][1 + a] = back->e[a];
    }
    if (j == r->elements) { /* end B has its given move */
        for (int a = 1; a < ROWS; a++) own[a][a] = 1;
        return;
    }
    const Element *on = &chain->element[j];
    for (int a = 0; a < 3; a++) {
        own[1 + a][0] = -dot(chain->m[j][a], back->e);
        after[1 + a][0] = dot(chain->m[j][a], on->e);
        for (int b = 0; b < 3; b++) own[1 + a][1 + b] = chain->q[j][a][b];
    }
    add_across(back, chain->m[j], 1, before);
    add_across(back, chain->m[j], -1, own);
    add_across(on, chain->m[j], -1, own);
    add_across(on, chain->m[j], 1, after);
}

/* The moves of the nodes, of which those of the ends are given: elimination from A to B. */
static bool solve_line(const Record *r, Chain *chain) {
    for (size_t j = 1; j < r->nodes; j++) {
        Real before[ROWS][ROWS], own[ROWS][ROWS], after[ROWS][ROWS], right[ROWS][COLUMNS];
        Real(*last)[COLUMNS] = chain->x[j - 1];
        set_rows(r, chain, j, before, own, after);
        for (int a = 0; a < ROWS; a++) {
            for (int k = 0; k < SIX; k++) {
                right[a][k] = j == r->elements ? chain->x[j][a][k] : 0;
                for (int b = 0; b < ROWS; b++) right[a][k] -= before[a][b] * last[b][k];
            }
            for (int k = 0; k < ROWS; k++) {
                right[a][SIX + k] = after[a][k];
                for (int b = 0; b < ROWS; b++) own[a][k] -= before[a][b] * last[b][SIX + k];
            }
        }
        if (!solve_block(own, right)) return false;
        memcpy(chain->x[j], right, sizeof right);
    }
    for (size_t j = r->elements; j-- > 1;)
        for (int a = 0; a < ROWS; a++)
            for (int k = 0; k < SIX; k++)
                for (int b = 0; b < ROWS; b++)
                    chain->x[j][a][k] -= chain->x[j][a][SIX + b] * chain->x[j + 1][b][k];
    return true;
}

/* ---- the body ---- */

/* From the reference point of the body to where an end of a line is on it. False: it is not. */
static bool arm_of(const StiffnessStep *step, const Record *r, int end, size_t k,
                   const BodyState *at, Triple arm) {
    const int point = r->end_point[end];
    if (point < 0 || step->bodies->of_point[point] != (int)k) return false;
    body_place((const double[3]){0, 0, 0}, at->rotation, step->bodies->place[point], arm);
    return true;
}

/* The moves of an end at the arm by the motions of the body. */
static void set_map(const Triple arm, Real map[3][SIX]) {
    for (int i = 0; i < SIX; i++) {
        const Triple turn = {i == 3, i == 4, i == 5};
        Triple move;
        cross(turn, arm, move);
        if (i < 3) move[i] = 1;
        for (int a = 0; a < 3; a++) map[a][i] = move[a];
    }
}

/* What the pull at an end loses by the moves of both: of the element there. */
static void take_end(const Record *r, const Chain *chain, int end, Real ends[SIX][SIX]) {
    const size_t own = end == 0 ? 0 : r->elements, next = end == 0 ? 1 : r->elements - 1,
                 element = end == 0 ? 0 : next;
    const Element *at = &chain->element[element];
    for (int i = 0; i < SIX; i++) {
        const Real grown = (end == 0 ? 1 : -1) * chain->x[element + 1][0][i];
        Triple d;
        for (int a = 0; a < 3; a++) d[a] = chain->x[next][1 + a][i] - chain->x[own][1 + a][i];
        for (int a = 0; a < 3; a++)
            ends[3 * end + a][i] -=
                at->across * (d[a] - dot(at->e, d) * at->e[a]) + grown * at->e[a];
    }
}

/* What the pull at an end loses as its arm turns. */
static void add_turn(const Record *r, int end, const Triple arm, Real stiffness[SIX * SIX]) {
    Triple pull;
    for (int a = 0; a < 3; a++) pull[a] = -(Real)r->end_force[end][a];
    for (int i = 3; i < SIX; i++) {
        const Triple turn = {i == 3, i == 4, i == 5};
        Triple swept, moment;
        cross(turn, arm, swept);
        cross(swept, pull, moment);
        for (int a = 0; a < 3; a++) stiffness[SIX * (3 + a) + i] -= moment[a];
    }
}

/* What a line changes of the force on the first body as the second one moves, which may be the
 * same. */
static bool add_line(const StiffnessStep *step, const Record *r, const size_t body[2],
                     const BodyState *all, BodyPoints *points, Real stiffness[SIX * SIX]) {
    const size_t to = body[0], from = body[1];
    MovedEnd end[2] = {{.follower = STAYS}, {.follower = STAYS}};
    bool moves = false, matters[2];
    Triple arm[2];
    for (int e = 0; e < 2; e++) {
        end[e].is_on = arm_of(step, r, e, from, &all[from], arm[e]);
        end[e].counts = to == from ? end[e].is_on : arm_of(step, r, e, to, &all[to], arm[e]);
        if (end[e].is_on || end[e].counts) set_map(arm[e], end[e].map);
        if (r->end_point[e] >= 0) end[e].follower = points->number[r->end_point[e]];
        moves = moves || end[e].is_on || end[e].follower != STAYS;
        matters[e] = end[e].is_on || end[e].counts || end[e].follower != STAYS;
    }
    if (!moves) return true;
    Chain chain;
    Real ends[SIX][SIX] = {{0}};
    bool found = chain_create(&chain, r) && is_plain(step, r) && set_line(step, r, matters, &chain);
    if (found) {
        for (int a = 0; a < 3; a++) chain.x[0][1 + a][a] = chain.x[r->elements][1 + a][3 + a] = 1;
        found = solve_line(r, &chain);
    }
    if (found) {
        for (int e = 0; e < 2; e++) take_end(r, &chain, e, ends);
        for (int e = 0; e < 2; e++)
            if (end[e].is_on && end[e].counts) add_turn(r, e, arm[e], stiffness);
        body_points_add(points, ends, end, stiffness);
    }
    chain_free(&chain);
    return found;
}

/* What weight, buoyancy and water lose. */
static void add_load(const StiffnessStep *step, size_t k, const BodyState *at, double arm,
                     Real stiffness[SIX * SIX]) {
    for (int i = 0; i < SIX; i++) {
        static const Real WEIGHT[4] = {1, -8, 8, -1};
        const Real h = i < 3 ? STEP * arm : STEP;
        for (int s = 0; s < 4; s++) {
            const Real by = h * (s < 2 ? s - 2 : s - 1);
            Real load[SIX];
            double position[3], rotation[FOUR];
            const Real c = i < 3 ? 1 : cosl(by / 2), w = i < 3 ? 0 : sinl(by / 2);
            const Triple p = {i == 3 ? w : 0, i == 4 ? w : 0, i == 5 ? w : 0};
            const double *q = at->rotation;
            for (int a = 0; a < 3; a++) position[a] = at->position[a] + (double)(i == a ? by : 0);
            rotation[0] = (double)(c * q[0] - p[0] * q[1] - p[1] * q[2] - p[2] * q[3]);
            rotation[1] = (double)(c * q[1] + p[0] * q[0] + p[1] * q[3] - p[2] * q[2]);
            rotation[2] = (double)(c * q[2] + p[1] * q[0] + p[2] * q[1] - p[0] * q[3]);
            rotation[3] = (double)(c * q[3] + p[2] * q[0] + p[0] * q[2] - p[1] * q[1]);
            body_load_beside(&step->bodies->data[k], position, rotation, q, step->gravity, load);
            for (int a = 0; a < SIX; a++) stiffness[SIX * a + i] -= WEIGHT[s] * load[a] / (12 * h);
        }
    }
}

bool body_coupling(const StiffnessStep *step, size_t to, size_t from, const BodyState *all,
                   Real stiffness[SIX * SIX]) {
    const size_t body[2] = {to, from};
    BodyPoints points;
    memset(stiffness, 0, SIX * SIX * sizeof *stiffness);
    bool found = body_points_open(step, from, &points);
    for (size_t i = 0; i < step->source->lines && found; i++)
        found = add_line(step, &step->line[i], body, all, &points, stiffness);
    found = found && body_points_finish(step, &points, stiffness);
    body_points_close(&points);
    return found;
}

bool body_stiffness(const StiffnessStep *step, size_t k, const BodyState *all, double arm,
                    Real stiffness[SIX * SIX]) {
    if (!body_coupling(step, k, k, all, stiffness)) return false;
    add_load(step, k, &all[k], arm, stiffness);
    return true;
}
