/* SPDX-License-Identifier: BSD-3-Clause */
/* A line that moves in time in a current, with drag, water that is moved along and given loads,
 * from a scene to the checker: the file is sound and the scene's, and copies with a number changed
 * are refused. */
#include "check.h"
#include "falsified.h"

static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\nwater_density: 1000\n"
    "current: [{z: 0, velocity: [0.5, 0.2, 0]}, {z: 10, velocity: [1, 0, 0]}]\n"
    "obstacles:\n"
    "  bed: {plane: {point: [0, 0, 0], normal: [0, 0.1, 1]}, friction: 0.4}\n"
    "lines:\n"
    "  a: {length: 20, elements: 40, mass: 12, stiffness: 1e5, damping: 2e3, start: static, "
    "ends: {A: {held: [0, 0, 0.2]}, B: {held: [16, 0, 6]}}, "
    "drag: {diameter: 0.1, normal: 1.2, tangential: 0.3, added_normal: 0.9, added_tangential: "
    "0.2}, "
    "loads: [{force: [0, 3, 1], from: 4, to: 11}]}\n"
    "history:\n"
    "  - {name: sway, duration: 1, steps: 4, a.B: {move: [0, 0, 0], sine: [1, 2, 0], period: 3}}\n";
enum { STEPS = 5, NODES = 41, AT = 30 };

static const FalseNumber FALSE[] = {
    {"a_ledger_drag", 2, 0.1, "ledger in time"},
    {"a_ledger_drag", 2, 0.1, "ledger_drag"},
    {"a_ledger_added", 3, 0.1, "ledger_added"},
    {"a_ledger_loads", 3, 0.1, "ledger_loads in time"},
    {"a_ledger_damping", 3, 0.1, "ledger_damping"},
    {"a_elongation", 2 * (NODES - 1) + AT, 0.01, "elongation off"},
    {"a_elongation_rest", 2 * (NODES - 1) + AT, 0.01, "elongation_rest off"},
    {"a_elongation_rest", 2 * (NODES - 1) + AT, -1, "senseless elongations"},
    {"a_damping", 0, 2001, "elongation_rest off"},
    {"a_damping", 0, -1, "senseless damping"},
    {"a_velocity", 3 * (2 * NODES + AT), 9, "velocity off"},
    {"a_node_load", 3 * (2 * NODES + AT), 3, NULL},
    {"a_drag", 0, 0.11, "ledger_drag"},
    {"a_drag", 1, 1.3, "ledger_drag"},
    {"a_drag", 2, 0.4, "ledger_drag"},
    {"a_added_mass", 0, 1, "ledger_added"},
    {"a_added_mass", 1, 0.3, "ledger_added"},
    {"current", 1, 0.6, "ledger_drag"},
    {"water_density", 0, 1001, "ledger_drag"},
    {"a_load_residual", 2, 1, NULL},
};

/* Scenes with another drag and other loads. */
static const OtherScene OTHER[] = {
    {"diameter: 0.1", "diameter: 0.10001"},
    {"normal: 1.2", "normal: 1.2001"},
    {"tangential: 0.3", "tangential: 0.3001"},
    {"added_normal: 0.9", "added_normal: 0.9001"},
    {"added_tangential: 0.2", "added_tangential: 0.2001"},
    {"damping: 2e3", "damping: 2001"},
    {"velocity: [0.5, 0.2, 0]", "velocity: [0.5, 0.201, 0]"},
    {"force: [0, 3, 1]", "force: [0, 3, 1.001]"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
