/* SPDX-License-Identifier: BSD-3-Clause */
/* The nearest places (nearest_places.h).
 *
 * An anchor that is pulled with exactly its capacity balances wherever it lies along the pull, and
 * so does a point at exactly its friction limit, or one whose lines are all slack: the energy is
 * flat there. The places that balance are a convex set, in which the search ends anywhere. The
 * answer is the one of least motion, as for the nodes of a line (cable/least_motion.c).
 *
 * In directions in which the energy is flat the matrix of Newton's method has only the little
 * stiffness that is added to it. A force of that stiffness times the displacement from where the
 * step began, towards there, therefore moves the points to the nearest place in these directions,
 * and in no others. So far, or as far of it as all still balances, they go; what has slid and comes
 * back to where it was does not go beyond. */
#include "evolve/nearest_places.h"

#include <math.h>
#include <string.h>

#include "evolve/newton_step.h"
#include "evolve/points.h"

/* The set has corners, where a line comes taut or another point begins to slide: so many steps. The
 * end of one is found in so many halvings. */
enum { STEPS = 4, HALVINGS = 24 };
/* A place that balances as well leaves no more than this share of the largest force beyond what was
 * left; a step shorter than this share of the displacement is none; what comes back to within this
 * share is where it was. */
static const double AS_WELL = 1e-9, NO_STEP = 1e-2, BACK = 1e-6;

/* [m] From where a point was. */
static Vec3 moved_by(const CpsiBalance *balance, const CpsiFree *at) {
    const CpsiPoint *point = &balance->evolution->points.point[at->point];
    const bool has_start = at->drags || (at->obstacle != CPS_NO_OBSTACLE && at->reaction > 0);
    return vec3_sub(at->place, has_start ? at->start : vec3_load(point->before));
}

/* [N] The size of what the lines do to a point, along the obstacle on which it rests. */
static double pull_on(const CpsiBalance *balance, const CpsiFree *at) {
    const CpsEvolution *evolution = balance->evolution;
    double load[3] = {0};
    if (!at->drags) cpsi_point_load(&evolution->points.point[at->point], evolution->gravity, load);
    const Vec3 pull = vec3_sub(cpsi_rest_with(at, 0), vec3_load(load));
    return vec3_norm(at->reaction > 0 ? vec3_reject(pull, at->normal) : pull);
}

/* Has a point moved though no line pulls it? Taut lines may balance each other, and then hold it.
 */
static bool is_idle(const CpsiBalance *balance, const CpsiFree *at) {
    return vec3_norm(moved_by(balance, at)) > cpsi_trial_touch(balance, at) &&
           fmax(at->tension, pull_on(balance, at)) <= AS_WELL * balance->force;
}

/* Does a point move without any line that pulls it, or slide by forces that may be at their bound
 * elsewhere too? */
static bool may_have_a_choice(const CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++) {
        const CpsiFree *at = &balance->at[k];
        const double far = vec3_norm(moved_by(balance, at)), touch = cpsi_trial_touch(balance, at);
        if ((far > touch && at->bound > 0) || is_idle(balance, at)) return true;
    }
    return false;
}

/* The share of the step at which the first point that slides comes back to where it was. */
static double share_back(const CpsiBalance *balance) {
    double share = 1;
    for (int k = 0; k < balance->count; k++) {
        const Vec3 slip = balance->from[k].slip, step = vec3_load(&balance->step[3 * k]);
        const double towards = -vec3_dot(slip, step), far = vec3_dot(slip, slip);
        if (balance->from[k].bound > 0 && far > 0 && towards > far)
            share = fmin(share, far / towards);
    }
    return share;
}

/* Go by a share of the step; does all balance there as well? */
static bool is_as_good(CpsiBalance *balance, double share, double left) {
    for (int k = 0; k < balance->count; k++) {
        CpsiFree *at = &balance->at[k];
        const CpsiFree *from = &balance->from[k];
        const double far = vec3_norm(moved_by(balance, from));
        *at = *from;
        at->place = cpsi_place_after(balance, from, &balance->step[3 * k], share);
        cpsi_trial_find_obstacle(balance->evolution, at);
        const Vec3 off = moved_by(balance, at);
        if (vec3_norm(off) <= BACK * far) at->place = vec3_sub(at->place, off);
    }
    for (int k = 0; k < balance->body_count; k++)
        balance->rigid[k].pose = cpsi_pose_after(balance, k, &balance->rigid_from[k].pose,
                                                 &balance->step[3 * balance->count + 6 * k], share);
    cpsi_try_places(balance);
    return cpsi_is_answer(balance) && cpsi_left_now(balance) <= left + AS_WELL * balance->force;
}

