/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's method for free points and bodies (newton_step.h). */
#include "evolve/newton_step.h"

#include <math.h>
#include <string.h>

#include "cable/stiffness.h"
#include "evolve/bodies.h"
#include "evolve/body_motion.h"
#include "evolve/point_motion.h"
#include "evolve/points.h"
#include "linalg/dense.h"

/* A point or body moves by no more than this share of its longest line in one iteration, and turns
 * by no more than this [rad]. */
static const double FARTHEST = 0.5, FARTHEST_TURN = 0.3;
/* The share at which a body that is held back no longer moves. */
static const double MOST_HELD = 1e6;

/* Of a buoyancy, and of a place on a curve, to the last digits. */
enum { BISECTIONS = 60, NEWTON = 4 };

CpsiJointMap cpsi_joint_map(const CpsiBalance *balance, int point) {
    const int k = point == CPSI_NO_POINT ? -1 : balance->number[point],
              body = point == CPSI_NO_POINT ? -1 : balance->rigid_of[point];
    if (k >= 0) return cpsi_joint_map_of_point(3 * k);
    if (body < 0) return (CpsiJointMap){.width = 0};
    return cpsi_joint_map_on_body(3 * balance->count + 6 * body,
                                  cpsi_trial_arm(balance, &balance->rigid[body], point));
}

/* Add what of a body's forces turns with it, and its hydrostatics. */
static void add_body(CpsiBalance *balance, int k) {
    const CpsEvolution *evolution = balance->evolution;
    const CpsiRigid *rigid = &balance->rigid[k];
    double own[36] = {0};
    cpsi_body_whole_stiffness(evolution, &evolution->bodies.body[rigid->body], &rigid->pose, own);
    for (int item = 0; item < balance->line_count; item++)
        for (int end = 0; end < 2; end++) {
            const int i = balance->line[item], point = evolution->points.tie[2 * i + end];
            if (point == CPSI_NO_POINT || balance->rigid_of[point] != k) continue;
            const Vec3 pull = vec3_scale(-1, vec3_load(evolution->line[i].report.end[end].force));
            cpsi_add_turning_force(pull, cpsi_trial_arm(balance, rigid, point), own);
        }
    cpsi_graph_matrix_add_body(balance->matrix, 3 * balance->count + 6 * k, own);
}

static void tangent_of_one(void *data, int worker, int item) {
    CpsiBalance *balance = data;
    CpsEvolution *evolution = balance->evolution;
    CpsiLine *line = &evolution->line[balance->line[item]];
    cpsi_workspace_attach(&evolution->workspace[worker], line);
    cpsi_line_tangent(line, &evolution->workspace[worker].program, &evolution->options,
                      &balance->tangent[36 * item]);
}

/* The stiffness of the lines and bodies at the unknowns. */
void cpsi_fill_matrix(CpsiBalance *balance) {
    const CpsEvolution *evolution = balance->evolution;
    cpsi_workers_run(evolution->workers, tangent_of_one, balance, balance->line_count);
    cpsi_graph_matrix_clear(balance->matrix);
    for (int item = 0; item < balance->line_count; item++) {
        const int *tie = &evolution->points.tie[2 * (size_t)balance->line[item]];
        const CpsiJointMap end[2] = {cpsi_joint_map(balance, tie[0]),
                                     cpsi_joint_map(balance, tie[1])};
        for (int to = 0; to < 2; to++)
            for (int from = 0; from < 2; from++)
                cpsi_graph_matrix_add(
                    balance->matrix, &end[to], &end[from],
                    &balance->tangent[36 * (size_t)item + (size_t)(18 * to + 3 * from)], 6);
    }
    for (int k = 0; k < balance->body_count; k++) add_body(balance, k);
}

