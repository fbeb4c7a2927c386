/* SPDX-License-Identifier: BSD-3-Clause */
/* "X in t C" as conic rows, node by node; X and t are affine in the unknowns. With t >= 0 the rows
 * describe the closure of the cone over C x {1} (its perspective), which hulls, gauges and polars
 * need; with t = 1 they describe the set itself.
 *
 *     product, intersection, preimage, translate, scale
 *                 rows of the parts on parts of X
 *     image       X = L y, y in t C: new unknowns y
 *     sum         X = X_1 + ... + X_k, X_i in t C_i: new unknowns X_2 .. X_k; for an image
 *                 new unknowns y_i with X_i = L_i y_i
 *     hull        the same with X_i in t_i C_i, sum t_i = t, and t_i >= 0 where the rows of C_i do
 *                 not say so
 *     polar       h_C(X) <= t by conic duality: with C = {origin + P v + Q'l : A v + b in K},
 *                 Q X = 0,  A'z + P'X = 0,  <origin, X> + b.z <= t,  z in K */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linalg/dense.h"
#include "set/set.h"

/* The kind as which a node is written: its own, or a conic form. */
static CpsiSetKind kind_of(const CpsSet *set) { return set->touching ? CPSI_SET_CONIC : set->kind; }

/* Whether X_k of a sum or hull is written as L y with unknowns y. This does not hold for the first
 * part, which is X less the other parts. */
static bool is_carried(const CpsSet *set, int k) {
    return k > 0 && kind_of(set->part[k]) == CPSI_SET_IMAGE;
}

/* A ball that is at least this large beside the distance of its centre keeps its share t of a hull
 * from becoming negative to nearly the accuracy of its own rows. */
static const double LARGE = 0.01;

/* Do the rows of "X in t C" hold t >= 0 already? Those of a ball do, the first of which is radius t
 * >= |..|, and those of points, whose factors >= 0 add up to t. */
static bool keeps_share(const CpsSet *set) {
    const CpsiSetKind kind = kind_of(set);
    if (kind == CPSI_SET_BALL)
        return set->scalar > LARGE * (set->scalar + cpsi_norm(set->n, set->a));
    return kind == CPSI_SET_POINTS && !set->hull && set->count > 1;
}

static void count_own(const CpsSet *set, CpsiCount *count) {
    const size_t n = (size_t)set->n, items = (size_t)set->count;
    switch (kind_of(set)) {
    case CPSI_SET_POINTS:
        if (set->hull) {
            count->equations += n - (size_t)set->hull->dimension;
            count->rows += (size_t)set->hull->rows;
            count->cones += (size_t)set->hull->rows;
            break;
        }
        count->equations += n;
        if (items == 1) break;
        count->equations += 1;
        count->unknowns += items;
        count->rows += items;
        count->cones += items;
        break;
    case CPSI_SET_BALL:
    case CPSI_SET_ELLIPSOID:
        count->rows += n + 1;
        count->cones += 1;
        break;
    case CPSI_SET_BOX:
        count->rows += 2 * n;
        count->cones += 2 * n;
        count->equations += n;
        break;
    case CPSI_SET_INEQUALITIES:
        count->rows += items;
        count->cones += items;
        break;
    case CPSI_SET_SUBSPACE: count->equations += n - items; break;
    case CPSI_SET_RAYS:
        count->unknowns += items;
        count->rows += items;
        count->cones += items;
        count->equations += n;
        break;
    case CPSI_SET_CONIC:
        count->unknowns += (size_t)(set->form->unknowns + set->form->lines);
        count->equations += n + 1;
        count->rows += (size_t)set->form->rows;
        count->cones += (size_t)set->form->cones;
        break;
    case CPSI_SET_IMAGE:
        count->unknowns += (size_t)set->part[0]->n;
        count->equations += n;
        break;
    case CPSI_SET_SUM: count->unknowns += (items - 1) * n; break;
    case CPSI_SET_HULL:
        count->unknowns += (items - 1) * (n + 1);
        for (size_t k = 0; k < items; k++) {
            count->rows += !keeps_share(set->part[k]);
            count->cones += !keeps_share(set->part[k]);
        }
        break;
    case CPSI_SET_POLAR:
        if (!set->dual) break;
        count->unknowns += (size_t)set->dual->rows;
        count->equations += (size_t)(set->dual->unknowns + set->dual->lines);
        count->rows += (size_t)set->dual->rows + 1;
        count->cones += (size_t)set->dual->cones + 1;
        break;
    default: break;
    }
}

