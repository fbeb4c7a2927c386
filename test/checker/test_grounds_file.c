/* SPDX-License-Identifier: BSD-3-Clause */
/* A line drawn about on a grid whose friction changes from place to place, with frozen friction,
 * from a scene to the checker: the file is sound and the scene's, and copies with a number changed
 * are refused. */
#include "check.h"
#include "falsified.h"

/* x 0 to 8 and y 0 to 4, in steps of 2 and of 1; x changes fastest */
static const char GRID[] = "5 5\n0 2 4 6 8\n0 1 2 3 4\n"
                           "0 0 0.1\n2 0 0.3\n4 0 0.6\n6 0 0.4\n8 0 0\n"
                           "0 1 0.2\n2 1 0.4\n4 1 0.8\n6 1 0.4\n8 1 0.1\n"
                           "0 2 0.1\n2 2 0.5\n4 2 0.7\n6 2 0.3\n8 2 0\n"
                           "0 3 0.2\n2 3 0.4\n4 3 0.5\n6 3 0.3\n8 3 0.2\n"
                           "0 4 0\n2 4 0.2\n4 4 0.4\n6 4 0.1\n8 4 0.3\n";
static const char FACTOR[] = "5 5\n0 2 4 6 8\n0 1 2 3 4\n"
                             "0 0 1\n2 0 1.2\n4 0 0.9\n6 0 1\n8 0 1\n"
                             "0 1 0.8\n2 1 1\n4 1 0.5\n6 1 0.6\n8 1 1\n"
                             "0 2 1\n2 2 0.7\n4 2 1\n6 2 0.8\n8 2 1.1\n"
                             "0 3 1\n2 3 0.6\n4 3 1.2\n6 3 1\n8 3 0.9\n"
                             "0 4 1\n2 4 1\n4 4 1\n6 4 1\n8 4 1\n";
static const char OTHER_GRID[] = "5 5\n0 2 4 6 8\n0 1 2 3 4\n"
                                 "0 0 0.1\n2 0 0.3\n4 0 0.6\n6 0 0.4\n8 0 0\n"
                                 "0 1 0.2\n2 1 0.4\n4 1 0.8\n6 1 0.4\n8 1 0.1\n"
                                 "0 2 0.1\n2 2 0.5\n4 2 0.7\n6 2 0.3\n8 2 0\n"
                                 "0 3 0.2\n2 3 0.4\n4 3 0.5\n6 3 0.3\n8 3 0.2\n"
                                 "0 4 0\n2 4 0.2\n4 4 0.4\n6 4 0.1\n8 4 0.30001\n";
static const char WIDER_GRID[] = "5 5\n0 2 4 6 8.00001\n0 1 2 3 4\n"
                                 "0 0 0.1\n2 0 0.3\n4 0 0.6\n6 0 0.4\n8.00001 0 0\n"
                                 "0 1 0.2\n2 1 0.4\n4 1 0.8\n6 1 0.4\n8.00001 1 0.1\n"
                                 "0 2 0.1\n2 2 0.5\n4 2 0.7\n6 2 0.3\n8.00001 2 0\n"
                                 "0 3 0.2\n2 3 0.4\n4 3 0.5\n6 3 0.3\n8.00001 3 0.2\n"
                                 "0 4 0\n2 4 0.2\n4 4 0.4\n6 4 0.1\n8.00001 4 0.3\n";
static const DataFile FILES[] = {{"bed.txt", GRID},
                                 {"factor.txt", FACTOR},
                                 {"other.txt", OTHER_GRID},
                                 {"wider.txt", WIDER_GRID}};

static const char SCENE[] =
    "capstan: 1\n"
    "obstacles:\n"
    "  bed: {ground: {file: bed.txt, form: moordyn_c, friction_factor: factor.txt}, friction: "
    "0.6}\n"
    "lines:\n"
    "  rope: {length: 7, elements: 70, weight: 5, stiffness: 1e4, start: static, ends: {A: {held: "
    "[0.8, 1.6, 0.4]}, B: {held: [7.2, 1.7, 0.4]}}}\n"
    "friction_policy: frozen\n"
    "history:\n"
    "  - {name: aside, steps: 3, rope.B: {position: [7.4, 2.9, 0.5]}}\n"
    "  - {name: back, steps: 2, rope.B: {position: [6.9, 2.2, 0.45]}}\n";
enum { STEPS = 6 };

static const FalseNumber FALSE[] = {
    {"obstacle_bed_grid_z", 12, 0.71, "depth below an obstacle"},
    {"obstacle_bed_grid_z", 12, 0.69, "normal against the obstacle's"},
    {"obstacle_bed_grid_z", 24, 0.3001, NULL},
    {"obstacle_bed_grid_z", 7, 0.8 + 1e-6, "normal against the obstacle's"},
    {"obstacle_bed_grid_z", 0, NAN, "no whole grid of obstacle 'bed'"},
    {"obstacle_bed_grid_z", 0, INFINITY, "no whole grid of obstacle 'bed'"},
    {"obstacle_bed_grid_x", 2, 4.001, "normal against the obstacle's"},
    {"obstacle_bed_grid_x", 2, 2, "no whole grid of obstacle 'bed'"},
    {"obstacle_bed_grid_x", 4, 8.0001, NULL},
    {"obstacle_bed_grid_y", 2, 2.001, "normal against the obstacle's"},
    {"obstacle_bed_grid_y", 2, 3.5, "no whole grid of obstacle 'bed'"},
    {"obstacle_bed_grid_y", 0, NAN, "no whole grid of obstacle 'bed'"},
    {"obstacle_bed_grid_friction_factor", 12, 1.01, "times the reaction"},
    {"obstacle_bed_grid_friction_factor", 12, 0.99, "times the reaction"},
    {"obstacle_bed_grid_friction_factor", 24, 1.01, NULL},
    {"obstacle_bed_grid_friction_factor", 24, NAN, NULL},
    {"obstacle_point", 2, 0.001, "depth below an obstacle"},
    {"obstacle_point", 0, 0.001, "normal against the obstacle's"},
    {"obstacle_friction_axial", 0, 0.61, "times the reaction"},
};

/* Scenes with another ground. */
static const OtherScene OTHER[] = {
    {"file: bed.txt", "file: other.txt"},
    {"file: bed.txt, form: moordyn_c, friction_factor: factor.txt",
     "file: wider.txt, form: moordyn_c"},
    {", friction_factor: factor.txt", ""},
    {"friction_factor: factor.txt", "friction_factor: bed.txt"},
    {"friction_factor: factor.txt", "friction_factor: factor.txt, extend: true"},
    {"friction_factor: factor.txt", "friction_factor: factor.txt, point: [0, 0, -0.00001]"},
    {"friction: 0.6", "friction: 0.60001"},
    {"{ground: {file: bed.txt, form: moordyn_c, friction_factor: factor.txt}", "{plane: {}"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER),
                                        .file = FALSIFIED_ROWS(FILES)};
    return falsified_main(&FALSIFIED);
}
