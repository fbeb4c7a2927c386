/* SPDX-License-Identifier: BSD-3-Clause */
/* Histories that are decided as they go.     usage: random_live [--seeds N] [--seed S] [--in-time
 * 1] [--most-open N]
 *
 * Random scenes with a rope on a bed, a mooring that meets at a free point, a body and a round
 * obstacle; random calls: ends, points, bodies and nodes are moved, loaded, grasped and let go,
 * obstacles move and turn, gravity changes, several at a time. Calls are taken back, refused, or
 * lead nowhere; states are saved and given to fresh evolutions. What was kept is then gone again,
 * by moves of a fresh evolution and as the history of a scene: the same bits. The results of that
 * history are judged by the independent checker: nothing certified is refuted. Moves after the
 * first allocate nothing.
 *
 * In time either the rope or the mooring has inertia, and three of four calls have a duration: what
 * is taken back, saved and gone again is also velocities and the past that the next step needs.
 * Half of what is led to a place there has a velocity given, which may be any: another one than the
 * places have. From the middle of a history on calls lead something with one until the history has
 * two. */
#define _GNU_SOURCE
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "capstan/evolve.h"
#include "capstan/results.h"
#include "checker.h"
#include "given.h"
#include "same_line.h"
#include "splitmix.h"

enum {
    CALLS = 14,
    GIVEN = 2,
    LINES = 5,
    POINTS = 6,
    OBSTACLES = 2,
    ROPE_NODES = 33,
    ROPE = 0,
    KNOT = 2
};
enum { BED, ROUND };

/* ---- memory ---- */

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *place, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *place, size_t size);

static int allocations;
void *__wrap_malloc(size_t size) {
    allocations++;
    return __real_malloc(size);
}
void *__wrap_calloc(size_t count, size_t size) {
    allocations++;
    return __real_calloc(count, size);
}
void *__wrap_realloc(void *place, size_t size) {
    allocations++;
    return __real_realloc(place, size);
}

/* ---- scenes ---- */

typedef struct Tally {
    int seeds, kept, taken_back, refused, failed, loaded, open, several;
    int records, certified, by_kind[6], allocated, wrong, given;
} Tally;

static const char *const KIND[6] = {"ends", "points", "bodies", "nodes", "shifts", "turns"};

static uint64_t state, speeds; /* of the velocities that are given */
static double uniform(double low, double high) { return splitmix(&state, low, high); }
static bool chance(double share) { return uniform(0, 1) < share; }

/* What moves in time; statics: nothing. */
typedef enum Moving { STATICS, ROPE_IN_TIME, MOORING_IN_TIME } Moving;

typedef struct Live {
    Moving moving;
    CpsObstacle obstacle[OBSTACLES];
    CpsLine line[LINES];
    CpsPoint point[POINTS];
    CpsBody body;
    double rope[3 * ROPE_NODES];
    CpsScene scene;
} Live;

static void make_obstacles(Live *live) {
    for (int k = 0; k < OBSTACLES; k++) {
        CpsObstacle *o = &live->obstacle[k];
        *o = cps_obstacle_default();
        o->name = k == BED ? "bed" : "round";
        o->friction = chance(0.2) ? 0 : uniform(0.05, 0.8);
        o->moves = true;
    }
    CpsObstacle *o = &live->obstacle[ROUND];
    o->kind = chance(0.7) ? CPS_OBSTACLE_CYLINDER : CPS_OBSTACLE_SPHERE;
    o->radius = uniform(0.25, 0.6);
    o->axis[1] = 0;
    o->axis[chance(0.6) ? 2 : 0] = 1;
    o->point[0] = uniform(1, 5);
    o->point[1] = o->radius + uniform(0.05, 0.4);
    if (!chance(0.5)) o->point[1] *= -1;
    o->point[2] = o->axis[2] == 1 ? 0 : uniform(0.2, 0.8);
}

