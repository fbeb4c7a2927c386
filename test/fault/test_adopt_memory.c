/* SPDX-License-Identifier: BSD-3-Clause */
/* The files that are found in a directory without a list of capstan's: each allocation of listing
 * them is refused, which is said, and the list is let go of. Files that no result has the name of
 * are not among them. And result.nc is not begun with a field that there is not. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#define REFUSE_TEXT
#include "io/base/directory/directory_marker.h"
#include "io/results/writers.h"
#include "refuse.h"
#include "straight_rope.h"

enum { STEPS = 20 };

static void make_file(int folder, const char *name) {
    const int file = openat(folder, name, O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    assert_true(file >= 0);
    close(file);
}

static void each_allocation(void **state) {
    (void)state;
    char path[] = "adopt-XXXXXX", name[64];
    assert_non_null(mkdtemp(path));
    const int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    assert_true(folder >= 0);
    make_file(folder, "mine.txt");
    for (int k = 0; k < STEPS; k++) {
        snprintf(name, sizeof name, "step-%05d.vtp", k);
        make_file(folder, name);
    }
    bool reached = true;
    long tried = 0;
    for (; reached; tried++) {
        CpsiMarker marker = {0};
        CpsError err = {0};
        const long before = live;
        allowed = tried;
        const CpsStatus status = cpsi_marker_adopt(&marker, folder, path, &err);
        reached = allowed < 0;
        allowed = -1;
        if (reached) {
            assert_true(status == CPS_ERR_MEMORY && err.status == status && err.message[0]);
        } else {
            assert_int_equal(status, CPS_OK);
            assert_int_equal(marker.written.count, STEPS);
            assert_true(cpsi_names_have(&marker.written, "step-00003.vtp"));
            assert_false(cpsi_names_have(&marker.written, "mine.txt"));
        }
        cpsi_marker_free(&marker);
        assert_int_equal(live, before);
    }
    for (int k = 0; k < STEPS; k++) {
        snprintf(name, sizeof name, "step-%05d.vtp", k);
        unlinkat(folder, name, 0);
    }
    unlinkat(folder, "mine.txt", 0);
    close(folder);
    assert_int_equal(rmdir(path), 0);
    if (tried == 1) skip(); /* built as shared libraries they cannot be reached */
    print_message("%ld allocations, each refused\n", tried - 1);
    assert_true(tried > STEPS);
}

static void no_such_field(void **state) {
    (void)state;
    const double point[6] = {0, 0, 0, 6, 0, 0};
    const CpsLine line = straight_rope(point, 6, 4, 10, 1e4);
    CpsScene scene = cps_scene_default();
    scene.line_count = 1;
    scene.line = &line;
    CpsResultsOptions options = cps_results_options_default();
    options.fields = "position,colour";
    CpsEvolution *evolution = NULL;
    CpsiNetcdf *opened = NULL;
    CpsError err = {0};
    assert_int_equal(cps_evolution_create(&scene, &evolution, NULL), CPS_OK);
    assert_int_equal(cpsi_netcdf_open("adopt.nc", &scene, evolution, &options, &opened, &err),
                     CPS_ERR_ARGUMENT);
    assert_null(opened);
    assert_non_null(strstr(err.message, "colour"));
    assert_int_equal(access("adopt.nc", F_OK), -1);
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_allocation),
                                       cmocka_unit_test(no_such_field)};
    return cmocka_run_group_tests_name("files found", tests, NULL, NULL);
}
