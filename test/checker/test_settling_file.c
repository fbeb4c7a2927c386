/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines, points and a body that move in time and are then brought to rest, from a scene to the
 * checker: the file is sound and the scene's, and copies with a number changed are refused. */
#include "check.h"
#include "falsified.h"

/* A damped line in a current, on a bed, whose end swings; a line that is thrown; and a float
 * between two lines, of which one ends at a clump. Then all come to rest, as
 * an end moves, move again, and rest where they are. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\nwater_density: 1000\n"
    "current: [{z: 0, velocity: [0.5, 0.2, 0]}, {z: 10, velocity: [1, 0, 0]}]\n"
    "obstacles:\n"
    "  bed: {plane: {point: [0, 0, 0], normal: [0, 0.1, 1]}, friction: 0.4}\n"
    "bodies:\n"
    "  float: {free: [0, 0, 6], mass: 400, moments_of_inertia: [90, 120, 150],"
    " buoyancy: 6000, centre_of_gravity: [0, 0, -0.5], hydrostatics: {z: 3000, rx: 900, ry: 910,"
    " rz: 40}, velocity: [0.4, -0.2, 0.3]}\n"
    "points:\n"
    "  left: {body: float, at: [-1, 0, 0]}\n"
    "  right: {body: float, at: [1, 0, 0]}\n"
    "  clump: {free: [9, 0, 4], mass: 80, velocity: [0.6, 0.8, -0.4]}\n"
    "lines:\n"
    "  a: {length: 20, elements: 10, mass: 12, stiffness: 1e5, damping: 2e3, start: {straight: "
    "{from: [0, 30, 1], to: [17, 30, 12]}}, ends: {A: {held: [0, 30, 1]}, B: {held: [17, 30, "
    "12]}}, drag: {diameter: 0.1, normal: 1.2, tangential: 0.3, added_normal: 0.9}, "
    "loads: [{force: [0, 3, 1], from: 4, to: 11}]}\n"
    "  b: {length: 11.3, elements: 6, mass: 3, stiffness: 1e4, velocity: [0, 1, 2], start: "
    "{straight: {from: [0, 60, 8], to: [11, 63, 9]}}, ends: {A: {held: [0, 60, 8]}, B: {force: "
    "[100, 0, 30]}}}\n"
    "  c: {length: 11.1, elements: 6, mass: 3, stiffness: 1e5, quasi_static: true, start: "
    "{straight: {from: [-11, 0, 1], to: [-1, 0, 6]}}, ends: {A: {held: [-11, 0, 1]}, B: {point: "
    "left}}}\n"
    "  d: {length: 8.2, elements: 5, mass: 3, stiffness: 1e5, start: {straight: {from: [1, 0, 6], "
    "to: [9, 0, 4]}}, ends: {A: {point: right}, B: {point: clump}}}\n"
    "  e: {length: 11.5, elements: 5, mass: 3, stiffness: 1e5, quasi_static: true, start: "
    "{straight: "
    "{from: [9, 0, 4], to: [20, 0, 0.5]}}, ends: {A: {point: clump}, B: {held: [20, 0, 0.5]}}}\n"
    "history:\n"
    "  - {name: sway, duration: 0.8, steps: 4, a.B: {move: [0, 0, 0], sine: [1, 2, 0], period: "
    "3}}\n"
    "  - {name: rest, steps: 2, a.B: {move: [0.2, 0, 0]}}\n"
    "  - {name: sway again, duration: 0.4, steps: 2}\n"
    "  - {name: rest again, steps: 1}\n";
enum { STEPS = 9, LINES = 5, POINTS = 3, CLUMP = 2 };

/* The first step of a rest, and the second one. */
enum { REST = 4, STILL = 5 };

/* A finding NULL: only beside the scene. */
static const FalseNumber FALSE[] = {
    {"a_ledger_settling", REST, 100, "ledger_settling"},
    {"a_ledger_settling", REST, 100, "ledger: ends + obstacles - all else"},
    {"a_ledger_settling", STILL, 1, "ledger_settling"},
    {"a_ledger_settling", 2, 1, "ledger_settling in time"},
    {"b_ledger_settling", REST, 0, "ledger_settling"},
    {"d_ledger_settling", REST, 0, "ledger_settling"},
    {"a_ledger_kinetic", REST, 0, "growth of the kinetic energy"},
    {"a_ledger_kinetic", STILL, -1, "growth of the kinetic energy"},
    {"a_kinetic", REST, 1, "kinetic energy"},
    {"a_ledger_scheme", REST, 1, "energy of a motion in a quasi-static step"},
    {"a_ledger_drag", REST, 1, "energy of a motion in a quasi-static step"},
    {"a_ledger_ends", REST, 1, "ledger_ends"},
    {"a_ledger_elastic", REST, 1, "ledger_elastic"},
    {"a_ledger_gravity", REST, 1, "ledger_gravity"},
    {"a_ledger_loads", REST, 1, "ledger_loads"},
    {"a_ledger_imbalance", REST, 1, "imbalance where a line comes to rest"},
    {"b_ledger_ends", REST, 1, "ledger_ends"},
    {"ledger_settling_of_point", REST *POINTS + CLUMP, 0, "energy lost by coming to rest"},
    {"ledger_settling_of_point", 2 * POINTS + CLUMP, 1, "energy lost by coming to rest"},
    {"ledger_kinetic_of_point", REST *POINTS + CLUMP, 0, "growth of the kinetic energy"},
    {"ledger_settling_of_body", REST, 0, "energy lost by coming to rest"},
    {"ledger_settling_of_body", 2, 1, "energy lost by coming to rest"},
    {"ledger_kinetic_of_body", REST, 0, "growth of the kinetic energy"},
    {"kinetic_of_body", REST, 1, "motion in a quasi-static step"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = LINES * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE)};
    return falsified_main(&FALSIFIED);
}