static void make_line(Live *live, int i, int from, int to, double weight, double slack) {
    static const char *const NAME[LINES] = {"rope", "west", "east", "hang", "top"};
    CpsLine *line = &live->line[i];
    *line = cps_line_default();
    line->name = NAME[i];
    line->weight = weight;
    line->stiffness = weight * pow(10, uniform(3, 5));
    line->element_count = (int)uniform(6, 16);
    line->start.kind = CPS_START_STATIC;
    double distance = 0, place[2][3];
    for (int end = 0; end < 2; end++) {
        const CpsPoint *point = &live->point[end ? to : from];
        const bool on_body = point->kind == CPS_POINT_KIND_ON_BODY;
        for (int a = 0; a < 3; a++)
            place[end][a] = point->position[a] + (on_body ? live->body.position[a] : 0);
        line->end[end].kind = CPS_END_KIND_POINT;
        line->end_point[end] = end ? to : from;
    }
    for (int a = 0; a < 3; a++) distance += pow(place[1][a] - place[0][a], 2);
    line->length = sqrt(distance) * slack;
}

static void make(Live *live, uint64_t seed) {
    static const char *const NAME[POINTS] = {"a", "b", "knot", "low", "high", "roof"};
    static const double PLACE[POINTS][3] = {{0, 6, 0},    {8, 6, 0},   {4, 5, 1.5},
                                            {0, 0, -0.3}, {0, 0, 0.3}, {4, 3, 8}};
    memset(live, 0, sizeof *live);
    state = 0x9b05688c2b3e6c1fu * (seed + 1);
    speeds = 0x1f83d9abfb41bd6bu * (seed + 1);
    live->scene = cps_scene_default();
    make_obstacles(live);
    live->body = cps_body_default();
    live->body.name = "body";
    live->body.position[0] = 4;
    live->body.position[1] = 3;
    live->body.position[2] = 4;
    live->body.weight = uniform(50, 200);
    live->body.centre_of_gravity[2] = -uniform(0, 0.2);
    for (int k = 0; k < POINTS; k++) {
        live->point[k] = cps_point_default();
        live->point[k].name = NAME[k];
        memcpy(live->point[k].position, PLACE[k], sizeof PLACE[k]);
        if (k == 3 || k == 4) live->point[k].kind = CPS_POINT_KIND_ON_BODY;
    }
    live->point[KNOT].kind = CPS_POINT_KIND_FREE;
    live->point[KNOT].weight = chance(0.5) ? uniform(0, 40) : 0;
    const double weight = uniform(2, 20);
    make_line(live, 1, 0, KNOT, weight, uniform(1.02, 1.2));
    make_line(live, 2, KNOT, 1, weight, uniform(1.02, 1.2));
    make_line(live, 3, KNOT, 3, weight, uniform(1.0, 1.1));
    make_line(live, 4, 4, 5, weight, uniform(1.0, 1.05));
    CpsLine *rope = &live->line[ROPE];
    *rope = cps_line_default();
    rope->name = "rope";
    rope->element_count = (int)uniform(12, ROPE_NODES - 1);
    rope->length = 6;
    rope->weight = weight;
    rope->stiffness = chance(0.4) ? INFINITY : weight * pow(10, uniform(2, 5));
    for (int j = 0; j <= rope->element_count; j++)
        live->rope[3 * j] = 6.0 * j / rope->element_count;
    rope->start.kind = CPS_START_NODES;
    rope->start.point_count = rope->element_count + 1;
    rope->start.point = live->rope;
    live->scene.obstacle_count = OBSTACLES;
    live->scene.obstacle = live->obstacle;
    live->scene.line_count = LINES;
    live->scene.line = live->line;
    live->scene.point_count = POINTS;
    live->scene.point = live->point;
    live->scene.body_count = 1;
    live->scene.body = &live->body;
}

