/* SPDX-License-Identifier: BSD-3-Clause */
/* Random scenes shifted by up to 1e7 lengths from the origin of their coordinates: the answers must
 * be those of the unshifted scenes.
 *
 * Coordinates are multiples of 2^-20 of the length and shifts of 2^-6, so that the shifted data are
 * exact and any difference is due to the program. */
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rig.h"

enum { SCENES = 12, ELEMENTS = 20, NODES = ELEMENTS + 1 };

/* splitmix64 */
static uint64_t state_of_chance;

static double chance(double low, double high) {
    uint64_t z = state_of_chance += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return low + (high - low) * (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* a coordinate of 20 binary digits */
static double place(double low, double high) { return floor(chance(low, high) * 0x1p20) * 0x1p-20; }

/* A line of length 1 over a bed and, in two of three, a cylinder or a ball on it; its end B is
 * moved about above them. */
static void build(Rig *rig, uint64_t seed, const double at[3]) {
    state_of_chance = seed;
    rig_begin(rig, ELEMENTS, 1, pow(10, chance(1, 3.5)));
    rig_length(rig, 1);
    CpsObstacle *bed = rig_obstacle(rig, CPS_OBSTACLE_PLANE, chance(0.1, 0.8));
    bed->normal[0] = chance(-0.1, 0.1);
    bed->normal[2] = 1;
    for (int a = 0; a < 3; a++) bed->point[a] = at[a];
    if (seed % 3) {
        CpsObstacle *o =
            rig_obstacle(rig, seed % 3 == 1 ? CPS_OBSTACLE_CYLINDER : CPS_OBSTACLE_SPHERE,
                         chance(0.1, 0.5));
        o->radius = chance(0.1, 0.2);
        o->point[0] = at[0] + place(0.4, 0.5);
        o->point[1] = at[1];
        o->point[2] = at[2];
    }
    rig->line.start.kind = CPS_START_STATIC;
    rig_end(rig, CPS_END_A, CPS_END_KIND_HELD, at[0], at[1], at[2] + 0.25);
    rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, at[0] + place(0.85, 0.9), at[1], at[2] + 0.375);
    for (int s = 0; s < 3; s++) {
        rig_stage(rig, 1 + (int)chance(0, 3));
        const double x = place(0.8, 0.9), y = place(-0.2, 0.2), z = place(0.3, 0.5);
        rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, at[0] + x, at[1] + y, at[2] + z);
    }
}

/* All steps: places about `at`, tensions, and how many were solved. */
typedef struct Answer {
    int steps, solved;
    CpsOutcome outcome[16];
    double position[16][3 * NODES], tension[16][ELEMENTS], largest[16], origin[3];
    double bound[16]; /* [N] what the certificates so far leave open of the tension of an element */
} Answer;

