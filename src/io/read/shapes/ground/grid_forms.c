/* SPDX-License-Identifier: BSD-3-Clause */
/* The forms of text of a grid (grid_file.h): ESRI ASCII grid, points, and the two of MoorDyn. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "io/base/file/read_file.h"
#include "io/base/yaml/yaml.h"
#include "io/read/shapes/ground/grid_parts.h"

/* ---- ESRI ASCII grid ---- */

enum { NCOLS, NROWS, XLL, YLL, CELL, NODATA, KEYS };

typedef struct Header {
    double value[KEYS];
    bool has[KEYS], centre[2]; /* centre: of the corner cell, not its corner */
} Header;

static int key_of(const CpsiGridText *text, Header *header) {
    static const char *const NAME[KEYS] = {"ncols",     "nrows",    "xllcorner",
                                           "yllcorner", "cellsize", "nodata_value"};
    for (int k = 0; k < KEYS; k++)
        if (cpsi_grid_is_word(text, NAME[k])) return k;
    for (int a = 0; a < 2; a++)
        if (cpsi_grid_is_word(text, a ? "yllcenter" : "xllcenter")) {
            header->centre[a] = true;
            return XLL + a;
        }
    return -1;
}

static CpsStatus read_header(CpsiGridText *text, Header *header) {
    static const char KNOWN[] = "ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, "
                                "cellsize, nodata_value";
    int count;
    for (;;) {
        const CpsiGridText before = *text;
        double first;
        if (!cpsi_grid_word(text) || cpsi_grid_is_number(text, &first)) {
            *text = before; /* the first of the heights */
            break;
        }
        const int k = key_of(text, header);
        if (k < 0)
            return cpsi_grid_fail(text, "found '%.*s', expected one of %s",
                                  (int)(text->length < 40 ? text->length : 40), text->word, KNOWN);
        if (header->has[k]) return cpsi_grid_fail(text, "this is given twice");
        header->has[k] = true;
        CpsStatus status;
        if (k == NCOLS || k == NROWS) {
            status = cpsi_grid_count(text, k == NCOLS ? "ncols" : "nrows", &count);
            if (status == CPS_OK) header->value[k] = count;
        } else {
            status = cpsi_grid_number(text, "a number of the header", &header->value[k]);
        }
        if (status != CPS_OK) return status;
    }
    for (int k = NCOLS; k <= CELL; k++)
        if (!header->has[k]) return cpsi_grid_fail(text, "the header is not whole: %s", KNOWN);
    if (!(header->value[CELL] > 0))
        return cpsi_grid_fail(text, "the cellsize is %g, expected more than 0",
                              header->value[CELL]);
    return CPS_OK;
}

/* A file NAME.prj beside NAME.asc that begins with GEOGCS says that the coordinates are degrees. */
static CpsStatus refuse_degrees(const CpsiGridText *text) {
    const size_t length = strlen(text->path);
    const char *dot = strrchr(text->path, '.'), *slash = strrchr(text->path, '/');
    char *path = malloc(length + 5), *bytes = NULL;
    size_t size = 0;
    if (!path) return cpsi_grid_no_memory(text);
    const size_t stem = dot && (!slash || dot > slash) ? (size_t)(dot - text->path) : length;
    memcpy(path, text->path, stem);
    memcpy(path + stem, ".prj", 5);
    const bool degrees = cpsi_read_file_itself(path, 1 << 16, &bytes, &size, NULL) == CPS_OK &&
                         size > 6 && memcmp(bytes, "GEOGCS", 6) == 0;
    free(bytes);
    free(path);
    if (!degrees) return CPS_OK;
    return cpsi_fail_at(text->err, CPS_ERR_INPUT, text->path, 0, 0,
                        "its coordinates are degrees, as the file .prj beside it says, expected "
                        "metres: project it first");
}

