/* SPDX-License-Identifier: BSD-3-Clause */
/* Rigid bodies that lines hold: answers by hand, the stiffness of a body against poses beside its
 * own, OC3-Hywind with its spar, and what is refused. */
#include <stdlib.h>
#include <string.h>

#include "cases.h"

static const double RADIAN = 57.295779513082323;

enum { LINES = 4 };

/* A body with up to four lines: the points 0 .. 3 are anchors, 4 .. 7 are on the body. */
typedef struct Mooring {
    CpsLine line[LINES];
    CpsPoint point[2 * LINES];
    CpsBody body;
    CpsObstacle bed;
    CpsScene scene;
} Mooring;

static void begin(Mooring *m, int lines) {
    static const char *const LINE[] = {"one", "two", "three", "four"}, *const POINT[] = {
                                                                           "a1", "a2", "a3", "a4",
                                                                           "b1", "b2", "b3", "b4"};
    *m = (Mooring){.scene = cps_scene_default(),
                   .body = cps_body_default(),
                   .bed = cps_obstacle_default()};
    m->body.name = "body";
    m->body.kind = CPS_BODY_KIND_FREE;
    m->bed.name = "bed";
    for (int i = 0; i < 2 * lines; i++) {
        m->point[i] = cps_point_default();
        m->point[i].name = POINT[i < lines ? i : LINES + i - lines];
        if (i >= lines) m->point[i].kind = CPS_POINT_KIND_ON_BODY;
    }
    for (int i = 0; i < lines; i++) {
        m->line[i] = cps_line_default();
        m->line[i].name = LINE[i];
        m->line[i].start.kind = CPS_START_STATIC;
        for (int end = 0; end < 2; end++) {
            m->line[i].end[end].kind = CPS_END_KIND_POINT;
            m->line[i].end_point[end] = end * lines + i;
        }
    }
    m->scene.line_count = lines;
    m->scene.line = m->line;
    m->scene.point_count = 2 * lines;
    m->scene.point = m->point;
    m->scene.body_count = 1;
    m->scene.body = &m->body;
}

static CpsEvolution *evolve(const CpsScene *scene) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

static CpsBodyReport step(CpsEvolution *evolution) {
    CpsError err;
    assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
    assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    return cps_evolution_body_report(evolution, 0);
}

/* A body of weight W hangs from one string of length L at the point (0, 0, l) above its centre of
 * gravity, and is pulled aside with F there: string and body are in line with the force, at the
 * angle atan(F/W), and the string has |(F, W)|. */
static void a_pendulum(void **unused) {
    static const double L = 2, ARM = 0.7, W = 900, F = 500, EA = 1e6;
    static const double START[] = {0, -30, 40};
    (void)unused;
    for (int k = 0; k < 3; k++) {
        Mooring m;
        begin(&m, 1);
        m.line[0].length = L;
        m.line[0].element_count = 1;
        m.line[0].stiffness = EA;
        m.point[1].position[2] = ARM;
        m.body.position[0] = 0.1;
        m.body.position[2] = -L - ARM;
        m.body.rotation[0] = cos(0.5 * START[k] / RADIAN);
        m.body.rotation[2] = sin(0.5 * START[k] / RADIAN);
        m.body.weight = W;
        m.body.force[0] = F;
        m.body.fixed[5] = true; /* nothing holds it about its string */
        CpsEvolution *evolution = evolve(&m.scene);
        const CpsBodyReport found = step(evolution);
        const double pull = hypot(F, W), reach = L * (1 + pull / EA) + ARM;
        CHECK_NEAR(found.position[0], reach * F / pull, 1e-8);
        CHECK_NEAR(found.position[1], 0, 1e-8);
        CHECK_NEAR(found.position[2], -reach * W / pull, 1e-8);
        const double tilt = -2 * atan2(found.rotation[2], found.rotation[0]);
        CHECK_NEAR(sin(tilt), F / pull, 1e-8);
        CHECK_NEAR(cos(tilt), W / pull, 1e-8);
        CHECK_NEAR(hypot(found.lines[0], found.lines[2]), pull, 1e-5);
        assert_true(found.is_stable);
        cps_evolution_destroy(evolution);
    }
}

/* What nothing holds in some direction is not stable, whatever its rounding says: a float with a
 * line that hangs from it, slack, which may drift; and a pendulum without an axis that is fixed. */
