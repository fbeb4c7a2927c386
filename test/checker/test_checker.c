/* SPDX-License-Identifier: BSD-3-Clause */
/* The checker must accept an exact solution and refuse it when any one number is changed. */
#include <math.h>
#include <netcdf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "checker.h"
#include "sample.h"
#include "surface.h"

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
    {"drag_friction_force", 9, -3.99, "imbalance of forces"},
    {"drag_friction_force", 9, -4.01, "friction above its bound"},
    {"drag_friction_force", 11, 0.01, "friction along the normal"},
    {"drag_friction_force", 0, 1, "on a held end"},
    {"drag_reaction", 2, 8.001, "imbalance of forces"},
    {"drag_reaction", 2, -1, "adhesion"},
    {"drag_segment_force", 9, 8.00000002, "imbalance of forces"},
    {"drag_load", 3, 1e-6, "imbalance of forces"},
    {"drag_friction_bound", 4, 1.9, "friction above its bound"},
    {"drag_friction_bound", 4, 2.1, "sum of local gaps"},
    {"drag_contact_gap", 1, INFINITY, "force without an obstacle"},
    {"drag_contact_gap", 1, 0.5, "sum of local gaps"},
    {"drag_normal", 5, 0.999, "normal against the obstacle's"},
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
    {"drag_element_penetration", 0, 1e-6, "claimed element_penetration"},
    {"drag_element_push", 0, 1e-6, "claimed element_push"},
    {"drag_elongation_residual", 0, 1e-6, "claimed elongation_residual"},
    {"drag_segment_force", 0, -1e-6, "elements that push"},
    {"drag_position", 3, 1.001, "elongation that no force explains"},
    {"drag_dissipated", 0, 0, "claimed dissipated"},
    {"drag_ledger_ends", 0, 0, "ledger: ends + obstacles"},
    {"drag_ledger_elastic", 0, 0, "claimed ledger_elastic"},
    {"drag_ledger_gravity", 0, 1, "claimed ledger_gravity"},
    {"drag_unaccounted", 0, 1e-3, "claimed unaccounted"},
    {"drag_unaccounted", 1, 1e-3, "is said to be unaccounted"},
    {"drag_ledger_imbalance", 0, -0.04, "and not said to be unaccounted"},
    {"drag_outcome", 0, 3, "not certified, as the file says"},
    {"drag_end_force", 0, 1e-6, "end_force against the half element's balance"},
    {"drag_end_force", 3, 10.000001, "end_force against the half element's balance"},
    {"drag_end_friction_force", 0, 1e-6, "end_friction_force against the neighbour's"},
    {"drag_end_tension", 1, 10.000001, "end_tension against the size"},
    {"drag_end_tension", 0, -1, "end_tension holds a value that cannot be"},
    {"drag_end_held_position", 3, 5, "end_held_position holds a value that cannot be"},
    {"drag_end_held_position", 0, NAN, "end_held_position holds a value that cannot be"},
    {"drag_end_applied_force", 0, 0, "end_applied_force holds a value that cannot be"},
    {"drag_end_applied_force", 3, NAN, "end_applied_force holds a value that cannot be"},
    {"far_proof_force", 0, 1, "proof_force of a line that is neither unbounded nor slides"},
    {"loose_proof_length", 0, 1, "proof_length of a line that is not infeasible"},
    {"drag_end_tension_least", 1, 10, "the range of an end's tension is not whole"},
    {"drag_end_tension_greatest_bound", 0, 10, "the range of an end's tension is not whole"},
    {"drag_reaction", 0, 0, "reaction on a held end"},
    // numbers that are none
    {"drag_position", 4, NAN, "position holds a value that cannot be"},
    {"drag_tension", 0, INFINITY, "tension holds a value that cannot be"},
    {"drag_gap", 0, NAN, "gap holds a value that cannot be"},
    {"drag_element_length", 0, -1, "element_length holds a value that cannot be"},
    // outcomes other than solved
    {"drag_outcome", 0, 1, "taut, but the line is elastic"},
    {"drag_outcome", 0, 4, "unbounded, but a node is held"},
    {"drag_outcome", 0, 5, "infeasible, but"},
    {"drag_outcome", 0, 6, "mesh too coarse, but friction at one contact"},
    {"drag_outcome", 0, 7, "slides without end, but a node is held"},
    {"loose_outcome", 0, 7, "slides without end, but friction is frozen"},
    {"drag_outcome", 0, 8, "passes an obstacle, but contact is not"},
    {"drag_outcome", 0, 9, "unknown outcome"},
    {"tight_end_held_position", 3, 3.999, "distance of the ends - length"},
    {"tight_position", 3, 1.1, "stretch"},
    {"far_end_held_position", 3, 4, "infeasible, but held nodes are"},
    {"far_proof", 0, 0.5, "proof vector"},
    {"far_proof_length", 0, 1, "proof_length"},
    {"loose_load", 12, 15, "unbounded, but the energy falls"},
    {"loose_proof", 2, -0.1, "rigid motion"},
    {"loose_proof_force", 0, 2, "proof_force"},
    {"loose_end_kind", 0, 0, "end_held_position holds a value that cannot be"},
};

