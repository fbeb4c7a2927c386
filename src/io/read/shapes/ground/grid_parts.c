/* SPDX-License-Identifier: BSD-3-Clause */
/* Words, numbers and axes of a grid file (grid_parts.h). */
#include "io/read/shapes/ground/grid_parts.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/ground.h"
#include "io/base/yaml/yaml.h"

/* Larger numbers are no places. */
static const double LARGEST = 1e100;
/* [-] Coordinates nearer than this, per length of the axis, are one: decimals are rounded. */
static const double SAME = 1e-9;

enum { LONGEST = 60 }; /* letters of a number, and of a word in a message */

static bool separates(const CpsiGridText *text, char c) {
    return c == ' ' || c == '\t' || c == '\r' || (!text->blanks_only && (c == ',' || c == ';'));
}

bool cpsi_grid_word(CpsiGridText *text) {
    const char *at = text->at, *end = text->bytes + text->size;
    for (; at < end; at++) {
        if (*at == '#')
            while (at < end && *at != '\n') at++;
        if (at == end) break;
        if (*at == '\n') {
            text->line++;
            text->line_start = at + 1;
        } else if (!separates(text, *at)) {
            break;
        }
    }
    text->word = at;
    text->column = (int)(at - text->line_start) + 1;
    while (at < end && *at != '\n' && *at != '#' && !separates(text, *at)) at++;
    text->length = (size_t)(at - text->word);
    text->at = at;
    return text->length > 0;
}

bool cpsi_grid_is_word(const CpsiGridText *text, const char *word) {
    if (strlen(word) != text->length) return false;
    for (size_t i = 0; i < text->length; i++)
        if (tolower((unsigned char)text->word[i]) != tolower((unsigned char)word[i])) return false;
    return true;
}

bool cpsi_grid_is_number(const CpsiGridText *text, double *value) {
    char copy[LONGEST + 1], *end;
    if (text->length == 0 || text->length > LONGEST) return false;
    memcpy(copy, text->word, text->length);
    copy[text->length] = '\0';
    if (strspn(copy, "0123456789+-.eE") != text->length) return false;
    *value = strtod(copy, &end);
    return *end == '\0' && fabs(*value) <= LARGEST;
}

CpsStatus cpsi_grid_fail(const CpsiGridText *text, const char *format, ...) {
    char message[400];
    va_list list;
    va_start(list, format);
    vsnprintf(message, sizeof message, format, list);
    va_end(list);
    return cpsi_fail_at(text->err, CPS_ERR_INPUT, text->path, text->line, text->column, "%s",
                        message);
}

CpsStatus cpsi_grid_no_memory(const CpsiGridText *text) {
    return cpsi_fail_at(text->err, CPS_ERR_MEMORY, text->path, 0, 0,
                        "out of memory while reading the grid");
}

CpsStatus cpsi_grid_number(CpsiGridText *text, const char *what, double *value) {
    if (!cpsi_grid_word(text))
        return cpsi_grid_fail(text, "found the end of the file, expected %s", what);
    if (cpsi_grid_is_number(text, value)) return CPS_OK;
    const int shown = text->length < LONGEST ? (int)text->length : LONGEST;
    return cpsi_grid_fail(text, "found '%.*s', expected %s: a number of at most %g", shown,
                          text->word, what, LARGEST);
}

CpsStatus cpsi_grid_count(CpsiGridText *text, const char *what, int *value) {
    double found = 0;
    const CpsStatus status = cpsi_grid_number(text, what, &found);
    if (status != CPS_OK) return status;
    if (!(found >= 2 && found <= CPS_MAX_GROUND_COUNT && found == floor(found)))
        return cpsi_grid_fail(text, "found %.10g, expected %s: a whole number from 2 to %d", found,
                              what, CPS_MAX_GROUND_COUNT);
    *value = (int)found;
    return CPS_OK;
}

CpsStatus cpsi_grid_axis(CpsiGridText *text, const char *what, int count, double *value) {
    for (int i = 0; i < count; i++) {
        const CpsStatus status = cpsi_grid_number(text, what, &value[i]);
        if (status != CPS_OK) return status;
        if (i > 0 && !(value[i] > value[i - 1]))
            return cpsi_grid_fail(text, "found %.10g after %.10g, expected %s that increase",
                                  value[i], value[i - 1], what);
    }
    return CPS_OK;
}

CpsStatus cpsi_grid_end(CpsiGridText *text, const char *after) {
    if (!cpsi_grid_word(text)) return CPS_OK;
    const int shown = text->length < LONGEST ? (int)text->length : LONGEST;
    return cpsi_grid_fail(text, "found '%.*s' after %s, expected the end of the file", shown,
                          text->word, after);
}

CpsStatus cpsi_grid_allocate(const CpsiGridText *text, int x_count, int y_count, size_t least,
                             CpsiGridFile *out) {
    const double points = (double)x_count * y_count;
    if (points > CPS_MAX_GROUND_POINTS)
        return cpsi_fail_at(text->err, CPS_ERR_LIMIT, text->path, text->line, text->column,
                            "%d times %d points, the limit is %d: take every second one", x_count,
                            y_count, CPS_MAX_GROUND_POINTS);
    if (points * (double)least > (double)text->size + (double)least)
        return cpsi_grid_fail(text, "the file is too short for %d times %d points", x_count,
                              y_count);
    *out = (CpsiGridFile){.x_count = x_count, .y_count = y_count};
    out->x = CPSI_POOL_TAKE(text->pool, x_count, double);
    out->y = CPSI_POOL_TAKE(text->pool, y_count, double);
    out->z = CPSI_POOL_TAKE(text->pool, (size_t)x_count * (size_t)y_count, double);
    return out->x && out->y && out->z ? CPS_OK : cpsi_grid_no_memory(text);
}

int cpsi_grid_index(int count, const double *axis, double at) {
    const double near = SAME * (axis[count - 1] - axis[0]);
    int low = 0, high = count - 1;
    while (low < high) { /* the first that is not before */
        const int middle = (low + high) / 2;
        if (axis[middle] < at - near)
            low = middle + 1;
        else
            high = middle;
    }
    return fabs(axis[low] - at) <= near ? low : -1;
}