static void neutral_poses(void **unused) {
    (void)unused;
    for (int k = 0; k < 40; k++) {
        const double heading = 0.37 + 2.1 * k;
        Mooring m;
        begin(&m, 1);
        m.line[0].length = 9;
        m.line[0].weight = 1.3;
        m.line[0].element_count = 6;
        m.line[0].stiffness = k % 4 == 1 ? INFINITY : k % 4 == 2 ? 7e7 : 700;
        m.point[1].position[0] = 0.3 * cos(heading);
        m.point[1].position[1] = 0.3 * sin(heading);
        m.body.weight = 80;
        if (k % 2) {
            m.point[0].position[0] = 5 * cos(heading);
            m.point[0].position[1] = 5 * sin(heading);
            m.point[0].position[2] = -5.8;
            m.body.buoyancy = 120;
            const double stiff[] = {0, 0, 130, 30, 40, 9};
            for (int i = 0; i < 6; i++) m.body.hydrostatics[7 * i] = stiff[i];
            m.bed.normal[2] = 1;
            m.bed.point[2] = -6;
            m.scene.obstacle = &m.bed;
            m.scene.obstacle_count = 1;
        } else {
            m.point[1].position[2] = 0.4;
            m.body.position[2] = -9.6;
            m.body.centre_of_gravity[2] = -0.2;
        }
        CpsEvolution *evolution = evolve(&m.scene);
        const CpsBodyReport found = step(evolution);
        assert_true(found.has_place);
        if (found.is_stable) fail_msg("pose %d is said to be stable", k);
        cps_evolution_destroy(evolution);
    }
}

/* The vector of the one turn by which a rotation follows another. */
static void turn_between(const double from[4], const double to[4], double turn[3]) {
    const double q[4] = {
        to[0] * from[0] + to[1] * from[1] + to[2] * from[2] + to[3] * from[3],
        to[1] * from[0] - to[0] * from[1] - to[2] * from[3] + to[3] * from[2],
        to[2] * from[0] - to[0] * from[2] - to[3] * from[1] + to[1] * from[3],
        to[3] * from[0] - to[0] * from[3] - to[1] * from[2] + to[2] * from[1],
    };
    const double size = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]),
                 angle = 2 * atan2(size, fabs(q[0]));
    for (int i = 0; i < 3; i++)
        turn[i] = size > 0 ? (q[0] < 0 ? -1 : 1) * angle * q[1 + i] / size : 0;
}

/* With one axis fixed a body turns about the two others, by large angles too: what it turns by in a
 * step has nothing about the fixed one, however the pose was found, and the moments about the two
 * others balance. Rotations that follow each other about them would add up to one about the third:
 * up to 30 degrees here. */
static void one_axis_is_fixed(void **unused) {
    static const double MOMENT[][3] = {{10, 5, 8}, {30, 20, -10}, {60, -40, 20}, {100, 70, 50}};
    (void)unused;
    for (int k = 0; k < 12; k++) {
        const int axis = k % 3;
        Mooring m;
        begin(&m, 1);
        m.point[0].position[0] = 3;
        m.point[0].position[2] = -8;
        m.point[1].position[0] = 0.3;
        m.point[1].position[1] = 0.1;
        m.point[1].position[2] = -0.4;
        m.line[0].length = 9;
        m.line[0].weight = 1.3;
        m.line[0].element_count = 6;
        m.line[0].stiffness = 500;
        m.body.weight = 80;
        const double stiff[] = {0, 0, 100, 60, 30, 45}, centre[] = {0.1, 0.05, -0.5};
        for (int i = 0; i < 6; i++) m.body.hydrostatics[7 * i] = stiff[i];
        memcpy(m.body.centre_of_gravity, centre, sizeof centre);
        m.body.fixed[3 + axis] = true;
        CpsEvolution *evolution = evolve(&m.scene);
        double turn[3];
        CpsBodyReport was = step(evolution);
        turn_between(m.body.rotation, was.rotation, turn);
        CHECK_NEAR(turn[axis], 0, 1e-14);
        CpsBodyChange change = {.kind = CPS_BODY_KIND_FREE};
        memcpy(change.moment, MOMENT[k / 3], sizeof change.moment);
        CpsStage stage = cps_stage_default();
        stage.body_change_count = 1;
        stage.body_change = &change;
        CpsError err;
        if (cps_evolution_move(evolution, &stage, &err) != CPS_OK) fail_msg("%s", err.message);
        const CpsBodyReport now = cps_evolution_body_report(evolution, 0);
        assert_true(now.has_place);
        turn_between(was.rotation, now.rotation, turn);
        CHECK_NEAR(turn[axis], 0, 1e-14); /* a few roundings of a rotation of order one */
        assert_true(fabs(turn[(axis + 1) % 3]) > 0.01 && fabs(turn[(axis + 2) % 3]) > 0.01);
        for (int i = 0; i < 3; i++)
            if (i != axis)
                CHECK_NEAR(now.lines[3 + i] + now.load[3 + i] + now.support[3 + i], 0, 1e-4);
        cps_evolution_destroy(evolution);
    }
}

/* A float of buoyancy B above its weight on two equal strings, with hydrostatics in heave: the
 * strings have half each of what the heave leaves. */
