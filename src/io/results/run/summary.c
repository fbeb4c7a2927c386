/* SPDX-License-Identifier: BSD-3-Clause */
/* The summary as one JSON object (RFC 8259), printed by `capstan run --json` and written to
 * summary.json. Keys are stable and contain their units; a number without meaning is null.
 * docs/results.md lists them. */
#include <math.h>

#include "io/base/directory/file_list.h"
#include "io/base/text/columns.h"
#include "io/base/text/escape.h"
#include "io/results/writers.h"

static void write_key(FILE *out, const char *key) {
    cpsi_write_json_string(out, key);
    fputs(": ", out);
}

static void write_number(FILE *out, const char *key, double x, const char *after) {
    write_key(out, key);
    cpsi_write_json_number(out, x);
    fputs(after, out);
}

static void write_string(FILE *out, const char *key, const char *text, const char *after) {
    write_key(out, key);
    cpsi_write_json_string(out, text);
    fputs(after, out);
}

static void write_list(FILE *out, const char *key, int count, const double *x, const char *after) {
    write_key(out, key);
    for (int i = 0; i < count; ++i) {
        fputs(i ? ", " : "[", out);
        cpsi_write_json_number(out, x[i]);
    }
    fprintf(out, "]%s", after);
}

static void write_vector(FILE *out, const char *key, const double x[3], const char *after) {
    write_list(out, key, 3, x, after);
}

/* smallest and largest possible tension of the element at an end; null where unbounded or not
 * known, as `kind` says */
static void write_range(FILE *out, const CpsTensionRange *range) {
    fputs(", \n            \"tension_range_N\": {", out);
    write_string(out, "kind", cps_range_name(range->kind), ", ");
    write_number(out, "least", range->has_values ? range->least : NAN, ", ");
    write_number(out, "least_bound", range->has_values ? range->least_bound : NAN, ", ");
    write_number(out, "greatest", range->has_values ? range->greatest : NAN, ", ");
    write_number(out, "greatest_bound", range->has_values ? range->greatest_bound : NAN, "}}");
}

static void write_end(FILE *out, int which, const CpsiLineRow *row, const char *after) {
    const CpsLineReport *report = &row->report;
    const CpsEndReport *end = &report->end[which];
    const CpsWinchReport *winch = &row->winch[which];
    fputs("          ", out);
    write_key(out, which == CPS_END_A ? "A" : "B");
    fputc('{', out);
    write_vector(out, "position_m", end->position, ", ");
    write_vector(out, "force_N", end->force, ", ");
    write_number(out, "tension_N", end->tension, ", ");
    write_number(out, "uplift_N", end->uplift, ", ");
    write_number(out, "angle_rad", end->angle, ", ");
    write_number(out, "suspended_m", end->suspended, ", ");
    if (winch->is_there) {
        write_number(out, "stored_m", winch->stored, ", ");
        write_number(out, "paid_m", winch->paid, ", ");
        write_number(out, "winch_pull_N", winch->pull, ", ");
    }
    if (row->constraint[which].is_there)
        write_vector(out, "reaction_N", row->constraint[which].reaction, ", ");
    if (report->has_touchdown)
        write_vector(out, "touchdown_m", end->touchdown, "");
    else
        fputs("\"touchdown_m\": null", out);
    write_range(out, &end->range);
    fputs(after, out);
}

/* the proof that there is no solution, in the units of its kind */
static void write_proof(FILE *out, const CpsLineReport *report) {
    if (!cps_outcome_is_final(report->outcome)) return;
    fputs("          \"proof\": {", out);
    write_vector(out, "direction", report->proof, ", ");
    if (report->has_proof_obstacle) fprintf(out, "\"obstacle\": %d, ", report->proof_obstacle);
    if (report->has_proof_plane) fprintf(out, "\"plane\": %d, ", report->proof_plane);
    if (report->coulomb > 0) write_number(out, "coulomb_N", report->coulomb, ", ");
    if (report->outcome == CPS_OUTCOME_INFEASIBLE)
        write_number(out, "excess_m", report->proof_length, "},\n");
    else
        write_number(out, report->outcome == CPS_OUTCOME_SLIDES ? "power_N" : "fall_N",
                     report->proof_force, "},\n");
}

