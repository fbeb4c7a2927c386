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

#include "base/larger.h"
#include "cable/network.h"
#include "cable/stiffness.h"
#include "evolve/checkpoint.h"
#include "evolve/points.h"
#include "linalg/dense.h"

/* The search is for forces that balance to this share of the largest one, which is that to which
 * those of a line do; what it reaches counts as balanced up to so many tolerances of it. */
static const double TARGET = 1e-11, BALANCED = 100;
/* The search ends after so many iterations, or so many without halving what is left. */
enum { ITERATIONS = 60, PATIENCE = 6 };
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
/* A point moves by no more than this share of its longest line in one iteration. */
static const double FARTHEST = 0.5;
/* Stiffness added, in units of the largest force over the length of a point's longest line: where
 * slack lines have none, the rounding of forces moves a point by a thousandth of that length. */
static const double REGULAR = 1e-8;

/* A free point in a trial. */
typedef struct Free {
    int point;
    Vec3 place, rest; /* rest: r */
    Vec3 left;        /* r + R n + F */
    double stiffness; /* [N/m] rho, of the size of the lines' */
    /* at the nearest obstacle, where there is one */
    int obstacle;
    double gap, friction, bound, reaction;
    Vec3 normal, slip, force; /* force: F */
    Vec3 start;               /* where the point was, on the surface and turned with it */
} Free;

struct CpsiBalance {
    int count;              /* free points of the group under way */
    Free *at, *from, *best; /* (count) of the trial, before it, and of the best one */
    int *number;            /* (points) of a free point of the group, else -1 */
    int line_count;         /* lines at free points */
    int *line;              /* (line_count) */
    int *iterations;        /* (lines) of trials that were not kept */
    unsigned char *state;   /* of all lines before the step */
    size_t *offset;         /* (lines + 1) of each in `state` */
    double *tangent;        /* (line_count, 36) */
    double *matrix, *step;  /* (3 count, 3 count), (3 count) */
    int *pivot;             /* (3 count) */
    int (*ends)[2];         /* (line_count, 2) the free points at their ends, or CPSI_NO_JOINT */
    CpsiJoint *joint;       /* (count) */
    double *guess;          /* (count, 3) [m] */
    CpsiNetwork network;
    double force;   /* [N] the largest of the trial */
    bool certified; /* are all lines, in this trial? */
    bool follows;   /* friction bounds follow the reactions */
    int trials;
    CpsEvolution *evolution;
    CpsiTask task;
    CpsiArena arena; /* in which all this lies */
};

CpsiBalance *cpsi_balance_create(const CpsEvolution *evolution) {
    const size_t points = (size_t)evolution->points.count, lines = (size_t)evolution->line_count,
                 unknowns = 3 * points;
    CpsiBalance *balance = NULL, measured = {0};
    CpsiArena arena = {0};
    for (int pass = 0; pass < 2; pass++) {
        CpsiBalance *placed = cpsi_arena_take(&arena, 1, sizeof *placed),
                    *to = placed ? placed : &measured;
        CPSI_PLACE(&arena, to->at, points);
        CPSI_PLACE(&arena, to->from, points);
        CPSI_PLACE(&arena, to->best, points);
        CPSI_PLACE(&arena, to->number, points);
        CPSI_PLACE(&arena, to->line, lines);
        CPSI_PLACE(&arena, to->iterations, lines);
        CPSI_PLACE(&arena, to->offset, lines + 1);
        CPSI_PLACE(&arena, to->tangent, 36 * lines);
        CPSI_PLACE(&arena, to->matrix, unknowns * unknowns);
        CPSI_PLACE(&arena, to->step, unknowns);
        CPSI_PLACE(&arena, to->pivot, unknowns);
        CPSI_PLACE(&arena, to->ends, lines);
        CPSI_PLACE(&arena, to->joint, points);
        CPSI_PLACE(&arena, to->guess, unknowns);
        cpsi_network_place(&to->network, &arena, evolution->line, (int)lines, (int)points,
                           evolution->workspace[0].program.ops);
        size_t all = 0;
        for (size_t i = 0; i < lines; i++) {
            if (placed) to->offset[i] = all;
            all += cpsi_line_state_size(&evolution->line[i]);
        }
        CPSI_PLACE(&arena, to->state, all);
        balance = placed;
        if (pass == 0 && !cpsi_arena_allocate(&arena)) return NULL;
    }
    balance->arena = arena;
    return balance;
}

