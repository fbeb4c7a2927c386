/* SPDX-License-Identifier: BSD-3-Clause */
/* The face {x in C : <w, x> = h(w)} as a set of its own.
 *
 * Down the expression as far as it goes: the face of a product, sum, image, translate or scale is the same operation
 * on the parts' faces at w's image; of a hull the hull of the faces that reach the maximum, where they are bounded; of the primitives a point,
 * a smaller hull, a smaller box. On a conic form the interior-point solution (v, s, z) lies in the relative interior
 * of the optimal set, so z tells the face cone by cone:
 *
 *     z = 0                    the cone's rows stay as they are
 *     z on the boundary        s stays on the ray of Jz:  its other components are equations, s along it >= 0
 *     z inside (or z > 0)      s = 0
 *
 * written around the solution found, dv = v - v*, so that rounding cannot make the face empty. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linsys/small.h"
#include "set/node.h"

/* The solver's z are this sure: sqrt of its complementarity. No smaller angle is told from 0 on a conic form. */
static const double LEAST_ANGLE = 3e-8;
/* Equations of a face that differ by less than this share are one: the directions of z are known that well. */
static const double SAME_EQUATION = 1e-7;
/* Coefficients of rows of size one below this are rounding. */
static const double NOISE = 1e-9;

static CpsStatus face_of(const CpsSet *set, const double *w, double slack, CpsSet **out, CpsSetAnswer *answer,
                         CpsError *err);

/* ---- conic forms ---- */

/* Affine row over dv: a'(A dv) + constant, a over d rows of the form from i on. */
static void combine(const CpsiForm *form, int i, int d, const double *a, double constant, double *row) {
    const int u = form->unknowns;
    for (int r = 0; r < d; r++)
        for (int j = 0; j < u; j++) row[j] += a[r]*form->a[(size_t)(i + r)*(size_t)u + (size_t)j];
    row[u] += constant;
}

/* An equation; rows of nothing but rounding are left out. */
static void equation(CpsiRaw *raw, const CpsiForm *form, int i, int d, const double *a) {
    double *row = cpsi_raw_equation(raw);
    combine(form, i, d, a, 0, row);
    if (cpsi_norm(form->unknowns, row) > NOISE) return;
    memset(row, 0, (size_t)raw->width*sizeof *row);
    raw->equations--;
}

/* The rows of one cone on the face. a (d) is scratch. */
static void cone_on_face(CpsiRaw *raw, const CpsiForm *form, const CpsiSolution *at, int i, int d, double angle,
                         double *a) {
    const double *s = &at->s[i], *z = &at->z[i];
    double *rows, size = cpsi_norm(d - 1, z + 1);
    if (z[0] <= angle) { /* not pressed */
        rows = cpsi_raw_cone(raw, d);
        for (int r = 0; r < d; r++)
            combine(form, i + r, 1, (const double[]){1}, s[r], &rows[(size_t)r*(size_t)raw->width]);
        return;
    }
    if (d == 1 || z[0] - size > angle) { /* at the tip */
        for (int r = 0; r < d; r++) equation(raw, form, i + r, 1, (const double[]){1});
        return;
    }
    /* on the ray (1, -z1/|z1|)/sqrt 2 */
    for (int k = 0; k < d; k++) {
        /* component k less its part along the ray */
        const double along = k ? -z[k]/size : 1;
        for (int r = 0; r < d; r++) a[r] = (r == k) - 0.5*along*(r ? -z[r]/size : 1);
        equation(raw, form, i, d, a);
    }
    double pull = s[0];
    for (int r = 0; r < d; r++) a[r] = r ? -z[r]/size : 1, pull += r ? a[r]*s[r] : 0;
    combine(form, i, d, a, pull, cpsi_raw_cone(raw, 1));
}

/* The restricted form round the solution. */
static CpsStatus restrict_form(const CpsiForm *form, const CpsiSolution *at, double angle, CpsiForm **out,
                               CpsError *err) {
    const int n = form->n, u = form->unknowns;
    CpsiRaw *raw = NULL;
    const CpsiCount count = {.unknowns = (size_t)u, .equations = (size_t)form->rows + 1, .rows = (size_t)form->rows,
                             .cones = (size_t)form->cones};
    CpsStatus status = cpsi_raw_new(count, u, &raw, err);
    if (status) return status;
    double *map = calloc((size_t)n*(size_t)raw->width + (size_t)form->largest_cone + 1, sizeof *map);
    if (!map) status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a face");
    else {
        for (int k = 0, i = 0; k < form->cones; i += form->dim[k++])
            cone_on_face(raw, form, at, i, form->dim[k], angle, &map[(size_t)n*(size_t)raw->width]);
        for (int i = 0; i < n; i++) {
            memcpy(&map[(size_t)i*(size_t)raw->width], &form->p[(size_t)i*(size_t)u], (size_t)u*sizeof *map);
            map[(size_t)i*(size_t)raw->width + (size_t)u] = at->x[i];
        }
        status = cpsi_form_reduce(raw, n, map, form->lines, form->q, SAME_EQUATION, out, err);
    }
    free(map);
    cpsi_raw_free(raw);
    return status;
}

