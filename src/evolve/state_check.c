/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of a loaded state (see state_check.h).
 *
 * Everything that serves as an index, a count or a kind is compared with its range, and all numbers
 * that later steps start from are finite. Numbers that are only reported may be NaN or infinite, as
 * in reports. */
#include "evolve/state_check.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "evolve/grasps.h"
#include "evolve/winches.h"

/* Rounding of the axes of an obstacle. */
static const double ORTHONORMAL = 1e-9;

static bool all_finite(const double *x, size_t count) {
    if (x)
        for (size_t i = 0; i < count; i++)
            if (!isfinite(x[i])) return false;
    return true;
}

/* Where the history began. */
static bool is_start(const CpsiLine *line) {
    for (int i = 0; i < 3 * (line->n - 1); i++)
        if (!isfinite(line->start_element[i])) return false;
    return all_finite(line->start_end, 3);
}

static bool none_is_nan(const double *x, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (isnan(x[i])) return false;
    return true;
}

static bool within(int64_t value, int64_t least, int64_t greatest) {
    return least <= value && value <= greatest;
}

#define COUNT_ONE(name, number, key, sentence) +1
enum { OUTCOMES = CPS_OUTCOME_LIST(COUNT_ONE), RANGES = CPS_RANGE_LIST(COUNT_ONE) };

static bool is_outcome(CpsOutcome outcome) { return within(outcome, 0, OUTCOMES - 1); }
static bool is_end(const CpsEnd *end) {
    return (end->kind == CPS_END_KIND_HELD || end->kind == CPS_END_KIND_FREE) &&
           all_finite(end->value, 3);
}

/* Do `current`, `part` and `elapsed` agree with the number of steps taken? A stage with an error
 * has any number of them, at least one. */
static bool is_place_in_history(const CpsEvolution *evolution) {
    const int statics = evolution->has_static && evolution->done > 0;
    int64_t least = 0;
    bool any = false;
    if (!within(evolution->current, 0, evolution->stage_count)) return false;
    for (int k = 0; k < evolution->current; k++) {
        const CpsiEvolutionStage *stage = &evolution->stage[k];
        any = any || stage->error > 0;
        least += stage->error > 0 ? 1 : stage->steps;
    }
    const int64_t before = (int64_t)evolution->done - statics - evolution->part;
    if (!(any ? before >= least : before == least) || evolution->part < 0) return false;
    if (!(evolution->next >= 0 && isfinite(evolution->next))) return false;
    const CpsiEvolutionStage none = {.steps = 1}, *now = evolution->current < evolution->stage_count
                                                             ? &evolution->stage[evolution->current]
                                                             : &none;
    if (now->error > 0)
        return evolution->part == 0 ? evolution->elapsed == 0
                                    : evolution->elapsed > 0 && evolution->elapsed < now->duration;
    return evolution->part < now->steps && evolution->elapsed == 0;
}

static bool is_step_report(const CpsEvolution *evolution) {
    const CpsStepReport *report = &evolution->report;
    return evolution->move_count >= 0 && evolution->move_count <= INT_MAX - evolution->done &&
           evolution->break_count >= 0 &&
           evolution->break_count <= INT_MAX - evolution->done - evolution->move_count &&
           report->step_count == evolution->done + evolution->move_count + evolution->break_count &&
           is_outcome(report->outcome) &&
           within(report->places, CPS_PLACES_UNIQUE, CPS_PLACES_ANY) &&
           report->iteration_count >= 0 && report->substep_count >= 0 && report->warm_count >= 0 &&
           report->jump_count >= 0 &&
           memchr(evolution->step_name, '\0', sizeof evolution->step_name);
}

/* The ends that were let go, and the break that the step was. */
static bool are_releases(const CpsEvolution *evolution) {
    const CpsBreak *parted = &evolution->parted;
    for (int i = 0; i < 2 * evolution->line_count; i++)
        if (!within(evolution->release[i], CPS_RELEASE_NONE, CPS_RELEASE_TAKEN)) return false;
    return within(parted->line, 0, evolution->line_count - 1) && within(parted->end, 0, 1);
}

