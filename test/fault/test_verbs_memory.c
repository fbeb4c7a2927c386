/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory runs out at the k-th allocation of `capstan run`, `study`, `check` and `schema`, for every
 * k that is ours (libfyaml and libnetcdf end the process, docs/validation.md). The command ends
 * with EXIT_LIMIT and says why, everything allocated is given back, no file stays under a temporary
 * name, and once nothing is refused the same command ends well in the directory that the others
 * have left. */
#define REFUSE_TEXT
#include <dirent.h>

#include "hull_set.h"
#include "refuse_again.h"

/* allocations: reading a scene takes this many at the very least */
enum { LEAST = 5 };

static const char SCENE[] = "memory-verbs.yaml", LAID[] = "memory-verbs-laid",
                  NODES[] = "memory-verbs-laid/completed.csv", OUT[] = "memory-verbs-out";
static const char TEXT[] =
    "capstan: 1\ntitle: without memory\nfriction_policy: frozen\nobstacles:\n  bed: {plane: "
    "{normal: [0, "
    "0, 1]}, friction: 0.5}\nlines:\n"
    "  rope: {length: 1, elements: 4, weight: 1, stiffness: 100, start: {straight: {from: [0, 0, "
    "0], to: [1, 0, 0]}}, ends: {A: held, B: held}}\n"
    "history:\n  - {name: out, rope.B: {position: [1.1, 0, 0]}, steps: 2}\n";

/* Two lines, each kind of obstacle, friction, start, end and entry; and the nodes of one of them.
 */
static const char EVERYTHING[] = "memory-everything.yaml", EVERY_NODE[] = "memory-nodes.csv";
static const char EVERYTHING_TEXT[] =
    "capstan: 1\ntitle: everything\ngravity: [0, 0, -9.81]\nobstacles:\n"
    "  bed: {plane: {normal: [0, 0, 1]}, friction: {axial: 0.5, lateral: 0.2, shape: box}}\n"
    "  drum: {cylinder: {point: [0, 0, -9], axis: [0, 1, 0], radius: 1}, friction: {set: " HULL_SET
    ", grain: [1, 0, 0]}}\n"
    "  ball: {sphere: {centre: [0, 0, -20], radius: 1}, friction: 0.1}\n"
    "lines:\n"
    "  rope: {length: 1, elements: [0.25, [3, 0.75]], mass: 1, stiffness: 100, friction_zones: "
    "[{from: 0, to: 0.5, factor: 2}], start: {polyline: [[0, 0, 0], [0.5, 0, 0], [0.5, 0.5, 0]]}, "
    "ends: {A: {held: [0, 0, 0]}, B: {force: [0, 1, 0]}}}\n"
    "  wire: {length: 1, weight: 1, stiffness: .inf, start: {nodes: memory-nodes.csv}, ends: {A: "
    "free, B: held}}\n"
    "  hang: {length: 1, elements: 5, weight: 1, stiffness: 9, start: {arc: {from: [1, 0, 5], "
    "centre: [0, 0, 5]}}, ends: {A: held, B: free}}\n"
    "history:\n"
    "  - {name: out, rope.B: {force: [0, 2, 0]}, wire.B: {move: [0, 0.1, 0]}, gravity: [0, 0, -5], "
    "drum.turn: 20, steps: 2}\n"
    "  - {hang.B: {position: [0, 0, 6]}, hang.A: {force: [0, 0, 0]}}\n";
/* Points where lines meet, which need obstacles without directions of friction. */
static const char POINTS[] = "memory-points.yaml";
static const char POINTS_TEXT[] =
    "capstan: 1\nobstacles: {bed: {plane: {}, friction: 0.5}}\npoints:\n"
    "  post: {held: [0, 0, 0]}\n"
    "  knot: {free: [0.9, 0, 0], weight: 1, force: [1, 0, 0]}\n"
    "lines:\n"
    "  one: {length: 0.9, elements: 3, weight: 1, stiffness: 100, start: static, ends: {A: {point: "
    "post}, B: {point: knot}}}\n"
    "  two: {length: 0.5, elements: 2, weight: 1, stiffness: 100, start: static, ends: {A: {point: "
    "knot}, B: {held: [1.2, 0.3, 0]}}}\n"
    "history: [{knot.point: {force: [1, -1, 0]}, post.point: {move: [0, 0.1, 0]}}]\n";
