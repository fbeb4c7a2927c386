/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out at the k-th allocation of `capstan drive`, for every k: reading each kind of
 * file, answering it, drawing it. The command ends with EXIT_LIMIT and says why, everything
 * allocated is given back, and no part of a picture stays. Allocations are counted by wrapping them
 * at link time. */

#define REFUSE_TEXT
#include "refuse_in_copies.h"

/* allocations: a read file, its sets or systems and answers take this many at the very least */
enum { LEAST = 5 };

/* One small file of each kind. */
static const char FILE_NAME[] = "memory-drive.yaml", PICTURE[] = "memory-drive.svg";
static const char SYSTEM[] =
    "capstan: 1\ntitle: Wheel\nsystem:\n  parameters: [spin, side, roll]\n  laws:\n"
    "    - {name: brake, on: [spin], law: {interval: 60}}\n    - {on: [side, roll], law: {disc: "
    "500}}\n"
    "  drive: [side, {roll: 1, spin: -0.3}]\n  load: {side: 3}\n  velocity: [[1, 1]]\n";
static const char GREASE[] =
    "capstan: 1\nsystem:\n  parameters: [a, b]\n  laws: [{on: [a, b], resistance: [{dry: "
    "{disc: 3}}, {viscous: [[2, 0], "
    "[0, 2]]}]}]\n  constraints: [{a: 1, b: -2}]\n  drive: [a]\n  velocity: [[1]]\n";
static const char BODY[] =
    "capstan: 1\nbody:\n  patches:\n    - {rod: {half_length: 1, friction: 1, load: 1}}\n"
    "    - {point: {law: {ellipse: [1, 2]}}}\n    - {wheel: {radius: 1, friction: 1, load: 1, "
    "brake: 0.2}}\n"
    "  push: [{at: [1, 0], velocity: [0, 1]}]\n  tow: {hitch: [1, 0], path: [[2, 0]], steps: 3}\n";
static const char ROPE[] = "capstan: 1\nrope:\n  shape: {straight: {from: [0, 0], to: [1, 0]}}\n  "
                           "elements: 4\n  friction: 0.5\n  weight: 2\n"
                           "  ends: {B: [1, 1]}\n  path: [[1.1, 0.1]]\n  steps: 2\n";
static const char METER[] = "capstan: 1\nplanimeter: {pole: [0, 0], pole_arm: 1, tracer_arm: 1.3, "
                            "wheel: 0.4, friction: 0.2, load: 1,\n"
                            "  curve: {circle: {centre: [1, 0], radius: 0.2, points: 9}}}\n";
static const char SWEEP[] =
    "capstan: 1\nsweep: {law: {disc: 1}, stiffness: 1, path: [[2, 0]], steps: 4}\n";

/* answered as JSON, and drawn */
static void all_answers(const char *text) {
    static const char *const ASK[] = {"drive", FILE_NAME, "--json", "--quiet"};
    static const char *const DRAW[] = {"drive", FILE_NAME, "--quiet", "--plot", PICTURE};
    write_file(FILE_NAME, text);
    refuse_in_copies(cmd_drive, FILE_NAME, PICTURE, false, LEAST, (int)(sizeof ASK / sizeof *ASK),
                     ASK);
    refuse_in_copies(cmd_drive, FILE_NAME, PICTURE, true, LEAST, (int)(sizeof DRAW / sizeof *DRAW),
                     DRAW);
    remove(FILE_NAME);
}

static void system_maps(void **state) {
    (void)state;
    static const char *const REDUCED[] = {"drive", FILE_NAME, "-e", "-v",   "1,1",
                                          "-f",    "0,200",   "-p", PICTURE};
    all_answers(SYSTEM);
    write_file(FILE_NAME, SYSTEM);
    refuse_in_copies(cmd_drive, FILE_NAME, PICTURE, true, LEAST,
                     (int)(sizeof REDUCED / sizeof *REDUCED), REDUCED);
    remove(FILE_NAME);
}

static void system_resistance(void **state) {
    (void)state;
    static const char *const ASK[] = {"drive", FILE_NAME, "--json"};
    write_file(FILE_NAME, GREASE);
    refuse_in_copies(cmd_drive, FILE_NAME, PICTURE, false, LEAST, (int)(sizeof ASK / sizeof *ASK),
                     ASK);
    remove(FILE_NAME);
}

static void body(void **state) {
    (void)state;
    all_answers(BODY);
}

static void rope(void **state) {
    (void)state;
    all_answers(ROPE);
}

static void planimeter(void **state) {
    (void)state;
    all_answers(METER);
}

static void sweep(void **state) {
    (void)state;
    all_answers(SWEEP);
}

int main(int argc, char **argv) {
    if (argc > 1) which = argv[1];
    const struct CMUnitTest tests[] = {cmocka_unit_test(system_maps),
                                       cmocka_unit_test(system_resistance),
                                       cmocka_unit_test(body),
                                       cmocka_unit_test(rope),
                                       cmocka_unit_test(planimeter),
                                       cmocka_unit_test(sweep)};
    return cmocka_run_group_tests_name("driven systems without memory", tests, NULL, NULL);
}
