/* SPDX-License-Identifier: BSD-3-Clause */
/* `planimeter:`, `rope:` and `sweep:` of a file of driven systems, which follow a curve or a
 * path. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "capstan/io.h"
#include "io/base/file/read_file.h"
#include "io/base/file/text_rows.h"
#include "io/read/drive/drive_file.h"
#include "io/read/drive/path_points.h"
#include "io/read/key_reader.h"

/* ---- planimeter ---- */

static CpsStatus build_circle(const CpsiDocument *d, const CpsiCircleValues *circle,
                              CpsDrivePlanimeter *out) {
    double *x = CPSI_POOL_TAKE(d->pool, 2 * (size_t)circle->points, double);
    if (!x) return cpsi_document_no_memory(d);
    for (int i = 0; i < circle->points; i++) {
        const double a = 2 * CPSI_PI * i / circle->points;
        x[2 * i] = circle->centre[0] + circle->radius * cos(a);
        x[2 * i + 1] = circle->centre[1] + circle->radius * sin(a);
    }
    out->point_count = circle->points;
    out->point = x;
    return CPS_OK;
}

/* "x, y" per line; the first line may have names */
static CpsStatus parse_rows(const CpsiDocument *d, const char *name, CpsiTextRows *rows,
                            CpsDrivePlanimeter *out) {
    double *x = CPSI_POOL_TAKE(d->pool, 2 * rows->lines, double);
    if (!x) return cpsi_document_no_memory(d);
    int count = 0;
    for (const char *text, *rest; (text = cpsi_text_rows_next(rows));) {
        const int numbers = cps_row_read(text, " ,;", 2, x + 2 * (size_t)count, &rest);
        if (rows->line == 1 && !strchr("+-.0123456789", text[strspn(text, " \t\r")])) continue;
        if (numbers < 2 || *rest)
            return cpsi_fail_at(
                d->err, CPS_ERR_INPUT, name, rows->line, 1,
                "found something else, expected two numbers x, y (in m) in each line");
        count++;
    }
    if (count < 3)
        return cpsi_fail_at(d->err, CPS_ERR_INPUT, name, 0, 0,
                            "found %d points, expected at least 3", count);
    out->point_count = count;
    out->point = x;
    return CPS_OK;
}

static CpsStatus read_curve_file(const CpsiDocument *d, const CpsiCurveValues *curve,
                                 CpsDrivePlanimeter *out) {
    if (!cpsi_is_beside(curve->file))
        return cpsi_document_wrong(d, cpsi_yaml_child(curve->node, "file"), "'file'",
                                   "the name of a file beside this one, without '/'");
    char *name = cpsi_path_beside(d->pool, d->path, curve->file);
    if (!name) return cpsi_document_no_memory(d);
    CpsiTextRows rows;
    CpsStatus status = cpsi_text_rows_open(&rows, name, d->limits->max_bytes, d->err);
    if (status == CPS_OK) status = parse_rows(d, name, &rows, out);
    free(rows.bytes);
    return status;
}

static CpsStatus build_curve(const CpsiDocument *d, const CpsiCurveValues *curve,
                             CpsDrivePlanimeter *out) {
    if (curve->file) return read_curve_file(d, curve, out);
    if (curve->circle.node) return build_circle(d, &curve->circle, out);
    out->point_count = curve->points.rows;
    out->point = curve->points.x;
    return CPS_OK;
}

CpsStatus cpsi_build_planimeter(CpsiSetBuild *b, const CpsiPlanimeterValues *values,
                                CpsDrivePlanimeter *out) {
    const CpsiDocument *d = b->d;
    out->planimeter = values->planimeter;
    out->step_count = values->steps;
    CpsStatus status = build_curve(d, &values->curve, out);
    if (status == CPS_OK && (double)out->point_count * out->step_count > 1e8)
        return cpsi_document_fail(d, CPS_ERR_INPUT, values->node,
                                  "planimeter: more than 1e8 steps in all");

    /* a curve out of reach is reported here, with its position */
    CpsError found;
    if (status == CPS_OK &&
        cps_planimeter_check(&out->planimeter, out->point_count, out->point, &found) != CPS_OK)
        status = cpsi_document_place(d, cpsi_yaml_child(values->node, "curve"), &found);
    return status;
}