static bool is_obstacle(bool given, int index, int obstacles) {
    return within(index, 0, given ? obstacles - 1 : 0);
}

/* The obstacle index of a bend is used wherever the mesh is too coarse, else only where the line
 * turns. */
static bool is_line_report(const CpsLineReport *report, int obstacles) {
    const bool bends = report->bend.turn > 0 || report->outcome == CPS_OUTCOME_MESH_TOO_COARSE;
    bool sound = is_outcome(report->outcome) &&
                 (report->outcome != CPS_OUTCOME_PASSES || report->has_proof_obstacle) &&
                 within(report->places, CPS_PLACES_UNIQUE, CPS_PLACES_ANY) &&
                 report->iteration_count >= 0 && report->substep_count >= 0 &&
                 report->warm_count >= 0 && report->jump_count >= 0 &&
                 is_obstacle(report->has_pierced_obstacle, report->pierced_obstacle, obstacles) &&
                 is_obstacle(report->has_proof_obstacle, report->proof_obstacle, obstacles) &&
                 is_obstacle(report->has_proof_plane, report->proof_plane, obstacles) &&
                 within(report->bend.obstacle, 0, bends || obstacles > 0 ? obstacles - 1 : 0);
    for (int end = 0; end < 2; end++)
        sound = sound && within(report->end[end].range.kind, 0, RANGES - 1) &&
                all_finite(report->end[end].force, 3);
    return sound;
}

/* The state and the obstacle of each contact. */
static bool are_contacts(const CpsiLine *line) {
    const int contacts = cpsi_line_all_contacts(line);
    for (int c = 0; c < contacts; c++)
        if (line->state[c] > CPS_NODE_STATE_UNRESOLVED ||
            (line->obstacle_index &&
             !within(line->obstacle_index[c], -1, line->obstacle_count - 1)))
            return false;
    return true;
}

static bool is_load_change(const CpsiLoadChange *change) {
    bool sound = all_finite(change->weight, 3) && isfinite(change->turn) &&
                 within(change->grasp_count, 0, CPS_MAX_GRASPS);
    for (int k = 0; k < CPS_MAX_GRASPS; k++) sound = sound && all_finite(change->grasp[k].by, 3);
    for (int end = 0; end < 2; end++)
        sound =
            sound &&
            (change->kind[end] == CPS_END_KIND_HELD || change->kind[end] == CPS_END_KIND_FREE) &&
            all_finite(change->end[end], 3);
    return sound;
}

/* Rest strains of a line that has them. */
static bool are_rest_strains(const CpsiLine *line) {
    if (!line->two.exists) return true;
    for (int e = 0; e + 1 < line->n; e++)
        if (!(line->two.rest_strain[e] >= 0 && isfinite(line->two.rest_strain[e]))) return false;
    return true;
}

static bool are_fields(const CpsiLine *line) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    return all_finite(line->reference, 3 * n) && all_finite(line->position, 3 * n) &&
           is_start(line) && are_rest_strains(line) && all_finite(line->load, 3 * n) &&
           all_finite(line->motion, 3 * n) && is_load_change(&line->last_change) &&
           within(line->newton.failures, 0, CPSI_NEWTON_PATIENCE) &&
           within(line->newton.pause, 0, 1 << CPSI_NEWTON_PATIENCE) &&
           all_finite(line->weight, 3) && all_finite(line->weight_before, 3) &&
           all_finite(line->normal, 3 * contacts) &&
           all_finite(line->friction_force, 3 * contacts) && all_finite(line->slip, 3 * contacts) &&
           none_is_nan(line->gap, contacts) && all_finite(line->friction_bound, contacts) &&
           all_finite(line->reaction, contacts) && all_finite(line->segment_force, 3 * (n - 1)) &&
           all_finite(line->tension, n - 1) && all_finite(line->beta, n);
}

