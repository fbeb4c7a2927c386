/* SPDX-License-Identifier: BSD-3-Clause */
/* A history that is gone by moves has the bits of the history.    usage: random_moves [--scenes N]
 * [--seed S]
 *
 * Random scenes of all classes (random_scene.h) are run twice: with their history, and without one,
 * each step being a move to the targets that the stage has there. Between the steps come moves that
 * are taken back, moves that are refused, and moves that no line can follow: they must leave
 * nothing behind. Between stages the state of the history is given to a scene that lacks the stages
 * to come, and goes on there by moves. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "random_scene.h"
#include "same_line.h"
#include "splitmix.h"

typedef struct Tally {
    int scenes, steps, taken_back, refused, failed, loaded, failures;
} Tally;

static void fail(Tally *tally, const char *class_name, uint64_t seed, const char *how) {
    tally->failures++;
    fprintf(stderr, "class %s, seed %llu: %s\n", class_name, (unsigned long long)seed, how);
}

static CpsEvolution *make(const CpsScene *scene, int stages) {
    CpsScene copy = *scene;
    CpsEvolution *evolution = NULL;
    CpsError err;
    copy.stage_count = stages;
    copy.solver.max_halvings = 1; /* what is not certified is compared as well, and soon */
    if (cps_evolution_create(&copy, &evolution, &err) != CPS_OK) {
        fprintf(stderr, "%s\n", err.message);
        exit(1);
    }
    return evolution;
}

/* The changes of a stage, and where they begin. */
typedef struct Course {
    const CpsStage *stage;
    CpsEnd from[2 * SCENE_LINES];
    double gravity[3], gravity_from[3];
} Course;

/* The position of an end. */
static const double *position(const CpsEvolution *evolution, int line, int end) {
    const CpsLineView view = cps_evolution_line_view(evolution, line);
    return &view.position[end == CPS_END_A ? 0 : 3 * view.element_count];
}

/* What an end of this kind starts from: its position to be held, its force to be pulled. */
static CpsEnd end_now(const CpsEvolution *evolution, int line, int end, CpsEndKind kind) {
    const CpsEnd imposed = cps_evolution_line_view(evolution, line).end[end];
    if (imposed.kind == kind) return imposed;
    const CpsLineReport report = cps_evolution_line_report(evolution, line);
    CpsEnd now = {.kind = kind};
    memcpy(now.value,
           kind == CPS_END_KIND_HELD ? position(evolution, line, end) : report.end[end].force,
           sizeof now.value);
    return now;
}

static double between(double from, double to, int part, int steps) {
    return part < steps ? from + (double)part / steps * (to - from) : to;
}

/* Where the changes of a stage begin. It is asked of the history: after a move that no line can
 * follow the views of the other evolution show that one. */
static void begin(Course *course, const CpsStage *stage, const CpsEvolution *history) {
    course->stage = stage;
    for (int k = 0; k < stage->change_count; k++) {
        const CpsChange *change = &stage->change[k];
        course->from[k] = end_now(history, change->line, change->end, change->to.kind);
    }
    memcpy(course->gravity_from, course->gravity, sizeof course->gravity);
}

/* Step `part` of the stage, from 1, as a move. */
static CpsStatus move_along(CpsEvolution *evolution, Course *course, int part) {
    const CpsStage *stage = course->stage;
    CpsChange change[2 * SCENE_LINES];
    CpsTurn turn[SCENE_OBSTACLES];
    for (int k = 0; k < stage->change_count; k++) {
        change[k] = stage->change[k];
        for (int a = 0; a < 3; a++)
            change[k].to.value[a] = between(course->from[k].value[a], stage->change[k].to.value[a],
                                            part, stage->step_count);
    }
    for (int k = 0; k < stage->turn_count; k++) {
        turn[k] = stage->turn[k];
        turn[k].angle /= stage->step_count;
    }
    CpsStage move = cps_stage_default();
    move.change_count = stage->change_count;
    move.change = change;
    move.turn_count = stage->turn_count;
    move.turn = turn;
    move.gravity_changes = stage->gravity_changes;
    if (move.gravity_changes) {
        for (int a = 0; a < 3; a++)
            move.gravity[a] =
                between(course->gravity_from[a], stage->gravity[a], part, stage->step_count);
        memcpy(course->gravity, move.gravity, sizeof move.gravity);
    }
    return cps_evolution_move(evolution, &move, NULL);
}

