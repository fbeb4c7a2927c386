/* SPDX-License-Identifier: BSD-3-Clause */
/* The chain of scalars as a program of the interior-point loop (scalar_program.h).
 *
 * One kind of element, the cones of the sites:  ds = G du + keep rho,   dz = q - H ds,
 *     H = g W^-2 (cones.h). With M_k = G_k'H_k G_k the
 * site's block on (y, v), its own part is eliminated by a Cholesky factor, the rest is added to the
 * tridiagonal matrix of the scalars. */
#include "chain/scalar_program.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/larger.h"

static inline CpsiScalarProgram *scalar(CpsiProgram *base) { return (CpsiScalarProgram *)base; }

/* The unknowns that a site depends on, from the vector of all. */
static void read_unknowns(const CpsiSite *site, const double *u, double out[CPSI_SITE_SEEN]) {
    for (int a = 0; a < 2; a++) out[a] = site->scalar[a] >= 0 ? u[site->scalar[a]] : 0;
    for (int a = 0; a < CPSI_SITE_OWN; a++) out[2 + a] = a < site->own ? u[site->at + a] : 0;
}

static void add_forces(const CpsiSite *site, const double in[CPSI_SITE_SEEN], double *u) {
    for (int a = 0; a < 2; a++)
        if (site->scalar[a] >= 0) u[site->scalar[a]] += in[a];
    for (int a = 0; a < site->own; a++) u[site->at + a] += in[2 + a];
}

static double row_of(const double g[CPSI_SITE_SEEN], const double seen[CPSI_SITE_SEEN]) {
    double sum = 0;
    for (int a = 0; a < CPSI_SITE_SEEN; a++) sum += g[a] * seen[a];
    return sum;
}

/* passes --------------------------------------------------------------------------------------- */

static void start(CpsiProgram *base, double mu, double margin) {
    (void)margin;
    cpsi_cones_start(&scalar(base)->cones, mu);
}

static void measure(CpsiProgram *base, double alpha, CpsiSums *sums) {
    CpsiScalarProgram *program = scalar(base);
    CpsiCones *cones = &program->cones;
    if (alpha != 0) cpsi_cones_advance(cones, alpha);
    for (int g = 0; g < program->scalars; g++) base->residual[g] -= program->weight[g] * base->u[g];
    for (int k = 0; k < program->sites; k++) {
        const CpsiSite *site = &program->site[k];
        double seen[CPSI_SITE_SEEN], force[CPSI_SITE_SEEN] = {0};
        read_unknowns(site, base->u, seen);
        for (int i = site->row; i < site->row + site->rows; i++) {
            cones->rho[i] = row_of(program->g[i], seen) + program->h[i] - cones->s[i];
            sums->residual = cpsi_max_nan(sums->residual, fabs(cones->rho[i]));
            sums->sz += cones->s[i] * cones->z[i];
            sums->largest = cpsi_max_nan(sums->largest, fabs(cones->z[i]));
            for (int a = 0; a < CPSI_SITE_SEEN; a++) force[a] += program->g[i][a] * cones->z[i];
        }
        for (int a = 0; a < site->own; a++)
            for (int b = 0; b < site->own; b++)
                force[2 + a] -= site->weight[CPSI_SITE_OWN * a + b] * seen[2 + b];
        add_forces(site, force, base->residual);
    }
    sums->weight += cones->count;
}

/* out = H x for the rows of a site. */
static void apply_hessian(const CpsiScalarProgram *program, const CpsiSite *site, const double *x,
                          double *out) {
    const CpsiCones *cones = &program->cones;
    double turned[CPSI_SITE_SEEN + CPSI_SITE_OWN];
    for (int c = site->cone, i = site->row; c < site->cone + site->cones; i += program->dim[c++]) {
        cpsi_cones_apply(cones, c, i, -1, 1, &x[i - site->row], turned);
        cpsi_cones_apply(cones, c, i, -1, cones->g[c], turned, &out[i - site->row]);
    }
}

enum { MOST_ROWS = 12 }; /* of a site: two contacts of five */

