/* SPDX-License-Identifier: BSD-3-Clause */
/* Trials (trial.h). */
#include "evolve/trial.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "cable/end_set.h"
#include "cable/field.h"
#include "cable/soft.h"
#include "evolve/anchors.h"
#include "evolve/bodies.h"
#include "evolve/body_motion.h"
#include "evolve/checkpoint.h"
#include "evolve/joint_system.h"
#include "evolve/moving_ground.h"
#include "evolve/point_motion.h"
#include "evolve/points.h"
#include "evolve/soft_point.h"

/* What is left counts as balanced up to so many tolerances of the largest force. */
static const double BALANCED = 100;
/* A strain is known to so many roundings of the coordinates of its nodes: where all forces vanish
 * that alone is left. */
static const double ROUNDINGS = 16;
/* Of a buoyancy at an obstacle, to the last digits. */
enum { BISECTIONS = 60 };

/* Arrays of the points and of the inner nodes of all lines. */
static void place_rounds(const CpsEvolution *evolution, CpsiArena *arena, CpsiPointRounds *rounds) {
    int count = evolution->points.count;
    for (int i = 0; i < evolution->line_count; i++) count += evolution->line[i].n - 2;
    CPSI_PLACE(arena, rounds->place, 3 * (size_t)count);
    CPSI_PLACE(arena, rounds->weight, count);
    cpsi_anderson_layout(&rounds->anderson, arena, count);
}

CpsiBalance *cpsi_balance_create(const CpsEvolution *evolution) {
    const size_t points = (size_t)evolution->points.count, lines = (size_t)evolution->line_count,
                 bodies = (size_t)evolution->bodies.count, unknowns = 3 * points + 6 * bodies,
                 together = 6 * (bodies < CPSI_TOGETHER ? bodies : CPSI_TOGETHER);
    CpsiGraphMatrix *matrix =
        cpsi_joint_system(&evolution->points, &evolution->bodies, evolution->line_count);
    if (!matrix) return NULL;
    const CpsiNetworkTools tools = {matrix, evolution->workers, evolution->workspace_count};
    CpsiBalance *balance = NULL, measured = {0};
    CpsiArena arena = {0};
    for (int pass = 0; pass < 2; pass++) {
        CpsiBalance *placed = cpsi_arena_take(&arena, 1, sizeof *placed),
                    *to = placed ? placed : &measured;
        CPSI_PLACE(&arena, to->at, points);
        CPSI_PLACE(&arena, to->from, points);
        CPSI_PLACE(&arena, to->best, points);
        CPSI_PLACE(&arena, to->number, points);
        CPSI_PLACE(&arena, to->chose, points);
        CPSI_PLACE(&arena, to->rigid, bodies);
        CPSI_PLACE(&arena, to->rigid_from, bodies);
        CPSI_PLACE(&arena, to->rigid_best, bodies);
        CPSI_PLACE(&arena, to->rigid_now, bodies);
        CPSI_PLACE(&arena, to->rigid_of, points);
        CPSI_PLACE(&arena, to->line, lines);
        CPSI_PLACE(&arena, to->iterations, lines);
        CPSI_PLACE(&arena, to->offset, lines + 1);
        CPSI_PLACE(&arena, to->tangent, 36 * lines);
        CPSI_PLACE(&arena, to->smooth, 36 * lines);
        CPSI_PLACE(&arena, to->rows, points);
        CPSI_PLACE(&arena, to->joined, points);
        CPSI_PLACE(&arena, to->kept, 6 * bodies);
        CPSI_PLACE(&arena, to->turned, 3 * bodies);
        CPSI_PLACE(&arena, to->coupling, together * together);
        CPSI_PLACE(&arena, to->together, together * together);
        CPSI_PLACE(&arena, to->node, points + 2 * bodies);
        CPSI_PLACE(&arena, to->right, unknowns);
        CPSI_PLACE(&arena, to->step, unknowns);
        CPSI_PLACE(&arena, to->ends, lines);
        CPSI_PLACE(&arena, to->joint, points);
        CPSI_PLACE(&arena, to->joint_of, points);
        CPSI_PLACE(&arena, to->held, bodies);
        CPSI_PLACE(&arena, to->guess.joint, 3 * points);
        CPSI_PLACE(&arena, to->guess.state, points);
        CPSI_PLACE(&arena, to->guess.body, 6 * bodies);
        CPSI_PLACE(&arena, to->guess.pull, 6 * lines);
        cpsi_network_place(&to->network, &arena, evolution->line, (int)lines, (int)points,
                           (int)bodies, evolution->workspace[0].program.ops, &tools);
        if (lines > 0 && evolution->line[0].has_local_axes)
            place_rounds(evolution, &arena, &to->rounds);
        size_t all = 0;
        for (size_t i = 0; i < lines; i++) {
            if (placed) to->offset[i] = all;
            all += cpsi_line_state_size(&evolution->line[i]);
        }
        CPSI_PLACE(&arena, to->state, all);
        balance = placed;
        if (pass == 0 && !cpsi_arena_allocate(&arena)) {
            cpsi_graph_matrix_free(matrix);
            return NULL;
        }
    }
    balance->arena = arena;
    balance->matrix = matrix;
    return balance;
}

