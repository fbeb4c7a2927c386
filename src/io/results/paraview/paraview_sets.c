/* SPDX-License-Identifier: BSD-3-Clause */
/* Sets to which ends of lines are held, for ParaView, in text: sets.vtp with their outlines. */
#include "io/results/writers.h"

typedef enum CellData { POINTS, CONNECTIVITY, OFFSETS, LINE_ID } CellData;

/* The corners of a polyline, or their numbers from `first` on. */
static void write_corners(CellData what, const Vec3 *x, int count, int first, FILE *out) {
    for (int i = 0; i < count; ++i) {
        if (what == POINTS) fprintf(out, "%.17g %.17g %.17g\n", x[i].x, x[i].y, x[i].z);
        if (what == CONNECTIVITY) fprintf(out, "%d\n", first + i);
    }
}

/* Write one kind of numbers of all outlines; returns the number of points, and of polylines. */
static void write_all(const CpsResults *results, CellData what, FILE *out, int *points,
                      int *lines) {
    CpsiOutlineWalk walk = {.reach = 0};
    *points = *lines = 0;
    while (cpsi_next_outline(results, &walk)) {
        if (out) write_corners(what, walk.x, walk.count, *points, out);
        *points += walk.count;
        ++*lines;
        if (out && what == OFFSETS) fprintf(out, "%d\n", *points);
        if (out && what == LINE_ID) fprintf(out, "%d\n", walk.line);
    }
}

CpsStatus cpsi_paraview_sets(CpsResults *results, CpsError *err) {
    FILE *out = NULL;
    int points, lines;
    if (!results->draws_sets || results->row_count == 0) return CPS_OK;
    const CpsStatus status = cpsi_directory_create(results->directory, "sets.vtp", &out, err);
    if (status) return status;
    write_all(results, POINTS, NULL, &points, &lines);
    fprintf(out,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
            "byte_order=\"LittleEndian\">\n"
            "  <PolyData>\n    <Piece NumberOfPoints=\"%d\" NumberOfVerts=\"0\" "
            "NumberOfLines=\"%d\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n      <Points>\n"
            "        <DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
            "format=\"ascii\">\n",
            points, lines);
    write_all(results, POINTS, out, &points, &lines);
    fputs("        </DataArray>\n      </Points>\n      <Lines>\n"
          "        <DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n",
          out);
    write_all(results, CONNECTIVITY, out, &points, &lines);
    fputs("        </DataArray>\n"
          "        <DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n",
          out);
    write_all(results, OFFSETS, out, &points, &lines);
    fputs("        </DataArray>\n      </Lines>\n      <CellData Scalars=\"line\">\n"
          "        <DataArray type=\"Int32\" Name=\"line\" format=\"ascii\">\n",
          out);
    write_all(results, LINE_ID, out, &points, &lines);
    fputs("        </DataArray>\n      </CellData>\n    </Piece>\n  </PolyData>\n</VTKFile>\n",
          out);
    return cpsi_directory_close_file(results->directory, out, err);
}