static void a_float_on_two_strings(void **unused) {
    static const double L = 5, EA = 2e5, EXCESS = 4000, C33 = 3e4, ARM = 1.5;
    (void)unused;
    Mooring m;
    begin(&m, 2);
    for (int i = 0; i < 2; i++) {
        m.line[i].length = L;
        m.line[i].element_count = 1;
        m.line[i].stiffness = EA;
        m.point[i].position[0] = m.point[2 + i].position[0] = i == 0 ? -ARM : ARM;
    }
    m.body.position[2] = L;
    m.body.weight = 1000;
    m.body.buoyancy = 1000 + EXCESS;
    m.body.centre_of_buoyancy[2] = 0.4;
    m.body.hydrostatics[14] = C33;
    for (int i = 0; i < 2; i++) m.body.fixed[3 + 2 * i] = true; /* roll and yaw */
    CpsEvolution *evolution = evolve(&m.scene);
    const CpsBodyReport found = step(evolution);
    /* B - W - C z = 2 EA z/L */
    const double z = EXCESS / (C33 + 2 * EA / L);
    CHECK_NEAR(found.position[2], L + z, 1e-9);
    CHECK_NEAR(found.lines[2], -2 * EA * z / L, 1e-4);
    CHECK_NEAR(found.stiffness[14], C33 + 2 * EA / L, 1e-3);
    /* aside: the strings' T/L' each; in pitch: EA/L x^2 of each, and the buoyancy at its height */
    const double t = EA * z / L, aside = 2 * t / (L + z);
    CHECK_RELATIVE(found.stiffness[0], aside, 1e-9);
    CHECK_RELATIVE(found.stiffness[28], 2 * EA / L * ARM * ARM + 5000 * 0.4, 1e-9);
    cps_evolution_destroy(evolution);
}

/* A light body on a strong line stays where it is in its fixed directions, to the bit, whatever the
 * line pulls: 1e6 N here, on a weight of 1 N. */
static void fixed_directions_stay(void **unused) {
    (void)unused;
    for (int free = 0; free < 2; free++) { /* 1: along y, in which nothing else acts */
        Mooring m;
        begin(&m, 1);
        m.line[0].length = 10;
        m.line[0].element_count = 1;
        m.line[0].stiffness = 1e6;
        m.point[0].position[0] = m.point[1].position[0] = 1;
        m.point[0].position[1] = 20;
        m.body.weight = 1;
        for (int i = 0; i < 6; i++) m.body.fixed[i] = !(free && i == 1);
        CpsEvolution *evolution = evolve(&m.scene);
        const CpsBodyReport found = step(evolution);
        for (int i = 0; i < 3; i++)
            if (m.body.fixed[i]) CHECK_NEAR(found.position[i], 0, 0);
        for (int i = 0; i < 4; i++) CHECK_NEAR(found.rotation[i], i == 0, 0);
        const double pull = found.lines[1];
        CHECK_NEAR(pull, free ? 0 : 1e6, 1e-4);
        CHECK_NEAR(found.support[5], free ? 0 : -1e6, 1e-4);
        cps_evolution_destroy(evolution);
    }
}

/* Nothing holds a body off an obstacle: one that its line lets hang below the bed has no pose. */
static void below_the_bed(void **unused) {
    (void)unused;
    for (int deep = 0; deep < 2; deep++) {
        Mooring m;
        CpsError err;
        begin(&m, 1);
        m.line[0].length = 5;
        m.line[0].element_count = 2;
        m.line[0].stiffness = 1e5;
        m.point[0].position[2] = 2;
        m.body.weight = 100;
        for (int i = 3; i < 6; i++) m.body.fixed[i] = true;
        m.bed.point[2] = deep ? -1 : -4;
        m.scene.obstacle_count = 1;
        m.scene.obstacle = &m.bed;
        CpsEvolution *evolution = evolve(&m.scene);
        assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
        const CpsBodyReport found = cps_evolution_body_report(evolution, 0);
        CHECK_NEAR(found.position[2], 2 - 5 * (1 + 100 / 1e5), 1e-8);
        CHECK_INT(found.has_place, !deep);
        CHECK_INT(cps_evolution_report(evolution).outcome,
                  deep ? CPS_OUTCOME_STALLED : CPS_OUTCOME_SOLVED);
        cps_evolution_destroy(evolution);
    }
}

static void held_wrench(const Mooring *m, const double position[3], const double rotation[4],
                        double wrench[6]) {
    Mooring held = *m;
    held.scene.line = held.line;
    held.scene.point = held.point;
    held.scene.body = &held.body;
    held.scene.obstacle = &held.bed;
    held.body.kind = CPS_BODY_KIND_HELD;
    memset(held.body.force, 0, sizeof held.body.force);
    memset(held.body.moment, 0, sizeof held.body.moment);
    memcpy(held.body.position, position, sizeof held.body.position);
    memcpy(held.body.rotation, rotation, sizeof held.body.rotation);
    CpsEvolution *evolution = evolve(&held.scene);
    memcpy(wrench, step(evolution).lines, 6 * sizeof *wrench);
    cps_evolution_destroy(evolution);
}

