/* SPDX-License-Identifier: BSD-3-Clause */
/* Friction sets (friction_set.h).
 *
 * The support function is a formula where the expression has one, and for polygons however they are
 * written. The boundary of an intersection is put together of those of its parts
 * (boundary_intersection.h), and gives its support function. For the other sets, intersections with
 * ellipses and sums of intersections, it is a small conic program; the last answers are kept, since
 * the slip of a node is asked for by the certificate, by the state of the node, and after them. */
#include "cable/friction_set.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/status.h"
#include "cable/boundary_intersection.h"
#include "cable/conic_centre.h"
#include "cable/friction_boundary.h"
#include "conic/dense_program.h"
#include "ipm/cones.h"
#include "ipm/soc.h"
#include "linalg/dense.h"
#include "set/set.h"

/* Accuracy that a support value must have to be used, relative to data of order one. */
static const double ACCEPT = 1e-9;
/* Limit of the rows of the conic form: every touching node stores a matrix of them. */
enum { MOST_ROWS = 128 };
/* Answers of small programs that are kept: about as many as a line has nodes in contact. */
enum { KEPT = 1024 };
/* The support function of a polygon and that of its corners differ by less, per reach: a few
 * roundings of the small program. */
static const double SAME_POLYGON = 1e-14;

struct CpsiFrictionSet {
    CpsiConicSet shape;
    CpsiConicForm *form;
    CpsiArena arena;
    CpsSet *closed; /* the set, where its support function is a formula; else NULL */
    double *centre, *cost;
    double (*kept)[3]; /* (KEPT) u and phi(u) of small programs, by the bits of u */
    CpsiFrictionShape boundary;
    CpsiConicProgram *program;
};

/* ---- check ---- */

CpsStatus cpsi_friction_set_check(const CpsSet *set, const char *name, CpsError *err) {
    if (cps_set_space(set) != 2)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "obstacle '%s': friction set: it lies in R^%d, expected the plane R^2",
                         name, cps_set_space(set));
    if (cpsi_set_has_user(set))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "obstacle '%s': friction set: it holds a user's set, which is known by "
                         "its support alone",
                         name);
    CpsSetFacts facts;
    const CpsStatus status = cps_set_facts(set, 0, &facts, NULL, NULL, err);
    if (status) return status;
    if (facts.outcome != CPS_SET_OUTCOME_ANSWERED)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "obstacle '%s': friction set: %s", name,
                         cps_set_outcome_text(facts.outcome));
    if (!facts.bounded)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "obstacle '%s': friction set: it is unbounded, expected a bounded one",
                         name);
    if (!facts.has_zero)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "obstacle '%s': friction set: it does not contain 0, but a node may touch "
                         "without friction",
                         name);
    return CPS_OK;
}

/* ---- make ---- */

static void layout(CpsiFrictionSet *set) {
    const CpsiConicForm *form = set->form;
    CPSI_PLACE(&set->arena, set->centre, form->unknowns);
    CPSI_PLACE(&set->arena, set->cost, form->unknowns);
    CPSI_PLACE(&set->arena, set->kept, KEPT);
    set->program =
        cpsi_conic_layout(&set->arena, form->unknowns, form->rows, form->cones, form->largest_cone);
}

static CpsStatus find_centre(CpsiFrictionSet *set, const char *name, CpsError *err) {
    bool found;
    const CpsStatus status = cpsi_conic_centre(set->form, set->centre, &found, err);
    return status || found
               ? status
               : cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "obstacle '%s': friction set: its expression has no interior "
                           "or no centre: write it with fewer operations",
                           name);
}

/* Replace a set of dimension 1 by the segment between its end points. */
static CpsStatus as_segment(const CpsSet *set, const double along[2], CpsSet **out, CpsError *err) {
    const double back[2] = {-along[0], -along[1]};
    double from[2], to[2];
    CpsSetAnswer answer;
    CpsStatus status = cps_set_support(set, back, from, &answer, err);
    if (!status) status = cps_set_support(set, along, to, &answer, err);
    return status ? status : cps_set_segment(2, from, to, out, err);
}

