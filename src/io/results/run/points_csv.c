/* SPDX-License-Identifier: BSD-3-Clause */
/* The points where lines meet, and the rigid bodies, as CSV (RFC 4180): a row of names, a row of
 * units, then a row per step and point or body. The obstacle is empty where a point touches none,
 * the water where it cannot leave it. */
#include "io/base/text/columns.h"
#include "io/base/text/escape.h"
#include "io/results/writers.h"

#define POINT(member) CPSI_MEMBER(CpsPointReport, member)
#define VECTOR(name, unit, member)                                              \
    {name "_x", unit, POINT(member[0])}, {name "_y", unit, POINT(member[1])}, { \
        name "_z", unit, POINT(member[2])                                       \
    }

static const CpsiColumn COLUMN[] = {
    {"x", "m", POINT(position[0])},
    {"y", "m", POINT(position[1])},
    {"z", "m", POINT(position[2])},
    VECTOR("lines", "N", lines),
    VECTOR("load", "N", load),
    VECTOR("support", "N", support),
    {"reaction", "N", POINT(reaction)},
    VECTOR("normal", "1", normal),
    VECTOR("friction", "N", friction),
    VECTOR("slip", "m", slip),
    VECTOR("residual", "N", residual),
    {"dissipated", "J", POINT(dissipated)},
    {"buoyancy", "N", POINT(buoyancy)},
    {"displaced", "N", POINT(displaced)},
    {"capacity_used", "1", POINT(capacity_used)},
    {"uplift_used", "1", POINT(uplift_used)},
    VECTOR("drag", "m", drag),
    {"dragged", "m", POINT(dragged)},
    VECTOR("set_reaction", "N", set_reaction),
};

#define MOVING(name, unit, member)                                 \
    {name "_x", unit, CPSI_MEMBER(CpsiPointRow, member[0])},       \
        {name "_y", unit, CPSI_MEMBER(CpsiPointRow, member[1])}, { \
        name "_z", unit, CPSI_MEMBER(CpsiPointRow, member[2])      \
    }

/* Where steps have a duration. */
static const CpsiColumn MOTION_COLUMN[] = {
    MOVING("velocity", "m/s", motion.velocity),
    MOVING("inertia", "N", report.inertia),
    {"kinetic", "J", CPSI_MEMBER(CpsiPointRow, motion.kinetic)},
    {"impact", "J", CPSI_MEMBER(CpsiPointRow, motion.ledger.impact)},
    {"scheme", "J", CPSI_MEMBER(CpsiPointRow, motion.ledger.scheme)},
};

#define BODY(member) CPSI_MEMBER(CpsiBodyRow, member)
/* a force and a moment */
#define WRENCH(name, member)                                                                   \
    {name "_x", "N", BODY(report.member[0])}, {name "_y", "N", BODY(report.member[1])},        \
        {name "_z", "N", BODY(report.member[2])}, {name "_mx", "N m", BODY(report.member[3])}, \
        {name "_my", "N m", BODY(report.member[4])}, {                                         \
        name "_mz", "N m", BODY(report.member[5])                                              \
    }

static const CpsiColumn BODY_COLUMN[] = {
    {"x", "m", BODY(report.position[0])},
    {"y", "m", BODY(report.position[1])},
    {"z", "m", BODY(report.position[2])},
    {"qw", "1", BODY(report.rotation[0])},
    {"qx", "1", BODY(report.rotation[1])},
    {"qy", "1", BODY(report.rotation[2])},
    {"qz", "1", BODY(report.rotation[3])},
    {"roll", "degree", BODY(angle[0])},
    {"pitch", "degree", BODY(angle[1])},
    {"yaw", "degree", BODY(angle[2])},
    {"heel", "degree", BODY(heel)},
    WRENCH("lines", lines),
    WRENCH("load", load),
    WRENCH("support", support),
    WRENCH("residual", residual),
};

#define TURNING(name, unit, member)                                                         \
    {name "_x", unit, BODY(motion.member[0])}, {name "_y", unit, BODY(motion.member[1])}, { \
        name "_z", unit, BODY(motion.member[2])                                             \
    }