/* The rotation by the vector v after a rotation. */
static void turned(const double by[3], const double q[4], double out[4]) {
    const double angle = sqrt(by[0] * by[0] + by[1] * by[1] + by[2] * by[2]),
                 s = angle > 0 ? sin(angle / 2) / angle : 0.5, w = cos(angle / 2), x = s * by[0],
                 y = s * by[1], z = s * by[2];
    out[0] = w * q[0] - x * q[1] - y * q[2] - z * q[3];
    out[1] = w * q[1] + x * q[0] + y * q[3] - z * q[2];
    out[2] = w * q[2] - x * q[3] + y * q[0] + z * q[1];
    out[3] = w * q[3] + x * q[2] - y * q[1] + z * q[0];
}

/* The stiffness of a heeled body on three hanging lines is the derivative of what the lines do to
 * it, by poses beside its own: central differences by two distances, extrapolated. */
static void stiffness_of_a_heeled_body(void **unused) {
    (void)unused;
    Mooring m;
    begin(&m, 3);
    for (int i = 0; i < 3; i++) {
        const double turn = (120 * i + 10 * i * i) / RADIAN;
        m.line[i].length = 33 + i;
        m.line[i].element_count = 25;
        m.line[i].weight = 60 + 20 * i;
        m.line[i].stiffness = 3e6;
        m.point[i].position[0] = 25 * cos(turn);
        m.point[i].position[1] = 25 * sin(turn);
        m.point[i].position[2] = 18 + i;
        m.point[3 + i].position[0] = 3 * cos(turn);
        m.point[3 + i].position[1] = 2 * sin(turn);
        m.point[3 + i].position[2] = 1 + 0.3 * i;
    }
    m.body.weight = 9000;
    m.body.centre_of_gravity[2] = -0.5;
    m.body.moment[0] = 2500;
    m.body.moment[1] = -4000;
    m.body.force[1] = 800;
    CpsEvolution *evolution = evolve(&m.scene);
    const CpsBodyReport found = step(evolution);
    cps_evolution_destroy(evolution);
    const double heel = 2 * acos(fabs(found.rotation[0])) * RADIAN;
    CHECK_GREATER(heel, 5);
    double largest = 0;
    for (int column = 0; column < 6; column++) {
        double by[2][6], wrench[2][6];
        for (int fine = 0; fine < 2; fine++) {
            const double size = (column < 3 ? 2e-4 : 1e-4) / (fine + 1);
            for (int side = 0; side < 2; side++) {
                const double move = side ? size : -size;
                double position[3], rotation[4], turn[3] = {0};
                memcpy(position, found.position, sizeof position);
                memcpy(rotation, found.rotation, sizeof rotation);
                if (column < 3) position[column] += move;
                if (column >= 3) turn[column - 3] = move;
                turned(turn, found.rotation, rotation);
                held_wrench(&m, position, rotation, wrench[side]);
            }
            for (int i = 0; i < 6; i++) by[fine][i] = -(wrench[1][i] - wrench[0][i]) / (2 * size);
        }
        for (int i = 0; i < 6; i++) {
            /* the lines' part: the rest is that of the weight, which turns about its centre */
            const double lines = (4 * by[1][i] - by[0][i]) / 3;
            double own = found.stiffness[6 * i + column];
            if (i >= 3 && column >= 3) {
                const double *q = found.rotation, z = m.body.centre_of_gravity[2];
                const double arm[3] = {2 * z * (q[1] * q[3] + q[0] * q[2]),
                                       2 * z * (q[2] * q[3] - q[0] * q[1]),
                                       z * (1 - 2 * (q[1] * q[1] + q[2] * q[2]))},
                             f[3] = {0, 0, -m.body.weight};
                own -= (i == column ? f[2] * arm[2] : 0) - arm[i - 3] * f[column - 3];
            }
            const double size = fabs(found.stiffness[7 * i]) + fabs(found.stiffness[7 * column]);
            largest = fmax(largest, fabs(own - lines) / size);
        }
    }
    CHECK_LESS(largest, 1e-5); /* forces to 1e-11 of the largest over displacements of 1e-5 */
}

/* OC3-Hywind: three lines at 120 degrees, its spar with the published weight, centres and
 * hydrostatics (NREL/TP-500-47535), and the thrust of its turbine at 90 m. */