/* Directions that x can take over the form: the rank of P beside the lines, and one direction. */
static int directions(const CpsiForm *form, double *first, double *scratch) {
    const size_t n = (size_t)form->n, u = (size_t)form->unknowns;
    size_t count = 0;
    double most = 0;
    for (size_t j = 0; j < u; j++) {
        for (size_t i = 0; i < n; i++) scratch[count*n + i] = form->p[i*u + j];
        most = fmax(most, cpsi_norm(form->n, &scratch[count*n]));
        count++;
    }
    size_t kept = 0;
    for (size_t k = 0; k < count; k++)
        if (cpsi_norm(form->n, &scratch[k*n]) > NOISE*most)
            memmove(&scratch[kept++*n], &scratch[k*n], n*sizeof *scratch);
    memcpy(&scratch[kept*n], form->q, (size_t)form->lines*n*sizeof *scratch);
    kept += (size_t)form->lines;
    const int rank = cpsi_orthonormal_rows((int)kept, form->n, scratch, NULL, SAME_EQUATION);
    if (rank > 0) memcpy(first, scratch, n*sizeof *first);
    return rank;
}

/* The simplest set that a form is: a point, a segment, or the form itself, which is taken over. */
static CpsStatus simplest(CpsiForm *form, const double *x, CpsSet **out, CpsError *err) {
    const int n = form->n;
    CpsiSolution end[2] = {{.outcome = CPS_SET_INACCURATE}, {.outcome = CPS_SET_INACCURATE}};
    double *d = malloc((1 + (size_t)form->unknowns + (size_t)form->lines)*(size_t)n*sizeof *d);
    CpsStatus status = d ? CPS_OK : cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a face");
    const int rank = d ? directions(form, d, d + n) : 0;
    bool done = status != CPS_OK;
    if (!done && rank == 0) {
        status = cps_set_point(n, x, out, err);
        done = true;
    }
    if (!done && rank == 1) {
        for (int k = 0; !status && k < 2; k++) {
            for (int i = 0; i < n; i++) d[i] = -d[i];
            status = cpsi_form_minimise(form, d, &end[k], err);
        }
        if (!status && end[0].outcome == CPS_SET_ANSWERED && end[1].outcome == CPS_SET_ANSWERED) {
            double length = 0;
            for (int i = 0; i < n; i++) length = hypot(length, end[1].x[i] - end[0].x[i]);
            if (length > NOISE*form->size) status = cps_set_segment(n, end[0].x, end[1].x, out, err);
            else status = cps_set_point(n, x, out, err);
            done = true;
        }
        done = done || status;
        cpsi_solution_free(&end[0]), cpsi_solution_free(&end[1]);
    }
    free(d);
    if (!done) return cpsi_set_from_form(form, out, err);
    cpsi_form_free(form);
    return status;
}

CpsStatus cpsi_form_restrict(const CpsiForm *form, const CpsiSolution *at, CpsiForm **out, CpsError *err) {
    return restrict_form(form, at, LEAST_ANGLE, out, err);
}

static CpsStatus conic_face(const CpsSet *set, const double *w, double slack, CpsSet **out, CpsSetAnswer *answer,
                            CpsError *err) {
    const int n = set->n;
    const CpsiForm *form;
    CpsiForm *made, *face = NULL;
    CpsiSolution solution = {.outcome = CPS_SET_INACCURATE};
    double *c = malloc((size_t)n*sizeof *c);
    if (!c) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a direction");
    for (int i = 0; i < n; i++) c[i] = -w[i];
    CpsStatus status = cpsi_set_form(set, &form, &made, err);
    if (!status) status = cpsi_form_minimise(form, c, &solution, err);
    if (!status) cpsi_judge_attained(form, c, &solution);
    if (!status && solution.outcome == CPS_SET_ANSWERED) {
        const double angle = fmax(slack/cpsi_norm(n, w), LEAST_ANGLE);
        *answer = (CpsSetAnswer){.outcome = CPS_SET_ANSWERED, .value = -solution.value, .gap = solution.gap,
                                 .tolerance = angle};
        /* a form without cones is an affine space, and all of it is the face */
        if (!solution.s) *out = cps_set_retain(set);
        else status = restrict_form(form, &solution, angle, &face, err);
        if (!status && face) status = simplest(face, solution.x, out, err);
    } else if (!status) *answer = (CpsSetAnswer){.outcome = solution.outcome};
    cpsi_solution_free(&solution);
    cpsi_form_free(made);
    free(c);
    return status;
}