/* Condense a site: its part of the scalars' matrix. */
static void condense(CpsiScalarProgram *program, CpsiSite *site) {
    double m[CPSI_SITE_SEEN][CPSI_SITE_SEEN] = {{0}}, column[MOST_ROWS], h[MOST_ROWS];
    for (int b = 0; b < 2 + site->own; b++) {
        for (int i = 0; i < site->rows; i++) column[i] = program->g[site->row + i][b];
        apply_hessian(program, site, column, h);
        for (int a = 0; a < 2 + site->own; a++)
            for (int i = 0; i < site->rows; i++) m[a][b] += program->g[site->row + i][a] * h[i];
    }
    /* Cholesky factor of the block of the site's own unknowns; pivots below rounding are replaced
     * by the rounding level */
    double *l = site->factor;
    for (int a = 0; a < site->own; a++) {
        for (int b = 0; b <= a; b++) {
            const double whole = m[2 + a][2 + b] + site->weight[CPSI_SITE_OWN * a + b];
            double sum = whole;
            for (int k = 0; k < b; k++) sum -= l[CPSI_SITE_OWN * a + k] * l[CPSI_SITE_OWN * b + k];
            l[CPSI_SITE_OWN * a + b] = a == b ? sqrt(fmax(sum, DBL_EPSILON * fabs(whole) + DBL_MIN))
                                              : sum / l[CPSI_SITE_OWN * b + b];
        }
    }
    for (int s = 0; s < 2; s++)
        for (int a = 0; a < site->own; a++) {
            double sum = m[2 + a][s];
            for (int k = 0; k < a; k++)
                sum -= l[CPSI_SITE_OWN * a + k] * site->couple[CPSI_SITE_OWN * s + k];
            site->couple[CPSI_SITE_OWN * s + a] = sum / l[CPSI_SITE_OWN * a + a];
        }
    for (int s = 0; s < 2; s++)
        for (int r = 0; r < site->own; r++)
            for (int t = 0; t < 2; t++)
                m[s][t] -=
                    site->couple[CPSI_SITE_OWN * s + r] * site->couple[CPSI_SITE_OWN * t + r];
    for (int s = 0; s < 2; s++)
        if (site->scalar[s] >= 0) program->diagonal[site->scalar[s]] += fmax(0, m[s][s]);
    if (site->scalar[0] >= 0 && site->scalar[1] >= 0) program->off[site->scalar[1]] += m[0][1];
}

static void scale(CpsiProgram *base) {
    CpsiScalarProgram *program = scalar(base);
    cpsi_cones_scale(&program->cones);
    for (int k = 0; k < program->sites; k++) condense(program, &program->site[k]);
}

/* `scale` has computed q of the predictor, and there are no centring steps. */
static void load(CpsiProgram *base, const CpsiIpmAim *aim) {
    CpsiScalarProgram *program = scalar(base);
    CpsiCones *cones = &program->cones;
    if (aim->kind == CPSI_IPM_AIM_CORRECT) cpsi_cones_correct(cones, aim->target);
    for (int k = 0; k < program->sites; k++) {
        const CpsiSite *site = &program->site[k];
        double rho[MOST_ROWS], h[MOST_ROWS], force[CPSI_SITE_SEEN] = {0};
        for (int i = 0; i < site->rows; i++) rho[i] = aim->keep * cones->rho[site->row + i];
        apply_hessian(program, site, rho, h);
        for (int i = 0; i < site->rows; i++)
            for (int a = 0; a < CPSI_SITE_SEEN; a++)
                force[a] += program->g[site->row + i][a] * (cones->q[site->row + i] - h[i]);
        add_forces(site, force, base->du);
    }
}

static void direct(CpsiProgram *base, const CpsiIpmAim *aim, CpsiSums *sums) {
    CpsiScalarProgram *program = scalar(base);
    CpsiCones *cones = &program->cones;
    for (int k = 0; k < program->sites; k++) {
        const CpsiSite *site = &program->site[k];
        double seen[CPSI_SITE_SEEN], h[MOST_ROWS];
        read_unknowns(site, base->du, seen);
        for (int i = site->row; i < site->row + site->rows; i++)
            cones->ds[i] = row_of(program->g[i], seen) + aim->keep * cones->rho[i];
        apply_hessian(program, site, &cones->ds[site->row], h);
        for (int i = 0; i < site->rows; i++)
            cones->dz[site->row + i] = cones->q[site->row + i] - h[i];
    }
    sums->inverse_step = cpsi_max_nan(sums->inverse_step, cpsi_cones_step(cones));
}

