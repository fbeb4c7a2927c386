/* SPDX-License-Identifier: BSD-3-Clause */
/* Self-stresses through free bodies (body_self_stress.h).
 *
 * The forces are those of the places and poses of least excess, sum l e^2/2 with e = max(0, |X_B -
 * X_A|/l - 1), found by Newton's method with a stiffness added to points and bodies wherever the
 * excess would not fall (Levenberg). The proof does not depend on how they were found: it asks for
 * balanced forces on points and bodies, and takes the largest tr(Q' N) over all rotations Q for
 * each body. At poses of least excess the moments balance, which makes that trace stationary; where
 * it is not the largest there, the body is turned to where it is, and the search goes on. */
#include "evolve/body_self_stress.h"

#include <math.h>
#include <string.h>

#include "evolve/bodies.h"
#include "evolve/newton_step.h"
#include "evolve/points.h"
#include "linalg/dense.h"
#include "linalg/farthest_rotation.h"

enum { ITERATIONS = 200, TURNS = 6, CORRECTIONS = 2 };
/* [per longest line] The stiffness that is added at first, the least and the most. */
static const double FIRST = 1e-3, LEAST = 1e-12, MOST = 1e9;
/* It changes by these factors where the excess has fallen, or has not. */
static const double LESS = 0.1, MORE = 10;
/* The search ends where no force is left that is larger than this share of the largest, or no line
 * is longer by more than this share. */
static const double BALANCED = 1e-15, NO_EXCESS = 1e-12;
/* What is missing must exceed this share of the sum of |p| times the size of the numbers, which is
 * rounding, */
static const double ROUNDING = 1e-13;
/* ... and by this factor what the imbalance of the forces might bring at other places. */
static const double BEYOND = 2;

/* A line that takes part, where the trial has its ends: its force p on what is at A, e along it. */
typedef struct Stress {
    Vec3 span, direction, force;
    double distance, size;
} Stress;

/* The place of an end; false for one that is neither held nor at a free point or body. */
static bool find_end(const CpsiBalance *balance, int item, int end, Vec3 *place) {
    const CpsEvolution *evolution = balance->evolution;
    const CpsiLine *line = &evolution->line[balance->line[item]];
    if (cpsi_trial_place(balance, evolution->points.tie[2 * balance->line[item] + end], place))
        return true;
    *place = vec3_load(line->end[end].value);
    return line->end[end].kind == CPS_END_KIND_HELD;
}

static const CpsiLine *line_of(const CpsiBalance *balance, int item) {
    return &balance->evolution->line[balance->line[item]];
}

/* The force of a line that takes part, an inextensible one without a loose end; else none. */
static Stress stress_of(const CpsiBalance *balance, int item) {
    const CpsiLine *line = line_of(balance, item);
    Stress out = {.force = vec3(0, 0, 0)};
    Vec3 end[2];
    for (int side = 0; side < 2; side++)
        if (!find_end(balance, item, side, &end[side])) return out;
    if (line->compliance > 0) return out;
    out.span = vec3_sub(end[1], end[0]);
    out.distance = vec3_norm(out.span);
    out.size = fmax(0, out.distance / line->length - 1);
    if (!(out.size > 0)) return out;
    out.direction = vec3_scale(1 / out.distance, out.span);
    out.force = vec3_scale(out.size, out.direction);
    return out;
}

/* [m] sum l e^2/2, and the largest e. */
static double excess(const CpsiBalance *balance, double *largest) {
    double sum = 0;
    *largest = 0;
    for (int item = 0; item < balance->line_count; item++) {
        const double e = stress_of(balance, item).size;
        sum += 0.5 * line_of(balance, item)->length * e * e;
        *largest = fmax(*largest, e);
    }
    return sum;
}

/* the search ----------------------------------------------------------------------------------- */

/* Add the force on an end of a line to what is left at its point or body. */
static void add_force(CpsiBalance *balance, int item, int end, Vec3 force) {
    const int point = balance->evolution->points.tie[2 * balance->line[item] + end];
    if (point == CPSI_NO_POINT) return;
    const int k = balance->number[point], body = balance->rigid_of[point];
    if (k >= 0) balance->at[k].left = vec3_add(balance->at[k].left, force);
    if (body < 0) return;
    CpsiWrench *left = &balance->rigid[body].left;
    const Vec3 arm = cpsi_trial_arm(balance, &balance->rigid[body], point);
    left->force = vec3_add(left->force, force);
    left->moment = vec3_add(left->moment, vec3_cross(arm, force));
}

/* p of line `item` as it is stored. */
static Vec3 force_of(const CpsiBalance *balance, int item) {
    return vec3_load(&balance->guess.pull[6 * item]);
}

