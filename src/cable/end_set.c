/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends of a line that are held to convex sets (end_set.h). */
#include "cable/end_set.h"

#include <math.h>
#include <string.h>

#include "cable/held.h"
#include "cable/line.h"
#include "cable/place_form.h"
#include "chain/elements.h"
#include "chain/frame.h"

bool cpsi_line_has_sets(const CpsiLine *line) {
    return line->on[CPS_END_A].is_there || line->on[CPS_END_B].is_there;
}

/* The set of node j, or NULL. */
static const CpsiEndSet *set_of(const CpsiLine *line, int j) {
    if (j == 0 && line->on[CPS_END_A].is_there) return &line->on[CPS_END_A];
    if (j == line->n - 1 && line->on[CPS_END_B].is_there) return &line->on[CPS_END_B];
    return NULL;
}

/* sup over y in the set of v.(y - x), v in its own axes. */
static double gap_of(const CpsiEndSet *on, const double v[3], Vec3 x) {
    return on->form ? cpsi_place_form_gap(on->form, vec3_load(v), x)
                    : cpsi_place_set_gap(&on->set, v, x);
}

Vec3 cpsi_end_set_project(const CpsiEndSet *on, Vec3 x) {
    return on->form ? cpsi_place_form_nearest(on->form, x) : cpsi_place_set_project(&on->set, x);
}

bool cpsi_line_is_in_set(const CpsiLine *line, int j) { return set_of(line, j); }

Vec3 cpsi_line_set_reaction(const CpsiLine *line, int j) {
    const CpsiEndSet *on = set_of(line, j);
    return on ? cpsi_place_set_from(&on->set, on->reaction) : vec3(0, 0, 0);
}

double cpsi_end_set_gap(const CpsiEndSet *on, Vec3 x) {
    const double outwards[3] = {-on->reaction[0], -on->reaction[1], -on->reaction[2]};
    return fabs(gap_of(on, outwards, x));
}

double cpsi_line_set_gap(const CpsiLine *line, int j) {
    const CpsiEndSet *on = set_of(line, j);
    return on ? cpsi_end_set_gap(on, vec3_at(line->position, j)) : 0;
}

void cpsi_line_clear_set_reactions(CpsiLine *line) {
    for (int end = 0; end < 2; end++)
        memset(line->on[end].reaction, 0, sizeof line->on[end].reaction);
}

/* May the reaction of a set have the component `own` along its axis a? */
static bool may_have(const CpsiPlaceSet *set, int a, double own) {
    if (a < set->round || own == 0) return true;
    return own > 0 ? isfinite(set->low[a]) : isfinite(set->high[a]);
}

Vec3 cpsi_line_sets_take(CpsiLine *line, Vec3 rest) {
    for (int end = 0; end < 2; end++) {
        CpsiEndSet *on = &line->on[end];
        if (!on->is_there) continue;
        double own[3];
        cpsi_place_set_to(&on->set, rest, own);
        for (int a = 0; a < 3; a++) {
            if (!may_have(&on->set, a, on->reaction[a] - own[a])) continue;
            on->reaction[a] -= own[a];
            own[a] = 0;
        }
        rest = cpsi_place_set_from(&on->set, own);
    }
    return rest;
}

/* One row by x + at of a constraint; direction in the common axes. */
static void add_row(CpsiConstraint *out, int row, Vec3 direction, double at, const double *axes) {
    double common[3];
    vec3_store(common, direction);
    cpsi_frame_to(out->a[row], axes, common);
    out->b[row] = at;
}

/* The cones of a set: an equation where an interval is a point, a half-line for each end of one, a
 * second-order cone for the round axes. Along these the reaction is the dual of the row. */
static void fill_set(const CpsiPlaceSet *set, CpsiConstraint *out, Vec3 base, double length,
                     const double *axes) {
    double y[3];
    int row = 0;
    cpsi_place_set_to(set, vec3_sub(base, set->centre), y);
    for (int a = set->round; a < 3; a++) {
        const Vec3 axis = vec3_at(set->axes, a);
        const bool point = set->low[a] == set->high[a];
        if (isfinite(set->low[a])) {
            out->dim[out->cones++] = point ? 0 : 1;
            add_row(out, row++, axis, (y[a] - set->low[a]) / length, axes);
        }
        if (isfinite(set->high[a]) && !point) {
            out->dim[out->cones++] = 1;
            add_row(out, row++, vec3_scale(-1, axis), (set->high[a] - y[a]) / length, axes);
        }
    }
    if (set->round == 0) return;
    out->dim[out->cones++] = set->round + 1;
    add_row(out, row++, vec3(0, 0, 0), set->radius / length, axes);
    for (int a = 0; a < set->round; a++)
        add_row(out, row++, vec3_at(set->axes, a), y[a] / length, axes);
}

void cpsi_end_set_fill(const CpsiEndSet *on, int j, Vec3 base, const double *axes, double length,
                       CpsiConstraints *out) {
    if (on->form) {
        cpsi_place_form_fill(on->form, j, base, axes, length);
        out->conic[out->conic_count++] = cpsi_place_form_constraint(on->form);
        return;
    }
    CpsiConstraint *of = &out->item[out->count++];
    *of = (CpsiConstraint){.node = j};
    fill_set(&on->set, of, base, length, axes);
}

void cpsi_line_fill_sets(const CpsiLine *line, CpsiChainProgram *program, const double *base,
                         const double *axes, bool common) {
    CpsiConstraints *out = &program->constraints;
    out->count = out->conic_count = 0;
    for (int end = 0; end < 2; end++) {
        const int j = end == CPS_END_A ? 0 : line->n - 1;
        if (line->on[end].is_there)
            cpsi_end_set_fill(&line->on[end], j, vec3_at(base, j), common ? axes : &axes[9 * j],
                              line->length, out);
    }
}

