/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of ends where it is known: a straight cable without weight, a node that sticks on
 * the ground, a node that slides there, and the three lines of the OC3-Hywind spar. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "capstan/evolve.h"
#include "check.h"
#include "straight_rope.h"

static CpsEvolution *evolution_of(const CpsScene *scene) {
    CpsEvolution *out = NULL;
    CpsError err = {0};
    if (cps_evolution_create(scene, &out, &err) != CPS_OK) fail_msg("%s", err.message);
    return out;
}

static void step(CpsEvolution *evolution) {
    assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
    assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
}

static CpsStiffness stiffness(const CpsEvolution *evolution, int line, int end,
                              CpsStiffnessKind kind) {
    CpsStiffness out;
    assert_int_equal(cps_evolution_stiffness(evolution, line, end, kind, &out, NULL), CPS_OK);
    return out;
}

static void assert_close(double found, double expected, double by) {
    if (!(fabs(found - expected) <= by)) fail_msg("%.17g, expected %.17g", found, expected);
}

/* T along a line of natural length L and stiffness EA, stretched to x: EA/L along it, and T/x
 * across, in whatever direction and from whatever number of elements. */
static void straight_cable(void **state) {
    (void)state;
    static const double TO[] = {3, -4, 12}; /* 13 m */
    for (int elements = 1; elements <= 64; elements *= 4) {
        const double from[6] = {0, 0, 0, TO[0], TO[1], TO[2]}, stiff = 5e4, length = 12.9;
        CpsLine line = straight_rope(from, length, elements, 0, stiff);
        line.end[CPS_END_B].kind = CPS_END_KIND_AT_START;
        CpsScene scene = cps_scene_default();
        scene.line_count = 1;
        scene.line = &line;
        CpsStage stage = cps_stage_default();
        stage.name = "rest";
        scene.stage = &stage;
        scene.stage_count = 1;
        CpsEvolution *evolution = evolution_of(&scene);
        assert_int_equal(stiffness(evolution, 0, 0, CPS_STIFFNESS_STEP).outcome,
                         CPS_STIFFNESS_OUTCOME_NO_STEP);
        step(evolution);
        const double tension = stiff * (13 / length - 1);
        for (int k = 0; k < 4; k++) {
            const CpsStiffness found =
                stiffness(evolution, 0, k / 2, k % 2 ? CPS_STIFFNESS_STICK : CPS_STIFFNESS_STEP);
            assert_int_equal(found.outcome, CPS_STIFFNESS_OUTCOME_FOUND);
            for (int i = 0; i < 9; i++) {
                const double tt = TO[i / 3] * TO[i % 3] / 169;
                assert_close(found.matrix[i],
                             stiff / length * tt + tension / 13 * ((i % 4 == 0) - tt),
                             1e-10 * stiff / length);
            }
        }
        cps_evolution_destroy(evolution);
    }
}

/* Two elements from an anchor over the ground to a point above it, the node between them on the
 * ground: pinned where it sticks. Where it slides along x, the friction mu R is turned by what the
 * end adds to R: the upper element changes the force on the node by f, the lower one holds it along
 * x by EA/l, and along x -(k u) + f_x + mu f_z = 0 (pulled up, R falls and with it the friction).
 */
