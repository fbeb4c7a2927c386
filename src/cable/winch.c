/* SPDX-License-Identifier: BSD-3-Clause */
/* Winches (winch.h).
 *
 * Nodes are points of the line. Those that are on a drum are held where the end is held; the
 * elements between them are slack and weightless. The line leaves the drum at the last of them, by
 * an element as long as what is paid out of it: it grows until its next node leaves the drum. So a
 * node comes off the drum, and goes onto it, at the place of the drum, with nothing that jumps. */
#include "cable/winch.h"

#include <string.h>

#include "cable/soft.h"

/* A node within this share of its element from the drum is on it: no element is shorter. What the
 * shape of the line changes by is of third order in this length. */
static const double NEAR_DRUM = 1e-3;

void cpsi_winch_keep(CpsiLine *line) {
    CpsiDrums *drums = &line->drums;
    if (!cpsi_line_has_winch(line)) return;
    memcpy(drums->length, line->element_length, (size_t)(line->n - 1) * sizeof *drums->length);
    memcpy(drums->place, line->arc_length, (size_t)line->n * sizeof *drums->place);
    for (int j = 0; j < line->n; j++) {
        double own = 0;
        if (j > 0) own += 0.5 * drums->length[j - 1] * line->weight_factor[j - 1];
        if (j + 1 < line->n) own += 0.5 * drums->length[j] * line->weight_factor[j];
        drums->hung[j] = line->weight_length[j] - own;
    }
}

/* The nodes at which the line leaves the drums, where it is off them from `low` to `high`. */
static void find_nodes(CpsiLine *line, double low, double high) {
    CpsiDrums *drums = &line->drums;
    int first = 0, last = line->n - 1;
    while (first < line->n - 2 &&
           drums->place[first + 1] <= low + NEAR_DRUM * drums->length[first + 1])
        first++;
    while (last > first + 1 && drums->place[last - 1] >= high - NEAR_DRUM * drums->length[last - 2])
        last--;
    drums->nodes[CPS_END_A] = first;
    drums->nodes[CPS_END_B] = line->n - 1 - last;
}

/* The weight of nodes, and what is on the drums, where the line is off them from `low` to `high`.
 */
static void find_weights(CpsiLine *line, double low, double high) {
    CpsiDrums *drums = &line->drums;
    const int first = cpsi_line_end_node(line, CPS_END_A),
              last = cpsi_line_end_node(line, CPS_END_B);
    drums->weight[CPS_END_A] = drums->weight[CPS_END_B] = 0;
    for (int j = 0; j < line->n; j++) line->weight_length[j] = 0;
    for (int e = 0; e + 1 < line->n; e++) {
        const double factor = line->weight_factor[e], from = drums->place[e],
                     to = from + drums->length[e];
        if (e <= first) drums->weight[CPS_END_A] += factor * (fmin(low, to) - fmin(low, from));
        if (e >= last - 1) drums->weight[CPS_END_B] += factor * (fmax(high, to) - fmax(high, from));
        if (cpsi_line_is_on_drum(line, e)) continue;
        line->weight_length[e] += 0.5 * line->element_length[e] * factor;
        line->weight_length[e + 1] += 0.5 * line->element_length[e] * factor;
    }
    for (int j = 0; j < line->n; j++)
        if (j <= first && first > 0)
            drums->weight[CPS_END_A] += drums->hung[j];
        else if (j >= last && last < line->n - 1)
            drums->weight[CPS_END_B] += drums->hung[j];
        else
            line->weight_length[j] += drums->hung[j];
}

void cpsi_winch_set(CpsiLine *line, const double stored[2]) {
    CpsiDrums *drums = &line->drums;
    if (!cpsi_line_has_winch(line)) return;
    const double low = stored[CPS_END_A], high = drums->place[line->n - 1] - stored[CPS_END_B];
    memcpy(drums->stored, stored, sizeof drums->stored);
    find_nodes(line, low, high);
    const int first = cpsi_line_end_node(line, CPS_END_A),
              last = cpsi_line_end_node(line, CPS_END_B);
    memcpy(line->element_length, drums->length,
           (size_t)(line->n - 1) * sizeof *line->element_length);
    line->element_length[first] -= low - drums->place[first];
    line->element_length[last - 1] -= drums->place[last] - high;
    line->length = high - low;
    for (int j = 0; j < line->n; j++)
        line->arc_length[j] = j <= first ? 0 : j >= last ? line->length : drums->place[j] - low;
    find_weights(line, low, high);
}

void cpsi_winch_wind(CpsiLine *line) {
    CpsiDrums *drums = &line->drums;
    if (!cpsi_line_has_winch(line)) return;
    drums->moved = drums->due[CPS_END_A] != drums->stored[CPS_END_A] ||
                   drums->due[CPS_END_B] != drums->stored[CPS_END_B];
    if (drums->moved) cpsi_winch_set(line, drums->due);
}

void cpsi_winch_unload(CpsiLine *line) {
    for (int e = 0; e + 1 < line->n; e++) {
        if (!cpsi_line_is_on_drum(line, e)) continue;
        memset(&line->segment_force[3 * e], 0, 3 * sizeof *line->segment_force);
        line->tension[e] = 0;
    }
}

double cpsi_winch_pull(const CpsiLine *line, int end, bool before) {
    const double *weight = before ? line->weight_before : line->weight;
    const int j = cpsi_line_end_node(line, end), e = end == CPS_END_A ? j : j - 1;
    const int beside = end == CPS_END_A ? j + 1 : j - 1;
    const Vec3 x = vec3_at(line->position, j), next = vec3_at(line->position, beside);
    const CpsiElementLaw law = cpsi_line_law(line, e);
    const double tension = line->tension[e];
    return tension + cpsi_law_conjugate(&law, tension) -
           0.5 * line->weight_factor[e] * vec3_dot(vec3_load(weight), vec3_sub(x, next)) -
           0.5 * cpsi_soft_per_length(line, beside, before);
}