void cpsi_balance_free(CpsiBalance *balance) {
    if (!balance) return;
    CpsiArena arena = balance->arena;
    cpsi_arena_free(&arena);
}

/* trials --------------------------------------------------------------------------------------- */

static void step_one(void *data, int worker, int item) {
    CpsiBalance *balance = data;
    balance->task(balance->evolution, worker, balance->line[item]);
}

static void tangent_of_one(void *data, int worker, int item) {
    CpsiBalance *balance = data;
    CpsEvolution *evolution = balance->evolution;
    CpsiLine *line = &evolution->line[balance->line[item]];
    cpsi_workspace_attach(&evolution->workspace[worker], line);
    cpsi_line_tangent(line, &evolution->workspace[worker].program, &evolution->options,
                      &balance->tangent[36 * item]);
}

static bool places_by_statics(const CpsEvolution *evolution, int line) {
    return evolution->has_static && evolution->done == 0 && evolution->is_static[line];
}

/* Let the lines end where the free points are. */
static void impose(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    for (int item = 0; item < balance->line_count; item++) {
        const int i = balance->line[item];
        for (int end = 0; end < 2; end++) {
            const int point = evolution->points.tie[2 * i + end];
            if (point == CPSI_NO_POINT || balance->number[point] < 0) continue;
            double *to = evolution->move[i].to[end].value;
            vec3_store(to, balance->at[balance->number[point]].place);
            if (places_by_statics(evolution, i))
                memcpy(evolution->line[i].end[end].value, to, 3 * sizeof *to);
        }
    }
}

/* The nearest obstacle, and where the point was on it when the step began. */
static void find_obstacle(const CpsEvolution *evolution, Free *at) {
    const CpsiPoint *point = &evolution->points.point[at->point];
    at->obstacle = CPS_NO_OBSTACLE;
    at->gap = INFINITY;
    for (int k = 0; k < evolution->obstacle_count; k++) {
        const double gap = cpsi_obstacle_gap(&evolution->obstacle[k], at->place);
        if (!(gap < at->gap)) continue;
        at->gap = gap;
        at->obstacle = k;
    }
    if (at->obstacle == CPS_NO_OBSTACLE) return;
    const CpsiObstacle *on = &evolution->obstacle[at->obstacle];
    at->normal = cpsi_obstacle_normal(on, at->place);
    at->friction = evolution->has_static && evolution->done == 0 ? 0 : on->friction[0];
    const Vec3 before =
        cpsi_obstacle_turn(on, vec3_load(point->before), evolution->angle[at->obstacle]);
    at->slip = cpsi_obstacle_slip(on, before, at->place);
    at->start = vec3_axpy(-cpsi_obstacle_gap(on, before), cpsi_obstacle_normal(on, before), before);
}

/* [m] A point that is no farther from an obstacle, or has slid no farther, touches it, or is at
 * rest. */
static double touch_of(const CpsiBalance *balance, const Free *at) {
    return CPS_TOUCH * balance->evolution->points.point[at->point].length;
}

/* rho s - F with the friction F that would balance: within the bound the point is to stick. */
static Vec3 friction_test(const Free *at) {
    return vec3_axpy(at->stiffness, at->slip, vec3_reject(at->rest, at->normal));
}

static bool is_to_stick(const Free *at) {
    return at->bound > 0 && vec3_norm(friction_test(at)) <= at->bound;
}

/* What the obstacle does to the point, and what nothing balances. The friction bound follows the
 * reaction, or is that of the reference, and then acts off the obstacle as well (S90 (35)). The
 * friction is the force within its bound that is nearest to F - rho s, F what would balance: at a
 * solution it is F and opposite to the slip, elsewhere what is left is continuous in the place.
 * Until the stiffness rho is known, what has slid by CPS_TOUCH slides. */