static void store_force(CpsiBalance *balance, int item, Vec3 p) {
    vec3_store(&balance->guess.pull[6 * item], p);
    vec3_store(&balance->guess.pull[6 * item + 3], vec3_scale(-1, p));
}

/* Store the forces of the places of the trial. */
static void store_forces(CpsiBalance *balance) {
    for (int item = 0; item < balance->line_count; item++)
        store_force(balance, item, stress_of(balance, item).force);
}

/* What the stored forces and their moments leave, in fixed directions of bodies as well. */
static void find_left(CpsiBalance *balance) {
    const Vec3 none = vec3(0, 0, 0);
    for (int k = 0; k < balance->count; k++) balance->at[k].left = none;
    for (int k = 0; k < balance->body_count; k++) balance->rigid[k].left = (CpsiWrench){none, none};
    for (int item = 0; item < balance->line_count; item++) {
        const Vec3 force = force_of(balance, item);
        add_force(balance, item, CPS_END_A, force);
        add_force(balance, item, CPS_END_B, vec3_scale(-1, force));
    }
}

/* l e^2/2 of a line with a force differentiated twice by X_B - X_A. */
static void stiffness_of(const CpsiBalance *balance, int item, const Stress *stress, double k[9]) {
    const double across = stress->size / stress->distance,
                 along = 1 / line_of(balance, item)->length - across;
    const double *t = &stress->direction.x;
    for (int i = 0; i < 9; i++) k[i] = along * t[i / 3] * t[i % 3] + (i % 4 == 0 ? across : 0);
}

static void add_line(CpsiBalance *balance, int item) {
    const Stress stress = stress_of(balance, item);
    if (!(stress.size > 0)) return;
    const int *tie = &balance->evolution->points.tie[2 * (size_t)balance->line[item]];
    const CpsiJointMap end[2] = {cpsi_joint_map(balance, tie[0]), cpsi_joint_map(balance, tie[1])};
    double k[9];
    stiffness_of(balance, item, &stress, k);
    for (int to = 0; to < 2; to++)
        for (int from = 0; from < 2; from++) {
            double block[9];
            for (int i = 0; i < 9; i++) block[i] = to == from ? k[i] : -k[i];
            cpsi_graph_matrix_add(balance->matrix, &end[to], &end[from], block, 3);
        }
    for (int side = 0; side < 2; side++) {
        const int body = tie[side] == CPSI_NO_POINT ? -1 : balance->rigid_of[tie[side]];
        double own[36] = {0};
        if (body < 0) continue;
        cpsi_add_turning_force(vec3_scale(side == CPS_END_A ? 1 : -1, stress.force),
                               cpsi_trial_arm(balance, &balance->rigid[body], tie[side]), own);
        cpsi_graph_matrix_add_body(balance->matrix, 3 * balance->count + 6 * body, own);
    }
}

/* Add a stiffness to entry a of block row k. */
static void add_own(CpsiBalance *balance, int k, int a, double stiffness) {
    const CpsiGraphBlock block = cpsi_graph_matrix_block(balance->matrix, k, k);
    block.at[(size_t)a * (block.stride + 1)] += stiffness;
}

/* The step with a stiffness added [1/m]; false where there is none. */
static bool find_step(CpsiBalance *balance, double added) {
    cpsi_graph_matrix_clear(balance->matrix);
    for (int item = 0; item < balance->line_count; item++) add_line(balance, item);
    for (int k = 0; k < balance->count; k++) {
        for (int a = 0; a < 3; a++) add_own(balance, k, a, added);
        vec3_store(&balance->step[3 * k], balance->at[k].left);
    }
    for (int k = 0; k < balance->body_count; k++) {
        const CpsiRigid *rigid = &balance->rigid[k];
        const CpsiBody *body = &balance->evolution->bodies.body[rigid->body];
        const int first = balance->count + 2 * k;
        vec3_store(&balance->step[3 * first], rigid->left.force);
        vec3_store(&balance->step[3 * first + 3], rigid->left.moment);
        for (int a = 0; a < 6; a++)
            add_own(balance, first + a / 3, a % 3, added * (a < 3 ? 1 : body->arm * body->arm));
        for (int a = 0; a < 6; a++) {
            if (!body->given.fixed[a]) continue;
            cpsi_graph_matrix_fix(balance->matrix, first + a / 3, a % 3);
            balance->step[3 * first + a] = 0;
        }
    }
    if (!cpsi_graph_matrix_factor(balance->matrix)) return false;
    cpsi_graph_matrix_solve(balance->matrix, balance->step);
    for (int i = 0; i < balance->unknowns; i++)
        if (!isfinite(balance->step[i])) return false;
    return true;
}

