/* SPDX-License-Identifier: BSD-3-Clause */
/* The history as CSV (RFC 4180): a row of names, a row of units, a row per step. The columns are
 * three tables, for the step, for each line and for each body; a value without meaning is an empty
 * cell. */
#include "io/base/text/columns.h"
#include "io/base/text/escape.h"
#include "io/results/writers.h"

#define STEP(member)          CPSI_MEMBER(CpsStepReport, member)
#define LINE(member)          CPSI_MEMBER(CpsLineReport, member)
#define LINE_IF(flag, member) CPSI_MEMBER_IF(CpsLineReport, flag, member)

static const CpsiColumn STEP_COLUMN[] = {
    {"primal", "J", STEP(certificate.primal)},
    {"dual", "J", STEP(certificate.dual)},
    {"gap", "J", STEP(certificate.gap)},
    {"scale", "J", STEP(certificate.scale)},
    {"force_residual", "N", STEP(certificate.force_residual)},
    {"largest_force", "N", STEP(certificate.largest_force)},
    {"dissipated", "J", STEP(dissipated)},
    {"jump", "m", STEP(jump)},
    {"ends", "J", STEP(ledger.ends)},
    {"obstacles", "J", STEP(ledger.obstacles)},
    {"elastic", "J", STEP(ledger.elastic)},
    {"gravity", "J", STEP(ledger.gravity)},
    {"imbalance", "J", STEP(ledger.imbalance)},
    {"unaccounted", "J", STEP(unaccounted)},
    {"wall", "s", STEP(wall)},
};

