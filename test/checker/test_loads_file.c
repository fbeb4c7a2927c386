/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines on ground that gives, on springs and in a quadratic field, with given loads and in a
 * current, from a scene to the checker: the file is sound and the scene's, and copies with a number
 * changed are refused. */
#include "check.h"
#include "falsified.h"

static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\nwater_density: 1000\n"
    "current: [{z: 0, velocity: [0.5, 0.2, 0]}, {z: 10, velocity: [1, 0, 0]}]\n"
    "obstacles:\n"
    "  clay: {plane: {point: [0, 0, 0], normal: [0, 0.1, 1]}, friction: 0.4, stiffness: 4000}\n"
    "  log: {cylinder: {point: [6, 0, 0], axis: [0, 1, 0], radius: 0.5}, friction: 0.3, stiffness: "
    "20000}\n"
    "lines:\n"
    "  a: {length: 20, elements: 40, weight: 50, bearing_width: 0.2, stiffness: 1e5, start: "
    "static, "
    "ends: {A: {held: [0, 0, 0.2]}, B: {held: [16, 0, 6]}}}\n"
    "  b: {length: 20, elements: 40, weight: 50, bearing_width: 0.1, stiffness: 1e5, start: "
    "static, "
    "ends: {A: {held: [0, 20, 0.5]}, B: {held: [16, 20, 6]}}, drag: {diameter: 0.1, normal: 1.2}, "
    "loads: [{force: [0, 3, 1], from: 4, to: 11}], springs: [{stiffness: [4, 5, 6], coupling: [1, "
    "-2, 3], place: [8, 21, 4]}, {stiffness: [0, 10, 0], at: 7, place: [0, 22, 0]}]}\n"
    "history:\n"
    "  - {name: draw, steps: 2, a.B: {position: [17, 1, 6]}, b.B: {position: [17, 20.5, 6]}}\n"
    "  - {name: back, steps: 2, a.B: {position: [15, 1, 6]}, b.B: {position: [15, 20.5, 6]}}\n";
enum { STEPS = 5, NODES = 41, CLAY = 0, LOG = 1, AT = 15 };

static const FalseNumber FALSE[] = {
    {"obstacle_stiffness", CLAY, 4001, "claimed contact_residual"},
    {"obstacle_stiffness", CLAY, 0, "depth below an obstacle"},
    {"obstacle_stiffness", LOG, 19000, "claimed contact_residual"},
    {"obstacle_stiffness", LOG, -1, "a value that cannot be: obstacle_stiffness"},
    {"a_bearing_width", 0, 0.2001, "claimed contact_residual"},
    {"a_bearing_width", 0, 0, "a value that cannot be: a_bearing_width"},
    {"a_reaction", 2 * NODES * 2 + 10, 20, "imbalance"},
    {"a_contact_residual", 3, 0.1, "claimed contact_residual"},
    {"a_ledger_elastic", 2, 0.1, "claimed ledger_elastic"},
    {"b_node_stiffness", 3 * AT + 1, 2.6, "imbalance"},
    {"b_node_stiffness", 3 * AT + 1, -2.5, "negative energy: node_stiffness"},
    {"b_node_coupling", 3 * AT + 1, -1.1, "imbalance"},
    {"b_node_coupling", 3 * AT + 2, 3, "negative energy: node_stiffness"},
    {"b_node_place", 3 * AT, 8.1, "imbalance"},
    {"b_node_beside", 3 * (2 * NODES + AT), 0.1, "imbalance"},
    {"b_node_load", 3 * (2 * NODES + AT), 3, NULL},
    {"b_drag", 1, 1.3, NULL},
    {"current", 1, 0.6, NULL},
    {"water_density", 0, 1001, NULL},
    {"b_load_residual", 2, 1, NULL},
    {"b_ledger_loads", 2, 1, "claimed ledger_loads"},
};

/* Scenes with other loads and other ground. */
static const OtherScene OTHER[] = {
    {"stiffness: 4000", "stiffness: 4000.01"},
    {"stiffness: 20000", "stiffness: 0"},
    {"bearing_width: 0.2", "bearing_width: 0.20001"},
    {"stiffness: [4, 5, 6]", "stiffness: [4, 5, 6.0001]"},
    {"coupling: [1, -2, 3]", "coupling: [1.0001, -2, 3]"},
    {"coupling: [1, -2, 3]", "coupling: [1, -2, 2.9999]"},
    {"place: [8, 21, 4]", "place: [8, 21.001, 4]"},
    {"at: 7", "at: 7.5"},
    {"force: [0, 3, 1]", "force: [0, 3, 1.001]"},
    {"to: 11", "to: 11.5"},
    {"normal: 1.2", "normal: 1.2001"},
    {"velocity: [0.5, 0.2, 0]", "velocity: [0.5, 0.201, 0]"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = 2 * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
