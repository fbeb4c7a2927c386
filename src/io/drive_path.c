/* SPDX-License-Identifier: BSD-3-Clause */
/* `planimeter:`, `rope:` and `sweep:` of a file of driven systems: what follows a curve or a path. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/drive_read.h"
#include "io/file_bytes.h"

static const double PI = 3.14159265358979323846;

static CpsStatus fail_node(CpsiDriveRead *r, const CpsiYaml *node, const char *message) {
    const CpsiLawFile *f = &r->build.file;
    return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column, "%s", message);
}

/* ---- planimeter ---- */

static CpsStatus read_circle(CpsiDriveRead *r, const CpsiYaml *node, CpsDrivePlanimeter *out) {
    double center[2] = {0, 0}, radius = 0;
    int points = 0;
    const CpsiField field[] = {
        {"center", CPSI_FIELD_POINT, center, true, -INFINITY, false, 2, "m"},
        {"radius", CPSI_FIELD_NUMBER, &radius, true, 0, true, 0, "m"},
        {"points", CPSI_FIELD_COUNT, &points, true, 0, false, CPSI_DRIVE_MOST_STEPS, "corners on it"},
    };
    CpsStatus status = cpsi_drive_fields(r, node, "'circle'", CPSI_FIELDS(field));
    if (status != CPS_OK) return status;
    if (points < 3) return cpsi_drive_wrong(r, node, "'circle'", "at least 3 points");
    double *x = CPSI_POOL_TAKE(r->build.file.pool, 2 * (size_t)points, double);
    if (!x) return cpsi_drive_no_memory(r);
    for (int i = 0; i < points; i++) {
        x[2 * i] = center[0] + radius * cos(2 * PI * i / points);
        x[2 * i + 1] = center[1] + radius * sin(2 * PI * i / points);
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
                                "found '%.60s', expected two numbers x, y (in m) in each line", text);
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
    const char *slash = strrchr(r->path, '/');
    const int folder = slash && *node->text != '/' ? (int)(slash + 1 - r->path) : 0;
    const size_t room = strlen(r->path) + strlen(node->text) + 1;
    char *name = CPSI_POOL_TAKE(r->build.file.pool, room, char), *bytes = NULL;
    size_t size = 0;
    if (!name) return cpsi_drive_no_memory(r);
    snprintf(name, room, "%.*s%s", folder, r->path, node->text);
    if (strcmp(name, "-") == 0) return cpsi_drive_wrong(r, node, "'file'", "a file, not standard input");
    CpsStatus status = cpsi_read_file(name, name, r->max_bytes, &bytes, &size, r->build.file.err);
    if (status == CPS_OK && strlen(bytes) != size)
        status = cpsi_fail_at(r->build.file.err, CPS_ERR_INPUT, name, 0, 0, "found a zero byte: is this text?");
    if (status == CPS_OK) status = parse_rows(r, name, bytes, out);
    free(bytes);
    return status;
}

static CpsStatus read_curve(CpsiDriveRead *r, const CpsiYaml *node, CpsDrivePlanimeter *out) {
    if (node->kind != CPSI_YAML_MAPPING) return cpsi_drive_rows(r, node, "'curve'", 2, 3, &out->points, &out->point);
    const CpsiYaml *circle = NULL, *file = NULL;
    const CpsiField field[] = {
        {"circle", CPSI_FIELD_NODE, &circle, false, 0, false, 0, ""},
        {"file", CPSI_FIELD_NODE, &file, false, 0, false, 0, ""},
    };
    const CpsStatus status = cpsi_drive_fields(r, node, "'curve'", CPSI_FIELDS(field));
    if (status != CPS_OK) return status;
    if (!circle == !file) return cpsi_drive_wrong(r, node, "'curve'", "a list of points, {circle: ..} or {file: ..}");
    return circle ? read_circle(r, circle, out) : read_curve_file(r, file, out);
}