void cpsi_balance_free(CpsiBalance *balance) {
    if (!balance) return;
    cpsi_graph_matrix_free(balance->matrix);
    CpsiArena arena = balance->arena;
    cpsi_arena_free(&arena);
}

/* trials --------------------------------------------------------------------------------------- */

static void step_one(void *data, int worker, int item) {
    CpsiBalance *balance = data;
    balance->task(balance->evolution, worker, balance->line[item]);
}

static bool places_by_statics(const CpsEvolution *evolution, int line) {
    return evolution->has_static && evolution->done == 0 && evolution->is_static[line];
}

/* The place of a point in the trial; false where it is neither free nor on a free body. */
bool cpsi_trial_place(const CpsiBalance *balance, int point, Vec3 *place) {
    if (point == CPSI_NO_POINT) return false;
    const int k = balance->number[point], body = balance->rigid_of[point];
    if (k >= 0) *place = balance->at[k].place;
    if (body >= 0)
        *place = cpsi_pose_place(&balance->rigid[body].pose,
                                 balance->evolution->points.given[point].position);
    return k >= 0 || body >= 0;
}

/* Let the lines end where the free points and bodies are. */
static void impose(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    for (int item = 0; item < balance->line_count; item++) {
        const int i = balance->line[item];
        for (int end = 0; end < 2; end++) {
            const int point = evolution->points.tie[2 * i + end];
            Vec3 place;
            if (!cpsi_trial_place(balance, point, &place)) continue;
            double *to = evolution->move[i].to[end].value;
            vec3_store(to, place);
            if (places_by_statics(evolution, i))
                memcpy(evolution->line[i].end[end].value, to, 3 * sizeof *to);
        }
    }
}

int cpsi_trial_nearest(const CpsEvolution *evolution, Vec3 place, bool rigid, double *gap,
                       Vec3 *normal) {
    int nearest = CPS_NO_OBSTACLE;
    *gap = INFINITY;
    for (int k = 0; k < evolution->obstacle_count; k++) {
        const CpsiObstacle *on = &evolution->obstacle[k];
        if (rigid && on->stiffness > 0) continue;
        const double to = cpsi_obstacle_gap(on, place);
        if (!(to < *gap)) continue;
        *gap = to;
        nearest = k;
    }
    if (nearest != CPS_NO_OBSTACLE)
        *normal = cpsi_obstacle_normal(&evolution->obstacle[nearest], place);
    return nearest;
}

/* Slip in what gives, and where the point would be in it without: slip is that along the surface
 * through the place, as at nodes. */
static void find_slip_within(const CpsiObstacle *on, Vec3 before, CpsiFree *at) {
    const CpsiObstacle level = cpsi_obstacle_within(on, cpsi_soft_way_depth(on, at->place));
    at->slip = cpsi_obstacle_slip(&level, before, at->place);
    at->start = vec3_axpy(fmin(at->gap, 0), cpsi_obstacle_normal(on, at->start), at->start);
}