static const CpsiKind cones_kind = {start, measure, scale, load, direct};
static const CpsiKind *const KINDS[] = {&cones_kind};

/* the linear system ---------------------------------------------------------------------------- */

static void clear(CpsiProgram *base) {
    CpsiScalarProgram *program = scalar(base);
    for (int g = 0; g < program->scalars; g++) {
        program->diagonal[g] = program->weight[g];
        program->off[g] = 0;
    }
}

static bool factor(CpsiProgram *base) {
    CpsiScalarProgram *program = scalar(base);
    for (int g = 0; g < program->scalars; g++) {
        const double whole = program->diagonal[g];
        const double less = g > 0 ? program->off[g] * program->off[g] / program->pivot[g - 1] : 0;
        program->pivot[g] = fmax(whole - less, DBL_EPSILON * whole + DBL_MIN);
        if (!isfinite(whole) || !isfinite(less)) return false;
    }
    return true;
}

/* Eliminate the sites' own unknowns, solve for the scalars, and substitute back. */
static void solve(CpsiProgram *base) {
    CpsiScalarProgram *program = scalar(base);
    double *du = base->du;
    for (int k = 0; k < program->sites; k++) {
        const CpsiSite *site = &program->site[k];
        const double *l = site->factor;
        double *own = &du[site->at];
        for (int a = 0; a < site->own; a++) {
            for (int b = 0; b < a; b++) own[a] -= l[CPSI_SITE_OWN * a + b] * own[b];
            own[a] /= l[CPSI_SITE_OWN * a + a];
        }
        for (int s = 0; s < 2; s++)
            if (site->scalar[s] >= 0)
                for (int a = 0; a < site->own; a++)
                    du[site->scalar[s]] -= site->couple[CPSI_SITE_OWN * s + a] * own[a];
    }
    for (int g = 1; g < program->scalars; g++)
        du[g] -= program->off[g] / program->pivot[g - 1] * du[g - 1];
    for (int g = program->scalars - 1; g >= 0; g--) {
        du[g] /= program->pivot[g];
        if (g + 1 < program->scalars) du[g] -= program->off[g + 1] / program->pivot[g] * du[g + 1];
    }
    for (int k = 0; k < program->sites; k++) {
        const CpsiSite *site = &program->site[k];
        const double *l = site->factor;
        double *own = &du[site->at];
        for (int a = site->own - 1; a >= 0; a--) {
            for (int s = 0; s < 2; s++)
                if (site->scalar[s] >= 0)
                    own[a] -= site->couple[CPSI_SITE_OWN * s + a] * du[site->scalar[s]];
            for (int b = a + 1; b < site->own; b++) own[a] -= l[CPSI_SITE_OWN * b + a] * own[b];
            own[a] /= l[CPSI_SITE_OWN * a + a];
        }
    }
}

static double imbalance(const CpsiProgram *base) {
    double most = 0;
    for (int i = 0; i < base->size; i++) most = cpsi_max_nan(most, fabs(base->residual[i]));
    return most;
}

/* setting up ----------------------------------------------------------------------------------- */