/* Where steps have a duration. */
static const CpsiColumn BODY_MOTION_COLUMN[] = {
    TURNING("velocity", "m/s", velocity),
    TURNING("turn_rate", "rad/s", turn_rate),
    WRENCH("inertia", inertia),
    WRENCH("damping", damping),
    {"kinetic", "J", BODY(motion.kinetic)},
    {"damped", "J", BODY(motion.dissipated)},
    {"scheme", "J", BODY(motion.ledger.scheme)},
};

enum {
    BODY_MOTION_COLUMNS = sizeof BODY_MOTION_COLUMN / sizeof *BODY_MOTION_COLUMN,
    MOTION_COLUMNS = sizeof MOTION_COLUMN / sizeof *MOTION_COLUMN,
    COLUMNS = sizeof COLUMN / sizeof *COLUMN,
    BODY_COLUMNS = sizeof BODY_COLUMN / sizeof *BODY_COLUMN
};

static void write_row(FILE *out, const CpsResults *results, const CpsiRow *row, int point) {
    const CpsiPointRow *of = &row->point[point];
    const CpsPointReport *report = &of->report;
    fprintf(out, "%d,", row->report.step_count - 1);
    cpsi_write_csv(out, row->name);
    fputc(',', out);
    cpsi_write_csv(out, results->point[point].name);
    fprintf(out, ",%s", cpsi_point_state(report->state));
    cpsi_csv_values(out, COLUMN, COLUMNS, report);
    if (results->in_time) cpsi_csv_values(out, MOTION_COLUMN, MOTION_COLUMNS, of);
    fputc(',', out);
    if (report->obstacle != CPS_NO_OBSTACLE)
        cpsi_write_csv(out, results->obstacle[report->obstacle].name);
    fprintf(out, ",%d,%d,%s\n", report->trial_count, (int)report->has_place,
            cpsi_point_water(report->water));
}

void cpsi_points_write(const CpsResults *results, FILE *out) {
    fputs("step,name,point,state", out);
    cpsi_csv_names(out, COLUMN, COLUMNS, NULL);
    if (results->in_time) cpsi_csv_names(out, MOTION_COLUMN, MOTION_COLUMNS, NULL);
    fputs(",obstacle,trials,has_place,water\n1,,,", out);
    cpsi_csv_units(out, COLUMN, COLUMNS);
    if (results->in_time) cpsi_csv_units(out, MOTION_COLUMN, MOTION_COLUMNS);
    fputs(",,1,1,\n", out);
    for (int r = 0; r < results->row_count; ++r)
        for (int i = 0; i < results->point_count; ++i) write_row(out, results, &results->row[r], i);
}

static void write_body(FILE *out, const CpsResults *results, const CpsiRow *row, int body) {
    const CpsiBodyRow *of = &row->body[body];
    fprintf(out, "%d,", row->report.step_count - 1);
    cpsi_write_csv(out, row->name);
    fputc(',', out);
    cpsi_write_csv(out, results->body[body].name);
    fprintf(out, ",%s", cpsi_body_kind(of->report.kind));
    cpsi_csv_values(out, BODY_COLUMN, BODY_COLUMNS, of);
    if (results->in_time) cpsi_csv_values(out, BODY_MOTION_COLUMN, BODY_MOTION_COLUMNS, of);
    fprintf(out, ",%d,%d,%d\n", of->report.trial_count, (int)of->report.is_stable,
            (int)of->report.has_place);
}

void cpsi_bodies_write(const CpsResults *results, FILE *out) {
    fputs("step,name,body,kind", out);
    cpsi_csv_names(out, BODY_COLUMN, BODY_COLUMNS, NULL);
    if (results->in_time) cpsi_csv_names(out, BODY_MOTION_COLUMN, BODY_MOTION_COLUMNS, NULL);
    fputs(",trials,stable,has_place\n1,,,", out);
    cpsi_csv_units(out, BODY_COLUMN, BODY_COLUMNS);
    if (results->in_time) cpsi_csv_units(out, BODY_MOTION_COLUMN, BODY_MOTION_COLUMNS);
    fputs(",1,1,1\n", out);
    for (int r = 0; r < results->row_count; ++r)
        for (int i = 0; i < results->body_count; ++i) write_body(out, results, &results->row[r], i);
}