/* The nearest obstacle, and where the point was on it when the step began. */
void cpsi_trial_find_obstacle(const CpsEvolution *evolution, CpsiFree *at) {
    const CpsiPoint *point = &evolution->points.point[at->point];
    at->obstacle = CPS_NO_OBSTACLE;
    at->gap = INFINITY;
    at->gives = false;
    at->drags = cpsi_point_drags(&evolution->points, at->point);
    if (at->drags) {
        at->start = vec3_load(point->position);
        at->normal = cpsi_anchor_normal(evolution, at->point);
        at->slip = vec3_reject(vec3_sub(at->place, at->start), at->normal);
        at->bound = evolution->points.given[at->point].holding_capacity;
        return;
    }
    at->in_set.on = cpsi_set_of_point(&evolution->points, at->point);
    if (at->in_set.on) return;
    at->obstacle = cpsi_trial_nearest(evolution, at->place, false, &at->gap, &at->normal);
    if (at->obstacle == CPS_NO_OBSTACLE) return;
    const CpsiObstacle *on = &evolution->obstacle[at->obstacle];
    at->friction = evolution->has_static && evolution->done == 0
                       ? 0
                       : on->friction[0] * cpsi_obstacle_friction_factor(on, at->place);
    const Vec3 before = cpsi_ground_carry(evolution, point, at->obstacle);
    at->slip = cpsi_obstacle_slip(on, before, at->place);
    at->start = vec3_axpy(-cpsi_obstacle_gap(on, before), cpsi_obstacle_normal(on, before), before);
    /* on what is round the way to where it was is rounding, which friction counts as sliding until
     * the stiffness is known */
    if (cpsi_vec3_is_zero(vec3_sub(at->place, at->start))) at->slip = vec3(0, 0, 0);
    at->gives = on->stiffness > 0;
    if (!at->gives) return;
    const CpsiSoft soft = cpsi_soft_point_spring(evolution, at->point, at->obstacle, before);
    at->spring = soft.stiffness;
    at->over = at->gap + soft.rest;
    find_slip_within(on, before, at);
}

/* [m] A point that is no farther from an obstacle, or has slid no farther, touches it, or is at
 * rest. */
double cpsi_trial_touch(const CpsiBalance *balance, const CpsiFree *at) {
    return CPS_TOUCH * balance->evolution->points.point[at->point].length;
}

/* rho s - F with the friction F that would balance: within the bound the point is to stick. */
Vec3 cpsi_trial_friction_test(const CpsiFree *at) {
    return vec3_axpy(at->stiffness, at->slip, vec3_reject(at->rest, at->normal));
}

bool cpsi_is_to_stick(const CpsiFree *at) {
    return at->bound > 0 && vec3_norm(cpsi_trial_friction_test(at)) <= at->bound;
}

/* The friction is the force within its bound that is nearest to F - rho s, F what would balance: at
 * a solution it is F and opposite to the slip, elsewhere what is left is continuous in the place.
 * Until the stiffness rho is known, what has slid by CPS_TOUCH slides. */
static void find_friction(CpsiFree *at, double touch) {
    if (!(at->stiffness > 0)) at->stiffness = at->bound / touch;
    const Vec3 test = cpsi_trial_friction_test(at);
    const double size = vec3_norm(test);
    /* the size of a vector of 1e-300 is 0 */
    at->force =
        at->bound > 0 ? vec3_scale(size > at->bound ? -at->bound / size : -1, test) : vec3(0, 0, 0);
}

/* What holds an anchor that drags, and what of that nothing balances: nothing across its plane. */
static void find_hold(const CpsiBalance *balance, CpsiFree *at) {
    at->reaction = 0;
    find_friction(at, cpsi_trial_touch(balance, at));
    at->left = vec3_add(vec3_reject(at->rest, at->normal), at->force);
}

/* What the set of a point does to it. A stiffness below that of a force over a length would ask far
 * from the set. */
static void find_reaction_of_set(const CpsiBalance *balance, CpsiFree *at) {
    const double force = fmax(vec3_norm(at->rest), balance->force);
    const double length = balance->evolution->points.point[at->point].length;
    CpsiInSet *in = &at->in_set;
    in->place = at->place;
    in->rest = at->rest;
    in->yields = fmax(at->stiffness, (force > 0 ? force : 1) / length);
    at->left = cpsi_in_set_hold(in);
}

/* What the obstacle does to the point, and what nothing balances. The friction bound follows the
 * reaction, or is that of the reference, and then acts off the obstacle as well (S90 (35)). */