/* Entry a of the diagonal of block row k. */
static double *diagonal(CpsiBalance *balance, int k, int a) {
    const CpsiGraphBlock block = cpsi_graph_matrix_block(balance->matrix, k, k);
    return &block.at[(size_t)a * (block.stride + 1)];
}
/* ... and of a body, a = 0 .. 5. */
static double *body_diagonal(CpsiBalance *balance, int k, int a) {
    return diagonal(balance, balance->count + 2 * k + a / 3, a % 3);
}

/* [N/m] What is added to the stiffness of a point or body; of any size where no force acts. */
static double added_stiffness(const CpsiBalance *balance, double length) {
    return CPSI_REGULAR * (balance->force > 0 ? balance->force : 1) / length;
}

/* Add what the water opposes to floats with a height. */
static void add_water(CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++) {
        const CpsiWater *water = &balance->at[k].water;
        const CpsiGraphBlock own = cpsi_graph_matrix_block(balance->matrix, k, k);
        double n[3];
        const double stiffness = cpsi_water_stiffness(water);
        if (!(stiffness > 0)) continue;
        vec3_store(n, water->n);
        for (size_t a = 0; a < 3; a++)
            for (size_t b = 0; b < 3; b++) own.at[a * own.stride + b] += stiffness * n[a] * n[b];
    }
}

/* Add the inertia of points and bodies, in a step in time. */
static void add_inertia(CpsiBalance *balance) {
    const CpsEvolution *evolution = balance->evolution;
    if (!(evolution->interval > 0)) return;
    for (int k = 0; k < balance->count; k++) {
        const CpsiPoint *point = &evolution->points.point[balance->at[k].point];
        for (int a = 0; a < 3; a++) *diagonal(balance, k, a) += cpsi_point_inertia_stiffness(point);
    }
    for (int k = 0; k < balance->body_count; k++) {
        const CpsiRigid *rigid = &balance->rigid[k];
        double own[36] = {0};
        cpsi_body_motion_stiffness(&evolution->bodies.body[rigid->body], &rigid->pose, own);
        cpsi_graph_matrix_add_body(balance->matrix, 3 * balance->count + 6 * k, own);
    }
}

/* The size of the points' stiffnesses, and what is added to them where they have none. */
static void find_stiffness(CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++) {
        CpsiFree *at = &balance->at[k];
        double trace = 0;
        for (int a = 0; a < 3; a++) trace += fabs(*diagonal(balance, k, a));
        const double length = balance->evolution->points.point[at->point].length;
        const double added = added_stiffness(balance, length);
        at->stiffness = fmax(trace / 3, added);
        for (int a = 0; a < 3; a++) *diagonal(balance, k, a) += added;
    }
    for (int k = 0; k < balance->body_count; k++) {
        const CpsiBody *body = &balance->evolution->bodies.body[balance->rigid[k].body];
        for (int a = 0; a < 6; a++)
            *body_diagonal(balance, k, a) +=
                added_stiffness(balance, body->length) * (a < 3 ? 1 : body->arm * body->arm);
    }
}

/* Is the point to be on the obstacle after the step, or in one that gives? */
static bool is_to_touch(const CpsiFree *at) {
    const double gap = at->gives ? at->over : fmax(at->gap, 0);
    return at->obstacle != CPS_NO_OBSTACLE && -vec3_dot(at->rest, at->normal) > at->stiffness * gap;
}

/* The equation P K d + Q d = v of a point in its step, K its rows of the matrix. */
typedef struct Equation {
    double p[3][3], q[3][3];
    Vec3 v;
} Equation;

/* Along the surface: at rest, where friction holds the point; sliding with the friction F = -b e, e
 * the direction of the slip, which turns with it, where a bound b = mu R follows the reaction; or
 * without friction. */
