/* SPDX-License-Identifier: BSD-3-Clause */
/* Rigid bodies, from a scene to the checker: the file is sound and the scene's, and copies with a
 * number changed are refused, by themselves or beside their scene. */
#include "check.h"
#include "falsified.h"

/* A float that heels, with water whose stiffness is coupled, on two legs; and a barge beside it
 * that is moved and turned, let go, and held again, under a gravity that changes. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\nobstacles:\n"
    "  bed: {plane: {point: [0, 0, -20]}, friction: 0.5}\n"
    "bodies:\n"
    "  spar: {free: [0, 0, 0], rotation: {roll_pitch_yaw: [0, 0, 20]}, fixed: [rz, y], weight: 500,"
    " centre_of_gravity: [0.1, 0, -2], buoyancy: 1500, centre_of_buoyancy: [0, 0, 0.5],"
    " hydrostatics: [[10, 0, 0, 0, 5, 0], [0, 12, 0, 0, 0, 0], [0, 0, 90, 0, 0, 0],"
    " [0, 0, 0, 300, 0, 0], [5, 0, 0, 0, 310, 0], [0, 0, 0, 0, 0, 40]],"
    " force: [10, 0, 0], arm: [0, 0, 2]}\n"
    "  barge: {held: [30, 0, 0], weight: 50, hydrostatics: {x: 400, y: 500, z: 300, rx: 300,"
    " ry: 300, rz: 300}}\n"
    "points:\n"
    "  anchor: {held: [-14, 1, -20]}\n"
    "  left: {body: spar, at: [-1, 0.2, -3]}\n"
    "  right: {body: spar, at: [1, 0, -3]}\n"
    "  bow: {body: barge, at: [-2, 0, 1]}\n"
    "  stern: {body: barge, at: [2, 0.5, 0]}\n"
    "lines:\n"
    "  a: {length: 23, elements: 12, weight: 10, stiffness: 1e5, start: static, ends: {A: {point: "
    "anchor}, B: {point: left}}}\n"
    "  b: {length: 24, elements: 12, weight: 10, stiffness: 1e5, start: static, ends: {A: {point: "
    "right}, B: {held: [15, 0, -20]}}}\n"
    "  c: {length: 29, elements: 8, weight: 2, stiffness: 1e5, start: static, ends: {A: {point: "
    "right}, B: {point: bow}}}\n"
    "  d: {length: 30, elements: 8, weight: 2, stiffness: 1e5, start: static, ends: {A: {point: "
    "stern}, B: {held: [58, 0, -10]}}}\n"
    "history:\n"
    "  - {name: push, steps: 2, spar.body: {force: [90, 0, 0], arm: [0, 0, 2]}}\n"
    "  - {name: turn, steps: 2, barge.body: {move: [0.5, 0.2, 0], rotation: {roll_pitch_yaw: [5, "
    "10, 30]}}}\n"
    "  - {name: free, steps: 2, barge.body: {force: [5, 0, 0]}, gravity: [0, 0, -9]}\n"
    "  - {name: hold, steps: 2, barge.body: {position: [30, 1, 0], rotation: {quaternion: [1, 0, 0,"
    " 0.1]}}}\n";
enum { STEPS = 9, LINES = 4, BODIES = 2, POINTS = 5, SPAR = 0, BARGE = 1, LEFT = 1 };

/* A number of a step and a body, or component i of so many. */
#define NUMBER(step, body)    ((step)*BODIES + (body))
#define OF(step, body, n, i)  ((n)*NUMBER(step, body) + (i))
#define PLACE(step, point, a) (3 * ((step)*POINTS + (point)) + (a))

/* Step 1 pushes, 3 turns the barge, 5 has let it go, 7 holds it again. A finding NULL: only beside
 * the scene. */