/* The largest share of the step up to which all balances. */
static double largest_share(CpsiBalance *balance, double left) {
    const double most = share_back(balance);
    double good = NO_STEP * most, bad = most;
    if (is_as_good(balance, most, left)) return most;
    if (!is_as_good(balance, good, left)) return 0;
    for (int i = 0; i < HALVINGS && bad - good > NO_STEP * most; i++) {
        const double middle = 0.5 * (good + bad);
        *(is_as_good(balance, middle, left) ? &good : &bad) = middle;
    }
    return good;
}

/* The lines at points that a step has moved have places that are not unique. */
static void report_choice(CpsiBalance *balance, CpsPlaces places) {
    const CpsEvolution *evolution = balance->evolution;
    for (int item = 0; item < balance->line_count; item++)
        for (int end = 0; end < 2; end++) {
            CpsiLine *line = &evolution->line[balance->line[item]];
            const int point = evolution->points.tie[2 * balance->line[item] + end];
            const int k = point == CPSI_NO_POINT ? -1 : balance->number[point];
            if (k >= 0 && balance->chose[k] && line->report.places < places)
                line->report.places = places;
        }
}

/* Find the step, and note which points it moves by more than rounding; is there any? */
static bool find_step(CpsiBalance *balance) {
    bool any = false;
    if (!cpsi_find_least_step(balance)) return false;
    for (int k = 0; k < balance->count; k++) {
        const CpsiFree *at = &balance->at[k];
        const double far = vec3_norm(moved_by(balance, at)),
                     step = vec3_norm(vec3_load(&balance->step[3 * k]));
        if (!(step > fmax(NO_STEP * far, cpsi_trial_touch(balance, at)))) continue;
        any = balance->chose[k] = true;
    }
    return any;
}

static void keep_places(CpsiBalance *balance) {
    memcpy(balance->best, balance->at, (size_t)balance->count * sizeof *balance->at);
    memcpy(balance->rigid_best, balance->rigid,
           (size_t)balance->body_count * sizeof *balance->rigid);
}
/* ... and try those that were kept. */
static void return_to_places(CpsiBalance *balance) {
    memcpy(balance->at, balance->best, (size_t)balance->count * sizeof *balance->at);
    memcpy(balance->rigid, balance->rigid_best,
           (size_t)balance->body_count * sizeof *balance->rigid);
    cpsi_try_places(balance);
}

/* Does all balance as well with the points that no line pulls where they were? Nothing is nearer.
 * How slack their lines are the matrix does not tell: elements may be just as long as they are
 * apart. */
static bool go_back(CpsiBalance *balance) {
    bool any = false;
    for (int i = 0; i < balance->unknowns; i++) balance->step[i] = 0;
    for (int k = 0; k < balance->count; k++) {
        balance->chose[k] = is_idle(balance, &balance->at[k]);
        any = any || balance->chose[k];
        if (balance->chose[k])
            vec3_store(&balance->step[3 * k], vec3_scale(-1, moved_by(balance, &balance->at[k])));
    }
    if (!any) return false;
    const double left = cpsi_left_now(balance);
    keep_places(balance);
    memcpy(balance->from, balance->best, (size_t)balance->count * sizeof *balance->from);
    memcpy(balance->rigid_from, balance->rigid_best,
           (size_t)balance->body_count * sizeof *balance->rigid_from);
    if (is_as_good(balance, 1, left)) return true;
    return_to_places(balance);
    return false;
}

/* Is there still a point that no line pulls away from where it was? Where its lines come taut, by
 * no force, the steps do not see it. */
static bool has_idle(const CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++)
        if (is_idle(balance, &balance->at[k])) return true;
    return false;
}

void cpsi_take_nearest_places(CpsiBalance *balance) {
    const size_t bytes = (size_t)balance->count * sizeof *balance->at,
                 rigid = (size_t)balance->body_count * sizeof *balance->rigid;
    memset(balance->chose, 0, (size_t)balance->count * sizeof *balance->chose);
    if (cpsi_has_inextensible(balance) || !may_have_a_choice(balance)) return;
    if (go_back(balance)) {
        report_choice(balance, CPS_PLACES_NEAREST);
        return;
    }
    double share = 0;
    int i = 0;
    for (; i < STEPS; i++) {
        const double left = cpsi_left_now(balance);
        keep_places(balance);
        if (!find_step(balance)) {
            memcpy(balance->at, balance->best, bytes);
            break;
        }
        memcpy(balance->from, balance->best, bytes);
        memcpy(balance->rigid_from, balance->rigid_best, rigid);
        share = largest_share(balance, left);
        if (share > 0 && is_as_good(balance, share, left)) continue;
        return_to_places(balance);
        break;
    }
    /* a corner of the set at which the steps end may be farther than another one */
    const bool nearest = i < STEPS && (i == 0 || share > 0) && !has_idle(balance);
    report_choice(balance, nearest ? CPS_PLACES_NEAREST : CPS_PLACES_ANY);
}
