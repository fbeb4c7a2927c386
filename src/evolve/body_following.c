/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points that follow bodies (body_following.h).
 *
 * By the motion u of a body, the points moving by y, the forces on the body lose K_uu u + K_uy y.
 * The points keep to their equations P (K_yu u + K_yy y) + Q y = 0 (following.h), so that its
 * stiffness is
 *
 *     K_uu - K_uy (P K_yy + Q)^-1 P K_yu.
 *
 * The rows of all bodies are set to those of the identity: with a unit motion as the right-hand
 * side there the solution has y. What other bodies lose by the motion of the one, A' K y of the
 * lines at them, is their coupling. Where a point is held by nothing, as between slack lines, the
 * least stiffness of the search is added to K_yy: what the lines lose along such a motion is 0 as
 * well. */
#include "evolve/body_following.h"

#include <math.h>
#include <string.h>

#include "evolve/following.h"
#include "evolve/newton_step.h"
#include "evolve/point_motion.h"
#include "evolve/points.h"
#include "linalg/dense.h"

/* A point that follows by more than so many times what moves, rotations by the arm of the body, is
 * held by rounding alone. */
static const double TOO_FAR = 1e8;

/* Set the rows of the points, with a stiffness added to each, and of the bodies. */
static bool set_rows(CpsiBalance *balance, bool adds) {
    const CpsEvolution *evolution = balance->evolution;
    const bool is_static = evolution->has_static && evolution->done == 0;
    for (int k = 0; k < balance->count; k++) {
        const CpsiPoint *point = &evolution->points.point[balance->at[k].point];
        const CpsiGraphBlock own = cpsi_graph_matrix_block(balance->matrix, k, k);
        const double least =
            CPSI_REGULAR * (balance->force > 0 ? balance->force : 1) / point->length;
        double size = 0;
        for (size_t a = 0; a < 3; a++) {
            double *diagonal = &own.at[a * (own.stride + 1)];
            if (evolution->interval > 0) *diagonal += cpsi_point_inertia_stiffness(point);
            if (adds) *diagonal += least;
            size += fabs(*diagonal) / 3;
        }
        CpsiFollowerRows rows;
        (void)cpsi_follower_rows(evolution, is_static, balance->at[k].point, fmax(size, least),
                                 &rows);
        cpsi_graph_matrix_turn(balance->matrix, k, (const double(*)[3])rows.p);
        for (size_t a = 0; a < 3; a++)
            for (size_t b = 0; b < 3; b++) own.at[a * own.stride + b] += rows.q[a][b];
    }
    for (int i = 0; i < 6 * balance->body_count; i++)
        cpsi_graph_matrix_fix(balance->matrix, balance->count + i / 3, i % 3);
    return cpsi_graph_matrix_factor(balance->matrix);
}

/* The move of a point at the other end of a line at body `on`, by the unit motion `column` of body
 * k that is imposed: of a free point that follows, and of one on body k. */
static bool far_move(const CpsiBalance *balance, int point, int on, int k, int column,
                     double move[3]) {
    if (point == CPSI_NO_POINT) return false;
    if (balance->number[point] >= 0)
        memcpy(move, &balance->step[3 * balance->number[point]], 3 * sizeof *move);
    if (balance->number[point] >= 0) return true;
    if (balance->rigid_of[point] != k || on == k) return false;
    const CpsiJointMap map = cpsi_joint_map(balance, point);
    for (int a = 0; a < 3; a++) move[a] = map.by[a][column];
    return true;
}

/* Add A' K y, y the moves of the other ends of the lines at each body. */
static void add_column(CpsiBalance *balance, int k, int column, double added[36]) {
    const int *tie = balance->evolution->points.tie;
    const size_t width = 6 * (size_t)balance->body_count;
    for (int item = 0; item < balance->line_count; item++)
        for (int end = 0; end < 2; end++) {
            const int i = balance->line[item], point = tie[2 * i + end],
                      on = point == CPSI_NO_POINT ? -1 : balance->rigid_of[point];
            double y[3];
            if (on < 0 || (on != k && balance->body_count > CPSI_TOGETHER) ||
                !far_move(balance, tie[2 * i + !end], on, k, column, y))
                continue;
            const CpsiJointMap map = cpsi_joint_map(balance, point);
            const double *block =
                &balance->tangent[36 * (size_t)item + (size_t)(18 * end) + (size_t)(3 * !end)];
            for (size_t row = 0; row < 6; row++) {
                double *to = on == k ? &added[6 * row + (size_t)column]
                                     : &balance->coupling[width * (6 * (size_t)on + row) +
                                                          6 * (size_t)k + (size_t)column];
                for (size_t a = 0; a < 3; a++)
                    *to += map.by[a][row] * cpsi_dot(3, &block[6 * a], y);
            }
        }
}

/* What body k loses; false where a point goes too far. */
static bool find_added(CpsiBalance *balance, int k, double added[36]) {
    const double arm = balance->evolution->bodies.body[balance->rigid[k].body].arm;
    memset(added, 0, 36 * sizeof *added);
    for (int column = 0; column < 6; column++) {
        memset(balance->step, 0, (size_t)balance->unknowns * sizeof *balance->step);
        balance->step[3 * balance->count + 6 * k + column] = 1;
        cpsi_graph_matrix_solve(balance->matrix, balance->step);
        for (int i = 0; i < 3 * balance->count; i++)
            if (!(fabs(balance->step[i]) <= TOO_FAR * (column < 3 ? 1 : fmax(arm, 1e-300))))
                return false;
        add_column(balance, k, column, added);
    }
    return true;
}

static void clear_coupling(CpsiBalance *balance) {
    const size_t width = balance->body_count > CPSI_TOGETHER ? 0 : 6 * (size_t)balance->body_count;
    memset(balance->coupling, 0, width * width * sizeof *balance->coupling);
}

/* For each body; where that is not known of one, it and those after it keep their own blocks. */
static bool add_all(CpsiBalance *balance, bool adds) {
    clear_coupling(balance);
    CpsiBodies *bodies = &balance->evolution->bodies;
    for (int k = 0; k < balance->body_count; k++)
        cpsi_body_block(balance, k, bodies->body[balance->rigid[k].body].report.stiffness);
    bool all = set_rows(balance, adds);
    for (int k = 0; k < balance->body_count && all; k++) {
        double added[36], *stiffness = bodies->body[balance->rigid[k].body].report.stiffness;
        all = find_added(balance, k, added);
        if (!all) break;
        for (int i = 0; i < 36; i++) stiffness[i] += added[i];
    }
    return all;
}

void cpsi_add_followers(CpsiBalance *balance) {
    if (balance->body_count == 0 || (balance->count == 0 && balance->body_count == 1)) return;
    if (add_all(balance, false)) return;
    cpsi_fill_matrix(balance);
    if (!add_all(balance, true)) clear_coupling(balance);
}
