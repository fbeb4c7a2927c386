/* SPDX-License-Identifier: BSD-3-Clause */
/* Rounds of a group with bodies (body_rounds.h).
 *
 * The program of a round is convex: what it lacks of the energy of the bodies are negative
 * eigenvalues of their stiffness, and their rotations are small. So it may turn them too far, and
 * it leads to the answer by a constant factor only where a body would fall over without the lines'
 * own stiffness. */
#include "evolve/body_rounds.h"

#include <math.h>
#include <string.h>

#include "evolve/newton_step.h"
#include "linalg/dense.h"

/* So many rounds, in the first of which the share by which bodies are held back falls as soon as it
 * may, later after every so many. */
enum { ROUNDS = 160, EAGER = 60, PATIENT = 4 };
/* Bodies are held back by shares of their stiffness between these: by so many times as much where
 * more than MORE_LEFT times as much is left as after the round before, else by less. */
static const double LEAST_BACK = 1e-4, MOST_BACK = 1e6, BACK = 10, LESS_BACK = 2, MORE_LEFT = 1.5;
/* What is linear in rotations of this size [rad] is exact. */
static const double LINEAR = 1e-6;
/* Rotations are about the same axes if the cosine between them is larger than this; with q between
 * SLOW and WILD in size, and 1 - q no less than LEAST_REST. */
static const double ALIGNED = 0.99, SLOW = 0.3, WILD = 4, LEAST_REST = 0.02;

/* What the stiffness of the bodies bears of their loads after a round, as a force: what would be
 * left at the poses with which it began. */
static double left_by_round(const CpsiBalance *balance) {
    double most = 0;
    for (int k = 0; k < balance->body_count; k++) {
        const CpsiBody *body = &balance->evolution->bodies.body[balance->rigid[k].body];
        const double *move = &balance->guess.body[6 * k], *m = balance->held[k].stiffness;
        for (int i = 0; i < 6; i++)
            if (!body->given.fixed[i])
                most = fmax(most, fabs(cpsi_dot(6, &m[6 * i], move)) / (i < 3 ? 1 : body->arm));
    }
    return most;
}

/* Where two rounds have turned the bodies about the same axes, the second by q times as much, the
 * others would turn them by q/(1 - q) times as much again: as along directions in which their poses
 * are hardly stable, or to and fro. */
static void turn_on(CpsiBalance *balance, CpsiBodyRounds *rounds) {
    double now = 0, last = 0, both = 0;
    for (int k = 0; k < balance->body_count; k++) {
        const double *a = &balance->guess.body[6 * k + 3], *b = &balance->turned[3 * k];
        now += cpsi_dot(3, a, a);
        last += cpsi_dot(3, b, b);
        both += cpsi_dot(3, a, b);
    }
    const double share = last > 0 ? both / last : 0;
    const bool aligned = rounds->has_turned && fabs(both) > ALIGNED * sqrt(now * last) &&
                         fabs(share) > SLOW && fabs(share) < WILD;
    rounds->has_turned = !aligned;
    for (int k = 0; k < balance->body_count; k++) {
        const double *turn = &balance->guess.body[6 * k + 3];
        double move[6] = {0};
        memcpy(&balance->turned[3 * k], turn, 3 * sizeof *turn);
        if (!aligned) continue;
        for (int a = 0; a < 3; a++) move[3 + a] = turn[a] * share / fmax(1 - share, LEAST_REST);
        cpsi_limit(&move[3], CPSI_FARTHEST_TURN);
        balance->rigid[k].pose = cpsi_pose_after(balance, k, &balance->rigid[k].pose, move, 1);
    }
}

CpsiBodyRounds cpsi_body_rounds(const CpsiBalance *balance) {
    return (CpsiBodyRounds){.several = balance->evolution->line[balance->line[0]].has_local_axes,
                            .back = CPSI_LEAST_HELD,
                            .left = INFINITY,
                            .turned = {INFINITY, INFINITY}};
}

/* Begin where the last round did, with the bodies held back; false where none has been solved from
 * there. */
static bool go_back(CpsiBalance *balance, CpsiBodyRounds *rounds) {
    if (!rounds->may_return) return false;
    memcpy(balance->rigid, balance->rigid_from,
           (size_t)balance->body_count * sizeof *balance->rigid);
    rounds->back *= BACK;
    rounds->may_return = rounds->has_turned = false;
    rounds->done = 0;
    return true;
}

/* The share by which bodies are held back in the next round. */
static double next_back(const CpsiBodyRounds *rounds, double left) {
    if (left > MORE_LEFT * rounds->left) return BACK * rounds->back;
    if (rounds->tried <= EAGER) return fmax(rounds->back / BACK, LEAST_BACK);
    return rounds->tried % PATIENT == 0 ? fmax(rounds->back / LESS_BACK, LEAST_BACK) : rounds->back;
}

bool cpsi_body_round(CpsiBalance *balance, CpsiBodyRounds *rounds, bool *near) {
    const CpsiStepOptions options = cpsi_trial_options(balance->evolution);
    const size_t rigid = (size_t)balance->body_count * sizeof *balance->rigid;
    const CpsiRoundAim guess = {.several = rounds->several,
                                .refined = true,
                                .exact = true,
                                .back = rounds->back};
    const CpsiTurned before = rounds->turned;
    *near = false;
    if (rounds->tried++ >= ROUNDS || !(rounds->back < MOST_BACK)) return false;
    memcpy(balance->rigid_now, balance->rigid, rigid);
    if (!rounds->several) rounds->turned.points = 0;
    if (!cpsi_guess_round(balance, &options, rounds->done, &guess, &rounds->turned))
        return go_back(balance, rounds);
    memcpy(balance->rigid_from, balance->rigid_now, rigid);
    const double left = left_by_round(balance), back = rounds->back;
    rounds->back = next_back(rounds, left);
    rounds->left = left;
    rounds->may_return = true;
    rounds->done++;
    *near = before.bodies <= CPSI_SETTLED && (!rounds->several || before.points <= CPSI_NEAR) &&
            rounds->turned.bodies <= LINEAR && rounds->turned.points <= CPSI_TURNS_BY_ROUNDING;
    if (*near) {
        cpsi_trial_restore_lines(balance);
        if (rounds->several) rounds->done = 0;
    } else {
        turn_on(balance, rounds);
        rounds->has_turned = rounds->has_turned && rounds->back == back;
    }
    return true;
}