static void find_contact(const CpsiBalance *balance, Free *at) {
    const CpsiPoint *point = &balance->evolution->points.point[at->point];
    const double touch = touch_of(balance, at);
    at->reaction = at->bound = 0;
    at->force = vec3(0, 0, 0);
    at->left = at->rest;
    if (at->obstacle == CPS_NO_OBSTACLE) return;
    if (at->gap <= touch) at->reaction = fmax(0, -vec3_dot(at->rest, at->normal));
    at->bound = at->friction * (balance->follows ? at->reaction : point->reaction_before);
    if (!(at->stiffness > 0)) at->stiffness = at->bound / touch;
    const Vec3 test = friction_test(at);
    const double size = vec3_norm(test);
    at->force = vec3_scale(size > at->bound ? -at->bound / size : -1, test);
    at->left = vec3_add(vec3_axpy(at->reaction, at->normal, at->rest), at->force);
}

static void restore_line(CpsiBalance *balance, int line) {
    cpsi_line_restore(&balance->evolution->line[line], &balance->state[balance->offset[line]]);
}

/* Solve the lines for the places of the points. */
static void try_places(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    if (balance->trials > 0)
        for (int item = 0; item < balance->line_count; item++) {
            const int i = balance->line[item];
            balance->iterations[i] += evolution->line[i].report.iteration_count;
            restore_line(balance, i);
        }
    impose(balance);
    cpsi_workers_run(evolution->workers, step_one, balance, balance->line_count);
    balance->trials++;
    balance->force = 0;
    balance->certified = true;
    for (int k = 0; k < balance->count; k++) {
        double load[3];
        cpsi_point_load(&evolution->points.point[balance->at[k].point], evolution->gravity, load);
        balance->at[k].rest = vec3_load(load);
        balance->force = fmax(balance->force, vec3_norm(balance->at[k].rest));
    }
    for (int item = 0; item < balance->line_count; item++) {
        const int i = balance->line[item];
        const CpsLineReport *report = &evolution->line[i].report;
        balance->certified = balance->certified && cps_outcome_is_certified(report->outcome);
        balance->force = cpsi_max_nan(balance->force, report->certificate.largest_force);
        for (int end = 0; end < 2; end++) {
            const int point = evolution->points.tie[2 * i + end];
            if (point == CPSI_NO_POINT || balance->number[point] < 0) continue;
            Free *at = &balance->at[balance->number[point]];
            at->rest = vec3_sub(at->rest, vec3_load(report->end[end].force));
        }
    }
    for (int k = 0; k < balance->count; k++) {
        find_obstacle(evolution, &balance->at[k]);
        find_contact(balance, &balance->at[k]);
    }
}

/* [N] The largest force that nothing balances. */
static double largest_left(int count, const Free *at) {
    double most = 0;
    for (int k = 0; k < count; k++) most = cpsi_max_nan(most, vec3_norm(at[k].left));
    return most;
}

/* Newton's method ------------------------------------------------------------------------------ */

/* The stiffness of the lines at the points. */
static void fill_matrix(CpsiBalance *balance) {
    const CpsEvolution *evolution = balance->evolution;
    const size_t n = 3 * (size_t)balance->count;
    cpsi_workers_run(evolution->workers, tangent_of_one, balance, balance->line_count);
    memset(balance->matrix, 0, n * n * sizeof *balance->matrix);
    for (int item = 0; item < balance->line_count; item++) {
        const int *tie = &evolution->points.tie[2 * (size_t)balance->line[item]];
        const double *tangent = &balance->tangent[36 * (size_t)item];
        for (int to = 0; to < 2; to++)
            for (int from = 0; from < 2; from++) {
                const int row = tie[to] == CPSI_NO_POINT ? -1 : balance->number[tie[to]],
                          column = tie[from] == CPSI_NO_POINT ? -1 : balance->number[tie[from]];
                if (row < 0 || column < 0) continue;
                for (int a = 0; a < 3; a++)
                    for (int b = 0; b < 3; b++)
                        balance->matrix[(3 * (size_t)row + (size_t)a) * n + 3 * (size_t)column +
                                        (size_t)b] += tangent[6 * (3 * to + a) + 3 * from + b];
            }
    }
    for (int k = 0; k < balance->count; k++) {
        Free *at = &balance->at[k];
        double trace = 0;
        for (size_t a = 0; a < 3; a++) {
            const size_t i = 3 * (size_t)k + a;
            trace += fabs(balance->matrix[i * n + i]);
        }
        const double length = evolution->points.point[at->point].length;
        at->stiffness = fmax(trace / 3, REGULAR * balance->force / length);
        for (size_t a = 0; a < 3; a++) {
            const size_t i = 3 * (size_t)k + a;
            balance->matrix[i * n + i] += REGULAR * balance->force / length;
        }
    }
}