static void describe(CpsiFrictionSet *set, double reach) {
    const CpsiConicForm *form = set->form;
    set->shape = (CpsiConicSet){.unknowns = form->unknowns,
                                .rows = form->rows,
                                .cones = form->cones,
                                .spread = form->rows,
                                .dim = form->dim,
                                .a = form->a,
                                .b = form->b,
                                .p = form->p,
                                .origin = form->origin,
                                .centre = set->centre,
                                .reach = reach};
    for (int k = 0; k < form->cones; k++) set->shape.spread += form->dim[k] > 1;
    set->program->data =
        (CpsiConicData){.dim = form->dim, .a = form->a, .b = form->b, .c = set->cost};
}

/* The largest norm in a box round the set. */
static CpsStatus find_reach(const CpsSet *set, double *reach, CpsError *err) {
    *reach = 0;
    for (int a = 0; a < 2; a++) {
        const double w[2] = {a == 0, a == 1};
        CpsSetExtent extent;
        const CpsStatus status = cps_set_extent(set, w, &extent, err);
        if (status) return status;
        *reach = hypot(*reach, fmax(fabs(extent.low), fabs(extent.high)));
    }
    return CPS_OK;
}

/* phi(u) by the small conic program. */
static double solve_phi(const CpsiFrictionSet *set, const double u[2]) {
    const CpsiConicSet *form = &set->shape;
    const double size = hypot(u[0], u[1]);
    double largest = 0;
    for (int j = 0; j < form->unknowns; j++) {
        set->cost[j] = (form->p[j] * u[0] + form->p[form->unknowns + j] * u[1]) / size;
        largest = fmax(largest, fabs(set->cost[j]));
    }
    const double here = -cpsi_dot(2, u, form->origin);
    if (!(largest > 0)) return here;
    /* of order one, like the rows */
    for (int j = 0; j < form->unknowns; j++) set->cost[j] /= largest;
    const CpsiConicResult result = cpsi_conic_solve(set->program, ACCEPT);
    if (result.outcome != CPSI_CONIC_SOLVED) return NAN;
    return here - size * largest * cpsi_dot(form->unknowns, set->cost, result.x);
}

/* Is the set the hull of these corners, points of it that go round it counterclockwise? It is if it
 * reaches no further than each side. */
static bool has_corners(const CpsiFrictionSet *set, int count, const double *corner) {
    for (int k = 0; k < count; k++) {
        const double *a = &corner[2 * k], *b = &corner[2 * ((k + 1) % count)];
        const double inward[2] = {a[1] - b[1], b[0] - a[0]}, size = hypot(inward[0], inward[1]);
        const double beyond = solve_phi(set, inward) + cpsi_dot(2, inward, a);
        if (!(beyond <= SAME_POLYGON * set->shape.reach * size)) return false;
    }
    return count > 2;
}

/* The set, or the hull of its corners where it is a polygon, if that has a support function in
 * closed form. */
static CpsStatus find_closed(const CpsSet *of, CpsiFrictionSet *set, CpsError *err) {
    if (cpsi_support_is_closed(of)) {
        set->closed = cps_set_retain(of);
        return CPS_OK;
    }
    for (int k = 0; k < set->form->cones; k++)
        if (set->form->dim[k] > 1) return CPS_OK;
    double corner[2 * MOST_ROWS];
    int count = 0;
    CpsSetAnswer answer;
    const CpsStatus status = cps_set_vertices(of, 0, MOST_ROWS, corner, &count, &answer, err);
    if (status || answer.outcome != CPS_SET_OUTCOME_ANSWERED || count > MOST_ROWS ||
        !has_corners(set, count, corner))
        return status;
    return cps_set_hull_of_points(2, count, corner, &set->closed, err);
}

/* The largest part of an intersection with flat sides, in a box of this many reaches. */
static const double BOX = 2;
/* Boundary and small program agree about the support function up to this, per reach. */
static const double SAME_SUPPORT = 1e-9;

/* The parts of an intersection: bounded ones with a support function in closed form, and flat ones.
 */
typedef struct Parts {
    int round, flat;
    const CpsSet *round_part[MOST_ROWS], *flat_part[MOST_ROWS + 1];
} Parts;

