/* SPDX-License-Identifier: BSD-3-Clause */
/* The search for the places of free points (balance.h).
 *
 * For given places of the points each line is a step of its own, from the same reference, with its
 * ends held there. The force r(x) that the lines and the load leave on the points is, up to its
 * sign, the derivative of the lines' energies, which are convex: so r is monotone, and where it
 * vanishes lies the minimum of the whole. It is found by Newton's method with the tangents of the
 * lines (cable/stiffness.h). A point that touches an obstacle has a reaction R = -r.n >= 0 and
 * friction F, |F| <= mu R, so that r + R n + F vanishes; whether it is off the obstacle, sticks or
 * slides is decided in each iteration from forces and places together (Alart and Curnier 1991).
 *
 * Along a direction d the work r(x + s d).d falls as s grows. A step that goes much too far makes
 * it negative, and is shortened; so is one to where a line finds no certified answer. */
#include "evolve/balance.h"

#include <math.h>
#include <string.h>

#include "cable/soft.h"
#include "evolve/anchors.h"
#include "evolve/balance_report.h"
#include "evolve/bodies.h"
#include "evolve/body_motion.h"
#include "evolve/checkpoint.h"
#include "evolve/first_guess.h"
#include "evolve/graph_existence.h"
#include "evolve/joint_answer.h"
#include "evolve/lone.h"
#include "evolve/nearest_places.h"
#include "evolve/newton_step.h"
#include "evolve/point_motion.h"
#include "evolve/points.h"
#include "evolve/soft_point.h"
#include "evolve/time_step.h"
#include "evolve/trial.h"

/* The search is for forces that balance to this share of the largest one, which is that to which
 * those of a line do. */
static const double TARGET = 1e-11;
/* The search ends after so many iterations or trials, or so many without halving what is left: a
 * body that swings on stiff lines goes down a curved valley, in which its forces do not fall before
 * the end, and so does a group that nothing holds as it turns with its loads. Trials in which a
 * line finds no answer take the most time by far: they are fewer. At last, where nothing was found,
 * it goes on for longer: in a net whose sides become taut one after the other what is left rises
 * and falls for thirty iterations before it vanishes. The answer as one program takes the time of
 * some ten trials, and is asked last; of groups of MANY points, whose trials take long, after a
 * first search with few of them. */
enum {
    ITERATIONS = 100,
    PATIENCE = 6,
    PATIENCE_AT_LAST = 40,
    PATIENCE_WITH_BODIES = 20,
    PATIENCE_UNHELD = 60,
    MOST_TRIALS = 200,
    TRIALS_BESIDE = 30,
    MANY = 200,
    FEW_TRIALS = 8,
    OPEN_TRIALS = 12
};
/* The full step is taken where it reduces what is left to this share, or makes the work along it
 * negative by no more than this share of what it was. */
static const double REDUCED = 0.9, OVERSHOOT = 0.5;
/* Otherwise a share of it is found, in so many trials, at which the work is no more than this share
 * of what it was: where a line lifts off an obstacle node by node its force may rise steeply within
 * a millimetre. Each trial leaves out at least this share of what is still possible. Places differ
 * by more than this share of the lines' lengths. */
enum { SHORTENINGS = 40 };
static const double NEARLY = 0.1, LEAST_SHARE = 0.1, ROUNDING = 1e-14;
/* A step is no more than so many times as long as the matrix says. */
static const double LONGEST = 1e3;
/* Lines are made so soft that the largest force stretches them by this share, and then so many
 * times as stiff, in so many stages; so many lines at most. */
static const double SOFT = 0.1, STIFFER = 8;
enum { SOFT_STAGES = 5, SOFT_LINES = 64 };

static bool is_interrupted(const CpsEvolution *evolution) {
    bool seen = false;
    for (int i = 0; i < evolution->workspace_count; i++)
        seen = seen || cpsi_interrupt_seen(&evolution->workspace[i].interrupt);
    return seen;
}

static bool is_over(const CpsiBalance *balance) {
    return balance->open_trials >= OPEN_TRIALS || is_interrupted(balance->evolution);
}

