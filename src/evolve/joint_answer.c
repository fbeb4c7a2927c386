/* SPDX-License-Identifier: BSD-3-Clause */
/* The step of a group as one program (joint_answer.h).
 *
 * The search goes through the places of the points, at each of which every line finds its own
 * answer. Where slack is dragged over a rough bed a line has several, and its force on a point may
 * jump from one to another while the place hardly moves, so that no force between is met. Of
 * inextensible lines that are pulled straight there is no tangent to go by. The program of lines
 * and points together has neither difficulty; on one plane, or without obstacles, it is the step
 * itself. Each line takes its part of the solution as the answer to its own program, and is
 * certified as ever; a line that is not, because its forces are far below the largest ones, is
 * solved alone between the places found. What is left at the points then, by rounding in a matrix
 * that holds the stiffness of inextensible lines, goes along lines to what is held.
 *
 * Where inextensible lines are pulled exactly straight, as a row of them between points that are as
 * far apart as the lines are long, a load across them has no finite tension to balance it, and the
 * program ends with tensions that mean nothing. As for a single line that is pulled straight the
 * forces then are those of lines longer by CPSI_TAUT_SLACK, at the places of the lines as they are.
 */
#include "evolve/joint_answer.h"

#include <math.h>
#include <string.h>

#include "cable/line_solve.h"
#include "cable/winch.h"
#include "evolve/body_rounds.h"
#include "evolve/first_guess.h"
#include "evolve/points.h"

/* A point whose friction is below its bound by this share rests. */
static const double CLEARLY = 1e-6;
/* Lines that are pulled straight by loads of which their tension is more than this multiple get the
 * tension of slightly longer ones. */
static const double STRAINED = 1e5;
/* The search for places ends at this share of the largest force. */
static const double BALANCED = 1e-11;
/* A line's part of the solution is poor if its gap is more than this share of the tolerance. */
static const double POOR = 1e-2;
/* [N/m] With hardly any stiffness the friction of a point is what balances it, as in the solution,
 * up to the bound; whether it is against the slip is asked all the same. The slip may be so small
 * that its direction is known less well than that of the force. */
static const double AS_FOUND = 1e-300;

bool cpsi_may_have_joint_answer(const CpsiBalance *balance) {
    if (!cpsi_is_without_bounds(balance)) return false;
    for (int item = 0; item < balance->line_count; item++) {
        const CpsiLine *line = &balance->evolution->line[balance->line[item]];
        if ((line->has_local_axes && !balance->follows) || line->grasp_count > 0) return false;
        if (line->has_potential) return false; /* it is followed line by line */
    }
    return true;
}

/* Is the slip no more than what counts as none, or as the loop leaves where friction is below its
 * bound: one that changes the forces of elastic lines by less than what balances to? */
static bool is_short(const CpsiBalance *balance, const CpsiFree *at) {
    const double slip = vec3_norm(at->slip);
    return slip <= cpsi_trial_touch(balance, at) ||
           (at->stiffness > AS_FOUND && !cpsi_has_inextensible(balance) &&
            cpsi_is_balanced(balance, at->stiffness * slip));
}

/* The place of point k in the solution: on what it touches, and where it was if it rests there. */
static Vec3 place_of(const CpsiBalance *balance, int k) {
    const CpsEvolution *evolution = balance->evolution;
    const CpsiNetworkProgram *program = &balance->network.program;
    const CpsiChainProgram *chain = &program->chain[balance->line_count + k];
    CpsiFree at = balance->at[k];
    at.place = vec3_add(balance->joint[k].position, vec3_load(&balance->guess.joint[3 * k]));
    const bool touches =
        chain->unilateral.count > 0 && chain->unilateral.z[0] > chain->unilateral.s[0];
    if (!touches) return at.place; /* a trial brings it into its set */
    cpsi_trial_find_obstacle(evolution, &at);
    const double *z = chain->disc.z[0];
    if (chain->disc.count > 0 && hypot(z[1], z[2]) < (1 - CLEARLY) * z[0] && is_short(balance, &at))
        return at.start;
    return at.gives ? at.place : vec3_axpy(-at.gap, at.normal, at.place);
}