/* Is the set, in its conic form, one of half-lines alone? */
static CpsStatus is_flat(const CpsSet *set, bool *flat, CpsError *err) {
    CpsiConicForm *form = NULL;
    const CpsStatus status = cpsi_conic_form_make(set, 1, &form, err);
    *flat = !status;
    for (int k = 0; *flat && k < form->cones; k++) *flat = form->dim[k] == 1;
    cpsi_conic_form_free(form);
    return status;
}

/* Sort the parts of an intersection, and of intersections among them. `known` becomes false where
 * there is another one. */
static CpsStatus sort_parts(const CpsSet *of, Parts *parts, bool *known, CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int k = 0; k < of->count && *known && !status; k++) {
        const CpsSet *part = of->part[k];
        double reach = INFINITY;
        bool flat = false;
        *known = parts->round < MOST_ROWS && parts->flat < MOST_ROWS;
        if (!*known) break;
        if (part->kind == CPSI_SET_INTERSECTION) {
            status = sort_parts(part, parts, known, err);
            continue;
        }
        status = is_flat(part, &flat, err);
        if (!status && !flat && cpsi_support_is_closed(part))
            status = find_reach(part, &reach, err);
        if (flat)
            parts->flat_part[parts->flat++] = part;
        else if (!status && isfinite(reach))
            parts->round_part[parts->round++] = part;
        else
            *known = false;
    }
    return status;
}

/* The boundary of what flat parts have in common, in a box. */
static CpsStatus find_flat(Parts *parts, double reach, CpsiFrictionShape *shape, CpsError *err) {
    const double far = BOX * reach, low[2] = {-far, -far}, high[2] = {far, far};
    double corner[2 * MOST_ROWS];
    int count = 0;
    CpsSet *box = NULL, *all = NULL, *hull = NULL;
    CpsSetAnswer answer = {.outcome = CPS_SET_OUTCOME_ANSWERED};
    shape->count = 0;
    CpsStatus status = cps_set_box(2, low, high, &box, err);
    parts->flat_part[parts->flat] = box;
    if (!status) status = cps_set_intersection(parts->flat + 1, parts->flat_part, &all, err);
    if (!status) status = cps_set_vertices(all, 0, MOST_ROWS, corner, &count, &answer, err);
    const bool found = answer.outcome == CPS_SET_OUTCOME_ANSWERED && count <= MOST_ROWS;
    if (!status && found) status = cps_set_hull_of_points(2, count, corner, &hull, err);
    if (hull) cpsi_friction_boundary_find(hull, 2 * far, shape);
    cps_set_release(box);
    cps_set_release(all);
    cps_set_release(hull);
    return status;
}

/* Does the small program find the support function of the boundary, at its normals and between
 * them? */
static bool is_boundary(const CpsiFrictionSet *set, const CpsiFrictionShape *shape) {
    for (int i = 0; i < shape->count; i++) {
        const double(*n)[2] = shape->piece[i].normal;
        for (int k = 0; k < 3; k++) {
            const double at[2] = {n[0][0] * (2 - k) + n[1][0] * k, n[0][1] * (2 - k) + n[1][1] * k},
                         against[2] = {-at[0], -at[1]}, size = hypot(at[0], at[1]);
            const double off = cpsi_friction_shape_support(shape, at) - solve_phi(set, against);
            if (!(fabs(off) <= SAME_SUPPORT * shape->reach * size)) return false;
        }
    }
    return shape->count > 0;
}

/* The boundary of an intersection, where those of its parts are known. A call that fails leaves it
 * unknown, but for lack of memory. */
static CpsStatus find_common(const CpsSet *of, CpsiFrictionSet *set, CpsError *err) {
    const CpsiConicSet *form = &set->shape;
    Parts parts = {.round = 0};
    bool known = of->kind == CPSI_SET_INTERSECTION;
    CpsStatus status = known ? sort_parts(of, &parts, &known, err) : CPS_OK;
    double inside[2];
    for (int a = 0; a < 2; a++)
        inside[a] =
            form->origin[a] +
            cpsi_dot(form->unknowns, &form->p[(size_t)a * (size_t)form->unknowns], form->centre);
    CpsiFrictionShape *common = &set->boundary;
    if (!status && known && parts.flat > 0) {
        status = find_flat(&parts, form->reach, common, err);
        known = common->count > 0;
    }
    for (int k = 0; k < parts.round && known && !status; k++) {
        CpsiFrictionShape part, before = *common;
        double reach;
        status = find_reach(parts.round_part[k], &reach, err);
        known = !status;
        if (known) cpsi_friction_boundary_find(parts.round_part[k], reach, &part);
        known = known && part.count > 0;
        if (known && before.count > 0) cpsi_boundary_intersect(&before, &part, inside, common);
        if (known && before.count == 0) *common = part;
        known = known && common->count > 0;
    }
    common->reach = form->reach;
    if (status || !known || !is_boundary(set, common)) common->count = 0;
    return status == CPS_ERR_MEMORY ? status : CPS_OK;
}

