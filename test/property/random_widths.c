/* SPDX-License-Identifier: BSD-3-Clause */
/* Each step of a random scene, and the solution of each random conic program, has the same bits at
 * every width of registers that the processor has (base/width.h).
 *     usage: random_widths [--scenes N] [--seed S]
 *
 * Random scenes of all classes (random_scene.h); the number of elements varies, so that the last
 * lanes are filled to any number. Of every six scenes one conic program (random_program.h), with
 * 200 to 700 unknowns that fill the end of its factor. With one width alone there is nothing to
 * compare: exit status 77. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/width.h"
#include "random_program.h"
#include "random_scene.h"
#include "splitmix.h"

static const char *const BITS[CPSI_WIDTHS] = {"128", "256", "512"};

static void use_width(CpsiWidth width) {
    setenv("CAPSTAN_WIDTH", BITS[width], 1);
    if (cpsi_width() == width) return;
    fprintf(stderr, "CAPSTAN_WIDTH=%s is not heard\n", BITS[width]);
    exit(1);
}

static CpsEvolution *make(const CpsScene *scene, CpsiWidth width) {
    CpsScene copy = *scene;
    CpsEvolution *evolution = NULL;
    CpsError err;
    copy.solver.max_halvings = 1; /* what is not certified is compared as well, and soon */
    use_width(width);
    if (cps_evolution_create(&copy, &evolution, &err) == CPS_OK) return evolution;
    fprintf(stderr, "%s\n", err.message);
    exit(1);
}

static bool same(const double *a, const double *b, int count) {
    return memcmp(a, b, (size_t)count * sizeof *a) == 0;
}

static bool same_line(const CpsEvolution *one, const CpsEvolution *other, int line) {
    const CpsLineView a = cps_evolution_line_view(one, line),
                      b = cps_evolution_line_view(other, line);
    const int elements = a.element_count, nodes = elements + 1, contacts = a.contact_count * nodes;
    const CpsStepReport report = cps_evolution_report(one),
                        other_report = cps_evolution_report(other);
    return report.iteration_count == other_report.iteration_count &&
           same(&report.certificate.gap, &other_report.certificate.gap, 1) &&
           same(a.position, b.position, 3 * nodes) && same(a.tension, b.tension, elements) &&
           same(a.segment_force, b.segment_force, 3 * elements) &&
           same(a.reaction, b.reaction, contacts) &&
           same(a.friction_force, b.friction_force, 3 * contacts);
}

static bool same_lines(const CpsEvolution *one, const CpsEvolution *other, int count) {
    bool all = true;
    for (int i = 0; i < count; i++) all = all && same_line(one, other, i);
    return all;
}

/* Sets of other sizes on obstacles side by side, so that lanes are filled by runs of each. */
static CpsSet *make_set(double size, int kind) {
    const double points[] = {size,       0,           0.3 * size,  0.6 * size, -0.5 * size,
                             0.4 * size, -0.4 * size, -0.5 * size, 0.2 * size, -0.7 * size};
    const double from[2] = {-0.5 * size, 0}, to[2] = {2 * size, size};
    CpsSet *set = NULL, *part[2] = {NULL};
    if (kind == 0) return cps_set_hull_of_points(2, 5, points, &set, NULL) == CPS_OK ? set : NULL;
    if (cps_set_ball(2, NULL, size, &part[0], NULL) == CPS_OK &&
        cps_set_segment(2, from, to, &part[1], NULL) == CPS_OK)
        (void)cps_set_hull(2, (const CpsSet *const *)part, &set, NULL);
    cps_set_release(part[0]);
    cps_set_release(part[1]);
    return set;
}

/* Give every obstacle a set, of one kind or of alternating ones. */
static void add_sets(RandomScene *random, CpsSet **set) {
    for (int k = 0; k < random->scene.obstacle_count; k++) {
        CpsObstacle *o = &random->obstacle[k];
        o->friction_set = set[k] = make_set(fmax(o->friction, 0.1), k % 2);
        o->friction = o->friction_lateral = 0;
        o->has_friction_lateral = false;
    }
}