void cpsi_scalar_program_layout(CpsiScalarProgram *program, CpsiArena *arena, int scalars,
                                int sites, int rows) {
    const size_t size = (size_t)scalars + CPSI_SITE_OWN * (size_t)sites;
    *program = (CpsiScalarProgram){.max_sites = sites, .max_rows = rows, .max_scalars = scalars};
    CpsiProgram *base = &program->base;
    double **vector[] = {&base->load, &base->u, &base->du, &base->residual};
    for (size_t k = 0; k < sizeof vector / sizeof *vector; k++) CPSI_PLACE(arena, *vector[k], size);
    double **per_scalar[] = {&program->weight, &program->diagonal, &program->off, &program->pivot};
    for (size_t k = 0; k < sizeof per_scalar / sizeof *per_scalar; k++)
        CPSI_PLACE(arena, *per_scalar[k], scalars);
    CPSI_PLACE(arena, program->site, sites);
    CPSI_PLACE(arena, program->g, rows);
    CPSI_PLACE(arena, program->h, rows);
    CPSI_PLACE(arena, program->dim, rows);
    cpsi_cones_layout(arena, &program->cones, rows, rows, 3);
    base->kind_count = 1;
    base->kind = KINDS;
    base->clear = clear;
    base->factor = factor;
    base->solve = solve;
    base->imbalance = imbalance;
}

void cpsi_scalar_program_begin(CpsiScalarProgram *program, int scalars) {
    program->scalars = scalars;
    program->sites = 0;
    program->base.size = scalars;
    program->cones.rows = program->cones.count = 0;
    program->cones.dim = program->dim;
    memset(program->weight, 0, (size_t)scalars * sizeof *program->weight);
    memset(program->base.load, 0,
           ((size_t)program->max_scalars + CPSI_SITE_OWN * (size_t)program->max_sites) *
               sizeof(double));
}

CpsiSite *cpsi_scalar_program_site(CpsiScalarProgram *program, int first, int second, int own) {
    CpsiSite *site = &program->site[program->sites++];
    *site = (CpsiSite){.scalar = {first, second == first ? -1 : second},
                       .own = own,
                       .at = program->base.size,
                       .row = program->cones.rows,
                       .cone = program->cones.count};
    program->base.size += own;
    return site;
}

int cpsi_scalar_program_cone(CpsiScalarProgram *program, int dim) {
    CpsiSite *site = &program->site[program->sites - 1];
    const int row = program->cones.rows;
    program->dim[program->cones.count++] = dim;
    program->cones.rows += dim;
    site->cones++;
    site->rows += dim;
    memset(program->g[row], 0, (size_t)dim * sizeof *program->g);
    memset(&program->h[row], 0, (size_t)dim * sizeof *program->h);
    return row;
}

void cpsi_scalar_program_end(CpsiScalarProgram *program) {
    memset(program->base.u, 0, (size_t)program->base.size * sizeof *program->base.u);
}

void cpsi_scalar_program_weigh(CpsiScalarProgram *program, double weight) {
    for (int g = 0; g < program->scalars; g++) program->weight[g] = weight;
    for (int k = 0; k < program->sites; k++)
        for (int a = 0; a < CPSI_SITE_OWN; a++)
            program->site[k].weight[(CPSI_SITE_OWN + 1) * a] = weight;
}

double cpsi_scalar_program_margin(const CpsiScalarProgram *program, int k) {
    const CpsiSite *site = &program->site[k];
    double seen[CPSI_SITE_SEEN], margin = INFINITY;
    read_unknowns(site, program->base.u, seen);
    for (int c = site->cone, i = site->row; c < site->cone + site->cones; i += program->dim[c++]) {
        double across = 0;
        for (int r = 1; r < program->dim[c]; r++)
            across += pow(row_of(program->g[i + r], seen) + program->h[i + r], 2);
        margin = fmin(margin, row_of(program->g[i], seen) + program->h[i] - sqrt(across));
    }
    return margin;
}

double cpsi_scalar_program_bound(const CpsiScalarProgram *program) {
    const CpsiProgram *base = &program->base;
    double sum = 0;
    for (int i = 0; i < program->cones.rows; i++) sum += program->cones.z[i] * program->h[i];
    for (int i = 0; i < base->size; i++) sum += fabs(base->residual[i] * base->u[i]);
    for (int g = 0; g < program->scalars; g++) sum += program->weight[g] * base->u[g] * base->u[g];
    for (int k = 0; k < program->sites; k++) {
        const CpsiSite *site = &program->site[k];
        for (int a = 0; a < site->own; a++)
            for (int b = 0; b < site->own; b++)
                sum += base->u[site->at + a] * site->weight[CPSI_SITE_OWN * a + b] *
                       base->u[site->at + b];
    }
    return sum;
}