#define RANGE_COLUMN(letter, e, which) \
    { letter ".tension_" #which, "N", LINE_IF(end[e].range.has_values, end[e].range.which) }
#define END_COLUMNS(letter, e)                                                                    \
    {letter ".x", "m", LINE(end[e].position[0])}, {letter ".y", "m", LINE(end[e].position[1])},   \
        {letter ".z", "m", LINE(end[e].position[2])}, {letter ".fx", "N", LINE(end[e].force[0])}, \
        {letter ".fy", "N", LINE(end[e].force[1])}, {letter ".fz", "N", LINE(end[e].force[2])},   \
        {letter ".tension", "N", LINE(end[e].tension)},                                           \
        {letter ".uplift", "N", LINE(end[e].uplift)},                                             \
        {letter ".angle", "rad", LINE(end[e].angle)},                                             \
        {letter ".suspended", "m", LINE(end[e].suspended)}, RANGE_COLUMN(letter, e, least),       \
        RANGE_COLUMN(letter, e, least_bound), RANGE_COLUMN(letter, e, greatest),                  \
        RANGE_COLUMN(letter, e, greatest_bound)

#define TOUCHDOWN_COLUMNS(letter, e)                                                 \
    {letter ".touchdown_x", "m", LINE_IF(has_touchdown, end[e].touchdown[0])},       \
        {letter ".touchdown_y", "m", LINE_IF(has_touchdown, end[e].touchdown[1])}, { \
        letter ".touchdown_z", "m", LINE_IF(has_touchdown, end[e].touchdown[2])      \
    }

static const CpsiColumn LINE_COLUMN[] = {
    END_COLUMNS("A", CPS_END_A),
    END_COLUMNS("B", CPS_END_B),
    {"grounded", "m", LINE(grounded)},
    {"slipping", "m", LINE_IF(has_slipping, slipping)},
    {"slack", "m", LINE(slack)},
    {"dissipated", "J", LINE(dissipated)},
    {"bend", "rad", LINE(bend.turn)},
    {"bend_ratio", "1", LINE(bend.ratio)},
    {"bend_coulomb", "1", LINE(bend.coulomb)},
    {"tension_bound_rms", "N", LINE_IF(certificate.has_tension_bound, certificate.tension_bound)},
    {"tension_mesh_estimate", "N", LINE_IF(has_tension_mesh, tension_mesh)},
    {"utilisation", "1", LINE_IF(has_utilisation, utilisation)},
    {"utilisation_at", "m", LINE_IF(has_utilisation, utilisation_arc_length)},
    TOUCHDOWN_COLUMNS("A", CPS_END_A),
    TOUCHDOWN_COLUMNS("B", CPS_END_B),
    {"sweep", "m", LINE(sweep)},
};

/* Where ends may be let go. */
static const CpsiColumn FAILURE_COLUMN[] = {
    {"break_share", "1", CPSI_MEMBER_IF(CpsLineFailure, has_break_at, share)},
    {"break_share_at", "m", CPSI_MEMBER_IF(CpsLineFailure, has_break_at, arc_length)},
};

/* Where lines have winches. */
static const CpsiColumn WINCH_STEP_COLUMN[] = {{"winches", "J", STEP(ledger.winches)}};

/* Where lines have loads beside their weight. */
static const CpsiColumn LOADS_COLUMN[] = {{"loads", "J", STEP(ledger.loads)}};

#define WINCH(member) CPSI_MEMBER_IF(CpsWinchReport, is_there, member)

static const CpsiColumn WINCH_COLUMN[] = {{"stored", "m", WINCH(stored)},
                                          {"paid", "m", WINCH(paid)},
                                          {"winch_pull", "N", WINCH(pull)}};

#define SET(member) CPSI_MEMBER_IF(CpsConstraintReport, is_there, member)

/* Where ends of lines are held to sets. */
static const CpsiColumn SET_COLUMN[] = {{"reaction_x", "N", SET(reaction[0])},
                                        {"reaction_y", "N", SET(reaction[1])},
                                        {"reaction_z", "N", SET(reaction[2])}};

#define BODY(member) CPSI_MEMBER(CpsiBodyRow, member)

static const CpsiColumn BODY_COLUMN[] = {
    {"x", "m", BODY(report.position[0])},     {"y", "m", BODY(report.position[1])},
    {"z", "m", BODY(report.position[2])},     {"roll", "degree", BODY(angle[0])},
    {"pitch", "degree", BODY(angle[1])},      {"yaw", "degree", BODY(angle[2])},
    {"heel", "degree", BODY(heel)},           {"fx", "N", BODY(report.lines[0])},
    {"fy", "N", BODY(report.lines[1])},       {"fz", "N", BODY(report.lines[2])},
    {"mx", "N m", BODY(report.lines[3])},     {"my", "N m", BODY(report.lines[4])},
    {"mz", "N m", BODY(report.lines[5])},     {"residual", "N", BODY(residual[0])},
    {"residual_m", "N m", BODY(residual[1])},
};

#define MOTION(member) CPSI_MEMBER(CpsiMotionRow, member)

/* Where steps have a duration. */
static const CpsiColumn MOTION_COLUMN[] = {
    {"time", "s", MOTION(time)},
    {"time_step", "s", MOTION(pace.length)},
    {"step_error", "m", MOTION(pace.error)},
    {"steps_rejected", "1", MOTION(rejected)},
    {"kinetic", "J", MOTION(of.kinetic)},
    {"kinetic_growth", "J", MOTION(of.ledger.kinetic)},
    {"impact", "J", MOTION(of.ledger.impact)},
    {"scheme", "J", MOTION(of.ledger.scheme)},
    {"settling", "J", MOTION(of.ledger.settling)},
    {"damping", "J", MOTION(of.ledger.damping)},
    {"drag", "J", MOTION(of.ledger.drag)},
    {"added", "J", MOTION(of.ledger.added)},
    {"waves", "J", MOTION(of.ledger.waves)},
    {"turnover", "J", MOTION(of.ledger.turnover)},
    {"position_bound", "m", MOTION(of.position_bound)},
    {"landed", "1", MOTION(landed)},
    {"changed", "1", MOTION(changed)},
    {"snatched", "1", MOTION(snatched)},
};

enum {
    MOTION_COLUMNS = sizeof MOTION_COLUMN / sizeof MOTION_COLUMN[0],
    STEP_COLUMNS = sizeof STEP_COLUMN / sizeof STEP_COLUMN[0],
    LINE_COLUMNS = sizeof LINE_COLUMN / sizeof LINE_COLUMN[0],
    WINCH_COLUMNS = sizeof WINCH_COLUMN / sizeof WINCH_COLUMN[0],
    SET_COLUMNS = sizeof SET_COLUMN / sizeof SET_COLUMN[0],
    FAILURE_COLUMNS = sizeof FAILURE_COLUMN / sizeof FAILURE_COLUMN[0],
    BODY_COLUMNS = sizeof BODY_COLUMN / sizeof BODY_COLUMN[0]
};

/* What the failure of a line has beside numbers: which ends were let go. */
static void write_failure_heads(FILE *out, const char *line) {
    cpsi_csv_names(out, FAILURE_COLUMN, FAILURE_COLUMNS, line);
    fprintf(out, ",%s.A.release,%s.B.release", line, line);
}

static void write_failure(FILE *out, const CpsLineFailure *failure) {
    cpsi_csv_values(out, FAILURE_COLUMN, FAILURE_COLUMNS, failure);
    for (int end = 0; end < 2; ++end) fprintf(out, ",%s", cps_release_name(failure->release[end]));
}

/* Names, or units, of columns of both ends of a line. */
static void write_end_heads(FILE *out, const char *line, const CpsiColumn *column, int count,
                            bool units) {
    for (int end = 0; end < 2; ++end)
        if (units)
            cpsi_csv_units(out, column, count);
        else
            for (int i = 0; i < count; ++i)
                fprintf(out, ",%s.%s.%s", line, end == CPS_END_A ? "A" : "B", column[i].name);
}

static void write_heads(FILE *out, const CpsResults *results) {
    fputs("step,name,outcome,iterations,substeps,jumps,places_not_unique", out);
    cpsi_csv_names(out, STEP_COLUMN, STEP_COLUMNS, NULL);
    for (int l = 0; l < cpsi_listed_lines(results); ++l)
        cpsi_csv_names(out, LINE_COLUMN, LINE_COLUMNS, results->line_name[l]);
    for (int l = 0; l < cpsi_listed_lines(results) && results->lets_go; ++l)
        write_failure_heads(out, results->line_name[l]);
    if (results->winds) cpsi_csv_names(out, WINCH_STEP_COLUMN, 1, NULL);
    for (int l = 0; l < cpsi_listed_lines(results) && results->winds; ++l)
        write_end_heads(out, results->line_name[l], WINCH_COLUMN, WINCH_COLUMNS, false);
    for (int l = 0; l < cpsi_listed_lines(results) && results->has_sets; ++l)
        write_end_heads(out, results->line_name[l], SET_COLUMN, SET_COLUMNS, false);
    for (int i = 0; i < results->body_count; ++i)
        cpsi_csv_names(out, BODY_COLUMN, BODY_COLUMNS, results->body[i].name);
    if (results->has_loads) cpsi_csv_names(out, LOADS_COLUMN, 1, NULL);
    if (results->in_time) cpsi_csv_names(out, MOTION_COLUMN, MOTION_COLUMNS, NULL);
    fputs("\n1,,,1,1,1,1", out);
    cpsi_csv_units(out, STEP_COLUMN, STEP_COLUMNS);
    for (int l = 0; l < cpsi_listed_lines(results); ++l)
        cpsi_csv_units(out, LINE_COLUMN, LINE_COLUMNS);
    for (int l = 0; l < cpsi_listed_lines(results) && results->lets_go; ++l) {
        cpsi_csv_units(out, FAILURE_COLUMN, FAILURE_COLUMNS);
        fputs(",,", out);
    }
    if (results->winds) cpsi_csv_units(out, WINCH_STEP_COLUMN, 1);
    for (int l = 0; l < cpsi_listed_lines(results) && results->winds; ++l)
        write_end_heads(out, results->line_name[l], WINCH_COLUMN, WINCH_COLUMNS, true);
    for (int l = 0; l < cpsi_listed_lines(results) && results->has_sets; ++l)
        write_end_heads(out, results->line_name[l], SET_COLUMN, SET_COLUMNS, true);
    for (int i = 0; i < results->body_count; ++i) cpsi_csv_units(out, BODY_COLUMN, BODY_COLUMNS);
    if (results->has_loads) cpsi_csv_units(out, LOADS_COLUMN, 1);
    if (results->in_time) cpsi_csv_units(out, MOTION_COLUMN, MOTION_COLUMNS);
    fputs("\n", out);
}

void cpsi_history_write(const CpsResults *results, FILE *out) {
    write_heads(out, results);
    for (int r = 0; r < results->row_count; ++r) {
        const CpsiRow *row = &results->row[r];
        fprintf(out, "%d,", row->report.step_count - 1);
        cpsi_write_csv(out, row->name);
        fprintf(out, ",%s,%d,%d,%d,%d", cps_outcome_name(row->report.outcome),
                row->report.iteration_count, row->report.substep_count, row->report.jump_count,
                (int)row->report.places);
        cpsi_csv_values(out, STEP_COLUMN, STEP_COLUMNS, &row->report);
        for (int l = 0; l < cpsi_listed_lines(results); ++l)
            cpsi_csv_values(out, LINE_COLUMN, LINE_COLUMNS, &row->line[l].report);
        for (int l = 0; l < cpsi_listed_lines(results) && results->lets_go; ++l)
            write_failure(out, &row->line[l].failure);
        if (results->winds) cpsi_csv_values(out, WINCH_STEP_COLUMN, 1, &row->report);
        for (int l = 0; l < cpsi_listed_lines(results) && results->winds; ++l)
            for (int end = 0; end < 2; ++end)
                cpsi_csv_values(out, WINCH_COLUMN, WINCH_COLUMNS, &row->line[l].winch[end]);
        for (int l = 0; l < cpsi_listed_lines(results) && results->has_sets; ++l)
            for (int end = 0; end < 2; ++end)
                cpsi_csv_values(out, SET_COLUMN, SET_COLUMNS, &row->line[l].constraint[end]);
        for (int i = 0; i < results->body_count; ++i)
            cpsi_csv_values(out, BODY_COLUMN, BODY_COLUMNS, &row->body[i]);
        if (results->has_loads) cpsi_csv_values(out, LOADS_COLUMN, 1, &row->report);
        if (results->in_time) cpsi_csv_values(out, MOTION_COLUMN, MOTION_COLUMNS, &row->motion);
        fputs("\n", out);
    }
}