/* One end of one line goes somewhere else, by so many lengths, or is pulled by another force. */
static CpsStatus wander(CpsEvolution *evolution, const RandomScene *random, double lengths,
                        uint64_t *state) {
    CpsChange change = {.line = (int)splitmix(state, 0, random->scene.line_count)};
    change.end = splitmix(state, 0, 1) < 0.5;
    const CpsLine *line = &random->line[change.line];
    CpsEndKind kind = cps_evolution_line_view(evolution, change.line).end[change.end].kind;
    if (lengths > 1 || splitmix(state, 0, 1) < 0.3) kind = CPS_END_KIND_HELD;
    change.to = end_now(evolution, change.line, change.end, kind);
    const bool held = change.to.kind == CPS_END_KIND_HELD;
    const double size = held ? lengths * line->length : 0.1 * line->weight * line->length;
    change.to.value[2] += size;
    change.to.value[0] += splitmix(state, -1, 1) * size;
    CpsStage move = cps_stage_default();
    move.change_count = 1;
    move.change = &change;
    return cps_evolution_move(evolution, &move, NULL);
}

/* A move that the check refuses. */
static CpsStatus nonsense(CpsEvolution *evolution, uint64_t *state) {
    const int which = (int)splitmix(state, 0, 5);
    CpsChange change[2] = {{.to.kind = CPS_END_KIND_FREE}, {.to.kind = CPS_END_KIND_FREE}};
    CpsTurn turn = {.obstacle = SCENE_OBSTACLES};
    CpsStage move = cps_stage_default();
    move.change_count = 1;
    move.change = change;
    switch (which) {
    case 0: change[0].line = -1; break;
    case 1: change[0].to.value[1] = NAN; break;
    case 2: move.change_count = 2; break; /* the same end twice */
    case 3:
        move.turn_count = 1;
        move.turn = &turn;
        break;
    default: move.step_count = 2;
    }
    return cps_evolution_move(evolution, &move, NULL);
}

/* Things that leave nothing behind. Returns false where they do. */
static bool disturb(CpsEvolution *evolution, const RandomScene *random, uint64_t *state,
                    Tally *tally) {
    size_t size, size_after;
    unsigned char *before = saved_state(evolution, &size);
    bool good = true;
    if (splitmix(state, 0, 1) < 0.3) {
        good = nonsense(evolution, state) == CPS_ERR_ARGUMENT;
        tally->refused++;
    }
    if (splitmix(state, 0, 1) < 0.3 && wander(evolution, random, 0.05, state) == CPS_OK) {
        good = good && cps_evolution_take_back(evolution, NULL) == CPS_OK &&
               cps_evolution_take_back(evolution, NULL) == CPS_ERR_ARGUMENT;
        tally->taken_back++;
    }
    if (splitmix(state, 0, 1) < 0.3 && wander(evolution, random, 100, state) == CPS_OK) {
        /* a soft line, or one whose other end is free, follows */
        const bool follows = !cps_outcome_is_final(cps_evolution_report(evolution).outcome);
        tally->failed += !follows;
        if (follows || splitmix(state, 0, 1) < 0.5)
            good = good && cps_evolution_take_back(evolution, NULL) == CPS_OK;
    }
    unsigned char *after = saved_state(evolution, &size_after);
    good = good && size == size_after && memcmp(before, after, size) == 0;
    free(before);
    free(after);
    return good;
}