/* Is line `item` inextensible and pulled straight between the places of the trial, to the share by
 * which it may be made longer? */
static bool is_straight(const CpsiBalance *balance, int item) {
    const CpsEvolution *evolution = balance->evolution;
    const int i = balance->line[item];
    Vec3 end[2];
    for (int side = 0; side < 2; side++) {
        const int point = evolution->points.tie[2 * i + side];
        if (!cpsi_trial_place(balance, point, &end[side]))
            end[side] = vec3_load(evolution->move[i].to[side].value);
        if (point == CPSI_NO_POINT && evolution->move[i].to[side].kind != CPS_END_KIND_HELD)
            return false;
    }
    const CpsiLine *line = &evolution->line[i];
    return line->compliance == 0 &&
           vec3_norm(vec3_sub(end[1], end[0])) >= line->length / (1 + CPSI_TAUT_SLACK);
}

static bool has_straight(const CpsiBalance *balance) {
    for (int item = 0; item < balance->line_count; item++)
        if (is_straight(balance, item)) return true;
    return false;
}

/* The places with which the solution for longer lines is tried: those of the solution for the lines
 * as they are, of which what lies sideways of a row that is pulled straight is not known to the
 * root of a length. A point that is as near to where it was has not moved: from there it does not
 * slide, in whatever direction. */
static void keep_still(CpsiBalance *balance) {
    const CpsEvolution *evolution = balance->evolution;
    for (int k = 0; k < balance->count; k++) {
        const CpsiPoint *point = &evolution->points.point[balance->at[k].point];
        CpsiFree at = {.point = balance->at[k].point, .place = balance->from[k].place};
        cpsi_trial_find_obstacle(evolution, &at);
        const bool touches =
            at.obstacle != CPS_NO_OBSTACLE && at.gap <= cpsi_trial_touch(balance, &at);
        const Vec3 still = touches ? at.start : vec3_load(point->before);
        if (vec3_norm(vec3_sub(at.place, still)) <= sqrt(CPSI_TAUT_SLACK) * point->length)
            balance->from[k].place = still;
    }
}

/* Try the places, the lines that are `joined` with their parts of the solution. */
static void try_joined(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    const int halvings = evolution->options.solver.max_halvings;
    evolution->options.solver.max_halvings = 0;
    cpsi_try_places(balance);
    evolution->options.solver.max_halvings = halvings;
}

/* The weakest force [N] in a line: one that hangs or lies slack bears no other. */
static double weakest_force(const CpsiLine *line) {
    double least = INFINITY;
    for (int e = 0; e + 1 < line->n; e++)
        if (!cpsi_line_is_on_drum(line, e))
            least = fmin(least, vec3_norm(vec3_at(line->segment_force, e)));
    return least;
}

/* The point of the group at an end of line `item`, else -1. */
static int point_at(const CpsiBalance *balance, int item, int end) {
    const int point = balance->evolution->points.tie[2 * balance->line[item] + end];
    return point == CPSI_NO_POINT ? -1 : balance->number[point];
}

/* The next line of the forest: the strongest one that takes part in the solution and leads from
 * what is reached to a point that is not. Returns its item, else -1, and the end at that point. */
static int next_of_forest(const CpsiBalance *balance, int *outer) {
    double strongest = 0;
    int next = -1;
    for (int item = 0; item < balance->line_count; item++)
        for (int end = 0; end < 2; end++) {
            const CpsiLine *line = &balance->evolution->line[balance->line[item]];
            const int to = point_at(balance, item, end), from = point_at(balance, item, !end);
            const bool leads = to >= 0 && !balance->from[to].reached &&
                               (from >= 0 ? balance->from[from].reached
                                          : line->end[!end].kind == CPS_END_KIND_HELD);
            if (!line->joined || !leads || !(weakest_force(line) > strongest)) continue;
            strongest = weakest_force(line);
            next = item;
            *outer = end;
        }
    return next;
}

