/* SPDX-License-Identifier: BSD-3-Clause */
/* The first guess (first_guess.h). */
#include "evolve/first_guess.h"

#include <math.h>
#include <string.h>

#include "cable/winch.h"
#include "evolve/anchors.h"
#include "evolve/bodies.h"
#include "evolve/body_motion.h"
#include "evolve/newton_step.h"
#include "evolve/point_rounds.h"
#include "evolve/points.h"
#include "linalg/symmetric.h"

/* The guess takes so many rounds, until no body turns by more than CPSI_SETTLED [rad] in one, and
 * no normal of a point by more than ON_ITS_PLANE; no body turns farther than CPSI_FARTHEST_TURN in
 * one. */
enum { ROUNDS = 12, POINT_ROUNDS = 200 };
/* What a guess moves by no more than this, per length, is at rest. */
static const double AT_REST = 1e-6;
static const double ON_ITS_PLANE = 1e-6;
/* Axes that turn by no more than this [rad] are those of the solution, as in the rounds of a line,
 * or by no more than this where they come no nearer. */
static const double TURNS_NO_MORE = 1e-10;
/* Relative gap of a program whose planes are still to turn by more than CPSI_NEAR [rad], and of the
 * others. A point touches a plane within this share of its longest line. */
static const double ROUGH = 1e-5, FINE = 1e-10, REFINED = 1e-12, TOUCHES = 1e-3;
/* Bodies that turn by more than this [rad] in a round are far from where they go. */
static const double FAR = 0.1;

void cpsi_impose_plan(CpsiBalance *balance, int item) {
    CpsEvolution *evolution = balance->evolution;
    const int i = balance->line[item];
    CpsiLine *line = &evolution->line[i];
    cpsi_workspace_attach(&evolution->workspace[0], line);
    line->inertia.moved_in_span = false;
    for (int k = 0; k < evolution->obstacle_count; k++) {
        line->turn[k] = evolution->angle[k];
        line->shift[k] = evolution->shift[k];
    }
    memcpy(line->weight_before, evolution->move[i].weight_from, sizeof line->weight_before);
    memcpy(line->weight, evolution->move[i].weight_to, sizeof line->weight);
    for (int k = 0; k < line->grasp_count; k++) {
        line->grasp_before[k] = evolution->move[i].grasp_from[k];
        line->grasp[k].imposed = evolution->move[i].grasp_to[k];
    }
    for (int end = 0; end < 2; end++) {
        const int point = evolution->points.tie[2 * i + end],
                  joint = point == CPSI_NO_POINT ? CPSI_NO_JOINT : balance->joint_of[point];
        balance->ends[item][end] = joint;
        line->end_before[end] = evolution->move[i].from[end];
        line->drums.due[end] = evolution->move[i].stored_to[end];
        if (joint == CPSI_NO_JOINT)
            line->end[end] = evolution->move[i].to[end];
        else
            vec3_store(line->end[end].value, balance->joint[joint].position);
    }
    cpsi_winch_wind(line);
}

int cpsi_place_joints(CpsiBalance *balance, bool first) {
    CpsEvolution *evolution = balance->evolution;
    int count = balance->count;
    for (int k = 0; k < balance->count; k++) {
        CpsiFree *at = &balance->at[k];
        const CpsiPoint *point = &evolution->points.point[at->point];
        double load[3];
        const bool drags = cpsi_point_drags(&evolution->points, at->point);
        if (first) at->place = vec3_load(drags ? point->position : point->before);
        cpsi_trial_find_obstacle(evolution, at);
        CpsiWater water = {0};
        memset(load, 0, sizeof load);
        if (!drags) {
            cpsi_point_load(point, evolution->gravity, load);
            water = cpsi_water_at(point, evolution->gravity, at->place);
            load[2] += water.displaced;
        }
        balance->joint_of[at->point] = k;
        balance->joint[k] = (CpsiJoint){.position = at->place,
                                        .load = vec3_load(load),
                                        .obstacle = at->obstacle == CPS_NO_OBSTACLE
                                                        ? NULL
                                                        : &evolution->obstacle[at->obstacle],
                                        .on = at->in_set.on,
                                        .gap = at->gap,
                                        .gives = at->gives,
                                        .spring = at->spring,
                                        .slip = first ? vec3(0, 0, 0) : at->slip,
                                        .friction = at->friction,
                                        .bound = at->friction * point->reaction_before,
                                        .drags = drags,
                                        .normal = at->normal,
                                        .capacity = at->bound,
                                        .dragged = drags ? at->slip : vec3(0, 0, 0),
                                        .displaced = water.displaced,
                                        .depth = -water.height,
                                        .body = -1};
    }
    for (int i = 0; i < evolution->points.count; i++) {
        if (balance->number[i] >= 0) continue;
        balance->joint_of[i] = CPSI_NO_JOINT;
        if (balance->rigid_of[i] < 0) continue;
        const CpsiRigid *rigid = &balance->rigid[balance->rigid_of[i]];
        const Vec3 arm = cpsi_trial_arm(balance, rigid, i);
        balance->joint_of[i] = count;
        balance->joint[count++] = (CpsiJoint){.position = vec3_add(rigid->pose.place, arm),
                                              .body = balance->rigid_of[i],
                                              .arm = arm};
    }
    return count;
}