/* the sharpest bend round an obstacle, where there is one */
static void write_bend(FILE *out, const CpsBend *bend) {
    if (!(bend->turn > 0)) return;
    fputs("          \"bend\": {", out);
    write_number(out, "turn_rad", bend->turn, ", ");
    write_number(out, "friction", bend->friction, ", ");
    write_number(out, "ratio", bend->ratio, ", ");
    write_number(out, "coulomb", bend->coulomb, ", ");
    write_number(out, "at_m", bend->arc_length, ", ");
    write_number(out, "element_m", bend->element, "},\n");
}

/* which ends of a line were let go, and how near it is to parting */
static void write_failure(FILE *out, const CpsLineFailure *failure) {
    fprintf(out, "          \"release\": {\"A\": \"%s\", \"B\": \"%s\"},\n",
            cps_release_name(failure->release[0]), cps_release_name(failure->release[1]));
    if (!failure->has_break_at) return;
    fputs("          ", out);
    write_number(out, "break_share", failure->share, ", ");
    write_number(out, "break_share_at_m", failure->arc_length, ",\n");
}

/* the break that a step is */
static void write_break(FILE *out, const CpsResults *results, const CpsBreak *parted) {
    if (!parted->is_break) return;
    fputs("      \"break\": {", out);
    write_string(out, "line", results->line_name[parted->line], ", ");
    write_string(out, "end", parted->end == CPS_END_A ? "A" : "B", ", ");
    write_number(out, "tension_N", parted->tension, ", ");
    write_number(out, "break_at_N", parted->break_at, ", ");
    write_number(out, "at_m", parted->arc_length, "},\n");
}

static void write_line(FILE *out, const char *name, const CpsiLineRow *row, bool lets_go,
                       const char *after) {
    const CpsLineReport *report = &row->report;
    fputs("        ", out);
    write_key(out, name);
    fputs("{\n          ", out);
    write_string(out, "outcome", cps_outcome_name(report->outcome), ", ");
    fprintf(out, "\"iterations\": %d, \"places_not_unique\": %d,\n          ",
            report->iteration_count, (int)report->places);
    write_number(out, "grounded_m", report->grounded, ", ");
    write_number(out, "slipping_m", report->has_slipping ? report->slipping : NAN, ", ");
    write_number(out, "slack_m", report->slack, ", ");
    write_number(out, "sweep_m", report->sweep, ", ");
    write_number(out, "dissipated_J", report->dissipated, ",\n          ");
    write_number(out, "tension_mesh_estimate_N",
                 report->has_tension_mesh ? report->tension_mesh : NAN, ",\n");
    if (report->has_utilisation) {
        fputs("          ", out);
        write_number(out, "utilisation", report->utilisation, ", ");
        write_number(out, "utilisation_at_m", report->utilisation_arc_length, ",\n");
    }
    if (lets_go) write_failure(out, &row->failure);
    write_proof(out, report);
    write_bend(out, &report->bend);
    write_end(out, CPS_END_A, row, ",\n");
    write_end(out, CPS_END_B, row, "\n        }");
    fputs(after, out);
}