/* The number of steps, all of which must be the same. */
static int compare(const CpsScene *scene, int widths, const char *class_name, uint64_t seed,
                   int *failures) {
    CpsEvolution *evolution[CPSI_WIDTHS];
    for (int k = 0; k < widths; k++) evolution[k] = make(scene, (CpsiWidth)k);
    const int before = *failures;
    int steps = 0;
    while (cps_evolution_remaining_count(evolution[0]) > 0 && *failures == before) {
        CpsStatus status[CPSI_WIDTHS] = {CPS_OK};
        for (int k = 0; k < widths; k++) status[k] = cps_evolution_step(evolution[k], NULL);
        for (int k = 1; k < widths; k++)
            if (status[k] != status[0] ||
                !same_lines(evolution[0], evolution[k], scene->line_count)) {
                ++*failures;
                fprintf(stderr, "class %s, seed %llu: other bits at %s\n", class_name,
                        (unsigned long long)seed, BITS[k]);
            }
        if (status[0] != CPS_OK) break; /* a grab through an obstacle */
        steps++;
    }
    for (int k = 0; k < widths; k++) cps_evolution_destroy(evolution[k]);
    return steps;
}

/* Whether the solutions of a random program are the same. */
static bool same_solutions(int widths, uint64_t seed) {
    uint64_t state = seed;
    const RandomProgramKind kind = {.unknowns = 200 + (int)splitmix(&state, 0, 500)};
    RandomProgram made = random_program_new(&kind, seed);
    CpsiSparseProgram *program[CPSI_WIDTHS];
    CpsiConicResult found[CPSI_WIDTHS];
    bool all = true;
    for (int k = 0; k < widths; k++) {
        CpsError err;
        use_width((CpsiWidth)k);
        if (cpsi_sparse_program_new(&made.data, &program[k], &err) != CPS_OK) {
            fprintf(stderr, "%s\n", err.message);
            exit(1);
        }
        found[k] = cpsi_sparse_program_solve(program[k], 1e-7);
        all = all && found[k].outcome == CPSI_CONIC_SOLVED &&
              found[k].iterations == found[0].iterations &&
              same(found[k].x, found[0].x, made.data.unknowns) &&
              same(found[k].y, found[0].y, made.data.equations) &&
              same(found[k].z, found[0].z, made.rows);
    }
    for (int k = 0; k < widths; k++) cpsi_sparse_program_free(program[k]);
    random_program_free(&made);
    return all;
}

int main(int argc, char **argv) {
    static RandomScene random;
    const RandomSceneRange range = random_scene_range(argc, argv);
    int valid = 0, with_sets = 0, steps = 0, failures = 0;
    unsetenv("CAPSTAN_WIDTH");
    const int widths = (int)cpsi_width() + 1;
    if (widths == 1) {
        printf("this processor, or this build, has one width alone\n");
        return 77;
    }
    for (int k = 0; k < range.count; k++) {
        const int class_index = k % SCENE_CLASSES;
        uint64_t state = range.seed + (uint64_t)k;
        random_scene_make(class_index, range.seed + (uint64_t)k, &random);
        if (!random.line[0].element_length)
            random.line[0].element_count = 8 + (int)splitmix(&state, 0, 24);
        CpsSet *set[SCENE_OBSTACLES] = {NULL};
        const bool sets = random.scene.obstacle_count > 0 && splitmix(&state, 0, 3) < 1;
        if (sets) add_sets(&random, set);
        if (cps_scene_check(&random.scene, NULL) == CPS_OK) {
            valid++;
            with_sets += sets;
            steps += compare(&random.scene, widths, random_scene_class_name(class_index),
                             range.seed + (uint64_t)k, &failures);
        }
        for (int i = 0; i < SCENE_OBSTACLES; i++) cps_set_release(set[i]);
    }
    const int programs = 1 + range.count / 6;
    for (int k = 0; k < programs; k++)
        if (!same_solutions(widths, range.seed + (uint64_t)k)) {
            failures++;
            fprintf(stderr, "conic program, seed %llu: other bits\n",
                    (unsigned long long)range.seed + (unsigned)k);
        }
    printf("%d of %d scenes valid, %d with sets, %d steps, %d programs, %d widths, %d failures\n",
           valid, range.count, with_sets, steps, programs, widths, failures);
    /* most scenes must be valid, or nothing is tested */
    return failures > 0 || 2 * valid < range.count;
}
