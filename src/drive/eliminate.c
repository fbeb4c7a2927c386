/* SPDX-License-Identifier: BSD-3-Clause */
/* Proposition 1: the law between W and G.
 *
 * With V = E W + N y, F is in equilibrium exactly where N (B*F + load) = 0, and then G = E*(B*F +
 * load). With F = F0 + L t,
 *
 *     D = { G0 + M t : F0 + L t in C },     C = C_0 x C_1 x ..,   M = (B E)* L,
 *         G0 = E*(B*F0 + load),
 *
 * which is an image of a preimage. Where G determines t (M invertible, as for the wheel) it is the
 * preimage by L M^-1 alone; where no velocity is free (no y) it is the image alone, the sum of the
 * contacts of a rigid body. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "drive/motion.h"
#include "drive/null_space.h"
#include "linalg/dense.h"

/* Rows of the drive count as dependent at this share, the rounding of the given numbers. */
static const double DEPENDENT = 1e-9;
/* A force farther outside its law than this share of its size is not a force of the law. */
static const double CONTRADICTION = 1e-9;
/* A force nearer to a law's boundary than this share of its size is on the boundary. */
static const double BOUNDARY = 1e-6;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a reduced law");
}

/* E (m, n): row j is the velocity of least norm with W = e_j, C V = 0. */
static CpsStatus carry_drive(const CpsSystem *system, double *carried, CpsError *err) {
    const int n = system->n, m = system->drive.rows, rows = m + system->constraint.rows;
    double *rhs = malloc(((size_t)rows + 1) * sizeof *rhs);
    CpsStatus status = rhs ? CPS_OK : out_of_memory(err);
    for (int j = 0; status == CPS_OK && j < m; j++) {
        int rank;
        double *all = NULL;
        memset(rhs, 0, (size_t)rows * sizeof *rhs);
        rhs[j] = 1;
        status = cpsi_system_kernel(system, rhs, &rank, &all, err);
        double size = 0;
        if (status == CPS_OK)
            for (int i = 0; i < rows; i++) size = fmax(size, fabs(rhs[i]));
        for (int i = rank; status == CPS_OK && i < rows; i++)
            if (fabs(rhs[i]) > DEPENDENT * size)
                status = cpsi_fail(
                    err, CPS_ERR_ARGUMENT,
                    "row %d of the drive depends on the constraints and its other rows: its "
                    "velocity is not free, so no law ties it to a force of its own; leave it out",
                    j);
        if (status == CPS_OK)
            for (int i = 0; i < rank; i++)
                for (int k = 0; k < n; k++)
                    carried[(size_t)j * (size_t)n + (size_t)k] +=
                        rhs[i] * all[(size_t)i * (size_t)n + (size_t)k];
        free(all);
    }
    free(rhs);
    return status;
}

/* Arrays of a reduction, in one block. */
typedef struct Reduction {
    CpsiDense dense;
    int m, p;
    double *carried; /* (m, n) E */
    double *contact; /* (components, m) B E: velocities of the laws at W */
    double *inner;   /* (components, p) L as columns */
    double *outer;   /* (p, m) M*, velocities of t at W */
    double *direct;  /* (components, m) L M^-1 */
    double *origin;  /* (m) G0 */
    double *shift;   /* (components) F0 - L M^-1 G0 */
    double *lu;      /* (m, m) */
    int *pivot;      /* (m) */
    bool invertible;
} Reduction;

static void clear(Reduction *r) {
    cpsi_dense_clear(&r->dense);
    free(r->carried);
    free(r->pivot);
}

static CpsStatus allocate(Reduction *r, CpsError *err) {
    const size_t n = (size_t)r->dense.n, c = (size_t)r->dense.components, m = (size_t)r->m,
                 p = (size_t)r->p;
    double *at = r->carried =
        calloc(m * n + 2 * c * m + c * p + p * m + m + c + m * m + 1, sizeof *at);
    r->pivot = calloc(m + 1, sizeof *r->pivot);
    if (!at || !r->pivot) return out_of_memory(err);
    r->contact = at + m * n;
    r->inner = r->contact + c * m;
    r->outer = r->inner + c * p;
    r->direct = r->outer + p * m;
    r->origin = r->direct + c * m;
    r->shift = r->origin + m;
    r->lu = r->shift + c;
    return CPS_OK;
}