static void find_touch(const CpsiBalance *balance, CpsiFree *at) {
    if (at->drags) {
        find_hold(balance, at);
        return;
    }
    const CpsiPoint *point = &balance->evolution->points.point[at->point];
    const double touch = cpsi_trial_touch(balance, at);
    if (at->in_set.on) {
        find_reaction_of_set(balance, at);
        return;
    }
    at->reaction = at->bound = 0;
    at->force = vec3(0, 0, 0);
    at->left = at->rest;
    if (at->obstacle == CPS_NO_OBSTACLE) return;
    if (at->gives)
        at->reaction = at->spring * fmax(0, -at->over);
    else if (at->gap <= touch)
        at->reaction = fmax(0, -vec3_dot(at->rest, at->normal));
    at->bound = at->friction * (balance->follows ? at->reaction : point->reaction_before);
    find_friction(at, touch);
    at->left = vec3_add(vec3_axpy(at->reaction, at->normal, at->rest), at->force);
}

/* ... with another buoyancy. */
static void find_touch_with(const CpsiBalance *balance, CpsiFree *at, double buoyancy) {
    at->rest = cpsi_rest_with(at, buoyancy);
    at->water.buoyancy = buoyancy;
    find_touch(balance, at);
}

/* ... and what the water does: at the surface the buoyancy that leaves nothing upright. What is
 * left upright rises with it, also where the point lies on an obstacle. */
static void find_contact(const CpsiBalance *balance, CpsiFree *at) {
    if (!(at->water.displaced > 0)) {
        find_touch(balance, at);
        return;
    }
    double range[2], stiffness = at->stiffness;
    cpsi_water_range(&at->water, cpsi_trial_touch(balance, at), range);
    const Vec3 n = at->water.n;
    const double holds = -vec3_dot(at->rest, n) / vec3_dot(n, n);
    find_touch_with(balance, at, fmin(fmax(holds, range[0]), range[1]));
    if (range[0] == range[1] || (at->reaction == 0 && at->bound == 0)) return;
    for (int i = 0; i < BISECTIONS; i++) {
        at->stiffness = stiffness;
        find_touch_with(balance, at, 0.5 * (range[0] + range[1]));
        range[vec3_dot(at->left, n) < 0 ? 0 : 1] = at->water.buoyancy;
    }
}

/* From the reference point of a free body to a point on it, in the axes of the scene. */
Vec3 cpsi_trial_arm(const CpsiBalance *balance, const CpsiRigid *rigid, int point) {
    return cpsi_pose_arm(&rigid->pose, balance->evolution->points.given[point].position);
}

static void add_pull(const CpsiBalance *balance, CpsiRigid *rigid, int point, Vec3 pull) {
    const Vec3 arm = cpsi_trial_arm(balance, rigid, point);
    rigid->lines.force = vec3_add(rigid->lines.force, pull);
    rigid->lines.moment = vec3_add(rigid->lines.moment, vec3_cross(arm, pull));
}

/* Count a force that is given, or that is stored in something elastic. */
static void count_force(CpsiBalance *balance, double force) {
    balance->force = cpsi_max_nan(balance->force, force);
    balance->acting = cpsi_max_nan(balance->acting, force);
}

/* [N] What acts on a line: its weight, and what pulls at free ends and grasped nodes. */
static double acting_on(const CpsiLine *line) {
    double sum = 0;
    for (int j = 0; j < line->n; j++)
        sum += vec3_norm(vec3_at(line->load, j)) +
               vec3_norm(cpsi_line_field_force(line, j, vec3_at(line->position, j)));
    return sum;
}

/* Count the forces of a line. An inextensible line takes any tension, and pulled straight by a load
 * across it one that no load is near to; what it brings to the balance are the loads on it. */
static void count_line(CpsiBalance *balance, const CpsiLine *line) {
    balance->force = cpsi_max_nan(balance->force, line->report.certificate.largest_force);
    balance->acting =
        cpsi_max_nan(balance->acting, line->compliance > 0 ? line->report.certificate.largest_force
                                                           : acting_on(line));
    if (!(line->compliance > 0)) return;
    const double far = fmax(vec3_norm(vec3_at(line->position, 0)),
                            vec3_norm(vec3_at(line->position, line->n - 1)));
    const double strain = ROUNDINGS * DBL_EPSILON * (1 + far / line->element_length[0]);
    balance->rounding = cpsi_max_nan(balance->rounding, strain / cpsi_line_least_compliance(line));
}

/* Count what moves a mass, where `inertia` [N] acts on it at a place, by mass/k^2 `stiffness`; its
 * rounding is that of the place, up to `far` from the origin. */