/* Is the point to be on the obstacle after the step? */
static bool is_to_touch(const Free *at) {
    return at->obstacle != CPS_NO_OBSTACLE &&
           -vec3_dot(at->rest, at->normal) > at->stiffness * fmax(at->gap, 0);
}

/* The equation P K d + Q d = v of a point in its step, K its rows of the matrix. */
typedef struct Equation {
    double p[3][3], q[3][3];
    Vec3 v;
} Equation;

/* m += by a b' */
static void add_outer(double m[3][3], double by, Vec3 a, Vec3 b) {
    const double left[3] = {a.x, a.y, a.z}, right[3] = {b.x, b.y, b.z};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) m[i][j] += by * left[i] * right[j];
}
static void add_identity(double m[3][3], double by) {
    for (int i = 0; i < 3; i++) m[i][i] += by;
}

/* Along the surface: at rest, where friction holds the point; sliding with the friction F = -b e, e
 * the direction of the slip, which turns with it, where a bound b = mu R follows the reaction; or
 * without friction. */
static void add_tangential(Equation *out, const Free *at, bool follows) {
    const Vec3 n = at->normal, test = friction_test(at);
    const double size = vec3_norm(test);
    if (at->bound > 0 && is_to_stick(at)) {
        add_identity(out->q, at->stiffness);
        add_outer(out->q, -at->stiffness, n, n);
        const Vec3 back = vec3_reject(vec3_sub(at->start, at->place), n);
        out->v = vec3_axpy(at->stiffness, back, out->v);
        return;
    }
    add_identity(out->p, 1);
    add_outer(out->p, -1, n, n);
    out->v = vec3_add(out->v, vec3_reject(at->rest, n));
    if (!(at->bound > 0) || !(size > 0)) return;
    const Vec3 e = vec3_scale(1 / size, test);
    const double turns = at->bound / (vec3_norm(at->slip) + at->bound / at->stiffness);
    if (follows) add_outer(out->p, at->friction, e, n);
    add_identity(out->q, turns);
    add_outer(out->q, -turns, n, n);
    add_outer(out->q, -turns, e, e);
    out->v = vec3_axpy(-at->bound, e, out->v);
}

/* Across it: the gap closes, or nothing acts. */
static void add_normal(Equation *out, const Free *at) {
    const Vec3 n = at->normal;
    if (is_to_touch(at)) {
        add_outer(out->q, at->stiffness, n, n);
        out->v = vec3_axpy(-at->stiffness * at->gap, n, out->v);
    } else {
        add_outer(out->p, 1, n, n);
        out->v = vec3_axpy(vec3_dot(at->rest, n), n, out->v);
    }
}

static Equation equation_of(const Free *at, bool follows) {
    Equation out = {.v = vec3(0, 0, 0)};
    if (at->obstacle == CPS_NO_OBSTACLE) {
        add_identity(out.p, 1);
        out.v = at->rest;
        return out;
    }
    add_tangential(&out, at, follows);
    add_normal(&out, at);
    return out;
}

/* The step of all points by Newton's method. */
static bool find_step(CpsiBalance *balance) {
    const size_t n = 3 * (size_t)balance->count;
    fill_matrix(balance);
    for (int k = 0; k < balance->count; k++) {
        const Equation is = equation_of(&balance->at[k], balance->follows);
        double *row = &balance->matrix[3 * (size_t)k * n];
        for (size_t j = 0; j < n; j++) {
            const double old[3] = {row[j], row[n + j], row[2 * n + j]};
            for (size_t a = 0; a < 3; a++)
                row[a * n + j] = is.p[a][0] * old[0] + is.p[a][1] * old[1] + is.p[a][2] * old[2];
        }
        for (size_t a = 0; a < 3; a++)
            for (size_t b = 0; b < 3; b++) row[a * n + 3 * (size_t)k + b] += is.q[a][b];
        vec3_store(&balance->step[3 * k], is.v);
    }
    if (!cpsi_lu_factor((int)n, balance->matrix, balance->pivot)) return false;
    cpsi_lu_solve((int)n, balance->matrix, balance->pivot, balance->step);
    for (size_t i = 0; i < n; i++)
        if (!isfinite(balance->step[i])) return false;
    return true;
}

