/* SPDX-License-Identifier: BSD-3-Clause */
/* A line that moves in time on a slope that gives and is damped, from a scene to the checker: the
 * file is sound and the scene's, and copies with a number changed are refused. */
#include "check.h"
#include "falsified.h"

static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\n"
    "obstacles:\n"
    "  bed: {plane: {point: [0, 0, 0], normal: [0, 0.1, 1]}, friction: 0.4, stiffness: 3e4, "
    "damping: 900}\n"
    "lines:\n"
    "  a: {length: 20, elements: 40, mass: 12, stiffness: 1e5, bearing_width: 0.1, start: static, "
    "ends: {A: {held: [0, 0, 0.2]}, B: {held: [16, 0, 6]}}}\n"
    "history:\n"
    "  - {name: sway, duration: 1, steps: 8, a.B: {move: [0, 0, 0], sine: [2, 2, 0], period: 3}}\n";
enum { STEPS = 9, NODES = 41, AT = 10 };

static const FalseNumber FALSE[] = {
    {"obstacle_stiffness", 0, 3.01e4, "sum of local gaps"},
    {"obstacle_stiffness", 0, 3.01e4, "ledger_elastic in time"},
    {"obstacle_stiffness", 0, 0, "a value that cannot be"},
    {"obstacle_damping", 0, 910, "claimed primal"},
    {"obstacle_damping", 0, -1, "a value that cannot be"},
    {"a_bearing_width", 0, 0.101, "sum of local gaps"},
    {"a_ledger_damping", 4, 0.1, "ledger_damping"},
    {"a_ledger_elastic", 4, 0.1, "ledger_elastic in time"},
    {"a_ledger_impact", 4, 0.1, "ledger in time"},
    {"a_reaction", 4 * NODES + AT, 90, "sum of local gaps"},
    {"a_span", 4 * NODES + AT, 0.05, "velocity off"},
};

static const OtherScene OTHER[] = {
    {"stiffness: 3e4", "stiffness: 30001"},
    {"damping: 900", "damping: 901"},
    {"bearing_width: 0.1", "bearing_width: 0.1001"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