/* Give the rope mass and leave out the mooring, or the other way round. */
static void set_in_motion(Live *live) {
    const double gravity = 9.81;
    live->moving = chance(0.5) ? ROPE_IN_TIME : MOORING_IN_TIME;
    live->scene.in_time = true;
    live->scene.time_scheme = chance(0.7) ? CPS_TIME_SCHEME_BDF2 : CPS_TIME_SCHEME_EULER;
    for (int i = 0; i < LINES; i++) {
        CpsLine *line = &live->line[i];
        line->inertia = line->weight / gravity;
        if (chance(0.3) && isfinite(line->stiffness))
            line->damping = line->stiffness * uniform(1e-4, 1e-2);
    }
    if (live->moving == ROPE_IN_TIME) {
        live->scene.line_count = 1;
        live->scene.point_count = live->scene.body_count = 0;
        return;
    }
    live->scene.line = &live->line[1];
    live->scene.line_count = LINES - 1;
    live->line[1].quasi_static = chance(0.3);
    live->point[KNOT].inertia = live->point[KNOT].weight / gravity;
    live->body.mass = live->body.weight / gravity;
    for (int a = 0; a < 3; a++) live->body.inertia[a] = live->body.mass * uniform(0.08, 0.12);
}

static CpsEvolution *begin(const CpsScene *scene) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(scene, &evolution, &err) != CPS_OK) {
        fprintf(stderr, "%s: %s\n", err.where, err.message);
        exit(1);
    }
    bool is_placed = false; /* by a first step, which is one of the history also */
    for (int i = 0; i < scene->line_count; i++)
        is_placed = is_placed || scene->line[i].start.kind == CPS_START_STATIC;
    if (is_placed) cps_evolution_step(evolution, NULL);
    return evolution;
}

/* ---- moves ---- */

typedef struct Move {
    CpsStage stage;
    CpsChange end[2];
    CpsPointChange point[2];
    CpsBodyChange body;
    CpsGraspChange node[2];
    CpsShift shift[OBSTACLES];
    CpsTurn turn;
    bool has[6];
} Move;

static CpsStage *stage_of(Move *move) {
    move->stage.change = move->end;
    move->stage.point_change = move->point;
    move->stage.body_change = &move->body;
    move->stage.grasp_change = move->node;
    move->stage.shift = move->shift;
    move->stage.turn = &move->turn;
    return &move->stage;
}

static void near(const double x[3], double size, double out[3]) {
    for (int a = 0; a < 3; a++) out[a] = x[a] + uniform(-size, size);
}

static void change_end(const CpsEvolution *now, const Live *live, Move *move, bool far) {
    CpsChange *change = &move->end[move->stage.change_count++];
    const CpsLineReport report = cps_evolution_line_report(now, ROPE);
    *change = (CpsChange){.line = ROPE, .end = far || chance(0.6) ? CPS_END_B : CPS_END_A};
    const bool held = far || change->end == CPS_END_A || chance(0.4);
    change->to.kind = held ? CPS_END_KIND_HELD : CPS_END_KIND_FREE;
    if (held) {
        near(report.end[change->end].position, 0.15, change->to.value);
        change->to.value[2] += 0.15;
        if (far) change->to.value[0] += 40;
    } else {
        const double none[3] = {0};
        near(none, 0.5 * live->line[ROPE].weight * live->line[ROPE].length, change->to.value);
    }
}

static void change_point(const CpsEvolution *now, Move *move) {
    CpsPointChange *change = &move->point[move->stage.point_change_count++];
    const int choice[] = {0, 1, KNOT, KNOT, 5};
    *change = (CpsPointChange){.point = choice[(int)uniform(0, 5)]};
    const CpsPointReport report = cps_evolution_point_report(now, change->point);
    if (change->point == KNOT && chance(0.6)) {
        const double none[3] = {0};
        change->kind = CPS_POINT_KIND_FREE;
        near(none, 30, change->value);
    } else {
        near(report.position, 0.2, change->value);
        if (change->point < 2) change->value[2] = fabs(change->value[2]) + 0.1;
    }
}

static void change_body(const CpsEvolution *now, const Live *live, Move *move) {
    const CpsBodyReport report = cps_evolution_body_report(now, 0);
    move->stage.body_change_count = 1;
    move->body = (CpsBodyChange){.kind = CPS_BODY_KIND_FREE};
    const double none[3] = {0};
    near(none, 0.3 * live->body.weight, move->body.force);
    if (chance(0.5)) return;
    move->body = (CpsBodyChange){.kind = CPS_BODY_KIND_HELD};
    near(report.position, 0.2, move->body.position);
    memcpy(move->body.rotation, report.rotation, sizeof report.rotation);
    for (int i = 1; i < 4; i++) move->body.rotation[i] += uniform(-0.05, 0.05);
}