/* L M^-1, where M is square and its inverse amplifies rounding by no more than 1e8. */
static void invert(Reduction *r) {
    const size_t c = (size_t)r->dense.components, m = (size_t)r->m;
    double largest = 0;
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < m; j++) r->lu[j * m + i] = r->outer[i * m + j]; /* M */
    for (size_t i = 0; i < m * m; i++) largest = fmax(largest, fabs(r->lu[i]));
    r->invertible = cpsi_lu_factor(r->m, r->lu, r->pivot);
    for (size_t i = 0; i < m; i++) r->invertible &= fabs(r->lu[i * m + i]) > 1e-8 * largest;
    if (!r->invertible) return;
    double *column = r->origin; /* used as scratch; G0 is written later */
    for (size_t j = 0; j < m; j++) {
        memset(column, 0, m * sizeof *column);
        column[j] = 1;
        cpsi_lu_solve(r->m, r->lu, r->pivot, column);
        for (size_t i = 0; i < c; i++) {
            r->direct[i * m + j] = cpsi_dot(r->p, &r->inner[i * (size_t)r->p], column);
            cpsi_dense_round(1, cpsi_norm(r->p, column), &r->direct[i * m + j]);
        }
    }
}

static CpsStatus reduce(const CpsSystem *system, Reduction *r, CpsError *err) {
    CpsStatus status = cpsi_dense_new(system, &r->dense, err);
    const CpsiDense *d = &r->dense;
    r->m = system->drive.rows;
    r->p = d->balanced;
    if (status == CPS_OK && d->contradiction)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "nothing balances the load: it moves parameters that no law resists");
    if (status == CPS_OK) status = allocate(r, err);
    if (status == CPS_OK) status = carry_drive(system, r->carried, err);
    if (status != CPS_OK) return status;
    const size_t n = (size_t)d->n, c = (size_t)d->components, m = (size_t)r->m, p = (size_t)r->p;
    for (size_t i = 0; i < c; i++)
        for (size_t j = 0; j < m; j++)
            r->contact[i * m + j] = cpsi_dot(d->n, &d->map[i * n], &r->carried[j * n]);
    for (size_t i = 0; i < c; i++)
        for (size_t k = 0; k < p; k++) r->inner[i * p + k] = d->forces[k * c + i];
    for (size_t k = 0; k < p; k++)
        for (size_t j = 0; j < m; j++)
            for (size_t i = 0; i < c; i++)
                r->outer[k * m + j] += d->forces[k * c + i] * r->contact[i * m + j];
    double size = 0;
    for (size_t i = 0; i < c * m; i++) size = fmax(size, fabs(r->contact[i]));
    cpsi_dense_round(c * m, size, r->contact);
    cpsi_dense_round(p * m, size, r->outer);
    if (p == m && d->free > 0) invert(r);
    /* G0 = E*(B*F0 + load), and the shift of the direct preimage */
    for (size_t j = 0; j < m; j++) {
        r->origin[j] = system->load ? cpsi_dot(d->n, &r->carried[j * n], system->load) : 0;
        for (size_t i = 0; i < c; i++) r->origin[j] += r->contact[i * m + j] * d->start[i];
    }
    for (size_t i = 0; i < c; i++)
        r->shift[i] =
            d->start[i] - (r->invertible ? cpsi_dot(r->m, &r->direct[i * m], r->origin) : 0);
    return CPS_OK;
}

/* the law of one force, 0 */
static CpsStatus no_force(int m, CpsLaw **out, CpsError *err) {
    CpsSet *point = NULL;
    CpsStatus status = cps_set_subspace(m, 0, NULL, &point, err);
    if (status == CPS_OK) status = cps_law_friction(point, out, err);
    cps_set_release(point);
    return status;
}

/* without a load every intermediate result is a law */
static CpsStatus compose_law(const Reduction *r, const CpsLaw *product, CpsLaw **out,
                             CpsError *err) {
    if (r->p == 0) return no_force(r->m, out, err);
    if (r->invertible) return cps_law_preimage(r->m, r->direct, product, NULL, out, err);
    const double *const all = r->contact, *const outer = r->outer;
    if (r->dense.free == 0) return cps_law_contacts(r->m, 1, &product, &all, out, err);
    CpsLaw *inner = NULL;
    CpsStatus status = cps_law_preimage(r->p, r->inner, product, NULL, &inner, err);
    if (status == CPS_OK)
        status = cps_law_contacts(r->m, 1, (const CpsLaw *const *)&inner, &outer, out, err);
    cps_law_release(inner);
    return status;
}