static void count_inertia(CpsiBalance *balance, double inertia, double stiffness, double far) {
    count_force(balance, inertia);
    balance->rounding = cpsi_max_nan(balance->rounding, ROUNDINGS * DBL_EPSILON * stiffness * far);
}

/* Add the inertia of a free point, in a step in time. */
static void add_point_inertia(CpsiBalance *balance, CpsiFree *at) {
    const CpsiPoint *point = &balance->evolution->points.point[at->point];
    const Vec3 inertia = cpsi_point_inertia(point, at->place);
    at->rest = vec3_add(at->rest, inertia);
    if (point->inertia.mass > 0)
        count_inertia(balance, vec3_norm(inertia), cpsi_point_inertia_stiffness(point),
                      vec3_norm(at->place));
}

/* ... and of a free body, with its damping. */
static void add_body_motion(CpsiBalance *balance, CpsiRigid *rigid) {
    const CpsiBody *body = &balance->evolution->bodies.body[rigid->body];
    const double span = body->inertia.span, mass = body->given.mass + body->given.added_mass[0];
    rigid->inertia = cpsi_body_inertia(body, &rigid->pose);
    rigid->damping = cpsi_body_damping(body, &rigid->pose);
    rigid->rest.force =
        vec3_add(rigid->rest.force, vec3_add(rigid->inertia.force, rigid->damping.force));
    rigid->rest.moment =
        vec3_add(rigid->rest.moment, vec3_add(rigid->inertia.moment, rigid->damping.moment));
    const double spin =
        fmax(body->given.inertia[0], fmax(body->given.inertia[1], body->given.inertia[2])) +
        body->given.added_mass[21] + body->given.added_mass[28] + body->given.added_mass[35];
    count_inertia(balance, vec3_norm(rigid->inertia.force), mass / (span * span),
                  vec3_norm(rigid->pose.place) + vec3_norm(body->inertia.now.centre));
    count_inertia(balance, vec3_norm(rigid->inertia.moment) / body->arm,
                  spin / (span * span * body->arm), 1);
}

/* Weight and buoyancy may cancel, to so many roundings of each. */
static void count_rounding(CpsiBalance *balance, const CpsiBody *body) {
    const double pull = vec3_norm(vec3_load(balance->evolution->gravity)),
                 low = vec3_norm(vec3_load(body->given.centre_of_gravity)),
                 high = vec3_norm(vec3_load(body->given.centre_of_buoyancy)),
                 size =
                     body->mass * fmax(1, low / body->arm) + body->lift * fmax(1, high / body->arm);
    balance->rounding = cpsi_max_nan(balance->rounding, ROUNDINGS * DBL_EPSILON * pull * size);
}

/* What nothing balances on a free body: nothing in its fixed directions. */
static void find_rest(CpsiBalance *balance, CpsiRigid *rigid) {
    const CpsiBody *body = &balance->evolution->bodies.body[rigid->body];
    const CpsiWrench load = cpsi_body_whole_load(balance->evolution, body, &rigid->pose);
    rigid->rest = (CpsiWrench){vec3_add(rigid->lines.force, load.force),
                               vec3_add(rigid->lines.moment, load.moment)};
    rigid->inertia = rigid->damping = (CpsiWrench){vec3(0, 0, 0), vec3(0, 0, 0)};
    if (balance->evolution->interval > 0) add_body_motion(balance, rigid);
    double left[6];
    vec3_store(left, rigid->rest.force);
    vec3_store(&left[3], rigid->rest.moment);
    for (int i = 0; i < 6; i++)
        if (body->given.fixed[i]) left[i] = 0;
    rigid->left = (CpsiWrench){vec3_load(left), vec3_load(&left[3])};
    count_rounding(balance, body);
    count_force(balance, vec3_norm(body->load.force) + vec3_norm(body->waves.force));
    count_force(balance,
                (vec3_norm(body->load.moment) + vec3_norm(body->waves.moment)) / body->arm);
    balance->acting = cpsi_max_nan(balance->acting, vec3_norm(load.force));
    balance->acting = cpsi_max_nan(balance->acting, vec3_norm(load.moment) / body->arm);
}

CpsiStepOptions cpsi_trial_options(const CpsEvolution *evolution) {
    CpsiStepOptions options = evolution->options;
    if (evolution->has_static && evolution->done == 0) {
        options.frictionless = true;
        options.contact_policy = CPS_CONTACT_POLICY_REACHED;
    }
    return options;
}

