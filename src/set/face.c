/* SPDX-License-Identifier: BSD-3-Clause */
/* The face {x in C : <w, x> = h(w)} as a set of its own.
 *
 * It is computed recursively: the face of a product, sum, image, translate or scale is the same
 * operation on the faces of the parts at w's image; that of a hull is the hull of the faces that
 * attain the maximum, where they are bounded; that of a primitive is a point, a smaller hull or a
 * smaller box. For a conic form the multipliers of the interior-point solution determine the face
 * cone by cone (restrict.c). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linalg/dense.h"
#include "set/set.h"

/* Directions of a face below this share of the largest one, and lengths below this share of the
 * form's, are rounding. */
static const double NOISE = 1e-9;

static CpsStatus face_of(const CpsSet *set, const double *w, double slack, CpsSet **out,
                         CpsSetAnswer *answer, CpsError *err);

/* ---- conic forms ---- */

/* The dimension of the set of x of the form: the rank of P and the lines; `first` is one
 * direction. */
static int directions(const CpsiConicForm *form, double *first, double *scratch) {
    const size_t n = (size_t)form->n, u = (size_t)form->unknowns;
    size_t count = 0;
    double most = 0;
    for (size_t j = 0; j < u; j++) {
        for (size_t i = 0; i < n; i++) scratch[count * n + i] = form->p[i * u + j];
        most = fmax(most, cpsi_norm(form->n, &scratch[count * n]));
        count++;
    }
    size_t kept = 0;
    for (size_t k = 0; k < count; k++)
        if (cpsi_norm(form->n, &scratch[k * n]) > NOISE * most)
            memmove(&scratch[kept++ * n], &scratch[k * n], n * sizeof *scratch);
    memcpy(&scratch[kept * n], form->q, (size_t)form->lines * n * sizeof *scratch);
    kept += (size_t)form->lines;
    const int rank = cpsi_orthonormal_rows((int)kept, form->n, scratch, NULL, CPSI_SAME_EQUATION);
    if (rank > 0) memcpy(first, scratch, n * sizeof *first);
    return rank;
}

/* The simplest set that equals a form: a point, a segment, or the form itself. Takes ownership of
 * the form. */
static CpsStatus simplest(CpsiConicForm *form, const double *x, CpsSet **out, CpsError *err) {
    const int n = form->n;
    CpsiSolution end[2] = {{.outcome = CPS_SET_OUTCOME_INACCURATE},
                           {.outcome = CPS_SET_OUTCOME_INACCURATE}};
    double *d = malloc((1 + (size_t)form->unknowns + (size_t)form->lines) * (size_t)n * sizeof *d);
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
            status = cpsi_conic_form_minimise(form, d, &end[k], err);
        }
        if (!status && end[0].outcome == CPS_SET_OUTCOME_ANSWERED &&
            end[1].outcome == CPS_SET_OUTCOME_ANSWERED) {
            double length = 0;
            for (int i = 0; i < n; i++) length = hypot(length, end[1].x[i] - end[0].x[i]);
            if (length > NOISE * form->size)
                status = cps_set_segment(n, end[0].x, end[1].x, out, err);
            else
                status = cps_set_point(n, x, out, err);
            done = true;
        }
        done = done || status;
        cpsi_solution_free(&end[0]);
        cpsi_solution_free(&end[1]);
    }
    free(d);
    if (!done) return cpsi_set_from_conic_form(form, out, err);
    cpsi_conic_form_free(form);
    return status;
}

static CpsStatus conic_face(const CpsSet *set, const double *w, double slack, CpsSet **out,
                            CpsSetAnswer *answer, CpsError *err) {
    const int n = set->n;
    const CpsiConicForm *form;
    CpsiConicForm *made, *face = NULL;
    CpsiSolution solution = {.outcome = CPS_SET_OUTCOME_INACCURATE};
    double *c = malloc((size_t)n * sizeof *c);
    if (!c) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a direction");
    for (int i = 0; i < n; i++) c[i] = -w[i];
    CpsStatus status = cpsi_set_conic_form(set, &form, &made, err);
    if (!status) status = cpsi_conic_form_minimise(form, c, &solution, err);
    if (!status) cpsi_check_attained(form, c, &solution);
    if (!status && solution.outcome == CPS_SET_OUTCOME_ANSWERED) {
        const double angle = fmax(slack / cpsi_norm(n, w), CPSI_LEAST_ANGLE);
        *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED,
                                 .value = -solution.value,
                                 .gap = solution.gap,
                                 .tolerance = angle};
        /* a form without cones is an affine space, which is its own face */
        if (!solution.s)
            *out = cps_set_retain(set);
        else
            status = cpsi_conic_form_restrict(form, &solution, angle, &face, err);
        if (!status && face) {
            status = simplest(face, solution.x, out, err);
            if (!status) (*out)->bounded = cpsi_set_known_bounded(set);
        }
    } else if (!status)
        *answer = (CpsSetAnswer){.outcome = solution.outcome};
    cpsi_solution_free(&solution);
    cpsi_conic_form_free(made);
    free(c);
    return status;
}

