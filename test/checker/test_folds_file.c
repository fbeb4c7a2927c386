/* SPDX-License-Identifier: BSD-3-Clause */
/* A rope in a pit of three faces, whose nodes touch two and three of them at once, from a scene to
 * the checker: the file is sound and the scene's, and copies with a number changed are refused. */
#include "check.h"
#include "falsified.h"

/* three faces that rise from the origin */
static const char PIT[] = "v 0 0 0\nv 5 0 2\nv -3 5 2.5\nv -2 -5 3\nf 1 2 3\nf 1 3 4\nf 1 4 2\n";
/* with another slope of one of its edges */
static const char STEEPER[] =
    "v 0 0 0\nv 5 0 2\nv -3 5 2.50001\nv -2 -5 3\nf 1 2 3\nf 1 3 4\nf 1 4 2\n";
static const DataFile FILES[] = {{"pit.obj", PIT}, {"steeper.obj", STEEPER}};

static const char SCENE[] =
    "capstan: 1\n"
    "obstacles:\n"
    "  pit: {mesh: {file: pit.obj, form: obj, radius: 0.1}, friction: 0.2}\n"
    "lines:\n"
    "  rope: {length: 6, elements: 30, weight: 20, stiffness: 1e4, start: static, ends: {A: {held: "
    "[-1.9, 0.3, 2.4]}, B: {held: [2.4, 0.2, 1.6]}}}\n"
    "history:\n"
    "  - {name: drawn, steps: 2, rope.B: {position: [2.5, 0.6, 1.6]}}\n"
    "  - {name: back, steps: 2, rope.B: {position: [2.2, -0.2, 1.5]}}\n";
enum { STEPS = 5 };

/* Of the last step: node 18 touches two faces, node 16 three, the third by the element before it.
 */
enum { NODE = 4 * 31 + 18, ELEMENT = 4 * 30 + 15 };
static const FalseNumber FALSE[] = {
    {"obstacle_radius", 0, 0.1001, "contact_gap against the distance"},
    {"obstacle_radius", 0, 0.0999, "contact_gap against the distance"},
    {"obstacle_pit_mesh_vertex", 3 * 2 + 2, 2.5001, "normal against the obstacle's"},
    {"obstacle_pit_mesh_vertex", 2, 0.001, "contact_gap against the distance"},
    {"rope_obstacle_second", NODE, 1, "unknown obstacle in"},
    {"rope_obstacle_second", NODE, -1, "normal against the obstacle's"},
    {"rope_obstacle_second", NODE, -2, "unknown obstacle in"},
    {"rope_obstacle", NODE, -1, "unknown obstacle in"},
    {"rope_reaction_second", NODE, 2.25, "imbalance of forces"},
    {"rope_normal_second", 3 * NODE, 0.1, "normal against the obstacle's"},
    {"rope_slip_second", 3 * NODE + 1, 0.01, "slip against the path from the reference"},
    {"rope_contact_gap_second", NODE, 0.001, "contact_gap against the distance"},
    {"rope_friction_bound_second", NODE, 0.5, "times the reaction"},
    {"rope_friction_force_second", 3 * NODE, 0.3, "imbalance of forces"},
    {"rope_element_obstacle", ELEMENT, -1, "force without an obstacle"},
    {"rope_element_obstacle", ELEMENT, 1, "unknown obstacle in"},
    {"rope_element_reaction", ELEMENT, 0.7, "imbalance of forces"},
    {"rope_element_normal", 3 * ELEMENT, 0.1, "normal against the obstacle's"},
    {"rope_element_share", ELEMENT, 0.99, "place of an element's contact"},
};

static const OtherScene OTHER[] = {
    {"file: pit.obj", "file: steeper.obj"},
    {"radius: 0.1", "radius: 0.10001"},
    {"friction: 0.2", "friction: 0.21"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER),
                                        .file = FALSIFIED_ROWS(FILES)};
    return falsified_main(&FALSIFIED);
}