static void add_tangential(Equation *out, const CpsiFree *at, bool follows) {
    const Vec3 n = at->normal, test = cpsi_trial_friction_test(at);
    const double size = vec3_norm(test);
    if (at->bound > 0 && cpsi_is_to_stick(at)) {
        vec3_add_identity(out->q, at->stiffness);
        vec3_add_outer(out->q, -at->stiffness, n, n);
        const Vec3 back = vec3_reject(vec3_sub(at->start, at->place), n);
        out->v = vec3_axpy(at->stiffness, back, out->v);
        return;
    }
    vec3_add_identity(out->p, 1);
    vec3_add_outer(out->p, -1, n, n);
    out->v = vec3_add(out->v, vec3_reject(at->rest, n));
    if (!(at->bound > 0) || !(size > 0)) return;
    const Vec3 e = vec3_scale(1 / size, test);
    const double turns = at->bound / (vec3_norm(at->slip) + at->bound / at->stiffness);
    if (follows && at->gives) /* R by the depth */
        vec3_add_outer(out->q, -at->friction * at->spring, e, n);
    else if (follows)
        vec3_add_outer(out->p, at->friction, e, n);
    vec3_add_identity(out->q, turns);
    vec3_add_outer(out->q, -turns, n, n);
    vec3_add_outer(out->q, -turns, e, e);
    out->v = vec3_axpy(-at->bound, e, out->v);
}

/* Across it: the gap closes, or nothing acts, or the spring of what gives. */
static void add_normal(Equation *out, const CpsiFree *at) {
    const Vec3 n = at->normal;
    if (at->gives && is_to_touch(at)) {
        vec3_add_outer(out->p, 1, n, n);
        vec3_add_outer(out->q, at->spring, n, n);
        out->v = vec3_axpy(vec3_dot(at->rest, n) - at->spring * at->over, n, out->v);
    } else if (is_to_touch(at)) {
        vec3_add_outer(out->q, at->stiffness, n, n);
        out->v = vec3_axpy(-at->stiffness * at->gap, n, out->v);
    } else {
        vec3_add_outer(out->p, 1, n, n);
        out->v = vec3_axpy(vec3_dot(at->rest, n), n, out->v);
    }
}

/* As a point slides on a round obstacle the reaction turns with the normal: the force along the
 * surface gains R times the curvature times the displacement. */
static void add_curvature(Equation *out, const CpsiFree *at, const CpsiObstacle *on) {
    double axes[9], curvature[3];
    const double reaction = fmax(0, -vec3_dot(at->rest, at->normal));
    if (!is_to_touch(at) || (at->bound > 0 && cpsi_is_to_stick(at))) return;
    cpsi_obstacle_axes(on, at->place, vec3(1, 0, 0), axes, curvature);
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++)
            vec3_add_outer(out->q, -reaction * curvature[a + b], vec3_load(&axes[3 * a]),
                           vec3_load(&axes[3 * b]));
}

static Equation equation_of_touch(const CpsiFree *at, const CpsiObstacle *on, bool follows,
                                  bool turns) {
    Equation out = {.v = vec3(0, 0, 0)};
    if (at->drags) {
        const double off = vec3_dot(vec3_sub(at->place, at->start), at->normal);
        add_tangential(&out, at, false);
        vec3_add_outer(out.q, at->stiffness, at->normal, at->normal);
        out.v = vec3_axpy(-at->stiffness * off, at->normal, out.v);
        return out;
    }
    if (at->obstacle == CPS_NO_OBSTACLE) {
        vec3_add_identity(out.p, 1);
        out.v = at->rest;
        return out;
    }
    add_tangential(&out, at, follows);
    add_normal(&out, at);
    if (turns) add_curvature(&out, at, on);
    return out;
}

/* The same with another buoyancy. */
static Equation equation_with(const CpsiFree *at, const CpsiObstacle *on, bool follows, bool turns,
                              double buoyancy) {
    CpsiFree other = *at;
    other.rest = cpsi_rest_with(at, buoyancy);
    other.water.buoyancy = buoyancy;
    return equation_of_touch(&other, on, follows, turns);
}

/* rho times the height above the surface to which a buoyancy brings the point without its lines; it
 * rises with the buoyancy. */