/* Shorten the step where it is too long; was it? */
static bool is_shortened(CpsiBalance *balance) {
    const double before = cpsi_norm(balance->unknowns, balance->step);
    cpsi_limit_step(balance);
    return cpsi_norm(balance->unknowns, balance->step) < 0.5 * before;
}

static void take_step(CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++)
        balance->at[k].place = vec3_add(balance->from[k].place, vec3_load(&balance->step[3 * k]));
    for (int k = 0; k < balance->body_count; k++)
        balance->rigid[k].pose = cpsi_pose_after(balance, k, &balance->rigid_from[k].pose,
                                                 &balance->step[3 * balance->count + 6 * k], 1);
}

/* What is left, the largest force or moment over the arm of its body, in free directions. */
static double largest_left(const CpsiBalance *balance) {
    double most = 0;
    for (int k = 0; k < balance->count; k++) most = fmax(most, vec3_norm(balance->at[k].left));
    for (int k = 0; k < balance->body_count; k++) {
        const CpsiBody *body = &balance->evolution->bodies.body[balance->rigid[k].body];
        double left[6];
        vec3_store(left, balance->rigid[k].left.force);
        vec3_store(&left[3], balance->rigid[k].left.moment);
        for (int a = 0; a < 6; a++)
            if (!body->given.fixed[a]) most = fmax(most, fabs(left[a]) / (a < 3 ? 1 : body->arm));
    }
    return most;
}

/* Go to the places of least excess near those of the trial; false where none is left. */
static bool minimise(CpsiBalance *balance, double longest) {
    double added = FIRST / longest, most, now = excess(balance, &most);
    store_forces(balance);
    find_left(balance);
    for (int i = 0; i < ITERATIONS && added < MOST / longest; i++) {
        if (!(most > NO_EXCESS)) return false;
        if (largest_left(balance) <= BALANCED * most) return true;
        memcpy(balance->from, balance->at, (size_t)balance->count * sizeof *balance->at);
        memcpy(balance->rigid_from, balance->rigid,
               (size_t)balance->body_count * sizeof *balance->rigid);
        double largest, then = INFINITY;
        bool shortened = false;
        if (find_step(balance, added)) {
            shortened = is_shortened(balance);
            take_step(balance);
            then = excess(balance, &largest);
        }
        if (then < now) {
            /* what nothing holds would go far, and all else with it by a small share only */
            added = shortened ? MORE * added : fmax(LESS * added, LEAST / longest);
            now = then;
            most = largest;
            store_forces(balance);
            find_left(balance);
        } else {
            added *= MORE;
            memcpy(balance->at, balance->from, (size_t)balance->count * sizeof *balance->at);
            memcpy(balance->rigid, balance->rigid_from,
                   (size_t)balance->body_count * sizeof *balance->rigid);
        }
    }
    return true;
}

/* The displacement of an end by the step. */
static Vec3 end_moves(const CpsiBalance *balance, int point) {
    const CpsiJointMap map = cpsi_joint_map(balance, point);
    double move[3] = {0};
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < map.width; i++) move[a] += map.by[a][i] * balance->step[map.first + i];
    return vec3_load(move);
}

/* Balance the forces to the last digits. Those of the places have lost as many as the excess is
 * small; the forces of one more step are added to them, and the places stay. */
static void balance_forces(CpsiBalance *balance, double longest) {
    for (int i = 0; i < CORRECTIONS; i++) {
        find_left(balance);
        if (!find_step(balance, LEAST / longest)) return;
        for (int item = 0; item < balance->line_count; item++) {
            const Stress stress = stress_of(balance, item);
            const int *tie = &balance->evolution->points.tie[2 * (size_t)balance->line[item]];
            if (!(stress.size > 0)) continue;
            double k[9], p[3];
            vec3_store(p, force_of(balance, item));
            stiffness_of(balance, item, &stress, k);
            const Vec3 longer =
                vec3_sub(end_moves(balance, tie[CPS_END_B]), end_moves(balance, tie[CPS_END_A]));
            for (int a = 0; a < 9; a++) p[a / 3] += k[a] * (&longer.x)[a % 3];
            store_force(balance, item, vec3_load(p));
        }
    }
    find_left(balance);
}

/* the proof ------------------------------------------------------------------------------------ */

static bool may_turn(const CpsiBody *body) {
    return !body->given.fixed[3] || !body->given.fixed[4] || !body->given.fixed[5];
}

/* N = -sum p s', s the place of an end in the body's axes, p with its sign at end B: the larger
 * tr(Q' N), the shorter are the ways to the body along the forces. */
