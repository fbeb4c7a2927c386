/* SPDX-License-Identifier: BSD-3-Clause */
/* The readers keep what they read in a pool. Every request to it is refused in turn, also those for
 * which it would need no new block: each example, and a scene, a law and a driven system with all
 * that the examples do not have, is then refused for want of memory, and read when nothing is
 * refused. The pool is reached by the linker's --wrap. */
#include <glob.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "capstan/io.h"
#include "io/base/yaml/pool.h"

void *__real_cpsi_pool_take(CpsiPool *pool, size_t count, size_t size);
void *__wrap_cpsi_pool_take(CpsiPool *pool, size_t count, size_t size);
char *__real_cpsi_pool_text(CpsiPool *pool, const char *text, size_t n);
char *__wrap_cpsi_pool_text(CpsiPool *pool, const char *text, size_t n);

static long allowed = -1; /* requests until the one that is refused; negative: none is */

static bool refuse(void) { return allowed >= 0 && allowed-- == 0; }

void *__wrap_cpsi_pool_take(CpsiPool *pool, size_t count, size_t size) {
    return refuse() ? NULL : __real_cpsi_pool_take(pool, count, size);
}
char *__wrap_cpsi_pool_text(CpsiPool *pool, const char *text, size_t n) {
    return refuse() ? NULL : __real_cpsi_pool_text(pool, text, n);
}

typedef CpsStatus Read(const char *path, CpsError *err);

static CpsStatus read_scene(const char *path, CpsError *err) {
    CpsSceneFile *file = NULL;
    const CpsStatus status = cps_scene_read(path, NULL, &file, err);
    assert_true((status == CPS_OK) == (file != NULL));
    cps_scene_file_destroy(file);
    return status;
}

static CpsStatus read_law(const char *path, CpsError *err) {
    CpsLawFile *file = NULL;
    const CpsStatus status = cps_law_read(path, NULL, &file, err);
    assert_true((status == CPS_OK) == (file != NULL));
    cps_law_file_destroy(file);
    return status;
}

static CpsStatus read_drive(const char *path, CpsError *err) {
    CpsDriveFile *file = NULL;
    const CpsStatus status = cps_drive_read(path, NULL, &file, err);
    assert_true((status == CPS_OK) == (file != NULL));
    cps_drive_file_destroy(file);
    return status;
}

/* Every request of one file refused; *all counts them. */
static void refuse_each(Read *read, const char *path, long *all) {
    CpsError err;
    for (long k = 0;; ++k) {
        allowed = k;
        const CpsStatus status = read(path, &err);
        const bool reached = allowed < 0;
        allowed = -1;
        if (!reached) {
            if (status != CPS_OK) fail_msg("%s: %s", path, err.message);
            if (k == 0) skip(); /* built as shared libraries it cannot be reached */
            *all += k;
            return;
        }
        if (status != CPS_ERR_MEMORY)
            fail_msg("%s, request %ld: %s: %s", path, k, cps_status_name(status), err.message);
    }
}