/* the same on the drum; node 2 is at half a radian from the top */
static const Tamper DRUM_TAMPER[] = {
    {"wound_normal", 6, 0.4, "normal against the obstacle's"},
    {"wound_slip", 7, 1e-9, "slip against the path"},
    {"wound_slip", 15 + 7, 1e-9, "slip against the path"},
    {"wound_contact_gap", 2, 1e-9, "contact_gap against the distance"},
    {"wound_contact_gap", 2, INFINITY, "contacts not looked for"},
    {"wound_friction_force", 7, 1, "friction above its bound"},
    {"wound_friction_bound", 2, 1.7, "friction bound"},
    {"wound_reaction", 2, 3.4, "imbalance of forces"},
    {"wound_position", 6, 0.98, "sum of local gaps"},
    {"wound_position", 8, 1.12, "depth below the obstacle"},
    {"wound_share", 0, 0.5, "slip against the path"},
    {"wound_substeps", 0, 0, "senseless number of substeps"},
    {"wound_friction_residual", 0, 1e-6, "claimed friction_residual"},
    {"wound_dissipated", 1, 0, "claimed dissipated"},
    {"wound_end_force", 0, 0, "end_force against the half element's balance"},
    {"wound_end_friction_force", 0, 0, "end_friction_force against the neighbour's"},
    {"wound_end_tension", 0, 8, "end_tension against the size"},
    {"wound_reaction", 0, 0, "reaction on a held end"},
    {"wound_ledger_obstacles", 1, 0, "claimed ledger_obstacles"},
    {"wound_penetration", 0, 1e-6, "claimed penetration"},
    {"wound_element_penetration", 0, 1e-6, "claimed element_penetration"},
    {"wound_element_length", 0, 0.1, "depth of an element inside an obstacle"},
    {"wound_bend_turn", 0, 0.26, "claimed bend_turn"},
    {"wound_bend_friction", 0, 0.25, "claimed bend_friction"},
    {"wound_bend_at", 0, 0, "claimed turn at bend_at"},
    {"wound_bend_turn", 1, NAN, "bend_turn holds a value that cannot be"},
    {"wound_outcome", 0, 6,
     "mesh too coarse, but friction at one contact holds tensions in the ratio 1.13"},
    {"obstacle_friction_axial", 0, 7.3,
     "certified, but friction at one contact holds tensions in the ratio 23"},
    {"obstacle_turn", 1, -0.2, "slip against the path"},
    {"obstacle_turn", 1, -0.125 - 2 * 3.14159265358979323846,
     "quarters of a turn of an obstacle in one part"},
    {"wound_reference", 8, -1.75, "quarters of a turn that a node with friction went"},
    {"obstacle_kind", 0, 2, "normal against the obstacle's"},
    {"obstacle_kind", 0, 0, "normal against the obstacle's"},
    {"obstacle_kind", 0, 3, "no whole grid of obstacle"},
    {"obstacle_kind", 0, 4, "senseless obstacle"},
    {"obstacle_point", 0, 0.6, "normal against the obstacle's"},
    {"obstacle_axis", 0, 0.1, "normal against the obstacle's"},
    {"obstacle_radius", 0, 1.001, "depth below an obstacle"},
    {"obstacle_radius", 0, 0.999, "contact_gap against the distance"},
    {"obstacle_friction_axial", 0, 0.51, "friction bound"},
    {"obstacle_friction_axial", 0, 0.2, "friction above its bound"},
    {"obstacle_friction_grain", 1, 1, "friction above its bound"},
};