void cpsi_conic_rows_count(const CpsSet *set, CpsiCount *count) {
    count_own(set, count);
    if (!set->part || set->kind == CPSI_SET_POLAR || set->touching) return;
    const bool added = set->kind == CPSI_SET_SUM || set->kind == CPSI_SET_HULL;
    for (int k = 0; k < set->count; k++) {
        cpsi_conic_rows_count(set->part[k], count);
        if (added && is_carried(set, k)) {
            count->unknowns -= (size_t)set->n;
            count->equations -= (size_t)set->n;
        }
    }
}

/* ---- rows of primitives ---- */

/* A sum of two coefficients that is this small relative to them is their rounding: maps and bases
 * are accurate to some tens of eps. Without this, an equation of rounding errors alone would be
 * scaled to size one. */
static const double CANCELLED = 1e-14;

/* out += factor in, both affine */
static void add(const CpsiConicRows *conic, double factor, const double *in, double *out) {
    for (int j = 0; j < conic->unknowns; j++) {
        const double more = factor * in[j], sum = out[j] + more;
        out[j] = fabs(sum) <= CANCELLED * (fabs(out[j]) + fabs(more)) ? 0 : sum;
    }
    out[conic->unknowns] += factor * in[conic->unknowns];
}

/* The same for an equation. Its constants may cancel, so the largest one is recorded, relative to
 * which the sum may be rounding. */
static void balance(CpsiConicRows *conic, double factor, const double *in, double *equation) {
    add(conic, factor, in, equation);
    conic->constant = fmax(conic->constant, fabs(factor * in[conic->width - 1]));
}

static double *unknown(CpsiConicRows *conic, double *affine) {
    affine[conic->next++] = 1;
    return affine;
}

/* out += sum of a_i X_i */
static void add_product(const CpsiConicRows *conic, int n, double factor, const double *a,
                        const double *x, double *out) {
    for (int i = 0; i < n; i++)
        if (a[i] != 0) add(conic, factor * a[i], &x[(size_t)i * (size_t)conic->width], out);
}

/* the rows of a hull from its facets */
static void hull_rows(CpsiConicRows *conic, const CpsiHull *hull, const double *x,
                      const double *t) {
    const size_t n = (size_t)hull->n;
    for (size_t k = 0; k < n - (size_t)hull->dimension; k++) {
        double *equation = cpsi_conic_rows_equation(conic);
        for (size_t i = 0; i < n; i++)
            balance(conic, hull->normal[k * n + i], &x[i * (size_t)conic->width], equation);
        balance(conic, -hull->level[k], t, equation);
    }
    for (int k = 0; k < hull->rows; k++) {
        double *row = cpsi_conic_rows_cone(conic, 1);
        add_product(conic, hull->n, -1, &hull->row[(size_t)k * n], x, row);
        add(conic, hull->offset[k], t, row);
    }
}

static void points_rows(CpsiConicRows *conic, const CpsSet *set, const double *x, const double *t) {
    if (set->hull) {
        hull_rows(conic, set->hull, x, t);
        return;
    }
    const int n = set->n, first = conic->next;
    /* X = sum factor_k point_k, with factors >= 0 whose sum is t */
    double *equation = NULL;
    for (int i = 0; i < n; i++) {
        equation = cpsi_conic_rows_equation(conic);
        balance(conic, -1, &x[(size_t)i * (size_t)conic->width], equation);
        if (set->count == 1)
            balance(conic, set->a[i], t, equation);
        else
            for (int k = 0; k < set->count; k++)
                equation[first + k] += set->a[(size_t)k * (size_t)n + (size_t)i];
    }
    if (set->count == 1) return;
    equation = cpsi_conic_rows_equation(conic);
    balance(conic, -1, t, equation);
    for (int k = 0; k < set->count; k++) {
        equation[first + k] += 1;
        unknown(conic, cpsi_conic_rows_cone(conic, 1));
    }
}