static void spar(Mooring *m, int elements, double friction) {
    begin(m, 3);
    m->scene.gravity[2] = -9.80665;
    m->scene.obstacle_count = 1;
    m->scene.obstacle = &m->bed;
    m->bed.point[2] = -320;
    m->bed.friction = friction;
    for (int i = 0; i < 3; i++) {
        const double x = cos(120 * i / RADIAN), y = sin(120 * i / RADIAN);
        m->line[i].length = 902.2;
        m->line[i].element_count = elements;
        m->line[i].weight = 698.094;
        m->line[i].stiffness = 384.243e6;
        const double anchor[3] = {853.87 * x, 853.87 * y, -320},
                     fairlead[3] = {5.2 * x, 5.2 * y, -70};
        memcpy(m->point[i].position, anchor, sizeof anchor);
        memcpy(m->point[3 + i].position, fairlead, sizeof fairlead);
    }
    m->body.weight = 8066048 * 9.80665;
    m->body.buoyancy = m->body.weight + 1607182;
    m->body.centre_of_gravity[2] = -78;
    m->body.hydrostatics[14] = 332941;
    m->body.hydrostatics[21] = m->body.hydrostatics[28] = -4.999e9;
    m->body.hydrostatics[35] = 98.34e6;
}

static void oc3_at_rest(void **unused) {
    (void)unused;
    Mooring m;
    spar(&m, 400, 0);
    for (int i = 0; i < 6; i++) m.body.fixed[i] = true;
    CpsEvolution *evolution = evolve(&m.scene);
    const CpsBodyReport found = step(evolution);
    CHECK_RELATIVE(found.lines[2], -1607182, 1e-4);
    CHECK_RELATIVE(found.stiffness[35] - 98.34e6, 1.156668e7, 1e-4);
    /* touchdown goes from node to node: one mesh is within a half and 0.7 of a hundred */
    CHECK_RELATIVE(found.stiffness[0], 41181.2, 5e-3);
    CHECK_RELATIVE(found.stiffness[14] - 332941, 11941.5, 7e-3);
    CHECK_NEAR(found.support[2], 0, 200);
    cps_evolution_destroy(evolution);
}

/* The stiffness of the step is that of the report; of a small cycle it is no less in surge, and
 * more where friction holds the lines on the bed. */
static void compare_stiffness(const CpsEvolution *evolution, const CpsBodyReport *found,
                              bool rough) {
    CpsBodyStiffness by[2];
    CpsError err;
    for (int kind = 0; kind < 2; kind++) {
        assert_int_equal(cps_evolution_body_stiffness(evolution, 0, (CpsStiffnessKind)kind,
                                                      &by[kind], &err),
                         CPS_OK);
        assert_int_equal(by[kind].outcome, CPS_STIFFNESS_OUTCOME_FOUND);
    }
    double most = 0;
    for (int i = 0; i < 36; i++) most = fmax(most, fabs(found->stiffness[i]));
    for (int i = 0; i < 36; i++)
        CHECK_NEAR(by[CPS_STIFFNESS_STEP].matrix[i], found->stiffness[i], 1e-9 * most);
    const double surge = by[CPS_STIFFNESS_STICK].matrix[0] - found->stiffness[0];
    if (rough)
        CHECK_GREATER(surge, 100);
    else
        CHECK_NEAR(surge, 0, 1e-6 * found->stiffness[0]);
    CHECK_INT(cps_evolution_body_stiffness(evolution, 1, CPS_STIFFNESS_STEP, by, &err),
              CPS_ERR_ARGUMENT);
}

/* Thrust on and off: with friction the spar comes back to another place than it left, and from the
 * second cycle on the loop is closed; without, it comes back to where it was. */
static void oc3_thrust_on_and_off(void **unused) {
    static const double THRUST = 400e3, HEIGHT = 90;
    (void)unused;
    for (int rough = 0; rough < 2; rough++) {
        Mooring m;
        CpsBodyChange change[6];
        CpsStage stage[6];
        double at[7];
        spar(&m, 100, rough ? 0.5 : 0);
        for (int k = 0; k < 6; k++) {
            change[k] = (CpsBodyChange){.kind = CPS_BODY_KIND_FREE};
            if (k % 2 == 0) change[k].force[0] = THRUST;
            if (k % 2 == 0) change[k].moment[1] = HEIGHT * THRUST;
            stage[k] = cps_stage_default();
            stage[k].name = "thrust";
            stage[k].step_count = 4;
            stage[k].body_change_count = 1;
            stage[k].body_change = &change[k];
        }
        m.scene.stage_count = 6;
        m.scene.stage = stage;
        CpsEvolution *evolution = evolve(&m.scene);
        at[0] = step(evolution).position[0];
        for (int k = 0; k < 6; k++) {
            CpsBodyReport found = {0};
            for (int i = 0; i < 4; i++) found = step(evolution);
            at[k + 1] = found.position[0];
            assert_true(found.is_stable);
            compare_stiffness(evolution, &found, rough);
        }
        CHECK_BETWEEN(at[1], 13, 15);
        if (rough) {
            CHECK_GREATER(at[2] - at[0], 0.01);
            CHECK_NEAR(at[6], at[4], 1e-3);
        } else {
            CHECK_NEAR(at[2], at[0], 1e-7);
            CHECK_NEAR(at[6], at[0], 1e-7);
        }
        cps_evolution_destroy(evolution);
    }
}

