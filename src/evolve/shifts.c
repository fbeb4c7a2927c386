/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that are shifted (shifts.h). */
#include "evolve/shifts.h"

#include <math.h>
#include <stdio.h>

#include "base/math.h"
#include "base/status.h"
#include "evolve/ranges.h"

/* Limit of a shift in one stage, in radii of a round obstacle, which takes a substep for each
 * quarter of one; and of its turn, which takes one for each quarter of a turn. */
static const double MOST_RADII = 1e4, MOST_TURN = 2e4 * CPSI_PI, DEGREES = 180 / CPSI_PI;

/* [rad] The path of what is held is checked at places so far apart as the obstacle turns. */
static const double PATH_ANGLE = 0.005;
enum { MOST_PLACES = 100000 };

/* Depth below the surface that still counts as touching, per length of the line. */
static const double PATH_TOUCH = 1e-9;

/* What a shift asks of an obstacle that moves. */
static CpsStatus check_shift(const CpsObstacle *obstacle, const CpsShift *shift, const char *place,
                             const char *what, CpsError *err) {
    const double *const of[] = {shift->by, shift->turn, shift->about};
    static const char *const is[] = {"is shifted by", "is shifted with the turn",
                                     "is shifted about"};
    for (int i = 0; i < 3; i++)
        if (!cpsi_are_usable(of[i]))
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: obstacle '%s' %s (%g, %g, %g), expected finite numbers", what,
                                obstacle->name, is[i], of[i][0], of[i][1], of[i][2]);
    const double turn = vec3_norm(vec3_load(shift->turn));
    if (turn > MOST_TURN)
        return CPSI_FAIL_AT(place, err, CPS_ERR_LIMIT,
                            "%s: obstacle '%s' is shifted with a turn of %g degrees, the limit is "
                            "%g",
                            what, obstacle->name, turn * DEGREES, MOST_TURN * DEGREES);
    if (obstacle->kind == CPS_OBSTACLE_PLANE) return CPS_OK;
    const double by = vec3_norm(vec3_load(shift->by));
    if (by > MOST_RADII * obstacle->radius)
        return CPSI_FAIL_AT(place, err, CPS_ERR_LIMIT,
                            "%s: obstacle '%s' is shifted by %g m, the limit is %g radii", what,
                            obstacle->name, by, MOST_RADII);
    return CPS_OK;
}

CpsStatus cpsi_stage_shifts_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                                  CpsError *err) {
    if (stage->shift_count < 0 || (stage->shift_count > 0 && !stage->shift))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: found %d shifts, expected 0 or more", what,
                         stage->shift_count);
    for (int i = 0; i < stage->shift_count; i++) {
        const CpsShift *shift = &stage->shift[i];
        if (shift->obstacle < 0 || shift->obstacle >= scene->obstacle_count)
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: shift %d names obstacle %d: there are %d",
                             what, i + 1, shift->obstacle, scene->obstacle_count);
        const CpsObstacle *obstacle = &scene->obstacle[shift->obstacle];
        char place[80];
        snprintf(place, sizeof place, "%s.obstacle", obstacle->name);
        if (!obstacle->moves)
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: obstacle '%s' is shifted, but stays in its place: say that it "
                                "moves",
                                what, obstacle->name);
        const CpsStatus status = check_shift(obstacle, shift, place, what, err);
        if (status != CPS_OK) return status;
        for (int k = 0; k < i; k++)
            if (stage->shift[k].obstacle == shift->obstacle)
                return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                    "%s: obstacle '%s' is shifted twice", what, obstacle->name);
    }
    return CPS_OK;
}

/* [m] How deep what goes straight from one place to another gets below an obstacle that turns
 * meanwhile, at places close to each other. */
static double depth_on_the_way(const CpsiObstacle *obstacle, const CpsiShift *shift, Vec3 from,
                               Vec3 to) {
    const double angle = vec3_norm(shift->turn);
    const int count = 1 + (int)fmin(MOST_PLACES, angle / PATH_ANGLE);
    const double sine = sin(0.25 * angle / count), versine = 2 * sine * sine;
    double depth = -INFINITY;
    Vec3 last = from;
    for (int i = 1; i <= count; i++) {
        const double share = (double)i / count;
        const CpsiShift back = cpsi_shift_part(shift, share, 0);
        const Vec3 here = vec3_axpy(share, vec3_sub(to, from), from),
                   seen = cpsi_shift_carry(&back, here);
        /* between these places the way is an arc */
        const double arc = versine * vec3_norm(vec3_sub(last, shift->about));
        depth = fmax(depth, cpsi_obstacle_depth(obstacle, last, seen) - arc);
        last = seen;
    }
    return depth;
}