static void node_on_the_ground(void **state) {
    (void)state;
    for (int slides = 0; slides < 2; slides++) {
        const double mu = slides ? 0.2 : 5, stiff = 1e4;
        const double point[6] = {0, 0, 0, 20, 0, 0};
        CpsObstacle bed = cps_obstacle_default();
        bed.name = "bed";
        bed.friction = mu;
        CpsLine line = straight_rope(point, 20, 2, 100, stiff);
        line.end[CPS_END_B].kind = CPS_END_KIND_AT_START;
        const CpsChange up = {.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {20.5, 0, 1}}};
        CpsStage stage = cps_stage_default();
        stage.name = "up";
        stage.change_count = 1;
        stage.change = &up;
        CpsScene scene = cps_scene_default();
        scene.obstacle_count = scene.line_count = scene.stage_count = 1;
        scene.obstacle = &bed;
        scene.line = &line;
        scene.stage = &stage;
        CpsEvolution *evolution = evolution_of(&scene);
        step(evolution);
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        assert_int_equal(view.state[1], slides ? CPS_NODE_STATE_SLIP : CPS_NODE_STATE_STICK);
        /* the upper element's own stiffness */
        const double dx = view.position[6] - view.position[3], dz = view.position[8],
                     size = sqrt(dx * dx + dz * dz), t[3] = {dx / size, 0, dz / size};
        const double tension = view.tension[1], across = tension / size, along = stiff / 10;
        double upper[9];
        for (int i = 0; i < 9; i++)
            upper[i] = along * t[i / 3] * t[i % 3] + across * ((i % 4 == 0) - t[i / 3] * t[i % 3]);
        CpsStiffness found = stiffness(evolution, 0, CPS_END_B, CPS_STIFFNESS_STICK);
        assert_int_equal(found.outcome, CPS_STIFFNESS_OUTCOME_FOUND);
        for (int i = 0; i < 9; i++) assert_close(found.matrix[i], upper[i], 1e-9 * along);
        found = stiffness(evolution, 0, CPS_END_B, CPS_STIFFNESS_STEP);
        assert_int_equal(found.outcome, CPS_STIFFNESS_OUTCOME_FOUND);
        /* the node's moves in x and y by a move of the end along each axis */
        const double lower = stiff / 10, side = view.tension[0] / view.position[3] + across +
                                                0.2 * view.reaction[1] / (view.position[3] - 10);
        for (int a = 0; a < 3; a++) {
            const double along_x =
                (upper[a] + mu * upper[6 + a]) / (lower + upper[0] + mu * upper[6]);
            const double u = slides && a != 1 ? along_x : 0,
                         v = slides && a == 1 ? across / side : 0;
            for (int b = 0; b < 3; b++)
                assert_close(found.matrix[3 * b + a],
                             upper[3 * b + a] - upper[3 * b] * u - upper[3 * b + 1] * v,
                             1e-9 * along);
        }
        /* the anchor lies on the ground */
        assert_int_equal(stiffness(evolution, 0, CPS_END_A, CPS_STIFFNESS_STEP).outcome,
                         CPS_STIFFNESS_OUTCOME_TOUCHES);
        cps_evolution_destroy(evolution);
    }
}

/* The sum over the three lines of OC3-Hywind at rest (Jonkman 2010: anchors at radius 853.87 m and
 * depth 320 m, fairleads at 5.2 m and 70 m, 902.2 m, 698.094 N/m, 384.243 MN). */
typedef struct Spar {
    double surge, heave, yaw, pull; /* [N/m], [N/m], [N m/rad], [N] */
} Spar;

static Spar spar_of(int elements) {
    static char name[3][2] = {"a", "b", "c"};
    CpsObstacle bed = cps_obstacle_default();
    bed.name = "bed";
    bed.point[2] = -320;
    CpsLine line[3];
    for (int k = 0; k < 3; k++) {
        const double x = cos(2 * acos(-1) * k / 3), y = sin(2 * acos(-1) * k / 3);
        line[k] = cps_line_default();
        line[k].name = name[k];
        line[k].length = 902.2;
        line[k].element_count = elements;
        line[k].weight = 698.094;
        line[k].stiffness = 384.243e6;
        line[k].start.kind = CPS_START_STATIC;
        line[k].end[CPS_END_A] = (CpsEnd){CPS_END_KIND_HELD, {853.87 * x, 853.87 * y, -320}};
        line[k].end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {5.2 * x, 5.2 * y, -70}};
    }
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = 1;
    scene.obstacle = &bed;
    scene.line_count = 3;
    scene.line = line;
    CpsEvolution *evolution = evolution_of(&scene);
    step(evolution);
    Spar out = {0};
    for (int k = 0; k < 3; k++) {
        const CpsStiffness found = stiffness(evolution, k, CPS_END_B, CPS_STIFFNESS_STEP);
        assert_int_equal(found.outcome, CPS_STIFFNESS_OUTCOME_FOUND);
        const CpsEndReport end = cps_evolution_line_report(evolution, k).end[CPS_END_B];
        const double x = end.position[0], y = end.position[1], turn[2] = {-y, x};
        out.surge += found.matrix[0];
        out.heave += found.matrix[8];
        for (int i = 0; i < 4; i++)
            out.yaw += turn[i / 2] * found.matrix[3 * (i / 2) + i % 2] * turn[i % 2];
        out.yaw -= end.force[0] * x + end.force[1] * y;
        out.pull += end.force[2];
    }
    cps_evolution_destroy(evolution);
    return out;
}