/* A held body that is moved, released, where it stays, and pulled; a move that is taken back, a
 * state that is loaded, and two threads have the same bits. */
static void moves_of_bodies(void **unused) {
    (void)unused;
    Mooring m;
    CpsError err;
    spar(&m, 40, 0.5);
    m.body.kind = CPS_BODY_KIND_HELD;
    CpsEvolution *evolution = evolve(&m.scene);
    m.scene.solver.thread_count = 2;
    CpsEvolution *other = evolve(&m.scene);
    (void)step(evolution);
    CpsBodyChange change = {.kind = CPS_BODY_KIND_HELD,
                            .position = {4, 1, 0},
                            .rotation = {cos(0.02), 0, sin(0.02), 0}};
    CpsStage move = cps_stage_default();
    move.body_change_count = 1;
    move.body_change = &change;
    assert_int_equal(cps_evolution_move(evolution, &move, &err), CPS_OK);
    const CpsBodyReport held = cps_evolution_body_report(evolution, 0);
    CHECK_VECTOR(held.position, change.position, 0);
    for (int i = 0; i < 6; i++) CHECK_NEAR(held.lines[i] + held.load[i] + held.support[i], 0, 1e-4);
    change = (CpsBodyChange){.kind = CPS_BODY_KIND_FREE};
    memcpy(change.force, held.support, sizeof change.force);
    memcpy(change.moment, &held.support[3], sizeof change.moment);
    assert_int_equal(cps_evolution_move(evolution, &move, &err), CPS_OK);
    CHECK_VECTOR(cps_evolution_body_report(evolution, 0).position, held.position, 1e-6);
    void *state = malloc(cps_evolution_state_size(evolution));
    cps_evolution_save(evolution, state);
    change.force[0] += 50e3;
    assert_int_equal(cps_evolution_move(evolution, &move, &err), CPS_OK);
    const CpsBodyReport pulled = cps_evolution_body_report(evolution, 0);
    CHECK_GREATER(pulled.position[0], held.position[0] + 0.1);
    assert_int_equal(cps_evolution_take_back(evolution, &err), CPS_OK);
    assert_int_equal(cps_evolution_load(other, state, cps_evolution_state_size(other), &err),
                     CPS_OK);
    assert_int_equal(cps_evolution_move(evolution, &move, &err), CPS_OK);
    assert_int_equal(cps_evolution_move(other, &move, &err), CPS_OK);
    const CpsBodyReport again = cps_evolution_body_report(evolution, 0),
                        loaded = cps_evolution_body_report(other, 0);
    assert_memory_equal(again.position, pulled.position, sizeof pulled.position);
    assert_memory_equal(again.stiffness, pulled.stiffness, sizeof pulled.stiffness);
    assert_memory_equal(loaded.position, pulled.position, sizeof pulled.position);
    assert_memory_equal(loaded.rotation, pulled.rotation, sizeof pulled.rotation);
    free(state);
    cps_evolution_destroy(evolution);
    cps_evolution_destroy(other);
}

/* Angles of a rotation that is made of them, R = Rz(yaw) Ry(pitch) Rx(roll), as a product of
 * quaternions about axes that stay: roll first. Where pitch is upright, only roll - yaw, or their
 * sum, is left, and roll is 0. Quaternions of any length and either sign. */
static void angles_of_a_pose(void **unused) {
    (void)unused;
    static const double ROLL[] = {0, 0.3, -2.9, 3.1, 1e-9}, PITCH[] = {0, -1.2, 1.5, -1e-8},
                        YAW[] = {0, -3.0, 1.1, 2e-7}, SCALE[] = {1, -3};
    CpsBodyReport report = {0};
    double angle[3], heel;
    for (int n = 0; n < 5 * 4 * 4 * 2; n++) {
        const double roll = ROLL[n % 5], pitch = PITCH[n / 5 % 4], yaw = YAW[n / 20 % 4];
        double about_x[4], about_xy[4];
        turned((const double[]){roll, 0, 0}, (const double[]){1, 0, 0, 0}, about_x);
        turned((const double[]){0, pitch, 0}, about_x, about_xy);
        turned((const double[]){0, 0, yaw}, about_xy, report.rotation);
        for (int i = 0; i < 4; i++) report.rotation[i] *= SCALE[n / 80];
        cps_body_angles(&report, angle, &heel);
        CHECK_NEAR(angle[0], roll, 1e-14);
        CHECK_NEAR(angle[1], pitch, 1e-14);
        CHECK_NEAR(angle[2], yaw, 1e-14);
        CHECK_NEAR(cos(heel), cos(roll) * cos(pitch), 1e-14);
    }
    for (int up = -1; up <= 1; up += 2) { /* pitch +-90 degrees: x is vertical */
        double about_y[4];
        turned((const double[]){0, up * 0.5 * 3.14159265358979324, 0}, (const double[]){1, 0, 0, 0},
               about_y);
        turned((const double[]){0, 0, 0.7}, about_y, report.rotation);
        cps_body_angles(&report, angle, &heel);
        CHECK_NEAR(angle[0], 0, 0);
        CHECK_NEAR(angle[1], up * 0.5 * 3.14159265358979324, 1e-15);
        CHECK_NEAR(angle[2], 0.7, 1e-14);
        CHECK_NEAR(heel, 0.5 * 3.14159265358979324, 1e-14);
    }
    heel = 5;
    cps_body_angles(NULL, angle, &heel);
    cps_body_angles(&report, NULL, &heel);
    cps_body_angles(&report, angle, NULL);
    assert_true(heel == 5);
}