/* Without a matrix: every point along the force that is left on it. */
static void follow_forces(CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++) {
        const Free *at = &balance->at[k];
        vec3_store(&balance->step[3 * k],
                   at->stiffness > 0 ? vec3_scale(1 / at->stiffness, at->left) : vec3(0, 0, 0));
    }
}

static void limit_step(CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++) {
        const double most =
            FARTHEST * balance->evolution->points.point[balance->at[k].point].length;
        const double size = vec3_norm(vec3_load(&balance->step[3 * k]));
        if (size > most)
            for (int a = 0; a < 3; a++) balance->step[3 * k + a] *= most / size;
    }
}

/* the search ----------------------------------------------------------------------------------- */

/* The place of a point after a share of the step: out of every obstacle, and on that on which it is
 * to lie; exactly where it was where it is to stick. */
static Vec3 place_after(const CpsiBalance *balance, const Free *from, const double step[3],
                        double share) {
    const CpsEvolution *evolution = balance->evolution;
    Vec3 x = vec3_axpy(share, vec3_load(step), from->place);
    const bool touches = is_to_touch(from);
    if (touches && is_to_stick(from) && share == 1) return from->start;
    if (touches) {
        const CpsiObstacle *on = &evolution->obstacle[from->obstacle];
        const double gap = cpsi_obstacle_gap(on, x);
        if (share == 1 || gap < 0) x = vec3_axpy(-gap, cpsi_obstacle_normal(on, x), x);
    }
    for (int k = 0; k < evolution->obstacle_count; k++) {
        const double gap = cpsi_obstacle_gap(&evolution->obstacle[k], x);
        if (gap < 0) x = vec3_axpy(-gap, cpsi_obstacle_normal(&evolution->obstacle[k], x), x);
    }
    return x;
}

/* [J] The work along the step of the forces that are left. */
static double work_along(const CpsiBalance *balance) {
    double work = 0;
    for (int k = 0; k < balance->count; k++)
        work += vec3_dot(balance->at[k].left, vec3_load(&balance->step[3 * k]));
    return work;
}

static bool is_interrupted(const CpsEvolution *evolution) {
    bool seen = false;
    for (int i = 0; i < evolution->workspace_count; i++)
        seen = seen || cpsi_interrupt_seen(&evolution->workspace[i].interrupt);
    return seen;
}

/* [m] The length of the shortest of the points' longest lines. */
static double smallest_length(const CpsiBalance *balance) {
    double least = INFINITY;
    for (int k = 0; k < balance->count; k++)
        least = fmin(least, balance->evolution->points.point[balance->at[k].point].length);
    return least;
}

