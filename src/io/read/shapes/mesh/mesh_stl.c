/* SPDX-License-Identifier: BSD-3-Clause */
/* STL files (mesh_parts.h). A binary file has a header of 80 bytes, the number of triangles in four
 * bytes, the lowest first, and 50 bytes for each: its normal and its corners as floats, and two
 * bytes for other things. A file of text begins with `solid`. A binary one may begin so as well: it
 * is binary if its size is that of the number in it. Normals are not read; the order of the corners
 * says the same. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/status.h"
#include "io/base/yaml/yaml.h"
#include "io/read/shapes/mesh/mesh_parts.h"

enum { HEADER = 80, BEGIN = 84, EACH = 50, NORMAL = 12 };
/* Bytes of a triangle as text, at least: its words, and twelve numbers of a digit. */
enum { LEAST_TEXT = 70 };

static uint32_t word_at(const char *bytes) {
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static double float_at(const char *bytes) {
    const uint32_t bits = word_at(bytes);
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

/* The corners of triangle t follow each other. */
static void count_corners(CpsiMeshFile *out) {
    out->vertex_count = 3 * out->triangle_count;
    for (int v = 0; v < out->vertex_count; v++) out->triangle[v] = v;
}

static CpsStatus read_binary(const CpsiGridText *text, size_t count, CpsiMeshFile *out) {
    const CpsStatus status = cpsi_mesh_allocate(text, 3 * count, count, out);
    if (status != CPS_OK) return status;
    out->triangle_count = (int)count;
    count_corners(out);
    for (size_t t = 0; t < count; t++)
        for (size_t k = 0; k < 9; k++) {
            const size_t at = BEGIN + EACH * t + NORMAL + 4 * k;
            const double x = float_at(text->bytes + at);
            if (!isfinite(x))
                return cpsi_fail_at(text->err, CPS_ERR_INPUT, text->path, 0, 0,
                                    "byte %zu: found %g as a coordinate of triangle %zu, expected "
                                    "a finite number",
                                    at, x, t + 1);
            out->vertex[9 * t + k] = x;
        }
    return CPS_OK;
}

/* Words of the text that must follow. */
static CpsStatus expect(CpsiGridText *text, const char *first, const char *second) {
    const char *const wanted[2] = {first, second};
    for (int i = 0; i < 2 && wanted[i]; i++) {
        const bool found = cpsi_grid_word(text);
        if (found && cpsi_grid_is_word(text, wanted[i])) continue;
        if (!found)
            return cpsi_grid_fail(text, "found the end of the file, expected '%s'", wanted[i]);
        return cpsi_grid_fail(text, "found '%.*s', expected '%s'",
                              (int)(text->length < 40 ? text->length : 40), text->word, wanted[i]);
    }
    return CPS_OK;
}

static void skip_line(CpsiGridText *text) {
    const char *end = memchr(text->at, '\n', (size_t)(text->bytes + text->size - text->at));
    text->at = end ? end : text->bytes + text->size;
}

/* What follows the word `facet`. */
static CpsStatus read_facet(CpsiGridText *text, double corner[9]) {
    CpsStatus status = expect(text, "normal", NULL);
    for (int k = 0; k < 3 && status == CPS_OK; k++)
        if (!cpsi_grid_word(text))
            status = cpsi_grid_fail(text, "found the end of the file, expected a normal");
    if (status == CPS_OK) status = expect(text, "outer", "loop");
    for (int k = 0; k < 9 && status == CPS_OK; k++) {
        if (k % 3 == 0) status = expect(text, "vertex", NULL);
        if (status == CPS_OK) status = cpsi_grid_number(text, "a coordinate", &corner[k]);
    }
    if (status == CPS_OK) status = expect(text, "endloop", NULL);
    return status == CPS_OK ? expect(text, "endfacet", NULL) : status;
}

static CpsStatus read_text(CpsiGridText *text, CpsiMeshFile *out) {
    const size_t most = text->size / LEAST_TEXT + 1;
    CpsStatus status = cpsi_mesh_allocate(text, 3 * most, most, out);
    bool inside = false;
    while (status == CPS_OK && cpsi_grid_word(text)) {
        if (cpsi_grid_is_word(text, inside ? "endsolid" : "solid")) {
            inside = !inside;
            skip_line(text); /* a name */
        } else if (inside && cpsi_grid_is_word(text, "facet")) {
            if ((size_t)out->triangle_count == most)
                return cpsi_grid_fail(text, "this facet is too short");
            status = read_facet(text, &out->vertex[9 * (size_t)out->triangle_count++]);
        } else {
            status = cpsi_grid_fail(text, "found '%.*s', expected '%s'",
                                    (int)(text->length < 40 ? text->length : 40), text->word,
                                    inside ? "facet' or 'endsolid" : "solid");
        }
    }
    if (status != CPS_OK) return status;
    if (inside) return cpsi_grid_fail(text, "found the end of the file, expected 'endsolid'");
    count_corners(out);
    return CPS_OK;
}

CpsStatus cpsi_mesh_read_stl(CpsiGridText *text, CpsiMeshFile *out) {
    const bool header = text->size >= BEGIN;
    const size_t count = header ? word_at(text->bytes + HEADER) : 0;
    if (header && (text->size - BEGIN) % EACH == 0 && (text->size - BEGIN) / EACH == count)
        return read_binary(text, count, out);
    if (!memchr(text->bytes, '\0', text->size)) return read_text(text, out);
    if (!header)
        return cpsi_fail_at(text->err, CPS_ERR_INPUT, text->path, 0, 0,
                            "found %zu bytes, expected at least the %d with which a binary STL "
                            "file begins",
                            text->size, BEGIN);
    return cpsi_fail_at(text->err, CPS_ERR_INPUT, text->path, 0, 0,
                        "found %zu bytes, expected %.0f, as a binary STL file of %zu triangles "
                        "has: is it whole, and is it STL?",
                        text->size, BEGIN + (double)EACH * (double)count, count);
}