static void expect_refused(const CpsScene *scene, const char *where, const char *part) {
    CpsError err = {0};
    assert_int_not_equal(cps_scene_check(scene, &err), CPS_OK);
    if (!strstr(err.where, where) || !strstr(err.message, part))
        fail_msg("at '%s': %s; expected at '%s': ..%s..", err.where, err.message, where, part);
}

static void what_is_refused(void **unused) {
    (void)unused;
    Mooring m;
    spar(&m, 10, 0.5);
    m.body = (CpsBody){.name = "body"};
    expect_refused(&m.scene, "bodies", "cps_body_default");
    spar(&m, 10, 0.5);
    m.body.name = "a1";
    expect_refused(&m.scene, "bodies", "a point has the same name");
    spar(&m, 10, 0.5);
    memset(m.body.rotation, 0, sizeof m.body.rotation);
    expect_refused(&m.scene, "bodies.body", "quaternion");
    spar(&m, 10, 0.5);
    m.body.weight = -1;
    expect_refused(&m.scene, "bodies.body", ">= 0");
    spar(&m, 10, 0.5);
    memset(m.scene.gravity, 0, sizeof m.scene.gravity);
    m.body.weight = 0;
    m.body.buoyancy = 5;
    expect_refused(&m.scene, "bodies.body", "gravity is zero");
    spar(&m, 10, 0.5);
    m.body.hydrostatics[1] = 5;
    expect_refused(&m.scene, "bodies.body", "symmetric");
    spar(&m, 10, 0.5);
    m.body.kind = CPS_BODY_KIND_HELD;
    m.body.moment[2] = 1;
    expect_refused(&m.scene, "bodies.body", "it is held");
    spar(&m, 10, 0.5);
    m.point[4].body = 1;
    expect_refused(&m.scene, "points", "body 1: there are 1");
    spar(&m, 10, 0.5);
    for (int i = 3; i < 6; i++) m.point[i].kind = CPS_POINT_KIND_HELD;
    expect_refused(&m.scene, "bodies.body", "no point is on it");
    spar(&m, 10, 0.5);
    m.point[3].weight = 5;
    expect_refused(&m.scene, "points.b1", "give them to the body");
    spar(&m, 10, 0.5);
    m.body.position[2] = -300;
    expect_refused(&m.scene, "points.b1", "below obstacle 'bed'");
    spar(&m, 10, 0.5);
    m.bed.has_friction_lateral = true;
    m.bed.friction_lateral = 0.2;
    expect_refused(&m.scene, "bodies.body", "friction has directions");
    spar(&m, 10, 0.5);
    CpsBodyChange change = {.body = 1, .kind = CPS_BODY_KIND_FREE};
    CpsPointChange point_change = {.point = 3, .kind = CPS_POINT_KIND_HELD};
    CpsStage stage = cps_stage_default();
    stage.name = "stage";
    stage.body_change_count = 1;
    stage.body_change = &change;
    m.scene.stage_count = 1;
    m.scene.stage = &stage;
    expect_refused(&m.scene, "history[1]", "names body 1");
    change = (CpsBodyChange){.kind = CPS_BODY_KIND_HELD};
    expect_refused(&m.scene, "history[1].body.body", "no rotation");
    stage.body_change_count = 0;
    stage.point_change_count = 1;
    stage.point_change = &point_change;
    expect_refused(&m.scene, "history[1].b1.point", "change the body instead");
}

/* A mast of weight W, its centre of gravity and the ends of its stays at the height 1 over the
 * hinge about which it turns, between two stays of two equal pieces each, which meet at free
 * points: each stay has the stiffness k = EA/(2 l), so that the hinge has 2 k - W. */