/* the same with a set and zones: 0.4 by 0.2 and the factor 1.25; the boundary of the zones lies in
 * the share of node 1 or 2 */
static const Tamper SET_TAMPER[] = {
    {"obstacle_friction_set_map", 0, 0.41, "claimed primal"},
    {"obstacle_friction_set_map", 0, 0.39, "friction above its bound"},
    {"obstacle_friction_set_origin", 0, 0.01, "claimed primal"},
    {"obstacle_friction_set_origin", 1, 0.01, "friction above its bound"},
    {"obstacle_friction_set_rows", 3, 1.01, "friction above its bound"},
    {"obstacle_friction_set_offset", 0, 1.01, "claimed primal"},
    {"obstacle_friction_set_offset", 0, -1, "no bounded set with points inside"},
    {"obstacle_friction_set_cone", 0, 2, "no bounded set with points inside"},
    {"obstacle_friction_set_cone", 0, 5, "no bounded set with points inside"},
    {"obstacle_friction_set_cone", 0, 2.5, "no bounded set with points inside"},
    {"obstacle_friction_set_rows", 2, NAN, "cannot read variable 'obstacle_friction_set_rows'"},
    {"obstacle_friction_shape", 0, 0, "friction bound"},
    {"obstacle_friction_shape", 0, 3, "senseless obstacle"},
    {"wound_zone_factor", 0, 1.26, "friction bound"},
    {"wound_zone_factor", 1, 1.2500001, "friction bound"},
    {"wound_zone_factor", 1, -1, "senseless friction zones"},
    {"wound_zone_from", 1, 0.376, "friction bound"},
    {"wound_zone_from", 1, 0.374, "senseless friction zones"},
    {"wound_zone_to", 1, 0.8, "friction bound"},
    {"wound_zone_to", 0, NAN, "senseless friction zones"},
    {"wound_friction_force", 7, 1, "friction above its bound"},
    {"wound_friction_bound", 2, 4.7, "friction bound"},
};

/* the second contact: a wall beside the bed, obstacle 1; a ceiling, obstacle 2, is far */
static const Tamper CORNER_TAMPER[] = {
    {"corner_friction_force_second", 9, -1.99, "imbalance of forces"},
    {"corner_friction_force_second", 9, -2.01, "friction above its bound"},
    {"corner_friction_force_second", 10, 0.01, "friction along the normal"},
    {"corner_friction_force_second", 0, 1, "on a held end"},
    {"corner_friction_force_second", 6, NAN, "friction_force holds a value that cannot be"},
    {"corner_friction_bound_second", 3, 1.9, "friction above its bound"},
    {"corner_friction_bound_second", 3, 2.1, "friction bound"},
    {"corner_reaction_second", 2, 8.001, "imbalance of forces"},
    {"corner_reaction_second", 2, -1, "adhesion"},
    {"corner_position", 10, 0.001, "sum of local gaps"},
    {"corner_position", 10, -1e-6, "depth below the obstacle"},
    {"corner_normal_second", 4, 0.999, "normal against the obstacle's"},
    {"corner_slip_second", 9, 0, "slip against the path"},
    {"corner_contact_gap_second", 1, 1e-6, "contact_gap against the distance"},
    {"corner_contact_gap_second", 1, INFINITY, "contacts not looked for"},
    {"corner_obstacle_second", 2, 2, "contacts that are not with the nearest"},
    {"corner_obstacle_second", 2, 0, "contacts that are not with the nearest"},
    {"corner_obstacle", 2, 1, "contacts that are not with the nearest"},
    {"corner_obstacle", 2, 2, "contacts that are not with the nearest"},
    {"corner_obstacle", 0, -1, "unknown obstacle"},
    {"corner_obstacle_second", 2, 3, "unknown obstacle"},
    {"corner_element_reaction", 1, 1, "force without an obstacle"},
    {"corner_element_obstacle", 1, 2, "place of an element's contact"},
    {"corner_element_obstacle", 1, 1, "contacts that are not with the nearest"},
    {"obstacle_friction_axial", 1, 0.3, "friction bound"},
    {"obstacle_point", 4, 0.001, "depth below an obstacle"},
    {"obstacle_point", 4, -0.001, "contact_gap against the distance"},
    {"corner_friction_residual", 0, 1e-6, "claimed friction_residual"},
    {"corner_dissipated", 0, 0.05, "claimed dissipated"},
};