/* [m] The length of the shortest of the points' longest lines. */
static double smallest_length(const CpsiBalance *balance) {
    double least = INFINITY;
    for (int k = 0; k < balance->count; k++)
        least = fmin(least, balance->evolution->points.point[balance->at[k].point].length);
    for (int k = 0; k < balance->body_count; k++)
        least = fmin(least, balance->evolution->bodies.body[balance->rigid[k].body].length);
    return least;
}

/* [m] The largest displacement of a point in the step. */
static double size_of_step(const CpsiBalance *balance) {
    double most = 0;
    for (int k = 0; k < balance->count; k++)
        most = fmax(most, vec3_norm(vec3_load(&balance->step[3 * k])));
    for (int k = 0; k < balance->body_count; k++) {
        const double *step = &balance->step[3 * balance->count + 6 * k];
        const double arm = balance->evolution->bodies.body[balance->rigid[k].body].arm;
        most = fmax(most, vec3_norm(vec3_load(step)) + arm * vec3_norm(vec3_load(&step[3])));
    }
    return most;
}

/* Where the work along the step vanishes: between `low`, where it is positive, and `high`. */
typedef struct Bracket {
    double low, high, above, below; /* above: the work at low */
} Bracket;

/* The next share to try, by the rule of false position; an end that stays twice counts half. */
static double next_share(Bracket *bracket, double share, double work) {
    if (work > 0) {
        if (bracket->low > 0) bracket->below *= 0.5;
        bracket->low = share;
        bracket->above = work;
    } else {
        if (bracket->high < 1) bracket->above *= 0.5;
        bracket->high = share;
        bracket->below = work;
    }
    const double at = bracket->above / (bracket->above - bracket->below);
    return bracket->low +
           (bracket->high - bracket->low) * fmin(fmax(at, LEAST_SHARE), 1 - LEAST_SHARE);
}

/* By which factor the next step is longer than the matrix says, after one that has reduced the work
 * along it to `now`: what differs by little from 1 is what is not linear, and falls by itself. */
static double next_longer(double longer, double work, double now) {
    const double next = fmin(longer * fmax(work / (work - fmin(now, 0.9 * work)), 0.5), LONGEST);
    return fabs(next - 1) > NEARLY ? next : 1;
}

/* Take the step, or the share of it at which the work along it nearly vanishes, in no more than
 * `shortenings` further trials. Returns by which factor the next step may be longer: where the work
 * has fallen less than it should, the stiffness is less than the matrix says. */
static double take_step(CpsiBalance *balance, int shortenings, double longer) {
    const double work = cpsi_work_along(balance),
                 allowed = REDUCED * cpsi_largest_left(balance, balance->from, balance->rigid_from),
                 size = size_of_step(balance);
    Bracket bracket = {.high = NAN, .above = work};
    double share = 1;
    for (int i = 0; i <= shortenings && share * size > 0; i++) {
        for (int k = 0; k < balance->count; k++)
            balance->at[k].place =
                cpsi_place_after(balance, &balance->from[k], &balance->step[3 * k], share);
        for (int k = 0; k < balance->body_count; k++)
            balance->rigid[k].pose =
                cpsi_pose_after(balance, k, &balance->rigid_from[k].pose,
                                &balance->step[3 * balance->count + 6 * k], share);
        cpsi_try_places(balance);
        if (is_over(balance)) return 1;
        const double now = cpsi_work_along(balance);
        if (!balance->certified || !(work > 0)) {
            if (balance->certified && cpsi_left_now(balance) <= allowed) return 1;
            bracket.high = share;
            bracket.below = -work;
            share *= 0.5;
            continue;
        }
        const bool reduced = cpsi_left_now(balance) <= allowed;
        if (i == 0 && (reduced || now >= -OVERSHOOT * work)) return next_longer(longer, work, now);
        if (fabs(now) <= NEARLY * work) return 1;
        const double before = share;
        share = next_share(&bracket, share, now);
        if (fabs(share - before) * size <= ROUNDING * smallest_length(balance)) return 1;
    }
    return 1;
}

/* Step the lines that are at no free point and no free body. */
static void step_others(CpsiBalance *balance) {
    balance->line_count = 0;
    for (int i = 0; i < balance->evolution->line_count; i++)
        if (cpsi_group_of_line(&balance->evolution->points, i) == CPSI_NO_POINT)
            balance->line[balance->line_count++] = i;
    if (balance->line_count > 0) cpsi_step_lines(balance);
}