static double lifted_by(const CpsiFree *at, bool follows, double buoyancy) {
    const Vec3 v = equation_with(at, NULL, follows, false, buoyancy).v;
    return at->stiffness * at->water.height + vec3_dot(v, at->water.n);
}

/* The buoyancy with which the step is to be taken: none above the water, all below it, or, where
 * the point is to float, that which brings it to the surface; of a float with a height that of the
 * place, which the matrix says how it changes. */
static double buoyancy_of_step(const CpsiFree *at, bool follows, bool *floats) {
    double low = 0, high = at->water.displaced;
    *floats = false;
    if (at->water.extent > 0) return at->water.buoyancy;
    if (!(high > 0) || lifted_by(at, follows, low) >= 0) return low;
    if (lifted_by(at, follows, high) <= 0) return high;
    *floats = true;
    for (int i = 0; i < BISECTIONS; i++) {
        const double middle = 0.5 * (low + high);
        *(lifted_by(at, follows, middle) < 0 ? &low : &high) = middle;
    }
    return high;
}

/* Replace the equation along c = P n by: the point goes to the surface. */
static void bring_to_surface(Equation *out, const CpsiFree *at) {
    double v[3], e[3], n[3], c[3];
    vec3_store(n, at->water.n);
    for (int a = 0; a < 3; a++) c[a] = vec3_dot(vec3_load(out->p[a]), at->water.n);
    const double size = vec3_norm(vec3_load(c));
    if (!(size > 0)) return; /* friction holds it there */
    vec3_store(v, out->v);
    for (int a = 0; a < 3; a++) e[a] = c[a] / size;
    for (int j = 0; j < 3; j++) {
        double p = 0, q = 0;
        for (int a = 0; a < 3; a++) {
            p += e[a] * out->p[a][j];
            q += e[a] * out->q[a][j];
        }
        for (int a = 0; a < 3; a++) {
            out->p[a][j] -= e[a] * p;
            out->q[a][j] += e[a] * (at->stiffness * n[j] - q);
        }
    }
    const double along = e[0] * v[0] + e[1] * v[1] + e[2] * v[2];
    for (int a = 0; a < 3; a++) v[a] -= e[a] * (along + at->stiffness * at->water.height);
    out->v = vec3_load(v);
}

/* In a set: M K d + rho (1 - M) d = rho (P(z) - x), M the derivative of P (point_set.c). */
static Equation equation_in_set(const CpsiFree *at) {
    CpsiInSet in = at->in_set;
    Equation out = {.v = vec3(0, 0, 0)};
    in.yields = fmax(in.yields, at->stiffness);
    out.v = cpsi_in_set_hold(&in);
    cpsi_in_set_slopes(&in, out.p);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) out.q[a][b] = in.yields * ((a == b) - out.p[a][b]);
    return out;
}

static Equation equation_of(const CpsiFree *at, const CpsiObstacle *on, bool follows, bool turns) {
    if (at->in_set.on) return equation_in_set(at);
    if (!(at->water.displaced > 0)) return equation_of_touch(at, on, follows, turns);
    bool floats;
    Equation out = equation_with(at, on, follows, turns, buoyancy_of_step(at, follows, &floats));
    if (floats) bring_to_surface(&out, at);
    return out;
}

/* The rows of the points; `turns`: with what the reactions gain as the normals turn. */
static void set_points(CpsiBalance *balance, bool turns) {
    const CpsEvolution *evolution = balance->evolution;
    for (int k = 0; k < balance->count; k++) {
        const CpsiFree *at = &balance->at[k];
        const CpsiObstacle *on =
            at->obstacle == CPS_NO_OBSTACLE ? NULL : &evolution->obstacle[at->obstacle];
        const Equation is = equation_of(at, on, balance->follows, turns);
        cpsi_graph_matrix_turn(balance->matrix, k, is.p);
        const CpsiGraphBlock own = cpsi_graph_matrix_block(balance->matrix, k, k);
        for (size_t a = 0; a < 3; a++)
            for (size_t b = 0; b < 3; b++) own.at[a * own.stride + b] += is.q[a][b];
        vec3_store(&balance->right[3 * k], is.v);
    }
}