CpsStatus cpsi_grid_read_esri(CpsiGridText *text, CpsiGridFile *out) {
    Header header = {.value = {[NODATA] = -9999}};
    CpsStatus status = refuse_degrees(text);
    if (status == CPS_OK) status = read_header(text, &header);
    if (status == CPS_OK)
        status =
            cpsi_grid_allocate(text, (int)header.value[NCOLS], (int)header.value[NROWS], 2, out);
    if (status != CPS_OK) return status;
    const double cell = header.value[CELL];
    for (int i = 0; i < out->x_count; i++)
        out->x[i] = header.value[XLL] + cell * (i + (header.centre[0] ? 0 : 0.5));
    for (int j = 0; j < out->y_count; j++)
        out->y[j] = header.value[YLL] + cell * (j + (header.centre[1] ? 0 : 0.5));
    for (int j = out->y_count - 1; j >= 0; j--) /* rows come from the north */
        for (int i = 0; i < out->x_count; i++) {
            double *z = &out->z[(size_t)j * (size_t)out->x_count + (size_t)i];
            status = cpsi_grid_number(text, "a height", z);
            if (status != CPS_OK) return status;
            if (*z == header.value[NODATA])
                return cpsi_grid_fail(text,
                                      "found %g at (%g, %g) m, the value for no data: fill such "
                                      "places, or cut the grid so that it has none",
                                      *z, out->x[i], out->y[j]);
        }
    return cpsi_grid_end(text, "the last height");
}

/* ---- points ---- */

typedef struct GridPoint {
    double value[3];
    int line;
} GridPoint;

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The different values among `count`, sorted in place; values that are nearly the same are one. */
static int distinct(double *value, size_t count) {
    qsort(value, count, sizeof *value, compare);
    const double near = 1e-9 * (value[count - 1] - value[0]);
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || value[i] > value[kept - 1] + near) value[kept++] = value[i];
    return kept < 1000000 ? (int)kept : 1000000;
}

/* Put a point of the file where it belongs; NaN marks places without one. */
static CpsStatus place_point(const CpsiGridText *text, CpsiGridFile *out, const GridPoint *point) {
    CpsiGridText at = *text;
    at.line = point->line;
    at.column = 1;
    const int i = cpsi_grid_index(out->x_count, out->x, point->value[0]),
              j = cpsi_grid_index(out->y_count, out->y, point->value[1]);
    if (i < 0 || j < 0)
        return cpsi_grid_fail(&at, "the point (%.10g, %.10g) is none of the grid's",
                              point->value[0], point->value[1]);
    double *z = &out->z[(size_t)j * (size_t)out->x_count + (size_t)i];
    if (!isnan(*z))
        return cpsi_grid_fail(&at, "the point (%.10g, %.10g) is given twice", point->value[0],
                              point->value[1]);
    *z = point->value[2];
    return CPS_OK;
}

static void clear(CpsiGridFile *out) {
    const size_t points = (size_t)out->x_count * (size_t)out->y_count;
    for (size_t i = 0; i < points; i++) out->z[i] = NAN;
}

static CpsStatus find_gap(const CpsiGridText *text, const CpsiGridFile *out) {
    for (int j = 0; j < out->y_count; j++)
        for (int i = 0; i < out->x_count; i++)
            if (isnan(out->z[(size_t)j * (size_t)out->x_count + (size_t)i]))
                return cpsi_grid_fail(text,
                                      "the points are no grid of %d x %d: there is none at "
                                      "(%.10g, %.10g)",
                                      out->x_count, out->y_count, out->x[i], out->y[j]);
    return CPS_OK;
}

static CpsStatus read_point(CpsiGridText *text, GridPoint *point) {
    static const char *const WHAT[3] = {"x of a point", "y of a point", "z of a point"};
    for (int a = 0; a < 3; a++) {
        const CpsStatus status = cpsi_grid_number(text, WHAT[a], &point->value[a]);
        if (status != CPS_OK) return status;
        if (a == 0) point->line = text->line;
        if (text->line != point->line)
            return cpsi_grid_fail(text, "found the end of line %d, expected x, y and z in one line",
                                  point->line);
    }
    return CPS_OK;
}

/* Is there another word? Nothing is read. */
static bool is_more(const CpsiGridText *text) {
    CpsiGridText ahead = *text;
    return cpsi_grid_word(&ahead);
}