/* ---- primitives ---- */

static CpsStatus face_of_points(const CpsSet *set, const double *w, double slack,
                                const double *best, CpsSet **out, CpsError *err) {
    const size_t n = (size_t)set->n;
    double *kept = malloc((size_t)set->count * n * sizeof *kept);
    int count = 0;
    if (!kept) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a face");
    for (int k = 0; k < set->count; k++) {
        const double *point = &set->a[(size_t)k * n];
        double short_of = 0, far = 0, size = 0;
        for (size_t i = 0; i < n; i++) {
            short_of += w[i] * (best[i] - point[i]);
            far = hypot(far, best[i] - point[i]);
            size += fabs(w[i]) * (fabs(best[i]) + fabs(point[i]));
        }
        if (short_of <= slack * far + 4e-16 * size)
            memcpy(&kept[(size_t)count++ * n], point, n * sizeof *kept);
    }
    const CpsStatus status = cps_set_hull_of_points(set->n, count, kept, out, err);
    free(kept);
    return status;
}

static CpsStatus face_of_box(const CpsSet *set, const double *w, double slack, CpsSet **out,
                             CpsError *err) {
    const CpsStatus status = cps_set_box(set->n, set->a, set->b, out, err);
    if (!status)
        for (int i = 0; i < set->n; i++) {
            if (w[i] > slack) (*out)->a[i] = (*out)->b[i];
            if (w[i] < -slack) (*out)->b[i] = (*out)->a[i];
        }
    return status;
}

static CpsStatus face_of_rays(const CpsSet *set, const double *w, double slack, CpsSet **out,
                              CpsError *err) {
    const size_t n = (size_t)set->n;
    const CpsStatus status = cps_set_cone_of_rays(set->n, set->count, set->a, out, err);
    if (status) return status;
    int count = 0;
    for (int k = 0; k < set->count; k++) {
        double *ray = &(*out)->a[(size_t)k * n];
        if (cpsi_dot(set->n, w, ray) < -slack * cpsi_norm(set->n, ray)) continue;
        memmove(&(*out)->a[(size_t)count++ * n], ray, n * sizeof *ray);
    }
    (*out)->count = count;
    return CPS_OK;
}

/* ---- operations ---- */

/* Faces of the parts, each for its components of w; parts below the hull's maximum are left out. */
static CpsStatus face_of_parts(const CpsSet *set, const double *w, double slack, double value,
                               CpsSet **out, CpsSetAnswer *answer, CpsError *err) {
    CpsSet **face = calloc((size_t)set->count, sizeof(CpsSet *));
    if (!face) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a face");
    CpsStatus status = CPS_OK;
    int count = 0;
    for (int k = 0, at = 0;
         !status && answer->outcome == CPS_SET_OUTCOME_ANSWERED && k < set->count; k++) {
        CpsSetAnswer one = {.outcome = CPS_SET_OUTCOME_ANSWERED};
        if (set->kind == CPSI_SET_HULL) {
            status = cpsi_support(set->part[k], w, NULL, &one, err);
            const double size = cpsi_set_size(set);
            if (status || one.outcome == CPS_SET_OUTCOME_EMPTY) continue;
            if (one.outcome == CPS_SET_OUTCOME_ANSWERED &&
                one.value + one.gap < value - slack * size - 1e-12 * fabs(value))
                continue;
        }
        /* a user's function may have failed meanwhile */
        if (one.outcome == CPS_SET_OUTCOME_ANSWERED)
            status = face_of(set->part[k], w + at, slack, &face[count], &one, err);
        answer->tolerance = fmax(answer->tolerance, one.tolerance);
        answer->exact &= one.exact;
        answer->outcome = one.outcome;
        if (!status && one.outcome == CPS_SET_OUTCOME_ANSWERED) count++;
        if (set->kind == CPSI_SET_PRODUCT) at += set->part[k]->n;
    }
    if (count == 0 && answer->outcome == CPS_SET_OUTCOME_ANSWERED)
        answer->outcome = CPS_SET_OUTCOME_INACCURATE; /* ... or have answered otherwise */
    const CpsSet *const *parts = (const CpsSet *const *)face;
    if (!status && answer->outcome == CPS_SET_OUTCOME_ANSWERED) {
        if (count == 1)
            *out = cps_set_retain(face[0]);
        else if (set->kind == CPSI_SET_PRODUCT)
            status = cps_set_product(count, parts, out, err);
        else if (set->kind == CPSI_SET_SUM)
            status = cps_set_sum(count, parts, out, err);
        else
            status = cps_set_hull(count, parts, out, err);
    }
    for (int k = 0; k < count; k++) cps_set_release(face[k]);
    free(face);
    return status;
}