/* ---- primitives ---- */

static CpsStatus face_of_points(const CpsSet *set, const double *w, double slack, const double *best, CpsSet **out,
                                CpsError *err) {
    const size_t n = (size_t)set->n;
    double *kept = malloc((size_t)set->count*n*sizeof *kept);
    int count = 0;
    if (!kept) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a face");
    for (int k = 0; k < set->count; k++) {
        const double *point = &set->a[(size_t)k*n];
        double short_of = 0, far = 0, size = 0;
        for (size_t i = 0; i < n; i++) {
            short_of += w[i]*(best[i] - point[i]);
            far = hypot(far, best[i] - point[i]);
            size += fabs(w[i])*(fabs(best[i]) + fabs(point[i]));
        }
        if (short_of <= slack*far + 4e-16*size) memcpy(&kept[(size_t)count++*n], point, n*sizeof *kept);
    }
    const CpsStatus status = cps_set_hull_of_points(set->n, count, kept, out, err);
    free(kept);
    return status;
}

static CpsStatus face_of_box(const CpsSet *set, const double *w, double slack, CpsSet **out, CpsError *err) {
    const CpsStatus status = cps_set_box(set->n, set->a, set->b, out, err);
    for (int i = 0; !status && i < set->n; i++) {
        if (w[i] > slack) (*out)->a[i] = (*out)->b[i];
        if (w[i] < -slack) (*out)->b[i] = (*out)->a[i];
    }
    return status;
}

static CpsStatus face_of_rays(const CpsSet *set, const double *w, double slack, CpsSet **out, CpsError *err) {
    const size_t n = (size_t)set->n;
    const CpsStatus status = cps_set_cone_of_rays(set->n, set->count, set->a, out, err);
    if (status) return status;
    int count = 0;
    for (int k = 0; k < set->count; k++) {
        double *ray = &(*out)->a[(size_t)k*n];
        if (cpsi_dot(set->n, w, ray) < -slack*cpsi_norm(set->n, ray)) continue;
        memmove(&(*out)->a[(size_t)count++*n], ray, n*sizeof *ray);
    }
    (*out)->count = count;
    return CPS_OK;
}

/* ---- operations ---- */

/* Faces of the parts, each at its piece of w; those below the hull's maximum are left out. */
static CpsStatus face_of_parts(const CpsSet *set, const double *w, double slack, double value, CpsSet **out,
                               CpsSetAnswer *answer, CpsError *err) {
    CpsSet **face = calloc((size_t)set->count, sizeof(CpsSet *));
    if (!face) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a face");
    CpsStatus status = CPS_OK;
    int count = 0;
    for (int k = 0, at = 0; !status && answer->outcome == CPS_SET_ANSWERED && k < set->count; k++) {
        CpsSetAnswer one = {.outcome = CPS_SET_ANSWERED};
        if (set->kind == CPSI_SET_HULL) {
            status = cpsi_support(set->part[k], w, NULL, &one, err);
            const double size = cpsi_set_size(set);
            if (status || one.outcome == CPS_SET_EMPTY ||
                one.value + one.gap < value - slack*size - 1e-12*fabs(value))
                continue;
        }
        status = face_of(set->part[k], w + at, slack, &face[count], &one, err);
        answer->tolerance = fmax(answer->tolerance, one.tolerance);
        answer->exact = answer->exact && one.exact;
        answer->outcome = one.outcome;
        if (!status && one.outcome == CPS_SET_ANSWERED) count++;
        if (set->kind == CPSI_SET_PRODUCT) at += set->part[k]->n;
    }
    const CpsSet *const *parts = (const CpsSet *const *)face;
    if (!status && answer->outcome == CPS_SET_ANSWERED) {
        if (count == 1) *out = cps_set_retain(face[0]);
        else if (set->kind == CPSI_SET_PRODUCT) status = cps_set_product(count, parts, out, err);
        else if (set->kind == CPSI_SET_SUM) status = cps_set_sum(count, parts, out, err);
        else status = cps_set_hull(count, parts, out, err);
    }
    for (int k = 0; k < count; k++) cps_set_release(face[k]);
    free(face);
    return status;
}

