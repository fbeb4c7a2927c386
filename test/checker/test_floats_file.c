/* SPDX-License-Identifier: BSD-3-Clause */
/* Points that float in time, in waves, from a scene to the checker: the file is sound and the
 * scene's, and copies with a number changed are refused. */
#include "check.h"
#include "falsified.h"

/* A buoy with a height, one without that is pulled under, and a knot without a volume. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\nwater_density: 1000\nwater_surface: 3\n"
    "waves: {depth: 9, ramp: 1, components: [{amplitude: 0.3, period: 4, direction: 20, phase: "
    "30}]}\n"
    "points:\n"
    "  foot: {held: [0, 0, -5], mass: 9, volume: 0.1}\n"
    "  can: {free: [1, 0, 3], mass: 20, volume: 0.08, height: 0.9, inertia: 30}\n"
    "  ball: {free: [9, 0, 3], mass: 10, volume: 0.02}\n"
    "  knot: {free: [5, 0, 0], weight: 50}\n"
    "lines:\n"
    "  a: {length: 9, elements: 6, mass: 0.1, stiffness: 1e5, start: static, ends: {A: {point: "
    "foot}, B: {point: can}}}\n"
    "  b: {length: 5, elements: 4, mass: 0.1, stiffness: 1e5, start: static, ends: {A: {point: "
    "knot}, B: {point: can}}}\n"
    "  c: {length: 5, elements: 4, mass: 0.1, stiffness: 1e5, start: static, ends: {A: {point: "
    "knot}, B: {point: ball}}}\n"
    "history:\n"
    "  - {name: sea, duration: 1, steps: 10}\n"
    "  - {name: under, duration: 1, steps: 5, ball.point: {force: [0, 0, -300]}}\n";
enum { STEPS = 16, POINTS = 4, FOOT = 0, CAN = 1, BALL = 2, KNOT = 3 };
enum { NONE = 0, SUBMERGED = 1, FLOATING = 2, ABOVE = 3 };

/* A number of a step and a point, or its component a. */
#define NUMBER(step, point)    ((step)*POINTS + (point))
#define VECTOR(step, point, a) (3 * NUMBER(step, point) + (a))

static const FalseNumber FALSE[] = {
    {"water_direction_of_point", VECTOR(7, CAN, 0), 0.2, "point can: direction of the water's"},
    {"water_direction_of_point", VECTOR(7, BALL, 2), 1, "point ball: direction of the water's"},
    {"water_level_of_point", NUMBER(7, CAN), 3, "point can: level of the water, off"},
    {"water_level_of_point", NUMBER(0, BALL), 3.1, "point ball: level of the water, off"},
    {"ledger_waves_of_point", NUMBER(7, CAN), 0, "point can: work of the waves, off"},
    {"ledger_waves_of_point", NUMBER(7, KNOT), 1, "point knot: work of the waves, off"},
    {"ledger_scheme_of_point", NUMBER(9, CAN), 1, "point can: ledger, work of lines and load"},
    {"height_of_point", CAN, 0.8, "point can: buoyancy"},
    {"height_of_point", CAN, -1, "senseless height_of_point"},
    {"buoyancy_of_point", NUMBER(9, CAN), 300, "point can: buoyancy"},
    {"buoyancy_of_point", NUMBER(15, BALL), 150, "point ball: buoyancy below what its place"},
    {"buoyancy_of_point", NUMBER(9, BALL), 250, "point ball: buoyancy above what its place"},
    {"water_of_point", NUMBER(9, CAN), SUBMERGED, "point can: it is said to be submerged"},
    {"water_of_point", NUMBER(9, CAN), ABOVE, "point can: it is said to be above the water"},
    {"water_of_point", NUMBER(15, BALL), FLOATING, "point ball: distance from the surface"},
    {"water_of_point", NUMBER(9, CAN), NONE, "point can: where it is in the water is not said"},
    {"inertia_of_point", VECTOR(9, CAN, 2), 5, "point can: inertia of the mass, off"},
    {"waves", 0, 0.31, "point can: direction of the water's"},
    {"waves", 1, 4.1, "point can: direction of the water's"},
    {"wave_ramp", 0, 1.2, "point can: direction of the water's"},
    {"water_surface", 0, 3.01, "point can: level of the water, off"},
    {"time", 3, 0.35, "point can: direction of the water's"},
};

/* Scenes with other water. */
static const OtherScene OTHER[] = {
    {"height: 0.9", "height: 0.90001"},
    {", height: 0.9", ""},
    {"amplitude: 0.3", "amplitude: 0.30001"},
    {"period: 4", "period: 4.0001"},
    {"direction: 20", "direction: 20.001"},
    {"depth: 9", "depth: 9.0001"},
    {"ramp: 1", "ramp: 1.0001"},
    {"water_surface: 3\n", "water_surface: 3.0000001\n"},
    {"mass: 20, volume: 0.08", "mass: 20, volume: 0.0800001"},
    {"inertia: 30", "inertia: 30.0001"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = 3 * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