static bool is_motion(const CpsiLine *line) {
    const CpsiInertia *inertia = &line->inertia;
    const size_t n = (size_t)line->n;
    if (!line->has_inertia) return true;
    for (size_t j = 0; j < n; j++)
        if (inertia->is_moving && !(inertia->span[j] > 0)) return false;
    return all_finite(inertia->rest_velocity, 3 * n) && all_finite(inertia->start, 3 * n) &&
           all_finite(inertia->velocity, 3 * n) && all_finite(inertia->before, 3 * n) &&
           all_finite(inertia->before_velocity, 3 * n) && all_finite(inertia->span, n) &&
           isfinite(inertia->kinetic) && isfinite(line->field.size) && line->field.size >= 0;
}

static bool is_point_motion(const CpsiPointInertia *inertia) {
    return (!inertia->is_moving || inertia->span > 0) && isfinite(inertia->span) &&
           all_finite(inertia->reference, 3) && all_finite(inertia->rest_velocity, 3) &&
           all_finite(inertia->velocity, 3) && all_finite(inertia->before, 3) &&
           all_finite(inertia->before_velocity, 3) && isfinite(inertia->kinetic);
}

/* Its turns are rotations, or 0 before there is such a step. */
static bool is_body_motion(const CpsiBodyInertia *inertia) {
    const CpsiBodyPhase *all[] = {&inertia->now, &inertia->before, &inertia->rest};
    bool sound = (!inertia->is_moving || inertia->span > 0) && isfinite(inertia->span) &&
                 isfinite(inertia->kinetic);
    for (int i = 0; i < 3; i++) {
        const Vec3 vector[] = {all[i]->place,
                               all[i]->centre,
                               all[i]->velocity,
                               all[i]->rate,
                               all[i]->angular,
                               all[i]->centre_velocity,
                               all[i]->water,
                               all[i]->water_angular,
                               vec3(all[i]->turn.x, all[i]->turn.y, all[i]->turn.z),
                               vec3(all[i]->turn.w, 0, 0)};
        for (size_t k = 0; k < sizeof vector / sizeof *vector; k++)
            sound =
                sound && isfinite(vector[k].x) && isfinite(vector[k].y) && isfinite(vector[k].z);
    }
    return sound;
}

static bool is_surface(const CpsiSurface *surface) {
    const Vec3 at = surface->at, n = surface->n;
    return isfinite(at.x) && isfinite(at.y) && isfinite(at.z) && isfinite(n.x) && isfinite(n.y) &&
           isfinite(n.z) && n.z > 0;
}

static bool is_point(const CpsiPoint *point, int obstacles) {
    const CpsPointReport *report = &point->report;
    return within(point->kind, CPS_POINT_KIND_HELD, CPS_POINT_KIND_ON_BODY) &&
           within(report->state, CPS_POINT_STATE_HELD, CPS_POINT_STATE_ON_BODY) &&
           within(report->water, CPS_POINT_WATER_NONE, CPS_POINT_WATER_ABOVE) &&
           within(report->obstacle, CPS_NO_OBSTACLE, obstacles - 1) && report->trial_count >= 0 &&
           all_finite(point->position, 3) && all_finite(point->force, 3) &&
           all_finite(point->from, 3) && all_finite(point->before, 3) &&
           all_finite(point->move, 3) && all_finite(report->support, 3) &&
           all_finite(&report->reaction, 1) && all_finite(&report->buoyancy, 1) &&
           all_finite(&report->displaced, 1) && is_surface(&point->surface) &&
           all_finite(&report->capacity_used, 1) && all_finite(&report->uplift_used, 1) &&
           all_finite(report->drag, 3) && all_finite(&report->dragged, 1) &&
           all_finite(&point->dragged, 1) && is_point_motion(&point->inertia);
}