/* The rows of the bodies: nothing moves in a fixed direction. */
static void set_bodies(CpsiBalance *balance) {
    for (int k = 0; k < balance->body_count; k++) {
        const CpsiRigid *rigid = &balance->rigid[k];
        const CpsiBody *body = &balance->evolution->bodies.body[rigid->body];
        const int first = balance->count + 2 * k;
        vec3_store(&balance->right[3 * first], rigid->left.force);
        vec3_store(&balance->right[3 * first + 3], rigid->left.moment);
        for (int a = 0; a < 6; a++)
            if (body->given.fixed[a]) cpsi_graph_matrix_fix(balance->matrix, first + a / 3, a % 3);
    }
}

/* [J] The work along the step of the forces that are left. */
double cpsi_work_along(const CpsiBalance *balance) {
    double work = 0;
    for (int k = 0; k < balance->count; k++)
        work += vec3_dot(balance->at[k].left, vec3_load(&balance->step[3 * k]));
    for (int k = 0; k < balance->body_count; k++) {
        const double *step = &balance->step[3 * balance->count + 6 * k];
        const CpsiWrench *left = &balance->rigid[k].left;
        work +=
            vec3_dot(left->force, vec3_load(step)) + vec3_dot(left->moment, vec3_load(&step[3]));
    }
    return work;
}

/* The symmetric part of a stiffness in the directions that are not fixed, rotations times the arm,
 * less a share of its largest entry: is it positive definite? */
static bool is_definite_by(const double stiffness[36], const bool fixed[6], double arm,
                           double share) {
    double m[36], l[36], most = 0;
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 6; k++) {
            const double unit = (i < 3 ? 1 : arm) * (k < 3 ? 1 : arm);
            m[6 * i + k] = fixed[i] || fixed[k]
                               ? 0
                               : 0.5 * (stiffness[6 * i + k] + stiffness[6 * k + i]) / unit;
            most = fmax(most, fabs(m[6 * i + k]));
        }
    for (int i = 0; i < 6; i++) m[7 * i] = fixed[i] ? 1 : m[7 * i] - share * most;
    return cpsi_cholesky(6, m, l);
}

bool cpsi_is_definite(const double stiffness[36], const bool fixed[6], double arm) {
    return is_definite_by(stiffness, fixed, arm, 0);
}

bool cpsi_is_stable(const double stiffness[36], const bool fixed[6], double arm) {
    return is_definite_by(stiffness, fixed, arm, CPSI_NEUTRAL);
}

/* The block of body k in the matrix. */
void cpsi_body_block(const CpsiBalance *balance, int k, double out[36]) {
    const int first = balance->count + 2 * k;
    for (int i = 0; i < 36; i++) {
        const int row = i / 6, column = i % 6;
        const CpsiGraphBlock block =
            cpsi_graph_matrix_block(balance->matrix, first + row / 3, first + column / 3);
        out[i] = block.at[(size_t)(row % 3) * block.stride + (size_t)(column % 3)];
    }
}

/* The size of a body's stiffness against displacements and against rotations. */
static void size_of_stiffness(const CpsiBalance *balance, int k, double size[6]) {
    const CpsiBody *body = &balance->evolution->bodies.body[balance->rigid[k].body];
    double block[36], most[2] = {CPSI_REGULAR * balance->force / body->length, 0};
    cpsi_body_block(balance, k, block);
    for (int i = 0; i < 6; i++)
        if (!body->given.fixed[i]) most[i / 3] = fmax(most[i / 3], fabs(block[7 * i]));
    most[1] = fmax(most[1], most[0] * body->arm * body->arm * CPSI_REGULAR);
    for (int i = 0; i < 6; i++) size[i] = most[i / 3];
}

