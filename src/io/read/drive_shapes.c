/* SPDX-License-Identifier: BSD-3-Clause */
/* `planimeter:`, `rope:` and `sweep:` of a file of driven systems: what follows a curve or a path. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "io/read/drive_file.h"
#include "io/read/path_points.h"
#include "io/base/read_file.h"

static CpsStatus fail_node(CpsiDriveRead *r, const CpsiYaml *node, const char *message) {
    const CpsiLawFile *f = &r->build.file;
    return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column, "%s", message);
}

/* ---- planimeter ---- */

static CpsStatus read_circle(CpsiDriveRead *r, const CpsiYaml *node, CpsDrivePlanimeter *out) {
    CpsiCircleKeys circle = {.points = 0};
    CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_CIRCLE, &circle);
    if (status != CPS_OK) return status;
    const int points = circle.points;
    if (points < 3) return cpsi_drive_wrong(r, node, "'circle'", "at least 3 points");
    double *x = CPSI_POOL_TAKE(r->build.file.pool, 2 * (size_t)points, double);
    if (!x) return cpsi_drive_no_memory(r);
    for (int i = 0; i < points; i++) {
        x[2 * i] = circle.center[0] + circle.radius * cos(2 * CPSI_PI * i / points);
        x[2 * i + 1] = circle.center[1] + circle.radius * sin(2 * CPSI_PI * i / points);
    }
    out->points = points, out->point = x;
    return CPS_OK;
}

/* "x, y" per line; blank lines, comments and one line of names are passed over */
static CpsStatus parse_rows(CpsiDriveRead *r, const char *name, char *bytes, CpsDrivePlanimeter *out) {
    const CpsiLawFile *f = &r->build.file;
    size_t lines = 1;
    for (const char *c = bytes; *c; c++) lines += *c == '\n';
    double *x = CPSI_POOL_TAKE(f->pool, 2 * lines, double);
    if (!x) return cpsi_drive_no_memory(r);
    int count = 0, line = 0;
    for (char *text = bytes, *next; text; text = next) {
        line++;
        if ((next = strchr(text, '\n'))) *next++ = '\0';
        text += strspn(text, " \t\r");
        if (!*text || *text == '#') continue;
        char *end, *last;
        double *row = x + 2 * (size_t)count;
        row[0] = strtod(text, &end);
        const bool number = end != text;
        end += strspn(end, " \t,;");
        row[1] = strtod(end, &last);
        const bool whole = number && last != end && last[strspn(last, " \t\r")] == '\0';
        if (!number && count == 0 && line == 1) continue;
        if (!whole || !(fabs(row[0]) <= 1e100) || !(fabs(row[1]) <= 1e100))
            return cpsi_fail_at(f->err, CPS_ERR_INPUT, name, line, 1,
                                "found something else, expected two numbers x, y (in m) in each line");
        count++;
    }
    if (count < 3)
        return cpsi_fail_at(f->err, CPS_ERR_INPUT, name, 0, 0, "found %d points, expected at least 3", count);
    out->points = count, out->point = x;
    return CPS_OK;
}

static CpsStatus read_curve_file(CpsiDriveRead *r, const CpsiYaml *node, CpsDrivePlanimeter *out) {
    if (node->kind != CPSI_YAML_SCALAR || !*node->text)
        return cpsi_drive_wrong(r, node, "'file'", "the name of a file");
    if (!cpsi_is_beside(node->text))
        return cpsi_drive_wrong(r, node, "'file'", "the name of a file beside this one, without '/'");
    char *name = cpsi_path_beside(r->build.file.pool, r->path, node->text), *bytes = NULL;
    size_t size = 0;
    if (!name) return cpsi_drive_no_memory(r);
    CpsStatus status = cpsi_read_file_itself(name, r->max_bytes, &bytes, &size, r->build.file.err);
    if (status == CPS_OK && strlen(bytes) != size)
        status = cpsi_fail_at(r->build.file.err, CPS_ERR_INPUT, name, 0, 0, "found a zero byte: is this text?");
    if (status == CPS_OK) status = parse_rows(r, name, bytes, out);
    free(bytes);
    return status;
}

static CpsStatus read_curve(CpsiDriveRead *r, const CpsiYaml *node, CpsDrivePlanimeter *out) {
    if (node->kind != CPSI_YAML_MAPPING) return cpsi_drive_rows(r, node, "'curve'", 2, 3, &out->points, &out->point);
    CpsiCurveKeys keys = {.circle = NULL};
    const CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_CURVE, &keys);
    if (status != CPS_OK) return status;
    if (!keys.circle == !keys.file) return cpsi_drive_wrong(r, node, "'curve'", "a list of points, {circle: ..} or {file: ..}");
    return keys.circle ? read_circle(r, keys.circle, out) : read_curve_file(r, keys.file, out);
}

CpsStatus cpsi_drive_read_planimeter(CpsiDriveRead *r, const CpsiYaml *node, CpsDrivePlanimeter *out) {
    CpsiPlanimeterKeys keys = {.steps = 1};
    CpsPlanimeter *p = &out->planimeter;
    CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_PLANIMETER, &keys);
    *p = keys.planimeter, out->steps = keys.steps;
    if (status == CPS_OK) status = read_curve(r, keys.curve, out);
    if (status == CPS_OK && (double)out->points * out->steps > 1e8)
        return fail_node(r, node, "planimeter: more than 1e8 steps in all");

    /* a curve out of reach is refused here, with its place */
    CpsPlanimeterReading unused;
    CpsError found;
    if (status == CPS_OK && cps_planimeter_trace(p, out->points, out->point, 1, &unused, &found) != CPS_OK)
        status = cpsi_drive_place(r, keys.curve, &found);
    return status;
}

