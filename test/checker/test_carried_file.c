/* SPDX-License-Identifier: BSD-3-Clause */
/* Points in time on ground that moves, from a scene to the checker: the file is sound and the
 * scene's, and copies are refused in which a velocity, a slip or a work is that of ground at rest,
 * or the ground moves otherwise. */
#include "check.h"
#include "falsified.h"

/* Two clumps on a line, one of them thrown, on a table that rises, goes on and turns about its
 * normal; a third one on a drum that turns under it. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -9.81]\nobstacles:\n"
    "  table: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, friction: 0.3}\n"
    "  drum: {cylinder: {point: [10, 0, 1], axis: [0, 1, 0], radius: 0.5}, friction: 0.2}\n"
    "points:\n"
    "  near: {free: [1, 0, 0], mass: 4}\n"
    "  far: {free: [2, 0.5, 0], mass: 6, velocity: [0, 1, 0]}\n"
    "  rider: {free: [10.1, 0, 1.4898979485566356], mass: 5}\n"
    "lines:\n"
    "  a: {length: 1.118033988749895, elements: 4, mass: 0.3, stiffness: 1e4, start: {straight: "
    "{from: [1, 0, 0], to: [2, 0.5, 0]}}, ends: {A: {point: near}, B: {point: far}}}\n"
    "  b: {length: 2.427016, elements: 4, mass: 0.3, stiffness: 1e4, quasi_static: true, start: "
    "{straight: {from: [12, 0, 3], to: [10.1, 0, 1.4898979485566356]}}, ends: {A: held, B: "
    "{point: rider}}}\n"
    "history:\n"
    "  - {name: carry, duration: 0.2, steps: 10, drum.turn: 40, table.obstacle: {move: [0.2, 0.1, "
    "0.05], turn: 10, axis: [0, 0, 1], about: [0, 1, 0]}}\n"
    "  - {name: stop, duration: 0.1, steps: 5}\n";
enum { STEPS = 15, LINES = 2, POINTS = 3, NEAR = 0, FAR = 1, RIDER = 2, A_NODES = 5 };

#define POINT(step, point)    ((step)*POINTS + (point))
#define PLACE(step, point, a) (3 * POINT(step, point) + (a))

static const FalseNumber FALSE[] = {
    /* of the ground 0.25 m/s */
    {"velocity_of_point", PLACE(5, NEAR, 2), 0, "near: velocity out of the ground"},
    {"velocity_of_point", PLACE(12, NEAR, 2), 0.25, "near: velocity out of the ground"},
    {"rest_velocity_of_point", PLACE(6, NEAR, 2), 0, "near: v* off the velocity of the ground"},
    {"reference_of_point", PLACE(6, NEAR, 2), 0.03, "near: reference off that of the ground"},
    {"slip_of_point", PLACE(5, FAR, 0), 0, "far: error of the slip"},
    {"slip_of_point", PLACE(5, RIDER, 0), 0, "rider: error of the slip"},
    {"friction_of_point", PLACE(5, FAR, 0), 0, "far: "},
    {"friction_of_point", PLACE(5, RIDER, 0), 0, "rider: "},
    {"dissipated_of_point", POINT(5, NEAR), 0, "near: dissipated energy against the work"},
    {"dissipated_of_point", POINT(5, FAR), 0, "far: dissipated energy against the work"},
    {"dissipated_of_point", POINT(5, RIDER), 0, "rider: dissipated energy against the work"},
    {"ledger_scheme_of_point", POINT(5, NEAR), 1, "near: ledger, work of lines and load"},
    {"ledger_impact_of_point", POINT(5, FAR), 1, "far: ledger, work of lines and load"},
    {"a_slip", 3 * (5 * A_NODES + 2), 0, "line a: slip against the path from the reference"},
    {"a_friction_force", 3 * (5 * A_NODES + 2), 0, "line a: "},
    {"a_share", 5, 1, "line a: share of the step in which the ground moves"},
    {"obstacle_shift", 3 * (2 * 5), 0.01, "obstacle_place is not where the shifts lead"},
    {"obstacle_turn", 2 * 5 + 1, 0.01, NULL},
};

/* Scenes in which it moves otherwise. */
static const OtherScene OTHER[] = {
    {"drum.turn: 40", "drum.turn: 40.001"},
    {"move: [0.2, 0.1, 0.05]", "move: [0.2, 0.1, 0.050001]"},
    {"turn: 10, axis", "turn: 10.001, axis"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = LINES * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