static const FalseNumber FALSE[] = {
    {"position_of_body", OF(1, SPAR, 3, 0), 0.5, "body spar: distance of a point from its place"},
    {"position_of_body", OF(3, BARGE, 3, 2), 0.1, "body barge: distance of a point"},
    {"position_of_body", OF(1, SPAR, 3, 1), 0.1, "body spar: displacement in a fixed direction"},
    {"rotation_of_body", OF(1, SPAR, 4, 2), 0.2, "body spar: length of the quaternion"},
    {"rotation_of_body", OF(1, SPAR, 4, 3), -0.17, "body spar: distance of a point"},
    {"rotation_of_body", OF(1, SPAR, 4, 3), -0.17, "body spar: rotation about a fixed axis"},
    {"position_of_point", PLACE(1, LEFT, 2), -3.5, "body spar: distance of a point"},
    {"state_of_point", 1 * POINTS + LEFT, 0, "body spar: point left is said to be off it"},
    {"lines_of_body", OF(1, SPAR, 3, 0), 5, "body spar: force of the lines"},
    {"lines_moment_of_body", OF(1, SPAR, 3, 1), 5, "body spar: moment of the lines"},
    {"lines_moment_of_body", OF(3, BARGE, 3, 2), 5, "body barge: moment of the lines"},
    {"load_of_body", OF(1, SPAR, 3, 2), 5, "body spar: residual force against the sum"},
    {"load_moment_of_body", OF(5, BARGE, 3, 1), 5, "body barge: residual moment against the sum"},
    {"support_of_body", OF(1, SPAR, 3, 0), 1,
     "body spar: support in a direction that is not fixed"},
    {"support_moment_of_body", OF(1, SPAR, 3, 2), 100,
     "body spar: residual moment against the sum"},
    {"support_of_body", OF(3, BARGE, 3, 1), 100, "body barge: residual force against the sum"},
    {"residual_of_body", OF(1, SPAR, 3, 0), 1, "body spar: residual force against the sum"},
    {"residual_moment_of_body", OF(3, BARGE, 3, 0), 1, "body barge: residual where it is held"},
    {"residual_moment_of_body", OF(1, SPAR, 3, 0), 1, "body spar: it is said to have a place"},
    {"has_place_of_body", NUMBER(1, SPAR), 0, "body spar: it has no place, but lines"},
    {"has_place_of_body", NUMBER(3, BARGE), 0, "body barge: it is held, but not stable"},
    {"stable_of_body", NUMBER(1, SPAR), 0, "body spar: it is said to be not stable"},
    {"stiffness_xx_of_body", OF(1, SPAR, 9, 8), -1e4, "body spar: it is said to be stable"},
    {"stiffness_xx_of_body", OF(1, SPAR, 9, 8), 1294.43, NULL}, /* 1294.424 and so on: of 1e-5 */
    {"stiffness_xr_of_body", OF(1, SPAR, 9, 0), -296.4, NULL},
    {"stiffness_rx_of_body", OF(1, SPAR, 9, 0), -296.4, NULL},
    {"stiffness_rr_of_body", OF(1, SPAR, 9, 4), 6709.1, NULL},
    {"stiffness_rr_of_body", OF(5, BARGE, 9, 0), 1e3, NULL},
    {"stiffness_xr_of_body", OF(3, BARGE, 9, 1), 1, "body barge: it is held, but has a stiffness"},
    {"state_of_body", NUMBER(1, SPAR), 0, NULL},
    {"state_of_body", NUMBER(1, SPAR), 2, "unknown state of body spar"},
    {"kind_of_body", BARGE, 1, NULL},
    {"kind_of_body", BARGE, 2, "senseless kind, weight or buoyancy of body barge"},
    {"weight_of_body", SPAR, 501, NULL},
    {"weight_of_body", SPAR, -1, "senseless kind, weight or buoyancy of body spar"},
    {"buoyancy_of_body", SPAR, 1501, NULL},
    {"centre_of_gravity_of_body", 0, 0.2, NULL},
    {"centre_of_buoyancy_of_body", 2, 0.4, NULL},
    {"hydrostatics_xr_of_body", 1, 6, NULL},
    {"hydrostatics_rx_of_body", 3, 6, NULL},
    {"hydrostatics_xx_of_body", 8, 91, NULL},
    {"hydrostatics_rr_of_body", 0, 301, NULL},
    {"start_position_of_body", 0, 1e-3, NULL},
    {"start_rotation_of_body", 3, 0.1, NULL},
    {"fixed_of_body", 1, 0, "body spar: support in a direction that is not fixed"},
    {"fixed_of_body", 0, 1, "body spar: displacement in a fixed direction"},
    {"body_of_point", LEFT, 1, "body barge: distance of a point"},
    {"body_of_point", LEFT, -1, "senseless body of point left"},
    {"body_of_point", LEFT, 2, "senseless body of point left"},
    {"place_on_body_of_point", 3 * LEFT, -1.1, "body spar: distance of a point"},
    {"kind_of_point", LEFT, 0, "senseless body of point left"},
    {"b_end_force", 0, 1e3, "point right: sum of the lines"},
};

/* Scenes in which something else is imposed on the bodies. */
static const OtherScene OTHER[] = {
    {"free: [0, 0, 0]", "free: [0, 0, 1e-6]"},
    {"[0, 0, 20]", "[0, 0, 20.0001]"},
    {"fixed: [rz, y]", "fixed: [rz]"},
    {"weight: 500", "weight: 500.0001"},
    {"[0.1, 0, -2]", "[0.1, 0, -2.0001]"},
    {"buoyancy: 1500", "buoyancy: 1500.0001"},
    {"[0, 0, 0.5]", "[0, 0, 0.50001]"},
    {"[0, 12, 0, 0, 0, 0]", "[0, 12.0001, 0, 0, 0, 0]"},
    {"force: [10, 0, 0], arm: [0, 0, 2]", "force: [10, 0, 0], arm: [0, 0, 2.0001]"},
    {"force: [10, 0, 0]", "force: [10, 1e-5, 0]"},
    {"force: [90, 0, 0]", "force: [90, 0, 1e-5]"},
    {"held: [30, 0, 0]", "held: [30, 0, 1e-6]"},
    {"at: [-1, 0.2, -3]", "at: [-1, 0.2, -3.000001]"},
    {"move: [0.5, 0.2, 0]", "move: [0.5, 0.200001, 0]"},
    {"[5, 10, 30]", "[5, 10, 30.0001]"},
    {"force: [5, 0, 0]", "force: [5, 0, 1e-6]"},
    {"position: [30, 1, 0]", "position: [30, 1, 1e-6]"},
    {"[1, 0, 0, 0.1]", "[1, 0, 0, 0.10001]"},
    {"gravity: [0, 0, -9]", "gravity: [0, 0, -9.0001]"},
    {"{body: spar, at: [1, 0, -3]}", "{body: barge, at: [1, 0, -3]}"},
    {"left", "port"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = LINES * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
