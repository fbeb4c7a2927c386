/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points in a slope that gives, from a scene to the checker: the file is sound and the
 * scene's, and copies with a number changed are refused, by themselves or beside their scene. */
#include "check.h"
#include "falsified.h"

/* A clump that is dragged along and lifted off, and a knot without weight or area of its own. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\n"
    "obstacles:\n"
    "  bed: {plane: {point: [0, 0, 0], normal: [0, 0.1, 1]}, friction: 0.4, stiffness: 3e4}\n"
    "  stone: {sphere: {centre: [0, 30, 0], radius: 1}, friction: 0.3}\n"
    "points:\n"
    "  clump: {free: [8, 0, 0], weight: 900, bearing_area: 0.5}\n"
    "  knot: {free: [14, 0, 0]}\n"
    "  ring: {held: [20, 0, -0.1]}\n"
    "lines:\n"
    "  a: {length: 9, elements: 18, mass: 12, stiffness: 1e5, bearing_width: 0.1, start: static, "
    "ends: {A: {held: [0, 0, 0.2]}, B: {point: clump}}}\n"
    "  b: {length: 6.2, elements: 12, mass: 12, stiffness: 1e5, bearing_width: 0.1, start: static, "
    "ends: {A: {point: clump}, B: {point: knot}}}\n"
    "  c: {length: 6.5, elements: 10, mass: 12, stiffness: 1e5, bearing_width: 0.2, start: static, "
    "ends: {A: {point: knot}, B: {point: ring}}}\n"
    "history:\n"
    "  - {name: drag, steps: 2, clump.point: {force: [700, 900, 0]}}\n"
    "  - {name: lift, steps: 2, clump.point: {force: [0, 0, 4000]}, bed.obstacle: {move: [0, 0, "
    "0.02]}}\n";
enum { STEPS = 5, POINTS = 3, CLUMP = 0, KNOT = 1, RING = 2 };

/* A number of a step and a point, or its component a. */
#define NUMBER(step, point)    ((step)*POINTS + (point))
#define VECTOR(step, point, a) (3 * NUMBER(step, point) + (a))

static const FalseNumber FALSE[] = {
    {"bearing_area_of_point", CLUMP, 0.51, "point clump: reaction against that of the depth"},
    {"bearing_area_of_point", KNOT, 0.01, "point knot: reaction against that of the depth"},
    {"bearing_area_of_point", CLUMP, -1, "bearing_area_of_point"},
    {"bearing_area_of_point", RING, 0.1, NULL},
    {"b_bearing_width", 0, 0.11, "point knot: reaction against that of the depth"},
    {"obstacle_stiffness", 0, 3.01e4, "point clump: reaction against that of the depth"},
    {"position_of_point", VECTOR(2, CLUMP, 2), -0.05, "point clump: distance of the end of a line"},
    {"reaction_of_point", NUMBER(2, CLUMP), 900, "point clump: reaction against that of the depth"},
    {"reaction_of_point", NUMBER(1, KNOT), 0, "point knot: friction above its bound"},
    {"friction_of_point", VECTOR(2, CLUMP, 1), 0, "point clump: residual against the sum"},
    {"slip_of_point", VECTOR(2, CLUMP, 0), 0, "point clump: error of the slip"},
    {"obstacle_of_point", NUMBER(2, CLUMP), -1, "point clump: force of an obstacle"},
    {"obstacle_of_point", NUMBER(2, CLUMP), 1, "point clump: depth in another obstacle"},
    {"obstacle_of_point", NUMBER(4, CLUMP), 0, "point clump: it is said to be off all obstacles"},
    {"obstacle_of_point", NUMBER(2, RING), 0, "point ring: what gives is said to bear a point"},
};

static const OtherScene OTHER[] = {
    {"stiffness: 3e4", "stiffness: 30001"},
    {"bearing_area: 0.5", "bearing_area: 0.50001"},
    {"free: [14, 0, 0]", "free: [14, 0, 0], bearing_area: 1e-6"},
    {"bearing_width: 0.2", "bearing_width: 0.2001"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = 3 * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