/* Add what the pulls of the last round bring to the stiffness of body k as they turn with it. */
static void add_pulls(const CpsiBalance *balance, int k, double stiffness[36]) {
    const CpsEvolution *evolution = balance->evolution;
    const CpsiRigid *rigid = &balance->rigid[k];
    for (int item = 0; item < balance->line_count; item++)
        for (int end = 0; end < 2; end++) {
            const int point = evolution->points.tie[2 * balance->line[item] + end];
            if (point == CPSI_NO_POINT || balance->rigid_of[point] != k) continue;
            cpsi_add_turning_force(vec3_load(&balance->guess.pull[6 * item + 3 * end]),
                                   cpsi_trial_arm(balance, rigid, point), stiffness);
        }
}

/* Add to a symmetric stiffness, of so much as unit against displacements and rotations, what makes
 * its negative eigenvalues 0, or in rough steps as large as they were; in the fixed directions
 * nothing. */
static void make_definite(double m[36], const bool fixed[6], double along, double about,
                          bool rough) {
    double own[36], vectors[36], unit[6];
    for (int i = 0; i < 6; i++) unit[i] = sqrt(i < 3 ? along : about);
    for (int i = 0; i < 36; i++)
        own[i] = fixed[i / 6] || fixed[i % 6] ? 0 : m[i] / (unit[i / 6] * unit[i % 6]);
    cpsi_symmetric_diagonalise(6, own, vectors);
    for (int k = 0; k < 6; k++)
        for (int i = 0; i < 36; i++)
            m[i] += (rough ? 2 : 1) * fmax(0, -own[7 * k]) * unit[i / 6] *
                    vectors[6 * (i / 6) + k] * vectors[6 * (i % 6) + k] * unit[i % 6];
}

/* What acts on the bodies, and their stiffness: with `turns` that by which the pulls of the last
 * round turn with them; as much more as makes it positive definite, and far more in fixed
 * directions. */
static void hold_bodies(CpsiBalance *balance, bool turns, double back, bool rough) {
    CpsEvolution *evolution = balance->evolution;
    for (int k = 0; k < balance->body_count; k++) {
        const CpsiRigid *rigid = &balance->rigid[k];
        const CpsiBody *body = &evolution->bodies.body[rigid->body];
        const CpsiWrench load = cpsi_body_whole_load(evolution, body, &rigid->pose);
        CpsiNetworkBody *held = &balance->held[k];
        *held = (CpsiNetworkBody){.force = load.force, .moment = load.moment};
        memcpy(held->fixed, body->given.fixed, sizeof held->fixed);
        double *m = held->stiffness;
        cpsi_body_whole_stiffness(evolution, body, &rigid->pose, m);
        if (turns) add_pulls(balance, k, m);
        const double acts = vec3_norm(load.force) + vec3_norm(load.moment) / body->arm +
                            body->mass * vec3_norm(vec3_load(evolution->gravity)),
                     force = acts > 0 ? acts : 1;
        double most = force * body->arm;
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < i; j++)
                m[6 * i + j] = m[6 * j + i] = 0.5 * (m[6 * i + j] + m[6 * j + i]);
        for (int i = 3; i < 6; i++) most = fmax(most, fabs(m[7 * i]));
        make_definite(m, body->given.fixed, force / body->length, most, rough);
        for (int i = 0; i < 6; i++)
            m[7 * i] += (CPSI_REGULAR + back) * (i < 3 ? force / body->length : most);
        for (int i = 0; i < 6; i++)
            if (body->given.fixed[i])
                m[7 * i] += (i < 3 ? force / body->length : most) / CPSI_REGULAR;
    }
}

/* Nothing moves in the fixed directions of a body, in which the guess only makes it stiff. */
static void keep_fixed(const CpsiBody *body, double move[6]) {
    for (int i = 0; i < 6; i++)
        if (body->given.fixed[i]) move[i] = 0;
}

/* The place of an anchor in its plane: where it was, if the guess does not move it. */
static Vec3 near_its_place(const CpsiFree *at, double length) {
    const Vec3 drag = vec3_reject(vec3_sub(at->place, at->start), at->normal);
    return vec3_norm(drag) <= AT_REST * length ? at->start : vec3_add(at->start, drag);
}