static void write_certificate(FILE *out, const CpsResults *results, const CpsiRow *row) {
    const CpsCertificate *c = &row->report.certificate;
    fputs("      \"energy\": {", out);
    write_number(out, "primal_J", c->primal, ", ");
    write_number(out, "dual_J", c->dual, ", ");
    write_number(out, "gap_J", c->gap, ", ");
    write_number(out, "scale_J", c->scale, "},\n      \"tension_bound_rms_N\": {");
    for (int i = 0; i < cpsi_listed_lines(results); ++i) {
        const CpsCertificate *of = &row->line[i].report.certificate;
        write_number(out, results->line_name[i], of->has_tension_bound ? of->tension_bound : NAN,
                     i + 1 < results->line_count ? ", " : "");
    }
    fputs("},\n      ", out);
    write_number(out, "tension_estimate_N", c->tension_estimate, ",\n      ");
    write_number(out, "force_residual_N", c->force_residual, ", ");
    write_number(out, "largest_force_N", c->largest_force, ",\n      ");
    write_number(out, "law_residual_J", c->law_residual, ", ");
    write_number(out, "contact_residual_N", row->open_reaction, ", ");
    write_number(out, "contact_residual_J", c->contact_residual, ",\n      ");
    write_number(out, "friction_residual_N", c->friction_residual, ", ");
    write_number(out, "element_push_N", c->element_push, ", ");
    write_number(out, "elongation_residual", c->elongation_residual, ", ");
    write_number(out, "stretch_residual", c->stretch_residual, ", ");
    write_number(out, "penetration_m", c->penetration, ", ");
    write_number(out, "element_penetration_m", c->element_penetration, ", ");
    write_number(out, "dissipated_J", row->report.dissipated, ",\n      ");
}

/* what a ledger has more where things move in time */
static void write_motion_ledger(FILE *out, const CpsMotionLedger *ledger) {
    write_number(out, "waves", ledger->waves, ", ");
    write_number(out, "kinetic", ledger->kinetic, ", ");
    write_number(out, "impact", ledger->impact, ", ");
    write_number(out, "scheme", ledger->scheme, ", ");
    write_number(out, "settling", ledger->settling, ", ");
    write_number(out, "damping", ledger->damping, ", ");
    write_number(out, "drag", ledger->drag, ", ");
    write_number(out, "added", ledger->added, ", ");
    write_number(out, "turnover", ledger->turnover, ", ");
}

static void write_ledger(FILE *out, const CpsResults *results, const CpsLedger *ledger,
                         const CpsMotionLedger *motion) {
    fputs("\"ledger_J\": {", out);
    write_number(out, "ends", ledger->ends, ", ");
    write_number(out, "obstacles", ledger->obstacles, ", ");
    if (results->winds) write_number(out, "winches", ledger->winches, ", ");
    if (ledger->loads != 0) write_number(out, "loads", ledger->loads, ", ");
    write_number(out, "elastic", ledger->elastic, ", ");
    write_number(out, "gravity", ledger->gravity, ", ");
    write_number(out, "dissipated", ledger->dissipated, ", ");
    if (results->in_time) write_motion_ledger(out, motion);
    write_number(out, "imbalance", ledger->imbalance, "}");
}

/* parts, jumps and the energy balance of a step */
static void write_energy(FILE *out, const CpsResults *results, const CpsiRow *row) {
    const CpsStepReport *report = &row->report;
    fprintf(out, "\"substeps\": %d, \"jumps\": %d, ", report->substep_count, report->jump_count);
    write_number(out, "jump_m", report->jump, ", ");
    write_number(out, "unaccounted_J", report->unaccounted, ",\n      ");
    write_ledger(out, results, &report->ledger, &row->motion.of.ledger);
    fputs(",\n      ", out);
}

/* where a step stands in time */
static void write_time(FILE *out, const CpsResults *results, const CpsiMotionRow *motion) {
    if (!results->in_time) return;
    fputs("      ", out);
    write_number(out, "time_s", motion->time, ", ");
    write_number(out, "time_step_s", motion->pace.length, ", ");
    write_number(out, "step_error_m", motion->pace.error, ", ");
    fprintf(out, "\"steps_rejected\": %d, ", motion->pace.rejected);
    write_number(out, "kinetic_J", motion->of.kinetic, ",\n");
}