static void change_node(const CpsEvolution *now, const Live *live, Move *move) {
    const CpsLineView view = cps_evolution_line_view(now, ROPE);
    CpsGraspChange *change = &move->node[move->stage.grasp_change_count++];
    const int n = live->line[ROPE].element_count;
    *change = (CpsGraspChange){.line = ROPE, .node = n / 3 + n / 3 * chance(0.4)};
    change->kind = chance(0.6) ? CPS_END_KIND_HELD : CPS_END_KIND_FREE;
    if (change->kind == CPS_END_KIND_HELD) {
        change->stays = chance(0.3);
        near(&view.position[3 * change->node], 0.15, change->value);
        change->value[2] += 0.15;
    } else if (chance(0.5)) {
        const double none[3] = {0};
        near(none, live->line[ROPE].weight, change->value);
    } else {
        change->at_once = true;
    }
}

/* In one step in time what is round goes by a quarter of its radius at most. */
static void change_obstacle(const CpsEvolution *now, Move *move) {
    const int k = chance(0.5) ? BED : ROUND;
    const bool slow = move->stage.duration > 0 && k == ROUND;
    const double none[3] = {0};
    CpsShift *shift = &move->shift[move->stage.shift_count++];
    const CpsObstacleReport report = cps_evolution_obstacle_report(now, k);
    *shift = (CpsShift){.obstacle = k};
    near(none, slow ? 0.03 : k == BED ? 0.1 : 0.4, shift->by);
    shift->by[2] *= k == BED ? 0.3 : 0.5;
    if (chance(0.5)) near(none, slow ? 0.01 : 0.1, shift->turn);
    near(report.point, 2, shift->about);
}

/* Is there what moves of this kind change? */
static bool is_there(const Live *live, int kind) {
    const bool is_joined = kind == 1 || kind == 2, is_obstacle = kind == 4 || kind == 5;
    return live->moving == STATICS || is_obstacle || is_joined == (live->moving == MOORING_IN_TIME);
}

/* Velocities of what is held after a step in time: of all of it, or of half. */
static bool give(double *v, int count, bool all) {
    const bool gives = splitmix(&speeds, 0, 1) >= 0.5;
    if (!gives && !all) return false;
    for (int a = 0; a < count; a++) v[a] = splitmix(&speeds, -1, 1);
    return true;
}

static void give_velocities(Move *move, bool all) {
    if (!(move->stage.duration > 0)) return;
    for (int i = 0; i < move->stage.change_count; i++)
        if (move->end[i].to.kind == CPS_END_KIND_HELD)
            move->end[i].has_velocity = give(move->end[i].velocity, 3, all);
    for (int i = 0; i < move->stage.point_change_count; i++)
        if (move->point[i].kind == CPS_POINT_KIND_HELD)
            move->point[i].has_velocity = give(move->point[i].velocity, 3, all);
    if (move->stage.body_change_count > 0 && move->body.kind == CPS_BODY_KIND_HELD)
        move->body.has_velocity = give(move->body.velocity, CPS_BODY_DIRECTIONS, all);
}

/* How many changes of a move have a velocity. */
static int count_velocities(const Move *move) {
    int count = move->stage.body_change_count > 0 && move->body.has_velocity;
    for (int i = 0; i < move->stage.change_count; i++) count += move->end[i].has_velocity;
    for (int i = 0; i < move->stage.point_change_count; i++) count += move->point[i].has_velocity;
    return count;
}

