/* SPDX-License-Identifier: BSD-3-Clause */
/* The checker must accept an exact solution and refuse it when any one number is changed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "checker.h"
#include "sample.h"

static char path[] = "capstan-checker-XXXXXX";

static int make_path(void **state) {
    (void)state;
    int file = mkstemp(path);
    if (file < 0) return -1;
    close(file);
    return 0;
}

static int drop_path(void **state) {
    (void)state;
    return unlink(path);
}

static void exact_solution_is_certified(void **state) {
    (void)state;
    CheckerReport report;
    CHECK_INT(sample_write(path), 0);
    CHECK_INT(checker_file(path, &report, stdout), 0);
    CHECK_INT(report.records, 8);
    CHECK_INT(report.certified, 8);
    CHECK_NEAR(report.gap, 0, 1e-30); // every term of the sample is exact in binary
    CHECK_NEAR(report.force, 0, 1e-30);
}

/* one number changed, and a word of the finding it must lead to */
typedef struct Tamper {
    const char *variable;
    size_t index;
    double value;
    const char *finding;
} Tamper;

static const Tamper TAMPER[] = {
    // admissible forces and balance
    {"drag_friction", 9, -3.99, "imbalance of forces"},
    {"drag_friction", 9, -4.01, "friction above its bound"},
    {"drag_friction", 11, 0.01, "friction along the normal"},
    {"drag_friction", 0, 1, "on a held end"},
    {"drag_reaction", 2, 8.001, "imbalance of forces"},
    {"drag_reaction", 2, -1, "adhesion"},
    {"drag_segment_force", 9, 8.00000002, "imbalance of forces"},
    {"drag_load", 3, 1e-6, "imbalance of forces"},
    {"drag_friction_bound", 4, 1.9, "friction above its bound"},
    {"drag_friction_bound", 4, 2.1, "sum of local gaps"},
    {"drag_contact_gap", 1, INFINITY, "force without an obstacle"},
    {"drag_contact_gap", 1, 0.5, "sum of local gaps"},
    {"drag_normal", 5, 0.999, "length of the normal"},
    // admissible configuration
    {"drag_position", 12, 4.02, "sum of local gaps"},
    {"drag_position", 8, -1e-6, "depth below the obstacle"},
    {"drag_position", 0, 1e-6, "distance of a held end"},
    {"drag_reference", 12, 3.9, "claimed primal"},
    {"drag_tension", 3, 7.9, "tension_estimate"},
    {"drag_tension", 3, 2, "elongation beyond the tension"},
    {"drag_tension", 3, -1, "compression"},
    {"drag_element_length", 3, 1.1, "sum of local gaps"},
    {"drag_compliance", 0, 0.01, "sum of local gaps"},
    // what the second step takes over
    {"drag_reference", 15 + 3, 1.001, "the reference is not the position"},
    {"drag_position", 10, 1e-9, "the reference is not the position"},
    {"drag_friction_bound", 5 + 2, 4.001, "friction bound"},
    {"drag_friction_bound", 5 + 3, 0, "friction bound"},
    // claims
    {"drag_primal", 0, -39, "claimed primal"},
    {"drag_dual", 0, -39, "claimed dual"},
    {"drag_gap", 0, 1e-6, "claimed gap"},
    {"drag_scale", 0, 100, "claimed scale"},
    {"drag_tension_bound", 0, 1, "claimed tension_bound"},
    {"drag_force_residual", 0, 1e-6, "claimed force_residual"},
    {"drag_largest_force", 0, 11, "claimed largest_force"},
    {"drag_law_residual", 0, 1e-6, "claimed law_residual"},
    {"drag_contact_residual", 0, 1e-6, "claimed contact_residual"},
    {"drag_penetration", 0, 1e-6, "claimed penetration"},
    {"drag_dissipated", 0, 0, "claimed dissipated"},
    {"drag_outcome", 0, 3, "not certified, as the file says"},
    // numbers that are none
    {"drag_position", 4, NAN, "position holds a value that cannot be"},
    {"drag_tension", 0, INFINITY, "tension holds a value that cannot be"},
    {"drag_gap", 0, NAN, "gap holds a value that cannot be"},
    {"drag_element_length", 0, -1, "element_length holds a value that cannot be"},
    // outcomes other than solved
    {"drag_outcome", 0, 1, "taut, but the line is elastic"},
    {"drag_outcome", 0, 4, "unbounded, but an end is held"},
    {"drag_outcome", 0, 5, "infeasible, but"},
    {"drag_outcome", 0, 7, "unknown outcome"},
    {"tight_end_value", 3, 3.999, "distance of the ends - length"},
    {"tight_position", 3, 1.1, "stretch"},
    {"far_end_value", 3, 4, "infeasible, but the ends are"},
    {"far_proof", 0, 0.5, "proof vector"},
    {"far_proof_value", 0, 1, "proof_value"},
    {"loose_load", 12, 15, "unbounded, but the energy falls"},
    {"loose_proof", 2, -0.1, "rigid motion"},
    {"loose_proof_value", 0, 2, "proof_value"},
    {"loose_end_kind", 0, 0, "unbounded, but an end is held"},
};

static void every_change_is_refuted(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof TAMPER / sizeof *TAMPER; i++) {
        CHECK_INT(sample_write(path), 0);
        CHECK_INT(sample_poke(path, TAMPER[i].variable, TAMPER[i].index, TAMPER[i].value), 0);
        char *text = NULL;
        size_t size = 0;
        FILE *log = open_memstream(&text, &size);
        int result = checker_file(path, NULL, log);
        fclose(log);
        if (result == 0 || !strstr(text, TAMPER[i].finding)) {
            print_error("%s[%zu] = %g: result %d, expected a finding with \"%s\", got:\n%s", TAMPER[i].variable,
                        TAMPER[i].index, TAMPER[i].value, result, TAMPER[i].finding, text);
            fail();
        }
        free(text);
    }
    printf("%zu changes, each refused for its own reason\n", sizeof TAMPER / sizeof *TAMPER);
}

static void what_is_no_result_is_refused(void **state) {
    (void)state;
    CheckerReport report;
    CHECK_INT(checker_file("no-such-file.nc", &report, NULL), 2);
    CHECK_INT(report.refuted, 1);

    // cut short: the header still promises all the data
    CHECK_INT(sample_write(path), 0);
    CHECK_INT(truncate(path, 1000), 0);
    CHECK_GREATER(checker_file(path, &report, NULL), 0);
    CHECK_INT(truncate(path, 0), 0);
    CHECK_INT(checker_file(path, &report, NULL), 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_solution_is_certified),
        cmocka_unit_test(every_change_is_refuted),
        cmocka_unit_test(what_is_no_result_is_refused),
    };
    return cmocka_run_group_tests(tests, make_path, drop_path);
}