/* The reaction of a set in its own axes, from the duals. */
static void read_reaction(const CpsiPlaceSet *set, const CpsiConstraint *of, double force,
                          double own[3]) {
    int row = 0;
    memset(own, 0, 3 * sizeof *own);
    for (int a = set->round; a < 3; a++) {
        if (isfinite(set->low[a])) own[a] += force * of->z[row++];
        if (isfinite(set->high[a]) && set->low[a] != set->high[a]) own[a] -= force * of->z[row++];
    }
    for (int a = 0; a < set->round; a++) own[a] = force * of->z[row + 1 + a];
}

void cpsi_line_unpack_sets(CpsiLine *line, const CpsiChainProgram *program, double force) {
    const CpsiConstraints *from = &program->constraints;
    if (from->count + from->conic_count == 0) return;
    for (int end = 0, k = 0; end < 2; end++) {
        CpsiEndSet *on = &line->on[end];
        if (!on->is_there) continue;
        double *x = &line->position[3 * (end == CPS_END_A ? 0 : line->n - 1)];
        if (on->form) {
            const double *of = cpsi_place_form_constraint(on->form)->force;
            for (int a = 0; a < 3; a++) on->reaction[a] = force * of[a];
        } else {
            read_reaction(&on->set, &from->item[k++], force, on->reaction);
        }
        const Vec3 found = vec3_load(x);
        vec3_store(x, on->form ? cpsi_place_form_place(on->form, found)
                               : cpsi_place_set_project(&on->set, found));
    }
}

/* Rounding of the components of a unit vector: along a direction without end it counts as 0. */
static const double ROUNDING = 1e-12;

double cpsi_end_set_beyond(const CpsiEndSet *on, Vec3 v, Vec3 x) {
    const CpsiPlaceSet *set = &on->set;
    double own[3];
    cpsi_place_set_to(set, v, own);
    for (int a = set->round; a < 3; a++)
        if (fabs(own[a]) < ROUNDING && isinf(own[a] > 0 ? set->high[a] : set->low[a])) own[a] = 0;
    return gap_of(on, own, x);
}

/* Alternating projections approach the nearest places of two convex sets. Who proves by them takes
 * the sets' support functions along the vector between, which hold wherever they have come to. */
enum { NEARINGS = 1000, FORM_NEARINGS = 50 };

/* The nearest places of two sets, b in the second; of a place and a set where `first` is NULL. */
static void find_nearest(const CpsiEndSet *first, const CpsiEndSet *second, Vec3 *a, Vec3 *b) {
    *b = cpsi_end_set_project(second, *a);
    if (!first) return;
    const int most = first->form || second->form ? FORM_NEARINGS : NEARINGS;
    for (int i = 0; i < most; i++) {
        const Vec3 before = *a;
        *a = cpsi_end_set_project(first, *b);
        *b = cpsi_end_set_project(second, *a);
        if (vec3_norm(vec3_sub(*a, before)) == 0) return;
    }
}

static int last_held(const CpsiLine *line) {
    int last = line->n;
    for (int j = cpsi_line_next_held(line, 0); j < line->n; j = cpsi_line_next_held(line, j + 1))
        last = j;
    return last;
}

bool cpsi_line_set_distance(const CpsiLine *line, double *distance, double *length, Vec3 *apart) {
    const CpsiEndSet *a = &line->on[CPS_END_A], *b = &line->on[CPS_END_B];
    const int held = cpsi_line_next_held(line, 0);
    bool found = false;
    *distance = 0;
    for (int end = 0; end < 2; end++) {
        const CpsiEndSet *to = &line->on[end];
        const bool both = held == line->n;
        if (!to->is_there || (both && (end == CPS_END_A || !a->is_there || !b->is_there))) continue;
        const int last = end == CPS_END_A ? held : last_held(line);
        Vec3 x = both ? vec3_load(line->position) : cpsi_line_held_place(line, last), y;
        find_nearest(both ? a : NULL, to, &x, &y);
        const double size = vec3_norm(vec3_sub(y, x)),
                     between =
                         both ? line->length
                              : cpsi_line_length_between(line, end == CPS_END_A ? 0 : last,
                                                         end == CPS_END_A ? last : line->n - 1);
        if (!(size > 0)) continue;
        const Vec3 v = vec3_scale(1 / size, vec3_sub(y, x));
        double least = size - cpsi_end_set_beyond(to, vec3_scale(-1, v), y);
        if (both) least -= cpsi_end_set_beyond(a, v, x);
        if (found && least - between <= *distance - *length) continue;
        *distance = least;
        *length = between;
        *apart = v;
        found = true;
    }
    return found;
}

/* Projections to and fro between two cones, until they stay: between lines that meet at a small
 * angle they take longer, and where they stay is in one of them alone. */
enum { PROJECTIONS = 200 };

Vec3 cpsi_line_sets_let(const CpsiLine *line, Vec3 v) {
    const double size = vec3_norm(v);
    for (int i = 0; i < PROJECTIONS && cpsi_line_has_sets(line); i++)
        for (int end = 0; end < 2; end++)
            if (line->on[end].is_there) v = cpsi_place_set_recedes(&line->on[end].set, v);
    bool lets = vec3_norm(v) > ROUNDING * size;
    for (int end = 0; end < 2; end++) {
        if (!line->on[end].is_there) continue;
        const Vec3 along = cpsi_place_set_recedes(&line->on[end].set, v);
        lets = lets && vec3_norm(vec3_sub(v, along)) <= ROUNDING * vec3_norm(v);
    }
    return lets ? v : vec3(0, 0, 0);
}