static void ball_rows(CpsiConicRows *conic, const CpsSet *set, const double *x, const double *t) {
    const int n = set->n;
    const size_t w = (size_t)conic->width;
    double *rows = cpsi_conic_rows_cone(conic, n + 1);
    const bool ball = set->kind == CPSI_SET_BALL;
    add(conic, ball ? set->scalar : 1, t, rows);
    for (int i = 0; i < n; i++) {
        double *row = &rows[(size_t)(i + 1) * w];
        for (int j = ball ? i : 0; j <= i; j++) {
            const double factor = ball ? 1 : set->c[i * n + j];
            add(conic, factor, &x[(size_t)j * w], row);
            add(conic, -factor * set->a[j], t, row);
        }
    }
}

static void box_rows(CpsiConicRows *conic, const CpsSet *set, const double *x, const double *t) {
    for (int i = 0; i < set->n; i++) {
        const double *xi = &x[(size_t)i * (size_t)conic->width];
        if (set->a[i] == set->b[i]) {
            double *equation = cpsi_conic_rows_equation(conic);
            balance(conic, 1, xi, equation);
            balance(conic, -set->a[i], t, equation);
            continue;
        }
        if (isfinite(set->a[i])) {
            double *row = cpsi_conic_rows_cone(conic, 1);
            add(conic, 1, xi, row);
            add(conic, -set->a[i], t, row);
        }
        if (isfinite(set->b[i])) {
            double *row = cpsi_conic_rows_cone(conic, 1);
            add(conic, -1, xi, row);
            add(conic, set->b[i], t, row);
        }
    }
}

static void inequalities_rows(CpsiConicRows *conic, const CpsSet *set, const double *x,
                              const double *t) {
    for (int k = 0; k < set->count; k++) {
        double *row = cpsi_conic_rows_cone(conic, 1);
        add_product(conic, set->n, -1, &set->a[(size_t)k * (size_t)set->n], x, row);
        add(conic, set->b[k], t, row);
    }
}

static void subspace_rows(CpsiConicRows *conic, const CpsSet *set, const double *x) {
    for (int k = set->count; k < set->n; k++) {
        double *equation = cpsi_conic_rows_equation(conic);
        for (int i = 0; i < set->n; i++)
            balance(conic, set->a[(size_t)k * (size_t)set->n + (size_t)i],
                    &x[(size_t)i * (size_t)conic->width], equation);
    }
}

static void rays_rows(CpsiConicRows *conic, const CpsSet *set, const double *x) {
    const int n = set->n, first = conic->next;
    for (int i = 0; i < n; i++) {
        double *equation = cpsi_conic_rows_equation(conic);
        balance(conic, -1, &x[(size_t)i * (size_t)conic->width], equation);
        for (int k = 0; k < set->count; k++)
            equation[first + k] += set->a[(size_t)k * (size_t)n + (size_t)i];
    }
    for (int k = 0; k < set->count; k++) unknown(conic, cpsi_conic_rows_cone(conic, 1));
}