/* the element on the post is the second */
static const Tamper POST_TAMPER[] = {
    {"line_element_friction_force", 3, -1.61, "imbalance of forces"},
    {"line_element_friction_force", 3, -3.1, "friction above its bound"},
    {"line_element_friction_force", 4, 0.01, "friction along the normal"},
    {"line_element_friction_force", 0, 1, "force without an obstacle"},
    {"line_element_friction_bound", 1, 1.5, "friction above its bound"},
    {"line_element_friction_bound", 1, 3.1, "friction bound"},
    {"line_element_friction_bound", 2, 1, "force without an obstacle"},
    {"line_element_reaction", 1, 6.001, "imbalance of forces"},
    {"line_element_reaction", 1, -1, "adhesion"},
    {"line_element_reaction", 0, 1, "force without an obstacle"},
    {"line_element_normal", 4, 0.999, "normal against the obstacle's"},
    {"line_element_slip", 3, 1e-9, "slip against the path"},
    {"line_element_contact_gap", 1, 1e-9, "contact_gap against the distance"},
    {"line_element_contact_gap", 1, INFINITY, "force without an obstacle"},
    {"line_element_share", 1, 0.6001, "place of an element's contact"},
    {"line_element_share", 1, 1.1, "element_share holds a value that cannot be"},
    {"line_element_obstacle", 1, -1, "imbalance of forces"},
    {"line_element_obstacle", 1, 1, "unknown obstacle"},
    {"line_element_obstacle", 1, 0.5, "unknown obstacle"},
    {"line_element_reaction", 1, NAN, "reaction holds a value that cannot be"},
    {"line_element_length", 1, 1.9, "sum of local gaps"},
    {"line_element_penetration", 0, 1e-6, "claimed element_penetration"},
    {"line_position", 4, 0.74, "sum of local gaps"},
    {"obstacle_radius", 0, 1.001, "depth of an element inside an obstacle"},
    {"obstacle_radius", 0, 0.999, "contact_gap against the distance"},
    {"obstacle_point", 0, 0.01, "place of an element's contact"},
};

/* a slide: its velocities, the loads that drive it, what it slides on */
static const Tamper SPILL_TAMPER[] = {
    {"spill_motion", 2, 0.88, "an element would lengthen"},
    {"spill_motion", 8, 0.16, "an element would lengthen"},
    {"spill_motion", 8, 0.1, "a node would press on an obstacle"},
    {"spill_motion", 9, 0.04, "a node would press on an obstacle"},
    {"spill_motion", 14, -0.1, "an element would lengthen"},
    {"spill_motion", 5, 0, "the fastest node does not move at the speed 1"},
    {"spill_motion", 5, NAN, "motion holds a value that cannot be"},
    {"spill_end_applied_force", 5, -8.9, "no power that nothing can take"},
    {"spill_end_applied_force", 2, -1.2, "no power that nothing can take"},
    {"spill_load", 14, -14, "no power that nothing can take"}, // a line with weight
    {"spill_end_kind", 0, 0, "end_held_position holds a value that cannot be"},
    {"spill_proof_force", 0, 0.1, "proof_force"},
    {"spill_reference", 6, 0.1, "an element would lengthen"},
    {"obstacle_friction_axial", 0, 0.51, "a node would press on an obstacle"},
    {"obstacle_radius", 0, 1.001, "a node lies inside an obstacle"},
    {"obstacle_kind", 0, 0, "a node would press on an obstacle"},
};

/* a fall: the loads, the way, and what might be in it */
static const Tamper FALL_TAMPER[] = {
    {"fall_proof", 2, 1, "unbounded, but the energy falls"},
    {"fall_proof", 0, 0.1, "length of the rigid motion"},
    {"fall_proof_force", 0, 4.9, "proof_force"},
    {"fall_load", 8, 1, "proof_force"},
    {"fall_end_kind", 0, 0, "end_held_position holds a value that cannot be"},
    {"fall_reference", 8, -1, "unbounded, but the line meets an obstacle"}, // it touches
    {"fall_reference", 8, 1.5,
     "unbounded, but the line meets an obstacle"}, // an element goes through the drum
    {"fall_reference", 5, 50, "unbounded, but the line meets an obstacle"}, // ... will go
    {"obstacle_point", 2, -3,
     "unbounded, but the line meets an obstacle"}, // the drum is in the way
    {"obstacle_point", 2, -3e3, "unbounded, but the line meets an obstacle"},
    {"obstacle_radius", 0, 1.6, "unbounded, but the line meets an obstacle"},
};