static CpsStatus face_of_mapped(const CpsSet *set, const double *w, double slack, CpsSet **out, CpsSetAnswer *answer,
                                CpsError *err) {
    const CpsSet *part = set->part[0];
    const int m = part->n;
    double *back = calloc((size_t)m, sizeof *back), size = 1;
    CpsSet *face = NULL;
    if (!back) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a direction");
    if (set->kind == CPSI_SET_IMAGE) {
        size = cpsi_norm(set->n*m, set->a);
        cpsi_pull_back(set, w, back);
    } else {
        if (set->kind == CPSI_SET_SCALE) size = set->scalar;
        for (int j = 0; j < m; j++) back[j] = size*w[j];
    }
    CpsStatus status = face_of(part, back, slack*fabs(size), &face, answer, err);
    free(back);
    if (status || answer->outcome != CPS_SET_ANSWERED) return status;
    if (set->kind == CPSI_SET_IMAGE) status = cps_set_image(set->n, set->a, face, out, err);
    else if (set->kind == CPSI_SET_SCALE) status = cps_set_scale(set->scalar, face, out, err);
    else status = cps_set_translate(set->a, face, out, err);
    cps_set_release(face);
    return status;
}

/* slack: what w may be off by, in the units of w. */
static CpsStatus face_of(const CpsSet *set, const double *w, double slack, CpsSet **out, CpsSetAnswer *answer,
                         CpsError *err) {
    *answer = (CpsSetAnswer){.outcome = CPS_SET_ANSWERED, .exact = true};
    if (cpsi_norm(set->n, w) <= slack) {
        *out = cps_set_retain(set);
        return CPS_OK;
    }
    double *best = malloc((size_t)set->n*sizeof *best);
    if (!best) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    CpsStatus status = cpsi_support(set, w, best, answer, err);
    const double value = answer->value;
    const bool conic = !answer->exact;
    answer->tolerance = slack/cpsi_norm(set->n, w);
    if (!status && answer->outcome == CPS_SET_ANSWERED) switch (set->kind) {
        case CPSI_SET_POINTS: status = face_of_points(set, w, slack, best, out, err); break;
        case CPSI_SET_BALL:
        case CPSI_SET_ELLIPSOID: status = cps_set_point(set->n, best, out, err); break;
        case CPSI_SET_BOX: status = face_of_box(set, w, slack, out, err); break;
        case CPSI_SET_RAYS: status = face_of_rays(set, w, slack, out, err); break;
        case CPSI_SET_SUBSPACE: *out = cps_set_retain(set); break;
        case CPSI_SET_INEQUALITIES:
            if (conic) status = conic_face(set, w, slack, out, answer, err);
            else {
                const double *a = set->a, at = cpsi_dot(set->n, a, w) > 0 ? set->b[0] : -set->b[1];
                status = cps_set_strip(set->n, a, at, at, out, err);
            }
            break;
        case CPSI_SET_PRODUCT:
        case CPSI_SET_SUM: status = face_of_parts(set, w, slack, value, out, answer, err); break;
        case CPSI_SET_HULL:
            /* an unbounded part adds its directions to the faces of all others: of the closure the conic form knows them */
            if (set->closure) status = conic_face(set, w, slack, out, answer, err);
            else status = face_of_parts(set, w, slack, value, out, answer, err);
            break;
        case CPSI_SET_IMAGE:
        case CPSI_SET_TRANSLATE:
        case CPSI_SET_SCALE: status = face_of_mapped(set, w, slack, out, answer, err); break;
        case CPSI_SET_USER: answer->outcome = CPS_SET_NOT_AVAILABLE; break;
        case CPSI_SET_CONIC:
        case CPSI_SET_INTERSECTION:
        case CPSI_SET_PREIMAGE:
        case CPSI_SET_POLAR: status = conic_face(set, w, slack, out, answer, err); break;
        }
    if (answer->outcome == CPS_SET_ANSWERED) answer->value = value;
    free(best);
    return status;
}

CpsStatus cps_set_face(const CpsSet *set, const double *direction, double tolerance, CpsSet **face,
                       CpsSetAnswer *answer, CpsError *err) {
    if (!set || !direction || !face || !answer)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL",
                         !set ? "set" : !direction ? "direction" : "an answer");
    CpsStatus status = cpsi_set_finite("direction", (size_t)set->n, direction, err);
    if (status) return status;
    if (!(tolerance >= 0) || tolerance > 0.1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "tolerance is %g, expected an angle from 0 to 0.1",
                         tolerance);
    CpsSet *found = NULL;
    const double slack = (tolerance > 0 ? tolerance : 1e-9)*cpsi_norm(set->n, direction);
    status = face_of(set, direction, slack, &found, answer, err);
    if (status) return status;
    answer->closure = set->closure;
    if (answer->outcome == CPS_SET_ANSWERED) *face = found;
    else *face = NULL, cps_set_release(found);
    return CPS_OK;
}