static void conic_rows(CpsiConicRows *conic, const CpsSet *set, const double *x, const double *t) {
    const CpsiConicForm *form = set->form;
    const int n = set->n, u = form->unknowns, first = conic->next;
    conic->next += u + form->lines;
    for (int i = 0; i < n; i++) {
        double *equation = cpsi_conic_rows_equation(conic);
        balance(conic, -1, &x[(size_t)i * (size_t)conic->width], equation);
        balance(conic, form->origin[i], t, equation);
        for (int j = 0; j < u; j++)
            equation[first + j] += form->p[(size_t)i * (size_t)u + (size_t)j];
        for (int l = 0; l < form->lines; l++) equation[first + u + l] += form->q[l * n + i];
    }
    if (form->empty) /* the equation t = 0 has no solution with t = 1 */
        add(conic, 1, t, cpsi_conic_rows_equation(conic));
    for (int k = 0, i = 0; k < form->cones; k++) {
        double *rows = cpsi_conic_rows_cone(conic, form->dim[k]);
        for (int r = 0; r < form->dim[k]; r++, i++, rows += conic->width) {
            for (int j = 0; j < u; j++)
                rows[first + j] += form->a[(size_t)i * (size_t)u + (size_t)j];
            add(conic, form->b[i], t, rows);
        }
    }
}

static void polar_rows(CpsiConicRows *conic, const CpsSet *set, const double *x, const double *t) {
    const CpsiConicForm *form = set->dual;
    if (!form || form->empty) return; /* the polar of the empty set is the whole space */
    const int n = set->n, u = form->unknowns, first = conic->next;
    conic->next += form->rows;
    for (int l = 0; l < form->lines; l++)
        add_product(conic, n, 1, &form->q[l * n], x, cpsi_conic_rows_equation(conic));
    for (int j = 0; j < u; j++) {
        double *equation = cpsi_conic_rows_equation(conic);
        for (int i = 0; i < form->rows; i++)
            equation[first + i] += form->a[(size_t)i * (size_t)u + (size_t)j];
        for (int i = 0; i < n; i++)
            add(conic, form->p[(size_t)i * (size_t)u + (size_t)j] / form->size,
                &x[(size_t)i * (size_t)conic->width], equation);
    }
    double *row = cpsi_conic_rows_cone(conic, 1);
    add(conic, 1, t, row);
    add_product(conic, n, -1, form->origin, x, row);
    for (int i = 0; i < form->rows; i++) row[first + i] -= form->size * form->b[i];
    for (int k = 0, i = 0; k < form->cones; k++) {
        double *rows = cpsi_conic_rows_cone(conic, form->dim[k]);
        for (int r = 0; r < form->dim[k]; r++, i++, rows += conic->width) rows[first + i] += 1;
    }
}

/* ---- rows of operations ---- */

static bool parts_rows(CpsiConicRows *conic, const CpsSet *set, const double *x, const double *t) {
    const bool product = set->kind == CPSI_SET_PRODUCT;
    for (int k = 0; k < set->count; k++) {
        if (!cpsi_conic_rows_write(conic, set->part[k], x, t)) return false;
        if (product) x += (size_t)set->part[k]->n * (size_t)conic->width;
    }
    return true;
}

/* the part of a map, translate or scale, for the corresponding X */
static bool mapped_rows(CpsiConicRows *conic, const CpsSet *set, const double *x, const double *t) {
    const CpsSet *part = set->part[0];
    const int n = set->n;
    const size_t w = (size_t)conic->width;
    double *y = calloc((size_t)part->n * w, sizeof *y);
    if (!y) return false;
    for (int i = 0; i < part->n; i++) {
        double *yi = &y[(size_t)i * w];
        switch (set->kind) {
        case CPSI_SET_PREIMAGE:
            add_product(conic, n, 1, &set->a[(size_t)i * (size_t)n], x, yi);
            add(conic, set->b[i], t, yi);
            break;
        case CPSI_SET_IMAGE: unknown(conic, yi); break;
        case CPSI_SET_TRANSLATE:
            add(conic, 1, &x[(size_t)i * w], yi);
            add(conic, -set->a[i], t, yi);
            break;
        default:
            add(conic, 1 / set->scalar, &x[(size_t)i * w], yi);
            break; /* scale by a factor that is not 0 */
        }
    }
    if (set->kind == CPSI_SET_IMAGE)
        for (int i = 0; i < n; i++) {
            double *equation = cpsi_conic_rows_equation(conic);
            balance(conic, -1, &x[(size_t)i * w], equation);
            add_product(conic, part->n, 1, &set->a[(size_t)i * (size_t)part->n], y, equation);
        }
    const bool done = cpsi_conic_rows_write(conic, part, y, t);
    free(y);
    return done;
}

