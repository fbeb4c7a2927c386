/* SPDX-License-Identifier: BSD-3-Clause */
/* A step's data, copied and sampled on cells (see step_data.h). */
#include "regularized/step_data.h"

#include <math.h>
#include <string.h>

#include "base/status.h"
#include "regularized/band_blocks.h"

static void layout(CpsiCells *c, int cells, CpsiArena *arena) {
    const size_t n = (size_t)cells + 1;
    c->cells = cells;
    CPSI_PLACE(arena, c->width, cells);
    CPSI_PLACE(arena, c->bend, cells);
    CPSI_PLACE(arena, c->arc, n);
    CPSI_PLACE(arena, c->share, n);
    CPSI_PLACE(arena, c->reference, 3 * n);
    CPSI_PLACE(arena, c->normal, 3 * n);
    CPSI_PLACE(arena, c->gap, n);
    CPSI_PLACE(arena, c->bound, n);
    CPSI_PLACE(arena, c->factor, n);
    CPSI_PLACE(arena, c->load, 3 * n);
    CPSI_PLACE(arena, c->tension, cells);
    CPSI_PLACE(arena, c->position, 3 * n);
}

/* ---- the step ---- */

static void fill_own(CpsiCells *own, const CpsLineView *view) {
    const size_t elements = (size_t)view->element_count, n = elements + 1;
    memcpy(own->width, view->element_length, elements * sizeof(double));
    memcpy(own->arc, view->arc_length, n * sizeof(double));
    memcpy(own->reference, view->reference, 3 * n * sizeof(double));
    memcpy(own->normal, view->normal, 3 * n * sizeof(double));
    memcpy(own->gap, view->gap, n * sizeof(double));
    memcpy(own->bound, view->friction_bound, n * sizeof(double));
    memcpy(own->load, view->load, 3 * n * sizeof(double));
    memcpy(own->tension, view->tension, elements * sizeof(double));
    memcpy(own->position, view->position, 3 * n * sizeof(double));
    for (size_t j = 0; j < n; ++j) own->factor[j] = view->friction_factor[j];
    for (size_t i = 0; i < elements; ++i) {
        own->share[i] += own->width[i] / 2;
        own->share[i + 1] += own->width[i] / 2;
        /* |x''|^2 between the middles of neighbouring cells; before the first one u = 0 at a = 0 */
        own->bend[i] = 2 / (own->width[i] + (i > 0 ? own->width[i - 1] : 0));
    }
}

/* J** + j of the view, with the elastic part from its tensions and not from positions */
static double energy_of(const CpsiCells *own, double compliance) {
    double energy = 0;
    for (int i = 0; i < own->cells; ++i)
        energy += own->width[i] * compliance * own->tension[i] * own->tension[i] / 2;
    for (int j = 0; j <= own->cells; ++j) {
        const Vec3 x = vec3_at(own->position, j), u = vec3_sub(x, vec3_at(own->reference, j)),
                   n = vec3_at(own->normal, j);
        const Vec3 slip = vec3_reject(u, n);
        energy += own->bound[j] * vec3_norm(slip) - vec3_dot(vec3_at(own->load, j), x);
    }
    return energy;
}

static double force_of(const CpsiCells *own) {
    double most = 0, sum = 0;
    for (int i = 0; i < own->cells; ++i) most = fmax(most, own->tension[i]);
    for (int j = 0; j <= own->cells; ++j) sum += vec3_norm(vec3_at(own->load, j));
    return fmax(most, sum);
}

CpsStatus cpsi_step_copy(const CpsLineView *view, CpsiStep *step, CpsError *err) {
    if (view->end[CPS_END_A].kind != CPS_END_KIND_HELD)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s': end A is free, but the method keeps x(0) in place (S90 (8)): "
                         "hold end A, or turn the line round",
                         view->name);
    if (!(view->compliance > 0))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s' is inextensible: the method of 1990 has no multiplier for "
                         "that; give it a stiffness much larger than its tension",
                         view->name);
    if (!view->uniform)
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "line '%s' has sections, point weights or a dynamic stiffness: the method of "
            "1990 has one stiffness and one weight",
            view->name);
    if (view->spring_count > 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s' has a table of strain and tension: the method of 1990 has one "
                         "stiffness",
                         view->name);
    if (!view->one_plane)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s': more than one obstacle, or one that is curved, gives or has "
                         "directions, a node that is grasped, a winch, springs, loads or drag; the "
                         "paper's step slides in one tangent plane with one coefficient: use plane "
                         "obstacles with friction alone",
                         view->name);
    *step = (CpsiStep){.compliance = view->compliance,
                       .held = view->end[CPS_END_B].kind == CPS_END_KIND_HELD};
    layout(&step->own, view->element_count, &step->arena);
    if (!cpsi_arena_allocate(&step->arena)) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    layout(&step->own, view->element_count, &step->arena);
    fill_own(&step->own, view);
    step->length = view->arc_length[view->element_count];
    if (!step->held) memcpy(step->end_force, view->end[CPS_END_B].value, sizeof step->end_force);
    step->energy = energy_of(&step->own, step->compliance);
    step->force = force_of(&step->own);
    if (step->force > 0) return CPS_OK;
    cpsi_arena_free(&step->arena);
    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                     "line '%s': no load and no tension in this step: there is nothing to compare",
                     view->name);
}