/* Lead an end of the rope, or a held point of the mooring, to a place near by. */
static void lead(const CpsEvolution *now, const Live *live, Move *move) {
    if (live->moving == ROPE_IN_TIME) {
        const CpsLineReport report = cps_evolution_line_report(now, ROPE);
        CpsChange *change = &move->end[move->stage.change_count++];
        *change = (CpsChange){.line = ROPE, .end = chance(0.5) ? CPS_END_A : CPS_END_B};
        change->to.kind = CPS_END_KIND_HELD;
        near(report.end[change->end].position, 0.1, change->to.value);
        change->to.value[2] += 0.1;
    } else {
        CpsPointChange *change = &move->point[move->stage.point_change_count++];
        *change = (CpsPointChange){.point = chance(0.5) ? 0 : 1};
        near(cps_evolution_point_report(now, change->point).position, 0.1, change->value);
        change->value[2] = fabs(change->value[2]) + 0.1;
    }
    move->has[live->moving == ROPE_IN_TIME ? 0 : 1] = true;
}

static Move draw(const CpsEvolution *now, const Live *live, bool far, bool leads) {
    Move move = {.stage = cps_stage_default()};
    move.stage.name = "call";
    const int count = far ? 0 : 1 + (int)uniform(0, 3);
    if (far) change_end(now, live, &move, true);
    if (live->moving != STATICS && (leads || chance(0.75)))
        move.stage.duration = uniform(0.01, 0.2);
    if (leads) lead(now, live, &move);
    for (int i = 0; i < count; i++) {
        const int kind = (int)uniform(0, 6);
        if (move.has[kind] || !is_there(live, kind)) continue;
        move.has[kind] = true;
        if (kind == 0) change_end(now, live, &move, false);
        if (kind == 1) change_point(now, &move);
        if (kind == 2) change_body(now, live, &move);
        if (kind == 3) change_node(now, live, &move);
        if (kind == 4) change_obstacle(now, &move);
        if (kind == 5) {
            move.stage.turn_count = 1;
            const double most = move.stage.duration > 0 ? 1.2 : 2;
            move.turn = (CpsTurn){.obstacle = ROUND, .angle = uniform(-most, most)};
        }
    }
    if (chance(0.1)) {
        move.stage.gravity_changes = true;
        move.stage.gravity[0] = uniform(-1, 1);
        move.stage.gravity[2] = -uniform(8, 11);
    }
    give_velocities(&move, leads);
    return move;
}

/* ---- histories ---- */

static bool same_state(const CpsEvolution *evolution, const unsigned char *before) {
    size_t size;
    unsigned char *after = saved_state(evolution, &size);
    const bool same = memcmp(before, after, size) == 0;
    free(after);
    return same;
}

static CpsEvolution *handed_over(CpsEvolution *evolution, const Live *live, Tally *tally) {
    size_t size;
    unsigned char *bytes = saved_state(evolution, &size);
    CpsEvolution *fresh = NULL;
    CpsError err = {0};
    if (cps_evolution_create(&live->scene, &fresh, &err) != CPS_OK ||
        cps_evolution_load(fresh, bytes, size, &err) != CPS_OK) {
        fprintf(stderr, "a saved state is refused: %s\n", err.message);
        cps_evolution_destroy(fresh);
        free(bytes);
        tally->wrong++;
        return evolution;
    }
    free(bytes);
    cps_evolution_destroy(evolution);
    tally->loaded++;
    return fresh;
}

/* Not certified: a program takes that back, and tries another target. */
static bool is_open(const CpsEvolution *evolution) {
    return !cps_outcome_is_certified(cps_evolution_report(evolution).outcome);
}

