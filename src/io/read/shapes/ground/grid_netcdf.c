/* SPDX-License-Identifier: BSD-3-Clause */
/* A grid from a classic netCDF file (grid_file.h), by the specification of its format, versions 1
 * (classic) and 2 (64-bit offset): a header of dimensions, attributes and variables, big endian, in
 * which sizes and places are checked against the file before they are used.
 *
 * The variable has two dimensions, which both have variables of their names with the coordinates.
 * The last dimension is x. Values are floats, doubles, or integers; scale_factor and add_offset are
 * applied; _FillValue and missing_value are refused, as are units that are not metres, dimensions
 * whose names say that y is the last one, and a `positive` that is not what the scene says. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/status.h"
#include "capstan/ground.h"
#include "io/base/yaml/yaml.h"
#include "io/read/shapes/ground/grid_parts.h"

enum { BYTE = 1, CHAR, SHORT, INT, FLOAT, DOUBLE };
enum { DIMENSION = 10, VARIABLE = 11, ATTRIBUTE = 12 };
/* A file with more of them is no grid. */
enum { MOST_DIMENSIONS = 64 };

typedef struct Reader {
    const CpsiGridText *text;
    size_t at;
    int version;
    bool failed; /* beyond the end of the file */
    int dimensions;
    uint32_t length[MOST_DIMENSIONS];
    const char *name[MOST_DIMENSIONS];
    uint32_t name_length[MOST_DIMENSIONS];
} Reader;

/* What is known of a variable. */
typedef struct Variable {
    bool found, degrees, other_units, up, down; /* up, down: by its attribute `positive` */
    uint32_t type, rank, dimension[2];
    uint64_t begin;
    double scale, offset, missing[2];
} Variable;

static CpsStatus fail(const Reader *r, const char *what) {
    return cpsi_fail_at(r->text->err, CPS_ERR_INPUT, r->text->path, 0, 0, "%s", what);
}

static const unsigned char *take(Reader *r, size_t count) {
    if (r->failed || count > r->text->size - r->at) {
        r->failed = true;
        return NULL;
    }
    const unsigned char *here = (const unsigned char *)r->text->bytes + r->at;
    r->at += count;
    return here;
}

static uint32_t take_word(Reader *r) {
    const unsigned char *b = take(r, 4);
    return b ? (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3] : 0;
}

/* Bytes that are filled up to a multiple of four. */
static const char *take_padded(Reader *r, size_t count) {
    const unsigned char *here = take(r, count);
    (void)take(r, (4 - count % 4) % 4);
    return r->failed ? NULL : (const char *)here;
}

static const char *take_name(Reader *r, uint32_t *length) {
    *length = take_word(r);
    return take_padded(r, *length);
}

static size_t size_of(uint32_t type) {
    static const size_t SIZE[] = {0, 1, 1, 2, 4, 4, 8};
    return type >= BYTE && type <= DOUBLE ? SIZE[type] : 0;
}

static double number_at(const unsigned char *b, uint32_t type) {
    uint64_t bits = 0;
    const size_t size = size_of(type);
    for (size_t i = 0; i < size; i++) bits = bits << 8 | b[i];
    if (type == BYTE) return (int8_t)(uint8_t)bits;
    if (type == SHORT) return (int16_t)(uint16_t)bits;
    if (type == INT) return (int32_t)(uint32_t)bits;
    if (type == FLOAT) {
        const uint32_t half = (uint32_t)bits;
        float out;
        memcpy(&out, &half, sizeof out);
        return out;
    }
    double out;
    memcpy(&out, &bits, sizeof out);
    return out;
}

static bool is_name(const char *name, uint32_t length, const char *wanted) {
    return strlen(wanted) == length && memcmp(name, wanted, length) == 0;
}

/* The head of a list: its tag or 0, and how many. */
static uint32_t take_count(Reader *r, uint32_t tag) {
    const uint32_t found = take_word(r), count = take_word(r);
    if (found != tag && (found != 0 || count != 0)) r->failed = true;
    return r->failed ? 0 : count;
}

/* Does text of the file begin with these lower-case letters, or is it them? */
static bool begins_with(const char *value, uint32_t count, const char *wanted) {
    const size_t length = strlen(wanted);
    for (size_t i = 0; i < length; i++)
        if (i >= count || (value[i] | 0x20) != wanted[i]) return false;
    return true;
}