/* Against elastic catenaries. Surge and heave change by jumps as the line touches down node by node
 * (0.42 and 0.62 % at 400 elements); the mean over meshes of many phases is that of the catenary,
 * to what 24 phases leave of the jumps. */
static void oc3_spar(void **state) {
    (void)state;
    enum { MESHES = 24 };
    Spar mean = {0};
    for (int k = 0; k < MESHES; k++) {
        const Spar one = spar_of(389 + k);
        assert_close(one.surge, 41181.2, 0.005 * 41181.2);
        assert_close(one.heave, 11941.5, 0.007 * 11941.5);
        assert_close(one.yaw, 1.156668e7, 1e-4 * 1.156668e7);
        assert_close(one.pull, 1607182, 1e-4 * 1607182);
        mean.surge += one.surge / MESHES;
        mean.heave += one.heave / MESHES;
    }
    assert_close(mean.surge, 41181.2, 1e-3 * 41181.2);
    assert_close(mean.heave, 11941.5, 1e-3 * 11941.5);
}

/* A small cycle has friction also about where statics has put the line without: an anchor line laid
 * by statics keeps its stiffness in a step in which nothing changes. */
static void small_cycle_about_statics(void **state) {
    (void)state;
    CpsObstacle bed = cps_obstacle_default();
    bed.name = "bed";
    bed.friction = 0.5;
    CpsLine line = straight_rope(NULL, 100, 50, 200, 1e6);
    line.start = (CpsStart){.kind = CPS_START_STATIC};
    line.end[CPS_END_A] = (CpsEnd){CPS_END_KIND_HELD, {0, 0, 0}};
    line.end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {85, 0, 30}};
    CpsStage stage = cps_stage_default();
    stage.name = "rest";
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = scene.line_count = scene.stage_count = 1;
    scene.obstacle = &bed;
    scene.line = &line;
    scene.stage = &stage;
    for (int policy = 0; policy < 2; policy++) {
        scene.friction_policy = (CpsFrictionPolicy)policy;
        CpsEvolution *evolution = evolution_of(&scene);
        CpsStiffness found[2];
        for (int k = 0; k < 2; k++) {
            step(evolution);
            assert_true(cps_evolution_line_report(evolution, 0).grounded > 20);
            found[k] = stiffness(evolution, 0, CPS_END_B, CPS_STIFFNESS_STICK);
            assert_int_equal(found[k].outcome, CPS_STIFFNESS_OUTCOME_FOUND);
        }
        /* the line moves by what the two programs differ */
        for (int i = 0; i < 9; i++)
            assert_close(found[0].matrix[i], found[1].matrix[i], 1e-6 * found[1].matrix[0]);
        cps_evolution_destroy(evolution);
    }
}

static CpsStiffness after_move(CpsEvolution *evolution, const double to[3]) {
    const CpsChange change = {.line = 0,
                              .end = CPS_END_B,
                              .to = {CPS_END_KIND_HELD, {to[0], to[1], to[2]}}};
    CpsStage move = cps_stage_default();
    move.change_count = 1;
    move.change = &change;
    assert_int_equal(cps_evolution_move(evolution, &move, NULL), CPS_OK);
    const CpsStiffness found = stiffness(evolution, 0, CPS_END_B, CPS_STIFFNESS_STEP);
    for (int i = 0; i < 9; i++) assert_true(found.matrix[i] == 0);
    return found;
}

