/* SPDX-License-Identifier: BSD-3-Clause */
/* Convex sets of places in conic form (place_form.h).
 *
 * The support function is a formula where the expression has one, else a small conic program. The
 * nearest place is the least t with |origin + P v - x| <= t size in one more cone. */
#include "cable/place_form.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/status.h"
#include "cable/conic_centre.h"
#include "chain/frame.h"
#include "conic/dense_program.h"
#include "ipm/cones.h"
#include "linalg/dense.h"
#include "set/set.h"

/* Accuracy that a value must have to be used, relative to data of order one. */
static const double ACCEPT = 1e-9;
/* A place beyond the boundary goes inwards by at most this share of the way to the centre. */
static const double INWARDS = 1e-9;
/* Limit of the rows of the conic form, and with them of the work of an iteration. */
enum { MOST_ROWS = 128 };

struct CpsiPlaceForm {
    CpsiConicSet set;
    CpsiConicForm *form;
    CpsiArena arena;
    CpsSet *closed; /* the set, where its support function is a formula; else NULL */
    Vec3 middle;    /* a place of the set, about which the form is written */
    CpsiConicConstraint constraint;
    double origin[3];        /* [m] of the set's form about that of the scene */
    double *centre, *inside; /* (unknowns) */
    CpsiConicProgram *support, *nearest;
    double *cost;      /* (unknowns) of the support */
    double *a, *b, *c; /* of the nearest place */
    int *dim;
};

static CpsStatus check(const CpsSet *set, double middle[3], CpsError *err) {
    CpsSetFacts facts;
    if (!set) return cpsi_fail(err, CPS_ERR_ARGUMENT, "is NULL");
    if (cps_set_space(set) != 3)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "lies in R^%d, expected R^3", cps_set_space(set));
    if (cpsi_set_has_user(set))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "holds a user's set, which is known by its support alone");
    const CpsStatus status = cps_set_facts(set, 0, &facts, middle, NULL, err);
    if (status) return status;
    if (facts.outcome != CPS_SET_OUTCOME_ANSWERED)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "has no answer: %s",
                         cps_set_outcome_text(facts.outcome));
    if (!facts.bounded)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "is unbounded: intersect it with a box that the line does not leave");
    return CPS_OK;
}

static void layout(CpsiPlaceForm *of) {
    const CpsiConicForm *form = of->form;
    const size_t n = (size_t)form->unknowns, m = (size_t)form->rows;
    CPSI_PLACE(&of->arena, of->centre, n);
    CPSI_PLACE(&of->arena, of->inside, n);
    CPSI_PLACE(&of->arena, of->cost, n);
    CPSI_PLACE(&of->arena, of->a, (m + 4) * (n + 1));
    CPSI_PLACE(&of->arena, of->b, m + 4);
    CPSI_PLACE(&of->arena, of->c, n + 1);
    CPSI_PLACE(&of->arena, of->dim, form->cones + 1);
    cpsi_conic_constraint_layout(&of->constraint, &of->arena, &of->set);
    if (n == 0) return;
    of->support =
        cpsi_conic_layout(&of->arena, form->unknowns, form->rows, form->cones, form->largest_cone);
    of->nearest = cpsi_conic_layout(&of->arena, form->unknowns + 1, form->rows + 4, form->cones + 1,
                                    form->largest_cone > 4 ? form->largest_cone : 4);
}

/* The parts of the program of the nearest place that do not depend on the place. */
static void fill_nearest(CpsiPlaceForm *of) {
    const CpsiConicForm *form = of->form;
    const size_t n = (size_t)form->unknowns, m = (size_t)form->rows, width = n + 1;
    for (size_t i = 0; i < m; i++) memcpy(&of->a[i * width], &form->a[i * n], n * sizeof *of->a);
    memcpy(of->b, form->b, m * sizeof *of->b);
    memcpy(of->dim, form->dim, (size_t)form->cones * sizeof *of->dim);
    of->dim[form->cones] = 4;
    of->a[m * width + n] = of->c[n] = 1;
    for (size_t a = 0; a < 3; a++)
        for (size_t j = 0; j < n; j++)
            of->a[(m + 1 + a) * width + j] = form->p[a * n + j] / form->size;
    of->nearest->data = (CpsiConicData){.dim = of->dim, .a = of->a, .b = of->b, .c = of->c};
    of->support->data =
        (CpsiConicData){.dim = form->dim, .a = form->a, .b = form->b, .c = of->cost};
}

