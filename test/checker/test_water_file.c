/* SPDX-License-Identifier: BSD-3-Clause */
/* Points at the surface of the water and anchors, from a scene to the checker: the file is sound
 * and the scene's, and copies with a number changed are refused. */
#include "check.h"
#include "falsified.h"

/* A float that is pulled under, one that is lifted out of the water and drags its anchor, and a
 * knot without a volume; then gravity changes. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\nwater_density: 1000\nwater_surface: 3\n"
    "points:\n"
    "  foot: {held: [0, 0, -5], mass: 9, volume: 0.1}\n"
    "  float: {free: [1, 0, 3], mass: 20, volume: 0.08}\n"
    "  can: {free: [9, 0, 3], mass: 10, volume: 0.02}\n"
    "  knot: {free: [5, 0, 0], weight: 50}\n"
    "  claw: {held: [10, 0, -5], holding_capacity: 60, uplift_limit: 50, drags: true}\n"
    "lines:\n"
    "  a: {length: 9, elements: 6, weight: 1, stiffness: 1e5, start: static, ends: {A: {point: "
    "foot}, B: {point: float}}}\n"
    "  b: {length: 5, elements: 4, weight: 1, stiffness: 1e5, start: static, ends: {A: {point: "
    "knot}, B: {point: float}}}\n"
    "  c: {length: 5, elements: 4, weight: 1, stiffness: 1e5, start: static, ends: {A: {point: "
    "knot}, B: {point: can}}}\n"
    "  d: {length: 9, elements: 6, weight: 1, stiffness: 1e5, start: static, ends: {A: {point: "
    "claw}, B: {point: can}}}\n"
    "history:\n"
    "  - {name: under, foot.point: {position: [0, 0, -9]}}\n"
    "  - {name: out, can.point: {force: [400, 0, 600]}}\n"
    "  - {name: lighter, gravity: [0, 0, -8]}\n";
enum { STEPS = 4, POINTS = 5, FOOT = 0, FLOAT = 1, CAN = 2, KNOT = 3, CLAW = 4 };
enum { NONE = 0, SUBMERGED = 1, FLOATING = 2, ABOVE = 3 };

/* A number of a step and a point, or its component a. */
#define NUMBER(step, point)    ((step)*POINTS + (point))
#define VECTOR(step, point, a) (3 * NUMBER(step, point) + (a))

static const FalseNumber FALSE[] = {
    {"water_of_point", NUMBER(0, FLOAT), NONE, "point float: where it is in the water is not said"},
    {"water_of_point", NUMBER(0, KNOT), FLOATING, "point knot: where it is in the water is not"},
    {"water_of_point", NUMBER(0, FOOT), SUBMERGED, "point foot: where it is in the water is not"},
    {"water_of_point", NUMBER(1, FLOAT), FLOATING, "point float: distance from the surface"},
    {"water_of_point", NUMBER(1, FLOAT), ABOVE, "point float: it is said to be above the water"},
    {"water_of_point", NUMBER(2, CAN), SUBMERGED, "point can: it is said to be submerged"},
    {"water_of_point", NUMBER(2, CAN), 4, "unknown state in the water of point"},
    {"buoyancy_of_point", NUMBER(0, FLOAT), 900, "point float: buoyancy above"},
    {"buoyancy_of_point", NUMBER(0, FLOAT), 300, "point float: residual against the sum"},
    {"buoyancy_of_point", NUMBER(1, FLOAT), 700, "point float: buoyancy below what its place"},
    {"buoyancy_of_point", NUMBER(2, CAN), 1, "point can: buoyancy above what its place allows"},
    {"buoyancy_of_point", NUMBER(1, KNOT), 1, "point knot: buoyancy of a point that does not"},
    {"displaced_of_point", NUMBER(1, FLOAT), 700, "point float: buoyancy above what its place"},
    {"displaced_of_point", NUMBER(0, FOOT), -1, "point foot: weight of displaced water below 0"},
    {"position_of_point", VECTOR(0, FLOAT, 2), 2.9, "point float: distance from the surface"},
    {"load_of_point", VECTOR(1, FLOAT, 2), 600, "point float: residual against the sum"},
    {"capacity_used_of_point", NUMBER(2, CLAW), 0.9, "point claw: used capacity against the force"},
    {"capacity_used_of_point", NUMBER(0, FOOT), 0.9, "point foot: used capacity against the force"},
    {"capacity_used_of_point", NUMBER(0, CAN), 0.9, "point can: capacity or limit used by a free"},
    {"uplift_used_of_point", NUMBER(2, CLAW), 0, "point claw: used limit against the force"},
    {"drag_of_point", VECTOR(0, CLAW, 0), 0.1, "point claw: dragged length against the sum"},
    {"drag_of_point", VECTOR(0, FOOT, 0), 0.1, "point foot: drag of what does not"},
    {"drag_of_point", VECTOR(2, CLAW, 2), 0.1, "point claw: drag out of the ground"},
    {"drag_of_point", VECTOR(2, CLAW, 0), 0, "point claw: dragged length against the sum"},
    {"dragged_of_point", NUMBER(2, CLAW), 9, "point claw: dragged length against the sum"},
    {"dissipated_of_point", NUMBER(2, CLAW), 9, "point claw: dissipated energy against the work"},
    {"holding_capacity_of_point", CLAW, 50,
     "point claw: force along the ground above the capacity"},
    {"holding_capacity_of_point", CLAW, 70, "point claw: what a drag lacks of the capacity"},
};

/* Scenes with other water. */
static const OtherScene OTHER[] = {
    {"water_surface: 3", "water_surface: 3.0000001"},
    {"water_surface: 3\n", ""},
    {"mass: 20, volume: 0.08", "mass: 20.00001, volume: 0.08"},
    {"mass: 10, volume: 0.02", "mass: 10, volume: 0.0200001"},
    {"gravity: [0, 0, -8]", "gravity: [0, 0, -8.00001]"},
    {"holding_capacity: 60", "holding_capacity: 60.0001"},
    {"uplift_limit: 50", "uplift_limit: 50.0001"},
    {", drags: true", ""},
    {"held: [10, 0, -5]", "held: [10.00001, 0, -5]"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = 4 * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
