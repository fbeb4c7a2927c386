/* SPDX-License-Identifier: BSD-3-Clause */
/* history.out: the history in time as a table with blanks between its columns, with names, units
 * and meanings of the output channels of MoorDyn 2 (its manual, "The V2 Input File", "Outputs"):
 * a row of names, a row of units, then a row per time. Objects have numbers from 1, in the order of
 * the scene; end A of a line is its anchor, end B its fairlead. */
#include <math.h>

#include "base/math.h"
#include "base/rotation.h"
#include "io/base/text/escape.h"
#include "io/results/writers.h"

/* A column of each object of a kind: LINE1NAPX is "LINE", 1, "NAPX". */
typedef struct Channel {
    const char *object, *quantity, *unit;
} Channel;

#define TRIPLE(object, quantity, unit) \
    {object, quantity "X", unit}, {object, quantity "Y", unit}, { object, quantity "Z", unit }

static const Channel LINE_CHANNEL[] = {{"FAIRTEN", "", "(N)"},       {"ANCHTEN", "", "(N)"},
                                       TRIPLE("LINE", "NAP", "(m)"), TRIPLE("LINE", "NAF", "(N)"),
                                       TRIPLE("LINE", "NBP", "(m)"), TRIPLE("LINE", "NBF", "(N)")};

static const Channel POINT_CHANNEL[] = {TRIPLE("POINT", "P", "(m)")};

static const Channel BODY_CHANNEL[] = {TRIPLE("BODY", "P", "(m)"), TRIPLE("BODY", "R", "(deg)"),
                                       TRIPLE("BODY", "V", "(m/s)"),
                                       TRIPLE("BODY", "RV", "(deg/s)")};

enum {
    LINE_CHANNELS = sizeof LINE_CHANNEL / sizeof *LINE_CHANNEL,
    POINT_CHANNELS = sizeof POINT_CHANNEL / sizeof *POINT_CHANNEL,
    BODY_CHANNELS = sizeof BODY_CHANNEL / sizeof *BODY_CHANNEL,
    WIDTH = 25 /* of a column; a double takes 24 characters at most */
};

static void line_values(const CpsLineReport *report, double out[LINE_CHANNELS]) {
    out[0] = report->end[CPS_END_B].tension;
    out[1] = report->end[CPS_END_A].tension;
    for (int e = 0; e < 2; ++e)
        for (int a = 0; a < 3; ++a) {
            out[2 + 6 * e + a] = report->end[e].position[a];
            /* of the line on what holds its end */
            out[5 + 6 * e + a] = 0 - report->end[e].force[a];
        }
}

static void point_values(const CpsPointReport *report, double out[POINT_CHANNELS]) {
    for (int a = 0; a < 3; ++a) out[a] = report->position[a];
}

/* [degrees] The angles of MoorDyn: a turn about x, then about the y axis so turned, then about the
 * z axis so turned. With the images x', y', z' of the axes, z' = (sin b, -sin a cos b, cos a cos b)
 * and the x components of x' and y' are cos b cos c and -cos b sin c. */
static void body_angles(const double quaternion[4], double out[3]) {
    const Rotation r = rotation_load(quaternion);
    const Vec3 x = rotation_apply(r, vec3(1, 0, 0)), y = rotation_apply(r, vec3(0, 1, 0)),
               z = rotation_apply(r, vec3(0, 0, 1));
    out[0] = atan2(0 - z.y, z.z) / CPSI_DEGREE;
    out[1] = atan2(z.x, hypot(z.y, z.z)) / CPSI_DEGREE;
    out[2] = atan2(0 - y.x, x.x) / CPSI_DEGREE;
}

static void body_values(const CpsiBodyRow *body, double out[BODY_CHANNELS]) {
    body_angles(body->report.rotation, out + 3);
    for (int a = 0; a < 3; ++a) {
        out[a] = body->report.position[a];
        out[6 + a] = body->motion.velocity[a];
        out[9 + a] = body->motion.turn_rate[a] / CPSI_DEGREE;
    }
}

static void write_heads(FILE *out, const Channel *channel, int count, int objects, bool units) {
    for (int i = 0; i < objects; ++i)
        for (int k = 0; k < count; ++k) {
            char name[WIDTH + 1];
            snprintf(name, sizeof name, "%s%d%s", channel[k].object, i + 1, channel[k].quantity);
            fprintf(out, "%*s", WIDTH, units ? channel[k].unit : name);
        }
}

static void write_head_row(FILE *out, const CpsResults *results, bool units) {
    fprintf(out, "%*s", WIDTH, units ? "(s)" : "Time");
    write_heads(out, LINE_CHANNEL, LINE_CHANNELS, cpsi_listed_lines(results), units);
    write_heads(out, POINT_CHANNEL, POINT_CHANNELS, results->point_count, units);
    write_heads(out, BODY_CHANNEL, BODY_CHANNELS, results->body_count, units);
    fputc('\n', out);
}

static void write_values(FILE *out, const double *value, int count) {
    for (int i = 0; i < count; ++i) {
        char text[CPSI_NUMBER_SIZE];
        fprintf(out, "%*s", WIDTH, isfinite(value[i]) ? cpsi_number(text, value[i]) : "NaN");
    }
}

static void write_row(FILE *out, const CpsResults *results, const CpsiRow *row) {
    double line[LINE_CHANNELS], point[POINT_CHANNELS], body[BODY_CHANNELS];
    write_values(out, &row->motion.time, 1);
    for (int l = 0; l < cpsi_listed_lines(results); ++l) {
        line_values(&row->line[l].report, line);
        write_values(out, line, LINE_CHANNELS);
    }
    for (int i = 0; i < results->point_count; ++i) {
        point_values(&row->point[i].report, point);
        write_values(out, point, POINT_CHANNELS);
    }
    for (int i = 0; i < results->body_count; ++i) {
        body_values(&row->body[i], body);
        write_values(out, body, BODY_CHANNELS);
    }
    fputc('\n', out);
}

/* Times increase from row to row: of steps at the same time, which are quasi-static, the last. */
static bool is_last_at_its_time(const CpsResults *results, int row) {
    return row + 1 == results->row_count ||
           results->row[row + 1].motion.time > results->row[row].motion.time;
}

void cpsi_out_table_write(const CpsResults *results, FILE *out) {
    write_head_row(out, results, false);
    write_head_row(out, results, true);
    for (int r = 0; r < results->row_count; ++r)
        if (is_last_at_its_time(results, r)) write_row(out, results, &results->row[r]);
}