/* [m] The largest displacement of a point in the step. */
static double size_of_step(const CpsiBalance *balance) {
    double most = 0;
    for (int k = 0; k < balance->count; k++)
        most = fmax(most, vec3_norm(vec3_load(&balance->step[3 * k])));
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

/* Take the step, or the share of it at which the work along it nearly vanishes, in no more than
 * `shortenings` further trials. Returns by which factor the next step may be longer: where the work
 * has fallen less than it should, the stiffness is less than the matrix says. */
static double take_step(CpsiBalance *balance, int shortenings, double longer) {
    const double work = work_along(balance),
                 allowed = REDUCED * largest_left(balance->count, balance->from),
                 size = size_of_step(balance);
    Bracket bracket = {.high = NAN, .above = work};
    double share = 1;
    for (int i = 0; i <= shortenings && share * size > 0; i++) {
        for (int k = 0; k < balance->count; k++)
            balance->at[k].place =
                place_after(balance, &balance->from[k], &balance->step[3 * k], share);
        try_places(balance);
        if (is_interrupted(balance->evolution)) return 1;
        const double now = work_along(balance);
        if (!balance->certified || !(work > 0)) {
            if (balance->certified && largest_left(balance->count, balance->at) <= allowed)
                return 1;
            bracket.high = share;
            bracket.below = -work;
            share *= 0.5;
            continue;
        }
        const bool reduced = largest_left(balance->count, balance->at) <= allowed;
        if (i == 0 && (reduced || now >= -OVERSHOOT * work))
            return work > 0
                       ? fmin(longer * fmax(work / (work - fmin(now, 0.9 * work)), 0.5), LONGEST)
                       : 1;
        if (fabs(now) <= NEARLY * work) return 1;
        const double before = share;
        share = next_share(&bracket, share, now);
        if (fabs(share - before) * size <= ROUNDING * smallest_length(balance)) return 1;
    }
    return 1;
}

/* Step the lines that are at no free point. */
static void step_others(CpsiBalance *balance) {
    balance->line_count = 0;
    for (int i = 0; i < balance->evolution->line_count; i++)
        if (cpsi_group_of_line(&balance->evolution->points, i) == CPSI_NO_POINT)
            balance->line[balance->line_count++] = i;
    if (balance->line_count > 0)
        cpsi_workers_run(balance->evolution->workers, step_one, balance, balance->line_count);
}

/* Find the points and lines of a group. */
static void begin(CpsiBalance *balance, int group) {
    CpsEvolution *evolution = balance->evolution;
    CpsiPoints *points = &evolution->points;
    balance->count = balance->line_count = balance->trials = 0;
    balance->follows = evolution->options.friction_policy != CPS_FRICTION_POLICY_FROZEN;
    for (int i = 0; i < points->count; i++) {
        CpsiPoint *point = &points->point[i];
        balance->number[i] = -1;
        if (points->group[i] != group) continue;
        balance->number[i] = balance->count;
        balance->at[balance->count++] =
            (Free){.point = i, .place = vec3_load(point->position), .obstacle = CPS_NO_OBSTACLE};
    }
    for (int i = 0; i < evolution->line_count; i++) {
        if (cpsi_group_of_line(points, i) != group) continue;
        balance->line[balance->line_count++] = i;
        balance->iterations[i] = 0;
        cpsi_line_keep(&evolution->line[i], &balance->state[balance->offset[i]]);
    }
}

/* Let line i begin and end the step as planned, its ends at free points where they are. */
static void impose_plan(CpsiBalance *balance, int item) {
    CpsEvolution *evolution = balance->evolution;
    const int i = balance->line[item];
    CpsiLine *line = &evolution->line[i];
    cpsi_workspace_attach(&evolution->workspace[0], line);
    for (int k = 0; k < evolution->obstacle_count; k++)
        evolution->workspace[0].scratch.turn[k] = evolution->angle[k];
    memcpy(line->weight_before, evolution->move[i].weight_from, sizeof line->weight_before);
    memcpy(line->weight, evolution->move[i].weight_to, sizeof line->weight);
    for (int end = 0; end < 2; end++) {
        const int point = evolution->points.tie[2 * i + end];
        const int number = point == CPSI_NO_POINT ? -1 : balance->number[point];
        balance->ends[item][end] = number < 0 ? CPSI_NO_JOINT : number;
        line->end_before[end] = evolution->move[i].from[end];
        if (number < 0) line->end[end] = evolution->move[i].to[end];
    }
}

/* Begin where the points go on the tangent planes of the reference; false where that has no
 * solution. */
static bool guess_places(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    CpsiStepOptions options = evolution->options;
    int iterations;
    if (evolution->has_static && evolution->done == 0) {
        options.frictionless = true;
        options.contact_policy = CPS_CONTACT_POLICY_REACHED;
    }
    for (int item = 0; item < balance->line_count; item++) impose_plan(balance, item);
    for (int k = 0; k < balance->count; k++) {
        Free *at = &balance->at[k];
        const CpsiPoint *point = &evolution->points.point[at->point];
        double load[3];
        at->place = vec3_load(point->position);
        find_obstacle(evolution, at);
        cpsi_point_load(point, evolution->gravity, load);
        balance->joint[k] = (CpsiJoint){.position = at->place,
                                        .load = vec3_load(load),
                                        .obstacle = at->obstacle == CPS_NO_OBSTACLE
                                                        ? NULL
                                                        : &evolution->obstacle[at->obstacle],
                                        .gap = at->gap,
                                        .friction = at->friction,
                                        .bound = at->friction * point->reaction_before};
    }
    for (int item = 0; item < balance->line_count; item++)
        for (int end = 0; end < 2; end++) {
            const CpsiLine *line = &evolution->line[balance->line[item]];
            const int k = balance->ends[item][end], e = end == CPS_END_A ? 0 : line->n - 2;
            if (k == CPSI_NO_JOINT) continue;
            balance->joint[k].share += 0.5 * line->element_length[e];
        }
    const CpsiNetworkPart part = {.lines = balance->line_count,
                                  .joints = balance->count,
                                  .number = balance->line,
                                  .at = (const int(*)[2])balance->ends,
                                  .joint = balance->joint};
    const bool found = cpsi_network_guess(&balance->network, evolution->line, &part, &options,
                                          balance->guess, &iterations);
    for (int item = 0; item < balance->line_count; item++)
        restore_line(balance, balance->line[item]);
    for (int k = 0; k < balance->count; k++) {
        Free *at = &balance->at[k];
        double step[3];
        if (!found) continue;
        vec3_store(step, vec3_sub(vec3_load(&balance->guess[3 * k]), at->place));
        at->place =
            place_after(balance, &(Free){.place = at->place, .obstacle = CPS_NO_OBSTACLE}, step, 1);
    }
    return found;
}

/* Begin where the last step of the same stage leads. */
static void extrapolate(CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++) {
        Free *at = &balance->at[k];
        const CpsiPoint *point = &balance->evolution->points.point[at->point];
        if (point->is_moving) at->place = place_after(balance, at, point->move, 1);
    }
}