/* the points where lines meet after a step */
static void write_points(FILE *out, const CpsResults *results, const CpsiRow *row) {
    if (results->point_count == 0) return;
    fputs(",\n      \"points\": {\n", out);
    for (int i = 0; i < results->point_count; ++i) {
        const CpsPointReport *report = &row->point[i].report;
        fputs("        ", out);
        write_key(out, results->point[i].name);
        fputc('{', out);
        write_string(out, "state", cpsi_point_state(report->state), ", ");
        fprintf(out, "\"has_place\": %s, \"trials\": %d,\n          ",
                report->has_place ? "true" : "false", report->trial_count);
        write_vector(out, "position_m", report->position, ", ");
        write_vector(out, "lines_N", report->lines, ",\n          ");
        write_vector(out, "load_N", report->load, ", ");
        write_vector(out, "support_N", report->support, ",\n          ");
        if (results->point[i].constraint.kind != CPS_CONSTRAINT_KIND_NONE)
            write_vector(out, "set_reaction_N", report->set_reaction, ", ");
        if (report->obstacle != CPS_NO_OBSTACLE) {
            write_string(out, "obstacle", results->obstacle[report->obstacle].name, ", ");
            write_number(out, "reaction_N", report->reaction, ", ");
            write_vector(out, "normal", report->normal, ",\n          ");
            write_vector(out, "friction_N", report->friction, ", ");
            write_vector(out, "slip_m", report->slip, ", ");
            write_number(out, "dissipated_J", report->dissipated, ",\n          ");
        }
        if (results->in_time) {
            write_vector(out, "velocity_m_s", row->point[i].motion.velocity, ", ");
            write_vector(out, "inertia_N", report->inertia, ",\n          ");
        }
        const CpsPoint *point = &results->point[i];
        if (point->has_holding_capacity)
            write_number(out, "capacity_used", report->capacity_used, ", ");
        if (point->has_uplift_limit) write_number(out, "uplift_used", report->uplift_used, ", ");
        if (point->drags) {
            write_vector(out, "drag_m", report->drag, ", ");
            write_number(out, "dragged_m", report->dragged, ",\n          ");
        }
        if (report->water != CPS_POINT_WATER_NONE) {
            write_string(out, "water", cpsi_point_water(report->water), ", ");
            write_number(out, "buoyancy_N", report->buoyancy, ", ");
            write_number(out, "displaced_N", report->displaced, ",\n          ");
        }
        write_number(out, "residual_N", cpsi_point_residual(report), "}");
        fputs(i + 1 < results->point_count ? ",\n" : "\n", out);
    }
    fputs("      }", out);
}

/* a force and a moment about the reference point */
static void write_wrench(FILE *out, const char *force, const char *moment, const double *wrench) {
    write_vector(out, force, wrench, ", ");
    write_vector(out, moment, &wrench[3], ",\n          ");
}

/* the rigid bodies after a step */
static void write_bodies(FILE *out, const CpsResults *results, const CpsiRow *row) {
    if (results->body_count == 0) return;
    fputs(",\n      \"bodies\": {\n", out);
    for (int i = 0; i < results->body_count; ++i) {
        const CpsiBodyRow *of = &row->body[i];
        const CpsBodyReport *report = &of->report;
        fputs("        ", out);
        write_key(out, results->body[i].name);
        fputc('{', out);
        write_string(out, "state", cpsi_body_kind(report->kind), ", ");
        fprintf(out, "\"has_place\": %s, \"stable\": %s, \"trials\": %d,\n          ",
                report->has_place ? "true" : "false", report->is_stable ? "true" : "false",
                report->trial_count);
        write_vector(out, "position_m", report->position, ", ");
        write_list(out, "quaternion", 4, report->rotation, ",\n          ");
        write_vector(out, "roll_pitch_yaw_degrees", of->angle, ", ");
        write_number(out, "heel_degrees", of->heel, ",\n          ");
        write_wrench(out, "lines_N", "lines_Nm", report->lines);
        write_wrench(out, "load_N", "load_Nm", report->load);
        write_wrench(out, "support_N", "support_Nm", report->support);
        if (results->in_time) {
            write_wrench(out, "inertia_N", "inertia_Nm", report->inertia);
            write_wrench(out, "damping_N", "damping_Nm", report->damping);
            write_vector(out, "velocity_m_s", of->motion.velocity, ", ");
            write_vector(out, "turn_rate_rad_s", of->motion.turn_rate, ",\n          ");
        }
        if (report->proof_moment > 0) {
            fputs("\"proof\": {", out);
            write_vector(out, "axis", report->proof, ", ");
            write_number(out, "moment_Nm", report->proof_moment, "},\n          ");
        }
        write_number(out, "residual_N", of->residual[0], ", ");
        write_number(out, "residual_Nm", of->residual[1], "}");
        fputs(i + 1 < results->body_count ? ",\n" : "\n", out);
    }
    fputs("      }", out);
}