/* Is the group without points that may float and anchors that drag, whose forces are bounded? */
bool cpsi_is_without_bounds(const CpsiBalance *balance) {
    const CpsiPoints *points = &balance->evolution->points;
    for (int k = 0; k < balance->count; k++) {
        const int point = balance->at[k].point;
        if (cpsi_point_drags(points, point) ||
            (points->has_surface && points->point[point].displaced_mass > 0))
            return false;
    }
    return true;
}

void cpsi_begin_again(CpsiBalance *balance) {
    const CpsEvolution *evolution = balance->evolution;
    for (int k = 0; k < balance->count; k++) {
        const int point = balance->at[k].point;
        balance->at[k] = (CpsiFree){.point = point,
                                    .place = vec3_load(cpsi_point_drags(&evolution->points, point)
                                                           ? evolution->points.point[point].position
                                                           : evolution->points.point[point].before),
                                    .obstacle = CPS_NO_OBSTACLE};
    }
    for (int k = 0; k < balance->body_count; k++)
        balance->rigid[k].pose = evolution->bodies.body[balance->rigid[k].body].pose;
}

void cpsi_trial_restore_line(CpsiBalance *balance, int line) {
    cpsi_line_restore(&balance->evolution->line[line], &balance->state[balance->offset[line]]);
}

void cpsi_trial_restore_lines(CpsiBalance *balance) {
    for (int item = 0; item < balance->line_count; item++)
        cpsi_trial_restore_line(balance, balance->line[item]);
}

void cpsi_step_lines(CpsiBalance *balance) {
    cpsi_workers_run(balance->evolution->workers, step_one, balance, balance->line_count);
}

/* [N] The tension of the element at an end of a line. */
static double end_tension(const CpsiLine *line, int end) {
    const int node = cpsi_line_end_node(line, end);
    return vec3_norm(vec3_at(line->segment_force, end == CPS_END_A ? node : node - 1));
}

void cpsi_read_forces(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    balance->force = balance->acting = balance->rounding = 0;
    balance->certified = true;
    for (int k = 0; k < balance->count; k++) {
        CpsiFree *at = &balance->at[k];
        double load[3];
        at->rest = vec3(0, 0, 0);
        at->tension = 0;
        if (cpsi_point_drags(&evolution->points, at->point)) {
            balance->acting =
                fmax(balance->acting, evolution->points.given[at->point].holding_capacity);
            continue;
        }
        cpsi_point_load(&evolution->points.point[at->point], evolution->gravity, load);
        at->rest = vec3_load(load);
        at->water =
            cpsi_water_at(&evolution->points.point[at->point], evolution->gravity, at->place);
        count_force(balance, vec3_norm(at->rest));
        balance->acting = fmax(balance->acting, at->water.displaced);
        if (evolution->interval > 0) add_point_inertia(balance, at);
    }
    for (int k = 0; k < balance->body_count; k++)
        balance->rigid[k].lines = (CpsiWrench){vec3(0, 0, 0), vec3(0, 0, 0)};
    for (int item = 0; item < balance->line_count; item++) {
        const int i = balance->line[item];
        const CpsLineReport *report = &evolution->line[i].report;
        balance->certified = balance->certified && cps_outcome_is_certified(report->outcome);
        count_line(balance, &evolution->line[i]);
        for (int end = 0; end < 2; end++) {
            const int point = evolution->points.tie[2 * i + end];
            const Vec3 pull = vec3_scale(-1, vec3_load(report->end[end].force));
            if (point == CPSI_NO_POINT) continue;
            if (balance->number[point] >= 0) {
                CpsiFree *at = &balance->at[balance->number[point]];
                at->rest = vec3_add(at->rest, pull);
                at->tension += end_tension(&evolution->line[i], end);
            }
            if (balance->rigid_of[point] >= 0)
                add_pull(balance, &balance->rigid[balance->rigid_of[point]], point, pull);
        }
    }
    for (int k = 0; k < balance->count; k++) {
        cpsi_trial_find_obstacle(evolution, &balance->at[k]);
        find_contact(balance, &balance->at[k]);
    }
    for (int k = 0; k < balance->body_count; k++) find_rest(balance, &balance->rigid[k]);
}