/* Is what is left within the tolerance? A force that is left changes the tensions of the lines by
 * no more than itself, which is far below the bound of their error that certificates at this
 * tolerance give: these are of second order. */
static bool is_balanced(const CpsiBalance *balance, double left) {
    return left <= BALANCED * balance->evolution->options.solver.tolerance * balance->force;
}

static void search(CpsiBalance *balance) {
    const size_t bytes = (size_t)balance->count * sizeof *balance->at;
    double best = INFINITY, halved = INFINITY, longer = 1;
    int waited = 0;
    try_places(balance);
    for (int i = 0; i < ITERATIONS && !is_interrupted(balance->evolution); i++) {
        const double left = largest_left(balance->count, balance->at);
        if (balance->certified && left < best) {
            best = left;
            memcpy(balance->best, balance->at, bytes);
        }
        if (balance->certified && left <= TARGET * balance->force) return;
        waited++;
        if (balance->certified && left <= 0.5 * halved) {
            waited = 0;
            halved = left;
        }
        const bool good = is_balanced(balance, best);
        if (waited > (good ? 1 : PATIENCE)) break;
        if (!find_step(balance)) follow_forces(balance);
        for (int k = 0; k < 3 * balance->count; k++) balance->step[k] *= longer;
        limit_step(balance);
        memcpy(balance->from, balance->at, bytes);
        longer = take_step(balance, good ? 0 : SHORTENINGS, longer);
    }
    if (!(best < INFINITY) || !(best < largest_left(balance->count, balance->at))) return;
    memcpy(balance->at, balance->best, bytes);
    try_places(balance);
}

/* report --------------------------------------------------------------------------------------- */

static void report_point(const CpsiBalance *balance, const Free *at) {
    CpsEvolution *evolution = balance->evolution;
    CpsiPoint *point = &evolution->points.point[at->point];
    CpsPointReport *report = &point->report;
    const double touch = touch_of(balance, at), dissipated = -vec3_dot(at->force, at->slip);
    const bool touches = at->reaction > 0, slides = vec3_norm(at->slip) > touch;
    *report = (CpsPointReport){.state = !touches ? CPS_POINT_STATE_FREE
                                        : slides ? CPS_POINT_STATE_SLIP
                                                 : CPS_POINT_STATE_STICK,
                               .obstacle = touches ? at->obstacle : CPS_NO_OBSTACLE,
                               .reaction = at->reaction,
                               .dissipated = fmax(0, dissipated),
                               .trial_count = balance->trials};
    cpsi_point_load(point, evolution->gravity, report->load);
    vec3_store(report->position, at->place);
    vec3_store(report->lines, vec3_sub(at->rest, vec3_load(report->load)));
    vec3_store(report->friction, at->force);
    vec3_store(report->residual, at->left);
    if (touches) vec3_store(report->normal, at->normal);
    if (touches) vec3_store(report->slip, at->slip);
    report->has_place = is_balanced(balance, vec3_norm(at->left));
    for (int a = 0; a < 3; a++) point->move[a] = report->position[a] - point->before[a];
    memcpy(point->position, report->position, sizeof point->position);
}