/* Move free point k; returns by how much [rad] the normal of its obstacle turns where it is on
 * its tangent plane, or how far it has gone into an obstacle, over its longest line. A tangent
 * plane of a round obstacle leaves out places that are free, and none that are not: so the energy
 * falls from round to round, unless a point goes into another obstacle than its own. */
static double move_point(CpsiBalance *balance, int k) {
    const CpsEvolution *evolution = balance->evolution;
    CpsiFree *at = &balance->at[k];
    const double *move = &balance->guess.joint[3 * k];
    const Vec3 straight = vec3_add(at->place, vec3_load(move));
    const double length = evolution->points.point[at->point].length;
    at->place =
        cpsi_place_after(balance, &(CpsiFree){.place = at->place, .obstacle = CPS_NO_OBSTACLE},
                         move, 1);
    if (at->drags) at->place = near_its_place(at, length);
    if (!at->drags) at->place.z = cpsi_water_near(&evolution->points, at->point, at->place.z);
    if (at->obstacle == CPS_NO_OBSTACLE) return 0;
    const CpsiObstacle *on = &evolution->obstacle[at->obstacle];
    const double pushed = vec3_norm(vec3_sub(at->place, straight)) / length;
    const bool touches = at->gap + vec3_dot(at->normal, vec3_load(move)) <= TOUCHES * length;
    if (on->kind == CPS_OBSTACLE_PLANE) return pushed;
    return fmax(pushed,
                touches ? vec3_norm(vec3_sub(cpsi_obstacle_normal(on, at->place), at->normal)) : 0);
}

CpsiNetworkPart cpsi_network_part(CpsiBalance *balance, bool first) {
    const CpsiNetworkPart part = {.lines = balance->line_count,
                                  .joints = cpsi_place_joints(balance, first),
                                  .bodies = balance->body_count,
                                  .own = balance->count,
                                  .longer = 1,
                                  .number = balance->line,
                                  .at = (const int(*)[2])balance->ends,
                                  .joint = balance->joint,
                                  .body = balance->held};
    for (int item = 0; item < balance->line_count; item++) cpsi_impose_plan(balance, item);
    for (int item = 0; item < balance->line_count; item++)
        for (int end = 0; end < 2; end++) {
            const CpsiLine *line = &balance->evolution->line[balance->line[item]];
            const int k = balance->ends[item][end], node = cpsi_line_end_node(line, end),
                      e = end == CPS_END_A ? node : node - 1;
            if (k != CPSI_NO_JOINT) balance->joint[k].share += 0.5 * line->element_length[e];
        }
    return part;
}

/* How a round is solved: to a relative gap, with steps in which what sticks moves ever less, or to
 * the limit of the arithmetic. */
typedef enum Accuracy { TO_GAP, TO_REFINED_GAP, TO_THE_END } Accuracy;

/* One program on the tangent planes of the last round, or where there is one plane of the
 * reference, from the poses of the trial; false where no solution is found. */
static bool solve_round(CpsiBalance *balance, const CpsiStepOptions *options, bool first,
                        double target, Accuracy accuracy) {
    CpsEvolution *evolution = balance->evolution;
    if (first) cpsi_trial_restore_lines(balance);
    CpsiNetworkPart part = cpsi_network_part(balance, first);
    part.target = target;
    part.is_refined = accuracy != TO_GAP;
    part.is_exact = accuracy == TO_THE_END;
    part.continues = !first;
    const bool solved =
        cpsi_network_guess(&balance->network, evolution->line, &part, options, &balance->guess);
    /* whether a last round that rounding has ended is an answer is asked of its lines */
    return solved || (accuracy == TO_THE_END && balance->body_count > 0 &&
                      balance->network.found == CPSI_IPM_STALLED);
}

bool cpsi_guess_round(CpsiBalance *balance, const CpsiStepOptions *options, int round,
                      const CpsiRoundAim *guess, CpsiTurned *turned) {
    CpsEvolution *evolution = balance->evolution;
    const bool first = round == 0 || !guess->several,
               rough =
                   turned->points > CPSI_NEAR || (guess->exact && turned->bodies > CPSI_SETTLED);
    hold_bodies(balance, round > 0, guess->back, !guess->exact || turned->bodies > FAR);
    if (rough || !guess->refined) {
        const double target = turned->points > CPSI_NEAR ? ROUGH : FINE;
        if (!solve_round(balance, options, first, target, TO_GAP)) return false;
    } else if (guess->exact) {
        if (!solve_round(balance, options, first, FINE, TO_THE_END)) return false;
    } else if (!solve_round(balance, options, first, REFINED, TO_REFINED_GAP) &&
               !solve_round(balance, options, first, FINE, TO_REFINED_GAP)) {
        return false; /* large nets, whose gap comes no nearer than FINE, are tried twice */
    }
    *turned = (CpsiTurned){.points = guess->several ? balance->network.turned : 0};
    for (int k = 0; k < balance->count; k++)
        turned->points = fmax(turned->points, move_point(balance, k));
    for (int k = 0; k < balance->body_count; k++) {
        double *move = &balance->guess.body[6 * k];
        keep_fixed(&evolution->bodies.body[balance->rigid[k].body], move);
        turned->bodies = fmax(turned->bodies, vec3_norm(vec3_load(&move[3])));
        cpsi_limit(&move[3], CPSI_FARTHEST_TURN);
        balance->rigid[k].pose = cpsi_pose_after(balance, k, &balance->rigid[k].pose, move, 1);
    }
    return true;
}