static bool is_word(const char *value, uint32_t count, const char *wanted) {
    while (count > 0 && (value[count - 1] == ' ' || value[count - 1] == '\0')) count--;
    return count == strlen(wanted) && begins_with(value, count, wanted);
}

static void take_text(Variable *variable, const char *name, uint32_t length, const char *value,
                      uint32_t count) {
    if (is_name(name, length, "units")) {
        variable->degrees = begins_with(value, count, "degree");
        variable->other_units =
            !(is_word(value, count, "") || is_word(value, count, "m") ||
              begins_with(value, count, "metre") || begins_with(value, count, "meter"));
    }
    if (is_name(name, length, "positive")) {
        variable->up = is_word(value, count, "up");
        variable->down = is_word(value, count, "down");
    }
}

/* Attributes; those that matter go to `variable`, which may be NULL. */
static void take_attributes(Reader *r, Variable *variable) {
    const uint32_t count = take_count(r, ATTRIBUTE);
    for (uint32_t i = 0; i < count && !r->failed; i++) {
        uint32_t length;
        const char *name = take_name(r, &length);
        const uint32_t type = take_word(r), items = take_word(r);
        const size_t size = size_of(type);
        if (size == 0 || items > r->text->size) r->failed = true;
        if (r->failed) return;
        const char *value = take_padded(r, size * items);
        if (r->failed || !variable) continue;
        if (type == CHAR) {
            take_text(variable, name, length, value, items);
        } else if (items == 1) {
            const double x = number_at((const unsigned char *)value, type);
            if (is_name(name, length, "scale_factor")) variable->scale = x;
            if (is_name(name, length, "add_offset")) variable->offset = x;
            if (is_name(name, length, "_FillValue")) variable->missing[0] = x;
            if (is_name(name, length, "missing_value")) variable->missing[1] = x;
        }
    }
}

static void take_dimensions(Reader *r) {
    const uint32_t count = take_count(r, DIMENSION);
    if (count > MOST_DIMENSIONS) r->failed = true;
    for (uint32_t i = 0; i < count && !r->failed; i++) {
        r->name[i] = take_name(r, &r->name_length[i]);
        r->length[i] = take_word(r);
        r->dimensions = (int)i + 1;
    }
}

/* The variable of this name; `found` is false without one. */
static Variable take_variable(Reader *r, const char *wanted, uint32_t wanted_length) {
    Variable out = {.found = false};
    const uint32_t count = take_count(r, VARIABLE);
    for (uint32_t i = 0; i < count && !r->failed && !out.found; i++) {
        Variable here = {.scale = 1, .missing = {NAN, NAN}};
        uint32_t length;
        const char *name = take_name(r, &length);
        here.rank = take_word(r);
        for (uint32_t k = 0; k < here.rank && !r->failed; k++) {
            const uint32_t dimension = take_word(r);
            if (k < 2) here.dimension[k] = dimension;
            if (dimension >= (uint32_t)r->dimensions) r->failed = true;
        }
        take_attributes(r, &here);
        here.type = take_word(r);
        (void)take_word(r); /* its size, which may be wrong for large ones */
        here.begin = r->version == 2 ? (uint64_t)take_word(r) << 32 : 0;
        here.begin |= take_word(r);
        if (r->failed) break;
        here.found = length == wanted_length && memcmp(name, wanted, length) == 0;
        if (here.found) out = here;
    }
    return out;
}

/* The numbers of a variable. */
static CpsStatus read_values(const Reader *r, const Variable *v, size_t count, const char *what,
                             double *out) {
    const size_t size = size_of(v->type);
    char message[160];
    if (size == 0 || v->type == CHAR) return fail(r, "a variable of the grid is no number");
    if (v->begin > r->text->size || count > (r->text->size - (size_t)v->begin) / size)
        return fail(r, "the file is too short for the grid that its header describes");
    const unsigned char *at = (const unsigned char *)r->text->bytes + v->begin;
    for (size_t i = 0; i < count; i++, at += size) {
        const double x = number_at(at, v->type);
        out[i] = v->offset + v->scale * x;
        if (fabs(out[i]) <= 1e100 && x != v->missing[0] && x != v->missing[1]) continue;
        snprintf(message, sizeof message,
                 "%s number %zu is %g, which is missing or no number: fill such places, or cut the "
                 "grid so that it has none",
                 what, i + 1, x);
        return fail(r, message);
    }
    return CPS_OK;
}