static void sum_of_forces(const CpsiBalance *balance, int k, double n[3][3]) {
    const CpsiPoints *points = &balance->evolution->points;
    memset(n, 0, 9 * sizeof(double));
    for (int item = 0; item < balance->line_count; item++)
        for (int end = 0; end < 2; end++) {
            const int point = points->tie[2 * balance->line[item] + end];
            if (point == CPSI_NO_POINT || balance->rigid_of[point] != k) continue;
            const Vec3 p = force_of(balance, item);
            for (int i = 0; i < 9; i++)
                n[i / 3][i % 3] += (end == CPS_END_A ? 1 : -1) * (&p.x)[i / 3] *
                                   points->given[point].position[i % 3];
        }
}

/* tr(Q' N) in the pose of the trial. */
static double trace_now(const CpsiRigid *rigid, double n[3][3]) {
    double trace = 0;
    for (int c = 0; c < 3; c++) {
        const Vec3 axis = rotation_apply(rigid->pose.turn, vec3(c == 0, c == 1, c == 2));
        trace += axis.x * n[0][c] + axis.y * n[1][c] + axis.z * n[2][c];
    }
    return trace;
}

/* By how much another rotation of the bodies shortens the ways along the forces, in all. With
 * `turn` each is turned to where that is most. */
static double gained_by_turning(CpsiBalance *balance, bool turn) {
    double sum = 0;
    for (int k = 0; k < balance->body_count; k++) {
        CpsiRigid *rigid = &balance->rigid[k];
        double n[3][3], quaternion[4];
        if (!may_turn(&balance->evolution->bodies.body[rigid->body])) continue;
        sum_of_forces(balance, k, n);
        const double most = cpsi_farthest_rotation(n, quaternion);
        sum += fmax(0, most - trace_now(rigid, n));
        if (turn) rigid->pose.turn = rotation_load(quaternion);
    }
    return sum;
}

/* How far a point or body may be from where the trial has it: lines and bodies reach no farther. */
static double reach(const CpsiBalance *balance) {
    double sum = 0;
    for (int item = 0; item < balance->line_count; item++)
        sum += line_of(balance, item)->length + stress_of(balance, item).distance;
    for (int k = 0; k < balance->body_count; k++)
        sum += 4 * balance->evolution->bodies.body[balance->rigid[k].body].arm;
    return sum;
}

/* The sizes of the forces that are not balanced, those that would move a body in its fixed
 * directions left out. */
static double imbalance(const CpsiBalance *balance) {
    double sum = 0;
    for (int k = 0; k < balance->count; k++) sum += vec3_norm(balance->at[k].left);
    for (int k = 0; k < balance->body_count; k++) {
        const CpsiBody *body = &balance->evolution->bodies.body[balance->rigid[k].body];
        double force[3];
        vec3_store(force, balance->rigid[k].left.force);
        for (int a = 0; a < 3; a++)
            if (!body->given.fixed[a]) sum += fabs(force[a]);
    }
    return sum;
}

/* [m] What is missing with the largest |p| as unit; not positive: no proof. */
static double proven(CpsiBalance *balance) {
    double most = 0, sum = 0, sizes = 0;
    for (int item = 0; item < balance->line_count; item++) {
        const Vec3 p = force_of(balance, item);
        const double size = vec3_norm(p), length = line_of(balance, item)->length;
        Vec3 end[2];
        if (!(size > 0)) continue;
        most = fmax(most, size);
        sum += vec3_dot(p, stress_of(balance, item).span) - size * length;
        sizes += size * length;
        for (int side = 0; side < 2; side++)
            if (find_end(balance, item, side, &end[side])) sizes += size * vec3_norm(end[side]);
    }
    sum -= gained_by_turning(balance, false);
    const double sure = sum - ROUNDING * sizes - BEYOND * imbalance(balance) * reach(balance);
    return most > 0 && sure > 0 ? sum / most : 0;
}

/* Make the largest force 1. */
static void scale_forces(CpsiBalance *balance) {
    double most = 0;
    for (int item = 0; item < balance->line_count; item++)
        most = fmax(most, vec3_norm(force_of(balance, item)));
    for (int item = 0; item < balance->line_count; item++)
        store_force(balance, item, vec3_scale(1 / most, force_of(balance, item)));
}

bool cpsi_bodies_are_out_of_reach(CpsiBalance *balance, double *missing) {
    double longest = 0;
    for (int item = 0; item < balance->line_count; item++)
        longest = fmax(longest, line_of(balance, item)->length);
    cpsi_trial_use_blocks(balance);
    for (int turn = 0; turn < TURNS; turn++) {
        if (!minimise(balance, longest)) return false;
        balance_forces(balance, longest);
        *missing = proven(balance);
        if (*missing > 0) {
            scale_forces(balance);
            return true;
        }
        (void)gained_by_turning(balance, true);
    }
    return false;
}