static bool sum_rows(CpsiConicRows *conic, const CpsSet *set, const double *x, const double *t) {
    const int n = set->n;
    const bool hull = set->kind == CPSI_SET_HULL;
    int most = n; /* largest number of components of a part */
    for (int k = 1; k < set->count; k++)
        if (is_carried(set, k) && set->part[k]->part[0]->n > most) most = set->part[k]->part[0]->n;
    const size_t w = (size_t)conic->width, each = ((size_t)most + 1) * w;
    double *parts = calloc((size_t)set->count * each, sizeof *parts),
           *last = parts ? parts + (size_t)most * w : NULL;
    if (!parts) return false;
    /* X_k or y_k, and t_k, are new unknowns, except for the first part, which is X and t less the
     * others */
    memcpy(parts, x, (size_t)n * w * sizeof *x);
    memcpy(last, t, w * sizeof *t);
    for (int k = 1; k < set->count; k++) {
        double *part = &parts[(size_t)k * each], *share = &last[(size_t)k * each];
        const CpsSet *of = set->part[k];
        const int m = is_carried(set, k) ? of->part[0]->n : n;
        for (int i = 0; i < m; i++) unknown(conic, &part[(size_t)i * w]);
        for (int i = 0; i < n; i++) {
            double *rest = &parts[(size_t)i * w];
            if (is_carried(set, k))
                add_product(conic, m, -1, &of->a[(size_t)i * (size_t)m], part, rest);
            else
                add(conic, -1, &part[(size_t)i * w], rest);
        }
        if (hull) {
            unknown(conic, share);
            add(conic, -1, share, last);
        } else {
            add(conic, 1, t, share);
        }
    }
    bool done = true;
    for (int k = 0; done && k < set->count; k++) {
        const double *share = &last[(size_t)k * each];
        if (hull && !keeps_share(set->part[k]))
            add(conic, 1, share, cpsi_conic_rows_cone(conic, 1));
        done =
            cpsi_conic_rows_write(conic, is_carried(set, k) ? set->part[k]->part[0] : set->part[k],
                                  &parts[(size_t)k * each], share);
    }
    free(parts);
    return done;
}

bool cpsi_conic_rows_write(CpsiConicRows *conic, const CpsSet *set, const double *x,
                           const double *t) {
    switch (kind_of(set)) {
    case CPSI_SET_POINTS: points_rows(conic, set, x, t); return true;
    case CPSI_SET_BALL:
    case CPSI_SET_ELLIPSOID: ball_rows(conic, set, x, t); return true;
    case CPSI_SET_BOX: box_rows(conic, set, x, t); return true;
    case CPSI_SET_INEQUALITIES: inequalities_rows(conic, set, x, t); return true;
    case CPSI_SET_SUBSPACE: subspace_rows(conic, set, x); return true;
    case CPSI_SET_RAYS: rays_rows(conic, set, x); return true;
    case CPSI_SET_CONIC: conic_rows(conic, set, x, t); return true;
    case CPSI_SET_POLAR: polar_rows(conic, set, x, t); return true;
    case CPSI_SET_PRODUCT:
    case CPSI_SET_INTERSECTION: return parts_rows(conic, set, x, t);
    case CPSI_SET_SUM:
    case CPSI_SET_HULL: return sum_rows(conic, set, x, t);
    case CPSI_SET_PREIMAGE:
    case CPSI_SET_IMAGE:
    case CPSI_SET_TRANSLATE:
    case CPSI_SET_SCALE: return mapped_rows(conic, set, x, t);
    case CPSI_SET_USER: return true; /* never reached: cpsi_set_has_user is checked before */
    }
    return true;
}
