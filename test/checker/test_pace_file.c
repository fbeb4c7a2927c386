/* SPDX-License-Identifier: BSD-3-Clause */
/* Steps in time whose lengths follow from an error, of a line, points and a body, from a scene to
 * the checker: the file is sound and the scene's, and copies in which a step says another error, or
 * scenes that ask for another one, are refused. */
#include "check.h"
#include "falsified.h"

/* A line between a wall and a floor lands on both; a float swings on a line to a clump. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\n"
    "obstacles:\n"
    "  floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.4}\n"
    "  wall: {plane: {point: [0, 33, 0], normal: [0, -1, 0.3]}, friction: 0.2}\n"
    "bodies:\n"
    "  float: {free: [0, 0, 6], mass: 400, moments_of_inertia: [90, 120, 150],"
    " buoyancy: 6000, centre_of_gravity: [0, 0, -0.5], hydrostatics: {z: 3000, rx: 900, ry: 910,"
    " rz: 40}, velocity: [0.4, -0.2, 0.3], turn_rate: [0.5, 0.2, -0.3]}\n"
    "points:\n"
    "  left: {body: float, at: [-1, 0, 0]}\n"
    "  right: {body: float, at: [1, 0, 0]}\n"
    "  clump: {free: [9, 0, 4], mass: 80, velocity: [0.6, 0.8, -0.4]}\n"
    "lines:\n"
    "  a: {length: 20, elements: 10, mass: 12, stiffness: 1e5, start: {straight: "
    "{from: [0, 30, 1], to: [20, 30, 1]}}, velocity: [0, 6, 0], ends: {A: {force: [0, 0, 0]}, "
    "B: {force: [0, 0, 0]}}}\n"
    "  c: {length: 11.1, elements: 6, mass: 3, stiffness: 1e5, quasi_static: true, start: "
    "{straight: {from: [-11, 0, 1], to: [-1, 0, 6]}}, ends: {A: {held: [-11, 0, 1]}, B: {point: "
    "left}}}\n"
    "  d: {length: 8.2, elements: 5, mass: 3, stiffness: 1e5, start: {straight: {from: [1, 0, 6], "
    "to: [9, 0, 4]}}, ends: {A: {point: right}, B: {point: clump}}}\n"
    "history:\n"
    "  - {name: first, duration: 0.1, steps: 4}\n"
    "  - {name: by an error, duration: 1, time_step: 0.1, error: 2e-3}\n"
    "  - {name: rest, steps: 1}\n";
enum { STEPS = 37, LINES = 3 };
/* A step of an error, one at the wall, and one whose length was given. */
enum { PACED = 6, AT_WALL = 16, GIVEN = 2 };

/* A finding NULL: only beside the scene. */
static const FalseNumber FALSE[] = {
    {"step_error", PACED, 8.81e-4, "step_error"},
    {"step_error", PACED, 1e-9, "step_error"},
    {"step_error", PACED, 0, NULL},
    {"step_error", AT_WALL, 1.3e-3, "step_error"},
    {"step_error", AT_WALL, 0, NULL},
    {"step_error", GIVEN, 1e-3, "step_error"},
    {"step_error", GIVEN, 1e-3, NULL},
    {"step_error", STEPS - 1, 1e-3, "step_error"},
    {"step_error", STEPS - 1, 1e-3, NULL},
};

/* Scenes that ask for another error. */
static const OtherScene OTHER[] = {
    {"error: 2e-3", "error: 1.8e-3"},
    {"error: 2e-3", "error: 1e-5"},
    {", steps: 4", ", time_step: 0.025, error: 1"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = LINES * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