CpsStatus cpsi_drive_read_planimeter(CpsiDriveRead *r, const CpsiYaml *node, CpsDrivePlanimeter *out) {
    const CpsiYaml *curve = NULL;
    CpsPlanimeter *p = &out->planimeter;
    out->steps = 1;
    const CpsiField field[] = {
        {"pole", CPSI_FIELD_POINT, p->pole, true, -INFINITY, false, 2, "where the pole is, m"},
        {"pole_arm", CPSI_FIELD_NUMBER, &p->pole_arm, true, 0, true, 0, "length, m"},
        {"tracer_arm", CPSI_FIELD_NUMBER, &p->tracer_arm, true, 0, true, 0, "length, m"},
        {"wheel", CPSI_FIELD_NUMBER, &p->wheel, true, -INFINITY, false, 0, "from the hinge towards the tracer, m"},
        {"friction", CPSI_FIELD_NUMBER, &p->friction, true, 0, true, 0,
         "coefficient of the wheel: what turns it is friction"},
        {"load", CPSI_FIELD_NUMBER, &p->load, true, 0, true, 0, "on the wheel, N"},
        {"left_elbow", CPSI_FIELD_FLAG, &p->left_elbow, false, 0, false, 0, ""},
        {"curve", CPSI_FIELD_NODE, &curve, true, 0, false, 0, "closed curve that the tracer follows"},
        {"steps", CPSI_FIELD_COUNT, &out->steps, false, 0, false, 10000, ""},
    };
    CpsStatus status = cpsi_drive_fields(r, node, "planimeter", CPSI_FIELDS(field));
    if (status == CPS_OK) status = read_curve(r, curve, out);
    if (status == CPS_OK && (double)out->points * out->steps > 1e8)
        return fail_node(r, node, "planimeter: more than 1e8 steps in all");

    /* a curve out of reach is refused here, with its place */
    CpsPlanimeterReading unused;
    CpsError found;
    if (status == CPS_OK && cps_planimeter_trace(p, out->points, out->point, 1, &unused, &found) != CPS_OK)
        status = cpsi_drive_place(r, curve, &found);
    return status;
}

/* ---- rope ---- */

static CpsStatus arc_shape(CpsiDriveRead *r, const CpsiYaml *node, int nodes, double *x) {
    double center[2] = {0, 0}, radius = 0, from = 0, turn = 0;
    const CpsiField field[] = {
        {"center", CPSI_FIELD_POINT, center, true, -INFINITY, false, 2, "m"},
        {"radius", CPSI_FIELD_NUMBER, &radius, true, 0, true, 0, "m"},
        {"from", CPSI_FIELD_NUMBER, &from, true, -INFINITY, false, 0, "angle of the first end, rad"},
        {"turn", CPSI_FIELD_NUMBER, &turn, true, -INFINITY, false, 0, "angle to the last end, rad, counterclockwise"},
    };
    const CpsStatus status = cpsi_drive_fields(r, node, "'arc'", CPSI_FIELDS(field));
    for (int i = 0; i < nodes; i++) {
        const double a = from + turn * i / (nodes - 1);
        x[2 * i] = center[0] + radius * cos(a), x[2 * i + 1] = center[1] + radius * sin(a);
    }
    return status;
}

static CpsStatus straight_shape(CpsiDriveRead *r, const CpsiYaml *node, int nodes, double *x) {
    double end[4] = {0, 0, 0, 0};
    const CpsiField field[] = {
        {"from", CPSI_FIELD_POINT, end, true, -INFINITY, false, 2, "first end, m"},
        {"to", CPSI_FIELD_POINT, end + 2, true, -INFINITY, false, 2, "last end, m"},
    };
    const CpsStatus status = cpsi_drive_fields(r, node, "'straight'", CPSI_FIELDS(field));
    if (status == CPS_OK) cps_drive_walk(2, 2, end, nodes, x);
    return status;
}

static CpsStatus read_shape(CpsiDriveRead *r, const CpsiYaml *node, int elements, CpsDriveRope *out) {
    const CpsiYaml *straight = NULL, *arc = NULL, *points = NULL;
    const CpsiField field[] = {
        {"straight", CPSI_FIELD_NODE, &straight, false, 0, false, 0, ""},
        {"arc", CPSI_FIELD_NODE, &arc, false, 0, false, 0, ""},
        {"points", CPSI_FIELD_NODE, &points, false, 0, false, 0, ""},
    };
    CpsStatus status = cpsi_drive_fields(r, node, "'shape'", CPSI_FIELDS(field));
    if (status != CPS_OK) return status;
    if ((straight != NULL) + (arc != NULL) + (points != NULL) != 1)
        return cpsi_drive_wrong(r, node, "'shape'", "exactly one of 'straight', 'arc', 'points'");
    const int nodes = elements + 1;
    double *x = CPSI_POOL_TAKE(r->build.file.pool, 2 * (size_t)nodes, double);
    if (!x) return cpsi_drive_no_memory(r);
    out->rope.nodes = nodes, out->rope.node = x;
    if (straight) return straight_shape(r, straight, nodes, x);
    if (arc) return arc_shape(r, arc, nodes, x);
    int count = 0;
    const double *given = NULL;
    status = cpsi_drive_rows(r, points, "'points'", 2, 2, &count, &given);
    if (status == CPS_OK) cps_drive_walk(2, count, given, nodes, x);
    return status;
}