/* A point of the group that is on a free body: the body, if this is its first point. */
static void take_body(CpsiBalance *balance, int point) {
    CpsEvolution *evolution = balance->evolution;
    const int body = evolution->points.given[point].body;
    int k = 0;
    while (k < balance->body_count && balance->rigid[k].body != body) k++;
    if (k == balance->body_count)
        balance->rigid[balance->body_count++] =
            (CpsiRigid){.body = body, .pose = evolution->bodies.body[body].pose};
    balance->rigid_of[point] = k;
}

/* Find the points, bodies and lines of a group. */
static void begin(CpsiBalance *balance, int group) {
    CpsEvolution *evolution = balance->evolution;
    CpsiPoints *points = &evolution->points;
    balance->count = balance->body_count = balance->line_count = balance->trials = 0;
    balance->follows = evolution->options.friction_policy != CPS_FRICTION_POLICY_FROZEN;
    for (int i = 0; i < points->count; i++) {
        CpsiPoint *point = &points->point[i];
        balance->number[i] = balance->rigid_of[i] = -1;
        if (points->group[i] != group) continue;
        if (point->kind == CPS_POINT_KIND_ON_BODY) {
            take_body(balance, i);
            continue;
        }
        balance->number[i] = balance->count;
        balance->at[balance->count++] = (CpsiFree){.point = i,
                                                   .place = vec3_load(point->position),
                                                   .obstacle = CPS_NO_OBSTACLE};
    }
    balance->unknowns = 3 * balance->count + 6 * balance->body_count;
    cpsi_trial_use_blocks(balance);
    for (int i = 0; i < evolution->line_count; i++) {
        if (cpsi_group_of_line(points, i) != group) continue;
        balance->line[balance->line_count++] = i;
        balance->iterations[i] = 0;
        cpsi_line_keep(&evolution->line[i], &balance->state[balance->offset[i]]);
    }
}

/* Search on from the trial. */
static bool search_on(CpsiBalance *balance, int trials, int patience) {
    const size_t bytes = (size_t)balance->count * sizeof *balance->at,
                 rigid = (size_t)balance->body_count * sizeof *balance->rigid;
    double best = INFINITY, halved = INFINITY, longer = 1;
    int waited = 0;
    bool good = false;
    const int most = balance->trials + trials;
    for (int i = 0; i < ITERATIONS && !is_over(balance); i++) {
        const double left = cpsi_left_now(balance);
        if (balance->certified && left < best && (!good || cpsi_is_answer(balance))) {
            best = left;
            good = cpsi_is_answer(balance);
            memcpy(balance->best, balance->at, bytes);
            memcpy(balance->rigid_best, balance->rigid, rigid);
        }
        if (left <= TARGET * balance->force && cpsi_is_answer(balance)) return true;
        waited++;
        if (balance->certified && left <= 0.5 * halved) {
            waited = 0;
            halved = left;
        }
        if (waited > (good ? 1 : patience) || balance->trials > most) break;
        if (!cpsi_find_step(balance)) cpsi_follow_forces(balance);
        for (int k = 0; k < balance->unknowns; k++) balance->step[k] *= longer;
        cpsi_limit_step(balance);
        memcpy(balance->from, balance->at, bytes);
        memcpy(balance->rigid_from, balance->rigid, rigid);
        longer = take_step(balance, good ? 0 : SHORTENINGS, longer);
    }
    if (best < INFINITY && (!balance->certified || best < cpsi_left_now(balance))) {
        memcpy(balance->at, balance->best, bytes);
        memcpy(balance->rigid, balance->rigid_best, rigid);
        cpsi_try_places(balance);
    }
    return cpsi_is_answer(balance);
}

static bool search_with(CpsiBalance *balance, int trials, int patience) {
    balance->open_trials = 0;
    cpsi_try_places(balance);
    return search_on(balance, trials, patience);
}

static int patience_for(const CpsiBalance *balance) {
    return !cpsi_group_is_held(balance) ? PATIENCE_UNHELD
           : balance->body_count > 0    ? PATIENCE_WITH_BODIES
                                        : PATIENCE;
}