static void write_step(FILE *out, const CpsResults *results, const CpsiRow *row) {
    fputs("    {\n      ", out);
    write_string(out, "name", row->name, ", ");
    write_string(out, "outcome", cps_outcome_name(row->report.outcome), ", ");
    fprintf(out, "\"iterations\": %d,\n", row->report.iteration_count);
    write_time(out, results, &row->motion);
    write_break(out, results, &row->parted);
    write_certificate(out, results, row);
    write_energy(out, results, row);
    write_number(out, "wall_s", row->report.wall, ",\n      \"lines\": {\n");
    for (int i = 0; i < cpsi_listed_lines(results); ++i)
        write_line(out, results->line_name[i], &row->line[i], results->lets_go,
                   i + 1 < results->line_count ? ",\n" : "\n");
    fputs("      }", out);
    write_points(out, results, row);
    write_bodies(out, results, row);
    fputs("\n    }", out);
}

static void write_extreme(FILE *out, const char *key, const CpsExtreme *extreme,
                          const char *after) {
    write_key(out, key);
    if (!extreme->has_values) {
        fprintf(out, "null%s", after);
        return;
    }
    fputc('{', out);
    write_number(out, "least", extreme->least, ", ");
    fprintf(out, "\"least_step\": %d, ", extreme->least_step);
    write_number(out, "greatest", extreme->greatest, ", ");
    fprintf(out, "\"greatest_step\": %d}%s", extreme->greatest_step, after);
}

/* The extremes of line `i` over the certified steps; they are numbered as those of `steps`. */
static void write_line_extremes(FILE *out, const CpsResults *results, int i, const char *after) {
    CpsExtremes of = {0};
    for (int r = 0; r < results->row_count; ++r)
        cps_extremes_add(&of, &results->row[r].line[i].report, r);
    fputs("    ", out);
    write_key(out, results->line_name[i]);
    fputs("{\n", out);
    for (int end = 0; end < 2; ++end) {
        fputs("      ", out);
        write_key(out, end == CPS_END_A ? "A" : "B");
        fputc('{', out);
        write_extreme(out, "tension_N", &of.tension[end], ",\n        ");
        write_extreme(out, "uplift_N", &of.uplift[end], ",\n        ");
        write_extreme(out, "angle_rad", &of.angle[end], ",\n        ");
        write_extreme(out, "suspended_m", &of.suspended[end], ",\n        ");
        write_extreme(out, "touchdown_x_m", &of.touchdown[end][0], ",\n        ");
        write_extreme(out, "touchdown_y_m", &of.touchdown[end][1], ",\n        ");
        write_extreme(out, "touchdown_z_m", &of.touchdown[end][2], "},\n");
    }
    fputs("      ", out);
    write_extreme(out, "grounded_m", &of.grounded, ",\n      ");
    write_extreme(out, "slipping_m", &of.slipping, ",\n      ");
    write_extreme(out, "slack_m", &of.slack, ",\n      ");
    write_extreme(out, "sweep_m", &of.sweep, ",\n      ");
    write_extreme(out, "utilisation", &of.utilisation, "\n    }");
    fputs(after, out);
}