CpsStatus cpsi_grid_read_xyz(CpsiGridText *text, CpsiGridFile *out) {
    /* a point takes at least 6 bytes: three digits, each with a separator, but for the last */
    const size_t most = text->size / 6 + 1;
    GridPoint *point = CPSI_POOL_TAKE(text->pool, most, GridPoint);
    double *x = CPSI_POOL_TAKE(text->pool, most, double),
           *y = CPSI_POOL_TAKE(text->pool, most, double);
    if (!point || !x || !y) return cpsi_grid_no_memory(text);
    size_t count = 0;
    while (is_more(text) && count < most) {
        const CpsStatus status = read_point(text, &point[count]);
        if (status != CPS_OK) return status;
        x[count] = point[count].value[0];
        y[count] = point[count].value[1];
        count++;
    }
    if (count < 4)
        return cpsi_grid_fail(text,
                              "found %zu points, expected rows x y z of 2 x 2 points at least",
                              count);
    const int columns = distinct(x, count), rows = distinct(y, count);
    if (columns < 2 || rows < 2 || (double)columns * rows > 2 * (double)count)
        return cpsi_grid_fail(text,
                              "%zu points with %d different x and %d different y are no grid, "
                              "expected one point for each pair",
                              count, columns, rows);
    CpsStatus status = cpsi_grid_allocate(text, columns, rows, 2, out);
    if (status != CPS_OK) return status;
    memcpy(out->x, x, (size_t)columns * sizeof *x);
    memcpy(out->y, y, (size_t)rows * sizeof *y);
    clear(out);
    for (size_t k = 0; k < count && status == CPS_OK; k++)
        status = place_point(text, out, &point[k]);
    return status == CPS_OK ? find_gap(text, out) : status;
}

/* ---- MoorDyn ---- */

/* Lines at the top that begin with --- are titles. */
static void skip_titles(CpsiGridText *text) {
    for (;;) {
        CpsiGridText ahead = *text;
        if (!cpsi_grid_word(&ahead) || ahead.length < 3 || memcmp(ahead.word, "---", 3) != 0)
            return;
        const char *end = memchr(ahead.at, '\n', (size_t)(text->bytes + text->size - ahead.at));
        *text = ahead;
        text->at = end ? end : text->bytes + text->size;
    }
}

CpsStatus cpsi_grid_read_moordyn_c(CpsiGridText *text, CpsiGridFile *out) {
    int columns = 0, rows = 0;
    skip_titles(text);
    CpsStatus status = cpsi_grid_count(text, "the number of x", &columns);
    if (status == CPS_OK) status = cpsi_grid_count(text, "the number of y", &rows);
    if (status == CPS_OK) status = cpsi_grid_allocate(text, columns, rows, 6, out);
    if (status == CPS_OK) status = cpsi_grid_axis(text, "x", columns, out->x);
    if (status == CPS_OK) status = cpsi_grid_axis(text, "y", rows, out->y);
    if (status != CPS_OK) return status;
    clear(out);
    const size_t points = (size_t)columns * (size_t)rows;
    for (size_t k = 0; k < points && status == CPS_OK; k++) {
        GridPoint point;
        status = read_point(text, &point);
        if (status == CPS_OK) status = place_point(text, out, &point);
    }
    if (status == CPS_OK) status = cpsi_grid_end(text, "the last point");
    return status;
}

static CpsStatus read_named_count(CpsiGridText *text, const char *name, int *count) {
    if (!cpsi_grid_word(text) || !cpsi_grid_is_word(text, name))
        return cpsi_grid_fail(text, "found '%.*s', expected %s and a number",
                              (int)(text->length < 40 ? text->length : 40), text->word, name);
    return cpsi_grid_count(text, name, count);
}

CpsStatus cpsi_grid_read_moordyn_f(CpsiGridText *text, CpsiGridFile *out) {
    int columns = 0, rows = 0;
    skip_titles(text);
    CpsStatus status = read_named_count(text, "nGridX", &columns);
    if (status == CPS_OK) status = read_named_count(text, "nGridY", &rows);
    if (status == CPS_OK) status = cpsi_grid_allocate(text, columns, rows, 2, out);
    if (status == CPS_OK) status = cpsi_grid_axis(text, "x", columns, out->x);
    for (int j = 0; j < rows && status == CPS_OK; j++) {
        status = cpsi_grid_number(text, "y", &out->y[j]);
        if (status == CPS_OK && j > 0 && !(out->y[j] > out->y[j - 1]))
            status = cpsi_grid_fail(text, "found %.10g after %.10g, expected y that increase",
                                    out->y[j], out->y[j - 1]);
        for (int i = 0; i < columns && status == CPS_OK; i++)
            status =
                cpsi_grid_number(text, "a depth", &out->z[(size_t)j * (size_t)columns + (size_t)i]);
    }
    return status == CPS_OK ? cpsi_grid_end(text, "the last depth") : status;
}