static bool search(CpsiBalance *balance, int trials) {
    return search_with(balance, trials, patience_for(balance));
}

/* Search with soft lines, and then with stiffer ones up to their own stiffness: a body that starts
 * far from its place on stiff lines would go there through a narrow valley. For elastic lines,
 * where nothing else has found an answer. */
static void search_softly(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    double own[SOFT_LINES];
    const int count = balance->line_count < SOFT_LINES ? balance->line_count : SOFT_LINES;
    for (int item = 0; item < count; item++)
        own[item] = evolution->line[balance->line[item]].compliance;
    for (double soft = SOFT / balance->force, k = 0; k < SOFT_STAGES; k++, soft /= STIFFER) {
        for (int item = 0; item < count; item++)
            if (own[item] > 0)
                evolution->line[balance->line[item]].compliance = fmax(soft, own[item]);
        (void)search(balance, MOST_TRIALS);
    }
    for (int item = 0; item < count; item++)
        evolution->line[balance->line[item]].compliance = own[item];
    (void)search(balance, MOST_TRIALS);
}

void cpsi_balance_start(CpsEvolution *evolution) {
    CpsiFree *at = evolution->points.balance->at;
    cpsi_soft_point_areas(evolution);
    for (int k = 0; k < evolution->points.count; k++) {
        const CpsiPoint *point = &evolution->points.point[k];
        at[k] = (CpsiFree){.point = k, .place = vec3_load(point->position)};
        double load[3];
        cpsi_trial_find_obstacle(evolution, &at[k]);
        cpsi_point_load(point, evolution->gravity, load);
        at[k].rest = vec3_load(load);
        at[k].rest = vec3_add(at[k].rest, cpsi_buoyancy_at(point, evolution->gravity));
    }
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++) {
            const int k = evolution->points.tie[2 * i + end];
            if (k == CPSI_NO_POINT) continue;
            at[k].rest = vec3_add(at[k].rest, cpsi_line_start_pull(&evolution->line[i], end));
        }
    for (int k = 0; k < evolution->points.count; k++) {
        CpsiPoint *point = &evolution->points.point[k];
        if (at[k].gives && point->kind == CPS_POINT_KIND_FREE)
            point->report.reaction = at[k].spring * fmax(0, -at[k].over);
        else if (at[k].gap <= CPS_TOUCH * point->length)
            point->report.reaction = fmax(0, -vec3_dot(at[k].rest, at[k].normal));
    }
}

/* Search once more, from a guess, `refined` to the last digits; where there is none, things stay as
 * they are. */
static bool search_again(CpsiBalance *balance, bool refined) {
    const size_t bytes = (size_t)balance->count * sizeof *balance->at;
    memcpy(balance->best, balance->at, bytes);
    if (cpsi_guess_places(balance, refined)) {
        for (int k = 0; k < balance->count; k++) {
            const CpsiFree *at = &balance->at[k];
            balance->at[k] =
                (CpsiFree){.point = at->point, .place = at->place, .obstacle = CPS_NO_OBSTACLE};
        }
        return search(balance, MOST_TRIALS);
    }
    memcpy(balance->at, balance->best, bytes);
    cpsi_try_places(balance);
    return false;
}

/* Find the place of a point, or a body, at which no line ends any more. */
static void find_lone(CpsiBalance *balance) {
    CpsOutcome outcome = CPS_OUTCOME_SOLVED;
    const bool is_body = balance->body_count > 0,
               in_set =
                   !is_body && cpsi_set_of_point(&balance->evolution->points, balance->at[0].point),
               sinks = !is_body && cpsi_line_has_soft(&balance->evolution->line[0]);
    if (!(is_body || in_set || sinks) || !search(balance, MOST_TRIALS)) {
        if (sinks) cpsi_begin_again(balance);
        outcome = is_body || in_set ? CPS_OUTCOME_STALLED : cpsi_lone_point(balance);
    }
    if (outcome == CPS_OUTCOME_UNBOUNDED) {
        cpsi_begin_again(balance);
        cpsi_report_no_place(balance);
    } else {
        cpsi_report_found(balance);
    }
    balance->evolution->lone = cps_outcome_worse(balance->evolution->lone, outcome);
}

