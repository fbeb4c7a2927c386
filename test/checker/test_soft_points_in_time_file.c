/* SPDX-License-Identifier: BSD-3-Clause */
/* A free point that moves in time in a bed that gives and is damped, from a scene to the checker:
 * the file is sound and the scene's, and copies with a number changed are refused, by themselves or
 * beside their scene. */
#include "check.h"
#include "falsified.h"

/* A clump that is lifted out of the bed while it is pulled along, and falls back. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\n"
    "obstacles:\n"
    "  bed: {plane: {normal: [0, 0.1, 1]}, friction: 0.4, stiffness: 3e4, damping: 2e3}\n"
    "points:\n"
    "  clump: {free: [8, 0, 0], mass: 90, bearing_area: 0.5}\n"
    "lines:\n"
    "  a: {length: 9, elements: 12, mass: 12, stiffness: 1e5, bearing_width: 0.1, start: static, "
    "ends: {A: {held: [0, 0, 0.2]}, B: {point: clump}}}\n"
    "  b: {length: 8, elements: 10, mass: 12, stiffness: 1e5, bearing_width: 0.1, start: static, "
    "ends: {A: {point: clump}, B: {held: [15, 0, 0.3]}}}\n"
    "history:\n"
    "  - {name: lift, duration: 0.8, steps: 16, clump.point: {force: [100, 300, 1600]}}\n"
    "  - {name: fall, duration: 1.2, steps: 20, clump.point: {force: [0, 0, 0]}}\n";
enum { STEPS = 37, IN = 4, SLIDES = 9, OUT = 24, LANDS = 34, BACK = 35 };

static const FalseNumber FALSE[] = {
    {"bearing_area_of_point", 0, 0.51, "point clump: reaction against that of the depth"},
    {"obstacle_damping", 0, 2.1e3, "point clump: reaction against that of the depth"},
    {"obstacle_damping", 0, 0, "point clump: reaction against that of the depth"},
    {"obstacle_stiffness", 0, 3.01e4, "point clump: reaction against that of the depth"},
    {"reaction_of_point", BACK, 1000, "point clump: reaction against that of the depth"},
    {"reference_of_point", 3 * BACK + 2, -0.1, "point clump: reference off that of the scheme"},
    {"span_of_point", BACK, 0.05, "point clump: "},
    {"velocity_of_point", 3 * BACK + 2, 0, "point clump: velocity off that of the places"},
    {"ledger_damping_of_point", BACK, 0, "point clump: energy lost to the damping of what gives"},
    {"ledger_damping_of_point", OUT, 1, "point clump: energy lost to the damping of what gives"},
    {"ledger_impact_of_point", LANDS, 1, "point clump: energy lost by impact of what does not"},
    {"ledger_scheme_of_point", BACK, 1, "point clump: ledger, work of lines and load"},
    {"friction_of_point", 3 * IN + 1, 0, "point clump: residual against the sum"},
    {"slip_of_point", 3 * SLIDES, 0.01, "point clump: error of the slip"},
    {"obstacle_of_point", BACK, -1, "point clump: force of an obstacle"},
};

static const OtherScene OTHER[] = {
    {"damping: 2e3", "damping: 2001"},
    {"stiffness: 3e4", "stiffness: 30001"},
    {"mass: 90", "mass: 90, inertia: 90.001"},
    {"bearing_area: 0.5", "bearing_area: 0.50001"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = 2 * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