/* Give the state of the history after `stages` of its stages to a scene without the others. */
static CpsEvolution *hand_over(const CpsEvolution *history, const CpsScene *scene, int stages) {
    size_t size;
    unsigned char *state = saved_state(history, &size);
    CpsEvolution *shorter = make(scene, stages);
    CpsError err;
    if (cps_evolution_load(shorter, state, size, &err) != CPS_OK) {
        fprintf(stderr, "%s\n", err.message);
        cps_evolution_destroy(shorter);
        shorter = NULL;
    }
    free(state);
    return shorter;
}

static bool same_lines(const CpsEvolution *one, const CpsEvolution *other) {
    for (int i = 0; i < cps_evolution_line_count(one); i++)
        if (!same_line(one, i, other, i)) return false;
    return true;
}

/* Go along the history of a scene twice. Returns what went wrong, or NULL. */
static const char *go(const RandomScene *random, CpsEvolution *history, CpsEvolution **moved,
                      uint64_t *state, Tally *tally) {
    const CpsScene *scene = &random->scene;
    Course course = {0};
    memcpy(course.gravity, scene->gravity, sizeof course.gravity);
    bool statics = false;
    for (int i = 0; i < scene->line_count; i++)
        statics = statics || scene->line[i].start.kind == CPS_START_STATIC;
    if (statics) {
        if (wander(*moved, random, 0.1, state) != CPS_ERR_ARGUMENT) return "a move before statics";
        cps_evolution_step(history, NULL);
        cps_evolution_step(*moved, NULL);
    }
    for (int s = 0; s < scene->stage_count; s++) {
        begin(&course, &scene->stage[s], history);
        for (int part = 1; part <= course.stage->step_count; part++) {
            if (cps_evolution_remaining_count(history) == 0) return NULL;
            if (!disturb(*moved, random, state, tally)) return "a move left something behind";
            const CpsStatus status = cps_evolution_step(history, NULL);
            if (move_along(*moved, &course, part) != status) return "another status";
            if (status != CPS_OK) return NULL; /* a grab through an obstacle */
            tally->steps++;
            if (!same_lines(history, *moved)) return "other bits by moves";
            if (part < course.stage->step_count &&
                wander(history, random, 0.1, state) != CPS_ERR_ARGUMENT)
                return "a move within a stage";
        }
        if (cps_evolution_remaining_count(history) > 0 && splitmix(state, 0, 1) < 0.3) {
            CpsEvolution *shorter = hand_over(history, scene, s + 1);
            if (!shorter) return "a state is refused where only what is to come differs";
            cps_evolution_destroy(*moved);
            *moved = shorter;
            tally->loaded++;
        }
    }
    return NULL;
}

static void try_scene(int class_index, uint64_t seed, Tally *tally) {
    static RandomScene random;
    uint64_t state = seed;
    random_scene_make(class_index, seed, &random);
    if (random.scene.stage_count == 0 || cps_scene_check(&random.scene, NULL) != CPS_OK) return;
    tally->scenes++;
    CpsEvolution *history = make(&random.scene, random.scene.stage_count),
                 *moved = make(&random.scene, 0);
    const char *fault = go(&random, history, &moved, &state, tally);
    if (fault) fail(tally, random_scene_class_name(class_index), seed, fault);
    cps_evolution_destroy(history);
    cps_evolution_destroy(moved);
}

int main(int argc, char **argv) {
    const RandomSceneRange range = random_scene_range(argc, argv);
    Tally tally = {0};
    for (int k = 0; k < range.count; k++)
        try_scene(k % SCENE_CLASSES, range.seed + (uint64_t)k, &tally);
    printf("%d of %d scenes valid, %d steps; %d moves taken back, %d refused, %d that no line can "
           "follow, %d states handed over, %d failures\n",
           tally.scenes, range.count, tally.steps, tally.taken_back, tally.refused, tally.failed,
           tally.loaded, tally.failures);
    /* most scenes must be valid and all kinds of moves occur, or nothing is tested */
    return tally.failures > 0 || 2 * tally.scenes < range.count || tally.taken_back == 0 ||
           tally.refused == 0 || tally.failed == 0 || tally.loaded == 0;
}