/* The only F0 in equilibrium, as a set of G: empty where the laws cannot give it. */
static CpsStatus only_force(const Reduction *r, const CpsSet *product, CpsSet **out,
                            CpsError *err) {
    const size_t m = (size_t)r->m;
    CpsSetAnswer inside;
    double *rows = calloc(2 * m, sizeof *rows);
    if (!rows) return out_of_memory(err);
    rows[0] = 1;
    rows[m] = -1;
    CpsStatus status = cps_set_contains(product, r->dense.start, NULL, &inside, err);
    const double size = fmax(1, cpsi_norm(r->dense.components, r->dense.start));
    const bool out_of_it =
        inside.outcome == CPS_SET_OUTCOME_ANSWERED && inside.value < -CONTRADICTION * size;
    if (status == CPS_OK && out_of_it)
        status = cps_set_inequalities(r->m, 2, rows, (const double[]){-1, -1}, out, err);
    else if (status == CPS_OK)
        status = cps_set_point(r->m, r->origin, out, err);
    free(rows);
    return status;
}

/* with a load: the same with sets */
static CpsStatus compose_set(const Reduction *r, const CpsSet *product, CpsSet **out,
                             CpsError *err) {
    if (r->p == 0) return only_force(r, product, out, err);
    if (r->invertible) return cps_set_preimage(r->m, r->direct, r->shift, product, out, err);
    const size_t m = (size_t)r->m, p = (size_t)r->p;
    double *turned = malloc((m * p + 1) * sizeof *turned);
    if (!turned) return out_of_memory(err);
    for (size_t k = 0; k < p; k++)
        for (size_t j = 0; j < m; j++) turned[j * p + k] = r->outer[k * m + j];
    CpsSet *inner = NULL, *image = NULL;
    CpsStatus status = cps_set_preimage(r->p, r->inner, r->shift, product, &inner, err);
    if (status == CPS_OK) status = cps_set_image(r->m, turned, inner, &image, err);
    if (status == CPS_OK) status = cps_set_translate(r->origin, image, out, err);
    cps_set_release(inner);
    cps_set_release(image);
    free(turned);
    return status;
}

/* C = C_0 x C_1 x .. */
static CpsStatus product_of(const CpsSystem *system, CpsLaw **out, CpsError *err) {
    const CpsLaw **law = malloc(((size_t)system->laws + 1) * sizeof *law);
    if (!law) return out_of_memory(err);
    for (int k = 0; k < system->laws; k++) law[k] = system->law[k].friction_law;
    const CpsStatus status = cps_law_product(system->laws, law, out, err);
    free(law);
    return status;
}

static CpsStatus check(const CpsSystem *system, CpsLaw **law, CpsError *err) {
    if (!system) return cpsi_fail(err, CPS_ERR_ARGUMENT, "system is NULL");
    if (system->drive.rows == 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the system has no drive: there is no W for a law to be about");
    if (system->laws == 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the system has no laws: nothing resists the drive");
    for (int k = 0; k < system->laws; k++)
        if (system->law[k].resistance)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "%s is a resistance law: its forces depend on how fast it moves, so "
                             "no set describes the reduced law; drive the system instead",
                             system->law[k].name);
    if (law && cpsi_system_loaded(system))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the system carries a load: its forces need not contain 0, so they make "
                         "no friction law; ask for the set of forces");
    return CPS_OK;
}

CpsStatus cps_system_eliminate(const CpsSystem *system, CpsLaw **law, CpsSet **forces,
                               CpsComposition *composition, CpsError *err) {
    CpsStatus status = check(system, law, err);
    if (status != CPS_OK) return status;
    Reduction r = {0};
    CpsLaw *product = NULL, *reduced = NULL;
    CpsSet *set = NULL;
    CpsComposition found = CPS_COMPOSITION_NOT_SATISFIED;
    status = reduce(system, &r, err);
    if (status == CPS_OK) status = product_of(system, &product, err);
    if (status == CPS_OK && cpsi_system_loaded(system))
        status = compose_set(&r, cps_law_set(product), &set, err);
    else if (status == CPS_OK) {
        status = compose_law(&r, product, &reduced, err);
        if (status == CPS_OK) set = cps_set_retain(cps_law_set(reduced));
    }
    int iterations = 0;
    if (status == CPS_OK && composition)
        status = cpsi_motion_composition(system, BOUNDARY, &found, &iterations, err);
    if (status == CPS_OK) {
        if (law) {
            *law = reduced;
            reduced = NULL;
        }
        if (forces) {
            *forces = set;
            set = NULL;
        }
        if (composition) *composition = found;
    }
    cps_law_release(product);
    cps_law_release(reduced);
    cps_set_release(set);
    clear(&r);
    return status;
}