/* One call, and what becomes of it: true, and *move, where it is kept. */
static bool call(CpsEvolution *live_one, const Live *live, bool leads, bool *is_first, Move *move,
                 Tally *tally) {
    *move = draw(live_one, live, chance(0.1) && is_there(live, 0) && !leads, leads);
    if (chance(0.05)) move->stage.shift_count = -1;
    size_t size;
    unsigned char *before = saved_state(live_one, &size);
    const int allocated = allocations;
    const CpsStatus status = cps_evolution_move(live_one, stage_of(move), NULL);
    if (!*is_first && allocations != allocated) tally->allocated++;
    *is_first = *is_first && status != CPS_OK; /* which makes room for the state before it */
    bool kept = false, untouched = true;
    if (status != CPS_OK) {
        tally->refused++;
        untouched = same_state(live_one, before);
    } else if (cps_outcome_is_final(cps_evolution_report(live_one).outcome)) {
        tally->failed++;
        untouched = same_state(live_one, before);
        if (chance(0.5)) untouched &= cps_evolution_take_back(live_one, NULL) == CPS_OK;
    } else if (move->end[0].to.value[0] > 30 || chance(0.2) || is_open(live_one)) {
        tally->open += is_open(live_one);
        tally->taken_back++;
        untouched = cps_evolution_take_back(live_one, NULL) == CPS_OK &&
                    same_state(live_one, before) &&
                    cps_evolution_take_back(live_one, NULL) == CPS_ERR_ARGUMENT;
    } else {
        kept = true;
        int kinds = 0;
        for (int i = 0; i < 6; i++) {
            tally->by_kind[i] += move->has[i];
            kinds += move->has[i];
        }
        tally->several += kinds > 1;
        tally->given += count_velocities(move);
    }
    free(before);
    if (!untouched) {
        fprintf(stderr, "a call left something behind\n");
        tally->wrong++;
    }
    return kept;
}

static bool same_bits(const CpsEvolution *one, const CpsEvolution *other) {
    for (int i = 0; i < cps_evolution_line_count(one); i++)
        if (!same_line(one, i, other, i) || !same_motion(one, i, other, i)) return false;
    for (int i = 0; i < cps_evolution_point_count(one); i++) {
        const CpsPointMotion was = cps_evolution_point_motion(one, i),
                             is = cps_evolution_point_motion(other, i);
        if (!same_numbers(was.velocity, is.velocity, 3) || was.span != is.span) return false;
        const CpsPointReport a = cps_evolution_point_report(one, i),
                             b = cps_evolution_point_report(other, i);
        if (!same_numbers(a.position, b.position, 3) || !same_numbers(a.residual, b.residual, 3) ||
            !same_numbers(a.friction, b.friction, 3) || a.state != b.state)
            return false;
    }
    const CpsBodyReport a = cps_evolution_body_report(one, 0),
                        b = cps_evolution_body_report(other, 0);
    if (!same_numbers(a.position, b.position, 3) || !same_numbers(a.rotation, b.rotation, 4) ||
        !same_numbers(a.residual, b.residual, 6) || a.kind != b.kind)
        return false;
    const CpsBodyMotion u = cps_evolution_body_motion(one, 0),
                        v = cps_evolution_body_motion(other, 0);
    if (!same_numbers(u.velocity, v.velocity, 3) || !same_numbers(u.turn_rate, v.turn_rate, 3) ||
        u.span != v.span)
        return false;
    for (int i = 0; i < OBSTACLES; i++) {
        const CpsObstacleReport was = cps_evolution_obstacle_report(one, i),
                                is = cps_evolution_obstacle_report(other, i);
        if (memcmp(&was, &is, sizeof is) != 0) return false;
    }
    return true;
}

/* What the independent checker says of the results of the history, which are written. */
static void judge(const CpsScene *scene, const CpsEvolution *last, const char *folder,
                  Tally *tally) {
    CpsResultsOptions options = cps_results_options_default();
    CpsResults *results = NULL;
    CpsEvolution *evolution = NULL;
    CpsError err = {0};
    char path[300];
    options.no_paraview = true;
    if (cps_evolution_create(scene, &evolution, &err) != CPS_OK ||
        cps_results_open(folder, scene, evolution, &options, &results, &err) != CPS_OK) {
        fprintf(stderr, "the kept moves make no scene: %s\n", err.message);
        tally->wrong++;
        cps_evolution_destroy(evolution);
        return;
    }
    bool good = true;
    while (good && cps_evolution_remaining_count(evolution) > 0)
        good = cps_evolution_step(evolution, &err) == CPS_OK &&
               cps_results_append(results, evolution, &err) == CPS_OK;
    good = good && cps_results_finish(results, 0, &err) == CPS_OK;
    if (!good) fprintf(stderr, "the history is not gone again: %s\n", err.message);
    if (good && !same_bits(evolution, last)) {
        fprintf(stderr, "other bits by a history\n");
        good = false;
    }
    snprintf(path, sizeof path, "%s/result.nc", folder);
    CheckerReport report = {0};
    if (good) {
        checker_file(path, &report, NULL);
        good = report.refuted == 0 && given_file(path, scene, stderr) == 0;
        if (report.refuted > 0) checker_file(path, &report, stderr);
        tally->records += report.records;
        tally->certified += report.certified;
    }
    tally->wrong += !good;
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
}

