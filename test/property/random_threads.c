/* SPDX-License-Identifier: BSD-3-Clause */
/* The state after each step has the same bits with any number of threads, and each line the same as
 * where the lines stand in the reverse order: nothing passes from line to line.
 *     usage: random_threads [--scenes N] [--seed S]
 *
 * Random scenes of all classes (random_scene.h), whose first line is copied twice to thrice with
 * other weights, stiffnesses and numbers of elements; on a sixth of them the first obstacle has a
 * polygon of friction forces. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "random_scene.h"
#include "same_line.h"
#include "splitmix.h"

enum { MANY = 7, SHORT = 16 };

static const char *const NAME[SCENE_LINES] = {"a", "b", "c", "d"};

/* Line i as a variation of line 0, with the same changes of its ends. */
static void add_line(RandomScene *random, int i, uint64_t *state) {
    CpsLine *line = &random->line[i];
    *line = random->line[0];
    line->name = NAME[i];
    line->weight *= splitmix(state, 0.5, 2);
    if (splitmix(state, 0, 1) < 0.3)
        line->stiffness = INFINITY;
    else
        line->stiffness *= splitmix(state, 0.5, 2);
    if (!line->element_length) line->element_count += (int)splitmix(state, 0, 8);
    for (int s = 0; s < random->scene.stage_count; s++) {
        CpsStage *stage = &random->stage[s];
        const int count = stage->change_count;
        for (int k = 0; k < count; k++) {
            if (random->change[s][k].line != 0) continue;
            CpsChange *copy = &random->change[s][stage->change_count++];
            *copy = random->change[s][k];
            copy->line = i;
        }
    }
    random->scene.line_count = i + 1;
}

/* The lines in the reverse order. */
static void reverse(RandomScene *random) {
    const int last = random->scene.line_count - 1;
    for (int i = 0; 2 * i < last; i++) {
        const CpsLine line = random->line[i];
        random->line[i] = random->line[last - i];
        random->line[last - i] = line;
    }
    for (int s = 0; s < random->scene.stage_count; s++)
        for (int k = 0; k < random->stage[s].change_count; k++)
            random->change[s][k].line = last - random->change[s][k].line;
}

static CpsEvolution *make(const CpsScene *scene, int threads) {
    CpsScene copy = *scene;
    CpsEvolution *evolution = NULL;
    CpsError err;
    copy.solver.thread_count = threads;
    copy.solver.max_halvings = 1; /* what is not certified is compared as well, and soon */
    if (cps_evolution_create(&copy, &evolution, &err) != CPS_OK) {
        fprintf(stderr, "%s\n", err.message);
        exit(1);
    }
    return evolution;
}

/* The state without the time that the step took. */
static unsigned char *state_of(const CpsEvolution *evolution, size_t *size) {
    unsigned char *state = saved_state(evolution, size);
    const double wall = cps_evolution_report(evolution).wall;
    for (size_t i = 0; i + sizeof wall <= *size; i++)
        if (memcmp(state + i, &wall, sizeof wall) == 0) memset(state + i, 0, sizeof wall);
    return state;
}

static bool same_state(const CpsEvolution *one, const CpsEvolution *other) {
    size_t size, other_size;
    unsigned char *a = state_of(one, &size), *b = state_of(other, &other_size);
    const bool same = size == other_size && memcmp(a, b, size) == 0;
    free(a);
    free(b);
    return same;
}

typedef struct Tally {
    int scenes, steps, with_set, inextensible, failures;
} Tally;

static void fail(Tally *tally, const char *class_name, uint64_t seed, const char *how) {
    tally->failures++;
    fprintf(stderr, "class %s, seed %llu: %s\n", class_name, (unsigned long long)seed, how);
}

