/* SPDX-License-Identifier: BSD-3-Clause */
/* Points where lines meet, from a scene to the checker: the file is sound and the scene's, and
 * copies with a number changed are refused, by themselves or beside their scene. */
#include "check.h"
#include "falsified.h"

/* A knot on a drum, which turns under it; it is pulled along the drum, held above it, and let go;
 * and a buoy that nothing touches. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\nobstacles:\n"
    "  bed: {plane: {point: [0, 0, -9]}, friction: 0.5}\n"
    "  drum: {cylinder: {axis: [0, 1, 0], radius: 2}, friction: 0.3}\n"
    "points:\n"
    "  post: {held: [-4, 1, -1]}\n"
    "  knot: {free: [0, 0, 2], weight: 100}\n"
    "  buoy: {free: [4, 0, 9], weight: -30}\n"
    "lines:\n"
    "  a: {length: 6, elements: 12, weight: 10, stiffness: 1e5, start: static, ends: {A: {point: "
    "post}, B: {point: knot}}}\n"
    "  b: {length: 6, elements: 12, weight: 10, stiffness: 1e5, start: static, ends: {A: {point: "
    "knot}, B: {held: [4, 0, -2]}}}\n"
    "  c: {length: 5, elements: 5, weight: 1, stiffness: 1e5, start: static, ends: {A: {held: [4, "
    "0, 4]}, B: {point: buoy}}}\n"
    "history:\n"
    "  - {name: turn, steps: 2, drum.turn: 20}\n"
    "  - {name: pull, steps: 2, buoy.point: {force: [10, 0, 0]}, post.point: {move: [0.1, 0, 0]}}\n"
    "  - {name: hold, knot.point: {position: [0.5, 0.3, 2.5]}, gravity: [0, 1, -9]}\n";
enum { STEPS = 6, POINTS = 3, POST = 0, KNOT = 1, BUOY = 2 };

/* A number of a step and a point, or its component a. */
#define NUMBER(step, point)    ((step)*POINTS + (point))
#define VECTOR(step, point, a) (3 * NUMBER(step, point) + (a))

static const FalseNumber FALSE[] = {
    {"position_of_point", VECTOR(1, POST, 0), -4.1, "point post: distance of the end of a line"},
    {"position_of_point", VECTOR(2, KNOT, 2), 1, "point knot: depth below an obstacle"},
    {"position_of_point", VECTOR(2, KNOT, 1), 3, "point knot: error of the slip"},
    {"lines_of_point", VECTOR(0, BUOY, 2), -1, "point buoy: sum of the lines"},
    {"lines_of_point", VECTOR(3, POST, 1), 50, "point post: residual against the sum"},
    {"load_of_point", VECTOR(1, POST, 2), -1, "point post: load of a held point"},
    {"load_of_point", VECTOR(1, BUOY, 2), 29, "point buoy: residual against the sum"},
    {"support_of_point", VECTOR(1, BUOY, 0), 1, "point buoy: support of a free point"},
    {"support_of_point", VECTOR(4, POST, 0), 1, "point post: residual against the sum"},
    {"normal_of_point", VECTOR(1, KNOT, 1), 0.1, "point knot: error of the normal"},
    {"normal_of_point", VECTOR(1, BUOY, 1), 1, "point buoy: force of an obstacle"},
    {"reaction_of_point", NUMBER(1, KNOT), -5, "point knot: reaction that pulls"},
    {"reaction_of_point", NUMBER(1, KNOT), 1, "point knot: friction above its bound"},
    {"reaction_of_point", NUMBER(1, BUOY), 1, "point buoy: force of an obstacle"},
    {"friction_of_point", VECTOR(0, KNOT, 1), 1, "point knot: friction above its bound"},
    {"friction_of_point", VECTOR(1, KNOT, 2), 20, "point knot: friction along the normal"},
    {"friction_of_point", VECTOR(1, KNOT, 0), 0, "point knot: what the law of friction lacks"},
    {"friction_of_point", VECTOR(1, KNOT, 1), -0.828,
     "point knot: what friction is off the direction"},
    {"slip_of_point", VECTOR(1, KNOT, 1), 0.1, "point knot: error of the slip"},
    {"residual_of_point", VECTOR(1, KNOT, 1), 1, "point knot: residual against the sum"},
    {"dissipated_of_point", NUMBER(1, KNOT), 100, "point knot: dissipated energy"},
    {"state_of_point", NUMBER(1, KNOT), 0, "point knot: load of a held point"},
    {"state_of_point", NUMBER(1, KNOT), 1, "point knot: it is said to be off all obstacles"},
    {"state_of_point", NUMBER(1, KNOT), 2, "point knot: slip of a point at rest"},
    {"state_of_point", NUMBER(1, BUOY), 2, "point buoy: it is said to rest or slide"},
    {"state_of_point", NUMBER(1, BUOY), 4, "point buoy: its state and its kind differ"},
    {"state_of_point", NUMBER(1, BUOY), 5, "unknown state or obstacle of point"},
    {"obstacle_of_point", NUMBER(1, KNOT), 0, "point knot: distance from the obstacle"},
    {"obstacle_of_point", NUMBER(1, KNOT), -1, "point knot: force of an obstacle"},
    {"obstacle_of_point", NUMBER(1, KNOT), 2, "unknown state or obstacle of point"},
    {"has_place_of_point", NUMBER(1, BUOY), 0, "point buoy: it has no place, but lines"},
    {"a_end_point", 0, 2, "point buoy: sum of the lines"},
    {"a_end_point", 0, 3, "unknown point at an end of line"},
    {"kind_of_point", KNOT, 2, "point knot: its state and its kind differ"},
    {"kind_of_point", KNOT, 3, "senseless kind or weight of point"},
    {"kind_of_point", KNOT, 0, NULL},
    {"weight_of_point", BUOY, -31, NULL},
    {"b_end_kind", 0, 1, "point knot: the end of line b is free"},
};

/* Scenes in which something else is imposed on the points. */
static const OtherScene OTHER[] = {
    {"held: [-4, 1, -1]", "held: [-4, 1, -1.000001]"},
    {"weight: 100", "weight: 100.0001"},
    {"free: [4, 0, 9], weight: -30", "free: [4, 0, 9], force: [0, 1e-6, 0], weight: -30"},
    {"force: [10, 0, 0]", "force: [10, 0, 1e-9]"},
    {"move: [0.1, 0, 0]", "move: [0.1, 0, 1e-9]"},
    {"position: [0.5, 0.3, 2.5]", "position: [0.5, 0.3, 2.500001]"},
    {"{A: {point: post}, B: {point: knot}}", "{A: {point: knot}, B: {point: post}}"},
    {"buoy", "float"},
    {"gravity: [0, 1, -9]", "gravity: [0, 1, -8]"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = 3 * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