static void solve(uint64_t seed, const double at[3], Answer *out) {
    Rig rig;
    build(&rig, seed, at);
    CpsError err = {0};
    CpsEvolution *evolution;
    memset(out, 0, sizeof *out);
    if (cps_evolution_create(&rig.scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    for (; cps_evolution_remaining_count(evolution) > 0; out->steps++) {
        CHECK_INT(cps_evolution_step(evolution, &err), CPS_OK);
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        const CpsLineReport report = cps_evolution_line_report(evolution, 0);
        const int s = out->steps;
        for (int i = 0; i < 3 * NODES; i++)
            out->position[s][i] = view.position[i] + (view.origin[i % 3] - at[i % 3]);
        memcpy(out->tension[s], view.tension, sizeof out->tension[s]);
        memcpy(out->origin, view.origin, sizeof out->origin);
        out->largest[s] = report.certificate.largest_force;
        out->bound[s] = (s > 0 ? out->bound[s - 1] : 0) +
                        sqrt(ELEMENTS) * fmax(0, report.certificate.tension_bound); /* NaN: 0 */
        out->outcome[s] = report.outcome;
        out->solved += report.outcome == CPS_OUTCOME_SOLVED;
        /* the report is in the coordinates of the scene */
        for (int a = 0; a < 3; a++)
            CHECK_NEAR(report.end[CPS_END_B].position[a],
                       view.origin[a] + view.position[3 * ELEMENTS + a], 0);
        CHECK_VECTOR(report.end[CPS_END_A].position, rig.line.end[CPS_END_A].value, 0);
    }
    cps_evolution_destroy(evolution);
}

static void shifted_scenes_agree(void **state) {
    (void)state;
    static const double FAR[] = {1e4, 1e6, 1e7};
    static Answer here, there;
    double displacement = 0, tension = 0;
    int steps = 0;
    for (uint64_t seed = 1; seed <= SCENES; seed++) {
        solve(seed, (double[3]){0, 0, 0}, &here);
        CHECK_VECTOR(here.origin, ((double[3]){0, 0, 0}), 0);
        for (int f = 0; f < 9; f++) {
            /* along one axis, two, or all, and by a broken number, so that the local origin is not
             * where it was */
            const double s = FAR[f / 3] + 0.3125,
                         at[3] = {f % 3 == 1 ? 0 : s, f % 3 == 0 ? 0 : -0.75 * s,
                                  f % 3 == 2 ? 0.5 * s : 0};
            solve(seed, at, &there);
            for (int a = 0; a < 3; a++)
                CHECK_NEAR(there.origin[a], at[a], 10); /* in round numbers */
            CHECK_INT(there.steps, here.steps);
            for (int k = 0; k < here.steps; k++) {
                CHECK_INT(there.outcome[k], here.outcome[k]);
                if (here.outcome[k] != CPS_OUTCOME_SOLVED) continue;
                steps++;
                for (int i = 0; i < 3 * NODES; i++)
                    displacement =
                        fmax(displacement, fabs(there.position[k][i] - here.position[k][i]));
                for (int i = 0; i < ELEMENTS; i++)
                    tension = fmax(tension,
                                   fabs(there.tension[k][i] - here.tension[k][i]) /
                                       (here.bound[k] + there.bound[k] + 1e-6 * here.largest[k]));
            }
        }
    }
    printf("%d steps, places differ by %.1e of the length, tensions by %.1e of what certificates "
           "leave open\n",
           steps, displacement, tension);
    CHECK_GREATER(steps, 20 * SCENES);
    /* the loop ends at a relative gap of 1e-13; its root 3e-7 bounds what forces and places of a
     * step keep of it, and steps add up */
    CHECK_LESS(displacement, 1e-6);
    CHECK_LESS(tension, 1);
}

/* In water that goes along with a line, in short steps, the rounding of a place times m/k^2 is a
 * force: at 200 lengths, where a scene at rest keeps its coordinates, all steps are certified. In
 * each the velocity has what is rounded there, over k. */
static void motion_far_away_agrees(void **state) {
    (void)state;
    static const double AT[3] = {200.3125, -150.25, 0}, SHORT = 2e-5; /* [s] */
    static const CpsCurrentRow still = {0};
    static const CpsCurrent water = {.density = 1000, .row_count = 1, .row = &still};
    const CpsLineLoads loads = {
        .drag = {.diameter = 0.01, .normal = 1.6, .tangential = 0.1, .added_normal = 1}};
    enum { STEPS = 40 };
    double displacement = 0, velocity = 0;
    int certified = 0, steps = 0;
    for (uint64_t seed = 1; seed <= SCENES; seed++) {
        Rig rig[2];
        CpsEvolution *evolution[2];
        CpsError err = {0};
        for (int k = 0; k < 2; k++) {
            build(&rig[k], seed, k ? AT : (double[3]){0, 0, 0});
            rig[k].scene.current = &water;
            rig[k].line.inertia = 0.1;
            rig[k].line.loads = &loads;
            for (int s = 0; s < 3; s++) {
                rig[k].stage[s].step_count = STEPS;
                rig[k].stage[s].duration = STEPS * SHORT;
                rig[k].change[s][0].to = (CpsEnd){.kind = CPS_END_KIND_FREE, .value = {s, -s, 3}};
            }
            CHECK_INT(cps_evolution_create(&rig[k].scene, &evolution[k], &err), CPS_OK);
        }
        for (; cps_evolution_remaining_count(evolution[0]) > 0; steps++) {
            CpsLineView view[2];
            CpsLineMotion motion[2];
            for (int k = 0; k < 2; k++) {
                CHECK_INT(cps_evolution_step(evolution[k], &err), CPS_OK);
                certified +=
                    cps_evolution_line_report(evolution[k], 0).outcome == CPS_OUTCOME_SOLVED;
                view[k] = cps_evolution_line_view(evolution[k], 0);
                motion[k] = cps_evolution_line_motion(evolution[k], 0);
            }
            for (int i = 0; i < 3 * NODES; i++) {
                const double off = view[1].origin[i % 3] - AT[i % 3];
                displacement =
                    fmax(displacement, fabs(view[1].position[i] + off - view[0].position[i]));
                velocity = fmax(velocity, fabs(motion[1].velocity[i] - motion[0].velocity[i]));
            }
        }
        for (int k = 0; k < 2; k++) cps_evolution_destroy(evolution[k]);
    }
    printf("in time: of 2 x %d steps %d certified, places differ by %.1e of the length, velocities "
           "by %.1e of a length a second\n",
           steps, certified, displacement, velocity);
    CHECK_INT(certified, 2 * steps);
    CHECK_LESS(displacement, 1e-6); /* as above: the start is by statics */
    CHECK_LESS(velocity, 3 * STEPS * 2 * DBL_EPSILON * AT[0] / (2 * SHORT / 3));
}

/* Up to 512 lengths nothing is shifted. */
static void near_scenes_keep_their_origin(void **state) {
    (void)state;
    static Answer answer;
    solve(1, (double[3]){500, -500, 300}, &answer);
    CHECK_VECTOR(answer.origin, ((double[3]){0, 0, 0}), 0);
}

/* A saved state goes on with the same bits, and only with its own scene. */
static void saved_far_away(void **state) {
    (void)state;
    Rig rig, other;
    build(&rig, 2, (double[3]){5e5, 6e6, 0});
    build(&other, 2, (double[3]){5e5, 6.1e6, 0});
    CpsError err = {0};
    CpsEvolution *a, *b, *c;
    CHECK_INT(cps_evolution_create(&rig.scene, &a, &err), CPS_OK);
    CHECK_INT(cps_evolution_create(&rig.scene, &b, &err), CPS_OK);
    CHECK_INT(cps_evolution_create(&other.scene, &c, &err), CPS_OK);
    for (int k = 0; k < 2; k++) CHECK_INT(cps_evolution_step(a, &err), CPS_OK);
    const size_t size = cps_evolution_state_size(a);
    void *saved = malloc(size);
    assert_non_null(saved);
    cps_evolution_save(a, saved);
    CHECK_INT(cps_evolution_load(b, saved, size, &err), CPS_OK);
    CHECK_INT(cps_evolution_load(c, saved, size, &err), CPS_ERR_ARGUMENT);
    while (cps_evolution_remaining_count(a) > 0) {
        CHECK_INT(cps_evolution_step(a, &err), CPS_OK);
        CHECK_INT(cps_evolution_step(b, &err), CPS_OK);
    }
    const CpsLineView x = cps_evolution_line_view(a, 0), y = cps_evolution_line_view(b, 0);
    CHECK_INT(memcmp(x.position, y.position, 3 * NODES * sizeof *x.position), 0);
    free(saved);
    cps_evolution_destroy(a);
    cps_evolution_destroy(b);
    cps_evolution_destroy(c);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(shifted_scenes_agree),
                                       cmocka_unit_test(motion_far_away_agrees),
                                       cmocka_unit_test(near_scenes_keep_their_origin),
                                       cmocka_unit_test(saved_far_away)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