static bool is_body(const CpsiBody *body) {
    const double pose[] = {body->pose.place.x, body->pose.place.y, body->pose.place.z,
                           body->pose.turn.w,  body->pose.turn.x,  body->pose.turn.y,
                           body->pose.turn.z,  body->from.place.x, body->from.place.y,
                           body->from.place.z, body->from.turn.w,  body->from.turn.x,
                           body->from.turn.y,  body->from.turn.z};
    const Vec3 loads[] = {body->load.force, body->load.moment, body->load_from.force,
                          body->load_from.moment};
    bool sound = within(body->kind, CPS_BODY_KIND_HELD, CPS_BODY_KIND_FREE) &&
                 body->report.trial_count >= 0 && all_finite(body->report.support, 6) &&
                 all_finite(pose, sizeof pose / sizeof *pose) && is_body_motion(&body->inertia) &&
                 all_finite(body->radiation.past, 6 * (size_t)body->radiation.rows);
    for (int i = 0; i < 4; i++)
        sound = sound && isfinite(loads[i].x) && isfinite(loads[i].y) && isfinite(loads[i].z);
    return sound;
}

/* An obstacle at a place, its axes orthonormal but for rounding. */
static bool is_placed(const CpsEvolution *evolution, int k) {
    const CpsiObstacle *obstacle = &evolution->obstacle[k];
    const CpsiShift *shift = &evolution->shift[k];
    const Vec3 *axis = obstacle->frame.axis;
    const Vec3 all[] = {obstacle->frame.point, obstacle->grain, shift->by,
                        shift->turn,           shift->about,    vec3(evolution->angle[k], 0, 0)};
    bool sound = true;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        sound = sound && isfinite(all[i].x) && isfinite(all[i].y) && isfinite(all[i].z);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            sound = sound && fabs(vec3_dot(axis[i], axis[j]) - (i == j)) <= ORTHONORMAL;
    return sound;
}

const char *cpsi_state_fault(const CpsEvolution *evolution) {
    if (!is_place_in_history(evolution))
        return "it stands at a step that the history does not have";
    if (!is_step_report(evolution)) return "its report is none of a step";
    if (!are_releases(evolution)) return "an end is let go that there is not, or in no way";
    for (int i = 0; i < 2 * evolution->line_count; i++)
        if (!is_end(&evolution->from[i])) return "an end comes from nowhere";
    for (int k = 0; k < evolution->obstacle_count; k++)
        if (!is_placed(evolution, k)) return "an obstacle is at no place";
    if (!(evolution->time >= 0 && isfinite(evolution->time)) || !(evolution->interval >= 0))
        return "its time is none";
    if (!all_finite(evolution->gravity, 3) || !all_finite(evolution->gravity_from, 3))
        return "its gravity is not finite";
    for (int i = 0; i < evolution->line_count; i++) {
        const CpsiLine *line = &evolution->line[i];
        for (int end = 0; end < 2; end++)
            if (!is_end(&line->end[end])) return "an end is neither held nor free, or at no place";
        if (!cpsi_drums_are_sound(line, line->drums.stored))
            return "a drum has what the line is not long enough for";
        if (!cpsi_grasps_are_sound(line)) return "a node is grasped that cannot be, or at no place";
        if (!is_line_report(&line->report, evolution->obstacle_count))
            return "the report of a line is none";
        if (!are_contacts(line))
            return "a contact is with an obstacle that there is not, or in no state";
        if (!are_fields(line) || !is_motion(line)) return "a number is not finite";
    }
    for (int i = 0; i < evolution->points.count; i++)
        if (!is_point(&evolution->points.point[i], evolution->obstacle_count))
            return "a point is of no kind, in no state or at no place";
    for (int i = 0; i < evolution->bodies.count; i++)
        if (!is_body(&evolution->bodies.body[i])) return "a body is of no kind or in no pose";
    return NULL;
}