/* Solve the lines for the places of the points. */
void cpsi_try_places(CpsiBalance *balance) {
    CpsEvolution *evolution = balance->evolution;
    if (balance->trials > 0)
        for (int item = 0; item < balance->line_count; item++) {
            const int i = balance->line[item];
            balance->iterations[i] += evolution->line[i].report.iteration_count;
            cpsi_trial_restore_line(balance, i);
        }
    for (int k = 0; k < balance->count; k++) {
        const CpsiEndSet *on = cpsi_set_of_point(&evolution->points, balance->at[k].point);
        if (on) balance->at[k].place = cpsi_end_set_project(on, balance->at[k].place);
    }
    impose(balance);
    cpsi_step_lines(balance);
    balance->trials++;
    cpsi_read_forces(balance);
    if (!balance->certified) balance->open_trials++;
}

/* [N] The largest force that nothing balances, moments over the arm of their body. */
double cpsi_largest_left(const CpsiBalance *balance, const CpsiFree *at, const CpsiRigid *rigid) {
    double most = 0;
    for (int k = 0; k < balance->count; k++) most = cpsi_max_nan(most, vec3_norm(at[k].left));
    for (int k = 0; k < balance->body_count; k++) {
        const double arm = balance->evolution->bodies.body[rigid[k].body].arm;
        most = cpsi_max_nan(most, vec3_norm(rigid[k].left.force));
        most = cpsi_max_nan(most, vec3_norm(rigid[k].left.moment) / arm);
    }
    return most;
}

double cpsi_left_now(const CpsiBalance *balance) {
    return cpsi_largest_left(balance, balance->at, balance->rigid);
}

/* Is what is left within the tolerance of what acts? A force that is left changes the tensions of
 * the lines by no more than itself, which is far below the bound of their error that certificates
 * at this tolerance give: these are of second order. */
bool cpsi_is_balanced(const CpsiBalance *balance, double left) {
    return left <= BALANCED * balance->evolution->options.solver.tolerance *
                           fmin(balance->force, balance->acting) +
                       balance->rounding;
}

bool cpsi_obeys_friction(const CpsiBalance *balance, const CpsiFree *at) {
    const double slip = vec3_norm(at->slip), touch = cpsi_trial_touch(balance, at);
    if ((at->obstacle == CPS_NO_OBSTACLE && !at->drags) || slip <= touch) return true;
    const Vec3 lacks = vec3_axpy(at->bound / slip, at->slip, at->force);
    return cpsi_is_balanced(balance, at->bound + vec3_dot(at->force, at->slip) / slip) &&
           cpsi_is_balanced(balance, vec3_norm(lacks) - at->bound * touch / slip);
}

bool cpsi_is_kept_in_set(const CpsiBalance *balance, const CpsiFree *at) {
    const CpsEvolution *evolution = balance->evolution;
    const CpsiEndSet *on = at->in_set.on;
    const double touch = cpsi_trial_touch(balance, at);
    if (!on) return true;
    for (int k = 0; k < evolution->obstacle_count; k++)
        if (!(cpsi_obstacle_gap(&evolution->obstacle[k], at->place) >= -touch)) return false;
    return vec3_norm(vec3_sub(cpsi_end_set_project(on, at->place), at->place)) <= touch;
}

bool cpsi_is_answer(const CpsiBalance *balance) {
    for (int k = 0; k < balance->count; k++)
        if (!cpsi_obeys_friction(balance, &balance->at[k]) ||
            !cpsi_is_kept_in_set(balance, &balance->at[k]))
            return false;
    return balance->certified && cpsi_is_balanced(balance, cpsi_left_now(balance));
}

bool cpsi_has_inextensible(const CpsiBalance *balance) {
    for (int item = 0; item < balance->line_count; item++)
        if (balance->evolution->line[balance->line[item]].compliance == 0) return true;
    return false;
}

void cpsi_trial_use_blocks(CpsiBalance *balance) {
    int *node = balance->node;
    const int points = balance->evolution->points.count;
    for (int k = 0; k < balance->count; k++) node[k] = balance->at[k].point;
    for (int k = 0; k < balance->body_count; k++)
        for (int part = 0; part < 2; part++)
            node[balance->count + 2 * k + part] = points + 2 * balance->rigid[k].body + part;
    cpsi_graph_matrix_use(balance->matrix, balance->count + 2 * balance->body_count, node);
}
