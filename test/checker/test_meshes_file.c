/* SPDX-License-Identifier: BSD-3-Clause */
/* A line drawn over a wedge of triangles that is shifted and turned, from a scene to the checker:
 * the file is sound and the scene's, and copies with a number changed are refused. */
#include "check.h"
#include "falsified.h"

/* a roof over a rectangle, its ridge along y at x = 0.3 */
static const char ROOF[] =
    "v -1 -2 0\nv 1 -2 0\nv 1 2 0\nv -1 2 0\nv 0.3 -2 1\nv 0.3 2 1\n"
    "f 1 4 3\nf 1 3 2\nf 1 5 6\nf 1 6 4\nf 2 3 6\nf 2 6 5\nf 1 2 5\nf 4 6 3\n";
static const char HIGHER[] =
    "v -1 -2 0\nv 1 -2 0\nv 1 2 0\nv -1 2 0\nv 0.3 -2 1\nv 0.3 2 1.00001\n"
    "f 1 4 3\nf 1 3 2\nf 1 5 6\nf 1 6 4\nf 2 3 6\nf 2 6 5\nf 1 2 5\nf 4 6 3\n";
/* the other diagonal of one face */
static const char DIVIDED[] =
    "v -1 -2 0\nv 1 -2 0\nv 1 2 0\nv -1 2 0\nv 0.3 -2 1\nv 0.3 2 1\n"
    "f 1 4 3\nf 1 3 2\nf 1 5 4\nf 4 5 6\nf 2 3 6\nf 2 6 5\nf 1 2 5\nf 4 6 3\n";
/* without its floor */
static const char OPEN[] = "v -1 -2 0\nv 1 -2 0\nv 1 2 0\nv -1 2 0\nv 0.3 -2 1\nv 0.3 2 1\n"
                           "f 1 5 6\nf 1 6 4\nf 2 3 6\nf 2 6 5\nf 1 2 5\nf 4 6 3\n";
static const DataFile FILES[] = {{"roof.obj", ROOF},
                                 {"higher.obj", HIGHER},
                                 {"divided.obj", DIVIDED},
                                 {"open.obj", OPEN}};

static const char SCENE[] =
    "capstan: 1\n"
    "obstacles:\n"
    "  roof: {mesh: {file: roof.obj, form: obj, radius: 0.25}, friction: 0.3}\n"
    "lines:\n"
    "  rope: {length: 5, elements: 60, weight: 5, stiffness: 1e4, start: {straight: {from: [-2.2, "
    "0.2, 1.5], to: [2.8, -0.1, 1.5]}}, ends: {A: held, B: held}}\n"
    "history:\n"
    "  - {name: down, steps: 2, rope.A: {position: [-2, 0.2, 0.5]}, rope.B: {position: [2.2, -0.1, "
    "0.4]}}\n"
    "  - {name: drawn, rope.B: {position: [2.3, 0.3, 0.2]}}\n"
    "  - {name: moved, steps: 2, roof.obstacle: {move: [0.05, 0, 0.05], turn: 4, axis: [0, 0.2, "
    "1], about: [0.3, 0, 0]}}\n";
enum { STEPS = 5 };

static const FalseNumber FALSE[] = {
    {"obstacle_roof_mesh_vertex", 3 * 4 + 2, 1.01, "slip against the path from the reference"},
    {"obstacle_roof_mesh_vertex", 3 * 4 + 2, 0.99, "slip against the path from the reference"},
    {"obstacle_roof_mesh_vertex", 3 * 5 + 0, 0.3001, "slip against the path from the reference"},
    {"obstacle_roof_mesh_vertex", 3 * 0 + 0, -1.001, "normal against the obstacle's"},
    {"obstacle_roof_mesh_vertex", 3 * 5 + 1, 2.001, NULL},
    {"obstacle_roof_mesh_vertex", 3 * 2 + 1, NAN, "no whole mesh of obstacle 'roof'"},
    {"obstacle_roof_mesh_vertex", 3 * 2 + 1, INFINITY, "no whole mesh of obstacle 'roof'"},
    {"obstacle_roof_mesh_triangle", 7, 6, "no whole mesh of obstacle 'roof'"},
    {"obstacle_roof_mesh_triangle", 7, -1, "no whole mesh of obstacle 'roof'"},
    {"obstacle_radius", 0, 0.2501, "slip against the path from the reference"},
    {"obstacle_radius", 0, 0.2499, "contact_gap against the distance"},
    {"obstacle_radius", 0, 0, "senseless obstacle"},
    {"obstacle_point", 2, 0.001, "obstacle_place is not where the shifts lead"},
    {"obstacle_shift_turn", 3, 0.01, "obstacle_direction is not where the shifts lead"},
    {"obstacle_friction_axial", 0, 0.31, "times the reaction"},
};

/* Scenes with another mesh. */
static const OtherScene OTHER[] = {
    {"file: roof.obj", "file: higher.obj"},
    {"file: roof.obj", "file: divided.obj"},
    {"file: roof.obj", "file: open.obj"},
    {"radius: 0.25", "radius: 0.25001"},
    {"radius: 0.25", "radius: 0.25, scale: 1.00001"},
    {"radius: 0.25", "radius: 0.25, point: [0, 0.00001, 0]"},
    {"radius: 0.25", "radius: 0.25, rotation: {quaternion: [1, 0, 0.00001, 0]}"},
    {"radius: 0.25", "radius: 0.25, two_sided: true"},
    {"turn: 4", "turn: 4.00001"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER),
                                        .file = FALSIFIED_ROWS(FILES)};
    return falsified_main(&FALSIFIED);
}