/* too short to reach round a drum */
static const Tamper REEL_TAMPER[] = {
    {"reel_end_held_position", 5, -1, "the line is long enough"},
    {"reel_end_held_position", 5, 2, "the line is long enough"},
    {"reel_element_length", 0, 2, "the line is long enough"},
    {"reel_compliance", 0, 1e-9, "the line is elastic"},
    {"reel_end_kind", 1, 1, "end_applied_force holds a value that cannot be"},
    {"reel_substeps", 0, 2, "it is of a substep"},
    {"reel_proof_length", 0, 0.5, "proof_length"},
    {"reel_proof", 0, 0.01, "proof vector"},
    {"reel_proof", 2, -1, "proof vector off the shortest path"},
    {"reel_proof_obstacle", 0, -1, "infeasible, but held nodes are"},
    {"reel_proof_obstacle", 0, 1, "unknown obstacle of the proof"},
    {"reel_reference", 8, 0.1, "the line lies across the axis"},
    {"obstacle_radius", 0, 0.5, "the line is long enough"},
    {"obstacle_kind", 0, 0, "its obstacle is a plane"},
    {"obstacle_stiffness", 0, 1e9, "its obstacle gives"},
    {"obstacle_point", 2, 2, "the obstacle is not in the way"},
};

static void refuse_each(int (*write)(const char *), const Tamper *tamper, size_t count) {
    for (size_t i = 0; i < count; i++) {
        CHECK_INT(write(path), 0);
        CHECK_INT(sample_poke(path, tamper[i].variable, tamper[i].index, tamper[i].value), 0);
        char *text = NULL;
        size_t size = 0;
        FILE *log = open_memstream(&text, &size);
        int result = checker_file(path, NULL, log);
        fclose(log);
        if (result == 0 || !strstr(text, tamper[i].finding)) {
            print_error("%s[%zu] = %g: result %d, expected a finding with \"%s\", got:\n%s",
                        tamper[i].variable, tamper[i].index, tamper[i].value, result,
                        tamper[i].finding, text);
            fail();
        }
        free(text);
    }
    printf("%zu changes, each refused for its own reason\n", count);
}

static void every_change_is_refuted(void **state) {
    (void)state;
    refuse_each(sample_write, TAMPER, sizeof TAMPER / sizeof *TAMPER);
    refuse_each(sample_write_drum, DRUM_TAMPER, sizeof DRUM_TAMPER / sizeof *DRUM_TAMPER);
    refuse_each(sample_write_set, SET_TAMPER, sizeof SET_TAMPER / sizeof *SET_TAMPER);
    refuse_each(sample_write_corner, CORNER_TAMPER, sizeof CORNER_TAMPER / sizeof *CORNER_TAMPER);
    refuse_each(sample_write_post, POST_TAMPER, sizeof POST_TAMPER / sizeof *POST_TAMPER);
    refuse_each(sample_write_reel, REEL_TAMPER, sizeof REEL_TAMPER / sizeof *REEL_TAMPER);
    refuse_each(sample_write_spill, SPILL_TAMPER, sizeof SPILL_TAMPER / sizeof *SPILL_TAMPER);
    refuse_each(sample_write_fall, FALL_TAMPER, sizeof FALL_TAMPER / sizeof *FALL_TAMPER);
}

/* A file with names of an earlier version is refused for them, not for what it seems to lack. */
static void former_names_are_refused(void **state) {
    (void)state;
    char *text = NULL;
    size_t size = 0;
    int nc = -1;
    CHECK_INT(sample_write(path), 0);
    CHECK_INT(nc_open(path, NC_WRITE, &nc), NC_NOERR);
    CHECK_INT(nc_redef(nc), NC_NOERR);
    CHECK_INT(nc_rename_att(nc, NC_GLOBAL, "friction_policy", "friction"), NC_NOERR);
    CHECK_INT(nc_close(nc), NC_NOERR);
    FILE *log = open_memstream(&text, &size);
    CHECK_INT(checker_file(path, NULL, log), 2);
    fclose(log);
    CHECK_INT(strncmp(text, "names of an earlier version of capstan, run it again: '", 55), 0);
    free(text);
}