/* Arguments that are none. */
static void wrong_arguments(void **state) {
    (void)state;
    const double point[6] = {0, 0, 0, 10, 0, 0};
    CpsLine line = straight_rope(point, 10, 4, 0, INFINITY);
    CpsScene scene = cps_scene_default();
    scene.line_count = 1;
    scene.line = &line;
    CpsEvolution *evolution = evolution_of(&scene);
    CpsStiffness out;
    CpsError err;
    assert_int_equal(cps_evolution_stiffness(NULL, 0, 0, CPS_STIFFNESS_STEP, &out, &err),
                     CPS_ERR_ARGUMENT);
    assert_int_equal(cps_evolution_stiffness(evolution, 0, 0, CPS_STIFFNESS_STEP, NULL, &err),
                     CPS_ERR_ARGUMENT);
    static const int WRONG[][3] = {{-1, 0, 0}, {1, 0, 0}, {0, 2, 0},
                                   {0, -1, 0}, {0, 0, 2}, {0, 0, -1}};
    for (size_t i = 0; i < sizeof WRONG / sizeof *WRONG; i++)
        assert_int_equal(cps_evolution_stiffness(evolution, WRONG[i][0], WRONG[i][1],
                                                 (CpsStiffnessKind)WRONG[i][2], &out, &err),
                         CPS_ERR_ARGUMENT);
    cps_evolution_destroy(evolution);
    assert_string_equal(cps_stiffness_name(CPS_STIFFNESS_STICK), "stick");
    assert_string_equal(cps_stiffness_outcome_name(CPS_STIFFNESS_OUTCOME_TOUCHES), "touches");
    assert_string_equal(cps_stiffness_name((CpsStiffnessKind)9), "unknown");
    assert_string_equal(cps_stiffness_outcome_name((CpsStiffnessOutcome)9), "unknown");
    assert_true(strlen(cps_stiffness_text(CPS_STIFFNESS_STEP)) > 0);
    assert_true(strlen(cps_stiffness_outcome_text(CPS_STIFFNESS_OUTCOME_LOOSE)) > 0);
}

/* Lines that have no stiffness: an inextensible one without a force, moved to where it does not
 * reach, and one of which a part lies loose on a bed without friction. */
static void refusals(void **state) {
    (void)state;
    const double point[6] = {0, 0, 0, 10, 0, 0};
    CpsLine line = straight_rope(point, 10, 4, 0, INFINITY);
    line.end[CPS_END_B].kind = CPS_END_KIND_AT_START;
    CpsScene scene = cps_scene_default();
    scene.line_count = 1;
    scene.line = &line;
    CpsEvolution *evolution = evolution_of(&scene);
    assert_int_equal(after_move(evolution, (const double[3]){9, 0, 0}).outcome,
                     CPS_STIFFNESS_OUTCOME_NO_STEP);
    assert_int_equal(after_move(evolution, (const double[3]){11, 0, 0}).outcome,
                     CPS_STIFFNESS_OUTCOME_NO_STEP);
    cps_evolution_destroy(evolution);

    CpsObstacle bed = cps_obstacle_default();
    bed.name = "bed";
    scene.obstacle_count = 1;
    scene.obstacle = &bed;
    line = straight_rope(NULL, 20, 40, 10, 1e5);
    line.start = (CpsStart){.kind = CPS_START_STATIC};
    line.end[CPS_END_A] = (CpsEnd){CPS_END_KIND_HELD, {0, 0, 0.5}};
    line.end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {10, 0, 0.5}};
    evolution = evolution_of(&scene);
    step(evolution);
    assert_int_equal(after_move(evolution, (const double[3]){10.1, 0, 0.5}).outcome,
                     CPS_STIFFNESS_OUTCOME_LOOSE);
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(straight_cable),
                                       cmocka_unit_test(node_on_the_ground),
                                       cmocka_unit_test(oc3_spar),
                                       cmocka_unit_test(small_cycle_about_statics),
                                       cmocka_unit_test(wrong_arguments),
                                       cmocka_unit_test(refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