/* ---- rope ---- */

static CpsStatus build_shape(const CpsiDocument *d, const CpsiRopeShapeValues *shape, int elements,
                             CpsDriveRope *out) {
    const int nodes = elements + 1;
    const double *from = shape->straight.from, *to = shape->straight.to;
    const double straight[4] = {from[0], from[1], to[0], to[1]};
    double *x = CPSI_POOL_TAKE(d->pool, 2 * (size_t)nodes, double);
    if (!x) return cpsi_document_no_memory(d);
    out->rope.node_count = nodes;
    out->rope.node = x;
    if (shape->arc.node)
        cpsi_arc_points(shape->arc.from, shape->arc.centre, shape->arc.angle, nodes - 1, x);
    else if (shape->straight.node)
        cps_drive_walk(2, 2, straight, nodes, x);
    else
        cps_drive_walk(2, shape->polyline.rows, shape->polyline.x, nodes, x);
    return CPS_OK;
}

/* {A: held, B: [vx, vy]} */
static void build_ends(const CpsiRopeValues *values, CpsDriveRope *out) {
    int rows = 0;
    for (int k = 0; k < 2; k++) {
        const bool moved = !isnan(values->velocity[k][0]);
        out->rope.driven[k] = moved || values->end[k] == CPSI_ROPE_END_HELD;
        if (moved) memcpy(out->driving + 2 * rows, values->velocity[k], sizeof values->velocity[k]);
        rows += out->rope.driven[k];
    }
}

CpsStatus cpsi_build_rope(CpsiSetBuild *b, const CpsiRopeValues *values, CpsDriveRope *out) {
    const CpsiYaml *path = cpsi_yaml_child(values->node, "path");
    out->rope = cps_rope_default();
    out->friction = values->friction;
    out->weight = values->weight;
    out->step_count = values->steps;
    out->shot_count = values->shots;
    out->rope.slack = values->slack;
    out->rope.resistance = out->friction * out->weight;
    CpsStatus status = build_shape(b->d, &values->shape, values->elements, out);
    build_ends(values, out);
    if (status == CPS_OK && path && !out->rope.driven[1])
        return cpsi_document_fail(
            b->d, CPS_ERR_INPUT, path,
            "'path': end B is free, expected it held or driven: the path is its "
            "path");
    if (status == CPS_OK && path)
        status =
            cpsi_build_path(b->d, &values->path, 2, out->rope.node + 2 * (size_t)values->elements,
                            out->step_count, &out->point_count, &out->path);

    /* a shape that the library rejects (nodes at one position) is reported here, with its
     * position */
    CpsError found;
    if (status == CPS_OK && cps_rope_check(&out->rope, &found) != CPS_OK)
        status = cpsi_document_place(b->d, values->shape.node, &found);
    return status;
}

/* ---- sweep ---- */

CpsStatus cpsi_build_sweep(CpsiSetBuild *b, const CpsiSweepValues *values, CpsDriveSweep *out) {
    CpsLaw *law = NULL;
    out->start = cps_sweep_default();
    out->start.stiffness = values->stiffness;
    out->step_count = values->steps;
    CpsStatus status = cpsi_build_law(b, values->law, &law);
    out->law = law;
    if (status != CPS_OK) return status;
    out->space = cps_law_space(law);
    if (out->space > 2)
        return cpsi_document_fail(b->d, CPS_ERR_INPUT, cpsi_yaml_child(values->node, "law"),
                                  "'law': found more than 2 components, expected 1 or 2");
    const size_t size = (size_t)out->space * sizeof(double);
    const CpsiNumberRows *position = &values->position, *end = &values->end;
    if (position->node) status = cpsi_expect_components(b->d, position, "'position'", out->space);
    if (status == CPS_OK && end->node)
        status = cpsi_expect_components(b->d, end, "'end'", out->space);
    if (status != CPS_OK) return status;
    if (position->node) memcpy(out->start.position, position->x, size);
    memcpy(out->start.end, end->node ? end->x : out->start.position, size);
    return cpsi_build_path(b->d, &values->path, out->space, out->start.end, out->step_count,
                           &out->point_count, &out->path);
}