static CpsStatus make(const CpsSet *of, CpsiPlaceForm *out, CpsError *err) {
    CpsStatus status = cpsi_conic_form_make(of, 1, &out->form, err);
    if (status) return status;
    const CpsiConicForm *form = out->form;
    bool found = true;
    if (form->empty || form->lines > 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "is empty or unbounded");
    if (form->rows > MOST_ROWS)
        return cpsi_fail(err, CPS_ERR_LIMIT,
                         "has a conic form of %d rows, expected at most %d: use fewer parts",
                         form->rows, (int)MOST_ROWS);
    out->set = (CpsiConicSet){.unknowns = form->unknowns,
                              .rows = form->rows,
                              .cones = form->cones,
                              .dim = form->dim,
                              .a = form->a,
                              .b = form->b,
                              .p = form->p,
                              .origin = out->origin};
    vec3_store(out->origin, vec3_add(out->middle, vec3_load(form->origin)));
    layout(out);
    if (!cpsi_arena_allocate(&out->arena))
        return cpsi_fail(err, CPS_ERR_MEMORY, "needs more memory than there is");
    layout(out);
    out->set.centre = out->centre;
    if (form->unknowns > 0) {
        fill_nearest(out);
        status = cpsi_conic_centre(form, out->centre, &found, err);
    }
    if (!status && !found)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "has an expression without an interior or a centre: write it with fewer "
                           "operations");
    if (!status && cpsi_support_is_closed(of)) out->closed = cps_set_retain(of);
    return status;
}

CpsStatus cpsi_place_form_make(const CpsConstraint *on, CpsiPlaceForm **out, CpsError *err) {
    CpsSet *moved = NULL;
    double middle[3] = {0}, back[3];
    *out = NULL;
    CpsStatus status = check(on->set, middle, err);
    for (int a = 0; a < 3; a++) back[a] = -middle[a];
    if (!status) status = cps_set_translate(back, on->set, &moved, err);
    CpsiPlaceForm *made = status ? NULL : calloc(1, sizeof *made);
    if (!status && !made)
        status = cpsi_fail(err, CPS_ERR_MEMORY, "needs more memory than there is");
    if (!status) {
        made->middle = vec3_add(vec3_load(on->point), vec3_load(middle));
        status = make(moved, made, err);
    }
    cps_set_release(moved);
    if (status)
        cpsi_place_form_free(made);
    else
        *out = made;
    return status;
}

void cpsi_place_form_free(CpsiPlaceForm *form) {
    if (!form) return;
    cps_set_release(form->closed);
    cpsi_conic_form_free(form->form);
    cpsi_arena_free(&form->arena);
    free(form);
}

const CpsiConicSet *cpsi_place_form_conic(const CpsiPlaceForm *form) { return &form->set; }

CpsiConicConstraint *cpsi_place_form_constraint(CpsiPlaceForm *form) { return &form->constraint; }

/* The unknowns v of the place of the set nearest to x; NULL where they are not found. */
static const double *find_nearest(CpsiPlaceForm *form, Vec3 x) {
    const int m = form->set.rows;
    const Vec3 off = vec3_sub(vec3_load(form->set.origin), x);
    vec3_store(&form->b[m + 1], vec3_scale(1 / form->form->size, off));
    const CpsiConicResult result = cpsi_conic_solve(form->nearest, ACCEPT);
    return result.outcome == CPSI_CONIC_SOLVED ? result.x : NULL;
}

void cpsi_place_form_fill(CpsiPlaceForm *form, int node, Vec3 base, const double *axes,
                          double unit) {
    const double *v = form->set.unknowns > 0 ? find_nearest(form, base) : form->centre;
    memcpy(form->constraint.begin, v ? v : form->centre,
           (size_t)form->set.unknowns * sizeof *form->centre);
    CpsiConicConstraint *of = &form->constraint;
    const Vec3 off = vec3_sub(base, vec3_load(form->set.origin));
    of->node = node;
    of->unit = unit;
    of->rows_per_unit = unit / form->form->size;
    vec3_store(of->at, vec3_scale(1 / unit, off));
    for (int a = 0; a < 3; a++) {
        const double common[3] = {a == 0, a == 1, a == 2};
        cpsi_frame_to(of->frame[a], axes, common);
    }
}