/* Is where the step began an answer? Otherwise things stay as they are. */
static bool stays(CpsiBalance *balance) {
    const size_t bytes = (size_t)balance->count * sizeof *balance->at,
                 rigid = (size_t)balance->body_count * sizeof *balance->rigid;
    memcpy(balance->best, balance->at, bytes);
    memcpy(balance->rigid_best, balance->rigid, rigid);
    cpsi_begin_again(balance);
    cpsi_try_places(balance);
    if (cpsi_is_answer(balance)) return true;
    memcpy(balance->at, balance->best, bytes);
    memcpy(balance->rigid, balance->rigid_best, rigid);
    cpsi_try_places(balance);
    return false;
}

/* Points that come to the surface of the water or leave it, where the acceleration jumps: they are
 * to be taken by an Euler step. Returns whether there are any that were not. */
static bool restart_at_surface(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    bool any = false;
    for (int k = 0; k < balance->count; k++) {
        const CpsiFree *at = &balance->at[k];
        CpsiPoint *point = &evolution->points.point[at->point];
        const CpsPointWater now = cpsi_water_state(&at->water, cpsi_trial_touch(balance, at));
        if (now == point->report.water || !(point->inertia.span < evolution->interval)) continue;
        point->inertia.restarts = any = true;
    }
    return any;
}

/* Does a point go into what gives, or out of it, in a step that is no Euler step of it? */
static bool is_late(const CpsiBalance *balance, const CpsiFree *at) {
    const CpsEvolution *evolution = balance->evolution;
    return evolution->points.point[at->point].inertia.span < evolution->interval &&
           cpsi_soft_point_is_crossed(evolution, at->point, at->place);
}

/* ... and is it flung by the scheme? */
static bool is_flung(const CpsiBalance *balance, const CpsiFree *at) {
    return is_late(balance, at) && cpsi_point_loss(balance->evolution, at->point, at->place,
                                                   at->obstacle, at->reaction, at->normal) < 0;
}

/* The lines of a group whose motion is rough (time_step.h), whose nodes are to be taken by Euler
 * steps, as are points that go into what gives or out of it: those lines are again as they were,
 * and so is the next step of their nodes. Returns whether there are any. */
static bool restart_rough(CpsiBalance *balance, int group) {
    CpsEvolution *evolution = balance->evolution;
    bool any = restart_at_surface(balance);
    for (int item = 0; item < balance->line_count; item++)
        any = cpsi_line_is_rough(&evolution->line[balance->line[item]], evolution->interval) || any;
    for (int k = 0; k < balance->count; k++) any = any || is_flung(balance, &balance->at[k]);
    if (!any) return false;
    for (int k = 0; k < balance->count; k++) {
        CpsiPointInertia *inertia = &evolution->points.point[balance->at[k].point].inertia;
        inertia->restarts = inertia->restarts || is_late(balance, &balance->at[k]);
    }
    for (int item = 0; item < balance->line_count; item++) {
        const int i = balance->line[item];
        cpsi_trial_restore_line(balance, i);
        cpsi_line_restart_rough(&evolution->line[i]);
    }
    cpsi_point_motion_join(evolution, group);
    cpsi_point_motion_predict(evolution);
    cpsi_water_find_surfaces(evolution);
    for (int item = 0; item < balance->line_count; item++) {
        const int i = balance->line[item];
        cpsi_line_keep(&evolution->line[i], &balance->state[balance->offset[i]]);
    }
    return true;
}

/* Points and bodies where they are after the step if nothing acts on them. */
static void guess_motion(CpsiBalance *balance) {
    const CpsEvolution *evolution = balance->evolution;
    for (int k = 0; k < balance->count; k++) {
        CpsiFree *at = &balance->at[k];
        const CpsiPointInertia *inertia = &evolution->points.point[at->point].inertia;
        at->place = vec3_axpy(inertia->span, vec3_load(inertia->rest_velocity),
                              vec3_load(inertia->reference));
        for (int o = 0; o < evolution->obstacle_count; o++) {
            const double gap = cpsi_obstacle_gap(&evolution->obstacle[o], at->place);
            if (gap < 0 && !(evolution->obstacle[o].stiffness > 0))
                at->place =
                    vec3_axpy(-gap, cpsi_obstacle_normal(&evolution->obstacle[o], at->place),
                              at->place);
        }
    }
    for (int k = 0; k < balance->body_count; k++)
        balance->rigid[k].pose =
            cpsi_body_motion_guess(&evolution->bodies.body[balance->rigid[k].body]);
}