/* Are the poses of all bodies stable, held back by a share of their own stiffness? */
static bool are_definite(const CpsiBalance *balance, double share) {
    for (int k = 0; k < balance->body_count; k++) {
        const CpsiBody *body = &balance->evolution->bodies.body[balance->rigid[k].body];
        double block[36], size[6];
        cpsi_body_block(balance, k, block);
        size_of_stiffness(balance, k, size);
        for (int i = 0; i < 6; i++) block[7 * i] += share * size[i];
        if (!cpsi_is_definite(block, body->given.fixed, body->arm)) return false;
    }
    return true;
}

/* Solve for the step with bodies held back by a share of their own stiffness. */
static bool solve_step(CpsiBalance *balance, double share) {
    const size_t n = (size_t)balance->unknowns;
    memcpy(balance->step, balance->right, n * sizeof *balance->step);
    for (int k = 0; k < balance->body_count; k++) {
        const CpsiBody *body = &balance->evolution->bodies.body[balance->rigid[k].body];
        double size[6];
        size_of_stiffness(balance, k, size);
        for (int a = 0; a < 6; a++) {
            balance->kept[6 * k + a] = *body_diagonal(balance, k, a);
            if (!body->given.fixed[a]) *body_diagonal(balance, k, a) += share * size[a];
        }
    }
    const bool done = cpsi_graph_matrix_factor(balance->matrix);
    if (done) cpsi_graph_matrix_solve(balance->matrix, balance->step);
    for (int i = 0; i < 6 * balance->body_count; i++)
        *body_diagonal(balance, i / 6, i % 6) = balance->kept[i];
    if (!done) return false;
    for (size_t i = 0; i < n; i++)
        if (!isfinite(balance->step[i])) return false;
    return true;
}

/* Set the matrix and the right-hand side; is there an obstacle whose normal turns? */
static bool set_matrix(CpsiBalance *balance, bool turns) {
    const CpsEvolution *evolution = balance->evolution;
    bool any = false;
    for (int k = 0; k < evolution->obstacle_count; k++)
        any = any || evolution->obstacle[k].kind != CPS_OBSTACLE_PLANE;
    cpsi_fill_matrix(balance);
    add_water(balance);
    add_inertia(balance);
    find_stiffness(balance);
    set_points(balance, turns && any);
    set_bodies(balance);
    return any;
}

/* The step of all points and bodies by Newton's method. Where a body in its pose is not stable that
 * may lead up the energy; then it is held back. */
bool cpsi_find_step(CpsiBalance *balance) {
    const bool turns = set_matrix(balance, true);
    if (balance->body_count == 0) {
        if (!turns) return solve_step(balance, 0);
        if (solve_step(balance, 0) && cpsi_work_along(balance) > 0) return true;
        (void)set_matrix(balance, false);
        return solve_step(balance, 0);
    }
    for (double share = 0; share<MOST_HELD; share = share> 0 ? 10 * share : CPSI_LEAST_HELD)
        if (are_definite(balance, share) && solve_step(balance, share) &&
            cpsi_work_along(balance) > 0)
            return true;
    return false;
}

bool cpsi_find_least_step(CpsiBalance *balance) {
    const CpsEvolution *evolution = balance->evolution;
    (void)set_matrix(balance, true);
    memset(balance->right, 0, (size_t)balance->unknowns * sizeof *balance->right);
    for (int k = 0; k < balance->count; k++) {
        const CpsiFree *at = &balance->at[k];
        const CpsiPoint *point = &evolution->points.point[at->point];
        const CpsiObstacle *on =
            at->obstacle == CPS_NO_OBSTACLE ? NULL : &evolution->obstacle[at->obstacle];
        const Vec3 was = on || at->drags ? at->start : vec3_load(point->before);
        const double added = added_stiffness(balance, point->length);
        const Equation is = equation_of(at, on, balance->follows, true);
        double back[3];
        vec3_store(back, vec3_scale(added, vec3_sub(was, at->place)));
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) balance->right[3 * k + i] += is.p[i][j] * back[j];
    }
    return solve_step(balance, 0);
}