/* Where no line leads to what is held points in sets count as reached: their sets hold them across
 * the directions that they leave free. Are there any? */
static bool reach_sets(CpsiBalance *balance) {
    bool any = false;
    for (int k = 0; k < balance->count; k++) {
        CpsiFree *from = &balance->from[k];
        const bool more = !from->reached && balance->at[k].in_set.on;
        from->reached = from->reached || more;
        any = any || more;
    }
    return any;
}

/* What nothing balances at a point goes along a line to the next one, and so on to what is held:
 * every force of that line changes by as much. The lines form a forest (Prim), each point reached
 * by the strongest. balance->ends holds it: the item and the end of each line, in the order in
 * which the points are reached. */
static void balance_along_forest(CpsiBalance *balance) {
    int count = 0, outer = 0;
    for (int k = 0; k < balance->count; k++) balance->from[k].reached = false;
    for (int item; (item = next_of_forest(balance, &outer)) >= 0 || reach_sets(balance);) {
        if (item < 0) continue;
        balance->from[point_at(balance, item, outer)].reached = true;
        balance->ends[count][0] = item;
        balance->ends[count++][1] = outer;
    }
    for (int k = 0; k < balance->count; k++) balance->from[k].left = balance->at[k].left;
    while (count-- > 0) {
        const int item = balance->ends[count][0], end = balance->ends[count][1];
        const Vec3 left = balance->from[point_at(balance, item, end)].left;
        const int inner = point_at(balance, item, !end);
        double *shift = balance->network.joined[item].shift;
        vec3_store(shift, vec3_axpy(end == CPS_END_A ? -1 : 1, left, vec3_load(shift)));
        if (inner >= 0) balance->from[inner].left = vec3_add(balance->from[inner].left, left);
    }
}

/* The parts of the solution without what balance_along_forest has added; it was an answer. */
static bool take_back(CpsiBalance *balance) {
    for (int item = 0; item < balance->line_count; item++)
        memset(balance->network.joined[item].shift, 0, sizeof balance->network.joined[item].shift);
    try_joined(balance);
    return cpsi_is_answer(balance);
}

/* Let what is left at the points go along lines to what is held, also where it is within the
 * tolerance: `found`. An answer that this makes no better stays as it is. */
static bool balance_points(CpsiBalance *balance, bool found) {
    const double left = cpsi_left_now(balance);
    if (found && left <= BALANCED * balance->force) return true;
    balance_along_forest(balance);
    try_joined(balance);
    const bool better = cpsi_is_answer(balance) && (!found || cpsi_left_now(balance) < left);
    return better || (found && take_back(balance));
}

/* Which lines take their part of the solution: all; or, of the solution for longer lines, those
 * that are straight between the places. */
static void join(CpsiBalance *balance, double longer) {
    CpsEvolution *evolution = balance->evolution;
    for (int item = 0; item < balance->line_count; item++) {
        const int i = balance->line[item];
        evolution->line[i].joined =
            longer > 1 && !is_straight(balance, item) ? NULL : &balance->network.joined[item];
    }
}

/* Is a line's part of the solution poor: has it a gap that is a good part of the tolerance, as
 * where it hangs slack by less than the gap of the whole program tells? */
static bool is_poor(const CpsiBalance *balance, const CpsiLine *line) {
    const CpsCertificate *found = &line->report.certificate;
    return line->joined &&
           found->gap > POOR * balance->evolution->options.solver.tolerance * found->scale;
}

