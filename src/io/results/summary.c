/* SPDX-License-Identifier: BSD-3-Clause */
/* The summary as one JSON object (RFC 8259): what `capstan run --json` prints and summary.json
 * holds. Keys are stable and carry their units; a number that says nothing is null. docs/results.md
 * lists them. */
#include "io/base/escape.h"
#include "io/base/file_list.h"
#include "io/results/writers.h"

static void put_key(FILE *out, const char *key) {
    cpsi_put_json_string(out, key);
    fputs(": ", out);
}

static void put_number(FILE *out, const char *key, double x, const char *after) {
    put_key(out, key);
    cpsi_put_json_number(out, x);
    fputs(after, out);
}

static void put_string(FILE *out, const char *key, const char *text, const char *after) {
    put_key(out, key);
    cpsi_put_json_string(out, text);
    fputs(after, out);
}

static void put_vector(FILE *out, const char *key, const double x[3], const char *after) {
    put_key(out, key);
    for (int i = 0; i < 3; ++i) {
        fputs(i ? ", " : "[", out);
        cpsi_put_json_number(out, x[i]);
    }
    fprintf(out, "]%s", after);
}

/* between which values the tension of the element at an end lies; null where unbounded or not
 * known, `kind` says which */
static void put_range(FILE *out, const CpsTensionRange *range) {
    fputs(", \n            \"tension_range_N\": {", out);
    put_string(out, "kind", cps_range_key(range->kind), ", ");
    put_number(out, "least", range->least, ", ");
    put_number(out, "least_bound", range->least_bound, ", ");
    put_number(out, "greatest", range->greatest, ", ");
    put_number(out, "greatest_bound", range->greatest_bound, "}}");
}

static void put_end(FILE *out, const char *key, const CpsEndReport *end, const char *after) {
    fputs("          ", out);
    put_key(out, key);
    fputc('{', out);
    put_vector(out, "position_m", end->position, ", ");
    put_vector(out, "force_N", end->force, ", ");
    put_number(out, "tension_N", end->tension, "");
    put_range(out, &end->range);
    fputs(after, out);
}

/* what proves that there is no solution, in the units of its kind */
static void put_proof(FILE *out, const CpsLineReport *report) {
    if (!cps_outcome_is_final(report->outcome)) return;
    const char *value = report->outcome == CPS_INFEASIBLE ? "excess_m"
                        : report->outcome == CPS_SLIDES   ? "power_N"
                                                          : "fall_N";
    fputs("          \"proof\": {", out);
    put_vector(out, "direction", report->proof, ", ");
    if (report->outcome == CPS_INFEASIBLE && report->proof_obstacle >= 0)
        fprintf(out, "\"obstacle\": %d, ", report->proof_obstacle);
    if (report->coulomb > 0) put_number(out, "coulomb_N", report->coulomb, ", ");
    put_number(out, value, report->proof_value, "},\n");
}

/* the sharpest bend round an obstacle, where there is one */
static void put_bend(FILE *out, const CpsBend *bend) {
    if (!(bend->turn > 0)) return;
    fputs("          \"bend\": {", out);
    put_number(out, "turn_rad", bend->turn, ", ");
    put_number(out, "friction", bend->friction, ", ");
    put_number(out, "ratio", bend->ratio, ", ");
    put_number(out, "coulomb", bend->coulomb, ", ");
    put_number(out, "at_m", bend->arc_length, ", ");
    put_number(out, "element_m", bend->element, "},\n");
}

static void put_line(FILE *out, const char *name, const CpsLineReport *report, const char *after) {
    fputs("        ", out);
    put_key(out, name);
    fputs("{\n          ", out);
    put_string(out, "outcome", cps_outcome_key(report->outcome), ", ");
    fprintf(out, "\"iterations\": %d, \"places_not_unique\": %d,\n          ", report->iterations,
            (int)report->places);
    put_number(out, "grounded_m", report->grounded, ", ");
    put_number(out, "slipping_m", report->slipping, ", ");
    put_number(out, "slack_m", report->slack, ", ");
    put_number(out, "dissipated_J", report->dissipated, ",\n          ");
    put_number(out, "tension_mesh_estimate_N", report->tension_mesh, ",\n");
    put_proof(out, report);
    put_bend(out, &report->bend);
    put_end(out, "A", &report->end[CPS_END_A], ",\n");
    put_end(out, "B", &report->end[CPS_END_B], "\n        }");
    fputs(after, out);
}