/* Without a matrix: every point along the force that is left on it. */
void cpsi_follow_forces(CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++) {
        const CpsiFree *at = &balance->at[k];
        vec3_store(&balance->step[3 * k],
                   at->stiffness > 0 ? vec3_scale(1 / at->stiffness, at->left) : vec3(0, 0, 0));
    }
    for (int k = 0; k < balance->body_count; k++) {
        double size[6];
        size_of_stiffness(balance, k, size);
        for (int a = 0; a < 6; a++) {
            const int i = 3 * balance->count + 6 * k + a;
            balance->step[i] = size[a] > 0 ? balance->right[i] / size[a] : 0;
        }
    }
}

/* The share of a displacement or rotation that is no longer than `most`. */
static double share_within(const double step[3], double most) {
    const double size = vec3_norm(vec3_load(step));
    return size > most ? most / size : 1;
}

void cpsi_limit(double step[3], double most) {
    const double share = share_within(step, most);
    for (int a = 0; a < 3; a++) step[a] *= share;
}

/* Without bodies each point by itself. */
static void limit_points(CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++)
        cpsi_limit(&balance->step[3 * k],
                   FARTHEST * balance->evolution->points.point[balance->at[k].point].length);
}

/* With bodies all by the same share: a displacement without the rotation that belongs to it may
 * lead up the energy. */
void cpsi_limit_step(CpsiBalance *balance) {
    const CpsEvolution *evolution = balance->evolution;
    double share = 1;
    if (balance->body_count == 0) {
        limit_points(balance);
        return;
    }
    for (int k = 0; k < balance->count; k++)
        share = fmin(share,
                     share_within(&balance->step[3 * k],
                                  FARTHEST * evolution->points.point[balance->at[k].point].length));
    for (int k = 0; k < balance->body_count; k++) {
        const double *step = &balance->step[3 * balance->count + 6 * k];
        const double most = FARTHEST * evolution->bodies.body[balance->rigid[k].body].length;
        share = fmin(share, share_within(step, most));
        share = fmin(share, share_within(&step[3], FARTHEST_TURN));
    }
    for (int i = 0; i < balance->unknowns; i++) balance->step[i] *= share;
}

/* Where an obstacle meets the surface of the water, near x. */
static Vec3 along_the_waterline(const CpsiObstacle *on, const CpsiSurface *surface, Vec3 x) {
    const Vec3 up = surface->n;
    x = cpsi_surface_below(surface, x);
    for (int i = 0; i < NEWTON; i++) {
        const Vec3 n = cpsi_obstacle_normal(on, x),
                   level = vec3_axpy(-vec3_dot(n, up) / vec3_dot(up, up), up, n);
        const double size = vec3_dot(level, level);
        if (size > 0) x = vec3_axpy(-cpsi_obstacle_gap(on, x) / size, level, x);
    }
    return x;
}

/* A place without slip in what gives, as deep as x. */
static Vec3 without_slip(const CpsiObstacle *on, Vec3 start, Vec3 x) {
    const double higher = cpsi_obstacle_gap(on, x) - cpsi_obstacle_gap(on, start);
    return vec3_axpy(higher, cpsi_obstacle_normal(on, start), start);
}

/* The place x in what gives, as deep as the tangent plane says: the way along that leads out of
 * what is round, by its square over the radius, of which a stiff ground makes a large force. */
static Vec3 as_deep_as_planned(const CpsiObstacle *on, const CpsiFree *from, Vec3 x) {
    if (on->kind == CPS_OBSTACLE_PLANE) return x;
    const double gap = from->gap + vec3_dot(from->normal, vec3_sub(x, from->place));
    return vec3_axpy(gap - cpsi_obstacle_gap(on, x), cpsi_obstacle_normal(on, x), x);
}