/* {A: held, B: [vx, vy]} */
static CpsStatus read_ends(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveRope *out) {
    const CpsiYaml *end[2] = {NULL, NULL};
    const CpsiField field[] = {
        {"A", CPSI_FIELD_NODE, &end[0], false, 0, false, 0, ""},
        {"B", CPSI_FIELD_NODE, &end[1], true, 0, false, 0, "velocity [vx, vy] of the last end, m/s"},
    };
    CpsStatus status = cpsi_drive_fields(r, node, "'ends'", CPSI_FIELDS(field));
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
    const CpsiYaml *shape = NULL, *ends = NULL, *path = NULL;
    int elements = 100;
    out->steps = 40, out->shots = 6;
    const CpsiField field[] = {
        {"shape", CPSI_FIELD_NODE, &shape, true, 0, false, 0, "{straight: ..}, {arc: ..} or {points: ..}"},
        {"elements", CPSI_FIELD_COUNT, &elements, false, 0, false, CPSI_DRIVE_MOST_ELEMENTS, ""},
        {"friction", CPSI_FIELD_NUMBER, &out->friction, true, 0, true, 0, "coefficient"},
        {"weight", CPSI_FIELD_NUMBER, &out->weight, true, 0, true, 0, "N/m"},
        {"ends", CPSI_FIELD_NODE, &ends, true, 0, false, 0, "what the ends do, as in {A: held, B: [1, 0]}"},
        {"path", CPSI_FIELD_NODE, &path, false, 0, false, 0, ""},
        {"steps", CPSI_FIELD_COUNT, &out->steps, false, 0, false, 10000, ""},
        {"shots", CPSI_FIELD_COUNT, &out->shots, false, 0, false, 24, ""},
    };
    CpsStatus status = cpsi_drive_fields(r, node, "rope", CPSI_FIELDS(field));
    if (status == CPS_OK) status = read_shape(r, shape, elements, out);
    out->rope.resistance = out->friction * out->weight;
    if (status == CPS_OK) status = read_ends(r, ends, out);
    if (status == CPS_OK && path && !out->rope.driven[1])
        return fail_node(r, path, "'path': end B is free, expected it held or driven: the path is its path");
    if (status == CPS_OK && path)
        status = cpsi_drive_read_path(r, path, 2, out->rope.node + 2 * (size_t)elements, out->steps, &out->points,
                                      &out->path);

    /* a shape that the library refuses (nodes at one place) is refused here, with its place */
    CpsSystem *system = NULL;
    CpsError found;
    if (status == CPS_OK && cps_rope_system(&out->rope, &system, &found) != CPS_OK)
        status = cpsi_drive_place(r, shape, &found);
    cps_system_destroy(system);
    return status;
}

/* ---- sweep ---- */

CpsStatus cpsi_drive_read_sweep(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveSweep *out) {
    const CpsiYaml *law = NULL, *position = NULL, *end = NULL, *path = NULL;
    const CpsiField field[] = {
        {"law", CPSI_FIELD_NODE, &law, true, 0, false, 0, "friction law of the block, 1 or 2 components"},
        {"stiffness", CPSI_FIELD_NUMBER, &out->start.stiffness, true, 0, true, 0, "of the spring, N/m"},
        {"position", CPSI_FIELD_NODE, &position, false, 0, false, 0, ""},
        {"end", CPSI_FIELD_NODE, &end, false, 0, false, 0, ""},
        {"path", CPSI_FIELD_NODE, &path, true, 0, false, 0, "points that the spring's far end passes"},
        {"steps", CPSI_FIELD_COUNT, &out->steps, true, 0, false, CPSI_DRIVE_MOST_STEPS, "equal steps along the path"},
    };
    CpsStatus status = cpsi_drive_fields(r, node, "sweep", CPSI_FIELDS(field));
    CpsLaw *own = NULL;
    if (status == CPS_OK) status = cpsi_drive_law(r, law, &own);
    out->law = own;
    if (status != CPS_OK) return status;
    out->space = cps_law_space(own);
    if (out->space > 2) return fail_node(r, law, "'law': found more than 2 components, expected 1 or 2");
    const CpsiYaml *const given[2] = {position, end};
    double *const to[2] = {out->start.position, out->start.end};
    for (int k = 0; k < 2 && status == CPS_OK; k++) {
        if (given[k]) status = cpsi_drive_point(r, given[k], k ? "'end'" : "'position'", out->space, to[k]);
    }
    if (status == CPS_OK && !end) memcpy(out->start.end, out->start.position, sizeof out->start.end);
    return status ? status
                  : cpsi_drive_read_path(r, path, out->space, out->start.end, out->steps, &out->points, &out->path);
}
