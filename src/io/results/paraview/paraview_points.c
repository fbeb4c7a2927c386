/* SPDX-License-Identifier: BSD-3-Clause */
/* Points and bodies for ParaView, in text: step-N-points.vtp after each step of a scene that has
 * any. Points and the bodies' reference points are vertices; the axes of a body, half as long as
 * its farthest point is away, and the ways from its reference point to the points on it are
 * lines. */
#include <math.h>

#include "base/rotation.h"
#include "io/results/writers.h"

enum { AXES = 3 };

/* What a cell is: CellData "part". */
typedef enum Part { PART_POINT, PART_BODY, PART_X, PART_Y, PART_Z, PART_TO_POINT } Part;

static const CpsiRow *last_row(const CpsResults *results) {
    return &results->row[results->row_count - 1];
}

static Vec3 place_of(const CpsResults *results, const double position[3]) {
    return vec3_sub(vec3_load(position), vec3_load(results->origin));
}

/* [m] The length of a body's axes. */
static double axis_length(const CpsResults *results, int body) {
    double most = 0;
    for (int i = 0; i < results->point_count; ++i)
        if (results->point[i].kind == CPS_POINT_KIND_ON_BODY && results->point[i].body == body)
            most = fmax(most, vec3_norm(vec3_load(results->point[i].position)));
    return most > 0 ? 0.5 * most : 1;
}

static void write_row(FILE *out, Vec3 x) { fprintf(out, "%.17g %.17g %.17g\n", x.x, x.y, x.z); }

/* All points, then of each body its reference point and the tips of its axes. */
static void write_places(const CpsResults *results, FILE *out) {
    static const Vec3 ALONG[AXES] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const CpsiRow *row = last_row(results);
    for (int i = 0; i < results->point_count; ++i)
        write_row(out, place_of(results, row->point[i].report.position));
    for (int i = 0; i < results->body_count; ++i) {
        const CpsBodyReport *report = &row->body[i].report;
        const Vec3 at = place_of(results, report->position);
        write_row(out, at);
        for (int a = 0; a < AXES; ++a) {
            const Vec3 axis = rotation_apply(rotation_load(report->rotation), ALONG[a]);
            write_row(out, vec3_axpy(axis_length(results, i), axis, at));
        }
    }
}

/* [N] At each of them: the lines' force, 0 at tips. */
static void write_forces(const CpsResults *results, FILE *out) {
    const CpsiRow *row = last_row(results);
    for (int i = 0; i < results->point_count; ++i)
        write_row(out, vec3_load(row->point[i].report.lines));
    for (int i = 0; i < results->body_count; ++i) {
        write_row(out, vec3_load(row->body[i].report.lines));
        for (int a = 0; a < AXES; ++a) write_row(out, vec3(0, 0, 0));
    }
}

/* The place of a body's reference point among the rows. */
static int row_of(const CpsResults *results, int body) {
    return results->point_count + (AXES + 1) * body;
}

static int line_count(const CpsResults *results) {
    int count = AXES * results->body_count;
    for (int i = 0; i < results->point_count; ++i)
        count += results->point[i].kind == CPS_POINT_KIND_ON_BODY;
    return count;
}

typedef enum CellData { CONNECTIVITY, OFFSETS, PART, INDEX } CellData;

/* Vertices: `index` is that of the point or body in the scene. */
static void write_verts(const CpsResults *results, CellData what, FILE *out) {
    for (int i = 0; i < results->point_count + results->body_count; ++i) {
        const int body = i - results->point_count;
        const int value[] = {[CONNECTIVITY] = body < 0 ? i : row_of(results, body),
                             [OFFSETS] = i + 1,
                             [PART] = body < 0 ? PART_POINT : PART_BODY,
                             [INDEX] = body < 0 ? i : body};
        fprintf(out, "%d\n", value[what]);
    }
}

/* Lines: `index` is that of the body. */
static void write_lines(const CpsResults *results, CellData what, FILE *out) {
    int lines = 0;
    for (int body = 0; body < results->body_count; ++body) {
        const int from = row_of(results, body);
        for (int k = -AXES; k < results->point_count; ++k) {
            const bool is_axis = k < 0;
            if (!is_axis && (results->point[k].kind != CPS_POINT_KIND_ON_BODY ||
                             results->point[k].body != body))
                continue;
            if (what == CONNECTIVITY)
                fprintf(out, "%d %d\n", from, is_axis ? from + 1 + AXES + k : k);
            if (what == OFFSETS) fprintf(out, "%d\n", 2 * ++lines);
            if (what == PART) fprintf(out, "%d\n", is_axis ? PART_X + AXES + k : PART_TO_POINT);
            if (what == INDEX) fprintf(out, "%d\n", body);
        }
    }
}

static void begin_array(const char *type, const char *name, FILE *out) {
    fprintf(out, "        <DataArray type=\"%s\" Name=\"%s\" format=\"ascii\">\n", type, name);
}

static void write_cells(const CpsResults *results, const char *what,
                        void (*write)(const CpsResults *results, CellData what, FILE *out),
                        FILE *out) {
    fprintf(out, "      <%s>\n", what);
    begin_array("Int64", "connectivity", out);
    write(results, CONNECTIVITY, out);
    fputs("        </DataArray>\n", out);
    begin_array("Int64", "offsets", out);
    write(results, OFFSETS, out);
    fprintf(out, "        </DataArray>\n      </%s>\n", what);
}

static void write_data(const CpsResults *results, const char *name, CellData what, FILE *out) {
    begin_array("Int32", name, out);
    write_verts(results, what, out);
    write_lines(results, what, out);
    fputs("        </DataArray>\n", out);
}

CpsStatus cpsi_paraview_points(CpsResults *results, CpsError *err) {
    if (results->point_count == 0) return CPS_OK;
    char name[32];
    FILE *out = NULL;
    snprintf(name, sizeof name, "step-%05d-points.vtp", results->row_count - 1);
    const CpsStatus status = cpsi_directory_create(results->directory, name, &out, err);
    if (status) return status;
    fprintf(out,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
            "byte_order=\"LittleEndian\">\n"
            "  <PolyData>\n    <Piece NumberOfPoints=\"%d\" NumberOfVerts=\"%d\" "
            "NumberOfLines=\"%d\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n      <Points>\n"
            "        <DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
            "format=\"ascii\">\n",
            row_of(results, results->body_count), results->point_count + results->body_count,
            line_count(results));
    write_places(results, out);
    fputs("        </DataArray>\n      </Points>\n", out);
    write_cells(results, "Verts", write_verts, out);
    write_cells(results, "Lines", write_lines, out);
    fputs("      <PointData Vectors=\"lines_N\">\n"
          "        <DataArray type=\"Float64\" Name=\"lines_N\" NumberOfComponents=\"3\" "
          "format=\"ascii\">\n",
          out);
    write_forces(results, out);
    fputs("        </DataArray>\n      </PointData>\n      <CellData Scalars=\"part\">\n", out);
    write_data(results, "part", PART, out);
    write_data(results, "index", INDEX, out);
    fputs("      </CellData>\n    </Piece>\n  </PolyData>\n</VTKFile>\n", out);
    return cpsi_directory_close_file(results->directory, out, err);
}