/* Find the places of a group after a step in time; where it is rough, once more. Where there are
 * none its lines are not certified. */
static void find_motion(CpsiBalance *balance, int group) {
    begin(balance, group);
    for (int i = 0; i < 2; i++) {
        guess_motion(balance);
        if (!search(balance, MOST_TRIALS) && !is_over(balance)) {
            cpsi_begin_again(balance);
            (void)search_with(balance, MOST_TRIALS, PATIENCE_AT_LAST);
        }
        if (i > 0 || is_over(balance) || !restart_rough(balance, group)) break;
    }
    if (balance->line_count == 0 && !cpsi_is_answer(balance)) {
        /* no line says so; nothing holds it, and where the trials have led it says nothing */
        balance->evolution->lone = cps_outcome_worse(balance->evolution->lone, CPS_OUTCOME_STALLED);
        cpsi_begin_again(balance);
        cpsi_try_places(balance);
    }
    cpsi_report_found(balance);
}

/* Take the answer as one program; of bodies also from poses within reach of their lines, since the
 * places of its rounds are linear in their rotations. */
static bool take_joint_answer_within_reach(CpsiBalance *balance) {
    if (cpsi_take_joint_answer(balance)) return true;
    if (balance->body_count == 0 || is_interrupted(balance->evolution)) return false;
    cpsi_bring_bodies_within_reach(balance);
    if (cpsi_take_joint_answer(balance)) return true;
    cpsi_begin_again(balance);
    return false;
}

/* Begin where the stiffness at the state before leads by the loads that are new: so much is known
 * without a trial. What slid in the step before is taken to go on. Returns what is left in that
 * state; 0 where it leads nowhere, then points begin where the last step leads. */
static double predict_places(CpsiBalance *balance) {
    cpsi_read_forces(balance);
    const double left = cpsi_left_now(balance);
    if (balance->evolution->done == 0 || !balance->certified || cpsi_is_balanced(balance, left) ||
        !cpsi_find_step(balance)) {
        cpsi_begin_again(balance);
        cpsi_extrapolate_places(balance);
        return 0;
    }
    cpsi_limit_step(balance);
    for (int k = 0; k < balance->count; k++) {
        const CpsiFree from = balance->at[k];
        balance->at[k].place = cpsi_place_after(balance, &from, &balance->step[3 * k], 1);
    }
    for (int k = 0; k < balance->body_count; k++)
        balance->rigid[k].pose = cpsi_pose_after(balance, k, &balance->rigid[k].pose,
                                                 &balance->step[3 * balance->count + 6 * k], 1);
    return left;
}

/* Search from there; where that leaves more than the loads do, as with ends that are moved as well,
 * from where everything was. */
static bool search_from_prediction(CpsiBalance *balance) {
    balance->open_trials = 0;
    const double before = predict_places(balance);
    cpsi_try_places(balance);
    if (before > 0 && !(balance->certified && cpsi_left_now(balance) <= before)) {
        cpsi_begin_again(balance);
        cpsi_extrapolate_places(balance);
        cpsi_try_places(balance);
    }
    return search_on(balance, FEW_TRIALS, patience_for(balance));
}

/* Is a point of the trial between obstacles that give? Searches go back and forth there. */
static bool is_between(const CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++)
        if (cpsi_soft_point_is_between(balance->evolution, balance->at[k].place)) return true;
    return false;
}

/* Find the places of a group. In a history a body hardly moves in a step, and a few trials from
 * where it is take less time than the rounds of a first guess. */