static CpsStatus make(const CpsSet *of, const char *name, CpsiFrictionSet *set, CpsError *err) {
    CpsStatus status = cpsi_conic_form_make(of, 1, &set->form, err);
    if (status) return status;
    const CpsiConicForm *form = set->form;
    if (form->empty || form->lines > 0 || form->unknowns == 0 || form->rows > MOST_ROWS)
        return cpsi_fail(err, CPS_ERR_LIMIT,
                         "obstacle '%s': friction set: its conic form has %d rows, expected 1 to "
                         "%d: use fewer parts",
                         name, form->rows, (int)MOST_ROWS);
    layout(set);
    if (!cpsi_arena_allocate(&set->arena))
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a friction set");
    layout(set);
    double reach;
    status = find_reach(of, &reach, err);
    if (!status) status = find_centre(set, name, err);
    if (status) return status;
    describe(set, reach);
    status = find_closed(of, set, err);
    if (!status && set->closed) cpsi_friction_boundary_find(set->closed, reach, &set->boundary);
    if (!status && !set->closed) status = find_common(of, set, err);
    return status;
}

CpsStatus cpsi_friction_set_make(const CpsSet *set, const char *name, CpsiFrictionSet **out,
                                 CpsError *err) {
    *out = NULL;
    CpsSetFacts facts;
    double basis[4];
    CpsSet *segment = NULL;
    CpsStatus status = cps_set_facts(set, 0, &facts, NULL, basis, err);
    if (status || facts.dimension == 0) return status;
    if (facts.dimension == 1) status = as_segment(set, basis, &segment, err);
    CpsiFrictionSet *made = status ? NULL : calloc(1, sizeof *made);
    if (!status && !made) status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a friction set");
    if (!status) status = make(segment ? segment : set, name, made, err);
    cps_set_release(segment);
    if (status)
        cpsi_friction_set_free(made);
    else
        *out = made;
    return status;
}

void cpsi_friction_set_free(CpsiFrictionSet *set) {
    if (!set) return;
    cps_set_release(set->closed);
    cpsi_conic_form_free(set->form);
    cpsi_arena_free(&set->arena);
    free(set);
}

const CpsiConicSet *cpsi_friction_set_conic(const CpsiFrictionSet *set) { return &set->shape; }

const CpsiFrictionShape *cpsi_friction_set_shape(const CpsiFrictionSet *set) {
    return set->boundary.count > 0 ? &set->boundary : NULL;
}

/* Where the answer for u is kept: the upper bits of a product with an odd number (Fibonacci
 * hashing).
 */
static size_t place_of(const double u[2]) {
    uint64_t bits[2];
    memcpy(bits, u, sizeof bits);
    const uint64_t mixed = (bits[0] ^ (bits[1] << 32 | bits[1] >> 32)) * 0x9E3779B97F4A7C15u;
    return (size_t)(mixed >> 54) % KEPT;
}

double cpsi_friction_set_phi(const CpsiFrictionSet *set, const double u[2]) {
    const double size = hypot(u[0], u[1]), against[2] = {-u[0], -u[1]};
    if (!(size > 0)) return size;
    CpsSetAnswer answer;
    if (set->closed && cpsi_support(set->closed, against, NULL, &answer, NULL) == CPS_OK &&
        answer.outcome == CPS_SET_OUTCOME_ANSWERED)
        return answer.value;
    if (set->boundary.count > 0) return cpsi_friction_shape_support(&set->boundary, against);
    double *kept = set->kept[place_of(u)];
    if (kept[0] != u[0] || kept[1] != u[1]) {
        kept[2] = solve_phi(set, u);
        kept[0] = u[0];
        kept[1] = u[1];
    }
    return kept[2];
}