/* The points, and what at most nothing balances there, over all steps. */
static void write_largest_residuals(FILE *out, const CpsResults *results) {
    if (results->point_count == 0) return;
    fputs("  \"points\": {\n", out);
    for (int i = 0; i < results->point_count; ++i) {
        double largest = 0;
        int at = 0, without = 0;
        for (int r = 0; r < results->row_count; ++r) {
            const CpsPointReport *report = &results->row[r].point[i].report;
            const double residual = cpsi_point_residual(report);
            without += !report->has_place;
            if (isnan(largest) || residual <= largest) continue; /* a NaN is kept */
            largest = residual;
            at = r;
        }
        fputs("    ", out);
        write_key(out, results->point[i].name);
        fputc('{', out);
        const CpsPointKind kind = results->point[i].kind;
        write_string(out, "kind",
                     cpsi_point_state(kind == CPS_POINT_KIND_HELD   ? CPS_POINT_STATE_HELD
                                      : kind == CPS_POINT_KIND_FREE ? CPS_POINT_STATE_FREE
                                                                    : CPS_POINT_STATE_ON_BODY),
                     ", ");
        if (kind == CPS_POINT_KIND_ON_BODY)
            write_string(out, "body", results->body[results->point[i].body].name, ", ");
        write_number(out, "weight_N", results->point[i].weight, ", ");
        write_number(out, "largest_residual_N", largest, ", ");
        fprintf(out, "\"largest_residual_step\": %d, \"steps_without_place\": %d}%s\n", at, without,
                i + 1 < results->point_count ? "," : "");
    }
    fputs("  },\n", out);
}

static void widen(CpsExtreme *extreme, double value, int step) {
    if (!extreme->has_values) *extreme = (CpsExtreme){true, value, value, step, step};
    if (value < extreme->least) {
        extreme->least = value;
        extreme->least_step = step;
    }
    if (value > extreme->greatest) {
        extreme->greatest = value;
        extreme->greatest_step = step;
    }
}

/* Quantities of a body's extremes. */
static const struct {
    const char *key;
    CpsiMember member;
} BODY_EXTREME[] = {
    {"x_m", CPSI_MEMBER(CpsiBodyRow, report.position[0])},
    {"y_m", CPSI_MEMBER(CpsiBodyRow, report.position[1])},
    {"z_m", CPSI_MEMBER(CpsiBodyRow, report.position[2])},
    {"roll_degrees", CPSI_MEMBER(CpsiBodyRow, angle[0])},
    {"pitch_degrees", CPSI_MEMBER(CpsiBodyRow, angle[1])},
    {"yaw_degrees", CPSI_MEMBER(CpsiBodyRow, angle[2])},
    {"heel_degrees", CPSI_MEMBER(CpsiBodyRow, heel)},
    {"lines_x_N", CPSI_MEMBER(CpsiBodyRow, report.lines[0])},
    {"lines_y_N", CPSI_MEMBER(CpsiBodyRow, report.lines[1])},
    {"lines_z_N", CPSI_MEMBER(CpsiBodyRow, report.lines[2])},
};
enum { BODY_EXTREMES = sizeof BODY_EXTREME / sizeof *BODY_EXTREME };

/* The extremes of a body over the steps that have found a place for it. */
static void write_body_extremes(FILE *out, const CpsResults *results, int body) {
    fputs("      \"extremes\": {\n", out);
    for (int i = 0; i < BODY_EXTREMES; ++i) {
        CpsExtreme extreme = {0};
        for (int r = 0; r < results->row_count; ++r) {
            const CpsiBodyRow *of = &results->row[r].body[body];
            if (of->report.has_place) widen(&extreme, cpsi_member(of, BODY_EXTREME[i].member), r);
        }
        fputs("        ", out);
        write_extreme(out, BODY_EXTREME[i].key, &extreme, i + 1 < BODY_EXTREMES ? ",\n" : "\n");
    }
    fputs("      }", out);
}