/* What is held goes from one place to another, relative to the origin. */
typedef struct Held {
    const CpsiLine *line;
    int node;
    Vec3 from, to;
} Held;

static CpsStatus check_held(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                            const Held *held, const char *what, CpsError *err) {
    const Vec3 from = held->from, to = held->to;
    for (int k = 0; k < evolution->obstacle_count; k++) {
        const CpsiObstacle *obstacle = &evolution->obstacle[k];
        if (!obstacle->moves || obstacle->stiffness > 0) continue;
        CpsiShift shift = {.by = vec3(0, 0, 0)};
        for (int i = 0; i < stage->shift_count; i++)
            if (stage->shift[i].obstacle == k)
                shift = (CpsiShift){vec3_load(stage->shift[i].by), vec3_load(stage->shift[i].turn),
                                    vec3_load(stage->shift[i].about)};
        /* as seen from the obstacle */
        const double depth = cpsi_vec3_is_zero(shift.turn)
                                 ? cpsi_obstacle_depth(obstacle, from, vec3_sub(to, shift.by))
                                 : depth_on_the_way(obstacle, &shift, from, to),
                     before = -cpsi_obstacle_gap(obstacle, from);
        if (!(depth > fmax(PATH_TOUCH * held->line->length, before))) continue;
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: node %d of line '%s' is held in the way of obstacle '%s', up to %g m "
                         "deep: move one of them round the other",
                         what, held->node, held->line->name, evolution->given_obstacle[k].name,
                         depth);
    }
    return CPS_OK;
}

/* Is an end held, and where to? What is on a body or at a free point goes where the step finds it.
 */
static bool end_is_held(const CpsEvolution *evolution, const CpsiEvolutionStage *stage, int i,
                        int end, Held *held) {
    const CpsiPoints *points = &evolution->points;
    const int at = points->tie[2 * i + end];
    bool is_held = held->line->end[end].kind == CPS_END_KIND_HELD;
    for (int k = 0; k < stage->change_count; k++) {
        const CpsChange *change = &stage->change[k];
        if (change->line != i || change->end != end) continue;
        is_held = change->to.kind == CPS_END_KIND_HELD;
        if (is_held) held->to = vec3_load(change->to.value);
    }
    if (at == CPSI_NO_POINT) return is_held;
    is_held = points->point[at].kind == CPS_POINT_KIND_HELD;
    for (int k = 0; k < stage->point_change_count; k++) {
        const CpsPointChange *change = &stage->point_change[k];
        if (change->point != at) continue;
        is_held = change->kind == CPS_POINT_KIND_HELD;
        if (is_held) held->to = vec3_load(change->value);
    }
    return is_held;
}

/* The same of node j between the ends. */
static bool node_is_held(const CpsiEvolutionStage *stage, int i, int j, Held *held) {
    bool is_held = held->line->grasp_count > 0 && cpsi_line_grasp_holds(held->line, j);
    for (int k = 0; k < stage->grasp_change_count; k++) {
        const CpsGraspChange *change = &stage->grasp_change[k];
        if (change->line != i || change->node != j) continue;
        is_held = change->kind == CPS_END_KIND_HELD;
        if (is_held && !change->stays) held->to = vec3_load(change->value);
    }
    return is_held;
}

CpsStatus cpsi_shifts_check(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                            const char *what, CpsError *err) {
    bool any = false;
    for (int k = 0; k < evolution->obstacle_count; k++) any = any || evolution->obstacle[k].moves;
    if (!any) return CPS_OK;
    for (int i = 0; i < evolution->line_count; i++) {
        const CpsiLine *line = &evolution->line[i];
        for (int j = 0; j < line->n; j++) {
            const Vec3 from = vec3_at(line->position, j);
            Held held = {line, j, from, from};
            const bool is_end = j == 0 || j == line->n - 1,
                       is_held = is_end ? end_is_held(evolution, stage, i,
                                                      j == 0 ? CPS_END_A : CPS_END_B, &held)
                                        : node_is_held(stage, i, j, &held);
            const CpsStatus status =
                is_held ? check_held(evolution, stage, &held, what, err) : CPS_OK;
            if (status != CPS_OK) return status;
        }
    }
    return CPS_OK;
}
