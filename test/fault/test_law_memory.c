/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out at the k-th allocation of `capstan law`, for every k: reading a law, asking it in
 * all ways, drawing it. The command ends with EXIT_LIMIT and says why, everything allocated is
 * given back, and no part of a picture stays. Allocations are counted by wrapping them at link
 * time. */

#define REFUSE_TEXT
#include "refuse_in_copies.h"

/* allocations: a read file, its sets or systems and answers take this many at the very least */
enum { LEAST = 50 };

/* Two files: a wheel on an ellipse, which needs the solver, and a body with every kind of list; and
 * a resistance law.
 */
static const char WHEEL[] = "memory-wheel.yaml", BODY[] = "memory-body.yaml",
                  GREASE[] = "memory-grease.yaml", PICTURE[] = "memory-law.svg";
static const char WHEEL_TEXT[] = "capstan: 1\ntitle: Wheel\nload: [1, 0]\n"
                                 "law: {preimage: {map: [[0, -0.3], [1, 0], [0, 1]], of: {product: "
                                 "[{interval: 60}, {ellipse: [500, 400]}]}}}\n";
static const char BODY_TEXT[] =
    "capstan: 1\nlaw:\n  contacts:\n"
    "    - {map: [[1, 0, 0], [0, 1, 1]], of: {unit_load: {load: 50, of: {ball: {radius: 0.4, "
    "dimension: 2}}}}}\n"
    "    - {map: [[1, 0, 0], [0, 1, -1]], of: {polytope: [[1, 0], [0, 1], [-1, -1]]}}\n"
    "    - {map: [[0, 0, 1]], of: {translate: {by: [0.5], of: {box: [[-1, 2]]}}}}\n";
static const char GREASE_TEXT[] =
    "capstan: 1\nresistance:\n  - {dry: {disc: 3}}\n  - {viscous: [[2, 0], [0, 2]]}\n";

/* The second word of each is the file. */
#define REFUSE_EACH(argv, draws)                                \
    refuse_in_copies(cmd_law, (argv)[1], PICTURE, draws, LEAST, \
                     (int)(sizeof(argv) / sizeof *(argv)), argv)

static void planar_law(void **state) {
    (void)state;
    write_file(WHEEL, WHEEL_TEXT);
    static const char *const ASK[] = {"law",     WHEEL,        "--json", "--velocity",
                                      "1,1",     "--velocity", "0,1",    "--force",
                                      "400,200", "--force",    "1,0"};
    static const char *const DRAW[] = {"law",     WHEEL, "--velocity", "0,1",
                                       "--force", "1,0", "--plot",     PICTURE};
    REFUSE_EACH(ASK, false);
    REFUSE_EACH(DRAW, true);
    remove(WHEEL);
}

static void law_in_space(void **state) {
    (void)state;
    write_file(BODY, BODY_TEXT);
    static const char *const ASK[] = {"law",        BODY,    "--velocity", "1,1,0",
                                      "--velocity", "0,0,0", "--force",    "0.1,0.2,0.3"};
    static const char *const DRAW[] = {"law",    BODY,    "--velocity", "0,0,1",
                                       "--plot", PICTURE, "--axes",     "1,3"};
    REFUSE_EACH(ASK, false);
    REFUSE_EACH(DRAW, true);
    remove(BODY);
}

static void resistance_law(void **state) {
    (void)state;
    write_file(GREASE, GREASE_TEXT);
    static const char *const ASK[] = {"law", GREASE,    "--json", "--velocity",
                                      "1,1", "--force", "0,-5"};
    REFUSE_EACH(ASK, false);
    remove(GREASE);
}

/* Laws whose sets and cones are unbounded, round, or of every number of dimensions; each is drawn
 * with what is asked. */
static void every_shape(void **state) {
    (void)state;
    static const struct {
        const char *law, *velocity, *force;
    } SHAPE[] = {
        {"law: {interval: [-2, .inf]}\n", "1", "-2"},
        {"law: {strip: {normal: [1, 1], width: 2}}\n", "1,1", "1,1"},
        {"law: {half_space: {normal: [0, 1], offset: 1}}\n", "0,1", "3,1"},
        {"law: {half_space: {normal: [0, 0, 1], offset: 1}}\n", "0,0,1", "3,1,1"},
        {"law: {product: [{disc: 1}, {interval: [-1, 2]}]}\n", "1,0,0", "1,0,2"},
        {"law: {sum: [{ellipse: [1, 2]}, {ellipse: [2, 1]}]}\n", "1,2", "0.5,0.5"},
        {"law: {image: {map: [[1, 0, 1], [0, 1, 1]], of: {box: [[-1, 1], [-1, 1], [-1, 1]]}}}\n",
         "1,0", "2,0"},
        {"resistance:\n  - {dry: {disc: 3}}\n  - {viscous: [[2, 0], [0, 2]]}\n", "1,1", "0,-5"},
        {"resistance:\n  - {dry: {interval: 3}}\n  - {power: {degree: 1.5, factor: 2, of: "
         "{interval: 1}}}\n",
         "1", "-5"},
        {"resistance:\n  - {table: {points: [[0, 1], [1, 2], [3, 9]], of: {interval: 1}}}\n", "2",
         "-5"},
    };
    for (size_t i = 0; i < sizeof SHAPE / sizeof *SHAPE; i++) {
        char text[400];
        snprintf(text, sizeof text, "capstan: 1\n%s", SHAPE[i].law);
        write_file(WHEEL, text);
        const char *const draw[] = {"law", WHEEL,          "-v",     SHAPE[i].velocity,
                                    "-f",  SHAPE[i].force, "--plot", PICTURE};
        REFUSE_EACH(draw, true);
        remove(WHEEL);
    }
}

int main(int argc, char **argv) {
    if (argc > 1) which = argv[1];
    const struct CMUnitTest tests[] = {cmocka_unit_test(planar_law), cmocka_unit_test(law_in_space),
                                       cmocka_unit_test(resistance_law),
                                       cmocka_unit_test(every_shape)};
    return cmocka_run_group_tests_name("laws without memory", tests, NULL, NULL);
}