/* origin + P v */
static Vec3 place_at(const CpsiPlaceForm *form, const double *v) {
    const int n = form->set.unknowns;
    Vec3 x = vec3_load(form->set.origin);
    x.x += cpsi_dot(n, form->set.p, v);
    x.y += cpsi_dot(n, form->set.p + n, v);
    x.z += cpsi_dot(n, form->set.p + 2 * n, v);
    return x;
}

/* How far from the boundary of its cone rows i to i + dim are at the unknowns v; < 0 outside. */
static double margin_of(const CpsiConicSet *set, int i, int dim, const double *v) {
    double first = 0, across = 0;
    for (int r = i; r < i + dim; r++) {
        const double at =
            set->b[r] + cpsi_dot(set->unknowns, &set->a[(size_t)r * (size_t)set->unknowns], v);
        if (r == i) first = at;
        if (r > i) across += at * at;
    }
    return first - sqrt(across);
}

/* Are the unknowns in all cones? */
static bool is_inside(const CpsiPlaceForm *form, const double *v) {
    const CpsiConicSet *set = &form->set;
    bool inside = true;
    CPSI_FOR_CONES(k, i, set->cones, set->dim)
        inside = inside && margin_of(set, i, set->dim[k], v) >= 0;
    return inside;
}

/* Place by the unknowns v after going towards the centre until they are in all cones. A margin is a
 * concave function of the way, so that the share -m/(m' - m) of it is enough, m' the one at the
 * centre. */
static Vec3 place_inside(CpsiPlaceForm *form, const double *v) {
    const CpsiConicSet *set = &form->set;
    double share = 0;
    CPSI_FOR_CONES(k, i, set->cones, set->dim) {
        const double here = margin_of(set, i, set->dim[k], v);
        if (here >= 0) continue;
        share = fmax(share, -here / (margin_of(set, i, set->dim[k], form->centre) - here));
    }
    if (!(share <= INWARDS)) return place_at(form, v);
    for (int j = 0; j < set->unknowns; j++)
        form->inside[j] = v[j] + 2 * share * (form->centre[j] - v[j]);
    return place_at(form, form->inside);
}

Vec3 cpsi_place_form_place(CpsiPlaceForm *form, Vec3 x) {
    const double *v = form->constraint.v;
    return is_inside(form, v) ? place_at(form, v) : cpsi_place_form_nearest(form, x);
}

Vec3 cpsi_place_form_nearest(CpsiPlaceForm *form, Vec3 x) {
    if (form->set.unknowns == 0) return vec3_load(form->set.origin);
    const double *v = find_nearest(form, x);
    return v ? place_inside(form, v) : vec3(NAN, NAN, NAN);
}

/* sup of v.(y - origin) by the small conic program. */
static double solve_support(CpsiPlaceForm *form, Vec3 v) {
    const int n = form->set.unknowns;
    const double size = vec3_norm(v);
    double largest = 0;
    if (n == 0 || !(size > 0)) return size > 0 || size == 0 ? 0 : NAN;
    for (int j = 0; j < n; j++) {
        const Vec3 p = vec3(form->set.p[j], form->set.p[n + j], form->set.p[2 * n + j]);
        form->cost[j] = -vec3_dot(v, p) / size;
        largest = fmax(largest, fabs(form->cost[j]));
    }
    if (!(largest > 0)) return 0;
    for (int j = 0; j < n; j++) form->cost[j] /= largest; /* of order one, like the rows */
    const CpsiConicResult result = cpsi_conic_solve(form->support, ACCEPT);
    if (result.outcome != CPSI_CONIC_SOLVED) return NAN;
    return -size * largest * cpsi_dot(n, form->cost, result.x);
}

double cpsi_place_form_gap(CpsiPlaceForm *form, Vec3 v, Vec3 x) {
    double direction[3];
    CpsSetAnswer answer;
    vec3_store(direction, v);
    if (form->closed && cpsi_support(form->closed, direction, NULL, &answer, NULL) == CPS_OK &&
        answer.outcome == CPS_SET_OUTCOME_ANSWERED)
        return answer.value - vec3_dot(v, vec3_sub(x, form->middle));
    return solve_support(form, v) + vec3_dot(v, vec3_sub(vec3_load(form->set.origin), x));
}