/* The bodies over all steps. */
static void write_all_bodies(FILE *out, const CpsResults *results) {
    if (results->body_count == 0) return;
    fputs("  \"bodies\": {\n", out);
    for (int i = 0; i < results->body_count; ++i) {
        double largest[2] = {0};
        int without = 0, unstable = 0;
        for (int r = 0; r < results->row_count; ++r) {
            const CpsiBodyRow *of = &results->row[r].body[i];
            without += !of->report.has_place;
            unstable += !of->report.is_stable;
            for (int k = 0; k < 2; ++k) /* a NaN is kept */
                if (!(of->residual[k] <= largest[k])) largest[k] = of->residual[k];
        }
        fputs("    ", out);
        write_key(out, results->body[i].name);
        fputs("{\n      ", out);
        write_string(out, "kind", cpsi_body_kind(results->body[i].kind), ", ");
        write_number(out, "weight_N", results->body[i].weight, ", ");
        write_number(out, "buoyancy_N", results->body[i].buoyancy, ",\n      ");
        write_number(out, "largest_residual_N", largest[0], ", ");
        write_number(out, "largest_residual_Nm", largest[1], ",\n      ");
        fprintf(out, "\"steps_without_place\": %d, \"steps_not_stable\": %d,\n", without, unstable);
        write_body_extremes(out, results, i);
        fprintf(out, "\n    }%s\n", i + 1 < results->body_count ? "," : "");
    }
    fputs("  },\n", out);
}

/* The sums of the entries of the energy balances over all steps of a history in time. */
static void write_whole_ledger(FILE *out, const CpsResults *results) {
    if (!results->in_time) return;
    CpsLedger sum = {0};
    CpsMotionLedger motion = {0};
    for (int r = 0; r < results->row_count; ++r)
        cps_ledgers_add(&results->row[r].report.ledger, &results->row[r].motion.of.ledger, &sum,
                        &motion);
    fputs("  ", out);
    write_ledger(out, results, &sum, &motion);
    fputs(",\n", out);
}

static void write_run(const CpsResults *results, double wall, FILE *out) {
    fputs("{\n  ", out);
    write_string(out, "capstan", cps_version(), ",\n  ");
    write_string(out, "title", results->title, ",\n  ");
    const double *o = results->origin; /* written where it is not 0 */
    if (o[0] != 0 || o[1] != 0 || o[2] != 0) write_vector(out, "origin_m", o, ",\n  ");
    write_string(out, "outcome", cps_outcome_name(cpsi_results_outcome(results)), ",\n  ");
    write_number(out, "wall_s", wall, ",\n  \"extremes\": {\n");
    for (int i = 0; i < cpsi_listed_lines(results); ++i)
        write_line_extremes(out, results, i, i + 1 < results->line_count ? ",\n" : "\n");
    fputs("  },\n", out);
    write_whole_ledger(out, results);
    write_largest_residuals(out, results);
    write_all_bodies(out, results);
    fputs("  \"steps\": [", out);
    for (int i = 0; i < results->row_count; ++i) {
        fputs(i ? ",\n" : "\n", out);
        write_step(out, results, &results->row[i]);
    }
    fputs(results->row_count ? "\n  ]" : "]", out);
}

void cpsi_summary_write(const CpsResults *results, double wall, FILE *out) {
    write_run(results, wall, out);
    fputs("\n}\n", out);
}

CpsStatus cpsi_summary_file(const CpsResults *results, double wall, FILE *out, CpsError *err) {
    write_run(results, wall, out);
    fputs(",\n", out);
    const CpsStatus status = cpsi_result_list_add(results->directory, out, err);
    fputs("}\n", out);
    return status;
}
