/* SPDX-License-Identifier: BSD-3-Clause */
/* Reduced copies of the lines for the pictures.
 *
 * The copies are those of the steps with their own pictures, an even selection for the overviews,
 * and always the last step so far, which the next step overwrites unless it is one of the
 * others. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io/results/writers.h"

enum {
    MAX_OVERVIEW = 48,      /* number of curves that an overview can show */
    MAX_LINE_POINTS = 2000, /* per line: more than the pixels of a picture */
    MAX_POINTS = 20000      /* of all lines together */
};

static bool is_kept(const CpsResults *results, int step) {
    if (results->has_pace)
        return cpsi_results_passes(results, step, MAX_OVERVIEW) ||
               cpsi_results_pictured(results, step);
    const int stride = (results->planned_steps + MAX_OVERVIEW - 1) / MAX_OVERVIEW;
    return stride < 2 || step % stride == 0 || cpsi_results_pictured(results, step);
}

void cpsi_snapshot_free(CpsiSnapshot *snapshot) {
    free(snapshot->shape[0].position);
    free(snapshot->shape);
    *snapshot = (CpsiSnapshot){0};
}

static int point_count(const CpsResults *results, int elements) {
    int most = MAX_POINTS / results->line_count;
    if (most > MAX_LINE_POINTS) most = MAX_LINE_POINTS;
    if (most < 2) most = 2;
    return elements < most ? elements + 1 : most;
}

/* node of the line for point i of the shape; the first and the last node are always included */
static size_t node_of(int i, int points, int elements) {
    return (size_t)((int64_t)i * elements / (points - 1));
}

/* State of the node. A node without contact but with friction, the frozen friction of the
 * reference, has its own state. */
static unsigned char shown_state(const CpsLineView *view, size_t j) {
    const size_t n = (size_t)view->element_count + 1;
    const unsigned char state = cpsi_node_state(view, (int)j);
    if (state == CPS_NODE_STATE_FREE)
        for (size_t c = j; c < (size_t)view->contact_count * n; c += n) {
            const double *f = view->friction_force + 3 * c;
            if (fabs(f[0]) + fabs(f[1]) + fabs(f[2]) > 0) return CPSI_SHAPE_IN_AIR;
        }
    return state;
}

static void sample(CpsiShape *shape, const CpsLineView *view) {
    for (int i = 0; i < shape->points; ++i) {
        const size_t j = node_of(i, shape->points, view->element_count);
        shape->abscissa[i] = view->arc_length[j];
        shape->state[i] = shown_state(view, j);
        memcpy(shape->position + 3 * (size_t)i, view->position + 3 * j, 3 * sizeof(double));
        memcpy(shape->reference + 3 * (size_t)i, view->reference + 3 * j, 3 * sizeof(double));
        if (i == 0) continue;
        const size_t start = node_of(i - 1, shape->points, view->element_count);
        double sum = 0;
        for (size_t k = start; k < j; ++k) sum += view->tension[k] * view->element_length[k];
        shape->tension[i - 1] = sum / (view->arc_length[j] - view->arc_length[start]);
    }
}

static bool take(CpsResults *results, const CpsEvolution *evolution, CpsiSnapshot *out) {
    const size_t lines = (size_t)results->line_count;
    *out =
        (CpsiSnapshot){.step = results->row_count - 1, .shape = calloc(lines, sizeof *out->shape)};
    if (!out->shape) return false;

    /* one block for all lines: 8 doubles and a state per point */
    size_t total = 0;
    for (size_t i = 0; i < lines; ++i) {
        out->shape[i].points =
            point_count(results, cps_evolution_line_view(evolution, (int)i).element_count);
        total += (size_t)out->shape[i].points;
    }
    double *block = malloc(total * (8 * sizeof(double) + 1));
    if (!block) {
        free(out->shape);
        return false;
    }
    unsigned char *state = (unsigned char *)(block + 8 * total);
    for (size_t i = 0; i < lines; ++i) {
        CpsiShape *shape = &out->shape[i];
        const size_t points = (size_t)shape->points;
        shape->position = block;
        shape->reference = block + 3 * points;
        shape->abscissa = block + 6 * points;
        shape->tension = block + 7 * points;
        shape->state = state;
        block += 8 * points;
        state += points;
        const CpsLineView view = cps_evolution_line_view(evolution, (int)i);
        sample(shape, &view);
    }
    return true;
}

bool cpsi_snapshot_append(CpsResults *results, const CpsEvolution *evolution) {
    CpsiSnapshot snapshot;
    if (!take(results, evolution, &snapshot)) return false;

    /* overwrite the last one unless it is to be kept */
    if (results->snapshot_count > 0) {
        CpsiSnapshot *last = &results->snapshot[results->snapshot_count - 1];
        if (!is_kept(results, last->step)) {
            cpsi_snapshot_free(last);
            *last = snapshot;
            return true;
        }
    }
    if (results->snapshot_count == results->snapshot_capacity) {
        const size_t capacity =
            results->snapshot_capacity ? 2 * (size_t)results->snapshot_capacity : 16;
        CpsiSnapshot *grown = realloc(results->snapshot, capacity * sizeof *grown);
        if (!grown) {
            cpsi_snapshot_free(&snapshot);
            return false;
        }
        results->snapshot = grown;
        results->snapshot_capacity = (int)capacity;
    }
    results->snapshot[results->snapshot_count++] = snapshot;
    return true;
}
