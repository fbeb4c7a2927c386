/* SPDX-License-Identifier: BSD-3-Clause */
/* A line that moves in time in waves on a current, far from the origin, with drag and water that is
 * moved along, from a scene to the checker: the file is sound and the scene's, and copies with a
 * number changed are refused. */
#include "check.h"
#include "falsified.h"

static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\nwater_density: 1000\nwater_surface: 7\n"
    "current: [{z: 0, velocity: [0.5, 0.2, 0]}, {z: 10, velocity: [1, 0, 0]}]\n"
    "waves: {depth: 7, ramp: 2, components: [{amplitude: 0.5, period: 5, direction: 20, phase: "
    "30}, "
    "{amplitude: 0.2, frequency: 0.4, direction: -70}]}\n"
    "obstacles:\n"
    "  bed: {plane: {point: [5000, 0, 0], normal: [0, 0.1, 1]}, friction: 0.4}\n"
    "lines:\n"
    "  a: {length: 20, elements: 40, mass: 12, stiffness: 1e5, start: static, "
    "ends: {A: {held: [5000, 0, 0.2]}, B: {held: [5016, 0, 6]}}, "
    "drag: {diameter: 0.1, normal: 1.2, tangential: 0.3, added_normal: 0.9, added_tangential: "
    "0.2}}\n"
    "history:\n"
    "  - {name: sway, duration: 1, steps: 4, a.B: {move: [0, 0, 0], sine: [1, 2, 0], period: 3}}\n"
    "  - {name: later, duration: 2, steps: 2}\n";
enum { STEPS = 7, NODES = 41, AT = 30 };

static const FalseNumber FALSE[] = {
    {"a_ledger_waves", 2, 0.1, "ledger in time"},
    {"a_ledger_waves", 2, 0.1, "ledger_waves"},
    {"a_ledger_drag", 2, 0.1, "ledger_drag"},
    {"a_ledger_added", 3, 0.1, "ledger_added"},
    {"waves", 0, 0.51, "ledger_waves"},
    {"waves", 1, 5.05, "ledger_waves"},
    {"waves", 2, 0.4, "ledger_waves"},
    {"waves", 3, 0.6, "ledger_waves"},
    {"waves", 4, 0.21, "ledger_waves"},
    {"waves", 0, -1, "senseless numbers: waves"},
    {"waves", 1, 0, "senseless numbers: waves"},
    {"wave_depth", 0, 7.2, "ledger_waves"},
    {"wave_depth", 0, -7, "cannot read: waves"},
    {"wave_ramp", 0, 2.1, "ledger_waves"},
    {"wave_ramp", 0, -2, "cannot read: waves"},
    {"water_surface", 0, 7.1, "ledger_waves"},
    {"a_added_mass", 0, 1, "ledger_waves"},
    {"a_added_mass", 1, 0.3, "ledger_waves"},
    {"a_drag", 0, 0.11, "ledger_waves"},
    {"a_node_load", 3 * (2 * NODES + AT), 3, NULL},
    {"time", 3, 0.8, NULL},
};

/* Scenes with other waves. */
static const OtherScene OTHER[] = {
    {"amplitude: 0.5", "amplitude: 0.50001"},
    {"period: 5", "period: 5.0001"},
    {"direction: 20", "direction: 20.001"},
    {"phase: 30", "phase: 30.001"},
    {"frequency: 0.4", "frequency: 0.40001"},
    {"direction: -70", "direction: -70.01"},
    {"depth: 7", "depth: 7.0001"},
    {"depth: 7", "depth: .inf"},
    {"ramp: 2", "ramp: 2.0001"},
    {", {amplitude: 0.2, frequency: 0.4, direction: -70}", ""},
    {"water_surface: 7", "water_surface: 7.0001"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