/* Is there a free point without a place? Then the lines there are not certified; nor do they prove
 * that there is no equilibrium, which would depend on the places tried. */
static void report_lines(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    bool all = balance->certified;
    for (int k = 0; k < balance->count; k++)
        all = all && evolution->points.point[balance->at[k].point].report.has_place;
    for (int item = 0; item < balance->line_count; item++) {
        CpsLineReport *report = &evolution->line[balance->line[item]].report;
        report->iteration_count += balance->iterations[balance->line[item]];
        const bool claims =
            cps_outcome_is_certified(report->outcome) || cps_outcome_is_final(report->outcome);
        if (!all && claims) report->outcome = CPS_OUTCOME_STALLED;
    }
}

static void report_held(CpsEvolution *evolution, int index) {
    CpsiPoint *point = &evolution->points.point[index];
    CpsPointReport *report = &point->report;
    Vec3 lines = vec3(0, 0, 0);
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++)
            if (evolution->points.tie[2 * i + end] == index)
                lines = vec3_sub(lines, vec3_load(evolution->line[i].report.end[end].force));
    *report = (CpsPointReport){.state = CPS_POINT_STATE_HELD,
                               .obstacle = CPS_NO_OBSTACLE,
                               .has_place = true};
    Free at = {.point = index, .place = vec3_load(point->position)};
    find_obstacle(evolution, &at);
    memcpy(report->position, point->position, sizeof report->position);
    vec3_store(report->lines, lines);
    Vec3 support = vec3_scale(-1, lines);
    if (at.gap <= CPS_TOUCH * point->length && vec3_dot(support, at.normal) > 0) {
        report->obstacle = at.obstacle;
        report->reaction = vec3_dot(support, at.normal);
        vec3_store(report->normal, at.normal);
        support = vec3_reject(support, at.normal);
    }
    vec3_store(report->support, support);
}

void cpsi_balance_start(CpsEvolution *evolution) {
    for (int k = 0; k < evolution->points.count; k++) {
        CpsiPoint *point = &evolution->points.point[k];
        Free at = {.point = k, .place = vec3_load(point->position)};
        double load[3];
        find_obstacle(evolution, &at);
        cpsi_point_load(point, evolution->gravity, load);
        at.rest = vec3_load(load);
        for (int i = 0; i < evolution->line_count; i++)
            for (int end = 0; end < 2; end++)
                if (evolution->points.tie[2 * i + end] == k)
                    at.rest = vec3_add(at.rest, cpsi_line_start_pull(&evolution->line[i], end));
        if (at.gap <= CPS_TOUCH * point->length)
            point->report.reaction = fmax(0, -vec3_dot(at.rest, at.normal));
    }
}

/* Find the places of a group of free points. */
static void find_places(CpsiBalance *balance, int group) {
    begin(balance, group);
    if (!guess_places(balance)) extrapolate(balance);
    search(balance);
    for (int k = 0; k < balance->count; k++) report_point(balance, &balance->at[k]);
    report_lines(balance);
}

void cpsi_balance_step(CpsEvolution *evolution, CpsiTask step) {
    CpsiBalance *balance = evolution->points.balance;
    CpsiPoints *points = &evolution->points;
    bool any = false;
    for (int i = 0; i < points->count; i++) {
        points->point[i].reaction_before = points->point[i].report.reaction;
        any = any || points->point[i].kind == CPS_POINT_KIND_FREE;
    }
    if (any) {
        balance->evolution = evolution;
        balance->task = step;
        cpsi_points_group(points, evolution->line_count);
        step_others(balance);
        for (int i = 0; i < points->count && !is_interrupted(evolution); i++)
            if (points->group[i] == i) find_places(balance, i);
    } else {
        cpsi_workers_run(evolution->workers, step, evolution, evolution->line_count);
    }
    for (int i = 0; i < points->count; i++)
        if (points->point[i].kind == CPS_POINT_KIND_HELD) report_held(evolution, i);
}