static void refuse_examples(Read *read, const char *pattern, long *all) {
    glob_t found;
    assert_int_equal(glob(pattern, 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; ++i) refuse_each(read, found.gl_pathv[i], all);
    globfree(&found);
}

static void refuse_text(Read *read, const char *text, long *all) {
    static const char PATH[] = "pool-memory.yaml";
    FILE *file = fopen(PATH, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
    refuse_each(read, PATH, all);
    remove(PATH);
}

static void scenes(void **state) {
    (void)state;
    long all = 0;
    static const char NODES[] = "pool-nodes.csv";
    FILE *file = fopen(NODES, "w");
    assert_non_null(file);
    assert_true(fputs("x,y,z,arc_length,tension,reaction\nm,m,m,m,N,N\n"
                      "0,9,0,0,,0.5\n0.5,9,0,0.5,1,1\n1,9,0,1,1,0.5\n",
                      file) >= 0 &&
                fclose(file) == 0);
    refuse_examples(read_scene, EXAMPLES "/*.yaml", &all);
    refuse_text(
        read_scene,
        "capstan: 1\ntitle: everything\nobstacles:\n"
        "  bed: {plane: {}, friction: {axial: 0.5, lateral: 0.2, shape: box}}\n"
        "  drum: {cylinder: {point: [0, 0, -9], radius: 1}, friction: {set: {sum: [{disc: 0.1}, "
        "{segment: [[-0.1, 0], [0.1, 0]]}]}, grain: [1, 0, 0]}}\n"
        "  ball: {sphere: {centre: [0, 0, -20], radius: 1}, friction: 0.1}\n"
        "lines:\n"
        "  rope: {length: 1, elements: [0.25, [3, 0.75]], mass: 1, stiffness: 100, "
        "friction_zones: [{from: 0, to: 0.5, factor: 2}], start: {polyline: [[0, 0, 0], [0.5, 0, "
        "0], [0.5, 0.5, 0]]}, ends: {A: {held: [0, 0, 0]}, B: {force: [0, 1, 0]}}}\n"
        "  wire: {length: 1, weight: 1, stiffness: .inf, start: {nodes: pool-nodes.csv}, ends: "
        "{A: free, B: held}}\n"
        "  hang: {length: 1, elements: 5, weight: 1, stiffness: 9, start: {arc: {from: [1, 0, 5], "
        "centre: [0, 0, 5]}}, ends: {A: held, B: free}}\n"
        "  laid: {length: 2, elements: 5, weight: 1, stiffness: 9, start: static, ends: {A: {held: "
        "[0, 3, 0]}, B: {held: [1, 3, 0]}}}\n"
        "history:\n"
        "  - {name: out, rope.B: {force: [0, 2, 0]}, wire.B: {move: [0, 0.1, 0]}, gravity: [0, 0, "
        "-5], drum.turn: 20, steps: 2}\n"
        "  - {hang.B: {position: [0, 0, 6]}, hang.A: {force: [0, 0, 0]}}\n",
        &all);
    remove(NODES);
    assert_in_range(all, 1000, 100000);
}

static void laws(void **state) {
    (void)state;
    long all = 0;
    refuse_examples(read_law, EXAMPLES "/laws/*.yaml", &all);
    refuse_text(
        read_law,
        "capstan: 1\nlaw:\n  contacts:\n"
        "    - {map: [[1, 0, 0], [0, 1, 0]], of: {coulomb: {friction: 0.2, load: 9}}}\n"
        "    - {map: [[1, 0, 0]], of: {preimage: {map: [[2]], of: {interval: [-1, 3]}}}}\n"
        "    - {map: [[0, 1, 0], [0, 0, 1]], of: {hull: [{polytope: [[1, 1], [-1, 1], [0, "
        "-1]]}, {translate: {by: [0, 0.1], of: {scale: {by: 2, of: {ellipse: [1, 2]}}}}}]}}\n"
        "load: [1, 2, 3]\n",
        &all);
    refuse_text(read_law,
                "capstan: 1\nresistance:\n  - {dry: {disc: 1}}\n  - {viscous: [[1, 0], [0, 2]]}\n"
                "  - {power: {degree: 1.5, factor: 2, of: {disc: 1}}}\n"
                "  - {table: {points: [[0, 1], [1, 2], [3, 2.5]], of: {ellipse: [1, 2]}}}\n",
                &all);
    refuse_text(read_law,
                "capstan: 1\nlaw: {intersection: [{inequalities: {rows: [[1, 0], [0, 1]], offsets: "
                "[1, 1]}}, {subspace: [[1, 1]]}, {polar: {rays: [[-1, 0], [0, -1]]}}, {product: "
                "[{box: [[-.inf, 1]]}, {interval: 2}]}, {image: {map: [[1, 0], [0, 1]], of: "
                "{ellipsoid: [[9, 1], [1, 9]]}}}]}\n",
                &all);
    assert_in_range(all, 200, 100000);
}

static void drives(void **state) {
    (void)state;
    long all = 0;
    refuse_examples(read_drive, EXAMPLES "/drive/*.yaml", &all);
    refuse_text(read_drive,
                "capstan: 1\nplanimeter: {pole: [0, 0], pole_arm: 1, tracer_arm: 1.3, wheel: 0.4, "
                "friction: 0.2, load: 1, curve: {circle: {centre: [1, 1], radius: 0.2, points: "
                "9}}}\n",
                &all);
    refuse_text(read_drive,
                "capstan: 1\nplanimeter: {pole: [0, 0], pole_arm: 1, tracer_arm: 1.3, wheel: 0.4, "
                "friction: 0.2, load: 1, curve: [[1, 1], [1.2, 1], [1, 1.2]]}\n",
                &all);
    refuse_text(read_drive,
                "capstan: 1\nsweep: {law: {disc: 1}, stiffness: 1, position: [1, 0], end: [0, 0], "
                "path: {arc: {centre: [0, 1], angle: 90}}, steps: 9}\n",
                &all);
    assert_in_range(all, 400, 100000);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(scenes), cmocka_unit_test(laws),
                                       cmocka_unit_test(drives)};
    return cmocka_run_group_tests_name("readers without memory", tests, NULL, NULL);
}