static void try_seed(uint64_t seed, bool in_time, const char *folder, Tally *tally) {
    static Live live;
    static Move kept[CALLS];
    static CpsStage stage[CALLS];
    const int wrong = tally->wrong, given = tally->given;
    int count = 0;
    make(&live, seed);
    if (in_time) set_in_motion(&live);
    tally->seeds++;
    CpsEvolution *evolution = begin(&live.scene);
    bool is_first = true;
    for (int i = 0; i < CALLS; i++) {
        const bool leads = in_time && i >= CALLS / 2 && tally->given - given < GIVEN;
        const bool keeps = call(evolution, &live, leads, &is_first, &kept[count], tally);
        count += keeps;
        if (keeps && chance(0.2)) {
            evolution = handed_over(evolution, &live, tally);
            is_first = true;
        }
    }
    tally->kept += count;
    if (cps_outcome_is_final(cps_evolution_report(evolution).outcome))
        cps_evolution_take_back(evolution, NULL);
    CpsEvolution *again = begin(&live.scene);
    for (int i = 0; i < count; i++) {
        stage[i] = *stage_of(&kept[i]);
        if (cps_evolution_move(again, &stage[i], NULL) != CPS_OK) tally->wrong++;
    }
    if (!same_bits(again, evolution)) {
        fprintf(stderr, "other bits by moves alone\n");
        tally->wrong++;
    }
    cps_evolution_destroy(again);
    CpsScene scene = live.scene;
    scene.stage_count = count;
    scene.stage = stage;
    if (count > 0) judge(&scene, evolution, folder, tally);
    cps_evolution_destroy(evolution);
    if (tally->wrong > wrong) fprintf(stderr, "seed %llu\n", (unsigned long long)seed);
}

int main(int argc, char **argv) {
    int seeds = 20, most_open = -1;
    bool in_time = false;
    uint64_t first = 1;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--seeds") == 0) seeds = atoi(argv[i + 1]);
        if (strcmp(argv[i], "--in-time") == 0) in_time = atoi(argv[i + 1]) > 0;
        if (strcmp(argv[i], "--most-open") == 0) most_open = atoi(argv[i + 1]);
        if (strcmp(argv[i], "--seed") == 0) first = strtoull(argv[i + 1], NULL, 10);
    }
    char folder[] = "/tmp/random-live-XXXXXX", command[64];
    if (!mkdtemp(folder)) return 1;
    Tally tally = {0};
    for (int k = 0; k < seeds; k++) try_seed(first + (uint64_t)k, in_time, folder, &tally);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    if (system(command) != 0) return 1;
    printf("%d seeds, %d calls kept, %d of several kinds, %d not certified; %d taken back, %d "
           "refused, "
           "%d that lead nowhere, %d states handed over\n",
           tally.seeds, tally.kept, tally.several, tally.open, tally.taken_back, tally.refused,
           tally.failed, tally.loaded);
    for (int i = 0; i < 6; i++) printf("%s %d%s", KIND[i], tally.by_kind[i], i < 5 ? ", " : "\n");
    printf("%d velocities given; %d records, %d confirmed; %d moves allocated, %d faults\n",
           tally.given, tally.records, tally.certified, tally.allocated, tally.wrong);
    if (most_open >= 0) return tally.wrong > 0 || tally.allocated > 0 || tally.open > most_open;
    bool all = tally.kept > 5 * seeds && tally.taken_back > 0 && tally.refused > 0 &&
               tally.failed > 0 && tally.loaded > 0 && (tally.given > seeds) == in_time;
    for (int i = 0; i < 6; i++) all = all && tally.by_kind[i] > 0;
    return tally.wrong > 0 || tally.allocated > 0 || !all || tally.open > 0.01 * tally.kept + 1;
}