static void find_places(CpsiBalance *balance, int group) {
    CpsEvolution *evolution = balance->evolution;
    const bool is_static = evolution->has_static && evolution->done == 0;
    if (evolution->interval > 0) {
        find_motion(balance, group);
        return;
    }
    /* frozen bounds may grow while lines take their step in parts: these are tried first */
    const bool frozen =
        evolution->options.friction_policy == CPS_FRICTION_POLICY_FROZEN && !is_static;
    begin(balance, group);
    if (balance->line_count == 0) {
        find_lone(balance);
        return;
    }
    if (cpsi_group_turns(balance) || (!frozen && cpsi_group_falls(balance))) return;
    if (!is_static && balance->body_count > 0) {
        if (search_from_prediction(balance)) {
            cpsi_take_nearest_places(balance);
            cpsi_report_found(balance);
            return;
        }
        cpsi_begin_again(balance);
    }
    /* their tension is no function of the places */
    if (cpsi_has_inextensible(balance) && take_joint_answer_within_reach(balance)) {
        cpsi_report_found(balance);
        return;
    }
    const bool guessed = cpsi_guess_places(balance, false);
    if (!guessed && cpsi_group_is_too_short(balance)) return;
    if (!guessed) cpsi_extrapolate_places(balance);
    const bool joint = balance->body_count == 0 && !cpsi_has_inextensible(balance) &&
                       cpsi_may_have_joint_answer(balance);
    const bool early = joint && balance->count > MANY;
    bool found = search(balance, early ? TRIALS_BESIDE : MOST_TRIALS);
    if (!found && early && !is_interrupted(evolution) && cpsi_take_joint_answer(balance)) {
        cpsi_report_found(balance);
        return;
    }
    if (!found && early && !is_over(balance)) found = search_again(balance, false);
    const bool again = balance->body_count == 0 && !is_between(balance);
    if (!found && !is_over(balance) && again) found = search_again(balance, true);
    if (!found && !is_over(balance) && again)
        found = search_with(balance, MOST_TRIALS, PATIENCE_AT_LAST);
    if (!found && !frozen && !is_interrupted(evolution) && balance->body_count > 0) {
        cpsi_begin_again(balance);
        search_softly(balance);
        found = cpsi_is_answer(balance);
    }
    if (found) cpsi_take_nearest_places(balance);
    if (!found && joint && !early) found = cpsi_take_joint_answer(balance);
    if (!found && !is_interrupted(evolution)) found = stays(balance);
    if (!found && (cpsi_group_is_too_short(balance) || (frozen && cpsi_group_falls(balance))))
        return;
    if (!found) cpsi_try_places(balance); /* as before the question for a proof */
    if (!found && cpsi_group_is_left(balance)) return;
    cpsi_report_found(balance);
}

void cpsi_balance_step(CpsEvolution *evolution, CpsiTask step) {
    CpsiBalance *balance = evolution->points.balance;
    CpsiPoints *points = &evolution->points;
    bool any = false;
    cpsi_soft_point_areas(evolution);
    evolution->lone = CPS_OUTCOME_SOLVED;
    for (int i = 0; i < points->count; i++) {
        CpsiPoint *point = &points->point[i];
        point->reaction_before = point->report.reaction;
        point->height_before = cpsi_surface_height(&point->surface, vec3_load(point->before));
        any = any || points->point[i].kind == CPS_POINT_KIND_FREE || cpsi_point_drags(points, i);
    }
    for (int i = 0; i < evolution->bodies.count; i++)
        any = any || evolution->bodies.body[i].kind == CPS_BODY_KIND_FREE;
    if (any)
        cpsi_points_group(points, &evolution->bodies, evolution->line_count);
    else
        for (int i = 0; i < points->count; i++) points->group[i] = CPSI_NO_POINT;
    if (evolution->interval > 0) {
        cpsi_point_motion_join(evolution, CPSI_ALL_GROUPS);
        cpsi_point_motion_predict(evolution);
        cpsi_body_motion_predict(evolution);
    }
    cpsi_water_find_surfaces(evolution);
    if (any) {
        balance->evolution = evolution;
        balance->task = step;
        step_others(balance);
        for (int i = 0; i < points->count && !is_interrupted(evolution); i++)
            if (points->group[i] == i) find_places(balance, i);
    } else {
        cpsi_workers_run(evolution->workers, step, evolution, evolution->line_count);
    }
    cpsi_report_held(evolution);
    if (evolution->interval > 0) {
        cpsi_body_motion_advance(evolution);
        cpsi_point_motion_advance(evolution);
    } else {
        cpsi_body_motion_stop(evolution);
        cpsi_point_motion_stop(evolution);
    }
}