static CpsStatus face_of_mapped(const CpsSet *set, const double *w, double slack, CpsSet **out,
                                CpsSetAnswer *answer, CpsError *err) {
    const CpsSet *part = set->part[0];
    const int m = part->n;
    double *back = calloc((size_t)m, sizeof *back), size = 1;
    CpsSet *face = NULL;
    if (!back) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a direction");
    if (set->kind == CPSI_SET_IMAGE) {
        size = cpsi_norm(set->n * m, set->a);
        cpsi_pull_back(set, w, back);
    } else {
        if (set->kind == CPSI_SET_SCALE) size = set->scalar;
        for (int j = 0; j < m; j++) back[j] = size * w[j];
    }
    CpsStatus status = face_of(part, back, slack * fabs(size), &face, answer, err);
    free(back);
    if (status || answer->outcome != CPS_SET_OUTCOME_ANSWERED) return status;
    if (set->kind == CPSI_SET_IMAGE)
        status = cps_set_image(set->n, set->a, face, out, err);
    else if (set->kind == CPSI_SET_SCALE)
        status = cps_set_scale(set->scalar, face, out, err);
    else
        status = cps_set_translate(set->a, face, out, err);
    cps_set_release(face);
    return status;
}

/* `slack`: the error of w, in the units of w. */
static CpsStatus face_of(const CpsSet *set, const double *w, double slack, CpsSet **out,
                         CpsSetAnswer *answer, CpsError *err) {
    *answer = (CpsSetAnswer){.outcome = CPS_SET_OUTCOME_ANSWERED, .exact = true};
    if (cpsi_norm(set->n, w) <= slack) {
        *out = cps_set_retain(set);
        return CPS_OK;
    }
    double *best = malloc((size_t)set->n * sizeof *best);
    if (!best) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a point");
    CpsStatus status = cpsi_support(set, w, best, answer, err);
    const double value = answer->value;
    const bool conic = !answer->exact;
    answer->tolerance = slack / cpsi_norm(set->n, w);
    if (!status && answer->outcome == CPS_SET_OUTCOME_ANSWERED) switch (set->kind) {
        case CPSI_SET_POINTS: status = face_of_points(set, w, slack, best, out, err); break;
        case CPSI_SET_BALL:
        case CPSI_SET_ELLIPSOID: status = cps_set_point(set->n, best, out, err); break;
        case CPSI_SET_BOX: status = face_of_box(set, w, slack, out, err); break;
        case CPSI_SET_RAYS: status = face_of_rays(set, w, slack, out, err); break;
        case CPSI_SET_SUBSPACE: *out = cps_set_retain(set); break;
        case CPSI_SET_INEQUALITIES:
            if (conic)
                status = conic_face(set, w, slack, out, answer, err);
            else {
                const double *a = set->a, at = cpsi_dot(set->n, a, w) > 0 ? set->b[0] : -set->b[1];
                status = cps_set_strip(set->n, a, at, at, out, err);
            }
            break;
        case CPSI_SET_PRODUCT:
        case CPSI_SET_SUM: status = face_of_parts(set, w, slack, value, out, answer, err); break;
        case CPSI_SET_HULL:
            /* An unbounded part adds its directions to the faces of all others. The conic form
             * contains them, because it describes the closure. */
            if (set->closure)
                status = conic_face(set, w, slack, out, answer, err);
            else
                status = face_of_parts(set, w, slack, value, out, answer, err);
            break;
        case CPSI_SET_IMAGE:
        case CPSI_SET_TRANSLATE:
        case CPSI_SET_SCALE: status = face_of_mapped(set, w, slack, out, answer, err); break;
        case CPSI_SET_USER: answer->outcome = CPS_SET_OUTCOME_NOT_AVAILABLE; break;
        case CPSI_SET_CONIC:
        case CPSI_SET_INTERSECTION:
        case CPSI_SET_PREIMAGE:
        case CPSI_SET_POLAR: status = conic_face(set, w, slack, out, answer, err); break;
        }
    if (answer->outcome == CPS_SET_OUTCOME_ANSWERED) answer->value = value;
    free(best);
    return status;
}

CpsStatus cps_set_face(const CpsSet *set, const double *direction, double tolerance, CpsSet **face,
                       CpsSetAnswer *answer, CpsError *err) {
    if (!set || !direction || !face || !answer)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL",
                         !set         ? "set"
                         : !direction ? "direction"
                                      : "an answer");
    CpsStatus status = cpsi_set_finite("direction", (size_t)set->n, direction, err);
    if (status) return status;
    if (!(tolerance >= 0) || tolerance > 0.1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "tolerance is %g, expected an angle from 0 to 0.1",
                         tolerance);
    CpsSet *found = NULL;
    const double slack = (tolerance > 0 ? tolerance : 1e-9) * cpsi_norm(set->n, direction);
    status = face_of(set, direction, slack, &found, answer, err);
    if (status) return status;
    answer->closure = set->closure;
    if (answer->outcome == CPS_SET_OUTCOME_ANSWERED) {
        *face = found;
    } else {
        *face = NULL;
        cps_set_release(found);
    }
    return CPS_OK;
}