/* The place of a point that is to touch what gives, after a share of the step. */
static Vec3 place_within(const CpsiBalance *balance, const CpsiFree *from, bool floats, Vec3 x,
                         double share) {
    const CpsEvolution *evolution = balance->evolution;
    const CpsiObstacle *on = &evolution->obstacle[from->obstacle];
    x = as_deep_as_planned(on, from, x);
    if (cpsi_is_to_stick(from) && share == 1) x = without_slip(on, from->start, x);
    if (!(from->water.displaced > 0)) return x;
    const CpsiSurface *surface = &evolution->points.point[from->point].surface;
    return floats && share == 1 ? cpsi_surface_below(surface, x)
                                : cpsi_water_stop(&from->water, surface, x);
}

/* The place of a point after a share of the step: out of every rigid obstacle, and on that on which
 * it is to lie; exactly where it was where it is to stick. */
Vec3 cpsi_place_after(const CpsiBalance *balance, const CpsiFree *from, const double step[3],
                      double share) {
    const CpsEvolution *evolution = balance->evolution;
    Vec3 x = vec3_axpy(share, vec3_load(step), from->place);
    if (from->drags) {
        if (cpsi_is_to_stick(from) && share == 1) return from->start;
        return vec3_axpy(-vec3_dot(vec3_sub(x, from->start), from->normal), from->normal, x);
    }
    bool floats;
    CpsiFree next = *from;
    next.rest = cpsi_rest_with(from, buoyancy_of_step(from, balance->follows, &floats));
    const bool touches = is_to_touch(&next);
    const bool sinks = touches && from->gives;
    if (sinks) x = place_within(balance, from, floats, x, share);
    if (touches && !sinks && cpsi_is_to_stick(from) && share == 1) return from->start;
    if (touches && !sinks) {
        const CpsiObstacle *on = &evolution->obstacle[from->obstacle];
        const double gap = cpsi_obstacle_gap(on, x);
        /* what lies on a round one stays on it, and loses neither reaction nor friction on the way
         */
        const bool stays =
            on->kind != CPS_OBSTACLE_PLANE && from->gap <= cpsi_trial_touch(balance, from);
        if (share == 1 || gap < 0 || stays) x = vec3_axpy(-gap, cpsi_obstacle_normal(on, x), x);
    }
    const CpsiSurface *surface = &evolution->points.point[from->point].surface;
    if (from->water.displaced > 0 && !touches) x = cpsi_water_stop(&from->water, surface, x);
    if (floats && touches && !sinks && share == 1)
        x = along_the_waterline(&evolution->obstacle[from->obstacle], surface, x);
    for (int k = 0; k < evolution->obstacle_count; k++) {
        if (evolution->obstacle[k].stiffness > 0) continue;
        const double gap = cpsi_obstacle_gap(&evolution->obstacle[k], x);
        if (gap < 0) x = vec3_axpy(-gap, cpsi_obstacle_normal(&evolution->obstacle[k], x), x);
    }
    return x;
}

/* The rotation from one to another without its components, as one vector, in fixed directions: with
 * one axis fixed, rotations about the two others would add up to one about it. */
static Rotation without_fixed(const bool fixed[6], Rotation from, Rotation to) {
    if (fixed[3] + fixed[4] + fixed[5] != 1) return to;
    double turn[3];
    vec3_store(turn, rotation_vector(rotation_after(to, rotation_inverse(from))));
    for (int i = 0; i < 3; i++)
        if (fixed[3 + i]) turn[i] = 0;
    return rotation_after(rotation_of(vec3_load(turn)), from);
}

/* The pose of body k after a share of the step. */
CpsiPose cpsi_pose_after(const CpsiBalance *balance, int k, const CpsiPose *from,
                         const double step[6], double share) {
    const CpsiBody *body = &balance->evolution->bodies.body[balance->rigid[k].body];
    const Rotation turn =
        rotation_after(rotation_of(vec3_scale(share, vec3_load(&step[3]))), from->turn);
    return (CpsiPose){vec3_axpy(share, vec3_load(step), from->place),
                      without_fixed(body->given.fixed, body->pose.turn, turn)};
}