/* ---- external approximations ---- */

/* The element of `own` that contains arc, searched from *i onward. Returns the position in it,
 * 0..1. */
static double locate(const CpsiCells *own, double arc, int *i) {
    while (*i + 1 < own->cells && own->arc[*i + 1] < arc) ++*i;
    const double t = (arc - own->arc[*i]) / own->width[*i];
    return t <= 0 ? 0 : t >= 1 ? 1 : t;
}

/* exact at both ends, even where the other end is infinite */
static double mix(double t, double a, double b) {
    return t <= 0 ? a : t >= 1 ? b : (1 - t) * a + t * b;
}

static void mix3(double t, const double *v, int i, double out[3]) {
    for (int k = 0; k < 3; ++k)
        out[k] = mix(t, v[3 * (size_t)i + (size_t)k], v[3 * (size_t)(i + 1) + (size_t)k]);
}

double cpsi_zone_ratio(const CpsiCells *cells, int place, int next) {
    return cells->factor[next] > 0 ? cells->factor[place] / cells->factor[next] : 0;
}

/* friction bound per length; a held node has none and gets its neighbour's with its own zone
 * factor */
static double bound_at(const CpsiStep *step, int node) {
    const CpsiCells *own = &step->own;
    const int from = node == 0 ? 1 : node == own->cells && step->held ? own->cells - 1 : node;
    return own->bound[from] / own->share[from] *
           (from == node ? 1 : cpsi_zone_ratio(own, node, from));
}

/* all data at place j of the external cells, from element i and position t along it */
static void sample(CpsiCells *c, int j, const CpsiStep *step, int i, double t) {
    const CpsiCells *own = &step->own;
    const size_t k = 3 * (size_t)j;
    mix3(t, own->reference, i, c->reference + k);
    mix3(t, own->position, i, c->position + k);
    mix3(t, own->normal, i, c->normal + k);
    const Vec3 n = vec3_at(c->normal, j);
    const double norm = vec3_norm(n);
    if (norm > 0) vec3_store(c->normal + k, vec3_scale(1 / norm, n));
    c->gap[j] = mix(t, own->gap[i], own->gap[i + 1]);
    c->bound[j] = c->share[j] * mix(t, bound_at(step, i), bound_at(step, i + 1));
    c->factor[j] = mix(t, own->factor[i], own->factor[i + 1]);

    /* loads per length without the force on end B, which remains on the last place */
    for (int x = 0; x < 3; ++x) {
        double per[2];
        for (int side = 0; side < 2; ++side) {
            const int node = i + side;
            const double end = node == own->cells ? step->end_force[x] : 0;
            per[side] = (own->load[3 * (size_t)node + (size_t)x] - end) / own->share[node];
        }
        c->load[k + (size_t)x] =
            c->share[j] * mix(t, per[0], per[1]) + (j == c->cells ? step->end_force[x] : 0);
    }
}

static void fill_external(CpsiCells *c, const CpsiStep *step) {
    const double h = step->length / c->cells;
    c->arc[0] = h / 2;
    for (int i = 0; i < c->cells; ++i) {
        c->width[i] = i + 1 < c->cells ? h : h / 2;
        c->bend[i] = c->width[i] / (h * h);
        c->arc[i + 1] = i + 1 < c->cells ? (i + 1.5) * h : step->length;
        c->share[i] += c->width[i] / 2;
        c->share[i + 1] += c->width[i] / 2;
        c->tension[i] = cpsi_between_middles(step->own.cells, step->own.arc, step->own.tension,
                                             i + 1 < c->cells ? (i + 1) * h : step->length - h / 4);
    }
    c->share[0] += h / 2;
    for (int j = 0, i = 0; j <= c->cells; ++j) {
        const double t = locate(&step->own, c->arc[j], &i);
        sample(c, j, step, i, t);
    }
    /* u = 0 up to h/2: the first place remains where end A is, and its part of j_delta is a
     * constant */
    memcpy(c->reference, step->own.reference, 3 * sizeof(double));
    memcpy(c->position, step->own.position, 3 * sizeof(double));
}

void cpsi_cells_place(CpsiCells *out, const CpsiStep *step, int cells, CpsiArena *arena) {
    if (cells == 0) {
        *out = step->own;
        return;
    }
    layout(out, cells, arena);
    if (arena->base) fill_external(out, step);
}

double cpsi_between_middles(int cells, const double *arc, const double *value, double at) {
    int low = 0, high = cells - 1;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if ((arc[middle] + arc[middle + 1]) / 2 <= at)
            low = middle;
        else
            high = middle;
    }
    const double from = (arc[low] + arc[low + 1]) / 2, to = (arc[high] + arc[high + 1]) / 2;
    return high > low ? mix((at - from) / (to - from), value[low], value[high]) : value[low];
}