static void drum_is_certified(void **state) {
    (void)state;
    CheckerReport report;
    CHECK_INT(sample_write_drum(path), 0);
    CHECK_INT(checker_file(path, &report, stdout), 0);
    CHECK_INT(report.certified, 2);
    CHECK_NEAR(report.gap, 0, 1e-14); // rounding of the sample's doubles
    CHECK_INT(sample_write_set(path), 0);
    CHECK_INT(checker_file(path, &report, stdout), 0);
    CHECK_INT(report.certified, 2);
    CHECK_NEAR(report.gap, 0, 1e-14);
}

static void post_is_certified(void **state) {
    (void)state;
    CheckerReport report;
    CHECK_INT(sample_write_post(path), 0);
    CHECK_INT(checker_file(path, &report, stdout), 0);
    CHECK_INT(report.certified, 2);
    CHECK_NEAR(report.gap, 0, 1e-14); // rounding of the sample's doubles
}

static void spill_is_certified(void **state) {
    (void)state;
    CheckerReport report;
    CHECK_INT(sample_write_spill(path), 0);
    CHECK_INT(checker_file(path, &report, stdout), 0);
    CHECK_INT(report.certified, 2);
    CHECK_INT(report.outcome[7], 2);
}

static void reel_is_certified(void **state) {
    (void)state;
    CheckerReport report;
    CHECK_INT(sample_write_reel(path), 0);
    CHECK_INT(checker_file(path, &report, stdout), 0);
    CHECK_INT(report.certified, 2);
    CHECK_INT(report.outcome[5], 2);
}

static void corner_is_certified(void **state) {
    (void)state;
    CheckerReport report;
    CHECK_INT(sample_write_corner(path), 0);
    CHECK_INT(checker_file(path, &report, stdout), 0);
    CHECK_INT(report.certified, 2);
    CHECK_NEAR(report.gap, 0, 1e-30); // every term is exact in binary
    CHECK_NEAR(report.force, 0, 1e-30);
}

/* Triangle (0.3, 0), (0, 0.2), (-0.1, -0.4) as weights of its corners, and a half disc of radius 2
 * above its diameter: support and distance against what a ruler says, to the accuracy promised of
 * reach 1 and 2. */
static void supports_and_distances(void **state) {
    (void)state;
    static const Real CORNER[3][2] = {{0.3L, 0}, {0, 0.2L}, {-0.1L, -0.4L}};
    Conic *triangle = conic_create(2, 2, 3), *half = conic_create(2, 2, 4);
    for (size_t i = 0; i < 2; i++) {
        triangle->cone[i] = 1;
        triangle->a[2 * i + i] = 1;
        triangle->a[4 + i] = -1; // weights u, v and 1 - u - v
        for (size_t k = 0; k < 2; k++) triangle->map[2 * k + i] = CORNER[i][k] - CORNER[2][k];
        triangle->origin[i] = CORNER[2][i];
    }
    triangle->cone[2] = 1;
    triangle->b[2] = 1;
    half->cone[0] = 3;
    half->cone[3] = 1;
    half->b[0] = 1;
    half->a[2] = half->a[5] = 1;
    half->a[7] = 1;
    half->map[0] = half->map[3] = 2;
    assert_true(conic_prepare(triangle) && conic_prepare(half));
    for (int i = 0; i < 720; i++) { // faces and corners are among the directions
        const Real d[2] = {cosl(i * 0.00872664625997164788L), sinl(i * 0.00872664625997164788L)};
        Real best = -INFINITY;
        for (int k = 0; k < 3; k++) best = fmaxl(best, d[0] * CORNER[k][0] + d[1] * CORNER[k][1]);
        CHECK_BETWEEN((double)(conic_support(triangle, d) - best), -1e-18, 1e-14);
        CHECK_BETWEEN((double)(conic_support(half, d) - (d[1] > 0 ? 2 : 2 * fabsl(d[0]))), -1e-18,
                      5e-14);
        CHECK_BETWEEN((double)(conic_distance(half, (Real[2]){3 * d[0], 3 * fabsl(d[1])}) - 1),
                      -1e-18, 5e-14);
        CHECK_BETWEEN((double)conic_distance(half, (Real[2]){1.9L * d[0], 1.9L * fabsl(d[1])}), 0,
                      5e-14);
        CHECK_BETWEEN((double)(conic_distance(half, (Real[2]){1.9L * d[0], -0.5L}) - 0.5L), -1e-18,
                      5e-14);
    }
    const Real face[2] = {2, 3}; // normal of the face from (0.3, 0) to (0, 0.2)
    CHECK_BETWEEN((double)(conic_support(triangle, face) - 0.6L), -1e-18, 4e-14);
    conic_free(triangle);
    conic_free(half);
}