/* The coordinates of dimension d; reversed where they decrease. */
static CpsStatus read_axis(Reader *r, size_t variables, uint32_t d, int count, double *out,
                           bool *reversed) {
    r->at = variables;
    const Variable v = take_variable(r, r->name[d], r->name_length[d]);
    if (r->failed || !v.found || v.rank != 1 || v.dimension[0] != d)
        return fail(r, "a dimension of the grid has no variable of its name with its coordinates");
    if (v.degrees) return fail(r, "its coordinates are degrees, expected metres: project it first");
    if (v.other_units) return fail(r, "the units of its coordinates are not metres: convert it");
    const CpsStatus status = read_values(r, &v, (size_t)count, "coordinate", out);
    if (status != CPS_OK) return status;
    *reversed = out[0] > out[1];
    for (int i = 0; *reversed && i < count / 2; i++) {
        const double kept = out[i];
        out[i] = out[count - 1 - i];
        out[count - 1 - i] = kept;
    }
    for (int i = 1; i < count; i++)
        if (!(out[i] > out[i - 1]))
            return fail(r, "the coordinates of a dimension neither increase nor decrease");
    return CPS_OK;
}

static void reverse(CpsiGridFile *out, bool x, bool y) {
    const size_t columns = (size_t)out->x_count, rows = (size_t)out->y_count;
    for (size_t j = 0; j < rows; j++)
        for (size_t i = 0; i < columns; i++) {
            const size_t from = j * columns + i,
                         to = (y ? rows - 1 - j : j) * columns + (x ? columns - 1 - i : i);
            if (to <= from) continue;
            const double kept = out->z[from];
            out->z[from] = out->z[to];
            out->z[to] = kept;
        }
}

/* Do the names of the dimensions say that y is the last one? */
static bool is_transposed(const Reader *r, const Variable *z) {
    return is_word(r->name[z->dimension[0]], r->name_length[z->dimension[0]], "x") ||
           is_word(r->name[z->dimension[1]], r->name_length[z->dimension[1]], "y");
}

CpsStatus cpsi_grid_read_netcdf(CpsiGridText *text, const char *variable, CpsiGridFile *out) {
    Reader r = {.text = text};
    const unsigned char *magic = take(&r, 4);
    text->line = text->column = 0; /* there are no lines */
    if (!magic || memcmp(magic, "CDF", 3) != 0 || (magic[3] != 1 && magic[3] != 2))
        return fail(&r, "this is no classic netCDF file (CDF-1 or CDF-2): convert it, for "
                        "instance by nccopy -k classic");
    r.version = magic[3];
    (void)take_word(&r); /* number of records */
    take_dimensions(&r);
    take_attributes(&r, NULL);
    const size_t variables = r.at;
    const Variable z = take_variable(&r, variable, (uint32_t)strlen(variable));
    char message[160];
    if (r.failed) return fail(&r, "its header is not whole");
    if (!z.found || z.rank != 2) {
        snprintf(message, sizeof message, "it has no variable '%.64s' over two dimensions, y and x",
                 variable);
        return fail(&r, message);
    }
    const uint32_t rows = r.length[z.dimension[0]], columns = r.length[z.dimension[1]];
    if (rows < 2 || columns < 2 || rows > CPS_MAX_GROUND_COUNT || columns > CPS_MAX_GROUND_COUNT ||
        z.dimension[0] == z.dimension[1]) {
        snprintf(message, sizeof message,
                 "'%.64s' has %u x %u points, expected 2 to %d along each of two dimensions",
                 variable, (unsigned)columns, (unsigned)rows, CPS_MAX_GROUND_COUNT);
        return fail(&r, message);
    }
    if (is_transposed(&r, &z))
        return fail(&r, "its variable has the dimensions x, y, expected y, x: transpose it, for "
                        "instance by ncpdq -a y,x");
    CpsStatus status = cpsi_grid_allocate(text, (int)columns, (int)rows, 1, out);
    bool x_falls = false, y_falls = false;
    out->units_are_others = z.degrees || z.other_units;
    out->is_up = z.up;
    out->is_down = z.down;
    if (status == CPS_OK)
        status = read_axis(&r, variables, z.dimension[1], (int)columns, out->x, &x_falls);
    if (status == CPS_OK)
        status = read_axis(&r, variables, z.dimension[0], (int)rows, out->y, &y_falls);
    if (status == CPS_OK) status = read_values(&r, &z, (size_t)rows * columns, "height", out->z);
    if (status == CPS_OK && (x_falls || y_falls)) reverse(out, x_falls, y_falls);
    return status;
}