/* ---- rope ---- */

static CpsStatus arc_shape(CpsiDriveRead *r, const CpsiYaml *node, int nodes, double *x) {
    CpsiArcKeys arc = {.radius = 0};
    const CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_ARC, &arc);
    for (int i = 0; i < nodes; i++) {
        const double a = arc.from + arc.turn * i / (nodes - 1);
        x[2 * i] = arc.center[0] + arc.radius * cos(a), x[2 * i + 1] = arc.center[1] + arc.radius * sin(a);
    }
    return status;
}

static CpsStatus straight_shape(CpsiDriveRead *r, const CpsiYaml *node, int nodes, double *x) {
    CpsiStraightKeys keys = {.from = {0}};
    const CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_STRAIGHT, &keys);
    const double end[4] = {keys.from[0], keys.from[1], keys.to[0], keys.to[1]};
    if (status == CPS_OK) cps_drive_walk(2, 2, end, nodes, x);
    return status;
}

static CpsStatus read_shape(CpsiDriveRead *r, const CpsiYaml *node, int elements, CpsDriveRope *out) {
    CpsiShapeKeys keys = {.straight = NULL};
    CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_SHAPE, &keys);
    if (status != CPS_OK) return status;
    if ((keys.straight != NULL) + (keys.arc != NULL) + (keys.points != NULL) != 1)
        return cpsi_drive_wrong(r, node, "'shape'", "exactly one of 'straight', 'arc', 'points'");
    const int nodes = elements + 1;
    double *x = CPSI_POOL_TAKE(r->build.file.pool, 2 * (size_t)nodes, double);
    if (!x) return cpsi_drive_no_memory(r);
    out->rope.nodes = nodes, out->rope.node = x;
    if (keys.straight) return straight_shape(r, keys.straight, nodes, x);
    if (keys.arc) return arc_shape(r, keys.arc, nodes, x);
    int count = 0;
    const double *given = NULL;
    status = cpsi_drive_rows(r, keys.points, "'points'", 2, 2, &count, &given);
    if (status == CPS_OK) cps_drive_walk(2, count, given, nodes, x);
    return status;
}

/* {A: held, B: [vx, vy]} */
static CpsStatus read_ends(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveRope *out) {
    CpsiEndsKeys keys = {.A = NULL};
    CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_ENDS, &keys);
    const CpsiYaml *const end[2] = {keys.A, keys.B};
    int rows = 0;
    for (int k = 0; k < 2 && status == CPS_OK; k++) {
        const bool word = end[k] && end[k]->kind == CPSI_YAML_SCALAR;
        if (!end[k] || (word && strcmp(end[k]->text, "free") == 0)) continue;
        out->rope.driven[k] = true;
        double *v = out->driving + 2 * rows++;
        if (word && strcmp(end[k]->text, "held") == 0) continue;
        if (end[k]->kind != CPSI_YAML_SEQUENCE)
            return cpsi_drive_wrong(r, end[k], k ? "'B'" : "'A'", "free, held, or a velocity [vx, vy]");
        status = cpsi_drive_point(r, end[k], k ? "'B'" : "'A'", 2, v);
    }
    return status;
}

CpsStatus cpsi_drive_read_rope(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveRope *out) {
    CpsiRopeKeys keys = {.elements = 100, .steps = 40, .shots = 6};
    CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_ROPE, &keys);
    const CpsiYaml *path = keys.path;
    out->friction = keys.friction, out->weight = keys.weight;
    out->steps = keys.steps, out->shots = keys.shots;
    out->rope.slack = keys.slack;
    if (status == CPS_OK) status = read_shape(r, keys.shape, keys.elements, out);
    out->rope.resistance = out->friction * out->weight;
    if (status == CPS_OK) status = read_ends(r, keys.ends, out);
    if (status == CPS_OK && path && !out->rope.driven[1])
        return fail_node(r, path, "'path': end B is free, expected it held or driven: the path is its path");
    if (status == CPS_OK && path)
        status = cpsi_drive_read_path(r, path, 2, out->rope.node + 2 * (size_t)keys.elements, out->steps, &out->points,
                                      &out->path);

    /* a shape that the library refuses (nodes at one place) is refused here, with its place */
    CpsError found;
    if (status == CPS_OK && cps_rope_check(&out->rope, &found) != CPS_OK) status = cpsi_drive_place(r, keys.shape, &found);
    return status;
}

/* ---- sweep ---- */

CpsStatus cpsi_drive_read_sweep(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveSweep *out) {
    CpsiSweepKeys keys = {.law = NULL};
    CpsStatus status = cpsi_drive_fields(r, node, CPSI_DRIVE_SWEEP, &keys);
    out->start.stiffness = keys.stiffness, out->steps = keys.steps;
    CpsLaw *own = NULL;
    if (status == CPS_OK) status = cpsi_drive_law(r, keys.law, &own);
    out->law = own;
    if (status != CPS_OK) return status;
    out->space = cps_law_space(own);
    if (out->space > 2) return fail_node(r, keys.law, "'law': found more than 2 components, expected 1 or 2");
    const CpsiYaml *const given[2] = {keys.position, keys.end};
    double *const start[2] = {out->start.position, out->start.end};
    for (int k = 0; k < 2 && status == CPS_OK; k++) {
        if (given[k]) status = cpsi_drive_point(r, given[k], k ? "'end'" : "'position'", out->space, start[k]);
    }
    if (status == CPS_OK && !keys.end) memcpy(out->start.end, out->start.position, sizeof out->start.end);
    return status ? status
                  : cpsi_drive_read_path(r, keys.path, out->space, out->start.end, out->steps, &out->points, &out->path);
}