static void put_certificate(FILE *out, const CpsResults *results, const CpsiRow *row) {
    const CpsCertificate *c = &row->report.certificate;
    fputs("      \"energy\": {", out);
    put_number(out, "primal_J", c->primal, ", ");
    put_number(out, "dual_J", c->dual, ", ");
    put_number(out, "gap_J", c->gap, ", ");
    put_number(out, "scale_J", c->scale, "},\n      \"tension_bound_rms_N\": {");
    for (int i = 0; i < results->line_count; ++i)
        put_number(out, results->line_name[i], row->line[i].report.certificate.tension_bound,
                   i + 1 < results->line_count ? ", " : "");
    fputs("},\n      ", out);
    put_number(out, "tension_estimate_N", c->tension_estimate, ",\n      ");
    put_number(out, "force_residual_N", c->force_residual, ", ");
    put_number(out, "largest_force_N", c->largest_force, ",\n      ");
    put_number(out, "law_residual_J", c->law_residual, ", ");
    put_number(out, "contact_residual_N", row->open_reaction, ", ");
    put_number(out, "contact_residual_J", c->contact_residual, ",\n      ");
    put_number(out, "friction_residual_N", c->friction_residual, ", ");
    put_number(out, "element_push_N", c->element_push, ", ");
    put_number(out, "elongation_residual", c->elongation_residual, ", ");
    put_number(out, "stretch_residual", c->stretch_residual, ", ");
    put_number(out, "penetration_m", c->penetration, ", ");
    put_number(out, "element_penetration_m", c->element_penetration, ", ");
    put_number(out, "dissipated_J", row->report.dissipated, ",\n      ");
}

/* where the energy went */
static void put_ledger(FILE *out, const CpsStepReport *report) {
    const CpsLedger *ledger = &report->ledger;
    fprintf(out, "\"parts\": %d, \"snaps\": %d, ", report->parts, report->snaps);
    put_number(out, "jump_m", report->jump, ", ");
    put_number(out, "unaccounted_J", report->unaccounted, ",\n      \"ledger_J\": {");
    put_number(out, "ends", ledger->ends, ", ");
    put_number(out, "obstacles", ledger->obstacles, ", ");
    put_number(out, "elastic", ledger->elastic, ", ");
    put_number(out, "gravity", ledger->gravity, ", ");
    put_number(out, "dissipated", ledger->dissipated, ", ");
    put_number(out, "imbalance", ledger->imbalance, "},\n      ");
}

static void put_step(FILE *out, const CpsResults *results, const CpsiRow *row) {
    fputs("    {\n      ", out);
    put_string(out, "name", row->name, ", ");
    put_string(out, "outcome", cps_outcome_key(row->report.outcome), ", ");
    fprintf(out, "\"iterations\": %d,\n", row->report.iterations);
    put_certificate(out, results, row);
    put_ledger(out, &row->report);
    put_number(out, "wall_s", row->report.wall, ",\n      \"lines\": {\n");
    for (int i = 0; i < results->line_count; ++i)
        put_line(out, results->line_name[i], &row->line[i].report,
                 i + 1 < results->line_count ? ",\n" : "\n");
    fputs("      }\n    }", out);
}

static void put_run(const CpsResults *results, double wall, FILE *out) {
    fputs("{\n  ", out);
    put_string(out, "capstan", cps_version(), ",\n  ");
    put_string(out, "title", results->title, ",\n  ");
    const double *o = results->origin; /* said where it is not 0 */
    if (o[0] != 0 || o[1] != 0 || o[2] != 0) put_vector(out, "origin_m", o, ",\n  ");
    put_string(out, "outcome", cps_outcome_key(cpsi_results_outcome(results)), ",\n  ");
    put_number(out, "wall_s", wall, ",\n  \"steps\": [");
    for (int i = 0; i < results->row_count; ++i) {
        fputs(i ? ",\n" : "\n", out);
        put_step(out, results, &results->row[i]);
    }
    fputs(results->row_count ? "\n  ]" : "]", out);
}

void cpsi_summary_write(const CpsResults *results, double wall, FILE *out) {
    put_run(results, wall, out);
    fputs("\n}\n", out);
}

CpsStatus cpsi_summary_file(const CpsResults *results, double wall, FILE *out, CpsError *err) {
    put_run(results, wall, out);
    fputs(",\n", out);
    const CpsStatus status = cpsi_result_list_put(results->directory, out, err);
    fputs("}\n", out);
    return status;
}