static void a_mast_between_stays(Mooring *m, CpsPoint point[6], double tilt) {
    static const double X[] = {-10, 10, -5, 5}, PIECE = 4.9, EA = 3430;
    begin(m, 4);
    for (int i = 0; i < 6; i++) {
        point[i] = cps_point_default();
        if (i < 4) point[i].position[0] = X[i];
        point[i].position[2] = 1;
        if (i > 1) point[i].kind = i < 4 ? CPS_POINT_KIND_FREE : CPS_POINT_KIND_ON_BODY;
        point[i].name = m->point[i].name;
    }
    for (int i = 0; i < 4; i++) {
        m->line[i].length = PIECE;
        m->line[i].element_count = 1;
        m->line[i].stiffness = EA;
        m->line[i].end_point[0] = i;
        m->line[i].end_point[1] = i < 2 ? 2 + i : 4 + i % 2;
    }
    m->body.weight = 981;
    m->body.centre_of_gravity[2] = 1;
    m->body.rotation[0] = cos(0.5 * tilt);
    m->body.rotation[2] = sin(0.5 * tilt);
    for (int i = 0; i < 6; i++) m->body.fixed[i] = i != 4;
    m->scene.point = point;
    m->scene.point_count = 6;
}

/* Upright it is in balance and not stable, though it would be if the points of the stays were held;
 * from beside that it goes to where it hangs. */
static void free_points_follow_a_mast(void **unused) {
    (void)unused;
    Mooring m;
    CpsPoint point[6];
    a_mast_between_stays(&m, point, 0);
    CpsEvolution *evolution = evolve(&m.scene);
    CpsBodyReport found = step(evolution);
    CHECK_NEAR(found.rotation[2], 0, 1e-12);
    CHECK_NEAR(found.stiffness[28], 3430 / 4.9 - 981, 1e-6);
    assert_false(found.is_stable);
    cps_evolution_destroy(evolution);
    for (int side = -1; side <= 1; side += 2) {
        a_mast_between_stays(&m, point, 3 * side / RADIAN);
        evolution = evolve(&m.scene);
        found = step(evolution);
        CHECK_NEAR(fabs(found.rotation[2]), 1, 1e-9);
        assert_true(found.is_stable);
        cps_evolution_destroy(evolution);
    }
}

/* Two masts of weight W on hinges, of height 1, a line between their tops and a stay from each to
 * the other side, all of stiffness k. While the other stays a mast is stable if 2 k > W, and so are
 * both if they lean towards each other; if they lean the same way only the stays resist, by k. */
static void masts_lean_on_each_other(void **unused) {
    static const double W = 100, X[] = {-10, 12, 0, 2}, LENGTH[] = {9.9, 9.9, 1.9};
    static const int FROM[] = {0, 1, 2}, TO[] = {2, 3, 3};
    (void)unused;
    for (int i = 0; i < 4; i++) {
        const double k = W * (i < 2 ? 0.6 + 0.35 * i : 1.05 + 0.4 * (i - 2));
        Mooring m;
        CpsBody body[2];
        begin(&m, 3);
        for (int j = 0; j < 2; j++) {
            body[j] = m.body;
            body[j].name = j ? "second" : "first";
            body[j].position[0] = 2 * j;
            body[j].weight = W;
            body[j].centre_of_gravity[2] = 1;
            for (int d = 0; d < 6; d++) body[j].fixed[d] = d != 4;
        }
        for (int j = 0; j < 4; j++) {
            m.point[j].kind = j < 2 ? CPS_POINT_KIND_HELD : CPS_POINT_KIND_ON_BODY;
            m.point[j].position[0] = j < 2 ? X[j] : 0;
            m.point[j].position[2] = 1;
            m.point[j].body = j - 2;
        }
        for (int j = 0; j < 3; j++) { /* each is stretched by 0.1 */
            m.line[j].length = LENGTH[j];
            m.line[j].element_count = 1;
            m.line[j].stiffness = k * LENGTH[j];
            m.line[j].end_point[0] = FROM[j];
            m.line[j].end_point[1] = TO[j];
        }
        m.scene.point_count = 4;
        m.scene.body = body;
        m.scene.body_count = 2;
        CpsEvolution *evolution = evolve(&m.scene);
        (void)step(evolution);
        for (int j = 0; j < 2; j++) {
            const CpsBodyReport found = cps_evolution_body_report(evolution, j);
            CHECK_NEAR(found.rotation[2], 0, 1e-12);
            CHECK_NEAR(found.stiffness[28], 2 * k - W, 1e-6);
            CHECK_INT(found.is_stable, k > W);
        }
        cps_evolution_destroy(evolution);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pendulum),
        cmocka_unit_test(neutral_poses),
        cmocka_unit_test(one_axis_is_fixed),
        cmocka_unit_test(fixed_directions_stay),
        cmocka_unit_test(below_the_bed),
        cmocka_unit_test(a_float_on_two_strings),
        cmocka_unit_test(stiffness_of_a_heeled_body),
        cmocka_unit_test(oc3_at_rest),
        cmocka_unit_test(oc3_thrust_on_and_off),
        cmocka_unit_test(moves_of_bodies),
        cmocka_unit_test(free_points_follow_a_mast),
        cmocka_unit_test(masts_lean_on_each_other),
        cmocka_unit_test(angles_of_a_pose),
        cmocka_unit_test(what_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
