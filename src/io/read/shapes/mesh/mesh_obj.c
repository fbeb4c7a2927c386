/* SPDX-License-Identifier: BSD-3-Clause */
/* Wavefront OBJ files (mesh_parts.h): `v x y z` is a vertex, `f a b c ..` a face with three or more
 * corners, each the number of a vertex from 1, or counted back from the last one, -1; what follows
 * a slash in a corner (texture, normal) and all other lines are passed over. A face with more
 * corners becomes triangles that share its first corner. */
#include <string.h>

#include "base/status.h"
#include "io/read/shapes/mesh/mesh_parts.h"

enum { DIGITS = 9 };

/* The next word, if it is in the line of the last one. */
static bool word_in_line(CpsiGridText *text, int line) {
    CpsiGridText ahead = *text;
    if (!cpsi_grid_word(&ahead) || ahead.line != line) return false;
    *text = ahead;
    return true;
}

static void skip_line(CpsiGridText *text, int line) {
    while (word_in_line(text, line)) continue;
}

/* How many vertices and triangles the lines announce. */
static void count_items(CpsiGridText text, size_t *vertices, size_t *triangles) {
    *vertices = *triangles = 0;
    while (cpsi_grid_word(&text)) {
        const int line = text.line;
        size_t corners = 0;
        const bool is_face = cpsi_grid_is_word(&text, "f");
        *vertices += cpsi_grid_is_word(&text, "v");
        while (word_in_line(&text, line)) corners++;
        if (is_face && corners > 2) *triangles += corners - 2;
    }
}

/* The vertex that a corner names, `known` so far and `total` in all: a whole number up to a
 * slash. */
static CpsStatus read_corner(const CpsiGridText *text, int known, int total, int *out) {
    const char *word = text->word, *end = word + text->length;
    const bool back = *word == '-';
    int value = 0, digits = 0;
    for (word += back; word < end && *word >= '0' && *word <= '9' && digits <= DIGITS; digits++)
        if (digits < DIGITS) value = 10 * value + (*word++ - '0');
    *out = back ? known - value : value - 1;
    if (!(digits > 0 && digits <= DIGITS && (word == end || *word == '/') && value > 0 &&
          *out >= 0))
        return cpsi_grid_fail(text,
                              "found '%.*s', expected a corner of a face: the number of a vertex, "
                              "from 1, or back from -1",
                              (int)(text->length < 40 ? text->length : 40), text->word);
    if (*out >= total)
        return cpsi_grid_fail(text, "a face names vertex %d, but there are %d", value, total);
    return CPS_OK;
}

/* What follows the word `f`. */
static CpsStatus read_face(CpsiGridText *text, int total, CpsiMeshFile *out) {
    const int line = text->line;
    int corners = 0, first = 0, before = 0;
    for (; word_in_line(text, line); corners++) {
        int at = 0;
        const CpsStatus status = read_corner(text, out->vertex_count, total, &at);
        if (status != CPS_OK) return status;
        if (corners >= 2) {
            int *c = &out->triangle[3 * (size_t)out->triangle_count++];
            c[0] = first;
            c[1] = before;
            c[2] = at;
        }
        if (corners == 0) first = at;
        before = at;
    }
    if (corners > 2) return CPS_OK;
    return cpsi_grid_fail(text, "found a face with %d corners, expected 3 or more in its line",
                          corners);
}

static CpsStatus read_vertex(CpsiGridText *text, CpsiMeshFile *out) {
    const int line = text->line;
    for (size_t k = 0; k < 3; k++) {
        if (!word_in_line(text, line))
            return cpsi_grid_fail(text, "found the end of the line, expected x, y and z");
        CpsiGridText again = *text; /* the word is read once more as a number */
        again.at = text->word;
        const CpsStatus status = cpsi_grid_number(&again, "a coordinate",
                                                  &out->vertex[3 * (size_t)out->vertex_count + k]);
        if (status != CPS_OK) return status;
    }
    out->vertex_count++;
    skip_line(text, line);
    return CPS_OK;
}

CpsStatus cpsi_mesh_read_obj(CpsiGridText *text, CpsiMeshFile *out) {
    size_t vertices, triangles;
    count_items(*text, &vertices, &triangles);
    if (vertices == 0 || triangles == 0)
        return cpsi_grid_fail(text, "found %zu vertices and %zu triangles in faces: is this OBJ?",
                              vertices, triangles);
    CpsStatus status = cpsi_mesh_allocate(text, vertices, triangles, out);
    while (status == CPS_OK && cpsi_grid_word(text)) {
        if (cpsi_grid_is_word(text, "v"))
            status = read_vertex(text, out);
        else if (cpsi_grid_is_word(text, "f"))
            status = read_face(text, (int)vertices, out);
        else
            skip_line(text, text->line);
    }
    return status;
}
