/* SPDX-License-Identifier: BSD-3-Clause */
/* The nodes of a line that are held (held.h). */
#include "cable/held.h"

#include <string.h>

bool cpsi_line_is_loose(const CpsiLine *line) { return cpsi_line_next_held(line, 0) == line->n; }

static const double *place_of(const CpsiLine *line, int j) {
    if (j <= line->drums.nodes[CPS_END_A]) return line->end[CPS_END_A].value;
    for (int k = 0; k < line->grasp_count; k++)
        if (line->grasp[k].node == j) return line->grasp[k].imposed.value;
    return line->end[CPS_END_B].value;
}

Vec3 cpsi_line_held_place(const CpsiLine *line, int j) { return vec3_load(place_of(line, j)); }

void cpsi_line_put_held(const CpsiLine *line, double *x) {
    for (int j = cpsi_line_next_held(line, 0); j < line->n; j = cpsi_line_next_held(line, j + 1))
        memcpy(&x[3 * j], place_of(line, j), 3 * sizeof *x);
}

int cpsi_line_next_held(const CpsiLine *line, int j) {
    const int last = cpsi_line_end_node(line, CPS_END_B);
    if (j <= line->drums.nodes[CPS_END_A] && cpsi_line_is_held(line, 0)) return j > 0 ? j : 0;
    for (int k = 0; k < line->grasp_count; k++)
        if (line->grasp[k].node >= j && line->grasp[k].imposed.kind == CPS_END_KIND_HELD)
            return line->grasp[k].node;
    if (j >= line->n || !cpsi_line_is_held(line, line->n - 1)) return line->n;
    return j > last ? j : last;
}

double cpsi_line_length_between(const CpsiLine *line, int i, int j) {
    const bool whole =
        i == cpsi_line_end_node(line, CPS_END_A) && j == cpsi_line_end_node(line, CPS_END_B);
    return whole ? line->length : line->arc_length[j] - line->arc_length[i];
}

bool cpsi_line_next_span(const CpsiLine *line, int j, CpsiSpan *span) {
    const int first = line->drums.nodes[CPS_END_A];
    span->from = cpsi_line_next_held(line, j < first ? first : j);
    if (span->from >= cpsi_line_end_node(line, CPS_END_B)) return false;
    span->to = cpsi_line_next_held(line, span->from + 1);
    if (span->to >= line->n) return false;
    span->length = cpsi_line_length_between(line, span->from, span->to);
    span->distance = vec3_norm(
        vec3_sub(cpsi_line_held_place(line, span->to), cpsi_line_held_place(line, span->from)));
    return true;
}

bool cpsi_line_is_span_taut(const CpsiLine *line, const CpsiSpan *span) {
    return line->compliance == 0 && span->distance >= span->length * (1 - CPSI_TAUT);
}
