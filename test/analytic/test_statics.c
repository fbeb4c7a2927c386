/* SPDX-License-Identifier: BSD-3-Clause */
/* Ropes placed statically across a pipe that lies on a bed, or half in it.
 *
 * The rope is held on the bed on both sides and is long enough to be slack there. Without friction
 * T + T^2/(2 EA) - w z is constant along it: dT/da = w dz/dl, dl = (1 + T/EA) da. It is 0 on the
 * bed, so that at the crest of the pipe T + T^2/(2 EA) = w z, whatever the rest. The initial guess
 * is straight, on the bed, and therefore inside the pipe; for most pipes it is below the axis,
 * between pipe and bed. */
#include <stdio.h>

#include "rig.h"
#include "splitmix.h"

enum { ROPES = 16, ELEMENTS = 80 };

static const double PI = 3.14159265358979323846;

/* A random rope across a random pipe; all lengths times `unit`. */
typedef struct Across {
    double unit, weight, stiffness;
    double radius, axis; /* of the pipe; the height of its axis above the bed */
    double askew;        /* B is off the plane across the pipe by this much */
    double tilt;         /* [rad] of the whole scene about y, gravity included */
    bool reversed;       /* ends exchanged */
} Across;

static Across random_across(uint64_t *state) {
    Across a = {0};
    a.unit = pow(10, splitmix(state, -2, 3));
    a.weight = pow(10, splitmix(state, -2, 4));
    a.radius = splitmix(state, 0.04, 0.15);
    a.axis = a.radius * splitmix(state, -0.4, 0.9);
    a.askew = splitmix(state, -0.05, 0.05);
    a.tilt = splitmix(state, -PI, PI);
    a.reversed = splitmix(state, 0, 1) < 0.5;
    a.stiffness =
        splitmix(state, 0, 1) < 0.5 ? INFINITY : a.weight * a.unit * pow(10, splitmix(state, 2, 6));
    return a;
}

/* (x, y, z) in units of length, turned with the scene */
static void turned(const Across *across, double x, double y, double z, double out[3]) {
    const double c = cos(across->tilt), s = sin(across->tilt);
    out[0] = across->unit * (c * x + s * z);
    out[1] = across->unit * y;
    out[2] = across->unit * (c * z - s * x);
}

/* [N] the largest tension of the rope */
static double largest_tension(const Across *across) {
    static Rig rig;
    double at[3], other[3];
    rig_begin(&rig, ELEMENTS, across->weight, across->stiffness);
    rig_length(&rig, across->unit);
    CpsObstacle *bed = rig_obstacle(&rig, CPS_OBSTACLE_PLANE, 0);
    turned(across, 0, 0, 1 / across->unit, bed->normal);
    CpsObstacle *pipe = rig_obstacle(&rig, CPS_OBSTACLE_CYLINDER, 0);
    turned(across, 0, 0, across->axis, pipe->point);
    pipe->axis[0] = 0;
    pipe->axis[1] = 1;
    pipe->axis[2] = 0;
    pipe->radius = across->radius * across->unit;
    turned(across, 0, 0, -9.81 / across->unit, rig.scene.gravity);
    turned(across, -0.3, 0, 0, at);
    turned(across, 0.3, across->askew, 0, other);
    const int first = across->reversed ? CPS_END_B : CPS_END_A;
    rig_end(&rig, first, CPS_END_KIND_HELD, at[0], at[1], at[2]);
    rig_end(&rig, CPS_END_A + CPS_END_B - first, CPS_END_KIND_HELD, other[0], other[1], other[2]);
    rig.line.start.kind = CPS_START_STATIC;
    RigRun run = rig_open(&rig);
    const CpsLineView view = rig_step(&run);
    double most = 0;
    for (int e = 0; e < ELEMENTS; e++) most = fmax(most, rig_tension(&view, e));
    rig_close(&run);
    return most;
}

static void across_pipes(void **unused) {
    (void)unused;
    uint64_t state = 1;
    double worst = 0;
    for (int k = 0; k < ROPES; k++) {
        const Across across = random_across(&state);
        const double most = largest_tension(&across),
                     strain = isinf(across.stiffness) ? 0 : most / across.stiffness,
                     height = most * (1 + strain / 2) / (across.weight * across.unit),
                     crest = across.axis + across.radius;
        /* the element that touches down carries what is below it, and those at the crest leave
         * the pipe by a chord: one element's length of rope */
        CHECK_NEAR(height, crest, 1.0 / ELEMENTS);
        worst = fmax(worst, fabs(height - crest) * ELEMENTS);
    }
    printf("ropes across pipes | T/w at the crest, in elements off its height | 0 | %.3f\n", worst);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(across_pipes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