/* Does the plane on which a point may lie depend on where it is? */
static bool has_several_planes(const CpsEvolution *evolution) {
    for (int k = 0; k < evolution->obstacle_count; k++)
        if (evolution->obstacle[k].kind != CPS_OBSTACLE_PLANE) return true;
    return evolution->obstacle_count > 1;
}

/* Points that stick stay where they were, and others that touch are on the surface. */
static void settle_points(CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++) {
        CpsiFree *at = &balance->at[k];
        if (balance->guess.state[k] == CPSI_JOINT_OFF || at->obstacle == CPS_NO_OBSTACLE) continue;
        const CpsiObstacle *on = &balance->evolution->obstacle[at->obstacle];
        if (at->gives) { /* as deep as the guess has it */
            cpsi_trial_find_obstacle(balance->evolution, at);
            if (at->gives && balance->guess.state[k] == CPSI_JOINT_STICKS) at->place = at->start;
            continue;
        }
        at->place = balance->guess.state[k] == CPSI_JOINT_STICKS
                        ? at->start
                        : vec3_axpy(-cpsi_obstacle_gap(on, at->place),
                                    cpsi_obstacle_normal(on, at->place), at->place);
    }
}

/* Rounds, until they have come as near as is asked; returns how many, 0 where the first has no
 * solution. `settled`: they have come as near. */
static int take_rounds(CpsiBalance *balance, CpsiRoundAim guess, bool *settled) {
    const CpsiStepOptions options = cpsi_trial_options(balance->evolution);
    CpsiTurned turned = {0, guess.several ? INFINITY : 0};
    double best = INFINITY;
    int rounds = 0;
    *settled = false;
    while (rounds < POINT_ROUNDS) {
        if (guess.several && balance->body_count == 0 && rounds > 0)
            cpsi_point_rounds_accelerate(balance, rounds == 1 ? INFINITY : turned.points);
        const bool fine = turned.points <= CPSI_NEAR;
        if (!cpsi_guess_round(balance, &options, rounds, &guess, &turned)) break;
        rounds++;
        const bool halved = turned.points <= 0.5 * best;
        if (halved) best = turned.points;
        const bool bodies = turned.bodies <= CPSI_SETTLED || rounds >= ROUNDS,
                   points = turned.points <= (guess.exact ? TURNS_NO_MORE : ON_ITS_PLANE) ||
                            (guess.exact && !halved && turned.points <= CPSI_TURNS_BY_ROUNDING);
        *settled = bodies && fine && points;
        if (*settled) break;
    }
    cpsi_trial_restore_lines(balance);
    return rounds;
}

/* Begin where the points and bodies go on the tangent planes of the reference, the bodies in rounds
 * about the poses of the round before; false where that has no solution. */
bool cpsi_guess_places(CpsiBalance *balance, bool refined) {
    const CpsiRoundAim guess = {.several = has_several_planes(balance->evolution),
                                .refined = refined};
    bool settled;
    if (take_rounds(balance, guess, &settled) == 0) return false;
    settle_points(balance);
    return true;
}

bool cpsi_solve_places(CpsiBalance *balance, double longer) {
    CpsEvolution *evolution = balance->evolution;
    const CpsiStepOptions options = cpsi_trial_options(evolution);
    const bool several = evolution->line[balance->line[0]].has_local_axes;
    if (several) {
        const CpsiRoundAim guess = {.several = true, .refined = true, .exact = true};
        bool settled;
        (void)take_rounds(balance, guess, &settled);
        return settled;
    }
    cpsi_trial_restore_lines(balance);
    CpsiNetworkPart part = cpsi_network_part(balance, true);
    part.longer = longer;
    (void)cpsi_network_solve(&balance->network, evolution->line, &part, &options, &balance->guess);
    cpsi_trial_restore_lines(balance);
    return balance->network.found != CPSI_IPM_INFEASIBLE &&
           balance->network.found != CPSI_IPM_UNBOUNDED;
}

/* Begin where the last step of the same stage leads. */
void cpsi_extrapolate_places(CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++) {
        CpsiFree *at = &balance->at[k];
        const CpsiPoint *point = &balance->evolution->points.point[at->point];
        if (point->is_moving) at->place = cpsi_place_after(balance, at, point->move, 1);
    }
}
