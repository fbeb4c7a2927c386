/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines on a capsule, a torus, a cone and a box that moves, and in a bowl, from a scene to the
 * checker: the file is sound and the scene's, and copies with a number changed are refused. */
#include "check.h"
#include "falsified.h"

#define LINE(name, x)                                                                     \
    "  " name                                                                             \
    ": {length: 4, elements: 50, weight: 3, stiffness: 1e5, start: {straight: {from: [" x \
    ", -2, 1.75], to: [" x ", 2, 1.75]}}, ends: {A: held, B: held}}\n"
#define DRAWN(name, x) \
    name ".A: {position: [" x ", -2, 0.6]}, " name ".B: {position: [" x ", 2, 0.4]}"
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\n"
    "obstacles:\n"
    "  rod: {capsule: {centre: [0, 0, 0.4], axis: [1, 0, 0.2], length: 1, radius: 1}, friction: "
    "0.3}\n"
    "  ring: {torus: {centre: [10, 0, 0.4], axis: [1, 0.1, 0], main_radius: 0.8, radius: 0.5}, "
    "friction: 0.3}\n"
    "  tip: {cone: {tip: [20.1, 0, 1.2], axis: [0, 0, -1], angle: 25, radius: 0.5}, friction: "
    "0.3}\n"
    "  quay: {box: {centre: [30, 0, 0.2], size: [2, 2.2, 1.6], radius: 0.3, rotation: {quaternion: "
    "[1, 0, 0, 0.1]}}, friction: 0.3}\n"
    "  bowl: {sphere: {centre: [15, 0, 0], radius: 40, inside: true}}\n"
    "lines:\n" LINE("a", "0") LINE("b", "10") LINE("c", "20")
        LINE("d",
             "30") "history:\n"
                   "  - {name: down, steps: 2, " DRAWN("a", "0") ", " DRAWN("b", "10") ", " DRAWN(
                       "c", "20") ", " DRAWN("d",
                                             "30") "}\n"
                                                   "  - {name: shift, quay.obstacle: {move: [0, 0, "
                                                   "0.1], turn: 3, axis: [0, 0, 1], about: [30, 0, "
                                                   "0]}, rod.turn: 4}\n";
enum { STEPS = 3, ROD = 0, RING = 1, TIP = 2, QUAY = 3, BOWL = 4 };

static const FalseNumber FALSE[] = {
    {"obstacle_kind", ROD, 1, "depth below an obstacle"},
    {"obstacle_kind", ROD, 4, "senseless obstacle in 'obstacle_kind and the like'"},
    {"obstacle_kind", QUAY, 70, "senseless obstacle in 'obstacle_kind and the like'"},
    {"obstacle_length", ROD, 0.5, "sum of local gaps"},
    {"obstacle_length", ROD, -1, "senseless obstacle_length"},
    {"obstacle_radius", ROD, 0.99, "slip against the path from the reference"},
    {"obstacle_main_radius", RING, 0.81, "normal against the obstacle's"},
    {"obstacle_main_radius", RING, 0.5, "senseless obstacle_main_radius"},
    {"obstacle_radius", RING, 0.51, "slip against the path from the reference"},
    {"obstacle_angle", TIP, 0.5, "contacts that are not with the nearest obstacles"},
    {"obstacle_angle", TIP, 1.6, "senseless obstacle_angle"},
    {"obstacle_size", 3 * QUAY + 2, 1.61, "normal against the obstacle's"},
    {"obstacle_size", 3 * QUAY + 1, 2.21, "normal against the obstacle's"},
    {"obstacle_size", 3 * QUAY + 2, 0.6, "senseless obstacle_size"},
    {"obstacle_side", 3 * QUAY + 1, 0.5, "normal against the obstacle's"},
    {"obstacle_side", 3 * QUAY + 2, 0.5, "senseless obstacle_side"},
    {"obstacle_inside", ROD, 1, "depth below an obstacle"},
    {"obstacle_inside", BOWL, 0, "depth below an obstacle"},
    {"obstacle_inside", BOWL, 2, "senseless obstacle_inside"},
    {"obstacle_radius", BOWL, 4, "depth below an obstacle"},
};

/* Scenes with other shapes. */
static const OtherScene OTHER[] = {
    {"length: 1, radius: 1", "length: 1.00001, radius: 1"},
    {"main_radius: 0.8", "main_radius: 0.80001"},
    {"angle: 25", "angle: 25.0001"},
    {"size: [2, 2.2, 1.6]", "size: [2.00001, 2.2, 1.6]"},
    {"quaternion: [1, 0, 0, 0.1]", "quaternion: [1, 0, 0, 0.10001]"},
    {"quaternion: [1, 0, 0, 0.1]", "quaternion: [1, 0, 0.00001, 0.1]"},
    {"radius: 0.3, rotation", "radius: 0.300001, rotation"},
    {"tip: [20.1", "tip: [20.10001"},
    {"  bowl: {sphere: {centre: [15, 0, 0], radius: 40, inside: true}}",
     "  bowl: {sphere: {centre: [15, 0, -100], radius: 40}}"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = 4 * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