/* Solve such lines of an answer alone, if it is still one then. */
static void solve_poor(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    int count = 0;
    for (int item = 0; item < balance->line_count; item++) {
        CpsiLine *line = &evolution->line[balance->line[item]];
        if (!is_poor(balance, line)) continue;
        line->joined = NULL;
        balance->ends[count++][0] = item;
    }
    if (count == 0) return;
    try_joined(balance);
    if (cpsi_is_answer(balance)) return;
    while (count-- > 0) {
        const int item = balance->ends[count][0];
        evolution->line[balance->line[item]].joined = &balance->network.joined[item];
    }
    try_joined(balance);
}

/* Try the places of the solution found, as try_solution says. */
static bool try_parts(CpsiBalance *balance, double longer) {
    CpsEvolution *evolution = balance->evolution;
    if (longer > 1)
        keep_still(balance);
    else
        for (int k = 0; k < balance->count; k++) balance->from[k].place = place_of(balance, k);
    const bool elastic = !cpsi_has_inextensible(balance);
    for (int k = 0; k < balance->count; k++) {
        balance->at[k].place = balance->from[k].place;
        if (elastic) balance->at[k].stiffness = AS_FOUND;
    }
    join(balance, longer);
    try_joined(balance);
    bool found = cpsi_is_answer(balance);
    if (!found && !balance->certified) {
        for (int item = 0; item < balance->line_count; item++) {
            CpsiLine *line = &evolution->line[balance->line[item]];
            if (!cps_outcome_is_certified(line->report.outcome)) line->joined = NULL;
        }
        try_joined(balance);
        found = cpsi_is_answer(balance);
    }
    if (balance->certified) found = balance_points(balance, found);
    if (found) solve_poor(balance);
    for (int item = 0; item < balance->line_count; item++)
        evolution->line[balance->line[item]].joined = NULL;
    return found;
}

/* Try the places of the solution, in which lines are longer by a factor; `longer` > 1: with the
 * places of balance->from. */
static bool try_solution(CpsiBalance *balance, double longer) {
    return cpsi_solve_places(balance, longer) && try_parts(balance, longer);
}

/* Are lines pulled exactly straight by far larger forces than what acts? What is across them has no
 * tension that balances it: the forces are those of rounding. */
static bool is_strained(const CpsiBalance *balance) {
    return balance->force > STRAINED * balance->acting && has_straight(balance);
}

/* Try the poses to which rounds lead, once they hardly turn the bodies any more. Where the lines
 * are strained there is none. */
static bool try_rounds(CpsiBalance *balance) {
    CpsiBodyRounds rounds = cpsi_body_rounds(balance);
    bool near;
    while (cpsi_body_round(balance, &rounds, &near))
        if (near && try_parts(balance, 1)) return !is_strained(balance);
    return false;
}

bool cpsi_take_joint_answer(CpsiBalance *balance) {
    if (!cpsi_may_have_joint_answer(balance)) return false;
    const size_t bytes = (size_t)balance->count * sizeof *balance->at,
                 rigid = (size_t)balance->body_count * sizeof *balance->rigid;
    memcpy(balance->best, balance->at, bytes);
    memcpy(balance->rigid_best, balance->rigid, rigid);
    bool found = balance->body_count > 0 ? try_rounds(balance) : try_solution(balance, 1);
    const CpsiIpmOutcome outcome = balance->network.found;
    const bool in_rounds =
        balance->evolution->line[balance->line[0]].has_local_axes || balance->body_count > 0;
    if (!in_rounds && (outcome == CPSI_IPM_INFEASIBLE || outcome == CPSI_IPM_UNBOUNDED))
        return false;
    if (!in_rounds && (found ? is_strained(balance) : has_straight(balance))) {
        const bool exact = found;
        found = try_solution(balance, 1 + CPSI_TAUT_SLACK);
        if (!found && exact) found = try_solution(balance, 1);
    }
    if (found) return true;
    memcpy(balance->at, balance->best, bytes);
    memcpy(balance->rigid, balance->rigid_best, rigid);
    cpsi_try_places(balance);
    return false;
}