/* Rigid bodies, and points on them. */
static const char BODIES[] = "memory-bodies.yaml";
static const char BODIES_TEXT[] =
    "capstan: 1\nbodies:\n"
    "  spar: {free: [0, 0, 0], rotation: {roll_pitch_yaw: [0, 1, 0]}, fixed: [rz], weight: 5, "
    "buoyancy: 9, hydrostatics: {z: 9, rx: 9, ry: 9}}\n"
    "  barge: {held: [3, 0, 0]}\n"
    "points: {eye: {body: spar, at: [0, 0, 1]}, bow: {body: barge}}\n"
    "lines:\n"
    "  one: {length: 2.5, elements: 3, weight: 1, stiffness: 100, start: static, ends: {A: {held: "
    "[-2, 0, 0]}, B: {point: eye}}}\n"
    "  two: {length: 3.5, elements: 2, weight: 1, stiffness: 100, start: static, ends: {A: {point: "
    "eye}, B: {point: bow}}}\n"
    "history: [{spar.body: {force: [1, 0, 0]}, barge.body: {move: [0, 0.1, 0]}}]\n";
static const char EVERY_NODE_TEXT[] =
    "x,y,z,arc_length,tension,reaction\nm,m,m,m,N,N\n# a remark\n0,9,0,0,,0.5\n0.5,9,0,0.5,1,1\n"
    "1,9,0,1,1,0.5\n";

/* Is there a file in the directory that only a run which goes on may have? */
static bool has_temporary(void) {
    DIR *listing = opendir(OUT);
    bool found = false;
    if (listing)
        for (struct dirent *entry; (entry = readdir(listing)) != NULL;)
            found = found || strstr(entry->d_name, ".part") ||
                    strcmp(entry->d_name, ".capstan.run") == 0;
    if (listing) closedir(listing);
    return found;
}

static void refuse_into_directory(Command *run, int argc, const char *const *argv) {
    assert_int_equal(system("rm -rf memory-verbs-out"), 0);
    refuse_again(run, LEAST, argc, argv);
    assert_false(has_temporary());
}

#define INTO_DIRECTORY(run, ...)                                                \
    do {                                                                        \
        static const char *const WORDS[] = {__VA_ARGS__};                       \
        refuse_into_directory(run, (int)(sizeof WORDS / sizeof *WORDS), WORDS); \
    } while (0)

static void runs(void **state) {
    (void)state;
    INTO_DIRECTORY(cmd_run, "run", SCENE, "-q", "-o", OUT, "--force");
    INTO_DIRECTORY(cmd_run, "run", SCENE, "-q", "-o", OUT, "--resume", "--json", "--no-paraview");
    INTO_DIRECTORY(cmd_run, "run", SCENE, "-q", "-o", OUT, "--method", "regularized");
}

static void studies(void **state) {
    (void)state;
    INTO_DIRECTORY(cmd_study, "study", SCENE, "-q", "-o", OUT);
    INTO_DIRECTORY(cmd_study, "study", SCENE, "-q", "-o", OUT, "--history");
    INTO_DIRECTORY(cmd_study, "study", SCENE, "-q", "-o", OUT, "--complete", "meander");
    bool reached;
    assert_int_equal(command(cmd_study, -1, 7,
                             (const char *const[]){"study", SCENE, "-q", "-o", LAID, "--complete",
                                                   "straight"},
                             &reached),
                     EXIT_OK);
    INTO_DIRECTORY(cmd_study, "study", SCENE, "-q", "-o", OUT, "--judge", NODES);
}

static void others(void **state) {
    (void)state;
    INTO_DIRECTORY(cmd_check, "check", SCENE);
    write_file(EVERY_NODE, EVERY_NODE_TEXT);
    write_file(EVERYTHING, EVERYTHING_TEXT);
    INTO_DIRECTORY(cmd_check, "check", EVERYTHING);
    INTO_DIRECTORY(cmd_run, "run", EVERYTHING, "-q", "-o", OUT, "--force");
    remove(EVERYTHING);
    remove(EVERY_NODE);
    write_file(POINTS, POINTS_TEXT);
    INTO_DIRECTORY(cmd_check, "check", POINTS);
    INTO_DIRECTORY(cmd_run, "run", POINTS, "-q", "-o", OUT, "--force");
    remove(POINTS);
    write_file(BODIES, BODIES_TEXT);
    INTO_DIRECTORY(cmd_check, "check", BODIES);
    INTO_DIRECTORY(cmd_run, "run", BODIES, "-q", "-o", OUT, "--force", "--stiffness");
    remove(BODIES);
    static const char *const WHAT[] = {"scene", "law", "drive"};
    for (int i = 0; i < 3; ++i) {
        bool reached;
        const long before = live;
        const int code =
            command(cmd_schema, 0, 2, (const char *const[]){"schema", WHAT[i]}, &reached);
        assert_true(code == (reached
                                 ? EXIT_LIMIT
                                 : EXIT_OK)); /* what it writes needs little or no memory of ours */
        assert_int_equal(live, before);
    }
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(runs), cmocka_unit_test(studies),
                                       cmocka_unit_test(others)};
    if (argc > 1) which = argv[1];
    write_file(SCENE, TEXT);
    const int failed = cmocka_run_group_tests_name("verbs without memory", tests, NULL, NULL);
    remove(SCENE);
    return system("rm -rf memory-verbs-out memory-verbs-laid") != 0 || failed;
}