/* a quarter of a great circle, a quarter of a helix, and a plane's own vector */
static void slips_are_geodesics(void **state) {
    (void)state;
    const double pi = 3.14159265358979323846;
    Surface ball = {.kind = SURFACE_SPHERE, .point = {1, 0, 0}, .axis = {0, 0, 1}, .radius = 2};
    Surface pipe = {.kind = SURFACE_CYLINDER, .point = {1, 0, 0}, .axis = {0, 0, 1}, .radius = 2};
    Surface bed = {.kind = SURFACE_PLANE, .axis = {0, 0, 1}};
    const Real east[3] = {3, 0, 0}, north[3] = {1, 2, 0}, higher[3] = {1, 2.5L, 5};
    Real slip[3], carried[3];
    surface_slip(&ball, east, north, slip);
    CHECK_VECTOR(((double[]){(double)slip[0], (double)slip[1], (double)slip[2]}),
                 ((double[]){-pi, 0, 0}), 1e-15);
    surface_slip(&pipe, east, higher, slip);
    CHECK_VECTOR(((double[]){(double)slip[0], (double)slip[1], (double)slip[2]}),
                 ((double[]){-pi, 0, 5}), 1e-15);
    surface_slip(&bed, east, higher, slip);
    CHECK_VECTOR(((double[]){(double)slip[0], (double)slip[1], (double)slip[2]}),
                 ((double[]){-2, 2.5, 0}), 1e-15);
    surface_carry(&pipe, east, 1, pi / 2, carried);
    CHECK_VECTOR(((double[]){(double)carried[0], (double)carried[1], (double)carried[2]}),
                 ((double[]){1, 2, 0}), 1e-15);
    CHECK_NEAR((double)surface_distance(&pipe, higher), 0.5, 1e-15);
    CHECK_NEAR((double)surface_distance(&ball, higher), sqrt(2.5 * 2.5 + 25) - 2, 1e-15);
}

/* ellipse and box by hand: half-axes 4 and 2 under the bound 4 */
static void sets_are_ellipse_and_box(void **state) {
    (void)state;
    Surface ellipse = {.mu = {0.5, 0.25}}, box = {.mu = {0.5, 0.25}, .box = true};
    const Real inside[2] = {2.4L, 1.6L}, corner[2] = {4, 2}, slip[2] = {-3, -8};
    Real phi;
    CHECK_NEAR((double)surface_excess(&ellipse, 4, inside), 0, 1e-15); // (0.6, 0.8) on its edge
    CHECK_GREATER((double)surface_excess(&ellipse, 4, corner),
                  1.3); // sqrt(20) (1 - 1/sqrt 2) = 1.31
    CHECK_NEAR((double)surface_excess(&box, 4, corner), 0, 1e-15);
    CHECK_NEAR((double)surface_gap(&ellipse, 4, (Real[2]){2.4L, 1.6L}, (Real[2]){-3, -8}, &phi), 0,
               1e-15);
    CHECK_NEAR((double)phi, 20, 1e-15); // sqrt((4 3)^2 + (2 8)^2), and F.slip = -7.2 - 12.8
    CHECK_NEAR((double)surface_gap(&box, 4, corner, slip, &phi), 0, 1e-15);
    CHECK_NEAR((double)phi, 28, 1e-15);
    CHECK_NEAR((double)surface_gap(&box, 4, inside, slip, &phi), 28 - 20, 1e-14);
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
        cmocka_unit_test(reel_is_certified),
        cmocka_unit_test(exact_solution_is_certified),
        cmocka_unit_test(drum_is_certified),
        cmocka_unit_test(spill_is_certified),
        cmocka_unit_test(corner_is_certified),
        cmocka_unit_test(post_is_certified),
        cmocka_unit_test(every_change_is_refuted),
        cmocka_unit_test(slips_are_geodesics),
        cmocka_unit_test(sets_are_ellipse_and_box),
        cmocka_unit_test(supports_and_distances),
        cmocka_unit_test(what_is_no_result_is_refused),
        cmocka_unit_test(former_names_are_refused),
    };
    return cmocka_run_group_tests(tests, make_path, drop_path);
}