static void compare(const RandomScene *random, RandomScene *reversed, const char *class_name,
                    uint64_t seed, Tally *tally) {
    static const int THREADS[] = {1, 2, MANY};
    enum { COUNT = sizeof THREADS / sizeof *THREADS };
    CpsEvolution *evolution[COUNT], *backward = make(&reversed->scene, 1);
    for (int k = 0; k < COUNT; k++) evolution[k] = make(&random->scene, THREADS[k]);
    const int lines = random->scene.line_count, before = tally->failures;
    while (cps_evolution_remaining_count(evolution[0]) > 0 && tally->failures == before) {
        CpsStatus status = cps_evolution_step(backward, NULL);
        for (int k = 0; k < COUNT; k++)
            if (cps_evolution_step(evolution[k], NULL) != status)
                fail(tally, class_name, seed, "another status");
        if (status != CPS_OK) break; /* a grab through an obstacle */
        tally->steps++;
        for (int k = 1; k < COUNT; k++)
            if (!same_state(evolution[0], evolution[k]))
                fail(tally, class_name, seed, "other bits with more threads");
        for (int i = 0; i < lines; i++)
            if (!same_line(evolution[0], i, backward, lines - 1 - i))
                fail(tally, class_name, seed, "other bits in another order");
    }
    for (int k = 0; k < COUNT; k++) cps_evolution_destroy(evolution[k]);
    cps_evolution_destroy(backward);
}

/* A polygon that is no box, about 0. */
static CpsSet *polygon(double size) {
    const double points[] = {size,       0,           0.3 * size,  0.6 * size, -0.5 * size,
                             0.4 * size, -0.4 * size, -0.5 * size, 0.2 * size, -0.7 * size};
    CpsSet *set = NULL;
    return cps_set_hull_of_points(2, 5, points, &set, NULL) == CPS_OK ? set : NULL;
}

static void try_scene(int class_index, uint64_t seed, Tally *tally) {
    static RandomScene random, reversed;
    uint64_t state = seed;
    random_scene_make(class_index, seed, &random);
    /* short lines, for the sake of time; arcs that few elements cannot follow are refused */
    if (!random.line[0].element_length && random.line[0].element_count > SHORT)
        random.line[0].element_count = SHORT;
    const int lines = 3 + (splitmix(&state, 0, 1) < 0.5);
    while (random.scene.line_count < lines) add_line(&random, random.scene.line_count, &state);
    CpsSet *set = NULL;
    if (random.scene.obstacle_count > 0 && splitmix(&state, 0, 6) < 1) {
        set = polygon(fmax(random.obstacle[0].friction, 0.1));
        random.obstacle[0].friction = random.obstacle[0].friction_lateral = 0;
        random.obstacle[0].has_friction_lateral = false;
        random.obstacle[0].friction_set = set;
    }
    /* the copy's pointers into itself are made by making it again; what was added is copied */
    random_scene_make(class_index, seed, &reversed);
    memcpy(reversed.line, random.line, sizeof random.line);
    memcpy(reversed.obstacle, random.obstacle, sizeof random.obstacle);
    memcpy(reversed.change, random.change, sizeof random.change);
    for (int s = 0; s < random.scene.stage_count; s++)
        reversed.stage[s].change_count = random.stage[s].change_count;
    reversed.scene.line_count = random.scene.line_count;
    reverse(&reversed);
    if (cps_scene_check(&random.scene, NULL) == CPS_OK) {
        tally->scenes++;
        tally->with_set += set != NULL;
        for (int i = 0; i < random.scene.line_count; i++)
            tally->inextensible += isinf(random.line[i].stiffness) != 0;
        compare(&random, &reversed, random_scene_class_name(class_index), seed, tally);
    }
    cps_set_release(set);
}

int main(int argc, char **argv) {
    const RandomSceneRange range = random_scene_range(argc, argv);
    Tally tally = {0};
    for (int k = 0; k < range.count; k++)
        try_scene(k % SCENE_CLASSES, range.seed + (uint64_t)k, &tally);
    printf("%d of %d scenes valid, %d steps, %d with a friction set, %d inextensible lines, %d "
           "failures\n",
           tally.scenes, range.count, tally.steps, tally.with_set, tally.inextensible,
           tally.failures);
    /* most scenes must be valid, or nothing is tested */
    return tally.failures > 0 || 2 * tally.scenes < range.count;
}
